"""A sealed damper of a turbocharger: what seals and the inertia of the oil make of its orbit.

A rotor with 0.9 kg on the damper turns at 60 000 rpm. Its seals, known to a fifth, set damping and added
mass; what an orbit transmits is told with the inertia of the oil and without, and at both ends of that
fifth.
"""

from dataclasses import replace

import numpy as np

from rotorfilm import (
    EndSeal,
    FiniteSqueeze,
    FullFilm,
    RigidRotor,
    SqueezeFilmDamper,
    coefficients,
    small_motion_transmissibility,
    synchronous_orbits,
    with_springs,
)

SPEED = 60_000 * np.pi / 30.0
oil_film = SqueezeFilmDamper(
    radius=14e-3,
    length=9e-3,
    clearance=60e-6,
    viscosity=8e-3,
    density=850.0,
    extent=FullFilm(),
    film=FiniteSqueeze(),
    seals=EndSeal(leakage=4e-10, uncertainty=0.2),
)
print(f"squeeze Reynolds number {oil_film.reynolds_number(SPEED):.2f}")
print(coefficients(oil_film, [0.0, 0.0], SPEED))
added = oil_film.small_motion(0.0).added_mass
rotor = RigidRotor(mass=0.9, speed=SPEED, unbalance=4e-6, gravity=(0.0, 0.0))


def transmitted(film: SqueezeFilmDamper) -> float:
    """Return the force on the housing per centrifugal force of the unbalance."""
    support = with_springs(film, 1e6)
    (orbit,) = synchronous_orbits(rotor, support).at(rotor.unbalance)
    return orbit.transmissibility


with_inertia = transmitted(oil_film)
print(f"transmitted {with_inertia:.4f}; without inertia {transmitted(replace(oil_film, density=0.0)):.4f}")
ends = [transmitted(replace(oil_film, seals=seal)) for seal in oil_film.seals.bounds]
print(f"for the leakage within its uncertainty: {min(ends):.4f} to {max(ends):.4f}")

support = with_springs(oil_film, 1e6)
gain = small_motion_transmissibility(rotor, support)
crossing = np.sqrt(2.0 * 1e6 / (rotor.mass + 2.0 * added))
print("gain where it is 1 whatever the damping:", abs(gain(1j * crossing)))
