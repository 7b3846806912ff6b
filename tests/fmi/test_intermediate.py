"""FMI 3.0 Co-Simulation: what an FMU shows of the steps within one, and where it ends one early."""

from contextlib import contextmanager

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave

from rotorfilm import JournalBearing
from rotorfilm.fmu import export_fmu, extracted
from rotorfilm.rotors import RigidRotor, mount

MASS, SPEED, UNBALANCE = 50.0, 157.0, 8e-4
ROTOR = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, gravity=(0.0, 0.0))
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
SYSTEM = mount(RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, position=(3e-5, -3e-5)), {"": BEARING})
STEP = 0.02
OUTPUTS = ("x", "y", "vx", "vy")


@contextmanager
def running(path, update=None, early=False):
    """Yield an instance in step mode at t = 0, and the references of the outputs."""
    with extracted(path) as (description, folder):
        fmu = FMU3Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="a",
        )
        references = {v.name.partition(".")[2]: v.valueReference for v in description.modelVariables}
        fmu.instantiate(intermediateUpdate=update, earlyReturnAllowed=early)
        try:
            fmu.enterInitializationMode()
            fmu.exitInitializationMode()
            yield fmu, references
            fmu.terminate()
        finally:
            fmu.freeInstance()


@pytest.fixture(scope="module", params=[ROTOR, SYSTEM], ids=["explicit", "stiff"])
def path(request, tmp_path_factory):
    return export_fmu(request.param, tmp_path_factory.mktemp("fmu") / "a.fmu", "3.0", component="part")


@pytest.fixture(scope="module")
def rotor(tmp_path_factory):
    return export_fmu(ROTOR, tmp_path_factory.mktemp("fmu") / "rotor.fmu", "3.0", component="part")


def orbit(t):
    """Return x, y, vx, vy of a free rotor with unbalance, from rest."""
    r, turn = UNBALANCE / MASS, SPEED * t
    place = [r * (1.0 - np.cos(turn)), r * (turn - np.sin(turn))]
    return [*place, r * SPEED * np.sin(turn), r * SPEED * (1.0 - np.cos(turn))]


@pytest.mark.closed_form
def test_the_outputs_of_each_step_within_one_are_those_of_its_time(rotor):
    seen = []

    def update(_, time, set_requested, get_allowed, finished, early, *wish):
        assert (set_requested, get_allowed, finished, early) == (False, True, True, False)
        seen.append((time, fmu.getFloat64([references[name] for name in OUTPUTS])))

    with running(rotor, update) as (fmu, references):
        assert fmu.doStep(0.0, STEP) == (False, False, False, STEP)
    times = [time for time, _ in seen]
    assert len(times) > 5
    assert times == sorted(set(times))
    assert times[0] > 0.0
    assert times[-1] < STEP
    scale = np.abs(orbit(STEP))
    for time, values in seen:
        np.testing.assert_allclose(values / scale, orbit(time) / scale, atol=1e-8)


def test_who_looks_changes_nothing(path):
    def end(update):
        with running(path, update) as (fmu, references):
            looking.update(fmu=fmu, outputs=[references[name] for name in OUTPUTS])
            fmu.doStep(0.0, STEP)
            fmu.doStep(STEP, STEP)
            return fmu.getFloat64(looking["outputs"])

    looking = {}
    assert end(lambda *told: looking["fmu"].getFloat64(looking["outputs"])) == end(None)


@pytest.mark.closed_form
def test_a_step_ends_where_its_host_wants(rotor):
    wanted = 0.0123

    def update(_, time, set_requested, get_allowed, finished, early, leave, when):
        assert early
        if time < wanted:
            leave[0], when[0] = True, wanted

    with running(rotor, update, early=True) as (fmu, references):
        assert fmu.doStep(0.0, STEP) == (False, False, True, wanted)
        there = fmu.getFloat64([references[name] for name in OUTPUTS])
        np.testing.assert_allclose(there, orbit(wanted), rtol=1e-7)
        assert fmu.doStep(wanted, STEP - wanted) == (False, False, False, STEP)
        there = fmu.getFloat64([references[name] for name in OUTPUTS])
    np.testing.assert_allclose(there, orbit(STEP), rtol=1e-7)


def test_a_step_ends_at_once_where_that_is_wanted(path):
    reached = []

    def update(_, time, set_requested, get_allowed, finished, early, leave, when):
        reached.append(time)
        leave[0], when[0] = True, 0.0

    with running(path, update, early=True) as (fmu, _):
        assert fmu.doStep(0.0, STEP) == (False, False, True, reached[0])
        assert len(reached) == 1


def test_what_was_not_agreed_on_is_no_reason_to_end_early(rotor):
    def update(_, time, set_requested, get_allowed, finished, early, leave, when):
        leave[0], when[0] = True, time

    with running(rotor, update) as (fmu, _):
        assert fmu.doStep(0.0, STEP) == (False, False, False, STEP)


def test_nothing_but_reading_is_allowed_within_a_step(rotor):
    refused = []

    def update(_, time, *told):
        for call in (
            lambda: fmu.setFloat64([references["force_x"]], [1.0]),
            lambda: fmu.doStep(time, STEP),
            fmu.getFMUState,
        ):
            with pytest.raises(FMICallException):
                call()
            refused.append(time)

    with running(rotor, update) as (fmu, references):
        assert fmu.doStep(0.0, STEP)[3] == STEP
        np.testing.assert_allclose(fmu.getFloat64([references["x"]]), orbit(STEP)[0], rtol=1e-7)
    assert refused
