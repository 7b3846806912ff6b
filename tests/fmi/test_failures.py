"""A failing call answers with a status and the values; the process and the other instances go on."""

import gc
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard, fmi2Fatal, fmi2LastSuccessfulTime, fmi2Terminated

from rotorfilm import JeffcottRotor, JournalBearing, RigidRotor, export_fmu, mount

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = RigidRotor(mass=50.0, speed=157.0)
FORCES = ("bearing.force_x", "bearing.force_y")
INSIDE = {"bearing.x": 3e-5, "bearing.y": -4e-5, "bearing.speed": 157.0}
EXPECTED = BEARING.force([3e-5, -4e-5], [0.0, 0.0], 157.0)

WALLED = '''
"""A mass point between walls."""

from dataclasses import dataclass

import numpy as np

from rotorfilm import FilmContactError
from rotorfilm import Linearization
from rotorfilm.core import Signal


@dataclass(frozen=True)
class Walled:
    """dz/dt = input, |z| < 1."""

    inputs = (Signal(name="v", unit="m/s", nominal=1.0, description="velocity"),)
    outputs = (Signal(name="z", unit="m", nominal=1.0, description="position"),)
    states = outputs
    initial_state = np.zeros(1)

    def derivative(self, t, x, u):
        if abs(x[0]) >= 1.0:
            raise FilmContactError(f"z must stay inside 1 m, got {x[0]!r}")
        return np.array([u[0]])

    def output(self, t, x, u):
        return np.array([x[0]]) if u[0] < 100.0 else np.array([np.nan])

    def linearization(self, t, x, u):
        one = np.eye(1)
        return Linearization(0.0 * one, one, one, 0.0 * one)
'''


@pytest.fixture(scope="module")
def film_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("film") / "film.fmu"
    return export_fmu(BEARING, path, backend="python", component="bearing")


@pytest.fixture
def film(load, film_path):
    instance = load(film_path)
    instance.initialize(INSIDE)
    return instance


@pytest.fixture
def walled(write_module, load, tmp_path):
    model = write_module("walled_law", WALLED).Walled()
    return load(export_fmu(model, tmp_path / "walled.fmu", backend="python", component="point"))


