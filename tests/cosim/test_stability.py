from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from rotorfilm import FilmContactError, InputError, JournalBearing, PartialResultError
from rotorfilm.bearings.journal import ShortFilm
from rotorfilm.cosim import InProcessSlave, couple, coupling_stability, critical_macro_step
from rotorfilm.rotors import RigidRotor

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

# Gauss-Seidel with held force, short bearing, w = 1: critical macro step in degrees of rotation, to be met
# within 2 %: reference figures of an independent study of this coupling.
CRITICAL = {0.7: 14.75, 0.9: 10.1}


@dataclass(frozen=True)
class AngularSpeedRotor(RigidRotor):
    """A rotor whose first output feels its input at once: an algebraic loop with any film."""

    def linearization(self, t, x, u):
        linear = super().linearization(t, x, u)
        return linear._replace(D=np.ones((5, 2)))


def in_si(eccentricity):
    """Return the same case as `nondimensional` at w = 1, on the package's own short bearing in SI."""
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    speed, position = 157.0, (eccentricity * 1e-4, 0.0)
    load = -bearing.force(position, (0.0, 0.0), speed)
    mass = np.hypot(*load) / (speed**2 * 1e-4)
    rotor = RigidRotor(
        mass=mass, speed=speed, gravity=(0.0, 0.0), static_force=tuple(load), position=position
    )
    return rotor, bearing, speed


def test_the_film_of_these_tests_balances_the_unit_load(nondimensional):
    case = nondimensional(0.7)
    assert_allclose(case.film.force(case.state[:2], (0.0, 0.0), 1.0), [-1.0, 0.0], atol=1e-12)


@pytest.mark.parametrize("eccentricity", CRITICAL)
def test_critical_macro_step_of_a_short_bearing(nondimensional, eccentricity):
    case = nondimensional(eccentricity)
    limit = critical_macro_step(case.rotor, case.film, state=case.state)
    assert_allclose(np.degrees(limit.macro_step), CRITICAL[eccentricity], rtol=0.02)
    assert_allclose(limit.eigenvalue, -1.0, atol=1e-9)
    assert limit.reason == ""
    assert limit.growth_rate < 0.0


@pytest.mark.parametrize("eccentricity", CRITICAL)
def test_critical_macro_step_of_a_journal_bearing_in_si(nondimensional, eccentricity):
    rotor, bearing, speed = in_si(eccentricity)
    limit = critical_macro_step(rotor, bearing, state=rotor.initial_state)
    assert_allclose(np.degrees(limit.macro_step * speed), CRITICAL[eccentricity], rtol=0.02)
    case = nondimensional(eccentricity)
    other = critical_macro_step(case.rotor, case.film, state=case.state)
    assert_allclose(limit.macro_step * speed, other.macro_step, rtol=1e-8)


def growth_per_step(case, macro_step):
    """Return the growth of a small alternation of the force in a run of the master itself."""
    rotor = replace(case.rotor, position=tuple(case.state[:2] + 1e-9))
    run = couple(
        InProcessSlave(rotor), InProcessSlave(case.film), macro_step=macro_step, duration=60.0 * macro_step
    )
    force = np.stack([run.trajectory["force_x"], run.trajectory["force_y"]])
    swing = np.hypot(*np.diff(force, n=2, axis=1))
    return (swing[50] / swing[30]) ** (1.0 / 20.0)


@pytest.mark.parametrize("eccentricity", CRITICAL)
def test_simulated_alternation_grows_from_the_critical_macro_step_on(nondimensional, eccentricity):
    case = nondimensional(eccentricity)
    nominal = np.radians(CRITICAL[eccentricity])
    limit = brentq(lambda h: growth_per_step(case, h) - 1.0, 0.97 * nominal, 1.05 * nominal, xtol=1e-4)
    assert_allclose(np.degrees(limit), CRITICAL[eccentricity], rtol=0.02)
    theory = critical_macro_step(case.rotor, case.film, state=case.state)
    assert_allclose(limit, theory.macro_step, rtol=1e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("stiffness", "damping", "expected"), [(1.0, 10.0, 2.0 * 3.0 / 10.0), (50.0, 4.0, 2.0 * 4.0 / 50.0)]
)
def test_limit_on_a_spring_and_damper(make_spring_damper, stiffness, damping, expected):
    """Jury's criterion: damping chatters at H = 2 m/c, the delayed spring whirls up at H = 2 c/k."""
    rotor = RigidRotor(mass=3.0, speed=1.0)
    limit = critical_macro_step(rotor, make_spring_damper(stiffness, damping), state=np.zeros(4))
    assert_allclose(limit.macro_step, expected, rtol=1e-9)
    assert_allclose(abs(limit.eigenvalue), 1.0, rtol=1e-9)
    assert (abs(limit.eigenvalue.imag) < 1e-9) == (damping == 10.0)


