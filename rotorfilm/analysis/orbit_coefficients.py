"""Dampers for python-control: small motion about the center, and about a circular orbit in turning axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..bearings.reaction import InertialCoefficients
from ..core.errors import InputError, require_number, require_positive
from ..core.inputs import arguments
from ..core.model import JournalForce, Reaction, inertial, orbit_mass, require_reaction
from ..core.readable import Readable
from ..core.results import CircularOrbit
from ..core.signals import Signal, force_outputs
from ..rotors import RigidRotor
from ..rotors.structure import rotating_linearization
from .coefficients import coefficients
from .linearize import state_space

if TYPE_CHECKING:
    import control

_SYMMETRY = 1e-9


@dataclass(frozen=True, kw_only=True)
class OrbitCoefficients(Readable):
    """Equivalent stiffness and damping of a film on a circular orbit: F_r = -K e, F_t = -C w e.

    Attributes
    ----------
    stiffness : float [N/m]
    damping : float [N s/m]
    eccentricity_ratio : float [1]
    speed : float [rad/s]
    """

    stiffness: float
    damping: float
    eccentricity_ratio: float
    speed: float


@arguments
def orbit_coefficients(reaction: Reaction, eccentricity_ratio: float, speed: float) -> OrbitCoefficients:
    """Return the equivalent coefficients of a film on a synchronous circular orbit.

    With inertia the stiffness is that without the added mass, minus its mass times speed^2. They are what a
    linear code may take for a cavitated film, which has no damping matrix at rest: exact for this orbit, no
    derivative, and different at every radius.

    Parameters
    ----------
    reaction : Reaction
        Isotropic.
    eccentricity_ratio : float [1]
        Radius of the orbit / clearance, above 0 and below 1.
    speed : float [rad/s]
        Of the orbit, not zero.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    FilmContactError
        If the orbit is as wide as the clearance.
    """
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    require_positive("eccentricity_ratio", eccentricity_ratio)
    if require_number("speed", speed) == 0.0:
        raise InputError(f"speed must not be zero on an orbit, got {speed!r}")
    radius = eccentricity_ratio * reaction.clearance
    radial, tangential = reaction.force([radius, 0.0], [0.0, speed * radius], speed)
    heavy = inertial(reaction)
    if heavy is not None:
        heavy.require_range(speed)
        swung = heavy.mass([radius, 0.0], [0.0, speed * radius], speed)[:, 0] * speed**2 * radius
        radial, tangential = radial + swung[0], tangential + swung[1]
    return OrbitCoefficients(
        stiffness=float(-radial / radius),
        damping=float(-tangential / (speed * radius)),
        eccentricity_ratio=eccentricity_ratio,
        speed=speed,
    )


@arguments
def small_motion_transmissibility(
    rotor: RigidRotor, reaction: Reaction, name: str | None = None
) -> control.TransferFunction:
    """Return the force on the housing per force on the rotor in small motion about the center.

    T(s) = (M s^2 + C s + K)/((m + M) s^2 + C s + K), M being the mass that the film adds; |T| = 1 at
    s = i sqrt(2 K/(m + 2 M)) whatever the damping, and M/(m + M) at high speed.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
        Film and springs, isotropic at the center, without cross coupling: a damper with a full film.
    name : str, optional

    Raises
    ------
    UndefinedDerivativeError
        For a cavitated film, which has no damping matrix at rest; `orbit_coefficients` are what it offers.
    InputError
        If the film couples x and y at the center.
    """
    at = coefficients(reaction, [0.0, 0.0], 0.0)
    stiffness, damping = _isotropic("stiffness", at.stiffness), _isotropic("damping", at.damping)
    added = 0.0
    if isinstance(at, InertialCoefficients):
        added = _isotropic("mass", at.mass)
    numerator = [damping, stiffness]
    import control

    return control.TransferFunction(
        [added, *numerator] if added else numerator,
        [rotor.mass + added, *numerator],
        inputs=["force"],
        outputs=["housing_force"],
        name=name,
    )


@arguments
def orbit_system(
    rotor: RigidRotor, reaction: Reaction, orbit: CircularOrbit, name: str | None = None
) -> control.StateSpace:
    """Return the small motion about a circular orbit, in radial and tangential axes that turn with it.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
        Film and springs.
    orbit : CircularOrbit
        As `synchronous_orbits(...).at(...)` returns them, stable or not.
    name : str, optional

    Returns
    -------
    control.StateSpace
        Inputs force_radial, force_tangential: small force on the rotor [N]. Outputs radial, tangential and
        their rates: change of the position in turning axes [m, m/s]; housing_radial, housing_tangential:
        change of the force on the housing [N]. Its poles are the Floquet exponents of the orbit.
    """
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    radius = orbit.eccentricity_ratio * reaction.clearance
    position, velocity = np.array([radius, 0.0]), np.array([0.0, orbit.speed * radius])
    film = reaction.jacobian(position, velocity, orbit.speed)
    added = orbit_mass(reaction, position, velocity, orbit.speed)
    matrices = rotating_linearization(rotor.mass, orbit.speed, film, added)
    nominal = reaction.outputs[0].nominal
    inputs = tuple(
        Signal(name=f"force_{axis}", unit="N", nominal=nominal, description=f"{axis} force on the rotor")
        for axis in ("radial", "tangential")
    )
    states = _turning_states(reaction.clearance, abs(orbit.speed))
    return state_space(matrices, inputs, (*states, *_housing_outputs(nominal)), states, name)


def _turning_states(length: float, speed: float) -> tuple[Signal, ...]:
    """Return the signals of the position in turning axes and of its rates."""
    return tuple(
        Signal(name=f"{axis}{rate}", unit=unit, nominal=nominal, description=f"{axis} displacement{rate}")
        for rate, unit, nominal in (("", "m", length), ("_rate", "m/s", length * speed))
        for axis in ("radial", "tangential")
    )


def _housing_outputs(nominal: float) -> tuple[Signal, ...]:
    unit = force_outputs(nominal)[0].unit
    return tuple(
        Signal(name=f"housing_{axis}", unit=unit, nominal=nominal, description=f"{axis} force on the housing")
        for axis in ("radial", "tangential")
    )


def _isotropic(name: str, matrix: np.ndarray) -> float:
    value = 0.5 * float(np.trace(matrix))
    if np.abs(matrix - value * np.eye(2)).max() > _SYMMETRY * max(abs(value), np.abs(matrix).max()):
        raise InputError(
            f"{name} at the center must be isotropic without cross coupling, got {matrix.tolist()}"
        )
    return value
