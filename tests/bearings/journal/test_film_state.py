"""Bearings with pads, grooves and supply, and what a two-dimensional film says about them in SI."""

import dataclasses

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, RegularGridInterpolator

from rotorfilm import FilmContactError, FullFilm, Groove, InputError, Pad
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    JournalBearing,
    ReynoldsFilm,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
    film_state,
)

R, c, mu, omega = 0.05, 1e-4, 0.03, 150.0
FILM = ReynoldsFilm(cells=(128, 12))
FINE = ReynoldsFilm(cells=(256, 24))


def bearing(slenderness, **geometry):
    return JournalBearing(
        radius=R, length=2.0 * R * slenderness, clearance=c, viscosity=mu, film=FILM, **geometry
    )


def sommerfeld_load(b, S):
    """Return the load W of S = mu N L D (R/c)^2 / W, N = omega/(2 pi)."""
    return mu * omega / (2.0 * np.pi) * b.length * 2.0 * R * (R / c) ** 2 / S


# eps, S, attitude [deg] at L/D = 1, and how well each is met: S to two units of the last printed digit, but
# at .4, where print and film are 1.3 % and .5 deg apart. Their accuracy is 1-3 %.
RAIMONDI_BOYD = [
    (0.2, 0.631, 74.02, 0.002, 0.2),
    (0.4, 0.264, 63.10, 0.004, 0.6),
    (0.6, 0.121, 50.58, 0.002, 0.2),
    (0.8, 0.0446, 36.24, 0.0002, 0.2),
]


@pytest.mark.literature
@pytest.mark.parametrize("row", RAIMONDI_BOYD, ids=lambda row: f"eps {row[0]}")
def test_raimondi_and_boyd_full_bearing(row):
    # Raimondi & Boyd (1958), full bearing: film begins, p = 0, at the maximum film.
    eps, S, attitude, S_within, attitude_within = row
    b = dataclasses.replace(bearing(1.0, grooves=(Groove(center=np.pi),)), film=FINE)
    state = film_state(b, [eps * c, 0.0], [0.0, 0.0], omega)
    W = np.hypot(*state.force)
    assert sommerfeld_load(b, 1.0) / W == pytest.approx(S, abs=S_within)
    assert np.degrees(np.arctan2(state.force[1], -state.force[0])) == pytest.approx(
        attitude, abs=attitude_within
    )


@pytest.mark.literature
def test_lund_and_thomsen_two_grooves():
    # Lund & Thomsen (1978), L/D 0.5, grooves of 20 deg at 90 deg from the load line; x along the load.
    # K c/W and C c omega/W, printed to three digits for S printed to two: .58 +- .005 is +-.002 in the
    # eccentricity ratio, +-.12 deg, +-.015 in K and +-.02 in C. The rest is their accuracy.
    grooves = tuple(Groove(center=s * np.pi / 2, width=np.radians(20.0)) for s in (1, -1))
    b = dataclasses.replace(bearing(0.5, grooves=grooves), film=FINE)
    W = sommerfeld_load(b, 0.58)
    point = equilibrium(b, [W, 0.0], omega)
    assert point.eccentricity_ratio == pytest.approx(0.477, abs=0.002)
    assert np.degrees(point.attitude_angle) == pytest.approx(51.01, abs=0.12)
    K = coefficients(b, point.position, omega).stiffness * c / W
    C = coefficients(b, point.position, omega).damping * c * omega / W
    np.testing.assert_allclose(K, [[2.67, 3.70], [-0.78, 1.75]], atol=0.03)
    np.testing.assert_allclose(C, [[6.96, 1.94], [1.94, 2.40]], atol=0.07)


@pytest.mark.parametrize(
    "geometry",
    [
        {},
        {"grooves": (Groove(center=1.0, width=0.3),), "supply_pressure": 2e5},
        {"pads": (Pad(start=0.3, extent=2.0), Pad(start=3.0, extent=2.5))},
    ],
    ids=["plain", "groove", "pads"],
)
@pytest.mark.parametrize("speed", [omega, -omega])
def test_jacobian_equals_scaled_differences(geometry, speed):
    b = bearing(0.6, **geometry)
    z = np.array([0.4 * c, -0.3 * c, 20.0 * c, -30.0 * c, speed])
    jacobian = b.jacobian(z[:2], z[2:4], z[4])
    for column, signal in enumerate(b.inputs):
        d = np.zeros(5)
        d[column] = 1e-6 * signal.nominal
        plus, minus = (b.force((z + s)[:2], (z + s)[2:4], (z + s)[4]) for s in (d, -d))
        difference = (plus - minus) / (2.0 * d[column])
        # By the place the derivatives hold the lines of the grid, which the differences move.
        error = 1e-2 if column < 2 else 1e-6
        np.testing.assert_allclose(jacobian[:, column], difference, atol=error * np.abs(difference).max())


