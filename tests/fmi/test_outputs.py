"""An FMU answers like the model it was made from, at any time and after any call."""

from dataclasses import replace

import fmpy
import numpy as np
import pytest

from rotorfilm import JournalBearing, RigidRotor, SpeedProfile
from rotorfilm.bearings.journal import ComplementarityArc, FixedArc, ReynoldsArc, RotatingArc, SplittingFilm
from rotorfilm.fmu import export_fmu

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
FILMS = {
    "short": BEARING,
    "turning": replace(BEARING, film=SplittingFilm(order=(2, None), rupture=RotatingArc())),
    "fixed": replace(BEARING, film=SplittingFilm(order=(4, 2), rupture=FixedArc())),
    "reynolds": replace(BEARING, film=SplittingFilm(order=(4, 2), constant=True, rupture=ReynoldsArc())),
    "free": replace(BEARING, film=SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc())),
}
INPUTS = ["bearing.x", "bearing.y", "bearing.vx", "bearing.vy", "bearing.speed"]
FORCES = ["bearing.force_x", "bearing.force_y"]

MASS, SPEED, UNBALANCE = 50.0, 157.0, 8e-4
ROTOR = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, gravity=(0.0, 0.0))
MOTION = ["rotor.x", "rotor.y", "rotor.vx", "rotor.vy"]
STATES = ["rotor.state_x", "rotor.state_y", "rotor.state_vx", "rotor.state_vy"]
ROTORS = {
    "constant": ROTOR,
    "run-up": replace(ROTOR, speed=SpeedProfile(times=(0.0, 0.5), speeds=(40.0, 160.0)), unbalance_angle=0.3),
}


@pytest.fixture(scope="module")
def bearing_fmu(tmp_path_factory):
    path = tmp_path_factory.mktemp("bearing") / "a.fmu"
    return export_fmu(BEARING, path, backend="python", component="bearing")


@pytest.fixture(scope="module")
def rotor_fmu(tmp_path_factory):
    return export_fmu(ROTOR, tmp_path_factory.mktemp("rotor") / "a.fmu", backend="python", component="rotor")


def random_states(count):
    """Return states inside the clearance, shape (count, 5)."""
    generator = np.random.default_rng(7)
    radius, angle = 1e-4 * np.sqrt(generator.uniform(0, 0.97, count)), generator.uniform(0, 7, count)
    velocity, speed = generator.normal(0.0, 0.01, (2, count)), generator.normal(0.0, 300.0, count)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), *velocity, speed], axis=1)


def closed_form(t, force):
    """Return the unbalanced rotor's motion from rest under a constant force."""
    angle = SPEED * t
    turn, rate = (
        np.array([1 - np.cos(angle), angle - np.sin(angle)]),
        np.array([np.sin(angle), 1 - np.cos(angle)]),
    )
    position = force * t**2 / (2 * MASS) + UNBALANCE / MASS * turn
    return [*position, *(force * t / MASS + UNBALANCE / MASS * SPEED * rate)]


@pytest.mark.parametrize("bearing", FILMS.values(), ids=FILMS)
def test_the_force_is_that_of_a_direct_call(bearing, load, tmp_path):
    fmu = load(export_fmu(bearing, tmp_path / "a.fmu", backend="python", component="bearing"))
    fmu.initialize()
    for state in random_states(20):
        fmu.set(dict(zip(INPUTS, state, strict=True)))
        np.testing.assert_allclose(fmu.get(*FORCES), bearing.output(0.0, (), state), rtol=1e-12)


def test_outputs_are_valid_at_the_start(load, bearing_fmu):
    state = random_states(1)[0]
    fmu = load(bearing_fmu)
    fmu.initialize(dict(zip(INPUTS, state, strict=True)))
    np.testing.assert_allclose(fmu.get(*FORCES), BEARING.output(0.0, (), state), rtol=1e-12)


def test_start_values_hold_without_being_set(load, tmp_path):
    state = random_states(1)[0]
    start = dict(zip([name.split(".")[1] for name in INPUTS], state, strict=True))
    fmu = load(export_fmu(BEARING, tmp_path / "a.fmu", backend="python", component="bearing", start=start))
    fmu.initialize()
    assert fmu.get(*INPUTS) == state.tolist()
    np.testing.assert_allclose(fmu.get(*FORCES), BEARING.output(0.0, (), state), rtol=1e-12)


