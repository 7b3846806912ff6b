"""What an instance answers to right and wrong calls: statuses, messages with values, and nothing changed."""

import struct
import zlib
from contextlib import suppress

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, fmi2LastSuccessfulTime, fmi2Terminated
from fmpy.fmi3 import FMU3Model, FMU3Slave

from rotorfilm import JournalBearing, MapFilm, RigidRotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(mass=50.0, speed=100.0, unbalance=1e-3, position=(1e-5, 2e-5))
START = {"x": 2e-5, "y": -5e-5, "vx": 1e-3, "vy": 2e-3, "speed": 157.0}
INPUTS = list(START)
SLAVES = pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
MODELS = pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
ALL = pytest.mark.parametrize("kind", [FMU2Slave, FMU2Model, FMU3Slave, FMU3Model])
DISCARD, ERROR = 2, 3


def direct(bearing=BEARING, **changes):
    """Return (force_x, force_y) of the Python model."""
    x, y, vx, vy, speed = {**START, **changes}.values()
    return bearing.force([x, y], [vx, vy], speed)


class Refused:
    """A call that must answer a status, with a message that holds some texts."""

    def __init__(self, capsys, status, *texts):
        self.capsys, self.status, self.texts = capsys, status, texts

    def __enter__(self):
        self.capsys.readouterr()

    def __exit__(self, kind, error, trace):
        assert kind is FMICallException, "the call was accepted"
        assert error.status == self.status
        message = self.capsys.readouterr().out
        for text in self.texts:
            assert text in message
        return True


@pytest.fixture
def refused(capsys):
    return lambda status, *texts: Refused(capsys, status, *texts)


@ALL
def test_outputs_are_right_during_initialization_and_after_it(unzipped, kind):
    film = unzipped(BEARING, START).open(kind)
    if not film.third:
        film.fmu.setupExperiment()
    film.fmu.enterInitializationMode()
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(), rtol=1e-14)
    film.set(x=-3e-5)
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(x=-3e-5), rtol=1e-14)
    film.fmu.exitInitializationMode()
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(x=-3e-5), rtol=1e-14)
    np.testing.assert_array_equal(film.get(*INPUTS[1:]), list(START.values())[1:])


@SLAVES
def test_steps_hold_the_inputs(unzipped, kind):
    film = unzipped(BEARING, START).open(kind).start(startTime=2.0)
    for k in range(20):
        changes = {"x": 1e-6 * k, "speed": 10.0 * k}
        film.set(**changes)
        film.step(2.0 + 1e-3 * k, 1e-3)
        np.testing.assert_allclose(film.get("force_x", "force_y"), direct(**changes), rtol=1e-14)
        assert film.get("time") == pytest.approx(2.0 + 1e-3 * (k + 1), rel=1e-14)


@ALL
def test_parameters_may_be_set_one_by_one_and_together_must_fit(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind).start()
    film.set(radius=0.2)
    film.set(length=0.15)
    film.set(viscosity=0.02)
    other = JournalBearing(radius=0.2, length=0.15, clearance=1e-4, viscosity=0.02, film=MapFilm())
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(other), rtol=1e-13)
    film.set(length=2.0)
    with refused(ERROR, "length/diameter must be within the table of the film", "0.1 to 4", "got 5"):
        film.get("force_x")
    film.set(length=0.15)
    film.set(clearance=0.3)
    with refused(ERROR, "clearance must be below the radius 0.2, got 0.3"):
        film.get("force_x")
    film.set(clearance=1e-4)
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(other), rtol=1e-13)
    with refused(ERROR, "m.viscosity must be within 0 and inf, got -1"):
        film.set(viscosity=-1.0)
    with refused(ERROR, "m.radius must be finite, got nan"):
        film.set(radius=np.nan)
    with refused(ERROR, "radius must be finite and positive, got 0"):
        film.set(radius=0.0)
        film.get("force_x")


