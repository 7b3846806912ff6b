"""Maps over the Reynolds number of pads and of grooves: their grids, differences, identities, FMUs."""

import zipfile
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings import GroovedMapFilm, PadGridFilm, PadMapFilm, PadResolution, Turbulence
from rotorfilm.bearings.films import map_growth
from rotorfilm.bearings.journal import ExtrapolatedFilm, ReynoldsFilm, grooved_film
from rotorfilm.bearings.pads import pad_film
from rotorfilm.fmu import extracted, instantiated

SIZE = {"radius": 0.25, "length": 0.25, "viscosity": 0.0163}
FREE = Turbulence(closure="ng_pan", band=False, density=855.0)
LOBES = rf.lobe_set("elliptical", preload=0.3, extent=1.4)
PADS = {"pivots": rf.even_pivots(4), "extent": 1.4, "preload": 0.5, "pad_clearance": 5e-4}
GROOVES = (rf.Groove(center=0.4, width=0.3),)
SMALL = PadResolution(cells=(32, 4), nodes=(9, 8, 32), xi_range=(-0.5, 0.75), reach=0.85)
FILM = PadMapFilm(resolution=SMALL, reynolds_cells=6)
GROOVED = GroovedMapFilm(cells=(64, 8), nodes=(6, 24, 20), largest_eccentricity_ratio=0.7, reynolds_cells=6)
PLACE, VELOCITY, SPEED = np.array([0.6e-4, -1.1e-4]), np.array([0.01, 0.02]), 250.0


