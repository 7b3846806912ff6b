"""The mass-conserving film of a tilted journal in SI units: force, moments, K(s), contact, equilibrium."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    FilmContactError,
    Groove,
    InputError,
    JFOFilm,
    JournalBearing,
    ReynoldsFilm,
    coefficients,
    equilibrium,
)
from rotorfilm.bearings import MomentCarryingJFOFilm, MomentCarryingJournal

R, L, c, omega = 0.05, 0.05, 1e-4, 314.0
GROOVES = tuple(Groove(center=angle, width=np.radians(20.0)) for angle in (0.0, np.pi))
BEARING = JournalBearing(radius=R, length=L, clearance=c, viscosity=0.02, grooves=GROOVES)
TOP = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
FED = dataclasses.replace(BEARING, grooves=(TOP,), supply_pressure=2e5)
PLANAR = JFOFilm(bearing=FED, cells=(72, 6))
TILTED = MomentCarryingJFOFilm(film=PLANAR)
PLACE, REST = np.array([3e-5, -4e-5, 6e-4, -4e-4]), np.zeros(4)


@pytest.mark.closed_form
def test_without_tilt_it_is_the_film_of_half_the_length():
    place = np.append(PLACE[:2], [0.0, 0.0])
    force = TILTED.force(place, REST, omega)
    expected = PLANAR.force(place[:2], REST[:2], omega)
    np.testing.assert_allclose(force[:2], expected, rtol=1e-11)
    np.testing.assert_allclose(force[2:], 0.0, atol=1e-12 * L * np.abs(expected).max())
    for K, half in zip(
        TILTED.dynamic_stiffness(place, omega)(100j),
        PLANAR.dynamic_stiffness(place[:2], omega)(100j),
        strict=True,
    ):
        np.testing.assert_allclose(K[:2, :2], half, rtol=1e-9, atol=1e-11 * np.abs(half).max())


@pytest.mark.closed_form
def test_derivatives_are_those_of_force_and_moments():
    jacobian = TILTED.jacobian(PLACE, REST, omega)
    for k, step in enumerate((1e-10, 1e-10, 1e-9, 1e-9)):
        unit = step * np.eye(4)[k]
        ahead, back = (TILTED.force(PLACE + side * unit, REST, omega) for side in (1.0, -1.0))
        slope = (ahead - back) / (2.0 * step)
        np.testing.assert_allclose(jacobian[:, k], slope, atol=1e-5 * np.abs(slope).max())
    K, slope = TILTED.dynamic_stiffness(PLACE, omega)(0.0)
    np.testing.assert_allclose(
        jacobian, np.hstack([-K.real, -slope.real, jacobian[:, 8:]]), rtol=1e-9, atol=1e-9
    )
    near = TILTED.dynamic_stiffness(PLACE, omega).stiffness(1j)
    np.testing.assert_allclose(near.imag, slope.real, rtol=1e-3, atol=1e-4 * np.abs(slope).max())


@pytest.mark.convergence
def test_where_the_film_starts_at_openings_it_is_near_that_of_reynolds():
    # Both on the same cells; Reynolds rupture makes the oil that is missing behind the cavity.
    place = np.array([2e-5, -5e-5, 3e-4, 2e-4])
    reynolds = MomentCarryingJournal(
        bearing=dataclasses.replace(BEARING, film=ReynoldsFilm(cells=(96, 8)))
    ).force(place, REST, omega)
    found = MomentCarryingJFOFilm(film=JFOFilm(bearing=BEARING, cells=(96, 8))).force(place, REST, omega)
    np.testing.assert_allclose(found[:2], reynolds[:2], atol=0.05 * np.abs(reynolds[:2]).max())
    np.testing.assert_allclose(found[2:], reynolds[2:], atol=0.05 * np.abs(reynolds[2:]).max())


def test_a_load_and_a_moment_find_their_place():
    load = -TILTED.force(PLACE, REST, omega)
    at = equilibrium(TILTED, load, omega)
    np.testing.assert_allclose(at.position, PLACE, rtol=1e-6, atol=1e-9)
    found = coefficients(TILTED, PLACE, omega, frequency=150.0)
    K = TILTED.dynamic_stiffness(PLACE, omega).stiffness(150j)
    np.testing.assert_allclose(found.stiffness, K.real, rtol=1e-10)
    np.testing.assert_allclose(found.damping, K.imag / 150.0, rtol=1e-10)


def test_what_it_refuses():
    with pytest.raises(FilmContactError, match="position must leave a film over the whole length"):
        TILTED.force([3e-5, -4e-5, 0.0, 3.2e-3], REST, omega)
    with pytest.raises(InputError, match="velocity must be 0 for a film that conserves its oil"):
        TILTED.force(PLACE, [0.0, 1e-3, 0.0, 0.0], omega)
    split = dataclasses.replace(FED, grooves=(), circumferential_groove=2e-3)
    with pytest.raises(InputError, match="without a circumferential groove"):
        MomentCarryingJFOFilm(film=JFOFilm(bearing=split))
    with pytest.raises(InputError, match="film must be a JFOFilm"):
        MomentCarryingJFOFilm(film=BEARING)


@pytest.mark.closed_form
@pytest.mark.parametrize("angle", [0.1, 0.13])
def test_the_least_film_lies_between_lines_too(angle):
    """On few lines: at the ends the journal is a circle in a circle."""
    few = MomentCarryingJFOFilm(film=dataclasses.replace(PLANAR, cells=(16, 4)))
    e, tau = 0.9 * np.array([np.cos(angle), np.sin(angle)]), np.array([0.05, 0.02])
    place = np.array([*e * c, -tau[1] * 2.0 * c / L, tau[0] * 2.0 * c / L])
    expected = c * (1.0 - max(np.hypot(*(e + tau)), np.hypot(*(e - tau))))
    assert few.minimum_film(place) == pytest.approx(expected, rel=1e-12)
    with pytest.raises(FilmContactError):
        few.force(place * 1.06, REST, omega)
