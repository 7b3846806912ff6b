"""The pressure dam bearing in SI units: the film on the grids of its pads, its losses and its heat."""

from __future__ import annotations

import math
from collections.abc import Sequence
from ctypes import addressof, byref, c_double, c_size_t
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_each,
    require_kind,
    require_non_negative,
    require_number,
    require_tuple,
    require_vector,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.results import BearingLosses
from ...native.film_kernels import Batch, Status
from ...native.library import loops
from ...native.spec import NativeSpec, parameter
from ...native.structs import structure
from ..films.finite_volumes import are_counts
from ..films.geometry import TURN, SunkArc
from ..films.mobility import Mobility, per_rate, require_mobility
from ..reaction import KernelReaction, broadcast_state
from .pad_bearing import OwnCenter, PadBearing, cells_on_each, collected_losses, cross

# A fixed pad with its own center of curvature, and a recess in it.


@quantities
@dataclass(frozen=True, kw_only=True)
class Recess:
    """A recess of constant depth: a pressure dam or step if it ends inside its pad, else a relief track.

    Parameters
    ----------
    depth : float [m]
        Depth below the pad's surface; 0 for no recess.
    end : float [rad]
        Angle in the bearing frame of its edge on the +theta side. This is the step for positive rotation.
    share : float [1]
        Share of the bearing length that it takes, about the middle; 1 is a step of full length.
    start : float or None [rad]
        Angle of its other edge; None is the start of the pad.

    Raises
    ------
    InputError
        If a number breaks its rule.
    """

    depth: float
    end: float
    share: float = 1.0
    start: float | None = None

    def __post_init__(self) -> None:
        require_non_negative("depth", self.depth)
        require_number("end", self.end)
        require_number("share", self.share)
        if not 0.0 < self.share <= 1.0:
            raise InputError(f"share must be in (0, 1], got {self.share!r}")
        if self.start is not None:
            require_number("start", self.start)


@quantities
@dataclass(frozen=True, kw_only=True)
class RecessedPad(OwnCenter):
    """A fixed pad, which may have a recess: an arc of the wall with its own center of curvature.

    Its radius of curvature is the journal radius plus the pad clearance, and its ends are at ambient
    pressure. The smallest gap around a centered journal is the assembled clearance, (1 - preload) times the
    pad clearance.

    Parameters
    ----------
    start : float [rad]
        First end in the bearing frame, from +x towards +y: the leading edge for positive rotation.
    extent : float [rad]
        Angle covered, 0 < extent < 2 pi.
    preload : float [1]
        1 - assembled clearance / pad clearance, 0 <= preload < 1; 0 is a pad about the bearing center.
    offset : float [1]
        Place of the smallest gap around a centered journal, as a share of the extent from the start, 0 to 1.
        It is 0.5 in the middle and 1 at the end, where the film converges along the whole pad.
    recess : Recess or None
        Dam, step or relief track.

    Raises
    ------
    InputError
        If a number breaks its rule, or the recess leaves the pad.
    """

    recess: Recess | None = None

    def __post_init__(self) -> None:
        require_each(self, require_number, "start", "extent")
        if not 0.0 < self.extent < TURN:
            raise InputError(f"extent must be in (0, 2 pi), got {self.extent!r}")
        self._require_curve()
        require_kind("recess", self.recess, Recess | None, "a Recess or None")
        _ = self.edges

    @property
    def end(self) -> float:
        """Angle of its second end [rad]."""
        return self.start + self.extent

    @property
    def edges(self) -> tuple[float, float, float, float]:
        """Angles of the first end, both edges of the recess, and the second end [rad]."""
        recess = self.recess
        if recess is None or recess.depth == 0.0:
            return self.start, self.start, self.start, self.end
        first = self.start if recess.start is None else self._within("start", recess.start)
        last = self._within("end", recess.end)
        if not first < last:
            raise InputError(f"recess must end after its start, got from {first!r} to {last!r} rad")
        return self.start, first, last, self.end

    def _within(self, name: str, angle: float) -> float:
        """Return an angle of the recess as one of this pad, some turns away; ends of the pad to the digit."""
        angle = self.start + (angle - self.start) % TURN
        for end in (self.start, self.end):
            if abs(math.remainder(angle - end, TURN)) <= 1e-12:
                return end
        if angle > self.end:
            raise InputError(
                f"{name} of the recess must be on its pad, from {self.start!r} to {self.end!r} rad, "
                f"got {angle!r}"
            )
        return angle


