"""Cracks of a shaft: which motion they give way to, and how much of the stiffness they take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...errors import InputError, require_count, require_kind, require_non_negative, require_number
from ...inputs.si_arguments import quantities
from ...model import Array
from ..jeffcott import JeffcottRotor
from ..shaft.elements import ShaftElement
from ..shaft.shaft_rotor import ShaftRotor
from .crack_compliance import crack_compliance


class Weakness(NamedTuple):
    """What an open crack takes from a rotor.

    Attributes
    ----------
    rows : ndarray, shape (2, N)
        What it gives way to, in the x-z and in the y-z plane, of the coordinates of the rotor.
    loss : ndarray, shape (2,)
        Stiffness against that which it takes in its weak and in its strong direction.
    """

    rows: Array
    loss: Array


@quantities
@dataclass(frozen=True, kw_only=True)
class JeffcottCrack:
    """A crack in the shaft of a `JeffcottRotor`, by what it takes of its stiffness when open.

    Parameters
    ----------
    reduction : float [1]
        Share of the stiffness lost in the direction of the crack, from 0 to below 1.
    cross_reduction : float [1]
        The same across; not larger.
    crack_angle : float [rad]
        From +x to the crack at t = 0, positive about +z.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    reduction: float
    cross_reduction: float = 0.0
    crack_angle: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("cross_reduction", self.cross_reduction)
        require_number("crack_angle", self.crack_angle)
        if not self.cross_reduction <= self.reduction < 1.0:
            raise InputError(
                f"reduction must be from cross_reduction {self.cross_reduction!r} to below 1, "
                f"got {self.reduction!r}"
            )

    def weakness(self, rotor: object) -> Weakness:
        """Return what it takes from a JeffcottRotor; raise InputError for another rotor."""
        require_kind("rotor", rotor, JeffcottRotor, "a JeffcottRotor for a JeffcottCrack")
        assert isinstance(rotor, JeffcottRotor)
        rows = np.array([[1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]])
        return Weakness(rows, rotor.stiffness * np.array([self.reduction, self.cross_reduction]))


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftCrack:
    """A transverse crack with a straight edge, in the middle of an element of a `ShaftRotor`.

    Parameters
    ----------
    element : int
        Its number, from 0; a solid cylinder.
    depth : float [m]
        At its deepest, to the radius.
    crack_angle : float [rad]
        From +x to the crack at t = 0, positive about +z.

    Raises
    ------
    InputError
        If an argument breaks its rule; where the rotor is known, if it has no such solid element.

    Notes
    -----
    A hinge of compliance h (`crack_compliance`) in the middle of an element of bending stiffness EI over a
    length l takes kappa^2 h/(1 + kappa h), kappa = EI/l, from its stiffness against the difference of the
    tilts of its ends: exactly, with shear or without.
    """

    element: int
    depth: float
    crack_angle: float = 0.0

    def __post_init__(self) -> None:
        require_count("element", self.element, 0)
        require_non_negative("depth", self.depth)
        require_number("crack_angle", self.crack_angle)

    def weakness(self, rotor: object) -> Weakness:
        """Return what it takes from a ShaftRotor; raise InputError for another rotor."""
        require_kind("rotor", rotor, ShaftRotor, "a ShaftRotor for a ShaftCrack")
        assert isinstance(rotor, ShaftRotor)
        piece = self._piece(rotor)
        compliance = crack_compliance(
            depth=self.depth,
            radius=0.5 * piece.outer_diameter,
            young_modulus=piece.material.young_modulus,
            poisson_ratio=piece.material.poisson_ratio,
        )
        stiff = float(np.mean(piece.section().bending)) / piece.length
        loss = [stiff * stiff * h / (1.0 + stiff * h) for h in compliance]
        size = len(rotor.assembly.coordinates)
        rows = np.zeros((2, 2 * size))
        for plane in range(2):
            first = plane * size + 2 * self.element + 1
            rows[plane, [first, first + 2]] = -1.0, 1.0
        return Weakness(rows, np.array(loss))

    def _piece(self, rotor: ShaftRotor) -> ShaftElement:
        count = len(rotor.elements)
        if self.element >= count:
            raise InputError(f"element must be from 0 to {count - 1}, got {self.element!r}")
        piece = rotor.elements[self.element]
        if not isinstance(piece, ShaftElement) or piece.tapered or piece.inner_diameter > 0.0:
            raise InputError(f"element {self.element} must be a solid cylinder for a crack, got {piece!r}")
        return piece
