"""Dampers in python-control: transfer function, static place, circular orbit, coefficients."""

from dataclasses import replace

import control
import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    FilmContactError,
    FullFilm,
    InputError,
    Parallel,
    PorousCage,
    PorousDamper,
    RadialFeed,
    RigidRotor,
    UndefinedDerivativeError,
    closed_loop,
    equilibrium,
    orbit_coefficients,
    simulate,
    small_motion_transmissibility,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.analysis import orbit_system, transmitted_ratio
from rotorfilm.bearings.damper.squeeze_films import mean_permeability

MASS, SPEED, K = 10.0, 400.0, 2.56e5
DIMENSIONS = {"radius": 0.05, "length": 0.025, "clearance": 1e-4, "viscosity": 4e-3}
CAGE = PorousCage(thickness=2.5e-3, permeability=4e-12, grading=0.1, thin=True)
FULL = PorousDamper(**DIMENSIONS, cage=CAGE, extent=FullFilm())
SUPPORT = with_springs(FULL, K)
PI = with_springs(PorousDamper(**DIMENSIONS, cage=CAGE), K)
ROTOR = RigidRotor(mass=MASS, speed=SPEED, unbalance=1e-3 * MASS * 1e-4, gravity=(0.0, 0.0))


@pytest.mark.closed_form
@pytest.mark.parametrize("inflow", [0.0, 0.02])
def test_small_motion_transmissibility_is_the_closed_form(inflow):
    feed = RadialFeed(inflow=inflow) if inflow else None
    support = with_springs(replace(FULL, feed=feed), K)
    leak = 12.0 * 0.01 * mean_permeability(0.1)
    Bs = 4e-3 * 0.05 * 0.025**3 / (MASS * SPEED * 1e-12)
    cv = np.pi * Bs / (1.0 + leak)
    k = K / MASS / SPEED**2 + 3.0 * np.pi * Bs * (inflow / 1e-4 / SPEED) / (1.0 + leak) ** 2
    T = small_motion_transmissibility(ROTOR, support)
    omega = np.array([0.05, 0.3, 1.0, 2.5, 20.0])
    s = 1j * omega
    expected = (cv * s + k) / (s**2 + cv * s + k)
    assert_allclose(T(SPEED * s), expected, rtol=1e-10)
    assert abs(T(1j * SPEED * np.sqrt(2.0 * k))) == pytest.approx(1.0, abs=1e-12)


def test_transfer_function_is_the_orbit_of_small_unbalance_and_its_simulation():
    expected = abs(small_motion_transmissibility(ROTOR, SUPPORT)(1j * SPEED))
    (orbit,) = synchronous_orbits(ROTOR, SUPPORT).at(ROTOR.unbalance)
    assert orbit.transmissibility == pytest.approx(expected, rel=1e-5)
    run = simulate(ROTOR, SUPPORT, duration=0.6, samples=400)
    assert transmitted_ratio(run, ROTOR)[-1] == pytest.approx(expected, rel=1e-4)


def test_pi_film_about_rest_is_refused_and_told_what_to_do():
    with pytest.raises(UndefinedDerivativeError, match=r"no damping matrix at rest.*orbit_coefficients"):
        small_motion_transmissibility(ROTOR, PI)


@pytest.mark.closed_form
@pytest.mark.parametrize("eps", [1e-6, 0.4, 0.9])
@pytest.mark.parametrize("speed", [400.0, -400.0])
def test_equivalent_coefficients_of_the_solid_pi_film(eps, speed):
    # K = 2 mu R (L/c)^3 w e/(1-e^2)^2, C = (pi/2) mu R (L/c)^3/(1-e^2)^1.5.
    unit = 4e-3 * 0.05 * 250.0**3
    found = orbit_coefficients(PorousDamper(**DIMENSIONS), eps, speed)
    assert found.stiffness == pytest.approx(2.0 * unit * 400.0 * eps / (1 - eps**2) ** 2, rel=1e-8)
    assert found.damping == pytest.approx(0.5 * np.pi * unit / (1 - eps**2) ** 1.5, rel=1e-10)


