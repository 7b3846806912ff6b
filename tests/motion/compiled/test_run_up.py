"""Run-ups of rotors with gyroscopic effect and rotating damping, and shafts of many elements over time."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import Radau, solve_ivp
from scipy.linalg import expm

from rotorfilm import (
    ClassicalBeam,
    ContactError,
    Disk,
    ElasticMaterial,
    InputError,
    JournalBearing,
    LinearBearing,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Unbalance,
    mount,
    reduce_rotor,
    rotor_equilibrium,
    simulate,
    simulate_rotor,
)
from rotorfilm.analysis import condensed_runs
from rotorfilm.analysis.compiled_march import March, stretches
from rotorfilm.analysis.compiled_rotor import modal_rotor, take_apart
from rotorfilm.analysis.condensed_runs import NeglectedMotion

FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
SPRINGS = LinearBearing(stiffness=((2e6, 5e5), (-5e5, 3e6)), damping=800.0)
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
JOURNALS = ("left_x", "left_y", "right_x", "right_y")


def overhung(speed, elements=3, **changes):
    """Return a shaft with a disk beyond its bearings: strongly gyroscopic."""
    parts = {
        "elements": ShaftElement(length=1.0, outer_diameter=0.05, material=STEEL).split(elements),
        "disks": (Disk.solid(elements, outer_diameter=0.5, density=7810.0, width=0.05, inner_diameter=0.05),),
        "stations": (Station(node=0, name="left"), Station(node=2 * elements // 3, name="right")),
        "unbalances": (Unbalance(node=elements, unbalance=2e-3),),
        "beam": ClassicalBeam(),
        "speed": speed,
        "internal_damping": 2e-5,
    }
    return ShaftRotor(**(parts | changes))


def both(rotor, bearing):
    return mount(rotor, {"left": bearing, "right": bearing})


def at_rest(rotor, speed):
    rest = rotor_equilibrium(replace(rotor, speed=speed), {"left": FILM, "right": FILM}, speed)
    return np.concatenate([rest.displacement, 0.0 * rest.displacement])


def reference(rotor, bearing, times, speed_at):
    """Integrate the matrices of the rotor by scipy, with the speed, angle and forces of this function."""
    s, size = rotor.structure, len(rotor.structure.weight)

    def rate(t, x):
        q, v = x[:size], x[size:]
        w, slope, angle = speed_at(t)
        force = s.weight - (s.damping + w * s.gyroscopic) @ v - (s.stiffness + w * s.circulation) @ q
        turned = [
            w * w * math.cos(angle) + slope * math.sin(angle),
            w * w * math.sin(angle) - slope * math.cos(angle),
        ]
        force = force + s.unbalance @ turned
        for pair in (s.journals[:2], s.journals[2:]):
            force = force + pair.T @ bearing.force(pair @ q, pair @ v, w)
        return np.concatenate([v, np.linalg.solve(s.mass, force)])

    run = solve_ivp(
        rate, (0.0, times[-1]), np.zeros(2 * size), "DOP853", t_eval=times, rtol=1e-11, atol=1e-16
    )
    return s.journals @ run.y[:size]


@pytest.mark.parametrize("ends", [(100.0, 500.0), (500.0, -300.0)], ids=["up", "through rest"])
def test_run_up_is_that_of_an_independent_integrator(ends):
    (first, last), times = ends, np.linspace(0.0, 0.04, 9)
    slope = (last - first) / times[-1]
    profile = SpeedProfile(times=(0.0, times[-1]), speeds=ends)
    # Few coordinates: the explicit reference follows all modes.
    rotor = reduce_rotor(overhung(profile), frequency=600.0, tolerance=0.2).rotor
    run = simulate_rotor(both(rotor, SPRINGS), duration=times[-1], times=times, rtol=1e-9)
    exact = reference(
        rotor, SPRINGS, times, lambda t: (first + slope * t, slope, first * t + 0.5 * slope * t * t)
    )
    assert np.abs(exact).max() > 1e-5
    for row, name in zip(exact, JOURNALS, strict=True):
        assert run[name] == pytest.approx(row, abs=1e-7 * np.abs(exact).max())


def test_modes_of_another_speed_give_the_matrix_exponential():
    rotor = overhung(400.0, gravity=(0.0, 0.0), unbalances=())
    mounted = both(rotor, SPRINGS)
    size = len(mounted.states)
    start = 1e-5 * np.sin(np.arange(float(size)))
    modal = modal_rotor(take_apart(mounted), 330.0)
    times = np.array([0.011, 0.03])
    march = March(modal=modal, state=modal.modal(start), rtol=1e-10, longest=0.01, duration=0.03, speed=330.0)
    found = modal.physical(march.to(0.03, times).T)
    A = mounted.linearization(0.0, start, []).A
    for k, t in enumerate(times):
        exact = expm(A * t) @ start
        assert found[: size // 2, k] == pytest.approx(exact[: size // 2], abs=1e-12)


def test_bands_of_speed_do_not_matter(monkeypatch):
    profile = SpeedProfile(times=(0.0, 0.1, 0.15), speeds=(150.0, 500.0, 450.0))
    rotor = overhung(profile)
    start = at_rest(rotor, 150.0)
    runs = []
    for bands in (5, 40):
        monkeypatch.setattr(stretches, "__defaults__", (bands,))
        runs.append(
            simulate_rotor(both(rotor, FILM), duration=0.2, initial_state=start, samples=41, rtol=1e-8)
        )
    for name in JOURNALS:
        assert runs[0][name] == pytest.approx(runs[1][name], abs=1e-6 * 1e-4)
    assert np.ptp(runs[0]["right_x"]) > 0.1e-4


def test_stretches_end_at_kinks_and_where_the_speed_leaves_a_band():
    profile = SpeedProfile(times=(-1.0, 1.0, 2.0, 4.0), speeds=(-10.0, 10.0, 10.0, -10.0))
    found = list(stretches(take_apart(both(overhung(profile), SPRINGS)), 3.5, bands=2))
    assert [end for end, _ in found] == pytest.approx([0.5, 1.0, 2.0, 2.5, 3.0, 3.5])
    assert [speed for _, speed in found] == pytest.approx([2.5, 7.5, 10.0, 7.5, 2.5, -2.5])


def test_a_constant_speed_is_one_stretch():
    assert list(stretches(take_apart(both(overhung(300.0), SPRINGS)), 2.0)) == [(2.0, 300.0)]


@pytest.mark.filterwarnings("ignore:a journal went beyond", "ignore:eccentricity ratio")
def test_a_run_up_into_the_wall_keeps_what_was_computed():
    profile = SpeedProfile(times=(0.0, 0.005), speeds=(10.0, 110.0))
    rotor = overhung(profile)
    with pytest.raises(ContactError, match=r"journal of 'right' reached the wall at t = ") as caught:
        simulate_rotor(both(rotor, replace(FILM, viscosity=1e-9)), duration=0.05, samples=2001, rtol=1e-6)
    partial = caught.value.partial
    assert 100 < len(partial.time) < 2001
    gap = max(np.hypot(partial[f"{k}_x"], partial[f"{k}_y"])[-1] for k in ("left", "right"))
    assert 0.9 < gap / FILM.clearance < 1.0
    assert partial["speed"] == pytest.approx(np.minimum(10.0 + 2e4 * partial.time, 110.0))


@pytest.mark.parametrize(
    "speed", [350.0, SpeedProfile(times=(0.0, 0.1), speeds=(350.0, 400.0))], ids=["steady", "run-up"]
)
def test_steps_do_not_grow_with_elements(speed):
    steps, motions = [], []
    for elements in (12, 24, 48, 96):
        rotor = overhung(speed, elements)
        start = at_rest(overhung(350.0, elements), 350.0)
        arguments = {"duration": 0.1, "initial_state": start, "samples": 21, "rtol": 1e-7}
        run = simulate_rotor(both(rotor, FILM), **arguments)
        steps.append(run.work["steps"])
        motions.append(np.array([run[name] for name in JOURNALS]))
    # The first is run whole; classical elements have an error of their own, of second order.
    assert max(steps[1:]) < 1.6 * min(steps[1:])
    gaps = [np.abs(one - motions[-1]).max() / FILM.clearance for one in motions[:-1]]
    assert gaps[1] < 0.4 * gaps[0]
    assert gaps[2] < 2e-4


def test_few_shapes_are_within_their_tolerance_of_all():
    rotor = overhung(350.0, 18)
    start = at_rest(rotor, 350.0)
    arguments = {"duration": 0.05, "initial_state": start, "samples": 11, "rtol": 1e-7}
    few = simulate_rotor(both(rotor, FILM), **arguments)
    whole = simulate_rotor(both(rotor, FILM), condensation=0.0, **arguments)
    assert list(few.signals) == list(whole.signals)
    for name in JOURNALS:
        assert 0.0 < np.abs(few[name] - whole[name]).max() < 1e-5 * FILM.clearance
    with pytest.raises(InputError, match="condensation must"):
        simulate_rotor(both(rotor, FILM), condensation=-1.0, **arguments)


@pytest.mark.long
def test_films_by_station_are_mounted_and_run():
    rotor, films = (
        overhung(SpeedProfile(times=(0.0, 0.1), speeds=(100.0, 150.0))),
        {"left": FILM, "right": FILM},
    )
    run = simulate(rotor, films, duration="50 ms", samples=11, rtol=1e-6)
    same = simulate_rotor(mount(rotor, films), duration=0.05, samples=11, rtol=1e-6)
    np.testing.assert_array_equal(run["left_y"], same["left_y"])
    with pytest.raises(KeyError, match=r"signal must be one of .*left_x.* got 'leftx'"):
        run["leftx"]
    whole = simulate(rotor, films, duration="50 ms", samples=11, rtol=1e-7, method=Radau)
    np.testing.assert_allclose(whole["left_y"], run["left_y"], atol=1e-4 * FILM.clearance)


def driven(rotor, run):
    """Return the journals of all of a rotor under the forces of the bearings in a run."""
    model = rotor.operators
    names = ["left_force_x", "left_force_y", "right_force_x", "right_force_y"]
    turning = np.array([rotor.rotating(t) for t in run.time]).T
    forces = np.vstack([*(run[name] for name in names), turning, np.ones(len(run.time))])
    push = np.column_stack([model.push, model.unbalance, model.weight])
    size, count = push.shape
    step = run.time[1] - run.time[0]
    whole = np.zeros((size + 2 * count, size + 2 * count))
    whole[:size, :size] = model.steady + rotor.speed * model.by_speed
    whole[:size, size : size + count] = push
    whole[size : size + count, size + count :] = np.eye(count)
    free, held, rising = np.split(expm(step * whole)[:size], [size, size + count], axis=1)
    state, found = rotor.initial_state, []
    for now, then in zip(forces.T, forces.T[1:], strict=False):
        found.append(state)
        state = free @ state + held @ now + rising @ (then - now) / step
    rows = rotor.linearization(0.0, state, np.zeros(4)).C
    places = [[signal.name for signal in rotor.outputs].index(name) for name in JOURNALS]
    return rows[places] @ np.array(found).T


@pytest.fixture
def told(monkeypatch):
    """Return how far neglected shapes moved the journals in each run, as it was judged."""
    found, largest = [], NeglectedMotion.largest

    def kept(self, *run):
        found.append(largest(self, *run))
        return found[-1]

    monkeypatch.setattr(NeglectedMotion, "largest", kept)
    return found


@pytest.mark.closed_form
def test_the_whole_shaft_under_the_forces_of_a_run_has_its_journals(told, monkeypatch):
    rotor = overhung(350.0, 18)
    rotor = replace(rotor, initial=tuple(at_rest(rotor, 350.0)))
    monkeypatch.setattr(condensed_runs, "FREQUENCY", 0.2)
    away, ends = [], []
    for condensation in (1.0, 5e-5, 1e-5):
        run = simulate_rotor(both(rotor, FILM), duration=0.02, samples=2001, condensation=condensation)
        journals = np.array([run[name] for name in JOURNALS])[:, :-1]
        away.append(np.abs(driven(rotor, run) - journals).max() / FILM.clearance)
        ends.append(told[-1])
        assert told[-1] <= condensation
        assert 0.2 * told[-1] < away[-1] < 1.3 * told[-1]
    # The fewest shapes are too few for the default, and it takes more.
    assert away[0] > 2e-4
    assert away[2] < 1e-5
    assert len(set(ends)) == 3


@pytest.mark.long
def test_a_shaft_that_whirls_is_run_in_few_shapes(told):
    # Two runs of unstable motion part exponentially; what the shapes neglect stays small.
    rise, work = SpeedProfile(times=(0.0, 0.4), speeds=(300.0, 400.0)), []
    for elements in (24, 48):
        pieces = ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(elements)
        disk = {"outer_diameter": 0.3, "density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
        rotor = ShaftRotor(
            elements=pieces,
            disks=(Disk.solid(elements // 3, **disk), Disk.solid(2 * elements // 3, **disk)),
            stations=(Station(node=0, name="left"), Station(node=elements, name="right")),
            unbalances=(Unbalance(node=elements // 3, unbalance=2e-4),),
            speed=rise,
        )
        run = simulate_rotor(both(rotor, FILM), duration=0.4, samples=201, rtol=1e-6)
        whirl = np.hypot(run["left_x"], run["left_y"]) / FILM.clearance
        assert whirl.max() > 0.3
        assert told[-1] < 1e-5
        work.append(run.work["steps"])
    assert work[1] < 2.5 * work[0]
