"""Shafts that several tests look at, and what shafts do in closed form."""

import numpy as np
import pytest

from rotorfilm import LinearBearing
from rotorfilm.rotors import (
    Disk,
    ElasticMaterial,
    Probe,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    Unbalance,
    mount,
)

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)


class TimoshenkoShaft:
    """A uniform shaft whose modes are sines, in closed form: simply supported at both ends."""

    def __init__(self, piece):
        self.length = piece.length
        outer, inner = piece.outer_diameter, piece.inner_diameter
        area = np.pi / 4 * (outer**2 - inner**2)
        second = np.pi / 64 * (outer**4 - inner**4)
        self.bending = piece.material.young_modulus * second
        self.shear = piece.shear_coefficient * piece.material.shear_modulus * area
        self.mass, self.inertia = piece.material.density * area, piece.material.density * second

    def whirl(self, mode, speed):
        """Return the whirl frequencies [rad/s] of w = sin(mode pi z / L) exp(i p t), backward ones negative.

        m w'' = kGA (w_zz - theta_z),  j theta'' - 2 i j speed theta' = EI theta_zz + kGA (w_z - theta).
        """
        b, s = mode * np.pi / self.length, self.shear
        stiff = self.bending * b**2 + s
        j, m = self.inertia, self.mass
        # (s b^2 - m p^2) (stiff - j p^2 + 2 j speed p) - (s b)^2 = 0
        one = np.polynomial.Polynomial([s * b**2, 0.0, -m])
        two = np.polynomial.Polynomial([stiff, 2.0 * j * speed, -j])
        return np.sort((one * two - (s * b) ** 2).roots().real)


@pytest.fixture(scope="session")
def steel():
    return STEEL


@pytest.fixture(scope="session")
def timoshenko():
    return TimoshenkoShaft


@pytest.fixture(scope="session")
def friswell_591():
    """Friswell et al. (2010), section 5.9: 1.5 m x 50 mm, disks at 0.5 and 1.0 m, bearings at both ends."""

    def build(speed=0.0, **changes):
        piece = ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL)
        disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
        parts = {
            "elements": piece.split(6),
            "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
            "stations": (Station(node=0, name="left"), Station(node=6)),
            "probes": (Probe(node=2, name="small"), Probe(node=4, name="large")),
        }
        return ShaftRotor(speed=speed, **(parts | changes))

    return build


@pytest.fixture(scope="session")
def rich_rotor(friswell_591):
    """A rotor that has everything a ShaftRotor can have."""

    def build(speed):
        support = Support(mass=7.0, stiffness=((3e7, 1e6), (2e6, 4e7)), damping=500.0)
        return friswell_591(
            speed,
            stations=(Station(node=0, name="left", support=support), Station(node=6)),
            unbalances=(
                Unbalance(node=2, unbalance=1e-3, unbalance_angle=0.4),
                Unbalance(node=4, unbalance=2e-3),
            ),
            internal_damping=1e-5,
            gravity=(0.5, -9.0),
        )

    return build


@pytest.fixture(scope="session")
def on_springs():
    """Return a rotor on equal springs in all its stations."""

    def build(rotor, stiffness, damping=0.0):
        bearing = LinearBearing(stiffness=stiffness, damping=damping)
        return mount(rotor, dict.fromkeys(rotor.structure.stations, bearing))

    return build


@pytest.fixture(scope="session")
def frequencies():
    """Return the whirl frequencies [rad/s], each once, of a model without inputs."""

    def find(model):
        roots = np.linalg.eigvals(model.linearization(0.0, model.initial_state, []).A)
        return np.sort(roots.imag[roots.imag > 1e-6 * np.abs(roots).max() * 1e-3])

    return find