def test_mirrored_bearing_turns_the_other_way():
    grooves = (Groove(center=1.0, width=0.3), Groove(center=-2.5, width=0.1))
    mirrored = tuple(dataclasses.replace(g, center=-g.center) for g in grooves)
    supply = {"supply_pressure": 1e5}
    force = bearing(0.5, grooves=grooves, **supply).force([0.3 * c, 0.4 * c], [c, -c], omega)
    other = bearing(0.5, grooves=mirrored, **supply).force([0.3 * c, -0.4 * c], [c, c], -omega)
    np.testing.assert_allclose(other, force * [1.0, -1.0], rtol=1e-9)
    # The grooves stay where they are when the rotation is reversed.
    assert not np.allclose(bearing(0.5, grooves=grooves).force([0.3 * c, -0.4 * c], [c, c], -omega), other)


def test_state_is_consistent_with_the_force_of_the_bearing():
    b = bearing(0.7, grooves=(Groove(center=1.0, width=0.3),), supply_pressure=2e5)
    q, v = np.array([0.3 * c, -0.5 * c]), np.array([10 * c, 20 * c])
    state = film_state(b, q, v, omega)
    np.testing.assert_allclose(state.force, b.force(q, v, omega), rtol=1e-10)
    finer = dataclasses.replace(b, film=ReynoldsFilm(cells=(256, 24)))
    error = np.hypot(*(state.force - film_state(finer, q, v, omega).force_extrapolated))
    assert error == pytest.approx(state.force_error, rel=0.6)
    assert state.pressure.shape == (state.angle.size, state.axial.size)
    assert state.axial[-1] == pytest.approx(0.5 * b.length)
    assert state.maximum_pressure > 2e5
    assert np.isclose(state.pressure[:, 0], 2e5).any()
    assert state.thickness.min() == pytest.approx(state.minimum_film, rel=0.02)


@pytest.mark.closed_form
def test_friction_of_a_centered_journal_is_petroff():
    state = film_state(bearing(0.5), [0.0, 0.0], [0.0, 0.0], -omega)
    petroff = 2.0 * np.pi * mu * omega * R**3 * R / c
    assert state.friction_torque == pytest.approx(-petroff, rel=1e-3)
    assert state.power_loss == pytest.approx(petroff * omega, rel=1e-3)
    assert state.side_flow == 0.0


@pytest.mark.closed_form
@pytest.mark.parametrize("v", [[0.0, 0.0], [50.0 * c, -20.0 * c]])
def test_power_is_what_the_full_film_dissipates(v):
    # Couette shear mu U^2/h and pressure flow h^3/(12 mu) |grad p|^2 over the film, b = 2 h_z on both sides.
    b = dataclasses.replace(bearing(0.8), film=ReynoldsFilm(cells=(256, 32), cavitation=FullFilm()))
    state = film_state(b, [0.5 * c, 0.0], v, omega)
    theta, h, p, z = state.angle, state.thickness, state.pressure, state.axial
    step = (np.roll(theta, -1) - theta) % (2.0 * np.pi)
    film = 0.5 * (h + np.roll(h, -1))
    around = np.diff(p, axis=0, append=p[:1]) / (R * step[:, None])
    square_z = 0.5 * (around[:, 1:] ** 2 + around[:, :-1] ** 2) @ np.diff(z)
    cell = 0.5 * (step + np.roll(step, 1))
    along = (np.diff(p, axis=1) ** 2 / np.diff(z)).sum(axis=1)
    pressure_part = 2.0 * R / (12.0 * mu) * (film**3 * step @ square_z + h**3 * cell @ along)
    couette = mu * (R * omega) ** 2 * R * b.length * np.sum(step / film)
    assert state.power_loss == pytest.approx(couette + pressure_part, rel=2e-3)


@pytest.mark.parametrize("film", [ShortFilm(), SplittingFilm(order=(2, 1))])
@pytest.mark.parametrize(
    "geometry", [{"grooves": (Groove(center=0.0),)}, {"pads": (Pad(start=0.0, extent=2.0),)}]
)
def test_film_that_cannot_represent_the_geometry_is_refused(film, geometry):
    with pytest.raises(
        InputError,
        match=rf"film .*geometry, got {type(film).__name__}, which cannot represent (axial grooves|pads);",
    ):
        dataclasses.replace(bearing(0.5), film=film, **geometry)


def test_any_film_takes_a_pad_of_a_full_turn():
    full = dataclasses.replace(bearing(0.5), film=ShortFilm(), pads=(Pad(start=1.0, extent=2.0 * np.pi),))
    q = [0.3 * c, 0.2 * c]
    plain = dataclasses.replace(bearing(0.5), film=ShortFilm())
    np.testing.assert_array_equal(full.force(q, [0, 0], omega), plain.force(q, [0, 0], omega))


