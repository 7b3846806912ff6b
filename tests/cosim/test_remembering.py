"""Films that remember, coupled over macro steps: order of the scheme, and its answer."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from rotorfilm import Groove, InputError, JFOFilm, JournalBearing, RigidRotor, SIExp3, cosimulate, simulate
from rotorfilm.core import force_outputs, journal_inputs
from rotorfilm.cosim import SIExp, SIMemory
from rotorfilm.cosim.slaves import SteppedPartner

m, k, tau, damping, omega = 3.0, 50.0, 0.6, 4.0, 1.0


class Maxwell:
    """A spring behind a dashpot, and a damper: z' = (k q - z)/tau, F = -z - damping v, exact along cubics."""

    clearance = 1.0
    inputs, outputs = journal_inputs(1.0, 1.0), force_outputs(1.0)

    def start(self, u):
        return np.array(u), k * np.array(u[:2])

    def answer(self, state):
        motion, z = state
        return -z - damping * motion[2:4]

    def step(self, state, t, u, dt):
        (q0, v0), (q1, v1), z = (state[0][:2], state[0][2:4]), (u[:2], u[2:4]), state[1]
        turned = (3.0 * (q1 - q0) - dt * (2.0 * v0 + v1)) / dt**2
        bent = (dt * (v0 + v1) - 2.0 * (q1 - q0)) / dt**3
        # z' + z/tau = k/tau (q0 + v0 s + turned s^2 + bent s^3): a particular polynomial, from the top down.
        particular = []
        for power, a in ((3, bent), (2, turned), (1, v0), (0, q0)):
            above = particular[-1] if particular else 0.0
            particular.append(k * a - tau * (power + 1) * above)
        p3, p2, p1, p0 = particular
        z1 = p0 + dt * (p1 + dt * (p2 + dt * p3)) + (z - p0) * np.exp(-dt / tau)
        end = np.array(u), z1
        return end, self.answer(end), {}

    def slopes(self, state):
        return np.hstack([np.zeros((2, 2)), -damping * np.eye(2), np.zeros((2, 1))])

    def attempt(self, state, u, dt, near=None):
        raise NotImplementedError

    def pack(self, state):
        raise NotImplementedError

    def unpack(self, content):
        raise NotImplementedError


@pytest.mark.convergence
@pytest.mark.parametrize(("scheme", "order"), [(SIMemory(), 3.0), (SIExp3(), 1.0)])
def test_the_order_with_a_film_that_remembers(scheme, order):
    # m q'' = -z - damping q' + gravity, exactly.
    system = np.array([[0.0, 1.0, 0.0], [0.0, -damping / m, -1.0 / m], [k / tau, 0.0, -1.0 / tau]])
    exact = [expm(2.0 * system) @ [q, 0.0, k * q] for q in (0.1, -0.2)]
    rotor = RigidRotor(mass=m, speed=omega, gravity=(0.0, 0.0), position=(0.1, -0.2))
    errors = []
    for count in (80, 160):
        found = cosimulate(rotor, Maxwell(), macro_step=2.0 / count, duration=2.0, scheme=scheme).trajectory
        errors.append(np.abs(found.position[:, -1] - [z[0] for z in exact]).max())
    assert_allclose(np.log2(errors[0] / errors[1]), order, atol=0.25)
    assert scheme.order == 3


def test_without_memory_it_is_exact_on_linear_films(make_spring_damper):
    rotor = RigidRotor(mass=m, speed=omega, gravity=(0.0, 0.0), position=(1.0, -2.0), velocity=(0.5, 0.0))
    film = make_spring_damper(7.0, 200.0)
    runs = [
        cosimulate(rotor, film, macro_step=3.0, duration=9.0, scheme=scheme).trajectory
        for scheme in (SIMemory(), SIExp())
    ]
    assert_allclose(runs[0].position[:, -1], runs[1].position[:, -1], atol=1e-8)
    work = runs[0].work
    assert work["film_evaluations"] == work["steps"] + 1
    assert work["rollbacks"] == 0


@pytest.fixture(scope="module")
def film():
    top = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
    bearing = JournalBearing(
        radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, grooves=(top,), supply_pressure=2e5
    )
    return JFOFilm(bearing=bearing, cells=(36, 4))


def test_a_rotor_on_conserved_oil_is_that_of_one_system(film):
    turn, place = 2.0 * np.pi / 314.0, (4.2e-5, -3e-5)
    rotor = RigidRotor(mass=250.0, speed=314.0, unbalance=250.0 * 1.5e-5, position=place)
    found = cosimulate(rotor, film, macro_step=turn / 96, duration=0.5 * turn, scheme=SIMemory()).trajectory
    exact = simulate(rotor, film, duration=0.5 * turn, times=found.time, max_step=turn / 192)
    assert np.abs(found.position - exact.position).max() < 5e-4 * film.clearance
    assert found.units["oil_volume"] == "m3"
    assert found["oil_volume"].min() > 0.0


def test_a_partner_goes_back_and_names_its_inputs(film):
    partner = SteppedPartner(film)
    partner.start({"x": 3e-5, "speed": 314.0})
    state, before = partner.save(), partner.get()
    partner.set({"x": 3.1e-5})
    partner.step(0.0, 1e-4)
    assert partner.get() != before
    partner.restore(state)
    assert partner.get() == before
    with pytest.raises(InputError, match=r"input must be one of .*speed, got 'z'"):
        partner.set({"z": 1.0})