# The pressure dam bearing in SI units: the film on the grids of its pads, its losses and its heat.


PARAMETERS = (
    ("radius", "m", "bearing radius"),
    ("length", "m", "axial length"),
    ("clearance", "m", "radial clearance of a pad"),
    ("viscosity", "Pa.s", "dynamic viscosity"),
)
"""Names, units and meanings of what a simulator may set in the compiled bearing."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PressureDamBearing(PadBearing, KernelReaction):
    """A bearing of fixed pads, any of which may have a recess: pressure dam, step, relief track.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal.
    Angles are absolute, from +x towards +y. The film is two-dimensional, on a grid of its own for each pad,
    with ambient pressure, 0, at all edges of the pads and where it ruptures.

    Dimensions, clearance and lubricant are the parameters of `PadBearing`.

    Parameters
    ----------
    pads : tuple of RecessedPad
        See `pressure_dam_pads` for the usual two.
    cells : tuple of int
        Cells around each pad and along half the length, multiples of 4 and at least 16 and 8; a recess gets
        its share of them, at least 4 on each side of its edges.
    extrapolated : bool
        Whether the force is extrapolated from these cells and half as many, by adding a third of the
        difference.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow.

    Raises
    ------
    InputError
        As a `PadBearing`, and if another value breaks its rule or pads overlap.

    Notes
    -----
    Let d be the position from the pad's center of curvature, c_p the pad clearance, e = d/c_p, and D the
    depth of the recess divided by c_p. The equation is that of `ReynoldsFilm` with H = 1 - e.n + D, and with
    (speed/2) D_theta beside the source -w.n, for P >= 0 (Nicholas & Allaire 1980). Edges of recesses are on
    nodes, and the source at a step is the difference of the Couette flow on both sides. Derivatives are those
    of the discrete film with the edge of the ruptured zone held, since pressure and slope vanish there; the
    damping matrix is symmetric. Losses and inertia at the step, inlet pressure, and hot oil carry-over from
    pad to pad are neglected. A mobility is a factor of H^3 that depends on the local depth: a recess becomes
    turbulent first. The force is homogeneous of degree one in velocity and speed together. It does not depend
    on the source alone, so there is no map of it.

    Examples
    --------
    >>> from rotorfilm import PressureDamBearing, pressure_dam_pads
    >>> pads = pressure_dam_pads(depth="61 um", end="145 deg", share=0.75)
    >>> bearing = PressureDamBearing(
    ...     diameter="25.4 mm", length="25.4 mm", pad_clearance="55.9 um", viscosity=0.0524, pads=pads
    ... )
    >>> bearing.force(position=[0.0, -1e-5], velocity=[0.0, 0.0], speed=837.8).shape
    (2,)
    """

    pads: tuple[RecessedPad, ...]
    cells: tuple[int, int] = (64, 16)
    extrapolated: bool = True
    mobility: Mobility | None = None

    def __post_init__(self) -> None:
        require_tuple("pads", self.pads, RecessedPad)
        require_kind("extrapolated", self.extrapolated, bool, "True or False")
        require_mobility(self.mobility)
        if not self.pads:
            raise InputError(f"pads must be one at least, got {self.pads!r}")
        if not are_counts(self.cells, (16, 8), (4, 4)):
            raise InputError(f"cells must be two multiples of 4, at least (16, 8), got {self.cells!r}")
        if self.mobility is not None and self.turbulence is not None:
            raise InputError(f"mobility must be None in a turbulent bearing, got {self.mobility!r}")
        super().__post_init__()
        _ = self.geometry

    @property
    def arcs(self) -> tuple[RecessedPad, ...]:
        """The pads as arcs of the film."""
        return self.pads

    @property
    def recesses(self) -> tuple[SunkArc, ...]:
        """Recesses in the pads."""
        return tuple(
            SunkArc(
                start=first, end=last, share=pad.recess.share, depth_ratio=pad.recess.depth / self.clearance
            )
            for pad in self.pads
            for _, first, last, _ in [pad.edges]
            if pad.recess is not None and first < last
        )

    @cached_property
    def kernel(self) -> DamKernel:
        """The films in compiled code; InputError without a stated temperature."""
        return self.kernel_on(self.extrapolated)

    def kernel_on(self, extrapolated: bool) -> DamKernel:
        """Return the films in compiled code, extrapolated from two grids or not."""
        self.require_temperature()
        return DamKernel(self.rows, list(self.dimensions.values()), extrapolated, self._oil_mobility)

    def on_cells(self, around: int, along: int) -> PressureDamBearing:
        """Return this bearing on about so many cells around all pads, and twice as many along as asked."""
        return replace(self, cells=cells_on_each(around, 2 * along, len(self.pads)))

    @property
    def _oil_mobility(self) -> Mobility | None:
        return self.turbulent_mobility or self.mobility

    @cached_property
    def rows(self) -> Array:
        """The pads as compiled code reads them."""
        return pad_rows(self.pads, self.cells)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over all pads [m], shape (...), of journals at positions (2, ...) [m].

        It is zero or negative where the journal touches a pad.
        """
        at = require_vector("position", position)
        films = [self._place.least(x, y)[0] for x, y in at.reshape(2, -1).T.tolist()]
        return np.array(films).reshape(at.shape[1:])

    @cached_property
    def _place(self) -> DamKernel:
        """The pads, of any viscosity."""
        return DamKernel(self.rows, [self.radius, self.length, self.clearance, 1.0], False)

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError, which names the pad, if a journal at positions (2, ...) [m] touches one.

        Inside the circle of the assembled clearance the journal touches no pad.
        """
        flat = position.reshape(2, -1)
        for x, y in flat[:, ~(np.hypot(*flat) < self.bore_clearance)].T.tolist():
            least, touched = self._place.least(x, y)
            if not least > 0.0:
                pad = self.pads[touched]
                raise FilmContactError(
                    f"position must keep the journal off pads[{touched}], {math.degrees(pad.start):.6g} to "
                    f"{math.degrees(pad.end):.6g} deg, got ({x!r}, {y!r}) m with a film of {least:.6g} m"
                )

    def report(self, status: int, state: tuple[float, ...] | list[float]) -> None:
        """Raise the error that belongs to the status of a state x, y, vx, vy, speed."""
        x, y, vx, vy, speed = state
        said = f"got ({x!r}, {y!r}) m, ({vx!r}, {vy!r}) m/s and {speed!r} rad/s"
        if status == Status.UNDEFINED:
            raise UndefinedDerivativeError(
                "velocity and speed must drive the film of every pad where a derivative is asked for, " + said
            )
        if status == Status.AT_WALL:
            self.require_film(np.array([x, y]))
        if status == Status.NOT_FINITE:
            raise InputError(f"position, velocity and speed must be finite and not overflow, {said}")
        if status == Status.NO_MEMORY:
            raise MemoryError("no memory for the film of a pad")
        raise ConvergenceError(f"the search for the ruptured zone of a pad must end, and did not: {said}")

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._answers(self.kernel, position, velocity, speed, False).reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        found = self._answers(self.kernel, position, velocity, speed, True)
        return found.reshape(2, 5, *position.shape[1:])

    def force_error(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the estimated error of the force on these cells, without extrapolation [N], shape (...).

        It is a third of the difference from the force on half as many cells; the extrapolated force is
        closer.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.
        """
        state = broadcast_state(position, velocity, speed)
        self.require_film(state[0])
        plain, richer = (self._answers(self.kernel_on(both), *state, False) for both in (False, True))
        return np.hypot(*(richer - plain)).reshape(state[2].shape)

    def pressure(self, pad: int, position: ArrayLike, velocity: ArrayLike, speed: float) -> PadPressure:
        """Return the pressure on pads[pad] at a position (2,) [m], velocity (2,) [m/s] and speed [rad/s]."""
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        state = (*q.tolist(), *v.tolist(), float(omega))
        found, status = self.kernel.pressure(pad, np.array(state))
        if status:
            self.report(status, state)
        theta, axial = pad_places(self.pads[pad], self.cells)
        return PadPressure(theta, axial, np.pad(found, ((0, 1), (0, 1))))

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses:
        """Return power loss, torques and oil flow, by the film on these cells.

        Opening i is the gap behind pad i, in the sense of +theta. If `full_gap` is None, the value of the
        cooling is used, or false.

        Raises
        ------
        InputError, FilmContactError
            As `force`.

        Notes
        -----
        As `losses_of_pads`; pressure on the steps adds c_p D p/2 to the torque, integrated along their edges.
        For the flow, a film begins only where streamers bring enough oil; the force does not include this
        effect.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        states = _flat(q, v, omega)
        rows = np.empty((len(self.pads), LOSSES, omega.size))
        for k, state in enumerate(states.T):
            rows[..., k] = self._losses_at(state)
        force, (steps, streamers, gap), flows = rows[:, :2], rows.swapaxes(0, 1)[2:5], rows[:, 5:]
        turning, scale, c = states[4], self.force_scale, self.clearance
        centers = np.array([pad.center for pad in self.pads])
        e = states[:2] / c - centers[:, :, None]
        pressed = np.stack([cross(*pair) for pair in zip(e, force, strict=True)]) + steps
        shear = (gap if self.full_gap(full_gap) else streamers) * turning
        drag = scale * c * (shear + 0.5 * pressed).sum(axis=0)
        through, starts = (flows[:, 0], flows[:, 1]), [pad.start for pad in self.pads]
        return collected_losses(self, starts, drag, scale * force.sum(axis=0), through, (q, v, omega))

    def _losses_at(self, state: Array) -> Array:
        found, status = self.kernel.losses(state)
        if status:
            self.report(status, state.tolist())
        return found

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; a subclass has none."""
        if type(self) is not PressureDamBearing or self.is_warming:
            return None
        parameters = tuple(
            parameter(name, unit, value, text)
            for (name, unit, text), value in zip(PARAMETERS, self.kernel.dimensions, strict=True)
        )
        tables = {"pads": self.rows, "extrapolated": np.array([float(self.extrapolated)])}
        if self._oil_mobility is not None:
            tables |= self._oil_mobility.tables()
        return NativeSpec(kernel="pressure_dam", parameters=parameters, tables=tables)

    def _answers(
        self, film: DamKernel, position: Array, velocity: Array, speed: Array, differentiated: bool
    ) -> Array:
        states = _flat(position, velocity, speed)
        batch = film.batch(states, differentiated=differentiated)
        if batch.status:
            self.report(batch.status, states[:, batch.first].tolist())
        return batch.values