def status(call, *arguments):
    """Return the status of a call that fails."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    return caught.value.status


def test_the_wall_is_an_error_with_its_values_in_the_log(film):
    film.set({"bearing.x": 1.2e-4})
    assert status(film.get, *FORCES) == fmi2Fatal
    (logged_status, message) = film.log[-1]
    assert logged_status == fmi2Fatal
    for part in (
        "instance: FilmContactError",
        "bearing.x = 0.00012",
        "bearing.y = -4e-05",
        "clearance 0.0001 m",
    ):
        assert part in message


def test_a_step_at_the_wall_is_an_error_too(film):
    film.set({"bearing.x": 1.2e-4})
    assert status(film.fmu.doStep, 0.0, 1e-3) == fmi2Fatal
    assert "bearing.x = 0.00012" in film.log[-1][1]


def test_a_start_at_the_wall_is_an_error(load, film_path):
    film = load(film_path)
    assert status(film.initialize, {"bearing.y": -1e-4}) == fmi2Fatal


def test_a_failed_instance_keeps_failing(film):
    film.set({"bearing.x": 1.2e-4})
    status(film.get, *FORCES)
    for call, *arguments in (
        (film.set, INSIDE),
        (film.get, *FORCES),
        (film.get, "bearing.x"),
        (film.fmu.doStep, 0.0, 1e-3),
        (film.fmu.getFMUstate,),
    ):
        film.log.clear()
        assert status(call, *arguments) == fmi2Fatal
        assert "bearing.x = 0.00012" in film.log[-1][1]


def test_a_reset_revives_a_failed_instance(film):
    film.set({"bearing.x": 1.2e-4})
    status(film.get, *FORCES)
    film.fmu.reset()
    film.initialize(INSIDE)
    np.testing.assert_allclose(film.get(*FORCES), EXPECTED, rtol=1e-12)


def test_a_saved_state_revives_a_failed_instance(film):
    saved = film.fmu.getFMUstate()
    film.set({"bearing.x": 1.2e-4})
    status(film.get, *FORCES)
    film.fmu.setFMUstate(saved)
    np.testing.assert_allclose(film.get(*FORCES), EXPECTED, rtol=1e-12)
    film.fmu.freeFMUstate(saved)


def test_other_instances_go_on(film, load, film_path):
    other = load(film_path)
    other.initialize(INSIDE)
    film.set({"bearing.x": 1.2e-4})
    status(film.get, *FORCES)
    np.testing.assert_allclose(other.get(*FORCES), EXPECTED, rtol=1e-12)


@pytest.mark.long
def test_many_failures_neither_crash_nor_leak(load, tmp_path):
    path = export_fmu(BEARING, tmp_path / "film.fmu", backend="python", component="counted")
    film = load(path)
    film.initialize()
    film.set({"counted.x": 1.2e-4})
    for _ in range(200):
        status(film.get, "counted.force_x")
    for _ in range(20):
        film.fmu.reset()
        status(film.initialize, {"counted.x": 1.2e-4})
    gc.collect()
    # PythonFMU releases a failed instance twice; without compensation it would be dead, not alone.
    alive = [o for o in gc.get_objects() if str(type(o).__module__).startswith("counted_")]
    assert len(alive) == 1


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_finite_is_named(film, value):
    assert status(film.set, {"bearing.vy": value}) == fmi2Fatal
    assert f"InputError: bearing.vy must be finite, got {value!r}" in film.log[-1][1]


def test_outputs_cannot_be_set(film):
    assert status(film.set, {"bearing.force_x": 1.0}) == fmi2Fatal
    assert "bearing.force_x is a calculated output, it cannot be set" in film.log[-1][1]


def test_states_cannot_be_set_once_it_runs(load, tmp_path):
    rotor = load(export_fmu(ROTOR, tmp_path / "rotor.fmu", backend="python", component="rotor"))
    rotor.initialize()
    assert status(rotor.set, {"rotor.state_x": 1e-5}) == fmi2Fatal
    assert "rotor.state_x is a calculated local" in rotor.log[-1][1]


@pytest.mark.parametrize("reference", [7, 4_000_000])
def test_unknown_references_are_refused(film, reference):
    assert status(film.fmu.getReal, [reference]) == fmi2Fatal
    assert "value reference must be in 0 ... 6" in film.log[-1][1]


def test_variables_of_other_types_are_refused(film):
    assert status(film.fmu.setInteger, [0], [1]) == fmi2Fatal
    assert "must be read and set as reals" in film.log[-1][1]


@pytest.mark.parametrize(("time", "step"), [(0.5, 1e-3), (0.0, -1e-3), (0.0, np.nan), (np.nan, 1e-3)])
def test_a_step_from_elsewhere_is_refused(film, time, step):
    assert status(film.fmu.doStep, time, step) == fmi2Fatal


def test_a_step_before_initialization_is_refused(load, tmp_path):
    rotor = load(export_fmu(ROTOR, tmp_path / "rotor.fmu", backend="python", component="rotor"))
    assert status(rotor.fmu.doStep, 0.0, 1e-3) == fmi2Fatal
    assert "do_step must follow exit_initialization_mode" in rotor.log[-1][1]


def test_a_step_into_the_wall_is_discarded_and_the_state_stays(walled):
    walled.initialize({"point.v": 2.0})
    walled.fmu.doStep(0.0, 0.25)
    assert status(walled.fmu.doStep, 0.25, 0.5) == fmi2Discard
    logged_status, message = walled.log[-1]
    assert logged_status == fmi2Discard
    assert "FilmContactError: z must stay inside 1 m" in message
    assert "point.v = 2.0" in message
    assert walled.fmu.getBooleanStatus(fmi2Terminated)
    assert walled.fmu.getRealStatus(fmi2LastSuccessfulTime) == 0.25
    assert walled.get("point.z")[0] == pytest.approx(0.5, rel=1e-12)
    walled.fmu.doStep(0.25, 0.125)
    assert walled.get("point.z")[0] == pytest.approx(0.75, rel=1e-12)


def test_an_output_that_is_not_finite_is_an_error(walled):
    walled.initialize({"point.v": 0.0})
    walled.set({"point.v": 101.0})
    assert status(walled.get, "point.z") == fmi2Fatal
    assert "output z must be finite, got nan" in walled.log[-1][1]


def test_fmpy_stops_at_the_last_good_time(write_module, tmp_path):
    path = export_fmu(
        write_module("walled_law", WALLED).Walled(), tmp_path / "a.fmu", backend="python", component="point"
    )
    result = fmpy.simulate_fmu(
        str(path), start_values={"point.v": 1.0}, stop_time=2.0, step_size=0.1, output_interval=0.1
    )
    assert result["time"][-1] == pytest.approx(0.9)
    assert result["point.z"][-1] == pytest.approx(0.9)


def unbalanced(load, tmp_path, bearing):
    """Return an instance of the native FMU of a rotor with an unbalance on a journal bearing."""
    rotor = JeffcottRotor(mass=30.0, journal_mass=5.0, stiffness=1e7, speed=157.0, unbalance=1e-3)
    started = load(export_fmu(mount(rotor, {"": bearing}), tmp_path / "rotor.fmu", stop_time=1e-4))
    started.initialize()
    return started


def test_a_used_up_budget_of_steps_is_said_and_shorter_steps_go_on(load, tmp_path):
    rotor = unbalanced(load, tmp_path, BEARING)
    assert status(rotor.fmu.doStep, 0.0, 74.0) == fmi2Discard
    message = rotor.log[-1][1]
    assert "of 74 s within 100000 steps, the most in one call: ask for shorter communication steps" in message
    assert "clearance" not in message
    assert 50.0 < rotor.fmu.getRealStatus(fmi2LastSuccessfulTime) < 74.0
    rotor.fmu.reset()
    rotor.initialize()
    rotor.fmu.doStep(0.0, 37.0)
    rotor.fmu.doStep(37.0, 37.0)


def test_a_journal_that_is_pressed_to_the_wall_is_still_said(load, tmp_path):
    rotor = unbalanced(load, tmp_path, replace(BEARING, viscosity=1e-20))
    assert status(rotor.fmu.doStep, 0.0, 1.0) == fmi2Discard
    assert "its step fell to" in rotor.log[-1][1]
    assert "the journal must stay inside the clearance 0.0001 m" in rotor.log[-1][1]
