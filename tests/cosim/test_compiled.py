"""The loop over macro steps in C beside the same in Python: trajectories and work."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from studies.master_cases import (
    BEARING,
    CLEARANCE,
    EXPLICIT,
    IMPLICIT,
    RAMP,
    REPEATING,
    ROTOR,
    SPEED,
    STEP,
    PythonNewton,
    rotor_at,
)

from rotorfilm import with_springs
from rotorfilm.bearings.damper import MapSqueeze, PorousCage, PorousDamper
from rotorfilm.cosim import Adaptive, Newton, SIMemory, cosimulate
from rotorfilm.fmu.instance import Instance
from rotorfilm.rotors import RigidRotor, RigidShaft, mount

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")


def label(pair):
    return pair[0].label if isinstance(pair, tuple) else str(pair)


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
def test_fmus_take_the_same_steps_to_the_last_bit(pair, native_fmus, compiled, outcome):
    """Held forces and extrapolated ones, 1000 steps, the last one shorter."""
    rotor = native_fmus["held" if pair[0].degree == 0 else "law"]
    runs = [
        outcome(rotor, native_fmus["film"], macro_step=STEP, duration=1000.3 * STEP, scheme=scheme)[0]
        for scheme in pair
    ]
    assert [part is None for part in compiled] == [False, True]
    require_equal(*runs)
    assert runs[0].trajectory.work["film_jacobians"] >= 1


def distance(found, expected):
    """Return the largest difference of a signal, relative to its largest value."""
    pairs = [(found.trajectory[name], series) for name, series in expected.trajectory.signals.items()]
    return max(float(np.abs(own - series).max() / np.abs(series).max()) for own, series in pairs)


@pytest.mark.parametrize("pair", [*IMPLICIT, *REPEATING], ids=label)
@pytest.mark.parametrize("kind", ["law", "held"])
def test_linearly_implicit_steps_of_fmus_agree_to_roundoff(pair, kind, native_fmus, compiled):
    """With the law as inputs of the FMU, and integrated by the master; FMUs go back to their states.

    The length of an adaptive step multiplies roundoff, so that these runs are short.
    """
    steps, limit = (28, 1e-6) if pair in REPEATING[1:] else (200, 50 * 1e-13)
    duration, film = steps * STEP, native_fmus["film"]
    runs = [
        cosimulate(native_fmus[kind], film, macro_step=4 * STEP, duration=duration, scheme=scheme)
        for scheme in pair
    ]
    assert [part is None for part in compiled] == [False, True]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert (runs[0].trajectory.work["rollbacks"] > 0) == (pair in REPEATING)
    assert distance(*runs) < limit


@pytest.mark.parametrize("pair", [*EXPLICIT, *IMPLICIT, REPEATING[0]], ids=label)
def test_steps_from_equal_states_agree_to_1e_13(pair, outcome):
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


def test_adaptive_steps_of_what_c_does_not_know_run_in_python(compiled):
    for inner in (SIMemory(), Newton(), Adaptive(tolerance=1e-5)):
        cosimulate(ROTOR, BEARING, macro_step=STEP, duration=3 * STEP, scheme=Adaptive(scheme=inner))
    assert compiled == [None] * 3


def test_fmus_whose_states_cannot_be_freed_run_in_python(native_fmus, compiled, monkeypatch):
    """FMI asks for this function; without it, a call from C would end the process."""
    whole = Instance.entry

    def entry(self):
        version, component, functions = whole(self)
        return version, component, {k: v for k, v in functions.items() if k != "forget"}

    monkeypatch.setattr(Instance, "entry", entry)
    pair = native_fmus["law"], native_fmus["film"]
    for scheme in (Newton(), SIMemory()):
        cosimulate(*pair, macro_step=STEP, duration=3 * STEP, scheme=scheme)
    assert [part is None for part in compiled] == [True, False]


def test_a_step_that_newton_cannot_end_is_told_as_in_python(native_fmus, outcome):
    """Python takes such a step again, from the same states."""
    found, expected = (
        outcome(
            native_fmus["law"],
            native_fmus["film"],
            macro_step=40 * STEP,
            duration=400 * STEP,
            scheme=kind(tolerance=1e-9, most=4),
        )
        for kind in (Newton, PythonNewton)
    )
    assert "must converge in 4 iterations, got stuck at t = 0 s" in found[1]
    assert found[1] == expected[1]
    assert found[0].trajectory.work == expected[0].trajectory.work


@pytest.mark.parametrize("pair", [EXPLICIT[2], IMPLICIT[1], REPEATING[1]], ids=label)
def test_a_ramp_of_the_speed_stops_at_its_kinks(pair):
    rotor = rotor_at(0.6, 0.2, speed=RAMP)
    runs = [cosimulate(rotor, BEARING, macro_step=1e-4, duration=0.025, scheme=scheme) for scheme in pair]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    # That of the rotor's integration; lengths that adapt multiply roundoff.
    assert distance(*runs) < (1e-7 if pair is REPEATING[1] else 1e-8)


@pytest.mark.long
def test_a_rotor_that_is_not_linear_is_integrated_in_python(compiled, outcome):
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
    damper = with_springs(film, 5e6)
    rotor = RigidRotor(mass=20.0, speed=SPEED, unbalance=2e-4, gravity=(0.0, 0.0))
    runs = [
        cosimulate(rotor, damper, macro_step=4 * STEP, duration=100 * STEP, scheme=scheme)
        for scheme in IMPLICIT[1]
    ]
    assert runs[0].trajectory.work == runs[1].trajectory.work
    assert distance(*runs) < 1e-11