def test_linear_rotor_with_equivalent_coefficients_is_on_the_orbit():
    rotor = replace(ROTOR, unbalance=0.3 * MASS * 1e-4)
    (orbit, *_) = synchronous_orbits(rotor, PI).at(rotor.unbalance)
    found = orbit_coefficients(PI, orbit.eccentricity_ratio, SPEED)
    s = 1j * SPEED
    transmitted = (found.damping * s + found.stiffness) / (MASS * s**2 + found.damping * s + found.stiffness)
    assert abs(transmitted) == pytest.approx(orbit.transmissibility, rel=1e-9)


def test_static_eccentricity_by_the_ordinary_closed_loop():
    # At rest the film carries nothing: the springs hold the load, the damping is that of the place.
    at = equilibrium(SUPPORT, [0.0, -10.0], SPEED)
    assert_allclose(at.position, [0.0, -10.0 / K], rtol=1e-9, atol=1e-14)
    loop = closed_loop(ROTOR, SUPPORT, at)
    e, leak = 10.0 / K / 1e-4, 12.0 * 0.01 * mean_permeability(0.1)
    theta = 2.0 * np.pi * np.arange(4000) / 4000
    density = FULL.force_scale / 1e-4 / ((1.0 + e * np.cos(theta)) ** 3 + leak) * 2.0 * np.pi / 4000
    across, along = density @ np.sin(theta) ** 2, density @ np.cos(theta) ** 2
    expected = np.concatenate([np.roots([MASS, c, K]) for c in (across, along)])
    assert_allclose(np.sort_complex(loop.poles()), np.sort_complex(expected), rtol=1e-8)


def test_orbit_system_is_the_derivative_of_the_orbit():
    # A small extra unbalance along the old one is a constant radial-tangential force in turning axes.
    rotor = replace(ROTOR, unbalance=0.3 * MASS * 1e-4)
    (orbit,) = synchronous_orbits(rotor, PI).at(rotor.unbalance)
    system = orbit_system(rotor, PI, orbit)
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["force_radial", "force_tangential"]
    assert system.output_labels[-1] == "housing_tangential"
    gain = control.dcgain(system)
    h = 1e-5 * rotor.unbalance
    pull = h * SPEED**2 * np.array([np.cos(orbit.phase), -np.sin(orbit.phase)])
    more, less = (
        synchronous_orbits(rotor, PI, [rotor.unbalance + side * h]).branches[0] for side in (1.0, -1.0)
    )
    change = gain @ pull
    radius = 1e-4 * 0.5 * (more.eccentricity_ratio - less.eccentricity_ratio)[0]
    across = 1e-4 * orbit.eccentricity_ratio * 0.5 * (more.phase - less.phase)[0]
    assert_allclose(change[:2], [radius, across], rtol=1e-5)
    assert_allclose(change[2:4], 0.0, atol=1e-6 * SPEED * abs(radius))
    assert max(system.poles().real) == pytest.approx(orbit.growth_rate, rel=1e-9)


def test_what_has_no_coefficients_is_refused():
    with pytest.raises(InputError, match="eccentricity_ratio must be finite and positive"):
        orbit_coefficients(PI, 0.0, SPEED)
    with pytest.raises(InputError, match="speed must not be zero"):
        orbit_coefficients(PI, 0.3, 0.0)
    with pytest.raises(FilmContactError, match="inside the clearance"):
        orbit_coefficients(PI, 1.0, SPEED)


def test_film_that_couples_the_axes_is_refused():
    class Coupled(Parallel):
        def prepared_jacobian(self, position, velocity, speed):
            jacobian = super().prepared_jacobian(position, velocity, speed)
            jacobian[0, 1] += 1e6
            return jacobian

    with pytest.raises(InputError, match="stiffness at the center must be isotropic without cross coupling"):
        small_motion_transmissibility(ROTOR, Coupled(SUPPORT.reactions))
