"""Compiled runs with linear reactions that have states, added masses and cracks equal those of scipy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import Radau

import rotorfilm as rf
from rotorfilm.analysis import simulate, simulate_rotor
from rotorfilm.bearings import MapSqueeze
from rotorfilm.core import ContactError
from rotorfilm.rotors import BaseExcitedRotor, BaseMotion, CrackedRotor, GaschHinge, JeffcottCrack, mount

CLEARANCE, TIME = 1e-4, 0.005
FILM = rf.JournalBearing(radius=0.05, length=0.03, clearance=CLEARANCE, viscosity=0.05)
SEAL = rf.FrequencyDependentReaction.from_isotropic([[-500.0 + 60.0j]], [[1.0]], [[4e8]], [[-2e6]])
HEAVY = rf.FrequencyDependentReaction(
    A=SEAL.A, B=SEAL.B, C=SEAL.C, D=SEAL.D, damping=50.0 * np.eye(2), added_mass=[[3.0, 0.2], [0.2, 2.0]]
)
DAMPER = rf.SqueezeFilmDamper(
    radius=0.05, length=0.02, clearance=CLEARANCE, viscosity=0.02, density=870.0, film=MapSqueeze()
)
SPRINGS = rf.LinearBearing(stiffness=5e6 * np.eye(2), damping=np.zeros((2, 2)))
SPRUNG = rf.Parallel(reactions=(DAMPER, SPRINGS))
ANNULAR = rf.AnnularSeal(
    radius=0.05, length=0.02, clearance=2e-4, pressure_drop=2e6, viscosity=1e-3, density=1000.0
)
RISE = rf.SpeedProfile(times=(0.0, TIME), speeds=(150.0, 250.0))


def rigid(speed: Any = 200.0) -> rf.RigidShaft:
    """Return a rigid shaft of two journals, which turns and has a gyroscopic effect."""
    return rf.RigidShaft(
        mass=40.0,
        diametral_inertia=1.2,
        polar_inertia=0.9,
        stations=(("left", -0.3), ("right", 0.4)),
        unbalances=((0.1, 1e-3, 0.0),),
        speed=speed,
    )


def cracked(speed: Any = 200.0) -> CrackedRotor:
    """Return a Jeffcott rotor whose crack breathes."""
    rotor = rf.JeffcottRotor(
        mass=20.0, journal_mass=2.0, stiffness=2e7, external_damping=300.0, unbalance=1e-3, speed=speed
    )
    return CrackedRotor(rotor=rotor, crack=JeffcottCrack(reduction=0.3), breathing=GaschHinge(edge=0.8))


def shaken() -> BaseExcitedRotor:
    """Return the rigid shaft on ground that shakes."""
    base = BaseMotion(times=(0.0, 0.5 * TIME, TIME), acceleration_x=(0.0, 40.0, 0.0))
    return BaseExcitedRotor(rotor=rigid(), base=base)


RUNS: dict[str, Callable[[], tuple[Any, Any]]] = {
    "stiffness over frequency": lambda: (rigid(RISE), {"left": SEAL, "right": FILM}),
    "with a mass": lambda: (rigid(), {"left": HEAVY, "right": FILM}),
    "linear": lambda: (rigid(), {"left": SEAL, "right": HEAVY}),
    "seal": lambda: (rigid(), {"left": FILM, "right": ANNULAR}),
    "damper": lambda: (rigid(), {"left": SPRUNG, "right": FILM}),
    "damper, run-up": lambda: (rigid(RISE), {"left": SPRUNG, "right": FILM}),
    "seal in a run-up": lambda: (rigid(RISE), {"left": FILM, "right": ANNULAR}),
    "damper alone": lambda: (rf.RigidRotor(mass=20.0, speed=200.0, unbalance=1e-3), SPRUNG),
    "mass alone": lambda: (rf.RigidRotor(mass=20.0, speed=200.0, unbalance=1e-3), HEAVY),
    "mass on shaking ground": lambda: (shaken(), {"left": HEAVY, "right": FILM}),
    "crack": lambda: (cracked(), FILM),
    "crack, run-up": lambda: (cracked(RISE), FILM),
}


@pytest.mark.parametrize("name", RUNS)
def test_compiled_run_is_that_of_scipy(name: str) -> None:
    rotor, bearings = RUNS[name]()
    times = np.linspace(0.0, TIME, 9)
    run = simulate(rotor, bearings, duration=TIME, times=times, rtol=1e-9)
    wanted = simulate(rotor, bearings, duration=TIME, times=times, rtol=1e-8, method=Radau)
    assert "rejected" in run.work
    assert "rejected" not in wanted.work
    assert set(run.signals) == set(wanted.signals)
    for key, row in wanted.signals.items():
        part = 1e-4 if "force" in key else 3e-6
        assert run[key] == pytest.approx(row, abs=part * max(np.abs(row).max(), 1e-9)), key
    assert run.units == wanted.units


def test_states_of_bearings_are_in_order_in_several_levels() -> None:
    start = 1e-5 * np.arange(1.0, 13.0)
    first, last = mount(rigid(), {"right": SEAL}), {"left": HEAVY}
    run = simulate_rotor(mount(first, last), duration=TIME, samples=3, initial_state=start)
    swapped = np.concatenate([start[:8], start[10:], start[8:10]])
    bearings = {"left": HEAVY, "right": SEAL}
    wanted = simulate(rigid(), bearings, duration=TIME, samples=3, initial_state=swapped, method=Radau)
    assert run["left_y"] == pytest.approx(wanted["left_y"], rel=1e-5)


def test_a_seal_beside_springs_has_a_wall() -> None:
    fast = [0.0] * 6 + [0.6, 0.0]
    bearings = {"left": rf.LinearBearing(stiffness=5e4, damping=100.0), "right": ANNULAR}
    with pytest.raises(ContactError, match=r"at t = 0\.000391"):
        simulate(rigid(), bearings, duration=0.02, initial_state=fast)


LARGE = rf.AnnularSeal(
    radius=0.2, length=0.1, clearance=3e-4, pressure_drop=2e6, viscosity=1e-3, density=1000.0
)


@pytest.mark.parametrize("inner", ["left", "right"])
def test_forces_in_two_levels_are_those_of_all_bearings_at_once(inner: str) -> None:
    bearings = {"left": rf.LinearBearing(stiffness=5e6, damping=2e3), "right": LARGE}
    outer = {station: each for station, each in bearings.items() if station != inner}
    run, wanted = (
        simulate(rotor, films, duration=TIME, times=[0.5 * TIME, TIME], method=Radau)
        for rotor, films in ((mount(rigid(), {inner: bearings[inner]}), outer), (rigid(), bearings))
    )
    for name in ("left_force_y", "right_force_y"):
        assert run[name] == pytest.approx(wanted[name], rel=1e-5)


@pytest.mark.parametrize("method", [None, Radau])
def test_a_run_without_samples_has_the_signals_of_any_other(method: Any) -> None:
    bearings = {"left": HEAVY, "right": FILM}
    none, some = (
        simulate(rigid(), bearings, duration=1e-4, times=times, method=method) for times in ([], [1e-4])
    )
    assert list(none.signals) == list(some.signals)
    assert not none.time.size
