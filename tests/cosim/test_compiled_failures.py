"""The loop over macro steps in C: warnings, failures, counted calls, interrupts."""

import signal
import sys
import warnings
from collections import Counter
from ctypes import CFUNCTYPE, c_double, c_int, c_void_p, cast

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from studies.master_cases import BEARING, CLEARANCE, ROTOR, STEP, PythonGaussSeidel, rotor_at

from rotorfilm import CouplingError, FmuError, ValidityWarning
from rotorfilm.cosim import GaussSeidel, InProcessSlave, SIExp3, cosimulate, couple
from rotorfilm.cosim.compiled_loop import MOST_CHUNK
from rotorfilm.cosim.slaves import Call
from rotorfilm.fmu import export_fmu
from rotorfilm.fmu.instance import Instance

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")


def test_beyond_the_verified_range_is_told_as_in_python(outcome):
    rotor = rotor_at(0.6, 0.2, position=(0.0, 0.985 * CLEARANCE))
    told = []
    for scheme in (GaussSeidel(), PythonGaussSeidel()):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            outcome(rotor, BEARING, macro_step=0.1 * STEP, duration=2 * STEP, scheme=scheme)
        told.append([str(w.message) for w in caught if issubclass(w.category, ValidityWarning)])
    assert told[0]
    assert told[0][0] == told[1][0]


def test_a_journal_at_the_wall_leaves_what_was_computed(native_fmus, outcome):
    """The film answers fmi2Error mid-run."""
    arguments = {"macro_step": STEP, "duration": 360 * STEP}
    (run, told), (plain, expected) = (
        outcome(native_fmus["thrown"], native_fmus["film"], **arguments, scheme=scheme)
        for scheme in (GaussSeidel(), PythonGaussSeidel())
    )
    assert "inside the clearance" in told
    assert told == expected
    assert run.trajectory.time.size > 1
    assert run.trajectory.work == plain.trajectory.work
    for name, series in plain.trajectory.signals.items():
        assert_array_equal(run.trajectory[name], series, err_msg=name)


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


def test_chatter_ends_a_run_where_it_ends_in_python(outcome):
    arguments = {"macro_step": 30 * STEP, "duration": 4000 * STEP}
    (run, told), (plain, expected) = (
        outcome(ROTOR, BEARING, **arguments, scheme=scheme) for scheme in (GaussSeidel(), PythonGaussSeidel())
    )
    assert "without decaying" in told
    assert run.trajectory.time.size == plain.trajectory.time.size < 33
    assert run.trajectory.work == plain.trajectory.work
    assert told == expected


def test_calls_of_fmus_per_macro_step_are_counted(native_fmus, compiled):
    """One of each for a step; of the distance from the limit 5 + 6 derivatives in each eighth."""
    steps = 800
    cosimulate(native_fmus["held"], native_fmus["film"], macro_step=STEP, duration=steps * STEP)
    rotor, film = compiled[0].calls()
    for calls in (rotor, film):
        assert {call: calls[call] for call in (Call.PUT, Call.TAKE, Call.STRIDE)} == dict.fromkeys(
            (Call.PUT, Call.TAKE, Call.STRIDE), steps
        )
    assert film[Call.SLOPE] == 5 * steps // 8
    assert rotor[Call.SLOPE] == (4 + 2) * steps // 8
    cosimulate(
        native_fmus["law"], native_fmus["film"], macro_step=STEP, duration=steps * STEP, scheme=SIExp3()
    )
    film = compiled[1].calls()[1]
    assert film[Call.SLOPE] == 5 * steps
    assert film[Call.STRIDE] == steps


def test_a_run_is_interrupted_between_chunks(native_fmus):
    """What was told by then is a few chunks at most, of a run of a hundred."""
    told = []

    def stop(time):
        told.append(time)
        if len(told) == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        cosimulate(
            native_fmus["held"],
            native_fmus["film"],
            macro_step=STEP,
            duration=100 * MOST_CHUNK * STEP,
            progress=stop,
        )
    assert len(told) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="no timer there")
def test_a_signal_interrupts_a_long_run(native_fmus):
    def stop(number, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(KeyboardInterrupt):
            cosimulate(native_fmus["held"], native_fmus["film"], macro_step=1e-3 * STEP, duration=1e4 * STEP)
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
