from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import ContactError, CouplingError, FilmContactError, FmuError, InputError, JournalBearing
from rotorfilm.analysis import simulate
from rotorfilm.core import FmuRunError
from rotorfilm.cosim import GaussSeidel, InProcessSlave, couple
from rotorfilm.rotors import RigidRotor, SpeedProfile

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = RigidRotor(
    mass=525.0 / 9.80665,
    speed=SpeedProfile(times=(0.0, 0.015), speeds=(120.0, 157.0)),
    unbalance=1e-3,
    position=(2e-5, -4e-5),
)
TURN = 2.0 * np.pi / 157.0


def run(rotor, film, macro_step, duration):
    return couple(InProcessSlave(rotor), InProcessSlave(film), macro_step=macro_step, duration=duration)


@pytest.mark.closed_form
def test_every_step_is_the_exact_gauss_seidel_step(make_spring_damper):
    """Held force, exact rotor: x_(n+1) = M x_n with M known for a spring and damper."""
    m, k, c, h = 3.0, 7.0, 2.0, 0.05
    rotor = RigidRotor(mass=m, speed=1.0, gravity=(0.0, 0.0), position=(1.0, -2.0), velocity=(0.5, 0.0))
    found = run(rotor, make_spring_damper(k, c), h, 30 * h).trajectory
    scheme = np.array([[1.0 - k * h * h / (2 * m), h - c * h * h / (2 * m)], [-k * h / m, 1.0 - c * h / m]])
    states = [np.linalg.matrix_power(scheme, n) @ [[1.0, -2.0], [0.5, 0.0]] for n in range(31)]
    assert_allclose(found.position, np.array([s[0] for s in states]).T, atol=1e-9)
    assert_allclose(found.velocity, np.array([s[1] for s in states]).T, atol=1e-9)


