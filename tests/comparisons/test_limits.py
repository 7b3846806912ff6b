"""The atlas of limits against what is known of each limit, and its reading."""

from importlib import import_module
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, MapFilm
from rotorfilm.studies import failures, limits_atlas
from rotorfilm.studies.journal_accuracy import SPEED

atlas = import_module("rotorfilm.studies.limits_atlas")  # its package shows a function of this name
FAILED = atlas.FAILED

# That a model is used beyond its range is what the atlas shows.
pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")


class Curve(NamedTuple):
    abscissa: np.ndarray
    ordinate: np.ndarray


def curves(panel):
    return {name: Curve(np.asarray(x), np.asarray(y)) for name, x, y in panel()}


@pytest.mark.convergence
def test_short_bearing_fails_with_the_square_of_its_length():
    # Of the static force the short film leaves out terms of the order (L/D)^2.
    for name, curve in curves(atlas.journal_length).items():
        slope = np.polyfit(np.log(curve.abscissa[:5]), np.log(curve.ordinate[:5]), 1)[0]
        assert slope == pytest.approx(2.0, abs=0.15), name


@pytest.mark.closed_form
def test_fixed_arc_fails_beyond_half_speed_whirl_and_not_before():
    found = curves(atlas.journal_extent)
    fixed, turning = found["arc fixed in small motion"], found["arc that turns"]
    slow = fixed.abscissa < 0.5
    np.testing.assert_allclose(fixed.ordinate[slow], turning.ordinate[slow], rtol=1e-6)
    assert np.all(fixed.ordinate[~slow] > 1.0)  # tension where there should be none
    # On a circular orbit all films depend on the one number speed - 2 whirl, to which they are proportional.
    np.testing.assert_allclose(turning.ordinate, turning.ordinate[0], rtol=1e-6)


def test_more_functions_are_closer_at_every_eccentricity():
    found = list(curves(atlas.journal_order).values())
    for worse, better in pairwise(found[1:]):
        assert np.all(better.ordinate < worse.ordinate)


@pytest.mark.convergence
def test_linearization_fails_in_proportion_to_the_displacement():
    for name, curve in curves(atlas.journal_linearization).items():
        slope = np.polyfit(np.log(curve.abscissa[:5]), np.log(curve.ordinate[:5]), 1)[0]
        assert slope == pytest.approx(1.0, abs=0.1), name


@pytest.mark.closed_form
def test_macro_step_of_a_light_rotor_is_proportional_to_its_mass():
    found = curves(atlas.rotor_macro_step)
    light, heavier = (found[f"speed^2 c m / W = {ratio:g}"].ordinate for ratio in (0.01, 0.1))
    np.testing.assert_allclose(heavier / light, 10.0, rtol=0.02)


@pytest.mark.closed_form
def test_failure_is_read_off_the_curve():
    x = np.linspace(0.1, 1.0, 10)
    curve = x, np.exp(5.0 * (x - 0.55))
    assert atlas.failure(*curve, 1.0) == pytest.approx(0.55)
    assert atlas.failure(*curve, 100.0) is None
    assert atlas.failure(*curve, 1e-9) == 0.1


@pytest.mark.closed_form
def test_explicit_steps_end_where_their_stability_does():
    # |1 + z| = 1 at z = -2, and the fourth-order polynomial of exp(z) at -2.785294.
    found = curves(atlas.rotor_time_step)
    euler, fourth = found["explicit Euler"], found["explicit Runge-Kutta, order 4"]
    for curve, limit in ((euler, 2.0), (fourth, 2.785294)):
        assert atlas.failure(*curve, 1.0) == pytest.approx(limit, rel=0.06)
    assert np.all(found["trapezoidal rule"].ordinate < 0.1)


@pytest.mark.convergence
@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("explicit Euler", 1.0),
        ("explicit Runge-Kutta, order 4", 4.0),
        ("implicit Euler", 1.0),
        ("trapezoidal rule", 2.0),
    ],
)
def test_errors_of_time_steps_have_the_order_of_the_scheme(name, order):
    curve = curves(atlas.rotor_time_step)[name]
    short = (curve.abscissa > 0.05) & (curve.abscissa < 0.4)
    slope = np.polyfit(np.log(curve.abscissa[short]), np.log(curve.ordinate[short]), 1)[0]
    assert slope == pytest.approx(order, abs=0.15)


