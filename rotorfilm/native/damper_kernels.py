"""Dampers with seals and the inertia of their oil, in the C library."""

from __future__ import annotations

from collections.abc import Mapping
from ctypes import addressof, c_double, c_void_p, cast
from typing import ClassVar, NamedTuple

import numpy as np

from ..model import Array
from .film_kernels import FilmKernel
from .layouts.damper_structs import OilDamperStruct
from .layouts.structs import JournalStruct
from .library import loops
from .response_kernels import ResponseKernel


class OilParts(NamedTuple):
    """What a damper with seals or inertia is made of; see native/films/oil_damper.h.

    Attributes
    ----------
    zone, closed, tabled : float [1]
        Shares of the inertia of a ruptured zone, of a short full film, of the table.
    sealed : float [1]
        Share of the circumference with pressure at leaking seals of a short film; 0 without.
    radial : ndarray, shape (terms, 7), or None
        Table of a full film of finite length.
    least : float [1]
        Of its sqrt(1 - eps^2).
    nodes, weights : ndarray
        Over the zone.
    """

    zone: float
    closed: float
    tabled: float
    sealed: float
    radial: Array | None
    least: float
    nodes: Array
    weights: Array

    def tables(self, mapped: Mapping[str, Array] | None, *, heavy: bool) -> dict[str, Array]:
        """Return the tables of the kernel "oil_damper"; those of the map, if it has one, among them."""
        parts = [mapped is not None, self.zone, self.closed, self.tabled, self.sealed, heavy]
        found = {"parts": np.array(parts, dtype=float), **(mapped or {})}
        if self.radial is not None:
            found |= {"radial": self.radial, "least": np.array([self.least])}
        if self.zone:
            found |= {"nodes": self.nodes, "weights": self.weights}
        return found


class OilScales(NamedTuple):
    """Its dimensions.

    Attributes
    ----------
    clearance : float [m]
    viscous : float [N s]
        viscosity radius length^3/clearance^2.
    inertial : float [kg m]
        density radius length^3.
    seal : float [1]
        Damping of the seals of a short film per `viscous`.
    """

    clearance: float
    viscous: float
    inertial: float
    seal: float


class OilDamperKernel(ResponseKernel):
    """Force and added mass of a damper in SI units.

    Parameters
    ----------
    parts : OilParts
    viscous : FilmKernel or None
        Map of the viscous film; None for the table.
    scales : OilScales
    """

    function: ClassVar[str] = "rf_oil_damper_at"

    def __init__(self, parts: OilParts, viscous: FilmKernel | None, scales: OilScales) -> None:
        self._arguments = (parts, viscous, scales)
        self.film = viscous or FilmKernel()
        places = (None, None) if viscous is None else (viscous.film, addressof(viscous.struct))
        radial = np.zeros((0, 7)) if parts.radial is None else parts.radial
        self._kept = [np.ascontiguousarray(part) for part in (radial, parts.nodes, parts.weights)]
        table, nodes, weights = (part.ctypes.data for part in self._kept)
        self.struct = OilDamperStruct(
            JournalStruct(*places, scales.clearance, scales.viscous, self.film.error, 0),
            viscous is not None,
            len(radial),
            table,
            parts.least,
            *scales[1:],
            parts.zone,
            parts.closed,
            parts.tabled,
            nodes,
            weights,
            len(parts.nodes),
            0,
        )
        super().__init__()

    @property
    def mass_address(self) -> int:
        """The address of its rf_mass_response."""
        return cast(loops()["rf_oil_damper_mass"], c_void_p).value or 0

    def mass(self, x: float, y: float, vx: float, vy: float) -> tuple[Array, Array]:
        """Return the added mass xx, xy, yy, shape (3,) [kg], and its slopes by x, y, vx, vy, (3, 4)."""
        mass, slopes = np.empty(3), np.empty((3, 4))
        state = (c_double * 5)(x, y, vx, vy, 0.0)
        loops()["rf_oil_damper_mass"](self._reference, state, mass.ctypes.data, slopes.ctypes.data)
        return mass, slopes
