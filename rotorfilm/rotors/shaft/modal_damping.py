"""A rotor whose modes have damping ratios that were measured, or are usual."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from ...errors import InputError, require_non_negative
from ...inputs.si_arguments import quantities
from ...model import Array
from ..profile import SpeedProfile
from ..projection import mean_plane
from ..sparse_chain import dense_matrix
from ..structure import FlexibleRotor, Structure, both_planes, check_motion, dense


@quantities
@dataclass(frozen=True, kw_only=True)
class ModallyDampedRotor(FlexibleRotor):
    """A rotor with damping ratios of its lowest undamped modes in each plane: a Dynamic model.

        C = sum over the modes of 2 ratio w M u u' M,  u' M u = 1

    added to the damping that it has; it does not turn with the shaft. Modes beyond those named keep what they
    have. At rest on bearings of the stiffness named the ratios are exact; with gyroscopic effect and on other
    bearings the modes couple.

    Parameters
    ----------
    rotor : FlexibleRotor
    damping_ratios : tuple of float [1]
        From the lowest mode on.
    bearing_stiffness : float [N/m]
        Of each station, in the modes; 0 for those of the free shaft, whose motions without springs count as
        the first.
    speed : float or SpeedProfile [rad/s]
        In place of that of the rotor.
    gravity : tuple of two floats [m/s2]
        Must be that of the rotor.
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.

    Raises
    ------
    InputError
        If a ratio is negative, or the rotor has fewer modes.
    """

    rotor: FlexibleRotor
    damping_ratios: tuple[float, ...]
    speed: float | SpeedProfile
    gravity: tuple[float, float]
    bearing_stiffness: float = 0.0
    initial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        require_non_negative("bearing_stiffness", self.bearing_stiffness)
        for k, ratio in enumerate(self.damping_ratios):
            require_non_negative(f"damping_ratios[{k}]", ratio)
        most = len(self.rotor.assembly.coordinates)
        if len(self.damping_ratios) > most:
            raise InputError(f"damping_ratios must be at most {most}, got {len(self.damping_ratios)}")
        if tuple(self.gravity) != tuple(self.rotor.gravity):
            raise InputError(f"gravity must be that of the rotor {self.rotor.gravity}, got {self.gravity}")
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor, dense, with the damping of its modes."""
        full = dense(self.rotor.assembly)
        return full._replace(damping=full.damping + both_planes(self._modal(full)))

    def _modal(self, full: Structure) -> Array:
        n, count = len(full.coordinates), len(self.damping_ratios)
        if not count:
            return np.zeros((n, n))
        journals = full.journals[::2, :n]
        mass = dense_matrix(mean_plane(full.mass))
        held = mean_plane(full.stiffness) + self.bearing_stiffness * journals.T @ journals
        squares, shapes = eigh(held, mass, subset_by_index=[0, count - 1])
        rates = 2.0 * np.array(self.damping_ratios) * np.sqrt(np.maximum(squares, 0.0))
        pushed = mass @ shapes
        return np.asarray((pushed * rates) @ pushed.T)