def _flat(position: Array, velocity: Array, speed: Array) -> Array:
    """Return the states of a batch, of any shape, as columns (5, n)."""
    return np.concatenate([position.reshape(2, -1), velocity.reshape(2, -1), speed.reshape(1, -1)])


# The usual pressure dam bearing: two pads between two axial grooves.


GROOVE = math.radians(20.0)
"""Angle of an axial groove of Nicholas, Barrett & Leader (1980) [rad]."""


@arguments
def pressure_dam_pads(
    depth: float,
    end: float,
    share: float,
    track_depth: float = 0.0,
    track_share: float = 0.25,
    groove: float = GROOVE,
    preload: float = 0.0,
) -> tuple[RecessedPad, ...]:
    """Return the two pads of a pressure dam bearing that carries a load along -y.

    The axial grooves are at 0 and 180 deg. The dam in the upper pad begins at its leading edge (rotation
    about +z). The lower pad may have a relief track along its whole arc, which increases the load on its
    lands (Nicholas, Barrett & Leader 1980).

    Parameters
    ----------
    depth : float [m]
        Depth of the dam; 0 is a two-groove bearing.
    end : float [rad]
        Angle of the step, from +x: 125 to 150 deg, typically.
    share : float [1]
        Share of the length that the dam takes, about the middle.
    track_depth : float [m]
        Depth of the relief track; 0 for no track.
    track_share : float [1]
        Share of the length that the track takes.
    groove : float [rad]
        Angle of each axial groove.
    preload : float [1]
        Preload of both pads, with the smallest gap in their middle.

    Raises
    ------
    InputError
        If a value breaks its rule; see `Recess` and `RecessedPad`.
    """
    extent, half = math.pi - groove, 0.5 * groove
    dam = Recess(depth=depth, end=end, share=share) if depth else None
    bottom = math.pi + half
    track = Recess(depth=track_depth, end=bottom + extent, share=track_share) if track_depth else None
    return (
        RecessedPad(start=half, extent=extent, preload=preload, recess=dam),
        RecessedPad(start=bottom, extent=extent, preload=preload, recess=track),
    )


