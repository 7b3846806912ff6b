"""Losses of the film that conserves its oil, its temperature, and how much Reynolds rupture is off."""

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FeedHole,
    Groove,
    InputError,
    JFOFilm,
    JournalBearing,
    Oil,
    Pad,
    ReynoldsFilm,
    equilibrium,
)
from rotorfilm.bearings import rupture_error

R, c, mu, omega = 0.05, 1e-4, 0.02, 314.0
BAR = 0.0053 * omega * 12.0 * mu * (R / c) ** 2
REST = np.zeros(2)
TOP = {"center": np.pi / 2, "width": np.radians(20.0)}
OPENINGS = {
    "groove": {"grooves": (Groove(**TOP, length=0.04),), "supply_pressure": 2e5},
    "hole": {"grooves": (FeedHole(center=1.0, diameter=0.012),), "supply_pressure": 1e5},
    "open groove": {"grooves": (Groove(**TOP),)},
    "all round": {"circumferential_groove": 0.005, "supply_pressure": 1e5},
    "gap between pads": {"pads": (Pad(start=3.5, extent=2.5),)},
}


def bearing(**given):
    return JournalBearing(
        **{"radius": R, "length": 0.05, "clearance": c, "viscosity": mu, "film": ReynoldsFilm(), **given}
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [omega, -omega])
@pytest.mark.parametrize("openings", OPENINGS.values(), ids=OPENINGS)
def test_flows_and_moments_balance(openings, speed):
    film, position = JFOFilm(bearing=bearing(**openings), cells=(72, 8), submerged=True), [2e-5, -5e-5]
    found, state = film.losses(position, REST, speed), film.solve(position, speed)
    np.testing.assert_allclose(
        found.inflow - found.arriving, state.inflow, rtol=0.0, atol=1e-12 * state.side_flow
    )
    net = (found.inflow - found.arriving).sum()
    assert net + state.drawn_in == pytest.approx(found.side_flow, rel=1e-9)
    assert (found.inflow > 0.0).all()
    assert (found.arriving > 0.0).all()
    moment = position[0] * state.force[1] - position[1] * state.force[0]
    assert found.friction_torque - found.bush_torque == pytest.approx(moment, rel=1e-12)
    supplied = film.bearing.supply_pressure * net
    assert found.power_loss == pytest.approx(found.friction_torque * speed + supplied, rel=1e-9)


@pytest.mark.parametrize("openings", ["open groove", "gap between pads"])
def test_oil_that_arrives_is_that_of_reynolds_rupture(openings):
    # The film before an opening at ambient pressure ends there by either rupture; other cells, other code.
    own = bearing(**OPENINGS[openings], film=ReynoldsFilm(cells=(192, 16)))
    film = JFOFilm(bearing=own, cells=(144, 12))
    found, other = (one.losses([2e-5, -5e-5], REST, omega) for one in (film, own))
    np.testing.assert_allclose(found.arriving, other.arriving, rtol=3e-3)


@pytest.mark.convergence
def test_torque_counts_the_film_up_to_the_edges_of_openings():
    # Without the half cells beside the groove it is 1.1 % less on the coarse cells.
    fed = bearing(**OPENINGS["groove"])
    coarse, fine = (
        JFOFilm(bearing=fed, cells=cells).losses([2e-5, -5e-5], REST, omega).friction_torque
        for cells in ((72, 6), (288, 24))
    )
    assert coarse == pytest.approx(fine, rel=3e-3)


@pytest.mark.closed_form
def test_heat_balances_with_the_oil_that_really_flows():
    cooling = Cooling(supply_temperature=318.0, carry_over=0.7)
    warm = bearing(viscosity=None, oil=Oil.iso_vg(46), cooling=cooling, **OPENINGS["groove"])
    film = JFOFilm(bearing=warm, cells=(24, 4))
    with pytest.raises(InputError, match="temperature must be stated"):
        film.force([2e-5, -5e-5], REST, omega)
    at = equilibrium(film, [0.0, -3000.0], omega)
    found = film.at_temperature(at.temperature).losses(at.position, REST, omega)
    Q1, Q2 = found.inflow[0], found.arriving[0]
    effective = found.side_flow + 2.0 * (1.0 - 0.7) * Q2 / (1.0 + 0.7 * Q2 / Q1)
    carried = Oil.iso_vg(46).volumetric_heat(318.0) * effective * (at.temperature - 318.0)
    assert carried == pytest.approx(found.power_loss, rel=1e-6)
    assert at.losses.side_flow == pytest.approx(found.side_flow, rel=1e-9)


CASES = [
    (0.5, 0.0, (0.0, np.pi), 0.498, 48.9, 0.015),
    (0.5, 2.0, (0.0, np.pi), 0.487, 53.0, 0.040),
    (1.0, 2.0, (0.0, np.pi), 0.154, 67.3, 0.064),
    (0.5, 0.0, (np.pi / 2,), 0.599, 47.2, 0.021),
    (0.5, 10.0, (0.0, np.pi), 0.445, 59.3, 0.098),
]
"""L/D, supply [bar], grooves, eccentricity ratio, attitude [deg], error of Reynolds' force by fine grids."""


@pytest.mark.literature
@pytest.mark.parametrize(("slenderness", "bars", "centers", "eps", "attitude", "error"), CASES)
def test_error_of_rupture_is_within_a_factor_of_two(slenderness, bars, centers, eps, attitude, error):
    # Errors of an independent program on 144 x 10 cells.
    length = 2.0 * slenderness * R
    grooves = tuple(Groove(center=at, width=np.radians(20.0), length=0.8 * length) for at in centers)
    fed = bearing(length=length, grooves=grooves, supply_pressure=bars * BAR)
    angle = np.radians(270.0 + attitude)
    found = rupture_error(fed, eps * c * np.array([np.cos(angle), np.sin(angle)]), omega)
    assert 0.5 * error < found.force_error < 2.0 * error
    assert 0.05 < found.side_flow_error < 0.6
    assert 0.0 < found.torque_error < 0.1


@pytest.mark.closed_form
def test_rupture_is_exact_behind_a_line_groove_at_the_widest_gap():
    line = bearing(grooves=(Groove(center=np.pi),))
    found = rupture_error(line, [0.5 * c, 0.0], omega)
    assert abs(found.force_error) < 3e-3
    assert abs(found.side_flow_error) < 5e-3


def test_error_of_rupture_needs_a_supply_and_a_speed():
    with pytest.raises(InputError, match="must have an oil supply"):
        rupture_error(bearing(), [2e-5, 0.0], omega)
    with pytest.raises(InputError, match="speed must not be zero"):
        rupture_error(bearing(**OPENINGS["groove"]), [2e-5, 0.0], 0.0)