@pytest.mark.parametrize(
    ("geometry", "message"),
    [
        ({"grooves": [Groove(center=0.0)]}, "grooves must be a tuple of Groove"),
        ({"pads": (1.0,)}, "pads must be a tuple of Pad"),
        ({"supply_pressure": -1.0}, "supply_pressure must be finite and not negative, got -1.0"),
        ({"supply_pressure": 1e5}, "supply_pressure must be 0 without grooves"),
    ],
)
def test_bad_geometry_is_refused(geometry, message):
    with pytest.raises(InputError, match=message):
        bearing(0.5, **geometry)


def test_state_of_a_film_without_a_field_has_force_and_losses_only():
    b = dataclasses.replace(bearing(0.5), film=ShortFilm())
    state = film_state(b, [0.3 * c, 0.1 * c], [0, 0], omega)
    np.testing.assert_array_equal(state.force, b.force([0.3 * c, 0.1 * c], [0, 0], omega))
    assert state.side_flow == pytest.approx(np.sqrt(0.1) * omega * c * R * b.length)
    assert state.pressure is None
    assert state.maximum_pressure is None


def test_state_needs_a_film_with_losses_or_a_field():
    with pytest.raises(InputError, match=r"film must be a law with losses.*got SpectralArcFilm"):
        film_state(dataclasses.replace(bearing(0.5), film=SpectralArcFilm()), [0, 0], [0, 0], omega)


@pytest.mark.closed_form
@pytest.mark.parametrize("order", [(1, 1), (2, 1), (2, 3), (4, None)])
@pytest.mark.parametrize("v", [(0.0, 0.0), (2e-3, -5e-3)])
def test_the_pressure_of_a_splitting_film_makes_its_force(order, v):
    b = dataclasses.replace(bearing(0.5), film=SplittingFilm(order=order))
    state = film_state(b, [0.3 * c, -0.4 * c], v, omega)
    # Nodes of an arc may pass 2 pi on their way.
    angle = np.unwrap(state.angle)
    axial = CubicSpline(state.axial, state.pressure, axis=1).integrate(0.0, 0.5 * b.length)
    ends = np.array([angle[0] - (angle[1] - angle[0]) / 2.0, angle[-1] + (angle[-1] - angle[-2]) / 2.0])
    assert np.ptp(ends) == pytest.approx(np.pi, abs=0.01)
    normal = np.stack([np.cos(angle), np.sin(angle)])
    force = -2.0 * R * CubicSpline(angle, axial * normal, axis=1).integrate(*ends)
    np.testing.assert_allclose(force, state.force, rtol=2e-3, atol=2e-3 * np.hypot(*state.force))
    np.testing.assert_allclose(state.pressure[:, -1], 0.0, atol=1e-12 * state.maximum_pressure)
    expected = c - c * (0.3 * np.cos(angle) - 0.4 * np.sin(angle))
    np.testing.assert_allclose(state.thickness, expected)
    with pytest.raises(InputError, match="film must be a law with losses"):
        _ = state.power_loss
    assert "maximum pressure" in str(state)
    assert state.plot().get_ylabel() == "axial position [mm]"


@pytest.mark.literature
def test_a_rich_splitting_film_has_the_pressure_of_reynolds_equation():
    # On the arc that complementarity finds.
    rich = SplittingFilm(order=(12, None), constant=True, rupture=ComplementarityArc())
    at = [0.5 * c, 0.1 * c], [0.0, 0.0], omega
    found = film_state(dataclasses.replace(bearing(0.5), film=rich), *at)
    grid = film_state(dataclasses.replace(bearing(0.5), film=ReynoldsFilm(cells=(192, 16))), *at)
    order = np.argsort(grid.angle)
    lines = grid.angle[order], grid.axial
    there = RegularGridInterpolator(lines, grid.pressure[order], bounds_error=False, fill_value=None)
    places = np.stack(np.meshgrid(found.angle, found.axial, indexing="ij"), -1)
    np.testing.assert_allclose(found.pressure, there(places), atol=0.02 * grid.maximum_pressure)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (([2 * c, 0.0], [0.0, 0.0], 1.0), FilmContactError, "inside the clearance"),
        (([0.0, 0.0, 0.0], [0.0, 0.0], 1.0), InputError, r"position must have shape \(2,\)"),
        (([0.0, 0.0], [0.0, np.nan], 1.0), InputError, "velocity must be finite"),
        (([0.0, 0.0], [0.0, 0.0], [1.0, 2.0]), InputError, "speed must be a single number"),
    ],
)
def test_bad_state_is_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        film_state(bearing(0.5), *arguments)
