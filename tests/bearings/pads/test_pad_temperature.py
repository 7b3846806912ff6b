"""Pressure dams and tilting pads with the temperature of their films a field: limits, balances, order."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    FilmContactError,
    HeatedFilm,
    InputError,
    Lobe,
    LobedBearing,
    Oil,
    PressureDamBearing,
    TiltingPadBearing,
    equilibrium,
    even_pivots,
    heated_equilibrium,
    pressure_dam_pads,
)
from rotorfilm.analysis import coefficients
from rotorfilm.bearings import (
    AdiabaticWalls,
    BushRing,
    HeldWalls,
    LayeredTemperature,
    MeanTemperature,
    PadGridFilm,
)
from rotorfilm.bearings.pads.pressure_dam import pad_places

DEGREE = np.pi / 180.0
R, c, T_S, OMEGA = 0.05, 1e-4, 318.15, 314.159
LOAD, POSITION, STILL = [0.0, -4000.0], np.array([9e-6, -21e-6]), np.zeros(2)
SIZE = {"radius": R, "length": 0.05, "pad_clearance": c}
WARM = {**SIZE, "oil": Oil.iso_vg(46), "cooling": Cooling(supply_temperature=T_S)}
PROFILES = {"mean": MeanTemperature(), "layers": LayeredTemperature(6)}
WALLS = {
    "adiabatic": AdiabaticWalls(),
    "held": HeldWalls(bush_temperature=325.0, journal_temperature=330.0),
}


def dam(depth="150 um", share=0.75, track="80 um", track_share=0.25, **given):
    pads = pressure_dam_pads(
        depth=depth, end="135 deg", share=share, track_depth=track, track_share=track_share
    )
    return PressureDamBearing(pads=pads, **{**WARM, **given})


def tilting(**given):
    shape = {"pivots": even_pivots(4, between_pads=True), "extent": 70.0 * DEGREE, "preload": 0.4}
    return TiltingPadBearing(**{**shape, **WARM, **given})


BEARINGS = {
    "dam": dam(),
    "pads": tilting(),
    "light": tilting(pivots=even_pivots(5), extent=60.0 * DEGREE, preload=0.2, pivot_offset=0.6),
    "springs": tilting(pivot_stiffness=2e8),
}


def uniform(bearing):
    return dataclasses.replace(bearing, oil=Oil.constant(0.02))


def free(film):
    """Return a film that may start anywhere."""
    return dataclasses.replace(film, empty=np.zeros_like(film.empty))


def differences(film, states):
    """Return central differences of the force by x, y and speed."""
    steps = np.diag([1e-6 * c, 1e-6 * c, 1e-6 * OMEGA])
    ahead, behind = (
        np.stack([film.force((states + way * h)[:2], STILL, (states + way * h)[2]) for h in steps], axis=1)
        for way in (1.0, -1.0)
    )
    return (ahead - behind) / (2.0 * np.diag(steps))


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("walls", WALLS)
@pytest.mark.parametrize("name", BEARINGS)
def test_every_watt_is_accounted_for(name, walls, profile):
    film = HeatedFilm(bearing=BEARINGS[name], walls=WALLS[walls], profile=PROFILES[profile], cells=(48, 4))
    heat = film.solve(POSITION, OMEGA).heat
    assert heat.leaked > 0.1 * heat.made
    assert abs(heat.missing) < 1e-11 * heat.made


@pytest.mark.closed_form
@pytest.mark.parametrize("name", BEARINGS)
def test_derivatives_at_frozen_temperature_are_exact(name):
    film = HeatedFilm(bearing=BEARINGS[name], cells=(48, 4)).solve(POSITION, OMEGA).film
    slopes = film.jacobian(POSITION, STILL, OMEGA)[:, [0, 1, 4]]
    expected = differences(film, np.array([*POSITION, OMEGA]))
    np.testing.assert_allclose(slopes, expected, rtol=2e-6, atol=1e-7 * abs(slopes[:, :2]).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("name", BEARINGS)
def test_mirrored_rotation(name):
    mirror, bearing = np.array([1.0, -1.0]), BEARINGS[name]
    if name == "dam":
        edges = [(pad, pad.recess) for pad in bearing.pads]
        pads = tuple(
            dataclasses.replace(
                pad,
                start=-pad.end,
                offset=1.0 - pad.offset,
                recess=dataclasses.replace(sunk, start=-pad.edges[2], end=-pad.edges[1]),
            )
            for pad, sunk in edges
        )
        other = dataclasses.replace(bearing, pads=pads)
    else:
        pivots, offset = tuple(-angle for angle in bearing.pivots), 1.0 - bearing.pivot_offset
        other = dataclasses.replace(bearing, pivots=pivots, pivot_offset=offset)
    forward = HeatedFilm(bearing=bearing).solve(POSITION, OMEGA)
    backward = HeatedFilm(bearing=other).solve(mirror * POSITION, -OMEGA)
    np.testing.assert_allclose(backward.force, mirror * forward.force, rtol=1e-8)
    assert backward.power_loss == pytest.approx(forward.power_loss, rel=1e-8)
    assert backward.maximum_temperature == pytest.approx(forward.maximum_temperature, rel=1e-9)


@pytest.mark.convergence
@pytest.mark.parametrize("name", [pytest.param("dam", marks=pytest.mark.long), "pads"])
def test_order_of_the_cells(name):
    places = c * np.array([[0.1, -0.2], [0.15, -0.1]])

    def answers(n):
        film = HeatedFilm(bearing=BEARINGS[name], cells=(32 * n, 4 * n))
        found = [film.solve(place, OMEGA) for place in places]
        return np.array(
            [[np.hypot(*one.force), one.power_loss, one.maximum_temperature - T_S] for one in found]
        )

    exact = answers(4)
    coarse, fine = (np.sqrt(np.mean((answers(n) / exact - 1.0) ** 2, axis=0)) for n in (1, 2))
    assert (fine < 0.5**HeatedFilm.order * coarse).all()
    assert fine.max() < 0.03


# Pressure dams.


@pytest.mark.closed_form
@pytest.mark.parametrize("profile", PROFILES)
def test_a_dam_without_depth_is_the_lobe(profile):
    bearing = dam(0.0, track=0.0)
    lobes = tuple(Lobe(start=pad.start, extent=pad.extent) for pad in bearing.pads)
    one, other = (
        heated_equilibrium(HeatedFilm(bearing=each, profile=PROFILES[profile]), LOAD, OMEGA)
        for each in (bearing, LobedBearing(lobes=lobes, **WARM))
    )
    np.testing.assert_allclose(one.rest.position, other.rest.position, atol=1e-12 * c)
    assert one.state.power_loss == pytest.approx(other.state.power_loss, rel=1e-12)
    np.testing.assert_allclose(one.state.oil_temperature, other.state.oil_temperature, rtol=1e-12)


@pytest.mark.closed_form
def test_film_of_one_viscosity_is_that_of_the_dam_on_its_cells():
    """On the lines and nodes of the bearing itself, without the power of extrapolation."""
    bearing = uniform(dam(extrapolated=False, track_share=0.75))
    film = HeatedFilm(bearing=bearing, cells=(96, 16)).cold()
    lines, depth = [], []
    for pad in bearing.pads:
        theta, axial = pad_places(pad, bearing.cells)
        _, first, last, _ = pad.edges
        within = (axial[:-1] < pad.recess.share - 1e-9)[None, :]
        middle = 0.5 * (theta[1:] + theta[:-1])[:, None]
        sunk = ((middle > first) & (middle < last)) * within * pad.recess.depth / c
        lines.append(theta)
        depth.append(np.vstack([sunk, np.zeros((1, len(axial) - 1))]))
    # Both recesses end at the same share of the length, so that one row of nodes is that of both pads.
    assert {pad.recess.share for pad in bearing.pads} == {0.75}
    theta, width = np.concatenate(lines), np.diff(0.5 * (axial[1:] + axial[:-1]), prepend=0.0)
    onward = np.append(theta[1:], theta[0] + 2.0 * np.pi)
    ends = np.cumsum([len(one) for one in lines]) - 1
    held, wall = np.zeros(len(theta), dtype=bool), np.ones(len(theta))
    held[[*ends, *(ends - np.array([len(one) for one in lines]) + 1)]] = True
    wall[ends] = 0.0
    face, blank = 0.5 * (theta + onward), np.zeros(len(theta))
    cells = film.cells._replace(
        theta=theta,
        face=face,
        start=blank,
        extent=blank,
        gap=onward - theta,
        width=np.append(width, 1.0 - width.sum()),
        conductance=1.0 / np.diff(axial),
        held=held,
        value=blank,
        opening=blank,
        center=bearing.centers_at(face),
        film=wall,
        depth_ratio=np.concatenate(depth),
    )
    ones = np.ones(cells.shape)
    film = dataclasses.replace(
        film, cells=cells, fluidity=type(film.fluidity)(ones, 0.5 * ones, ones), empty=ones[:, 1:] < 0.0
    )
    state, own = (POSITION, np.array([1e-3, -2e-3]), OMEGA), bearing.at_temperature(T_S)
    np.testing.assert_allclose(film.force(*state), own.force(*state), rtol=1e-11)
    slopes = own.jacobian(*state)
    np.testing.assert_allclose(film.jacobian(*state), slopes, rtol=1e-9, atol=1e-9 * abs(slopes).max())


@pytest.mark.closed_form
def test_power_of_a_dam_is_that_of_the_torque():
    """M = int (viscosity speed R^2/h + h p'/2), with the pressure that rises along the recess and outside."""
    bearing = dam()
    state = HeatedFilm(bearing=bearing, cells=(48, 8)).solve(POSITION, OMEGA)
    film, cells = state.film, state.film.cells
    P, half = state.pressure / bearing.pressure_scale, 0.5 * np.diff(state.axial / (0.5 * bearing.length))
    rise, dragged = np.roll(P, -1, axis=0) - P, 2.0 * film.fluidity.mean_at_faces().dragged
    e = POSITION[:, None] / c - cells.center
    wall = 1.0 - cells.film * (e[0] * np.cos(cells.face) + e[1] * np.sin(cells.face))
    torque = 0.0
    for i in range(len(P)):
        for j in range(P.shape[1]):
            for k, tile in ((j - 1, j - 1), (j, j)):
                if 0 <= k < len(half):
                    H = wall[i] + cells.depth_ratio[i, tile]
                    torque += 6.0 * half[k] * dragged[i, j] * H * rise[i, j]
    shear = OMEGA * state.filled * cells.integral_of_inverse(POSITION / c) * cells.width
    torque += float(np.sum(shear * film.fluidity.sheared))
    assert state.friction_torque == pytest.approx(torque * bearing.force_scale * c, rel=1e-11)


def test_a_step_over_the_whole_length_has_the_power_and_flow_of_its_bearing():
    bearing = uniform(dam(share=1.0, track=0.0, cells=(128, 32)))
    own = bearing.at_temperature(T_S).losses(POSITION, STILL, OMEGA)
    state = HeatedFilm(bearing=bearing, cells=(160, 16)).solve(POSITION, OMEGA)
    assert state.power_loss == pytest.approx(own.power_loss, rel=5e-3)
    assert state.side_flow == pytest.approx(own.side_flow, rel=1e-2)


# Tilting pads.


@pytest.mark.closed_form
@pytest.mark.parametrize("name", ["pads", "light"])
def test_pads_in_their_tilts_are_lobes(name):
    """A lobe with the center of curvature that the tilt gives the pad, on the same lines."""
    bearing = BEARINGS[name]
    one = HeatedFilm(bearing=bearing, cells=(160, 16)).solve(POSITION, OMEGA)
    pads = one.film
    tilts = pads.pad_states(POSITION, OMEGA).tilts / c
    arcs = []
    for at, tilt in zip(bearing.pivots, tilts, strict=True):
        angle, size = float(np.arctan2(tilt, bearing.preload)), float(np.hypot(bearing.preload, tilt))
        offset = bearing.pivot_offset + angle / bearing.extent
        arcs.append(Lobe(start=at - bearing.pivot_offset * bearing.extent, extent=bearing.extent))
        # A lobe is closest on its arc; a pad may be tilted beyond that.
        vars(arcs[-1]).update(preload=size, offset=offset)
    lobes = tuple(arcs)
    lobed = LobedBearing(lobes=lobes, **WARM)
    cells = pads.cells._replace(center=lobed.centers_at(pads.cells.face))
    held = dataclasses.replace(pads.film, bearing=lobed, cells=cells)
    np.testing.assert_allclose(
        pads.force(POSITION, STILL, OMEGA), held.force(POSITION, STILL, OMEGA), rtol=1e-11
    )
    # The whole state, with lines that crowd at other places.
    other = HeatedFilm(bearing=lobed, cells=(160, 16)).solve(POSITION, OMEGA)
    np.testing.assert_allclose(other.force, one.force, atol=0.015 * np.hypot(*one.force))
    assert other.power_loss == pytest.approx(one.power_loss, rel=2e-3)
    assert other.maximum_temperature == pytest.approx(one.maximum_temperature, abs=0.15)


@pytest.mark.convergence
@pytest.mark.parametrize("name", ["pads", "light", "springs"])
def test_pads_of_one_viscosity_are_those_on_grids(name):
    bearing = uniform(BEARINGS[name])
    own = dataclasses.replace(bearing.at_temperature(T_S), film=PadGridFilm(cells=(96, 16)))
    force, reduced = own.at_rest().force(POSITION, STILL, OMEGA), coefficients(own, POSITION, OMEGA)
    errors = []
    for cells in ((80, 8), (160, 16)):
        film = HeatedFilm(bearing=bearing, cells=cells).cold()
        found = coefficients(film, POSITION, OMEGA)
        off = np.hypot(*(film.force(POSITION, STILL, OMEGA) - force)) / np.hypot(*force)
        K, C = (
            np.abs(getattr(found, one) - getattr(reduced, one)).max() / np.abs(getattr(reduced, one)).max()
            for one in ("stiffness", "damping")
        )
        errors.append((off, K, C))
    assert max(errors[0]) < 0.03
    assert errors[1][0] < 0.4 * errors[0][0]
    assert max(errors[1]) < 0.01


@pytest.mark.closed_form
def test_pivots_on_springs_give_way_to_the_film():
    """Each pad is a rigid one under a journal farther off by what its spring gives way."""
    sprung = BEARINGS["springs"]
    film = HeatedFilm(bearing=sprung, cells=(64, 8)).solve(POSITION, OMEGA).film
    pads = film.pad_states(POSITION, OMEGA)
    np.testing.assert_allclose(pads.pad_loads, -sprung.pivot_stiffness * pads.pivot_deflections, rtol=1e-9)
    rigid = dataclasses.replace(film, bearing=dataclasses.replace(sprung, pivot_stiffness=None))
    for k, at in enumerate(sprung.pivots):
        moved = POSITION + pads.pivot_deflections[k] * np.array([np.cos(at), np.sin(at)])
        assert rigid.pad_states(moved, OMEGA).pad_loads[k] == pytest.approx(pads.pad_loads[k], rel=1e-9)


@pytest.mark.long
def test_temperature_that_hardly_rises_is_that_of_the_balance():
    """E = 0.01: T1 and T2 see the same viscosity, and share the power and the flow."""
    for bearing in (dam(share=1.0, track=0.0), tilting(film=PadGridFilm(cells=(96, 8)))):
        slow = 0.003 * OMEGA
        load = [0.0, -0.004 * 4000.0]
        at = equilibrium(bearing, load, slow)
        own = bearing.at_temperature(at.temperature)
        losses = own.losses(at.position, STILL, slow)
        found = heated_equilibrium(HeatedFilm(bearing=bearing, cells=(160, 16)), load, slow)
        assert at.temperature - T_S < 0.5
        np.testing.assert_allclose(found.rest.position, at.position, atol=0.02 * c)
        assert found.state.power_loss == pytest.approx(losses.power_loss, rel=1.5e-2)
        assert found.state.side_flow == pytest.approx(losses.side_flow, rel=3e-2)


@pytest.mark.long
def test_four_pads_without_conduction_have_the_peak_of_another_program():
    """The bearing of Fillon, Bligoud and Frene (1992): 62.5 C at 1000 rpm by 48 x 8 cells on each pad."""
    oil = Oil.thinning_at("27.7 mPa s", 313.15, 0.0341)
    bearing = TiltingPadBearing(
        radius=0.05,
        length=0.07,
        pad_clearance=148e-6,
        preload=0.47,
        pivots=even_pivots(4, between_pads=True),
        extent=75.0 * DEGREE,
        oil=oil,
        cooling=Cooling(supply_temperature=313.15),
    )
    found = heated_equilibrium(
        HeatedFilm(bearing=bearing, cells=(192, 8)), [0.0, -1e4], 1000.0 * np.pi / 30.0
    )
    assert found.state.maximum_temperature - 273.15 == pytest.approx(62.5, abs=0.3)
    np.testing.assert_allclose(
        found.rest.pads.pad_loads[[0, 3]], found.rest.pads.pad_loads[[0, 3]].mean(), rtol=0.02
    )
    assert np.abs(found.rest.position[0]) < 0.02 * 148e-6  # the lower pads are not equally warm


@pytest.mark.long
def test_rest_says_how_the_pads_stand():
    found = heated_equilibrium(HeatedFilm(bearing=BEARINGS["pads"]), LOAD, OMEGA)
    pads, at = found.rest.pads, found.rest
    carried = (pads.pad_loads * np.array([np.cos(pads.pivots), np.sin(pads.pivots)])).sum(axis=1)
    np.testing.assert_allclose(carried, LOAD, atol=1e-9 * 4000.0)
    assert at.residual < 1e-11
    assert at.minimum_film == pytest.approx(pads.film_thickness.min())


def test_what_breaks_a_rule_is_named():
    bearing = BEARINGS["pads"]
    with pytest.raises(InputError, match=r"walls must be AdiabaticWalls\(\) or HeldWalls\(...\) for tilting"):
        HeatedFilm(bearing=bearing, walls=BushRing(outer_radius=2.0 * R))
    film = HeatedFilm(bearing=bearing)
    with pytest.raises(FilmContactError, match="touch at pad 3"):
        film.solve([0.0, 0.9 * c], OMEGA)
    with pytest.raises(FilmContactError, match="off pads"):
        HeatedFilm(bearing=BEARINGS["dam"]).solve([0.0, -1.01 * c], OMEGA)
    with pytest.raises(InputError, match="velocity be"):
        film.cold().force(POSITION, [1.0, 0.0], OMEGA)
    with pytest.raises(InputError, match="oil and cooling must be given"):
        HeatedFilm(bearing=tilting(oil=None, cooling=None, viscosity=0.02))