# The film of pads with recesses in compiled code (`native/grids/recess.h`).


COLUMNS = 13
"""Of a pad in the table of the kernel: the numbers of rf_recess_pad, in its order."""

LOSSES = 7
"""Of a pad: its force (2), steps, both shears, what enters it and what comes to its end."""

_Two, _Five, _Ten = c_double * 2, c_double * 5, c_double * 10


def cell_counts(pad: RecessedPad, cells: tuple[int, int]) -> tuple[list[int], list[int]]:
    """Return the cells of a pad before, in and behind its recess, and along the half length in and off it.

    In proportion, to multiples of 2, so that half as many have the edges on nodes too.
    """
    along = _divided([_share(pad), 1.0 - _share(pad)], cells[1])
    return _divided(np.diff(pad.edges).tolist(), cells[0]), along


def _divided(sizes: list[float], cells: int) -> list[int]:
    """Return cells for pieces of these sizes: multiples of 2, at least 4, none for a piece without size."""
    whole = sum(sizes)
    return [max(4, 2 * round(0.5 * cells * size / whole)) if size > 0.0 else 0 for size in sizes]


def pad_rows(pads: Sequence[RecessedPad], cells: tuple[int, int]) -> Array:
    """Return the pads as the kernel reads them, shape (pads, COLUMNS)."""
    return np.array([_row(pad, *cell_counts(pad, cells)) for pad in pads])