@pytest.mark.closed_form
def test_spectral_radius_on_a_spring_and_damper(make_spring_damper):
    m, k, c, h = 3.0, 7.0, 2.0, 0.4
    found = coupling_stability(
        RigidRotor(mass=m, speed=1.0), make_spring_damper(k, c), state=np.zeros(4), macro_step=h
    )
    scheme = [[1.0 - k * h * h / (2 * m), h - c * h * h / (2 * m)], [-k * h / m, 1.0 - c * h / m]]
    assert_allclose(found.spectral_radius, np.abs(np.linalg.eigvals(scheme)).max(), rtol=1e-12)


def test_an_unstable_system_has_no_critical_macro_step(nondimensional):
    case = nondimensional(0.1, w=3.0)  # threshold of whirl at w = 2.741279
    limit = critical_macro_step(case.rotor, case.film, state=case.state)
    assert limit.macro_step is None
    assert limit.growth_rate > 0.0
    assert "the system itself is not stable" in limit.reason
    stable = nondimensional(0.1, w=2.5)
    assert critical_macro_step(stable.rotor, stable.film, state=stable.state).macro_step > 0.0


def test_held_force_lowers_the_whirl_threshold(nondimensional):
    """A given bearing and rotor at eps .6: the threshold falls by .84 % with a macro step of 1 degree."""

    def excess(w, eccentricity, degrees):
        case = nondimensional(eccentricity, w=w)
        found = coupling_stability(case.rotor, case.film, state=case.state, macro_step=np.radians(degrees))
        return found.spectral_radius - 1.0

    threshold = brentq(excess, 2.3, 2.9, args=(0.6, 1e-3))
    # The same bearing at another speed: sigma is proportional to it, and so to w.
    sigma_per_w = nondimensional(0.6).film.sigma / threshold

    def held(w):
        eccentricity = brentq(lambda e: nondimensional(e).film.sigma - sigma_per_w * w, 0.3, 0.75)
        return excess(w, eccentricity, 1.0)

    assert_allclose(brentq(held, 2.3, 2.9) / threshold - 1.0, -0.0084, atol=5e-5)


def test_arguments_that_do_not_fit_are_named(nondimensional):
    case = nondimensional(0.5)
    with pytest.raises(InputError, match=r"macro_step must be finite and positive, got 0.0"):
        coupling_stability(case.rotor, case.film, state=case.state, macro_step=0.0)
    with pytest.raises(InputError, match=r"state must have shape \(4,\), got \(2,\)"):
        critical_macro_step(case.rotor, case.film, state=[0.0, 0.0])
    with pytest.raises(InputError, match=r"rotor must have the outputs .* without \['x', 'y'"):
        critical_macro_step(case.film, case.film, state=[])
    with pytest.raises(FilmContactError, match=r"outside at 1\.0"):
        critical_macro_step(case.rotor, case.film, state=[1.0, 0.0, 0.0, 0.0])
    loop = AngularSpeedRotor(mass=1.0, speed=1.0)
    with pytest.raises(InputError, match="rotor must have outputs that do not depend directly on its inputs"):
        critical_macro_step(loop, case.film, state=case.state)


def test_a_run_past_the_limit_is_never_an_answer(nondimensional):
    case = nondimensional(0.9, offset=(-0.01, 0.0))
    limit = critical_macro_step(case.rotor, case.film, state=nondimensional(0.9).state).macro_step
    for factor in (1.02, 1.2, 1.5, 2.0, 3.0, 5.0):
        step = factor * limit
        with pytest.raises(PartialResultError, match=r"macro_step must be|macro step of"):
            couple(
                InProcessSlave(case.rotor), InProcessSlave(case.film), macro_step=step, duration=150.0 * step
            )
