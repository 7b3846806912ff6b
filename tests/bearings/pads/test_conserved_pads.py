"""Lobed and pressure-dam bearings whose films conserve their oil: limits, closed forms, orders, oil."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import ConvergenceError, FilmContactError, InputError, JFOFilm
from rotorfilm.bearings import MomentCarryingJFOFilm, Pad, PadGridFilm, Recess, RecessedPad, rupture_error
from rotorfilm.bearings.films.geometry import FilmGeometry, SunkArc
from rotorfilm.bearings.films.mass_conserving import ConservedFilm, Supply, conserved_cells
from rotorfilm.scenes import parse_scene

DEGREE = math.pi / 180.0
SIZE = {"radius": 0.05, "length": 0.06, "viscosity": 0.02}
HERE, REST, OMEGA = np.array([2e-5, -4e-5]), [0.0, 0.0], 300.0
ARCS = {
    "two": [(10.0 * DEGREE, 160.0 * DEGREE), (190.0 * DEGREE, 160.0 * DEGREE)],
    "all round": [(k * 120.0 * DEGREE, 120.0 * DEGREE) for k in range(3)],
}
LOBED = rf.LobedBearing(**SIZE, pad_clearance=1e-4, lobes=rf.lobe_set("elliptical", preload=0.4))
DAM = rf.PressureDamBearing(
    **SIZE,
    pad_clearance=1e-4,
    pads=rf.pressure_dam_pads(depth=1.5e-4, end=140.0 * DEGREE, share=0.75, track_depth=5e-5, preload=0.2),
)
FILMS = {name: JFOFilm(bearing=one, cells=(72, 6)) for name, one in (("lobes", LOBED), ("dam", DAM))}


@pytest.fixture(params=FILMS)
def film(request):
    return FILMS[request.param]


def told(film):
    """Return what a film says at one place."""
    state = film.solve(HERE, OMEGA)
    K = film.complex_stiffness(HERE, OMEGA, 20.0 + 90.0j)
    return [*state.force, state.friction_torque, state.side_flow, *state.inflow, *K.ravel()]


@pytest.mark.closed_form
@pytest.mark.parametrize("arcs", ARCS)
def test_pads_about_one_center_are_those_of_a_journal_bearing(arcs):
    own = [{"start": start, "extent": extent} for start, extent in ARCS[arcs]]
    journal = rf.JournalBearing(**SIZE, clearance=1e-4, pads=tuple(Pad(**one) for one in own))
    lobed = rf.LobedBearing(**SIZE, pad_clearance=1e-4, lobes=tuple(rf.Lobe(**one) for one in own))
    dam = rf.PressureDamBearing(**SIZE, pad_clearance=1e-4, pads=tuple(RecessedPad(**one) for one in own))
    expected = told(JFOFilm(bearing=journal, cells=(72, 6)))
    for bearing in (lobed, dam):
        assert_allclose(told(JFOFilm(bearing=bearing, cells=(72, 6))), expected, rtol=1e-11)


@pytest.mark.closed_form
def test_a_dam_without_depth_is_the_pad():
    flat = [replace(pad, recess=replace(pad.recess, depth=1e-18)) for pad in DAM.pads]
    film = JFOFilm(bearing=replace(DAM, pads=tuple(flat)), cells=(72, 6))
    without = replace(film.film, cells=film.film.cells._replace(depth=None))
    found, expected = (one.solve(one.gap(HERE / film.clearance), 0.5 * OMEGA) for one in (film.film, without))
    assert_allclose(found.solution.pressure, expected.solution.pressure, rtol=1e-11)
    assert film.film.shear(found) == pytest.approx(without.shear(expected), rel=1e-12)


@pytest.mark.closed_form
def test_a_step_has_the_pressure_of_rayleigh():
    arc, share, D = 2.0, 0.7, 0.9
    geometry = FilmGeometry(
        pads=(Pad(start=0.0, extent=arc),),
        recesses=(SunkArc(start=0.0, end=share * arc, share=1.0, depth_ratio=D),),
    )
    cells = conserved_cells(geometry, 72, 4)
    cells = cells._replace(wall=np.ones((3, len(cells.angle))))
    supply = Supply(np.zeros(1), np.zeros(1, dtype=bool), np.zeros(1), 0.0)
    film = ConservedFilm(cells, 1e6, supply)  # so long that nothing leaves at its ends
    pressure = film.solve(film.gap(np.zeros(2)), 0.5).solution.pressure
    peak = 0.5 * D / ((1.0 + D) ** 3 / (share * arc) + 1.0 / ((1.0 - share) * arc))
    assert pressure.max() == pytest.approx(peak, rel=1e-9)
    assert cells.angle[pressure[:, 0].argmax()] % (2.0 * math.pi) == pytest.approx(share * arc)


def full_of(kind):
    """Return a bearing whose films are full, as they narrow all along, and its reference on a fine grid."""
    if kind == "lobes":
        lobes = rf.lobe_set("tapered_land", preload=0.5)
        bearing = rf.LobedBearing(**SIZE, pad_clearance=1e-4, lobes=lobes, film=PadGridFilm(cells=(192, 16)))
        return bearing, bearing
    pads = tuple(
        RecessedPad(
            start=start,
            extent=2.6,
            preload=0.4,
            offset=1.0,
            recess=Recess(depth=6e-5, end=start + 1.6, share=0.5),
        )
        for start in (0.1, 3.3)
    )
    bearing = rf.PressureDamBearing(**SIZE, pad_clearance=1e-4, pads=pads)
    return bearing, replace(bearing, cells=(128, 32))


@pytest.mark.convergence
@pytest.mark.parametrize("kind", ["lobes", "dam"])
def test_full_films_come_to_reynolds_with_second_order(kind):
    bearing, fine = full_of(kind)
    place = np.array([4e-6, -6e-6])
    losses = fine.losses(place, REST, OMEGA)
    expected = np.array([*fine.force(place, REST, OMEGA), losses.friction_torque, losses.side_flow])
    found = []
    for cells in ((48, 8), (96, 16)):
        state = JFOFilm(bearing=bearing, cells=cells).solve(place, OMEGA)
        assert state.oil_content.min() == 1.0
        found.append([*state.force, state.friction_torque, state.side_flow])
    coarse, finer = np.array(found)
    size = np.array([np.hypot(*expected[:2])] * 2 + [*expected[2:]])
    assert finer[3] == pytest.approx(expected[3], rel=1e-2)  # of first order at corners
    assert_allclose(((4.0 * finer - coarse) / 3.0 - expected)[:3] / size[:3], 0.0, atol=5e-4)
    coarse, finer = ((one - expected)[:2] for one in (coarse, finer))
    assert np.hypot(*coarse) / np.hypot(*finer) == pytest.approx(4.0, rel=0.25)


@pytest.mark.closed_form
def test_no_oil_is_made_or_lost(film):
    state = film.solve(HERE, OMEGA)
    assert state.oil_content.min() < 0.99
    assert state.mass_defect < 1e-12
    assert state.inflow.sum() + state.drawn_in == pytest.approx(state.side_flow, rel=1e-12)
    lost = film.losses(HERE, REST, OMEGA)
    assert_allclose(lost.inflow - lost.arriving, state.inflow, atol=1e-12 * lost.inflow.max())
    assert lost.bush_torque == pytest.approx(
        lost.friction_torque - HERE[0] * state.force[1] + HERE[1] * state.force[0]
    )


@pytest.mark.closed_form
def test_the_power_of_the_shaft_is_the_dissipation_of_film_and_streamers(film):
    # At rest: shear of the oil, and what pressure drives through every face, those of a start of film too.
    own, place = film.film, HERE / film.clearance
    state = own.solve(own.gap(place), 0.5 * OMEGA)
    equations, (P, theta, *_) = state.equations, state.solution
    rise, along = np.roll(P, -1, axis=0) - P, own.falls(state)
    power = np.sum(equations.around * rise**2) + np.sum(equations.along * along**2)
    power += np.sum(equations.wedge * (1.0 - theta) * rise)  # of oil that strikes the start of a film
    shear = OMEGA**2 * np.sum(own.sheared_area(state))
    assert OMEGA * own.shear(state) == pytest.approx(shear + 12.0 * power, rel=1e-12)


@pytest.mark.closed_form
def test_half_of_the_length_is_the_whole(film):
    half, whole = film.film, film.over(whole=True).film
    one, both = (each.solve(each.gap(HERE / film.clearance), 0.5 * OMEGA) for each in (half, whole))
    mirrored = np.hstack([one.solution.pressure[:, ::-1], one.solution.pressure])
    assert_allclose(both.solution.pressure, mirrored, atol=1e-12 * mirrored.max())
    assert_allclose(
        whole.force(both), [*half.force(one), 0.0, 0.0], atol=1e-12 * np.abs(half.force(one)).max()
    )
    assert whole.shear(both) == pytest.approx(half.shear(one), rel=1e-12)


def test_derivatives_are_those_of_differences(film):
    by = film.jacobian(HERE, REST, OMEGA)
    for k, step in ((0, 1e-10), (1, 1e-10), (4, 1e-4)):
        more, less = (
            film.force((HERE + sign * step * np.eye(5)[k, :2]), REST, OMEGA + sign * step * (k == 4))
            for sign in (1.0, -1.0)
        )
        assert_allclose((more - less) / (2.0 * step), by[:, k], atol=1e-6 * np.abs(by[:, k]).max())


def test_steps_in_time_are_the_stiffness_at_a_frequency():
    film, nu, size, steps = JFOFilm(bearing=DAM, cells=(36, 4)), 150.0, 1e-9, 192
    dt, z = 2.0 * math.pi / nu / steps, nu * 2.0j * math.pi / nu / steps

    def at(k):
        return np.array(
            [HERE[0] + size * math.sin(k * z.imag), HERE[1], size * nu * math.cos(k * z.imag), 0.0, OMEGA]
        )

    state, forces = film.start(at(0)), []
    for k in range(3 * steps):
        state, output, _ = film.step(state, k * dt, at(k + 1), dt)
        forces.append(output[:2])
    phase = np.exp(-1j * z.imag * np.arange(2 * steps + 1, 3 * steps + 1))
    found = 2.0j / steps * (np.array(forces[2 * steps :]).T @ phase) / size
    K = film.complex_stiffness(HERE, OMEGA, 1j * nu)[:, 0]
    assert_allclose(-found, K, atol=0.01 * np.abs(K).max())


def test_tilted_pads_have_moments():
    tilted = MomentCarryingJFOFilm(film=JFOFilm(bearing=LOBED, cells=(36, 4)))
    at, half = np.array([*HERE, 2e-4, -1e-4]), JFOFilm(bearing=LOBED, cells=(36, 4))
    assert_allclose(
        tilted.force([*HERE, 0.0, 0.0], [0.0] * 4, OMEGA)[:2], half.force(HERE, REST, OMEGA), rtol=1e-10
    )
    by = tilted.jacobian(at, [0.0] * 4, OMEGA)
    for k, step in enumerate((1e-10, 1e-10, 1e-8, 1e-8)):
        more, less = (tilted.force(at + sign * step * np.eye(4)[k], [0.0] * 4, OMEGA) for sign in (1.0, -1.0))
        assert_allclose((more - less) / (2.0 * step), by[:, k], atol=1e-5 * np.abs(by[:, k]).max())
    assert tilted.minimum_film(at) < LOBED.minimum_film(HERE)


def test_the_error_of_reynolds_rupture_is_that_of_fine_grids():
    found = rupture_error(DAM, HERE, OMEGA)
    fine = replace(DAM, cells=(64, 16))
    state = JFOFilm(bearing=DAM, cells=(144, 16)).solve(HERE, OMEGA)
    apart = np.hypot(*(fine.force(HERE, REST, OMEGA) - state.force)) / np.hypot(*state.force)
    flow = float(fine.losses(HERE, REST, OMEGA).side_flow) / state.side_flow - 1.0
    assert found.force_error == pytest.approx(apart, abs=5e-3)
    assert found.side_flow_error == pytest.approx(flow, abs=0.02)
    assert abs(found.side_flow_error) > 0.05


def test_a_journal_touches_where_a_pad_does(film):
    beyond = np.array([0.0, -1.01 * film.bearing.bore_clearance])
    assert film.minimum_film(beyond) < 0.0
    with pytest.raises(FilmContactError, match="position must"):
        film.force(beyond, REST, OMEGA)
    with pytest.raises(FilmContactError, match="the journal must leave a film on every pad"):
        film.start([*beyond, 0.0, 0.0, OMEGA])


def test_the_edge_of_a_pad_touches_between_the_faces_of_its_cells():
    """Where pads meet, the one before the line is the nearer one; the next begins with a step outward."""
    lobes = tuple(
        rf.Lobe(start=start, extent=extent, preload=0.4, offset=1.0) for start, extent in ARCS["all round"]
    )
    film = JFOFilm(bearing=rf.LobedBearing(**SIZE, pad_clearance=1e-4, lobes=lobes), cells=(36, 4))
    edge = 0.6 * film.clearance * np.array([math.cos(240.0 * DEGREE), math.sin(240.0 * DEGREE)])
    film.start([*0.997 * edge, 0.0, 0.0, OMEGA])
    assert film.minimum_film(1.003 * edge) < 0.0
    with pytest.raises(FilmContactError, match="the journal must leave a film on every pad"):
        film.start([*1.003 * edge, 0.0, 0.0, OMEGA])


@pytest.mark.closed_form
def test_the_temperature_over_pads_about_one_center_is_that_of_a_journal_bearing():
    warm = {"oil": rf.Oil.iso_vg(46), "cooling": rf.Cooling(supply_temperature=318.15)}
    size = {"radius": 0.05, "length": 0.06, **warm}
    own = [{"start": start, "extent": extent} for start, extent in ARCS["two"]]
    journal = rf.JournalBearing(**size, clearance=1e-4, pads=tuple(Pad(**one) for one in own))
    lobed = rf.LobedBearing(**size, pad_clearance=1e-4, lobes=tuple(rf.Lobe(**one) for one in own))
    one, other = (
        rf.HeatedJFOFilm(film=JFOFilm(bearing=each, cells=(36, 4))).solve(HERE, OMEGA)
        for each in (journal, lobed)
    )
    assert_allclose(other.oil_temperature, one.oil_temperature, rtol=1e-10)
    dam = replace(DAM, viscosity=None, **warm)
    state = rf.HeatedJFOFilm(film=JFOFilm(bearing=dam, cells=(36, 4))).solve(HERE, OMEGA)
    losses = state.film.losses(HERE, REST, OMEGA)
    assert abs(state.heat.missing) < 1e-12 * state.heat.made
    assert state.heat.made == pytest.approx(losses.power_loss, rel=1e-12)


def test_pads_that_tilt_are_refused_where_they_have_no_model():
    tilting = rf.TiltingPadBearing(**SIZE, pad_clearance=1e-4, pivots=(1.0, 3.0, 5.0), extent=1.2)
    for kind in (MomentCarryingJFOFilm, rf.HeatedJFOFilm):
        with pytest.raises(InputError, match="pads that do not tilt, got that of TiltingPadBearing"):
            kind(film=JFOFilm(bearing=tilting))


def test_cells_too_coarse_for_a_thin_film_are_refused_and_finer_ones_are_not():
    bearing = rf.TiltingPadBearing(
        **{**SIZE, "viscosity": 0.02},
        pad_clearance=7e-5,
        pivots=tuple(0.4 * np.pi * np.arange(5)),
        extent=1.0,
        preload=0.3,
    )

    def force(cells, ratio, angle):
        return JFOFilm(bearing=bearing, cells=cells).force(
            ratio * 7e-5 * np.array([np.cos(angle), np.sin(angle)]), REST, 500.0
        )

    with pytest.raises(ConvergenceError, match="the cells may be too coarse for least films of "):
        force((36, 4), 0.79, -1.77)
    assert_allclose(force((144, 6), 0.79, -1.77), force((216, 8), 0.79, -1.77), rtol=0.03)
    # Steps that the wall shortens are no reason to give up.
    assert_allclose(force((36, 4), 0.8, -1.8), force((144, 6), 0.8, -1.8), rtol=0.2)


def test_an_equilibrium_with_heat_balances():
    warm = {"viscosity": None, "oil": rf.Oil.iso_vg(46), "cooling": rf.Cooling(supply_temperature=318.15)}
    film = JFOFilm(bearing=replace(DAM, **warm), cells=(36, 4))
    at = rf.equilibrium(film, [0.0, -2000.0], OMEGA)
    heat = film.bearing.at_temperature(at.temperature)
    assert 320.0 < at.temperature < 360.0
    assert_allclose(
        JFOFilm(bearing=heat, cells=(36, 4)).force(at.position, REST, OMEGA), [0.0, 2000.0], atol=0.01
    )


SCENES = {
    "lobed_journal": 'preset = "elliptical"\npreload = 0.4\n',
    "pressure_dam": 'depth = 1.5e-4\nend = "140 deg"\nshare = 0.75\npreload = 0.2\n',
}


ROTOR = """[rigid_rotor]
mass = 400.0
unbalance = 1e-3
"""


def asked(table, film, quantity="side_flow", further=""):
    text = f'''schema = 1
[{table}]
{SCENES[table]}radius = 0.05
length = 0.06
pad_clearance = 1e-4
viscosity = 0.02
{film}
[operation]
speed = 300.0
load = 4000.0
[question]
quantity = "{quantity}"
tolerance = 0.1
{further}
'''
    return parse_scene(text, "pads.toml")


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")
@pytest.mark.parametrize("table", SCENES)
def test_scenes_say_what_conserved_oil_changes_and_conserve_it_where_asked(table):
    ruptured, conserved = (
        asked(table, film).ask() for film in ("", 'film = { name = "jfo", cells = [72, 8] }')
    )
    sizes = [one.size for one in ruptured.remarks if "conservation of oil" in one]
    assert conserved.met
    assert conserved.model == "JFO 72 x 8"
    change = abs(conserved.value / ruptured.value - 1.0)
    assert sum(sizes) == pytest.approx(change, rel=0.5, abs=0.02)
    assert len(sizes) == (table == "pressure_dam")
    assert ("but conservation of oil" in ruptured.within) is (change > 0.1)
    answer = asked(table, 'film = { name = "jfo", cells = [36, 4] }').describe()
    assert answer.model == "JFOFilm(cells=(36, 4))"
    assert answer.losses.side_flow == pytest.approx(conserved.value, rel=0.1)


def test_motions_ask_for_a_law():
    scene = asked("pressure_dam", 'film = { name = "jfo" }', "unbalance_amplitude", ROTOR)
    with pytest.raises(InputError, match="film must be a quasi-static film law"):
        scene.ask()
