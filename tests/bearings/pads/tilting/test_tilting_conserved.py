"""Tilting pads whose films conserve their oil: Reynolds' limit, held pads, orders, derivatives, oil."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError, JFOFilm
from rotorfilm.bearings import PadGridFilm
from rotorfilm.bearings.pads.pad_bearing import OwnCenter
from rotorfilm.scenes import parse_scene

SIZE = {"radius": 0.05, "length": 0.05, "viscosity": 0.02, "extent": 1.0}
HERE, THIN = np.array([6e-6, -2.8e-5]), np.array([3e-6, -5.5e-5])
REST, OMEGA = np.zeros(2), 300.0
FIVE = rf.TiltingPadBearing(
    **SIZE, assembled_clearance=7e-5, pivots=rf.even_pivots(5), preload=0.3, film=PadGridFilm(cells=(96, 16))
)
FULL = rf.TiltingPadBearing(
    **SIZE,
    assembled_clearance=7e-5,
    pivots=rf.even_pivots(4, between_pads=True),
    preload=0.2,
    pivot_offset=0.65,
    pad_inertia=2e-3,
    film=PadGridFilm(cells=(192, 32)),
)
SPRUNG = rf.TiltingPadBearing(
    **SIZE, assembled_clearance=7e-5, pivots=rf.even_pivots(5), preload=0.3, pivot_stiffness=4e7
)
PRELOADED = rf.TiltingPadBearing(**SIZE, assembled_clearance=7e-5, pivots=rf.even_pivots(5), preload=0.6)
FILMS = {
    "rigid": JFOFilm(bearing=FIVE, cells=(96, 8)),
    "sprung": JFOFilm(bearing=SPRUNG, cells=(96, 8)),
    "below ambient": JFOFilm(bearing=PRELOADED, cells=(96, 8), cavitation_pressure=-3e4, submerged=True),
}


@pytest.fixture(params=FILMS)
def film(request):
    return FILMS[request.param]


def fixed_in_its_tilts(film):
    """Return the same film of pads that stand, whose centers are those of the pads in their tilts."""
    bearing, pads = film.bearing, film.at_rest().pad_states(THIN, OMEGA)
    arcs = []
    for pivot, tilt, moved in zip(pads.pivots, pads.tilts, pads.pivot_deflections, strict=True):
        center = -np.array([bearing.preload + moved / bearing.clearance, tilt / bearing.clearance])
        start = pivot - bearing.pivot_offset * bearing.extent
        share = bearing.pivot_offset + math.atan2(-center[1], -center[0]) / bearing.extent
        own = {"extent": bearing.extent, "preload": math.hypot(*center), "offset": share}
        arcs.append(OwnCenter(start=start, **own))

    class Held(rf.LobedBearing):
        @property
        def arcs(self):
            return arcs

    size = {name: value for name, value in SIZE.items() if name != "extent"}
    lobes = tuple(rf.Lobe(start=arc.start, extent=arc.extent) for arc in arcs)
    return JFOFilm(bearing=Held(**size, pad_clearance=bearing.clearance, lobes=lobes), cells=film.cells)


@pytest.mark.convergence
def test_full_films_come_to_reynolds_with_second_order():
    losses = FULL.losses(HERE, REST, OMEGA)
    expected = np.array([*FULL.at_rest().force(HERE, REST, OMEGA), losses.friction_torque])
    found = []
    for cells in ((96, 8), (192, 16)):
        state = JFOFilm(bearing=FULL, cells=cells).solve(HERE, OMEGA)
        assert state.oil_content.min() == 1.0
        found.append([*state.force, state.friction_torque])
    coarse, finer = np.array(found)
    size = np.array([np.hypot(*expected[:2])] * 2 + [expected[2]])
    assert_allclose(((4.0 * finer - coarse) / 3.0 - expected) / size, 0.0, atol=5e-4)
    left = [np.hypot(*(one - expected)[:2]) for one in (coarse, finer)]
    assert left[0] / left[1] == pytest.approx(4.0, rel=0.25)


@pytest.mark.closed_form
def test_the_stiffness_of_full_films_is_linear_in_the_exponent():
    film, s = JFOFilm(bearing=FULL, cells=(96, 8)), 40.0 + 250.0j
    matrices = film.at_rest().matrices(HERE, OMEGA)
    expected, slope = matrices.dynamic_stiffness(s)
    K, by_s = film.dynamic_stiffness(HERE, OMEGA)(s)
    assert matrices.mass[2, 2] == pytest.approx(2e-3 / 0.05**2)
    assert_allclose(K, expected, rtol=1e-9, atol=1e-9 * abs(expected).max())
    assert_allclose(by_s, slope, rtol=1e-8, atol=1e-8 * abs(slope).max())
    grid = FULL.at_rest().matrices(HERE, OMEGA).reduced(OMEGA)
    own = matrices.reduced(OMEGA)
    assert_allclose(own.stiffness, grid.stiffness, atol=0.02 * grid.stiffness.max())
    assert_allclose(own.damping, grid.damping, atol=0.02 * grid.damping.max())


@pytest.mark.closed_form
@pytest.mark.parametrize("name", ["rigid", "sprung"])
def test_pads_are_in_balance_and_answer_as_fixed_ones_in_their_tilts(name):
    film = FILMS[name]
    fixed = fixed_in_its_tilts(film)
    own, other = (one.losses(THIN, REST, OMEGA) for one in (film, fixed))
    assert film.solve(THIN, OMEGA).oil_content.min() < 0.99
    assert_allclose(film.force(THIN, REST, OMEGA), fixed.force(THIN, REST, OMEGA), rtol=1e-10)
    assert own.power_loss == pytest.approx(other.power_loss, rel=1e-10)
    assert_allclose(own.inflow, other.inflow, rtol=1e-10)
    bearing, pads = film.bearing, film.at_rest().pad_states(THIN, OMEGA)
    normal = np.stack([np.cos(pads.pivots), np.sin(pads.pivots)])
    assert_allclose(-normal @ pads.pad_loads, film.force(THIN, REST, OMEGA), rtol=1e-9)
    if bearing.pivot_stiffness is not None:
        assert_allclose(pads.pad_loads, -bearing.pivot_stiffness * pads.pivot_deflections, rtol=1e-9)


@pytest.mark.closed_form
def test_derivatives_are_those_of_differences(film):
    step, quicker = 2e-10, 1e-3
    found = film.jacobian(THIN, REST, OMEGA)
    sides = [
        film.force(THIN + step * way, REST, OMEGA) - film.force(THIN - step * way, REST, OMEGA)
        for way in np.eye(2)
    ]
    assert_allclose(
        found[:, :2], np.array(sides).T / (2.0 * step), rtol=2e-4, atol=2e-4 * abs(found[:, :2]).max()
    )
    by_speed = film.force(THIN, REST, OMEGA + quicker) - film.force(THIN, REST, OMEGA - quicker)
    assert_allclose(found[:, 4], by_speed / (2.0 * quicker), rtol=1e-5)
    assert_allclose(film.at_rest().jacobian(THIN, REST, OMEGA)[:, [0, 1, 4]], found[:, [0, 1, 4]], rtol=1e-8)
    motion, s = film.dynamic_stiffness(THIN, OMEGA), 30.0 + 200.0j
    slope = (motion.stiffness(s + 0.01) - motion.stiffness(s - 0.01)) / 0.02
    assert_allclose(motion(s)[1], slope, rtol=1e-6, atol=1e-6 * abs(slope).max())
    assert_allclose(motion.stiffness(0j), -found[:, :2], rtol=1e-8)


@pytest.mark.closed_form
def test_no_oil_is_made_or_lost(film):
    state = film.solve(THIN, OMEGA)
    assert state.oil_content.min() < 0.99
    assert state.mass_defect < 1e-12
    assert state.inflow.sum() + state.drawn_in == pytest.approx(state.side_flow, rel=1e-12)


@pytest.mark.closed_form
def test_an_equilibrium_tells_its_pads_and_losses():
    film = FILMS["rigid"]
    at = rf.equilibrium(film, [0.0, -2000.0], OMEGA)
    assert at.pads.pad_loads @ np.sin(at.pads.pivots) == pytest.approx(-2000.0, rel=1e-9)
    assert at.losses.power_loss == pytest.approx(film.losses(at.position, REST, OMEGA).power_loss)
    K = rf.coefficients(film, at.position, OMEGA)
    other = rf.coefficients(FIVE, rf.equilibrium(FIVE, [0.0, -2000.0], OMEGA).position, OMEGA)
    assert_allclose(K.stiffness, other.stiffness, atol=0.01 * other.stiffness.max())
    assert_allclose(K.damping, other.damping, atol=0.01 * other.damping.max())


SCENE = """schema = 1
[tilting_pad]
radius = 0.05
length = 0.05
assembled_clearance = 7e-5
preload = 0.3
extent = 1.0
pad_count = 5
loading = "on_pad"
viscosity = 0.02
film = { name = "jfo", cells = [72, 6] }
[operation]
speed = 300.0
load = 2000.0
[rigid_rotor]
mass = 200.0
unbalance = 1e-3
[question]
quantity = "QUANTITY"
tolerance = 0.2
"""


def test_scenes_conserve_the_oil_of_tilting_pads_where_they_are_asked_to():
    answer = parse_scene(SCENE.replace("QUANTITY", "damping"), "pads.toml").ask()
    film = JFOFilm(bearing=FIVE, cells=(72, 6))
    at = rf.equilibrium(film, [0.0, -2000.0], OMEGA)
    assert answer.met
    assert (answer.model, answer.remarks) == ("JFO 72 x 6", ())
    assert_allclose(answer.value, rf.coefficients(film, at.position, OMEGA).damping, atol=1e-3)
    with pytest.raises(InputError, match="film must be a quasi-static film law"):
        parse_scene(SCENE.replace("QUANTITY", "unbalance_amplitude"), "pads.toml").ask()


def test_what_such_pads_do_not_have_is_refused():
    film = FILMS["rigid"]
    with pytest.raises(InputError, match="pads that do not tilt for steps in time and FMUs"):
        film.start([*HERE, 0.0, 0.0, OMEGA])
    with pytest.raises(InputError, match="pads that do not tilt"):
        film.native()
    light = rf.TiltingPadBearing(**SIZE, assembled_clearance=7e-5, pivots=rf.even_pivots(5))
    pulling = JFOFilm(bearing=light, cavitation_pressure=-1e5, submerged=True)
    with pytest.raises(rf.ConvergenceError, match=r"cavitation_pressure must be 0 .* at pad \d"):
        pulling.force(HERE, REST, OMEGA)


def test_derivatives_without_rotation_are_undefined():
    film = FILMS["rigid"]
    with pytest.raises(rf.UndefinedDerivativeError, match="must"):
        film.at_rest().matrices(HERE, 0.0)
    with pytest.raises(rf.UndefinedDerivativeError, match="speed must not be 0"):
        film.dynamic_stiffness(HERE, 0.0)(10j)
