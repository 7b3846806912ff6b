"""The loop over macro steps in C beside the same in Python: trajectories, work, failures, interrupts."""

import signal
import sys
import warnings
from collections import Counter
from ctypes import CFUNCTYPE, c_double, c_int, c_void_p, cast
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotorfilm.bearings.damper import MapSqueeze, PorousCage, PorousDamper
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.bearings.journal.bearing import JournalBearing
from rotorfilm.bearings.sprung import Sprung
from rotorfilm.cosim import GaussSeidel, InProcessSlave, Jacobi, SIExp, SIExp3, cosim_run, cosimulate, couple
from rotorfilm.cosim.loops.compiled_loop import MOST_CHUNK
from rotorfilm.errors import CouplingError, FmuError, PartialResultError, ValidityWarning
from rotorfilm.fmu import export_fmu
from rotorfilm.fmu.check.calls import Instance
from rotorfilm.native.master_structs import Call
from rotorfilm.rotors import LawRotor, RigidRotor, RigidShaft, SpeedProfile, mount

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.errors.CouplingWarning")

SPEED, CLEARANCE = 157.0, 1e-4
STEP = np.radians(1.0) / SPEED
BEARING = JournalBearing(radius=0.05, length=0.05, clearance=CLEARANCE, viscosity=0.05, film=MapFilm())
RAMP = SpeedProfile(times=(0.0, 0.0031, 0.02), speeds=(140.0, 157.0, 120.0))


@dataclass(frozen=True, kw_only=True)
class PythonGaussSeidel(GaussSeidel):
    """The same, of a class that the loop in C does not know."""


@dataclass(frozen=True, kw_only=True)
class PythonJacobi(Jacobi):
    """The same."""


@dataclass(frozen=True)
class PythonSIExp(SIExp):
    """The same."""


@dataclass(frozen=True)
class PythonSIExp3(SIExp3):
    """The same."""


EXPLICIT = [
    (kind(degree=degree), plain(degree=degree))
    for kind, plain in ((GaussSeidel, PythonGaussSeidel), (Jacobi, PythonJacobi))
    for degree in range(3)
]
IMPLICIT = [(SIExp(), PythonSIExp()), (SIExp3(), PythonSIExp3())]


def label(pair):
    return pair[0].label if isinstance(pair, tuple) else str(pair)


def rotor_at(eccentricity, unbalance, **changes):
    load = -BEARING.force((eccentricity * CLEARANCE, 0.0), (0.0, 0.0), SPEED)
    mass = float(np.hypot(*load)) / (CLEARANCE * SPEED**2)
    rotor = RigidRotor(
        mass=mass,
        speed=SPEED,
        unbalance=unbalance * CLEARANCE * mass,
        gravity=(0.0, 0.0),
        static_force=tuple(load),
        position=(eccentricity * CLEARANCE, 0.0),
    )
    return replace(rotor, **changes)