def pad_places(pad: RecessedPad, cells: tuple[int, int]) -> tuple[Array, Array]:
    """Return angles of the lines of a pad [rad] and places of its nodes along half the length, with ends."""
    around, along = cell_counts(pad, cells)
    return _nodes(pad.edges, around), _nodes((0.0, _share(pad), 1.0), along)


def _nodes(edges: tuple[float, ...], counts: list[int]) -> Array:
    """Return the nodes of a grid, equally spaced between edges."""
    pieces = [
        np.linspace(first, last, count, endpoint=False)
        for first, last, count in zip(edges[:-1], edges[1:], counts, strict=True)
        if count
    ]
    return np.concatenate([*pieces, edges[-1:]])


def _share(pad: RecessedPad) -> float:
    """Return the part of the length within which cells are of a recess; all of it without one."""
    return 1.0 if pad.recess is None or pad.recess.depth == 0.0 else pad.recess.share


def _row(pad: RecessedPad, around: list[int], along: list[int]) -> list[float]:
    depth = 0.0 if pad.recess is None else pad.recess.depth
    _, first, last, _ = pad.edges
    arc = [pad.start, pad.extent, pad.preload, pad.closest]
    return [*arc, first, last, depth, _share(pad), *around, *along]


class PadPressure(NamedTuple):
    """The pressure on one pad.

    Attributes
    ----------
    theta : ndarray, shape (N,) [rad]
        Angles of the lines of the grid, both ends of the pad included.
    axial : ndarray, shape (M,) [1]
        Places of its nodes, from the middle, 0, to the end, 1, of the bearing.
    pressure : ndarray, shape (N, M) [Pa]
    """

    theta: Array
    axial: Array
    pressure: Array


