from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import ContactError, ConvergenceError, FilmContactError, JournalBearing
from rotorfilm.analysis import simulate
from rotorfilm.bearings.reaction import Feedthrough
from rotorfilm.rotors import RigidRotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)


@pytest.mark.closed_form
@pytest.mark.parametrize("rtol", [1e-4, 1e-8])
def test_free_fall_hits_the_wall_at_the_right_time(make_linear_film, rtol):
    rotor = RigidRotor(mass=3.0, speed=10.0)
    impact = np.sqrt(2.0 * 1e-4 / 9.80665)
    with pytest.raises(ContactError, match="journal reached the wall at t = ") as caught:
        simulate(rotor, make_linear_film(), duration=1.0, samples=10_001, rtol=rtol)
    partial = caught.value.partial
    assert isinstance(caught.value, FilmContactError)
    assert 0.0 <= impact - partial.time[-1] < 1e-4
    assert_allclose(partial["y"], -0.5 * 9.80665 * partial.time**2, atol=1e-9)
    assert_allclose(float(str(caught.value).split("t = ")[1].split(" s")[0]), impact, rtol=1e-6)


def test_a_journal_thrown_at_the_wall_is_caught_by_the_squeeze_film():
    """The integrator tries states beyond the wall on the way; they must cost a step, not the run."""
    rotor = RigidRotor(mass=1000.0, speed=100.0, velocity=(0.0, -5.0))
    rough = simulate(rotor, BEARING, duration=2e-3, samples=41, rtol=1e-2)
    fine = simulate(rotor, BEARING, duration=2e-3, samples=41, rtol=1e-7)
    assert rough.work["restarts"] > 0
    assert np.hypot(*fine.position).max() > 0.97 * BEARING.clearance
    assert_allclose(rough.position, fine.position, atol=1e-2 * BEARING.clearance)


def test_a_start_at_the_wall_is_refused(make_linear_film):
    rotor = RigidRotor(mass=1.0, speed=1.0, position=(0.0, 2e-4))
    with pytest.raises(
        ContactError, match=r"reached the wall at t = 0 s: -1 of the clearance 0.0001 m is left"
    ):
        simulate(rotor, make_linear_film(), duration=1.0)


@dataclass(frozen=True)
class BrokenFilm(Feedthrough):
    """A bearing whose force is not a number below some height."""

    bearing: JournalBearing
    height: float

    clearance = property(lambda self: self.bearing.clearance)
    inputs = property(lambda self: self.bearing.inputs)
    outputs = property(lambda self: self.bearing.outputs)

    def force(self, position, velocity, speed):
        return np.where(position[1] < self.height, np.nan, self.bearing.force(position, velocity, speed))

    def jacobian(self, position, velocity, speed):
        return self.bearing.jacobian(position, velocity, speed)


def test_a_force_that_is_not_a_number_ends_the_run_with_what_was_computed():
    rotor = RigidRotor(mass=50.0, speed=100.0)
    with pytest.raises(ConvergenceError, match=r"film force must be finite, got .*nan") as caught:
        simulate(rotor, BrokenFilm(BEARING, -1e-5), duration=0.05, samples=501)
    partial = caught.value.partial
    sound = simulate(rotor, BEARING, duration=0.05, times=partial.time)
    assert 2 <= partial.time.size < 501
    assert_allclose(partial.position, sound.position, atol=1e-6 * BEARING.clearance)


@dataclass(frozen=True)
class RunawayRotor(RigidRotor):
    """A rotor that reaches infinite velocity, tan(t), at t = pi/2."""

    def derivative(self, t, x, u):
        return np.array([x[2], x[3], 1.0 + x[2] ** 2, 0.0])


@pytest.mark.long
def test_an_integrator_that_gives_up_says_where(make_linear_film):
    rotor = RunawayRotor(mass=1.0, speed=1.0)
    with pytest.raises(
        ConvergenceError, match=r"integration failed at t = 1.570.* s: Required step"
    ) as caught:
        simulate(rotor, make_linear_film(clearance=1e3), duration=2.0, samples=2001)
    partial = caught.value.partial
    assert_allclose(partial.time[-1], np.pi / 2.0, atol=1e-3)
    assert_allclose(partial["vx"][:1000], np.tan(partial.time[:1000]), atol=1e-3)