@ALL
def test_parameters_that_do_not_fit_stop_the_initialization(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind)
    film.set(length=1e-3)
    with refused(ERROR, "parameters at t = 0 s: length/diameter must be within", "got 0.01"):
        film.start()


@ALL
def test_initialization_does_not_end_at_the_wall(unzipped, kind, refused):
    film = unzipped(BEARING, {**START, "x": 2e-4}).open(kind)
    with refused(ERROR, "inside the clearance"):
        film.start()
    film.set(x=START["x"])
    film.fmu.exitInitializationMode()
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(), rtol=1e-14)


@ALL
def test_what_cannot_be_set_stays(unzipped, kind, refused):
    rotor = unzipped(ROTOR).open(kind)
    rotor.set(state_x=3e-5, constant_speed=50.0)
    rotor.start()
    before = rotor.get("state_x", "constant_speed", "force_x", "x", "mass")
    np.testing.assert_array_equal(before, [3e-5, 50.0, 0.0, 3e-5, 50.0])
    for name in ("state_x", "constant_speed", "x", "time", "der(m.state_x)"):
        with refused(ERROR, "cannot be set in the state"):
            rotor.set(force_x=1.0, **{name: 2.0})
    with refused(ERROR, "m.force_y must be finite, got inf"):
        rotor.set(force_x=1.0, force_y=np.inf)
    with refused(ERROR, "value reference must be below 24, got 99"):
        rotor.references["wrong"] = 99
        rotor.set(force_x=1.0, wrong=1.0)
    with refused(ERROR, "value reference must be below 24, got 99"):
        rotor.get("force_x", "wrong")
    np.testing.assert_array_equal(rotor.get("state_x", "constant_speed", "force_x", "x", "mass"), before)


@SLAVES
def test_step_arguments(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind).start(stopTime=1.0)
    for dt in (0.0, -1e-3, np.nan, np.inf):
        with refused(ERROR, "communicationStepSize must be finite and positive"):
            film.step(0.0, dt)
    with refused(ERROR, "currentCommunicationPoint must be 0 s, got 0.5 s"):
        film.step(0.5, 0.1)
    with refused(ERROR, "must not end after the stop time 1 s, got 1.5 s"):
        film.step(0.0, 1.5)
    film.step(0.0, 1.0)


@SLAVES
def test_the_wall_is_an_error_with_values_and_the_film_goes_on_when_it_is_left(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind).start()
    film.step(0.0, 1e-3)
    film.set(x=8e-5, y=6e-5)
    texts = ("inside the clearance 0.0001 m", "eccentricity of 0.0001 m", "x = 8e-05", "y = 6e-05")
    with refused(ERROR, "step from t = 0.001 s", *texts):
        film.step(1e-3, 1e-3)
    with refused(ERROR, "outputs at t = 0.001 s", *texts):
        film.get("force_x")
    assert film.get("time") == 1e-3
    film.set(**START)
    film.step(1e-3, 1e-3)
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(), rtol=1e-14)


@MODELS
def test_in_continuous_time_mode_the_wall_asks_for_a_smaller_step(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind).start()
    film.pass_event()
    film.set(x=2e-4)
    with refused(ERROR, "inside the clearance"):
        film.get("force_x")
    film.fmu.enterContinuousTimeMode()
    with refused(DISCARD, "inside the clearance"):
        film.get("force_x")
    film.set(x=START["x"])
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(), rtol=1e-14)


@SLAVES
def test_beyond_the_table_there_is_one_warning(unzipped, kind, capsys):
    film = unzipped(BEARING, {"x": 9.9999e-5, "speed": 100.0}).open(kind).start()
    force = film.get("force_x", "force_y")
    assert np.isfinite(force).all()
    assert "eccentricity ratio 0.99999 is beyond the map" in capsys.readouterr().out
    film.step(0.0, 1e-3)
    film.get("force_x")
    assert capsys.readouterr().out == ""