class DamKernel:
    """The film force of a bearing of pads with recesses, in SI units.

    Parameters
    ----------
    rows : ndarray, shape (pads, COLUMNS)
        Rows of `pad_rows`.
    dimensions : sequence of float
        Radius, length, clearance of a pad [m] and viscosity [Pa s].
    extrapolated : bool
        Whether forces are extrapolated from these cells and half as many.
    mobility : Mobility, optional
    """

    function: ClassVar[str] = "rf_recess_at"

    def __init__(
        self,
        rows: Array,
        dimensions: Sequence[float],
        extrapolated: bool,
        mobility: Mobility | None = None,
    ) -> None:
        self._arguments = (rows, list(dimensions), extrapolated, mobility)
        self.dimensions = tuple(dimensions)
        self._pads = (structure("rf_recess_pad") * len(rows))(*map(_pad_struct, rows))
        self.struct = structure("rf_recess")(
            addressof(self._pads), len(rows), *dimensions, extrapolated=extrapolated
        )
        if mobility is not None:
            radius, _, clearance, viscosity = dimensions
            self.struct.mobility = mobility.struct(per_rate(mobility, radius * clearance / viscosity))
        self._reference = byref(self.struct)
        self._at = loops()[self.function]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def call(self, *state: float) -> tuple[float, float, int]:
        """Return (force_x, force_y, status) at x, y, vx, vy, speed."""
        pair = _Two()
        status = self._at(self._reference, _Five(*state), pair, None)
        return pair[0], pair[1], status

    def tangent(self, *state: float) -> tuple[float, float, list[float], int]:
        """Return force_x, force_y, the ten entries of the Jacobian row by row, and a status."""
        pair, ten = _Two(), _Ten()
        status = self._at(self._reference, _Five(*state), pair, ten)
        return pair[0], pair[1], ten[:], status

    def batch(self, states: Array, *, differentiated: bool) -> Batch:
        """Return forces (2, n), or Jacobians (2, 5, n), of states x, y, vx, vy, speed (5, n)."""
        given, n, first = np.ascontiguousarray(states, dtype=float), states.shape[1], c_size_t()
        force = np.empty((2, n))
        jacobian = np.empty((2, 5, n)) if differentiated else None
        places = [None if rows is None else rows.ctypes.data for rows in (given, force, jacobian)]
        status = loops()["rf_recess_batch"](self._reference, n, *places, byref(first))
        return Batch(force if jacobian is None else jacobian, status, first.value)

    def pressure(self, pad: int, state: Array) -> tuple[Array, int]:
        """Return the pressure [Pa] of a pad at a state (5,) on its lines and nodes, and a status."""
        around, along = self._pads[pad].around, self._pads[pad].along
        field, given = np.zeros((sum(around), sum(along))), np.ascontiguousarray(state, dtype=float)
        status = loops()["rf_recess_field"](self._reference, pad, given.ctypes.data, field.ctypes.data)
        return field, status

    def losses(self, state: Array) -> tuple[Array, int]:
        """Return a row of `rf_recess_losses` for each pad at a state (5,), and a status."""
        rows, given = np.zeros((len(self._pads), LOSSES)), np.ascontiguousarray(state, dtype=float)
        status = loops()["rf_recess_losses"](self._reference, given.ctypes.data, rows.ctypes.data)
        return rows, status

    def least(self, x: float, y: float) -> tuple[float, int]:
        """Return the least film [m] at a position [m], and the pad that has it."""
        pad = c_size_t()
        return loops()["rf_recess_least"](self._reference, _Two(x, y), byref(pad)), pad.value


def _pad_struct(row: Array) -> Any:
    counts = row[8:13].astype(int).tolist()
    return structure("rf_recess_pad")(*row[:8].tolist(), tuple(counts[:3]), tuple(counts[3:]))