def test_outputs_follow_one_input_without_a_step(load, bearing_fmu):
    first, second = random_states(2)
    fmu = load(bearing_fmu)
    fmu.initialize(dict(zip(INPUTS, first, strict=True)))
    fmu.get(*FORCES)
    fmu.set({"bearing.speed": second[4]})
    np.testing.assert_allclose(fmu.get(*FORCES), BEARING.output(0.0, (), [*first[:4], second[4]]), rtol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("steps", [1, 7, 100])
def test_the_rotor_moves_as_its_closed_form(steps, load, rotor_fmu):
    force, duration = np.array([20.0, -30.0]), 0.05
    fmu = load(rotor_fmu)
    fmu.initialize({"rotor.force_x": force[0], "rotor.force_y": force[1]})
    for k in range(steps):
        fmu.fmu.doStep(k * duration / steps, duration / steps)
    nominal = [signal.nominal for signal in ROTOR.states]
    difference = np.subtract(fmu.get(*MOTION), closed_form(duration, force)) / nominal
    assert np.abs(difference).max() < 1e-7


@pytest.mark.parametrize("rotor", ROTORS.values(), ids=ROTORS)
def test_the_rotor_answers_as_a_direct_call_at_the_start(rotor, load, tmp_path):
    path = export_fmu(rotor, tmp_path / "a.fmu", backend="python", component="rotor")
    generator = np.random.default_rng(3)
    scale = [signal.nominal for signal in (*rotor.states, *rotor.inputs)]
    for value in generator.normal(0.0, scale, (10, 6)):
        fmu = load(path)
        fmu.initialize(dict(zip([*STATES, "rotor.force_x", "rotor.force_y"], value, strict=True)))
        expected = rotor.output(0.0, value[:4], value[4:])
        np.testing.assert_allclose(fmu.get(*MOTION, "rotor.speed"), expected, rtol=1e-12)


def test_the_rotor_starts_where_it_is_put(load, rotor_fmu):
    fmu = load(rotor_fmu)
    fmu.initialize({"rotor.state_x": 2e-5, "rotor.state_vy": -1e-3})
    assert fmu.get(*MOTION, "rotor.speed") == [2e-5, 0.0, 0.0, -1e-3, SPEED]


def test_the_rotor_knows_the_start_time(load, rotor_fmu):
    fmu = load(rotor_fmu)
    fmu.initialize(time=0.012)
    fmu.fmu.doStep(0.012, 1e-6)
    phase = SPEED * (0.012 + 0.5e-6)
    kick = UNBALANCE / MASS * SPEED**2 * np.array([np.cos(phase), np.sin(phase)]) * 1e-6
    np.testing.assert_allclose(fmu.get("rotor.vx", "rotor.vy"), kick, rtol=1e-7)


def test_fmpy_simulates_the_exported_file(tmp_path):
    path = export_fmu(
        ROTOR, tmp_path / "a.fmu", backend="python", component="rotor", stop_time=0.02, step_size=0.001
    )
    result = fmpy.simulate_fmu(str(path), start_values={"rotor.force_x": 20.0}, output=MOTION)
    end = result[-1]
    assert end["time"] == pytest.approx(0.02)
    expected = closed_form(0.02, np.array([20.0, 0.0]))
    np.testing.assert_allclose([end[name] for name in MOTION], expected, rtol=1e-7)


def test_a_users_own_model_runs(write_module, load, tmp_path):
    model = write_module("own_law").Proportional()
    fmu = load(export_fmu(model, tmp_path / "a.fmu", backend="python", component="own"))
    fmu.initialize({"own.a": 3.0})
    assert fmu.get("own.b") == [6.0]


def test_a_users_dataclass_may_extend_a_bearing(write_module, load, tmp_path):
    law = write_module(
        "own_law",
        "from dataclasses import dataclass\n"
        "from rotorfilm.bearings.journal.bearing import JournalBearing\n\n\n"
        "@dataclass(frozen=True, kw_only=True)\n"
        "class Twin(JournalBearing):\n"
        '    """Two bearings side by side."""\n\n'
        "    factor: float = 2.0\n\n"
        "    def output(self, t, x, u):\n"
        "        return self.factor * super().output(t, x, u)\n",
    )
    twin = law.Twin(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    fmu = load(export_fmu(twin, tmp_path / "a.fmu", backend="python", component="twin"))
    state = random_states(1)[0]
    fmu.initialize(dict(zip([f"twin.{name.split('.')[1]}" for name in INPUTS], state, strict=True)))
    expected = 2.0 * BEARING.output(0.0, (), state)
    np.testing.assert_allclose(fmu.get("twin.force_x", "twin.force_y"), expected, rtol=1e-12)
