"""Dampers by their dimensionless groups, and the rotor on them."""

import numpy as np
import pytest

from rotorfilm import PorousCage, PorousDamper, RigidRotor, with_springs

RADIUS, LENGTH, CLEARANCE, MASS, SPEED = 0.05, 0.025, 1e-4, 10.0, 400.0


@pytest.fixture(scope="session")
def support():
    """Return a function (Bs, Omega_s, Phi, ...) -> damper with springs; H/L = 0.1, w_r = the speed."""

    def build(squeeze, spring, phi=0.0, grading=0.0, **more):
        viscosity = squeeze * MASS * SPEED * CLEARANCE**3 / (RADIUS * LENGTH**3)
        cage = None
        if phi:
            thickness = 0.1 * LENGTH
            cage = PorousCage(
                thickness=thickness, permeability=phi * CLEARANCE**3 / thickness, grading=grading
            )
        damper = PorousDamper(
            radius=RADIUS, length=LENGTH, clearance=CLEARANCE, viscosity=viscosity, cage=cage, **more
        )
        return with_springs(damper, MASS * (spring * SPEED) ** 2) if spring else damper

    return build


@pytest.fixture(scope="session")
def rotor():
    """Return a function U -> rotor with that unbalance ratio."""

    def build(ratio, speed=SPEED, **more):
        return RigidRotor(
            mass=MASS, speed=speed, unbalance=ratio * MASS * CLEARANCE, gravity=(0.0, 0.0), **more
        )

    return build


@pytest.fixture(scope="session")
def unit():
    """Return the unbalance of ratio 1 [kg m]."""
    return MASS * CLEARANCE


@pytest.fixture(scope="session")
def whirl():
    """Return a function: state (x, y, vx, vy) at t = 0 on a circular orbit, disturbed in turning axes."""

    def state(orbit, disturbance=(0.0, 0.0, 0.0, 0.0)):
        radial = CLEARANCE * (orbit.eccentricity_ratio + disturbance[0])
        r = np.array([radial, CLEARANCE * disturbance[1]])
        rate = CLEARANCE * orbit.speed * np.array(disturbance[2:]) + orbit.speed * np.array([-r[1], r[0]])
        cos, sin = np.cos(orbit.phase), np.sin(orbit.phase)
        turn = np.array([[cos, -sin], [sin, cos]])
        return np.concatenate([turn @ r, turn @ rate])

    return state