@SLAVES
def test_without_source_there_is_a_force_but_no_derivative(unzipped, kind, refused):
    film = unzipped(BEARING, {"x": 2e-5}).open(kind).start()
    np.testing.assert_array_equal(film.get("force_x", "force_y"), 0.0)
    film.step(0.0, 1e-3)
    with refused(ERROR, "the film has no derivative", "x = 2e-05", "speed = 0"):
        film.differentiate(["force_x"], ["vx"], [1.0])


@ALL
def test_directional_derivatives_are_the_jacobian(unzipped, kind):
    film = unzipped(BEARING, START).open(kind).start()
    x, y, vx, vy, speed = START.values()
    jacobian = BEARING.jacobian([x, y], [vx, vy], speed)
    for k, name in enumerate(INPUTS):
        column = film.differentiate(["force_y", "force_x"], [name], [2.0])
        np.testing.assert_allclose(column, 2.0 * jacobian[::-1, k], rtol=1e-14)
    if film.third:
        row = film.fmu.getAdjointDerivative(film.of(["force_y"]), film.of(INPUTS), [3.0], nSensitivity=5)
        np.testing.assert_allclose(row, 3.0 * jacobian[1], rtol=1e-14)


@ALL
def test_no_other_derivatives(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind).start()
    with refused(ERROR, "no derivative of m.force_x by m.radius is provided"):
        film.differentiate(["force_x"], ["radius"], [1.0])
    with refused(ERROR, "no derivative of m.x by m.y is provided"):
        film.differentiate(["x"], ["y"], [1.0])


def test_a_rotor_that_cannot_go_on_says_so_as_simulators_want_it(unzipped, refused):
    rotor = unzipped(ROTOR).open(FMU2Slave).start()
    rotor.step(0.0, 0.01)
    good = rotor.get("state_x", "state_y", "state_vx", "state_vy")
    assert not rotor.fmu.getBooleanStatus(fmi2Terminated)
    rotor.set(mass=1e-300, force_x=1e300)
    with refused(DISCARD, "step failed, last good time t = 0.01 s", "acceleration is not finite", "1e+300"):
        rotor.step(0.01, 0.01)
    assert rotor.fmu.getBooleanStatus(fmi2Terminated)
    assert rotor.fmu.getRealStatus(fmi2LastSuccessfulTime) == 0.01
    np.testing.assert_array_equal(rotor.get("state_x", "state_y", "state_vx", "state_vy"), good)
    with refused(ERROR, "fmi2DoStep must not be called in the state 'step failed'"):
        rotor.step(0.01, 0.01)
    rotor.fmu.reset()
    rotor.start().step(0.0, 0.01)
    np.testing.assert_array_equal(rotor.get("state_x", "state_y", "state_vx", "state_vy"), good)


@ALL
def test_order_of_calls(unzipped, kind, refused):
    rotor = unzipped(ROTOR).open(kind)
    for call, state in (
        (lambda: rotor.get("x"), "instantiated"),
        (rotor.fmu.exitInitializationMode, "instantiated"),
        (rotor.fmu.terminate, "instantiated"),
    ):
        with refused(ERROR, f"must not be called in the state '{state}'"):
            call()
    rotor.start()
    with refused(ERROR, "must not be called in the state"):
        rotor.fmu.enterInitializationMode()
    rotor.fmu.terminate()
    rotor.get("x")
    with refused(ERROR, "must not be called in the state 'terminated'"):
        rotor.set(force_x=1.0)


@MODELS
def test_tunable_parameters_wait_for_an_event(unzipped, kind, refused):
    rotor = unzipped(ROTOR).open(kind).start()
    rotor.pass_event()
    rotor.fmu.enterContinuousTimeMode()
    with refused(ERROR, "m.mass cannot be set in the state 'continuous-time mode'"):
        rotor.set(mass=1.0)
    rotor.fmu.enterEventMode()
    rotor.set(mass=25.0)
    changed = RigidRotor(mass=25.0, speed=100.0, unbalance=1e-3)
    expected = changed.derivative(0.0, ROTOR.initial_state, [0.0, 0.0])
    np.testing.assert_allclose(rotor.derivatives(4), expected, rtol=1e-14)


