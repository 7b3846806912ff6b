"""Locus of the journal center: the closed form of the short bearing, and films that rupture alike."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm.analysis import equilibrium
from rotorfilm.bearings.journal import MapFilm, ReynoldsFilm, ShortFilm
from rotorfilm.scenes import bundled_scene
from rotorfilm.scenes.demo import RUNGS, attitude_angle, attitude_angles, demo_rungs

BEARING = bundled_scene().bearing
RATIOS = np.array([0.1, 0.3, 0.5, 0.74, 0.76])


@pytest.mark.closed_form
def test_attitude_angle_of_the_short_film():
    # tan(attitude) = pi sqrt(1 - e^2) / (4 e): Ocvirk (1952)
    expected = np.arctan2(math.pi * np.sqrt(1.0 - RATIOS**2), 4.0 * RATIOS)
    angles = attitude_angle(replace(BEARING, film=ShortFilm()), RATIOS)
    np.testing.assert_allclose(angles, expected, rtol=1e-12)


@pytest.mark.parametrize("name", ["map", "2-D 96 x 8", "free arc (4+c, 8)"])
def test_films_with_reynolds_rupture_lie_alike(name):
    finest = attitude_angle(replace(BEARING, film=ReynoldsFilm(cells=(192, 16))), RATIOS)
    np.testing.assert_allclose(
        attitude_angles(BEARING, demo_rungs(), RATIOS)[name], finest, atol=math.radians(0.2)
    )


def test_equilibrium_lies_on_the_locus():
    # The other way round: from the load to the position.
    at = equilibrium(BEARING, (0.0, -525.0), 157.08)
    (angle,) = attitude_angle(BEARING, np.array([at.eccentricity_ratio]))
    assert at.attitude_angle == pytest.approx(angle, abs=1e-6)


def test_demonstration_compares_every_film_that_it_names_and_ends_in_that_of_the_bearing():
    assert tuple(rung.name for rung in demo_rungs()) == RUNGS
    assert demo_rungs()[-1].law == BEARING.film == MapFilm()
