"""Shear and flow of films in the C library, on NumPy arrays."""

from __future__ import annotations

from ctypes import byref, c_double, c_size_t, c_void_p, cast
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..model import Array
from .film_kernels import periodic
from .heat_structs import OpeningMapStruct
from .library import functions, loops
from .structs import LossMapStruct


class LossBatch(NamedTuple):
    """The answer for a batch.

    Attributes
    ----------
    losses : ndarray, shape (3, n)
        Sigma of the film, Sigma of the streamers, side flow.
    slopes : ndarray, shape (3, 4, n)
        Their derivatives by (eccentricity, source).
    status : int
        The most severe status.
    first : int
        The index of the first state that has it.
    """

    losses: Array
    slopes: Array
    status: int
    first: int


class LossKernel:
    """The losses of a film, an rf_loss of the C library.

    Attributes
    ----------
    struct : ctypes.Structure or None
        What it reads.
    openings : bool
        Whether that is of a film with openings.
    """

    _function: ClassVar[str]
    _arguments: tuple[Any, ...] = ()
    struct: Any = None
    openings: ClassVar[bool] = False

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    @property
    def tables(self) -> dict[str, Array]:
        """What the kernels of bearings whose oil warms read of these losses."""
        return {}

    @property
    def address(self) -> int | None:
        """The address of its rf_loss."""
        return cast(self._compiled(self._function), c_void_p).value

    def _compiled(self, name: str) -> Any:
        """Return a function; no FMU at one viscosity needs those of openings."""
        return (loops() if self.openings else functions())[name]

    def losses(self, eccentricity: Array, source: Array) -> LossBatch:
        """Return losses and slopes at the eccentricities and sources (2, n)."""
        e, w = (np.ascontiguousarray(rows, dtype=float) for rows in (eccentricity, source))
        losses, slopes, first = np.empty((3, e.shape[1])), np.empty((3, 4, e.shape[1])), c_size_t()
        function = c_void_p(self.address)
        data = None if self.struct is None else byref(self.struct)
        places = [rows.ctypes.data for rows in (e, w, losses, slopes)]
        status = functions()["rf_loss_batch"](function, data, e.shape[1], *places, byref(first))
        return LossBatch(losses, slopes, status, first.value)


class ShortLossKernel(LossKernel):
    """Those of the short-bearing film, whatever its length / diameter."""

    _function: ClassVar[str] = "rf_short_losses"


class MapLossKernel(LossKernel):
    """Those of one plain bearing from its maps of shear and flow.

    Parameters
    ----------
    coefficients : ndarray, shape (3, cells_x + 5, cells_s + 5)
        Quintic B-spline coefficients of M(X, s) of the three maps.
    reach : float
        X of the last node.
    log_center : ndarray, shape (3,)
        L0 of the three.
    crowding : float
        Ratio of tan s and the tangent of the angle between eccentricity and source.
    """

    _function: ClassVar[str] = "rf_map_losses"

    def __init__(self, coefficients: Array, reach: float, log_center: Array, crowding: float) -> None:
        self._arguments = (coefficients, reach, log_center, crowding)
        self.coefficients = np.ascontiguousarray(coefficients, dtype=float)
        self.log_center = np.ascontiguousarray(log_center, dtype=float)
        cells_x, cells_s = (count - 5 for count in self.coefficients.shape[1:])
        center = (c_double * 3)(*self.log_center)
        self.struct = LossMapStruct(cells_x, cells_s, reach, crowding, center, self.coefficients.ctypes.data)

    @property
    def tables(self) -> dict[str, Array]:
        """The three maps; see `LossKernel.tables`."""
        reach = np.array([self.struct.x_end])
        return {
            "loss_coefficients": self.coefficients,
            "loss_center": self.log_center,
            "loss_reach": reach,
            "loss_squeeze": np.array([self.struct.squeeze]),
        }


class GrooveLossKernel(LossKernel):
    """Those of one bearing with axial openings from its maps of shear and flow.

    Parameters
    ----------
    shear : ndarray, shape (2, 3, cells_x + 5, cells_e, cells_s + 5)
        Quintic B-spline coefficients over X, theta and s of the three maps, for oil that runs forward and
        backward; over theta those centered on the nodes.
    flows : ndarray, shape (2, 2, openings, cells_x + 5, cells_e)
        Those over X and theta of the flow out of the openings and into them, over half the speed.
    edges : ndarray, shape (lands, 2) [rad]
        Angles where the films between openings begin and end, from the axis of the openings.
    numbers : (float, float, float)
        X of the last node, crowding, and angle of the axis in the bearing frame [rad].
    """

    _function: ClassVar[str] = "rf_groove_losses"
    openings: ClassVar[bool] = True

    def __init__(self, shear: Array, flows: Array, edges: Array, numbers: tuple[float, float, float]) -> None:
        self._arguments = (shear, flows, edges, numbers)
        self._shear, self._flows = (
            np.ascontiguousarray(periodic(each, 3 + k)) for k, each in ((0, shear), (1, flows))
        )
        self._edges = np.ascontiguousarray(edges)
        cells_x, cells_e, cells_s = (count - 5 for count in self._shear.shape[2:])
        places = (array.ctypes.data for array in (self._shear, self._flows, self._edges))
        counts = cells_x, cells_e, cells_s, flows.shape[2], len(edges)
        self.struct = OpeningMapStruct(*counts, *numbers, *places)

    def flows(self, eccentricity: Array, rate: Array) -> Array:
        """Return flows out of the openings and into them, (2, openings, n), at half the speeds (n,)."""
        e, along = (np.ascontiguousarray(rows, dtype=float) for rows in (eccentricity, rate))
        found = np.empty((2, self.struct.openings, e.shape[1]))
        places = [rows.ctypes.data for rows in (e, along, found)]
        self._compiled("rf_groove_flows")(byref(self.struct), e.shape[1], *places)
        return found

    @property
    def tables(self) -> dict[str, Array]:
        """The maps; see `LossKernel.tables`."""
        return {
            "loss_coefficients": self._shear.reshape(-1, *self._shear.shape[2:]),
            "loss_flows": self._flows.reshape(-1, *self._flows.shape[3:]),
            "loss_edges": self._edges,
        }