def roundtrip(client):
    """Return functions that save and restore through bytes."""
    fmu = client.fmu
    if client.third:
        return lambda: fmu.serializeFMUState(fmu.getFMUState()), lambda b: fmu.setFMUState(
            fmu.deserializeFMUState(b)
        )
    return lambda: fmu.serializeFMUstate(fmu.getFMUstate()), lambda b: fmu.setFMUstate(
        fmu.deSerializeFMUstate(b)
    )


@SLAVES
def test_a_saved_state_repeats_the_future_exactly_in_another_instance(unzipped, kind):
    folder = unzipped(ROTOR)
    one, other = folder.open(kind).start(), folder.open(kind)
    one.set(force_y=400.0, unbalance=2e-3)
    one.step(0.0, 0.013)
    content = roundtrip(one)[0]()
    future = []
    for rotor in (one, other):
        if rotor is other:
            roundtrip(other)[1](content)
        rotor.step(0.013, 0.01)
        rotor.set(force_y=100.0)
        rotor.step(0.023, 0.01)
        future.append(rotor.get("x", "y", "vx", "vy", "speed", "time", "unbalance"))
    np.testing.assert_array_equal(future[0], future[1])


@SLAVES
def test_restoring_takes_parameters_back(unzipped, kind):
    film = unzipped(BEARING, START).open(kind).start()
    save, restore = roundtrip(film)
    content = save()
    film.set(viscosity=0.2, length=0.05, x=0.0)
    assert not np.allclose(film.get("force_x", "force_y"), direct(), rtol=0.1)
    restore(content)
    np.testing.assert_allclose(film.get("force_x", "force_y"), direct(), rtol=1e-14)


def test_a_state_of_another_fmu_or_damaged_bytes_are_refused(unzipped, refused):
    one = unzipped(ROTOR, folder="one").open(FMU2Slave).start()
    other = unzipped(RigidRotor(mass=51.0, speed=100.0), folder="other").open(FMU2Slave).start()
    content = roundtrip(one)[0]()
    with refused(ERROR, f"the FMU state must come from this FMU, of {len(content)} bytes"):
        roundtrip(one)[1](content[:-1])
    for wrong in (bytes(len(content)), b"RFST" + bytes(len(content) - 4)):
        with refused(ERROR, "the FMU state is damaged, its checksum is wrong"):
            roundtrip(one)[1](wrong)
    with refused(ERROR, "the FMU state must come from this FMU"):
        roundtrip(other)[1](content)


def mutants(content):
    """Yield a serialized state with one bit changed, at every byte, and of another length."""
    for place in range(len(content)):
        yield content[:place] + bytes([content[place] ^ 1 << place % 8]) + content[place + 1 :]
    yield from (content[:-8], content + bytes(8), b"")


def sealed(content):
    """Return a serialized state with its checksum set right: the magic number, the checksum, the rest."""
    return content[:4] + struct.pack("<I", zlib.crc32(content[8:])) + content[8:]


@ALL
def test_no_damage_of_a_serialized_state_is_accepted(unzipped, kind):
    rotor = unzipped(ROTOR).open(kind).start()
    save, restore = roundtrip(rotor)
    rotor.set(force_y=400.0, unbalance=2e-3)
    content, before = save(), rotor.get(*rotor.references)
    accepted = []
    for number, wrong in enumerate(mutants(content)):
        with suppress(FMICallException):
            restore(wrong)
            accepted.append(number)
    assert accepted == []
    np.testing.assert_array_equal(rotor.get(*rotor.references), before)
    assert sealed(content) == content


