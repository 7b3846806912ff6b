"""Lobed bearings with the temperature of their films a field: limits, identities, and heat that closes."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FilmContactError,
    HeatedFilm,
    InputError,
    JFOFilm,
    JournalBearing,
    Lobe,
    LobedBearing,
    Oil,
    Pad,
    equilibrium,
    heated_equilibrium,
    lobe_set,
)
from rotorfilm.bearings import AdiabaticWalls, BushRing, LayeredTemperature, MeanTemperature, PadGridFilm

DEGREE = np.pi / 180.0
R, c, T_S, OMEGA = 0.05, 1e-4, 318.15, 314.159
LOAD, POSITION = [0.0, -5000.0], np.array([12e-6, -21e-6])
SIZE = {"radius": R, "length": 0.05}
WARM = {**SIZE, "oil": Oil.iso_vg(46), "cooling": Cooling(supply_temperature=T_S)}
PROFILES = {"mean": MeanTemperature(), "layers": LayeredTemperature(6)}
WALLS = {"adiabatic": AdiabaticWalls(), "ring": BushRing(outer_radius=2.0 * R)}
MEETING = tuple(Lobe(start=0.3 + k * 120.0 * DEGREE, extent=120.0 * DEGREE, preload=0.3) for k in range(3))
LOBES = {
    "three": lobe_set("three_lobe", preload=0.5),
    "offset": lobe_set("offset_halves", preload=0.4),
    "meeting": MEETING,
}


def lobed(lobes, **given):
    return LobedBearing(pad_clearance=c, lobes=lobes, **{**WARM, **given})


def isothermal(lobes):
    return lobed(lobes, oil=Oil.constant(0.02))


def mirrored(lobes):
    return tuple(
        dataclasses.replace(lobe, start=-lobe.start - lobe.extent, offset=1.0 - lobe.offset) for lobe in lobes
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_lobes_without_preload_are_the_pads_of_a_journal_bearing(profile):
    starts = [k * DEGREE for k in (10.0, 190.0)]
    pads = tuple(Pad(start=start, extent=160.0 * DEGREE) for start in starts)
    lobes = tuple(Lobe(start=start, extent=160.0 * DEGREE) for start in starts)
    bearings = JournalBearing(clearance=c, pads=pads, **WARM), lobed(lobes)
    one, other = (
        heated_equilibrium(
            HeatedFilm(bearing=bearing, walls=WALLS["ring"], profile=PROFILES[profile]), LOAD, OMEGA
        ).state
        for bearing in bearings
    )
    np.testing.assert_allclose(other.position, one.position, atol=2e-4 * c)
    assert other.power_loss == pytest.approx(one.power_loss, rel=1e-3)
    assert other.side_flow == pytest.approx(one.side_flow, rel=1e-3)
    assert other.maximum_temperature == pytest.approx(one.maximum_temperature, abs=0.05)


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("walls", WALLS)
@pytest.mark.parametrize("lobes", LOBES)
def test_every_watt_is_accounted_for(profile, walls, lobes):
    film = HeatedFilm(
        bearing=lobed(LOBES[lobes]), walls=WALLS[walls], profile=PROFILES[profile], cells=(48, 4)
    )
    heat = film.solve(POSITION, OMEGA).heat
    assert heat.leaked > 0.1 * heat.made
    assert abs(heat.missing) < 1e-11 * heat.made


@pytest.mark.closed_form
@pytest.mark.parametrize("lobes", LOBES)
def test_power_is_that_of_the_torque(lobes):
    """M = M_s + sum(E_k x F_k)/2, E_k from the center of curvature of a lobe, F_k of its film."""
    bearing = lobed(LOBES[lobes])
    state = HeatedFilm(bearing=bearing, cells=(48, 4)).solve(POSITION, OMEGA)
    cells = state.film.cells
    sheared = (state.filled * cells.width / state.film.fluidity.pressed).sum(axis=1)
    M = bearing.film_viscosity * OMEGA * R**3 * bearing.length / c
    M *= float(sheared @ cells.integral_of_inverse(POSITION / c)[:, 0])
    line_forces = -bearing.force_scale * 12.0 * cells.normal()
    line_forces *= (state.pressure / bearing.pressure_scale) @ cells.width
    E = POSITION[:, None] - c * cells.center
    M += 0.5 * float((E[0] * line_forces[1] - E[1] * line_forces[0]).sum())
    np.testing.assert_allclose(line_forces.sum(axis=1), state.force, rtol=1e-12)
    assert state.friction_torque == pytest.approx(M, rel=1e-11)


@pytest.mark.convergence
def test_film_of_one_viscosity_is_that_of_pads_on_grids():
    bearing = isothermal(LOBES["three"])
    grids = LobedBearing(
        pad_clearance=c, lobes=bearing.lobes, viscosity=0.02, film=PadGridFilm(cells=(96, 16)), **SIZE
    )
    force = grids.force(POSITION, np.zeros(2), OMEGA)
    errors = []
    for cells in ((80, 8), (160, 16)):
        film = HeatedFilm(bearing=bearing, cells=cells).frozen(POSITION, OMEGA, T_S)
        film = dataclasses.replace(film, empty=np.zeros_like(film.empty))
        errors.append(np.hypot(*(film.force(POSITION, np.zeros(2), OMEGA) - force)) / np.hypot(*force))
    assert errors[0] < 0.012
    assert errors[1] < 0.35 * errors[0]


@pytest.mark.closed_form
@pytest.mark.parametrize("lobes", LOBES)
def test_derivatives_at_frozen_temperature_are_exact(lobes):
    film = HeatedFilm(bearing=lobed(LOBES[lobes]), cells=(48, 4)).solve(POSITION, OMEGA).film
    state = np.array([*POSITION, 1e-3, -2e-3, OMEGA])
    jacobian = film.jacobian(state[:2], state[2:4], state[4])
    for column, scale in enumerate([c, c, 1e-2, 1e-2, OMEGA]):
        step = np.zeros(5)
        step[column] = 1e-6 * scale
        ahead, behind = (film.force(u[:2], u[2:4], u[4]) for u in (state + step, state - step))
        difference = (ahead - behind) / (2.0 * step[column])
        np.testing.assert_allclose(
            jacobian[:, column], difference, rtol=1e-6, atol=1e-8 * abs(jacobian).max()
        )


@pytest.mark.closed_form
@pytest.mark.parametrize("lobes", LOBES)
def test_mirrored_rotation(lobes):
    mirror = np.array([1.0, -1.0])
    films = (HeatedFilm(bearing=lobed(each)) for each in (LOBES[lobes], mirrored(LOBES[lobes])))
    forward, backward = (
        film.solve(at, speed)
        for film, at, speed in zip(films, (POSITION, mirror * POSITION), (OMEGA, -OMEGA), strict=True)
    )
    np.testing.assert_allclose(backward.force, mirror * forward.force, rtol=1e-8)
    assert backward.power_loss == pytest.approx(forward.power_loss, rel=1e-8)
    assert backward.maximum_temperature == pytest.approx(forward.maximum_temperature, rel=1e-9)


@pytest.mark.parametrize("name", ["elliptical", "three_lobe", "four_lobe"])
def test_one_temperature_is_as_far_off_as_in_journal_bearings(name):
    """Power of T1 is too high, by up to a seventh without a bush, and the place about right."""
    bearing = lobed(lobe_set(name, preload=0.5), film=PadGridFilm(cells=(32, 8)))
    cheap = equilibrium(bearing, LOAD, OMEGA)
    T = bearing.balanced_temperature(cheap.position, np.zeros(2), OMEGA)
    losses = bearing.at_temperature(T).losses(cheap.position, np.zeros(2), OMEGA)
    found = heated_equilibrium(HeatedFilm(bearing=bearing), LOAD, OMEGA)
    assert found.rest.residual < 1e-9
    np.testing.assert_allclose(found.rest.position, cheap.position, atol=0.05 * c)
    assert 0.86 < found.state.power_loss / losses.power_loss < 1.0
    assert found.state.side_flow == pytest.approx(losses.side_flow, rel=0.06)
    assert found.state.maximum_temperature > T


def test_what_breaks_a_rule_is_named():
    film = HeatedFilm(bearing=lobed(LOBES["three"]))
    with pytest.raises(FilmContactError, match=r"film on every pad, got .* on lobe 2, Lobe\("):
        film.solve([0.0, -0.7 * c], OMEGA)
    with pytest.raises(FilmContactError, match="film on every pad"):
        film.cold().force([0.0, -0.7 * c], [0.0, 0.0], OMEGA)
    assert film.cold().minimum_film(np.zeros(2)) == pytest.approx(0.5 * c)
    with pytest.raises(InputError, match="bearing must be a JournalBearing or a bearing of pads, with oil"):
        HeatedFilm(
            bearing=JFOFilm(bearing=JournalBearing(clearance=c, pads=(Pad(start=0.0, extent=3.0),), **WARM))
        )