def test_the_film_itself_in_explicit_steps_fails_at_the_limit_of_the_linear_system():
    # The nonlinear equations of motion on the map, on both sides of two shortest time constants.
    bearing: JournalBearing = atlas.journal(MapFilm())
    speed, ratio = SPEED, atlas.STEP_AT
    rest = np.array([ratio * bearing.clearance, 0.0])
    load = -bearing.force(rest, [0.0, 0.0], speed)
    mass = atlas.STEP_MASS * np.hypot(*load) / (speed**2 * bearing.clearance)
    found = coefficients(bearing, rest, speed)
    blocks = [[np.zeros((2, 2)), np.eye(2)], [-found.stiffness / mass, -found.damping / mass]]
    shortest = 1.0 / np.abs(np.linalg.eigvals(np.block(blocks))).max()

    def left_after(step, count=400):
        q, v = rest + np.array([1e-3 * bearing.clearance, 0.0]), np.zeros(2)
        for _ in range(count):
            q, v = q + step * v, v + step * (bearing.force(q, v, speed) + load) / mass
        return np.hypot(*(q - rest)) / bearing.clearance

    # The amplitude of what grows is limited by the film, which stiffens.
    assert left_after(1.9 * shortest) < 1e-3
    assert left_after(2.1 * shortest) > 1e-2


@pytest.mark.convergence
def test_short_damper_fails_with_the_square_of_its_length():
    for name, curve in curves(atlas.damper_length).items():
        slope = np.polyfit(np.log(curve.abscissa[:4]), np.log(curve.ordinate[:4]), 1)[0]
        assert slope == pytest.approx(2.0, abs=0.1), name


@pytest.mark.closed_form
def test_what_is_left_out_of_a_porous_cage_grows_with_its_permeability():
    # A little of it takes away in proportion; the thin layer is exact where there is none.
    for name, curve in curves(atlas.damper_cage).items():
        slope = np.diff(np.log(curve.ordinate[:2]))[0] / np.diff(np.log(curve.abscissa[:2]))[0]
        assert 0.5 < slope < 1.1, name
        assert np.all(np.diff(curve.ordinate) > -1e-6), name


@pytest.mark.closed_form
def test_linear_damper_fails_with_the_square_of_the_orbit():
    # Of a short full film on a circle pi/(1 - eps^2)^1.5, so that pi is off by 1 - (1 - eps^2)^1.5 of it.
    found = curves(atlas.damper_linearization)
    curve = found["full film, L/D 0.1"]
    short = 1.0 - (1.0 - curve.abscissa**2) ** 1.5
    np.testing.assert_allclose(curve.ordinate, short, rtol=0.05)
    # Half a film is wrong from the start: half the damping, and a stiffness instead.
    assert np.all(found["of a full film, where half of it is empty"].ordinate > 0.5)


@pytest.mark.closed_form
@pytest.mark.parametrize(("name", "order"), [("Euler", 1.0), ("BDF2", 3.0)])
def test_steps_of_a_contact_are_judged_by_their_known_damping(name, order):
    # z = i w dt: log|growth| is -(w dt)^2/2 for Euler, and -(w dt)^4/4 for BDF2.
    for y in (1e-2, 2e-2):
        shown = np.log(abs(atlas.STEPPERS[name](1j * y)))
        assert shown == pytest.approx({1.0: -(y**2) / 2.0, 3.0: -(y**4) / 4.0}[order], rel=1e-3)


@pytest.mark.long
@pytest.mark.convergence
def test_upwind_grid_of_a_contact_converges():
    found = curves(atlas.contact_grid)
    curve = found["film in the middle, upwind"]
    slope = np.polyfit(np.log(curve.abscissa), np.log(curve.ordinate), 1)[0]
    assert slope == pytest.approx(2.0, abs=0.35)
    # docs/charts.md: within 10 % on 16 x 16 cells of 4 radii, the smallest film from 24 x 24 on
    assert curve.abscissa.max() == 4.0 / 16.0
    assert atlas.failure(*curve, FAILED) is None
    assert 4.0 / 24.0 < atlas.failure(*found["smallest film, upwind"], FAILED) < 4.0 / 16.0


