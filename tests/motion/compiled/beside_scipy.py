"""What runs on films with states share: rotors, bearings beside the films, the comparison with scipy."""

import numpy as np

import rotorfilm as rf
from rotorfilm.rotors import CrackedRotor, GaschHinge, JeffcottCrack, LinearMotor

SEAL = rf.FrequencyDependentReaction(
    A=[[-400.0, 150.0], [-90.0, -700.0]],
    B=[[1.0, 0.5], [-0.4, 1.0]],
    C=[[2e8, -1e8], [1e8, 3e8]],
    D=[[2e5, 4e4], [-5e4, 3e5]],
    damping=[[300.0, 0.0], [20.0, 400.0]],
)
HEAVY_OIL = rf.SqueezeFilmDamper(
    radius=0.05, length=0.02, clearance=1e-4, viscosity=0.02, density=800.0, extent=rf.FullFilm()
)
MOTOR = LinearMotor(stall_torque=300.0, idle_speed=420.0)
STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7850.0)


def cracked(profile):
    """Return a cracked shaft."""
    return CrackedRotor(
        rotor=rf.JeffcottRotor(mass=20.0, journal_mass=2.0, stiffness=2e7, unbalance=1e-4, speed=profile),
        crack=JeffcottCrack(reduction=0.3),
        breathing=GaschHinge(edge=0.8),
    )


def long_shaft(count, speed):
    """Return a shaft of so many elements."""
    return rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.2, outer_diameter=0.08, material=STEEL).split(count),
        stations=(rf.Station(name="left", node=0), rf.Station(name="right", node=count)),
        unbalances=(rf.Unbalance(node=count // 2, unbalance=1e-3),),
        speed=speed,
    )


def require_same_motion(run, reference, share):
    """Assert that a run was compiled and all its signals are those of scipy, in shares of their changes."""
    assert "rejected" in run.work
    assert set(run.signals) == set(reference.signals)
    for name, signal in reference.signals.items():
        size = np.ptp(signal) or 1.0
        assert np.abs(run[name] - signal).max() < share * size, name
