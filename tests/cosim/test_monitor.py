"""The monitor on generated runs, its warnings, and what it says of the distance from the limit."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose
from studies.coupling_cases import coupling_cases

from rotorfilm import CouplingError, PartialResultError
from rotorfilm.core import CouplingWarning
from rotorfilm.cosim import GaussSeidel, InProcessSlave, Jacobi, SIExp3, cosimulate, couple
from rotorfilm.rotors import RigidRotor
from rotorfilm.studies.coupling_cost import limit_case

COUNT = 6  # of each kind here; 100 in benchmarks/coupling_monitor.py


def outcome(case):
    try:
        return "", couple(
            InProcessSlave(case.rotor),
            InProcessSlave(case.bearing),
            macro_step=case.macro_step,
            duration=case.duration,
            scheme=case.scheme,
        )
    except PartialResultError as error:
        return str(error), error.partial


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")
def test_every_bad_run_is_found():
    for case in coupling_cases(COUNT, bad=True):
        stopped, result = outcome(case)
        assert stopped
        assert result.watch.warnings
        assert case.factor > 1.05


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")
def test_no_good_run_is_stopped():
    for case in coupling_cases(COUNT - 1, bad=False):
        stopped, result = outcome(case)
        assert stopped == ""
        assert case.orbit_error(result.trajectory) < 0.1


def test_cases_are_the_same_for_the_same_seed():
    first, again = (coupling_cases(2, bad=True, seed=5) for _ in range(2))
    other = coupling_cases(2, bad=True, seed=6)
    assert [case.macro_step for case in first] == [case.macro_step for case in again]
    assert [case.macro_step for case in first] != [case.macro_step for case in other]


@pytest.mark.closed_form
def test_the_distance_from_the_limit_is_step_times_damping_over_mass(make_spring_damper):
    rotor = RigidRotor(mass=3.0, speed=1.0, gravity=(0.0, 0.0), velocity=(1.0, 0.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        calm = couple(
            InProcessSlave(rotor), InProcessSlave(make_spring_damper(1.0, 4.0)), macro_step=0.1, duration=20.0
        )
    assert_allclose(calm.watch.explicit_ratio, 0.1 * 4.0 / 3.0, rtol=1e-12)
    assert calm.watch.warnings == ()
    damper = InProcessSlave(make_spring_damper(1.0, 4.0))
    with (
        pytest.warns(CouplingWarning, match=r"mass is 1.33, near or beyond the stability limit 2 of Gauss"),
        pytest.raises(CouplingError, match="more than Gauss-Seidel 0 foresees"),
    ):
        couple(InProcessSlave(rotor), damper, macro_step=1.0, duration=20.0)


@pytest.mark.parametrize(("damping", "warned"), [(0.0, False), (1e-8, False), (1e-3, True)])
def test_a_swing_without_damping_is_not_said_to_be_stable(make_spring_damper, damping, warned):
    """Held forces make every spring grow, by k h^2/2m a step; only of one that would decay is it warned."""
    rotor = RigidRotor(mass=1.0, speed=1.0, gravity=(0.0, 0.0), velocity=(1.0, 0.0))
    spring, h = InProcessSlave(make_spring_damper(1.0, damping)), 0.05
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CouplingWarning)
        watch = couple(InProcessSlave(rotor), spring, macro_step=h, duration=20 * h).watch
    assert watch.spectral_radius - 1.0 == pytest.approx(0.5 * h * (0.5 * h - damping), rel=0.1)
    assert [one.startswith("at t = 0 s the coupling grows by") for one in watch.warnings] == [True] * warned


def test_a_run_past_the_limit_is_warned_of_at_once_and_stopped():
    rotor, bearing, _ = limit_case(0.7)
    step = 1.2 * np.radians(14.75) / 157.0
    from rotorfilm.studies.coupling_cost import nudged

    moved = nudged(rotor, 1e-3 * bearing.clearance)
    with (
        pytest.warns(CouplingWarning, match=r"at t = 0 s the coupling grows by a factor of 1\.\d+ per macro"),
        pytest.raises(CouplingError, match="without decaying") as caught,
    ):
        cosimulate(moved, bearing, macro_step=step, duration=400 * step)
    partial = caught.value.partial
    assert 12 < partial.trajectory.time.size < 120
    assert partial.watch.spectral_radius > 1.2


def test_linearly_implicit_schemes_are_not_warned_of_and_tell_their_local_error(nondimensional):
    case = nondimensional(0.7, unbalance=0.3)
    errors = []
    for degrees in (10.0, 5.0):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            run = couple(
                InProcessSlave(case.rotor),
                InProcessSlave(case.film),
                macro_step=np.radians(degrees),
                duration=2.0 * np.pi,
                scheme=SIExp3(),
            )
        errors.append(run.watch.local_error)
    assert_allclose(np.log2(errors[0] / errors[1]), 2.0, atol=0.3)  # D is of second order


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")
def test_local_error_of_a_held_force_is_its_increment(nondimensional):
    case = nondimensional(0.5, unbalance=0.3)
    for scheme in (GaussSeidel(), Jacobi()):
        run = couple(
            InProcessSlave(case.rotor),
            InProcessSlave(case.film),
            macro_step=np.radians(2.0),
            duration=2.0 * np.pi,
            scheme=scheme,
        )
        force = np.stack([run.trajectory["force_x"], run.trajectory["force_y"]])
        expected = np.sqrt(np.sum(np.diff(force) ** 2) / np.sum(force**2))
        assert_allclose(run.watch.local_error, expected, rtol=1e-9)


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")
def test_a_thrown_journal_without_chatter_is_no_answer(nondimensional):
    """At eps .9 thrown by unbalance: no alternation, but the force changes by half within single steps."""
    case = nondimensional(0.9, unbalance=0.2)
    with pytest.raises(CouplingError, match="more than Gauss-Seidel 0 foresees") as caught:
        couple(
            InProcessSlave(case.rotor),
            InProcessSlave(case.film),
            macro_step=np.radians(5.0),
            duration=4.0 * np.pi,
        )
    assert not caught.value.partial.coupling.chatter