@pytest.mark.long
@pytest.mark.convergence
def test_nodes_of_a_worn_bush_converge():
    curve = curves(atlas.bush_nodes)["largest"]
    slope = np.polyfit(np.log(curve.abscissa), np.log(curve.ordinate), 1)[0]
    assert 1.5 < slope < 2.5
    assert atlas.failure(*curve, FAILED) == pytest.approx(9.0, abs=0.5)  # docs/charts.md [deg]


def failing(panel, part):
    """Return where the curves of a panel whose names contain a part fail, in their order."""
    return [atlas.failure(*curve, FAILED) for name, curve in curves(panel).items() if part in name]


@pytest.mark.long
def test_limits_of_a_damper_are_as_documented():
    # docs/charts.md, to the digits that it gives
    lengths = {of: failing(atlas.damper_length, of) for of in ("solid", "porous")}
    assert lengths["solid"] == pytest.approx([0.47, 0.30, 0.13], abs=0.006)
    assert lengths["porous"] == pytest.approx([0.50, 0.44, 0.39], abs=0.005)
    cages = curves(atlas.damper_cage)
    assert failing(atlas.damper_cage, "solid") == pytest.approx([0.008, 0.002, 4e-5], rel=0.1)
    assert max(c.ordinate.max() for n, c in cages.items() if "thin" in n) == pytest.approx(0.04, abs=0.005)
    orbits = failing(atlas.damper_linearization, "L/D")
    assert (min(orbits), max(orbits)) == pytest.approx((0.26, 0.35), abs=0.005)


def test_limits_of_steps_of_a_contact_are_as_documented():
    euler, bdf = (failing(atlas.contact_step, of) for of in ("Euler", "BDF2"))
    assert (min(euler), max(euler)) == pytest.approx((0.001, 0.003), abs=5e-4)
    assert (min(bdf), max(bdf)) == pytest.approx((0.07, 0.26), abs=0.005)


def test_limits_of_the_published_models_of_a_bush_are_as_documented():
    fluxes = curves(atlas.bush_flux).values()
    assert all(curve.abscissa.max() == 0.3 for curve in fluxes)
    assert max(curve.ordinate.max() for curve in fluxes) == pytest.approx(0.03, abs=0.005)
    loads = failing(atlas.bush_published, "steps")
    assert all(1.01 <= load <= 1.02 for load in loads)


@pytest.mark.long
def test_a_film_as_cold_as_its_supply_fails_where_the_oil_thins():
    # docs/charts.md
    cold, balance, bush = curves(atlas.heat_rise).values()
    assert atlas.failure(*cold, FAILED) == pytest.approx(0.19, abs=0.01)
    assert atlas.failure(*balance, FAILED) is None
    assert atlas.failure(*bush, FAILED) == pytest.approx(8.3, abs=0.5)
    assert np.all(cold.ordinate > 2.0 * balance.ordinate)
    slope = np.diff(np.log(bush.ordinate[:2])) / np.diff(np.log(bush.abscissa[:2]))
    assert 0.7 < slope[0] < 1.1  # to first order what oil thins across the film grows with its thinning


@pytest.mark.closed_form
def test_cases_of_heat_have_their_numbers():
    case = atlas.heat_case(2.0, 50.0)
    at = equilibrium(case.bearing.at_temperature(atlas.SUPPLY), case.load, case.speed)
    oil, capacity = case.bearing.oil, float(case.bearing.oil.volumetric_heat(atlas.SUPPLY))
    rise = at.losses.power_loss / (capacity * at.losses.side_flow)
    assert float(oil.thinning(atlas.SUPPLY)) * rise == pytest.approx(2.0)
    assert case.speed * 75e-6**2 * capacity / oil.conductivity == pytest.approx(50.0)


@pytest.mark.long
def test_atlas_names_the_abscissa_of_every_curve():
    found = limits_atlas(["damper"])
    columns = found.columns()
    assert len({len(column) for column in columns.values()}) == 1
    assert set(columns["physics"]) == {"damper"}
    assert {panel.x_label for panel in failures(found)} == set(columns["abscissa"])
    assert all(np.isfinite(columns["error or limit"]))
    assert set(atlas.PHYSICS) == {"journal", "supply", "heat", "rotor", "damper", "contact", "bush"}


def test_unknown_physics_are_named():
    known = "journal, supply, heat, rotor, damper, contact, bush"
    with pytest.raises(InputError, match=f"physics must be among {known}"):
        limits_atlas(["journals"])
    with pytest.raises(InputError, match="physics must name one of"):
        limits_atlas([])