ROTOR = rotor_at(0.6, 0.2)


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def fmus(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmus")
    models = {
        "film": BEARING,
        "held": ROTOR,
        "law": LawRotor(rotor=rotor_at(0.6, 0.2, speed=RAMP)),
        "thrown": rotor_at(0.6, 0.2, velocity=(0.0, -0.6)),
    }
    return {
        name: export_fmu(model, folder / f"{name}.fmu", request.param, "native", component=name)
        for name, model in models.items()
    }


@pytest.fixture
def compiled(monkeypatch):
    """Return a list to which each run adds its part in C, or nothing for one in Python."""
    made, make = [], cosim_run.compiled_run
    monkeypatch.setattr(cosim_run, "compiled_run", lambda *given: made.append(make(*given)) or made[-1])
    return made


def outcome(*partners, **arguments):
    """Return the run, complete or not, and what it was stopped by."""
    try:
        return cosimulate(*partners, **arguments), ""
    except PartialResultError as error:
        return error.partial, str(error)


def require_equal(found, expected):
    assert_array_equal(found.trajectory.time, expected.trajectory.time)
    assert list(found.trajectory.signals) == list(expected.trajectory.signals)
    for name, series in expected.trajectory.signals.items():
        assert_array_equal(found.trajectory[name], series, err_msg=name)
    assert found.trajectory.work == expected.trajectory.work
    assert found.coupling == expected.coupling
    assert found.watch.explicit_ratio == pytest.approx(expected.watch.explicit_ratio, rel=1e-12)
    assert found.watch.local_error == pytest.approx(expected.watch.local_error, rel=1e-12)


@pytest.mark.parametrize("pair", EXPLICIT, ids=label)
def test_fmus_take_the_same_steps_to_the_last_bit(pair, fmus, compiled):
    """Held forces and extrapolated ones, 1000 steps, the last one shorter."""
    rotor = fmus["held" if pair[0].degree == 0 else "law"]
    runs = [
        outcome(rotor, fmus["film"], macro_step=STEP, duration=1000.3 * STEP, scheme=scheme)[0]
        for scheme in pair
    ]
    assert [part is None for part in compiled] == [False, True]
    require_equal(*runs)
    assert runs[0].trajectory.work["film_jacobians"] >= 1


def distance(found, expected):
    """Return the largest difference of a signal, relative to its largest value."""
    pairs = [(found.trajectory[name], series) for name, series in expected.trajectory.signals.items()]
    return max(float(np.abs(own - series).max() / np.abs(series).max()) for own, series in pairs)


@pytest.mark.parametrize("pair", IMPLICIT, ids=label)
@pytest.mark.parametrize("kind", ["law", "held"])
def test_linearly_implicit_steps_of_fmus_agree_to_roundoff(pair, kind, fmus):
    """With the law as inputs of the FMU, and integrated by the master."""
    runs = [
        cosimulate(fmus[kind], fmus["film"], macro_step=4 * STEP, duration=200 * STEP, scheme=scheme)
        for scheme in pair
    ]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert distance(*runs) < 50 * 1e-13


@pytest.mark.parametrize("pair", [*EXPLICIT, *IMPLICIT], ids=label)
def test_steps_from_equal_states_agree_to_1e_13(pair):
    """Two macro steps of 4 degrees each: with the second, what the first left over counts."""
    random = np.random.default_rng(3)
    for _ in range(10):
        place, rate = random.uniform(-0.5, 0.5, (2, 2)) * CLEARANCE
        rotor = replace(ROTOR, position=tuple(place), velocity=tuple(rate * SPEED))
        found, expected = (
            outcome(rotor, BEARING, macro_step=4 * STEP, duration=8 * STEP, scheme=scheme)[0].trajectory
            for scheme in pair
        )
        assert_allclose(found.position / CLEARANCE, expected.position / CLEARANCE, rtol=0.0, atol=1e-13)
        scale = CLEARANCE * SPEED
        assert_allclose(found.velocity / scale, expected.velocity / scale, rtol=0.0, atol=1e-13)


def test_models_with_kernels_go_through_c_and_others_do_not(compiled, make_spring_damper):
    arguments = {"macro_step": STEP, "duration": 4 * STEP}
    cosimulate(ROTOR, BEARING, **arguments)
    cosimulate(ROTOR, make_spring_damper(1e6, 1e4), **arguments)
    assert [part is None for part in compiled] == [False, True]


@pytest.mark.parametrize("pair", [EXPLICIT[2], IMPLICIT[1]], ids=label)
def test_a_ramp_of_the_speed_stops_at_its_kinks(pair):
    rotor = rotor_at(0.6, 0.2, speed=RAMP)
    runs = [cosimulate(rotor, BEARING, macro_step=1e-4, duration=0.025, scheme=scheme) for scheme in pair]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert distance(*runs) < 1e-9  # the rotor's integration


def test_a_rotor_that_is_not_linear_is_integrated_in_python(compiled):
    shaft = RigidShaft(
        mass=60.0,
        diametral_inertia=4.0,
        polar_inertia=0.6,
        speed=SPEED,
        unbalances=((0.1, 1.5e-3, 0.0),),
        stations=(("left", -0.4), ("right", 0.3)),
    )
    half = mount(shaft, {"left": BEARING})
    runs = [
        outcome(half, {"right": BEARING}, macro_step=4 * STEP, duration=40 * STEP, scheme=scheme)[0]
        for scheme in IMPLICIT[1]
    ]
    assert [part is None for part in compiled] == [False, True]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert distance(*runs) < 1e-7  # of the rotor's integration, whose matrices are taken at other times


def test_a_damper_at_rest_counts_as_held():
    """It has no derivative where it starts: neither in C nor in Python."""
    cage = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
    film = PorousDamper(
        radius=0.05, length=0.02, clearance=CLEARANCE, viscosity=0.02, cage=cage, film=MapSqueeze()
    )
    damper = Sprung(reaction=film, stiffness=5e6)
    rotor = RigidRotor(mass=20.0, speed=SPEED, unbalance=2e-4, gravity=(0.0, 0.0))
    runs = [
        cosimulate(rotor, damper, macro_step=4 * STEP, duration=100 * STEP, scheme=scheme)
        for scheme in IMPLICIT[1]
    ]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert distance(*runs) < 1e-11


def test_beyond_the_verified_range_is_told_as_in_python():
    rotor = rotor_at(0.6, 0.2, position=(0.0, 0.985 * CLEARANCE))
    told = []
    for scheme in (GaussSeidel(), PythonGaussSeidel()):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            outcome(rotor, BEARING, macro_step=0.1 * STEP, duration=2 * STEP, scheme=scheme)
        told.append([str(w.message) for w in caught if issubclass(w.category, ValidityWarning)])
    assert told[0]
    assert told[0][0] == told[1][0]


def test_a_journal_at_the_wall_leaves_what_was_computed(fmus):
    """The film answers fmi2Error mid-run."""
    arguments = {"macro_step": STEP, "duration": 360 * STEP}
    (run, told), (plain, expected) = (
        outcome(fmus["thrown"], fmus["film"], **arguments, scheme=scheme)
        for scheme in (GaussSeidel(), PythonGaussSeidel())
    )
    assert "inside the clearance" in told
    assert told == expected
    assert run.trajectory.time.size > 1
    require_equal(run, plain)


def failing(monkeypatch, call, at, status):
    """Have an FMU's function answer a status when it is called for the n-th time."""
    entry, kept, count = Instance.entry, [], Counter()

    def patched(instance):
        version, component, functions = entry(instance)
        kind = CFUNCTYPE(c_int, c_void_p, c_double, c_double, c_int)
        true = cast(functions[call], kind)

        def step(component, t, dt, keeps):
            count[component] += 1
            return status if count[component] == at else true(component, t, dt, keeps)

        kept.append(kind(step))
        return version, component, {**functions, call: cast(kept[-1], c_void_p).value}

    monkeypatch.setattr(Instance, "entry", patched)


@pytest.mark.parametrize(("status", "word"), [(2, "discard"), (3, "error")])
def test_a_step_that_fails_mid_run_leaves_what_was_computed(status, word, monkeypatch, tmp_path):
    paths = [
        export_fmu(model, tmp_path / f"{name}.fmu", "2.0", "native", component=name)
        for name, model in {"rotor": ROTOR, "film": BEARING}.items()
    ]
    whole = cosimulate(*paths, macro_step=STEP, duration=200 * STEP)
    failing(monkeypatch, "stride", 101, status)
    with pytest.raises(
        FmuError, match=rf"failed in the step from t = .*fmi2DoStep.*{status} \({word}"
    ) as caught:
        cosimulate(*paths, macro_step=STEP, duration=200 * STEP)
    partial = caught.value.partial.trajectory
    assert partial.time.size == 101  # the start and 100 steps
    assert_array_equal(partial["x"], whole.trajectory["x"][:101])
    assert partial.work["steps"] == 100


def test_chatter_ends_a_run_where_it_ends_in_python():
    arguments = {"macro_step": 30 * STEP, "duration": 4000 * STEP}
    (run, told), (plain, expected) = (
        outcome(ROTOR, BEARING, **arguments, scheme=scheme) for scheme in (GaussSeidel(), PythonGaussSeidel())
    )
    assert "without decaying" in told
    assert run.trajectory.time.size == plain.trajectory.time.size < 33
    assert run.trajectory.work == plain.trajectory.work
    assert told == expected


def test_calls_of_fmus_per_macro_step_are_counted(fmus, compiled):
    """One of each for a step; of the distance from the limit 5 + 6 derivatives in each eighth."""
    steps = 800
    cosimulate(fmus["held"], fmus["film"], macro_step=STEP, duration=steps * STEP)
    rotor, film = compiled[0].loop.calls()
    for calls in (rotor, film):
        assert {call: calls[call] for call in (Call.PUT, Call.TAKE, Call.STRIDE)} == dict.fromkeys(
            (Call.PUT, Call.TAKE, Call.STRIDE), steps
        )
    assert film[Call.SLOPE] == 5 * steps // 8
    assert rotor[Call.SLOPE] == (4 + 2) * steps // 8
    cosimulate(fmus["law"], fmus["film"], macro_step=STEP, duration=steps * STEP, scheme=SIExp3())
    film = compiled[1].loop.calls()[1]
    assert film[Call.SLOPE] == 5 * steps
    assert film[Call.STRIDE] == steps


def test_a_run_is_interrupted_between_chunks(fmus):
    """What was told by then is a few chunks at most, of a run of a hundred."""
    told = []

    def stop(time):
        told.append(time)
        if len(told) == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        cosimulate(
            fmus["held"], fmus["film"], macro_step=STEP, duration=100 * MOST_CHUNK * STEP, progress=stop
        )
    assert len(told) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="no timer there")
def test_a_signal_interrupts_a_long_run(fmus):
    def stop(number, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(KeyboardInterrupt):
            cosimulate(fmus["held"], fmus["film"], macro_step=1e-3 * STEP, duration=1e4 * STEP)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_progress_is_told_of_every_step_in_order():
    told = []
    couple(
        InProcessSlave(ROTOR),
        InProcessSlave(BEARING),
        macro_step=STEP,
        duration=500 * STEP,
        progress=told.append,
    )
    assert_allclose(told, STEP * np.arange(1, 501), rtol=1e-12)
    with pytest.raises(CouplingError):
        couple(InProcessSlave(ROTOR), InProcessSlave(BEARING), macro_step=30 * STEP, duration=4000 * STEP)