@pytest.fixture(scope="module")
def bearings(tmp_path_factory):
    """Return turbulent bearings with the maps of small grids, and the same on grids."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("maps")))
        patch.setattr(map_growth, "LARGEST_REYNOLDS", 4000.0)
        patch.setattr(pad_film, "GROWTH", {"cells": (32, 4), "nodes": (7, 6, 20)})
        patch.setattr(grooved_film, "GROWTH", {"cells": (48, 4), "nodes": (6, 16, 16)})
        lobed = rf.LobedBearing(**SIZE, lobes=LOBES, pad_clearance=5e-4, turbulence=FREE, film=FILM)
        tilting = rf.TiltingPadBearing(**SIZE, **PADS, turbulence=FREE, film=FILM)
        grooved = rf.JournalBearing(**SIZE, clearance=5e-4, grooves=GROOVES, turbulence=FREE, film=GROOVED)
        grid, ring = PadGridFilm(cells=(96, 8)), ExtrapolatedFilm(film=ReynoldsFilm(cells=(96, 8)))
        yield {
            "lobed": (lobed.portable(), replace(lobed, film=grid)),
            "tilting": (tilting.portable(), replace(tilting, film=grid)),
            "grooved": (grooved.portable(), replace(grooved, film=ring)),
        }


KINDS = pytest.mark.parametrize("kind", ["lobed", "tilting", "grooved"])


@KINDS
def test_map_is_its_film_at_all_speeds(bearings, kind):
    own, fine = bearings[kind]
    for speed in (SPEED, -SPEED, 40.0, 400.0):
        wanted = fine.force(PLACE, VELOCITY, speed)
        assert_allclose(own.force(PLACE, VELOCITY, speed), wanted, atol=5e-3 * np.hypot(*wanted))


@KINDS
def test_derivatives_are_those_of_differences(bearings, kind):
    own, _ = bearings[kind]
    by = own.jacobian(PLACE, VELOCITY, SPEED)
    state, steps = np.array([*PLACE, *VELOCITY, SPEED]), [1e-8, 1e-8, 1e-6, 1e-6, 1e-2]
    for k, step in enumerate(steps):
        more, less = (state + sign * step * np.eye(5)[k] for sign in (1.0, -1.0))
        differences = [own.force(each[:2], each[2:4], each[4]) for each in (more, less)]
        assert_allclose((differences[0] - differences[1]) / (2.0 * step), by[:, k], rtol=3e-6, atol=1e-3)


@pytest.mark.filterwarnings("ignore:eccentricity ratio .* at this Reynolds number is beyond the map")
@pytest.mark.parametrize("eccentricity", [0.8, 0.95])
def test_beyond_a_map_the_force_has_its_derivative_by_the_speed(bearings, eccentricity):
    own, _ = bearings["grooved"]
    place = eccentricity * 5e-4 * np.array([0.6, -0.8])
    more, less = (own.force(place, VELOCITY, -SPEED + step) for step in (0.01, -0.01))
    found = own.jacobian(place, VELOCITY, -SPEED)[:, 4]
    assert_allclose(found, (more - less) / 0.02, atol=1e-7 * np.abs(found).max())


@pytest.mark.parametrize("kind", ["lobed", "grooved"])
def test_damping_is_symmetric_and_tells_the_force_at_rest(bearings, kind):
    """F = C (speed/2) z x E for each film about its own center, exactly, at any Reynolds number."""
    own, _ = bearings[kind]
    damping = -own.jacobian(PLACE, np.zeros(2), SPEED)[:, 2:4]
    assert_allclose(damping, damping.T, rtol=1e-11)
    if kind == "grooved":
        found = damping @ (0.5 * SPEED * np.array([-PLACE[1], PLACE[0]]))
        assert_allclose(own.force(PLACE, np.zeros(2), SPEED), found, rtol=1e-11)


def test_turbulent_pads_are_far_from_laminar_ones_and_at_rest_the_same_as_on_the_grid(bearings):
    own, fine = bearings["tilting"]
    at, exact = (rf.equilibrium(each, [0.0, -5e4], SPEED) for each in (own, fine))
    laminar = rf.equilibrium(replace(fine, turbulence=None), [0.0, -5e4], SPEED)
    away = np.hypot(*(laminar.position - exact.position))
    assert np.hypot(*(at.position - exact.position)) < 0.02 * away
    assert at.losses.power_loss == pytest.approx(exact.losses.power_loss, rel=5e-3)


def test_a_map_knows_its_mobility_and_its_range(bearings):
    own, _ = bearings["lobed"]
    table = own.film.tables[0]
    assert type(table).from_bytes(table.to_bytes()) == table
    assert table.bound(0.3, slopes=False) < 0.05
    with pytest.warns(ValidityWarning, match="m at this Reynolds number are beyond the map"):
        own.force(PLACE, VELOCITY, 3000.0)
    with pytest.raises(
        InputError, match=r"mobility must be the one that the table was made with .* got None"
    ):
        replace(own, turbulence=None).force(PLACE, VELOCITY, SPEED)
    tilting, _ = bearings["tilting"]
    with pytest.warns(ValidityWarning, match=r"pad 1 .* at this Reynolds number are beyond the map"):
        tilting.force(PLACE, np.zeros(2), 3000.0)
    with pytest.warns(ValidityWarning, match=r"pad 1 .* at this Reynolds number are beyond the map"):
        tilting.derivative(0.0, tilting.initial_state, [*PLACE, 0.0, 0.0, 3000.0])
    other = replace(own, turbulence=replace(FREE, closure="hirs"))
    with pytest.raises(InputError, match="mobility must be the one that the table was made with"):
        other.force(PLACE, VELOCITY, SPEED)
    with pytest.raises(InputError, match="reynolds_cells must be 0"):
        PadMapFilm(reynolds_cells=3)


INPUTS = ("x", "y", "vx", "vy", "speed")


@KINDS
def test_native_fmus_have_the_forces_of_python_to_the_last_bit(bearings, kind, tmp_path):
    """Among them at a viscosity of their own, which changes the Reynolds number."""
    own, _ = bearings[kind]
    path = rf.export_fmu(own, tmp_path / "turbulent.fmu", "3.0", component="b", start={"speed": 100.0})
    assert not any(name.endswith(".py") for name in zipfile.ZipFile(path).namelist())
    with extracted(path) as (description, folder):
        places = {v.name.removeprefix("b."): v.valueReference for v in description.modelVariables}
        instance = instantiated(description, folder, False)
        instance.initialize([places[name] for name in INPUTS], [*PLACE, *VELOCITY, SPEED])
        state = np.array(own.initial_state) if kind == "tilting" else ()
        found = instance.get([places["force_x"], places["force_y"]])
        assert list(found) == own.output(0.0, state, np.array([*PLACE, *VELOCITY, SPEED]))[:2].tolist()
        if kind != "tilting":
            instance.set([places["viscosity"]], [0.03])
            instance.step(0.0, 0.01)
            thick = replace(own, viscosity=0.03)
            wanted = thick.output(0.0, (), np.array([*PLACE, *VELOCITY, SPEED])).tolist()
            assert list(instance.get([places["force_x"], places["force_y"]])) == wanted
        instance.close()