@pytest.mark.convergence
def test_error_against_the_monolithic_solution_falls_with_the_declared_order():
    errors = []
    exact = simulate(ROTOR, BEARING, duration=TURN, times=np.linspace(0.0, TURN, 401))
    for count in (400, 800, 1600):
        found = run(ROTOR, BEARING, TURN / count, TURN).trajectory
        errors.append(np.abs(found.position[:, :: count // 400] - exact.position).max() / BEARING.clearance)
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert_allclose(orders, GaussSeidel().order, atol=0.1)
    assert errors[-1] < 1e-3


def test_the_film_starts_at_the_rotors_initial_state_and_is_in_step_with_it():
    found = run(ROTOR, BEARING, 1e-4, 5e-3).trajectory
    journal = np.stack([found[name] for name in ("x", "y", "vx", "vy", "speed")])
    assert journal[:, 0].tolist() == [*ROTOR.position, *ROTOR.velocity, 120.0]
    force = BEARING.force(journal[:2], journal[2:4], journal[4])
    assert_allclose([found["force_x"], found["force_y"]], force, rtol=1e-12)


def test_communication_points_are_multiples_and_end_at_the_duration():
    time = run(ROTOR, BEARING, 1e-4, 1.05e-3).trajectory.time
    assert_allclose(time, [*(1e-4 * np.arange(11)), 1.05e-3], rtol=1e-12)
    result = run(ROTOR, BEARING, 5e-4 / 7, 5e-4)
    assert result.trajectory.time.size == 8
    assert result.trajectory.time[-1] == 5e-4
    assert result.macro_step == 5e-4 / 7
    assert result.trajectory.work["steps"] == result.trajectory.work["rotor_steps"] == 7
    assert result.trajectory.work["film_evaluations"] == 8
    assert run(ROTOR, BEARING, 1.0, 1e-4).trajectory.time.tolist() == [0.0, 1e-4]


def test_progress_is_told_after_each_step():
    told = []
    couple(
        InProcessSlave(ROTOR), InProcessSlave(BEARING), macro_step=1e-4, duration=3e-4, progress=told.append
    )
    assert_allclose(told, [1e-4, 2e-4, 3e-4])


def test_hold_defect_is_proportional_to_the_macro_step(nondimensional):
    case = nondimensional(0.5, unbalance=0.3)
    steps = np.radians([4.0, 2.0])
    coarse, fine = (run(case.rotor, case.film, h, 4.0 * np.pi).coupling.hold_defect for h in steps)
    assert_allclose(coarse / fine, 2.0, rtol=0.05)


def test_contact_carries_what_was_computed(nondimensional):
    case = nondimensional(0.5)
    thrown = replace(case.rotor, velocity=(30.0, 0.0))
    with pytest.raises(ContactError, match="journal reached the wall after t = ") as caught:
        run(thrown, case.film, 0.05, 10.0)
    result = caught.value.partial
    assert isinstance(caught.value, FilmContactError)
    assert 1 <= result.trajectory.time.size < 10
    assert np.hypot(*result.trajectory.position).max() < 1.0
    outside = replace(case.rotor, position=(2.0, 0.0))
    with pytest.raises(ContactError, match="journal reached the wall at t = 0") as caught:
        run(outside, case.film, 0.05, 10.0)
    assert caught.value.partial.trajectory.time.size == 0


def test_chatter_is_stopped_before_it_throws_the_journal_at_the_wall(make_spring_damper):
    """The damper doubles its alternation in each step until it throws the journal at the wall."""
    film = WalledFilm(make_spring_damper(0.0, 3.0))
    rotor = RigidRotor(mass=1.0, speed=1.0, gravity=(0.0, 0.0), velocity=(1e-6, 0.0))
    with pytest.raises(CouplingError, match="without decaying") as caught:
        run(rotor, film, 1.0, 300.0)
    assert caught.value.partial.coupling.chatter
    assert caught.value.partial.trajectory.time[-1] < 30.0


@dataclass(frozen=True)
class WalledFilm:
    """A spring and damper in a clearance of 1 m."""

    film: object

    inputs = property(lambda self: self.film.inputs)
    outputs = property(lambda self: self.film.outputs)
    states = ()

    def output(self, t, x, u):
        if np.hypot(u[0], u[1]) >= 1.0:
            raise FilmContactError(f"outside at {np.hypot(u[0], u[1])}")
        return self.film.output(t, x, u)


@dataclass(frozen=True)
class BrokenFilm:
    """A bearing whose force is not a number."""

    inputs = BEARING.inputs
    outputs = BEARING.outputs
    states = ()

    def output(self, t, x, u):
        return np.array([np.nan, 0.0])


def test_an_output_that_is_not_a_number_ends_the_run():
    with pytest.raises(
        FmuRunError, match=r"outputs of the film must be finite, got {'force_x': nan} at t = 0 s"
    ) as caught:
        run(ROTOR, BrokenFilm(), 1e-4, 1e-3)
    assert isinstance(caught.value, FmuError)
    assert caught.value.partial.trajectory.time.size == 0


@dataclass(frozen=True)
class LameRotor(RigidRotor):
    """A rotor that does not tell its velocity."""

    outputs = property(lambda self: RigidRotor.outputs.fget(self)[:2])


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        ({"macro_step": 0.0, "duration": 1.0}, r"macro_step must be finite and positive, got 0.0"),
        ({"macro_step": 1.0, "duration": np.nan}, "duration must be finite and positive, got nan"),
    ],
)
def test_bad_arguments_are_named(arguments, match):
    with pytest.raises(InputError, match=match):
        couple(InProcessSlave(ROTOR), InProcessSlave(BEARING), **arguments)


def test_partners_that_do_not_fit_are_named():
    for film in (ROTOR, BEARING):
        with pytest.raises(InputError, match=r"rotor must have the inputs \['force_x', 'force_y'\], got"):
            run(BEARING, film, 1e-4, 1e-3)
    with pytest.raises(InputError, match=r"film must have the outputs \['force_x', 'force_y'\], got"):
        run(ROTOR, ROTOR, 1e-4, 1e-3)
    with pytest.raises(InputError, match=r"rotor must have the outputs .* without \['vx', 'vy', 'speed'\]"):
        run(LameRotor(mass=1.0, speed=1.0), BEARING, 1e-4, 1e-3)
    with pytest.raises(InputError, match=r"input must be one of force_x, force_y, got 'torque'"):
        InProcessSlave(ROTOR).set({"torque": 1.0})