@ALL
@pytest.mark.parametrize("field", ["phase", "phase to return to"])
def test_unknown_phases_are_refused_and_a_reset_is_possible(unzipped, kind, field, refused):
    rotor = unzipped(ROTOR).open(kind).start()
    save, restore = roundtrip(rotor)
    content = save()
    place = {"phase": 48, "phase to return to": 96}[field]
    exchange = kind in (FMU2Model, FMU3Model)
    (phase,) = struct.unpack_from("<I", content, 48)
    assert phase == (8 if exchange else 32)
    for wrong in (0, 3, phase | 1, 32 if exchange else 16, 512, 1 << 31):
        with refused(ERROR, f"a phase of this instance, got {wrong}"):
            restore(sealed(content[:place] + struct.pack("<I", wrong) + content[place + 4 :]))
    rotor.fmu.reset()
    rotor.start()


@ALL
def test_a_state_that_is_not_finite_is_refused_by_its_value(unzipped, kind, refused):
    rotor = unzipped(ROTOR).open(kind).start()
    save, restore = roundtrip(rotor)
    content, wrong = save(), struct.pack("<d", np.inf)
    for place in (24, 40, 56):  # the time, the stride of the integration, the last step
        with refused(ERROR, "times of the FMU state must be finite, got inf"):
            restore(sealed(content[:place] + wrong + content[place + 8 :]))
    last = (len(content) - 104) // 8 - 1  # behind the header
    with refused(ERROR, f"value {last} of the FMU state must be finite, got inf"):
        restore(sealed(content[:-8] + wrong))


def test_reset_and_freeing_states_are_possible_in_every_phase(unzipped, refused):
    folder = unzipped(ROTOR)
    third, second = folder.open(FMU3Slave), folder.open(FMU2Slave)
    third.fmu.enterConfigurationMode()
    roundtrip(second)[1](roundtrip(third)[0]())  # a phase that FMI 2.0 has no function for
    with refused(ERROR, "must not be called in the state 'configuration mode'"):
        second.fmu.enterInitializationMode()
    other = folder.open(FMU2Slave)
    state = other.fmu.getFMUstate()
    second.fmu.freeFMUstate(state)
    assert not state.value
    second.fmu.reset()
    second.start().step(0.0, 0.01)


def test_instances_are_independent(unzipped):
    folder = unzipped(BEARING, START)
    films = [folder.open(FMU2Slave).start() for _ in range(3)]
    for k, film in enumerate(films):
        film.set(x=1e-5 * k, length=0.03 + 0.01 * k)
    for k, film in enumerate(films):
        bearing = JournalBearing(
            radius=0.05, length=0.03 + 0.01 * k, clearance=1e-4, viscosity=0.1, film=MapFilm()
        )
        np.testing.assert_allclose(film.get("force_x", "force_y"), direct(bearing, x=1e-5 * k), rtol=1e-13)


@pytest.mark.parametrize("kind", [FMU3Slave, FMU3Model])
def test_configuration_mode_passes_and_types_other_than_float64_are_refused(unzipped, kind, refused):
    film = unzipped(BEARING, START).open(kind)
    film.fmu.enterConfigurationMode()
    with refused(ERROR, "configuration mode"):
        film.set(x=1e-5)
    film.fmu.exitConfigurationMode()
    film.start()
    with refused(ERROR, "fmi3GetInt32: all variables of this FMU are of type Float64"):
        film.fmu.getInt32([0])
    with refused(ERROR, "fmi3GetFloat32: all variables of this FMU are of type Float64"):
        film.fmu.getFloat32([0])


def test_logging_follows_the_categories(unzipped, capsys):
    film = unzipped(BEARING, START).open(FMU2Slave).start()
    film.get("x")
    assert capsys.readouterr().out == ""
    film.fmu.setDebugLogging(True, ["logAll"])
    film.get("x")
    assert "fmi2GetReal at t = 0" in capsys.readouterr().out
    film.fmu.setDebugLogging(False, ["logAll", "logStatusError"])
    capsys.readouterr()
    with pytest.raises(FMICallException):
        film.step(3.0, 1.0)
    assert capsys.readouterr().out == ""
