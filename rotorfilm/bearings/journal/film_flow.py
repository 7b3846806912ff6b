"""Where the oil of a film goes: the flows through all faces, streamers of the ruptured zone, openings, ends.

All flows are in units of clearance x radius x length/2, that is in 1/s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ...core.model import Array
from ...core.port import Tangent, has_wall
from ..films.eddy_layers import Transfer, turbulent_transfer
from ..films.finite_volumes import Grid, Spans, Stencil, solve_stencil
from ..films.geometry import SunkArc
from ..films.mass_conserving import Fluidity
from ..films.turbulence import turbulent_factors
from ..reaction import StaticReaction


class FilmFlow(NamedTuple):
    """Flows and heat sources of one film at rest, on N lines of M + 1 cells.

    Attributes
    ----------
    dragged, pressed : ndarray, shape (N, M + 1) [1/s]
        Flow through the face after a line, by the walls and by pressure; streamers are dragged.
    axial : ndarray, shape (N, M + 1) [1/s]
        Flow through the face after a cell, towards the bearing's end; that after the last leaves it.
    entering, leaving : ndarray, shape (N, M + 1) [1/s]
        What flows into a cell through its faces, and out of it.
    filled : ndarray, shape (N, M + 1) [1]
        Share of the gap that oil fills: 1 in the film, less where it has ruptured, 0 in openings.
    full : ndarray of bool, shape (N, M + 1)
        Whether a cell is film.
    shear : ndarray, shape (N, M + 1) [1]
        Integral of filled/H over the cell.
    dissipation : ndarray, shape (N, M + 1) [1/s^2]
        Power of the pressure in the cells / (viscosity radius^3 length/2 / clearance).
    climb : ndarray, shape (N, M + 1) [1/s]
        Integral of H times the slope of the pressure around the film over the cells of film.
    central : ndarray, shape (N,), or None [1/s]
        Flow from a groove all round at mid-length into the first cells; None without one.
    sheared : ndarray, shape (N, M + 1), or float [1]
        Factor of the shear stress, 1 in a laminar film.
    transfer : Transfer or None
        Heat that is conducted across the film; None for that of a laminar one.
    """

    dragged: Array
    pressed: Array
    axial: Array
    entering: Array
    leaving: Array
    filled: Array
    full: np.ndarray
    shear: Array
    dissipation: Array
    climb: Array
    central: Array | None = None
    sheared: Array | float = 1.0
    transfer: Transfer | None = None

    @property
    def around(self) -> Array:
        """Whole flow through the face after a line, shape (N, M + 1) [1/s]."""
        return self.dragged + self.pressed

    @property
    def side_flow(self) -> float:
        """What leaves the film sideways, less what its ends draw in [1/s]."""
        lost = np.maximum(self.entering - self.leaving, 0.0)  # that its neighbors do not take from a cell
        return float(lost[self.filled > 0.0].sum() + self.axial[:, -1].sum())


def fed_film(
    film: FrozenFilm, position: Array, speed: float, *, full_gap: bool, settled: bool = False
) -> tuple[FrozenFilm, FilmSolution, FilmFlow]:
    """Return the film whose openings feed it, its solution for a journal at rest [m], and its flow.

    In a bearing with openings a film starts at an opening, or where the streamers fill the gap again. A node
    at its start that would take more oil than they bring is left empty, as often as this helps. A film whose
    empty nodes are `settled` is taken as it is.
    """
    cells = film.cells
    while True:
        eccentricity = film.reaction.eccentricity(position, speed)
        found = film.solve(eccentricity, np.zeros(2), speed)
        flow = film_flow(film, found, eccentricity, speed, full_gap=full_gap)
        starved = _starved(cells, flow, speed)
        if settled or not (cells.held.any() and starved.any()):
            return film, found, flow
        film = replace(film, empty=film.empty | starved)


def film_flow(
    film: FrozenFilm, found: FilmSolution, eccentricity: Array, speed: float, *, full_gap: bool
) -> FilmFlow:
    """Return the flow of a film for a journal at rest.

    Parameters
    ----------
    film : FrozenFilm
    found : FilmSolution
    eccentricity : ndarray, shape (2,) or (2, N) [1]
        Eccentricity of all lines, or of each.
    speed : float [rad/s]
    full_gap : bool
        Whether oil fills the gap in the ruptured zone too.
    """
    cells = film.cells
    full = np.pad(found.full, ((0, 0), (0, 1)), mode="edge")
    pressure = np.pad(found.pressure, ((0, 0), (0, 1)))
    drag = speed * film.fluidity.mean_at_faces().dragged * cells.width
    drag *= _driven(cells, full, eccentricity, speed)
    pressed = np.zeros(cells.shape)
    pressed[:, :-1] = found.stencil.around * (pressure - np.roll(pressure, -1, axis=0))[:, :-1]
    axial = np.zeros(cells.shape)
    axial[:, :-1] = found.stencil.along * (pressure[:, :-1] - pressure[:, 1:])
    axial[cells.held] = 0.0
    dragged = _with_streamers(cells, full, drag, axial, speed)
    around = dragged + pressed
    axial[:, -1] = np.where(
        full[:, -1], axial[:, -2] + np.roll(around, 1, axis=0)[:, -1] - around[:, -1], 0.0
    )
    entering, leaving = through(around, axial)
    capacity = abs(speed) * cells.mean_thickness(eccentricity) * film.fluidity.dragged * cells.width
    filled = np.where(full | full_gap, 1.0, np.minimum(entering / capacity, 1.0)) * ~cells.held[:, None]
    at_faces = cells.at_faces(eccentricity, cells.face)
    climbing = at_faces * (np.roll(pressure, -1, axis=0) - pressure)
    sheared, transfer = film.walls(speed, cells.mean_thickness(eccentricity))
    return FilmFlow(
        dragged=dragged,
        pressed=pressed,
        axial=axial,
        entering=entering,
        leaving=leaving,
        filled=filled,
        full=full,
        shear=filled * cells.integral_of_inverse(eccentricity) * cells.width,
        dissipation=_dissipation(cells, found, full),
        climb=0.5 * full * cells.width * (climbing + np.roll(climbing, 1, axis=0)),
        sheared=sheared,
        transfer=transfer,
    )


def _driven(cells: FilmCells, full: np.ndarray, eccentricity: Array, speed: float) -> Array:
    """Return the thickness of what the walls drag through the faces after the lines, (N, M + 1) or (N, 1).

    Oil that an opening leaves to the ruptured zone is as thick as the gap at the edge of the opening.
    """
    shifts = (0, -1) if speed > 0.0 else (-1, 0)
    giving, taking = (np.roll(cells.held, shift) for shift in shifts)
    emptied = (giving & ~taking)[:, None] & ~np.roll(full, shifts[1], axis=0)
    at_edge, at_face = (
        cells.at_faces(eccentricity, angles) for angles in (np.roll(cells.theta, shifts[0]), cells.face)
    )
    return np.where(emptied, at_edge, at_face)


def through(around: Array, axial: Array, central: Array | None = None) -> tuple[Array, Array]:
    """Return what enters and what leaves each cell by flows as in `FilmFlow`."""
    before = np.roll(around, 1, axis=0)
    inward = np.pad(axial, ((0, 0), (1, 0)))[:, :-1]
    if central is not None:
        inward[:, 0] = central
    entering = sum(np.maximum(flow, 0.0) for flow in (before, -around, inward, -axial))
    leaving = sum(np.maximum(flow, 0.0) for flow in (-before, around, -inward, axial))
    return np.asarray(entering), np.asarray(leaving)


def _with_streamers(cells: FilmCells, full: np.ndarray, drag: Array, axial: Array, speed: float) -> Array:
    """Return what the walls drag through the faces after the lines, in the ruptured zone what got there."""
    lines, sense = len(full), 1 if speed > 0.0 else -1
    here = full | cells.held[:, None]
    onward = np.roll(full, -sense, axis=0)
    sideways = np.pad(np.maximum(axial, 0.0), ((0, 0), (1, 0)))[:, :-1] + np.maximum(-axial, 0.0)
    # Faces by the line that oil comes from, flows along the rotation.
    drag = sense * (drag if sense > 0 else np.roll(drag, 1, axis=0))
    first = int(np.argmax(here.sum(axis=1)))
    rounds = lines if here[first].all() else 2 * lines
    for step in range(1, rounds):
        i = (first + sense * step) % lines
        brought = drag[(i - sense) % lines] + sideways[i]
        drag[i] = np.where(here[i] | onward[i], drag[i], brought)
    return sense * (drag if sense > 0 else np.roll(drag, -1, axis=0))


def _dissipation(cells: FilmCells, found: FilmSolution, full: np.ndarray) -> Array:
    """Return the power of the pressure, that of each face shared by the cells of film beside it."""
    pressure = np.pad(found.pressure, ((0, 0), (0, 1)))
    weight = film_weight(full, cells.held[:, None])
    around = np.zeros(full.shape)
    around[:, :-1] = found.stencil.around * (pressure - np.roll(pressure, -1, axis=0))[:, :-1] ** 2
    along = found.stencil.along * (pressure[:, :-1] - pressure[:, 1:]) ** 2
    return 12.0 * in_cells(around, along, weight)


def film_weight(full: np.ndarray, opening: np.ndarray) -> Array:
    """Return how much of what happens at its faces is a cell's: nothing is that of an opening's."""
    # Beside an opening under pressure there may be film shorter than a cell.
    return np.where(opening, 0.0, np.where(full, 1.0, 1e-30))


def in_cells(around: Array, along: Array, weight: Array) -> Array:
    """Return what faces after lines (N, M) and between cells (N, M - 1) have, shared by the cells."""
    here, there = _shared(around, weight, np.roll(weight, -1, axis=0))
    total = here + np.roll(there, 1, axis=0)
    here, there = _shared(along, weight[:, :-1], weight[:, 1:])
    total[:, :-1] += here
    total[:, 1:] += there
    return np.asarray(total)


def _shared(amount: Array, first: Array, second: Array) -> tuple[Array, Array]:
    """Return an amount shared in proportion to two weights; nothing where both are 0."""
    per_weight = amount / np.where(first + second > 0.0, first + second, 1.0)
    return per_weight * first, per_weight * second


def _starved(cells: FilmCells, flow: FilmFlow, speed: float) -> np.ndarray:
    """Return the nodes at the start of a film that take more than the streamers bring, shape (N, M)."""
    sense = 1 if speed > 0.0 else -1
    behind = np.roll(flow.full | cells.held[:, None], sense, axis=0)
    starts = flow.full & ~behind
    short = np.roll(flow.leaving - flow.entering > 1e-9 * np.max(flow.entering), sense, axis=0)
    return (starts & short)[:, :-1]


# The cells of a film that warms: lines at one place of the journal, which then stay where they are.


CROWDING = 0.35
"""The distance of lines at the minimum film falls as its thickness to this power, as in grids/cells.c."""

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(3)


class FilmCells(NamedTuple):
    """A ring of N lines with M unknown pressures on each and M + 1 cells of oil, the last at the end.

    Attributes
    ----------
    theta, face : ndarray, shape (N,) [rad]
        Angles of the lines, and of the faces after them.
    start, extent : ndarray, shape (N,) [rad]
        Cell of a line, from the face before it to that after it; but all film up to the edge of an opening.
    gap : ndarray, shape (N,) [rad]
        Angle from a line to the next.
    width : ndarray, shape (M + 1,)
        Axial widths of the cells as fractions of half the length; their sum is 1.
    conductance : ndarray, shape (M,)
        1/distance to the next node towards the bearing's end.
    held : ndarray of bool, shape (N,)
        Lines in an opening or at its edge.
    value : ndarray, shape (N,) [1/s]
        The pressure held there.
    opening : ndarray of int, shape (N,)
        Opening of a line that is held, -1 of others.
    center : ndarray, shape (2, N) [1]
        Center of curvature of the wall at a line and after it, over the clearance.
    film : ndarray, shape (N,)
        1 where there is a film after a line, and 0 in openings, in which the gap counts as 1.
    slenderness : float [1]
        Length / diameter.
    depth_ratio : ndarray, shape (N, M), or None [1]
        Depth of a recess after a line and after a node, over the clearance; None without any.
    """

    theta: Array
    face: Array
    start: Array
    extent: Array
    gap: Array
    width: Array
    conductance: Array
    held: np.ndarray
    value: Array
    opening: np.ndarray
    center: Array
    film: Array
    slenderness: float
    depth_ratio: Array | None = None

    @property
    def shape(self) -> tuple[int, int]:
        """Lines, and cells along half the length."""
        return len(self.theta), len(self.width)

    def normal(self) -> Array:
        """Return the integral of n = (cos theta, sin theta) over the cells of the lines, shape (2, N)."""
        before, after = np.roll(self.face, 1), self.face
        return np.stack([np.sin(after) - np.sin(before), np.cos(before) - np.cos(after)])

    def thickness(self, eccentricity: Array, angle: Array) -> Array:
        """Return H at angles (..., N) that belong to the lines, beside recesses."""
        x, y = eccentricity.reshape(2, -1) - self.center
        return np.asarray(1.0 - self.film * (x * np.cos(angle) + y * np.sin(angle)))

    def at_faces(self, eccentricity: Array, angle: Array, power: int = 1) -> Array:
        """Return the means of H^power over the cells' faces at angles (N,) after the lines.

        Their shape is (N, 1), with recesses (N, M + 1): on either side of a node it is as deep as there.
        """
        H = self.thickness(eccentricity, angle)[:, None]
        if self.depth_ratio is None:
            return H**power
        half = 0.5 / self.conductance
        parts = half * (H + self.depth_ratio) ** power
        return (_before(parts) + _after(parts)) / self.width

    def at_ends(self, eccentricity: Array, power: int) -> Array:
        """Return the means of H^power over the faces after the nodes along the bearing, (N, 1) or (N, M)."""
        H = self.thickness(eccentricity, self.theta)[:, None]
        if self.depth_ratio is None:
            return H**power
        before, after = self._halves
        parts = (
            before * (H + np.roll(self.depth_ratio, 1, axis=0)) ** power
            + after * (H + self.depth_ratio) ** power
        )
        return np.asarray(parts / (before + after))

    def mean_thickness(self, eccentricity: Array) -> Array:
        """Return H at the lines, shape (N, 1), with recesses its means over the cells, (N, M + 1)."""
        if self.depth_ratio is None:
            return self.thickness(eccentricity, self.theta)[:, None]
        mean = self.at_ends(eccentricity, 1) * (0.5 / self.conductance)
        return (_before(mean) + _after(mean)) / self.width

    def integral_of_inverse(self, eccentricity: Array) -> Array:
        """Return the integral of 1/H over the cells around the film, (N, 1), with recesses (N, M + 1)."""
        if self.depth_ratio is None:
            return self._inverse(eccentricity, self.start, self.extent, 0.0)
        before = (self.theta - self.start) % (2.0 * np.pi)
        deep = np.roll(self.depth_ratio, 1, axis=0)
        parts = self._inverse(eccentricity, self.start, before, deep)
        parts = parts + self._inverse(eccentricity, self.theta, self.extent - before, self.depth_ratio)
        parts = parts * (0.5 / self.conductance)
        return (_before(parts) + _after(parts)) / self.width

    def _inverse(self, eccentricity: Array, start: Array, extent: Array, depth: Array | float) -> Array:
        """Return the integral of 1/(H + depth) from angles (N,) on, of the shape of the depth or (N, 1)."""
        angles = start + 0.5 * extent * (1.0 + _GAUSS_NODES[:, None])
        H = self.thickness(eccentricity, angles)[..., None] + depth
        return np.asarray(0.5 * extent[:, None] * np.tensordot(_GAUSS_WEIGHTS, 1.0 / H, 1))

    @property
    def _halves(self) -> tuple[Array, Array]:
        """Angles from the face before a line to it, and to that after it, (N, 1) [rad]."""
        angles = self.theta - np.roll(self.face, 1), self.face - self.theta
        before, after = (angle[:, None] % (2.0 * np.pi) for angle in angles)
        return before, after


def _before(parts: Array) -> Array:
    """Return for cells (N, M + 1) what the halves (N, M) before their nodes have: none before the first."""
    return np.pad(parts, ((0, 0), (1, 0)))


def _after(parts: Array) -> Array:
    """Return for cells (N, M + 1) what the halves (N, M) after their nodes have: none after the last."""
    return np.pad(parts, ((0, 0), (0, 1)))


def film_cells(
    spans: Spans,
    grid: Grid,
    slenderness: float,
    eccentricity: Array,
    centers: Array | None = None,
    recesses: Sequence[SunkArc] = (),
) -> FilmCells:
    """Return the cells of a grid whose lines crowd at the minimum film for an eccentricity (2,).

    Parameters
    ----------
    spans : Spans
    grid : Grid
    slenderness : float [1]
        Length / diameter.
    eccentricity : ndarray, shape (2,) [1]
    centers : ndarray, shape (2, spans), optional [1]
        Centers of curvature of the wall on each span, over the clearance; by default all are those of the
        bearing. On an arc about a center of its own lines crowd at its own minimum film.
    recesses : sequence of SunkArc
        Recesses whose edges are edges of spans, and whose ends are nodes.
    """
    e = np.repeat(eccentricity[:, None], len(spans.start), axis=1)
    if centers is not None:
        e = (e - centers) * _within(spans, e - centers)
    a = (e[0] + 1j * e[1]) / (1.0 + np.maximum(1.0 - (e * e).sum(axis=0), 0.0) ** CROWDING)
    theta, face = _angles(spans, grid.span, grid.line, a), _angles(spans, grid.span, grid.face, a)
    held = grid.held > 0
    after_held, before_held = held & ~np.roll(held, 1), np.roll(held, -1)
    start = np.where(np.roll(held, 1), np.roll(theta, 1), np.roll(face, 1))
    end = np.where(before_held, np.roll(theta, -1), face)
    opening = np.where(held, np.cumsum(after_held) - 1, -1)
    if held[0] and held[-1] and not held.all() and grid.film[-1] == 0.0:
        opening[opening == opening.max()] = opening[0]
    return FilmCells(
        theta=theta,
        face=face,
        start=start,
        extent=(end - start) % (2.0 * np.pi),
        gap=(np.roll(theta, -1) - theta) % (2.0 * np.pi),
        width=np.append(grid.width, 1.0 - grid.width.sum()),
        conductance=grid.conductance,
        held=held,
        value=grid.value,
        opening=opening,
        center=np.zeros((2, 1)) if centers is None else centers[:, grid.span],
        film=grid.film,
        slenderness=slenderness,
        depth_ratio=_depths(spans, grid, recesses) if recesses else None,
    )


def _depths(spans: Spans, grid: Grid, recesses: Sequence[SunkArc]) -> Array:
    """Return the depth of recesses after each line and each node of a grid, shape (N, M)."""
    middles, along = (spans.start + 0.5 * spans.extent)[grid.span], grid.nodes[:-1] + 0.5 / grid.conductance
    total = np.zeros((len(middles), len(along)))
    for sunk in recesses:
        inside = np.array([sunk.covers(angle) for angle in middles]) & (grid.film > 0.0)
        total += sunk.depth_ratio * np.outer(inside, along < sunk.share)
    return total


def _within(spans: Spans, e: Array) -> Array:
    """Return the cosine between eccentricities (2, spans) and their arcs, at least 0."""
    half = 0.5 * spans.extent
    away = np.arctan2(e[1], e[0]) - spans.start - half
    away = np.abs((away + np.pi) % (2.0 * np.pi) - np.pi) - half
    return np.cos(np.clip(away, 0.0, 0.5 * np.pi))


def _angles(spans: Spans, span: np.ndarray, place: Array, a: Array) -> Array:
    """Return the angles of places on spans: exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s)."""
    start, end = spans.start, spans.start + spans.extent
    if spans.pinned:
        start, end = (angle - 2.0 * _bend(-a, angle) for angle in (start, end))
    s = start[span] + (end - start)[span] * place
    return np.asarray(s - 2.0 * _bend(a[span], s))


def _bend(a: Array, s: Array) -> Array:
    return np.angle(1.0 + a.conjugate() * np.exp(1j * s))


# The film of a given viscosity field: its force with exact derivatives, at frozen temperature.


class FilmSolution(NamedTuple):
    """A film at one state.

    Attributes
    ----------
    stencil : Stencil
    pressure : ndarray, shape (N, M) [1/s]
    full : ndarray of bool, shape (N, M)
        Nodes where there is film.
    answers : ndarray, shape (2, N, M)
        Response of the pressure to the two components of the force.
    normal : ndarray, shape (2, N)
    """

    stencil: Stencil
    pressure: Array
    full: np.ndarray
    answers: Array
    normal: Array

    def force(self, cells: FilmCells) -> Array:
        """Return the force on the journal in the film's units [1/s], shape (2,)."""
        return -12.0 * (self.normal @ (self.pressure @ cells.width[:-1]))

    def pumped(self, cells: FilmCells) -> float:
        """Return the power of the supply, pressure times flow into the film [1/s^2].

        The flow straight out of the openings at the bearing's end is no part of it.
        """
        stencil, pressure = self.stencil, self.pressure
        flow = stencil.outflow(pressure) - stencil.source
        flow[:, -1] -= stencil.along[:, -1] * pressure[:, -1]
        return 12.0 * float((cells.value * cells.held) @ flow.sum(axis=1))


@dataclass(frozen=True, eq=False, kw_only=True)
class FrozenFilm(StaticReaction):
    """A journal film whose oil keeps its temperature wherever it is, on cells that keep their place.

    Parameters
    ----------
    cells : FilmCells
        Where the film is looked at.
    fluidity : Fluidity
        How easily the oil of each cell flows.
    empty : ndarray of bool, shape (N, M)
        Nodes that no film may start at, since no oil gets there.
    bearing : JournalBearing or LobedBearing
        Bearing of the viscosity that the fluidity is relative to.
    frozen_at : (float, float) or None [m]
        Position of the journal at which it was; None of fresh oil.
    eddies : ndarray, shape (3, N, M + 1, layers), or None [1]
        Moments of the fluidity across a turbulent film, as of `eddy_moments`.
    """

    cells: FilmCells
    fluidity: Fluidity
    empty: np.ndarray
    bearing: Any
    frozen_at: tuple[float, float] | None = None
    eddies: Array | None = None

    @property
    def clearance(self) -> float:
        """Radial clearance [m], of arcs about centers of their own theirs."""
        return float(self.bearing.clearance)

    @property
    def nominal_force(self) -> float:
        """Typical force [N]."""
        return float(self.bearing.nominal_force)

    pulls: ClassVar[bool] = False
    """Whether pressures below ambient may hold a pad."""

    @property
    def reaction(self) -> Any:
        """The film as a reaction: itself, or the pads that tilt on it."""
        on_it = getattr(self.bearing, "on_frozen", None)
        return self if on_it is None else on_it(self)

    def eccentricity(self, position: Array, speed: float) -> Array:
        """Return the eccentricity of a journal at a position (2,) [m], shape (2,) [1]."""
        return position / self.clearance

    def minimum_film(self, position: Array) -> Array:
        """Return the least film [m], shape (...), of journals at positions (2, ...) [m]."""
        if has_wall(self.bearing):
            return np.asarray(self.bearing.minimum_film(position))
        return np.asarray(self.clearance - np.hypot(*position))

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError where a journal at positions (2, ...) [m] touches the bearing."""
        self.bearing.require_film(position)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for float arrays of equal batch shape."""
        return self._each(position, velocity, speed, slice(0, 1)).reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for float arrays of equal batch shape."""
        found = self._each(position, velocity, speed, slice(1, 6))
        return found.reshape(2, 5, *position.shape[1:])

    def _each(self, position: Array, velocity: Array, speed: Array, columns: slice) -> Array:
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), np.ravel(speed)
        states = zip(q.T, v.T, omega, strict=True)
        return np.stack([self._response(*state)[:, columns] for state in states], axis=-1)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `core.port.Reaction`."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            self.require_film(np.array((x, y)))
            found = self._response(np.array((x, y)), np.array((vx, vy)), speed)
            force_x, force_y = found[:, 0].tolist()
            return force_x, force_y, found[:, 1:].ravel().tolist()

        return tangent

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return about where a journal rests [m]: where the film is frozen; see `core.port`."""
        return self.frozen_at

    def solve(self, eccentricity: Array, squeeze: Array, speed: float) -> FilmSolution:
        """Return the film of one state.

        Parameters
        ----------
        eccentricity : ndarray, shape (2,), or (2, N) of each line [1]
            Position / clearance.
        squeeze : ndarray, shape (2,) [1/s]
            Velocity / clearance.
        speed : float [rad/s]
        """
        cells, (around, along, dragged) = self.cells, self._per_thickness
        H, cubed = (cells.at_faces(eccentricity, cells.face, k)[:, : dragged.shape[1]] for k in (1, 3))
        carried, normal, width = speed * H * dragged, cells.normal(), cells.width[:-1]
        (eased, onward), _ = self._eased(eccentricity, speed)
        stencil = Stencil(
            around=cubed * around * eased,
            along=cells.at_ends(eccentricity, 3) * along * onward,
            source=np.roll(carried, 1, axis=0) - carried + (squeeze @ normal)[:, None] * width,
            held=self.empty | cells.held[:, None],
        )
        value = np.broadcast_to(cells.value[:, None], stencil.source.shape)
        unit = normal[:, :, None] * width
        return FilmSolution(stencil, *solve_stencil(stencil, value, stencil.source > 0.0, unit), normal)

    @cached_property
    def _per_thickness(self) -> tuple[Array, Array, Array]:
        """Conductances over the cube of the thickness, and what walls drag over thickness and speed."""
        cells, faces, width = self.cells, self.fluidity.mean_at_faces(), self.cells.width[:-1]
        across = cells.slenderness**-2 * ((cells.face - np.roll(cells.face, 1)) % (2.0 * np.pi))
        return (
            faces.pressed[:, :-1] * width / cells.gap[:, None],
            _to_the_end(self.fluidity.pressed) * cells.conductance * across[:, None],
            faces.dragged[:, :-1] * width,
        )

    def _eased(self, eccentricity: Array, speed: float) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        """Return the factors of the conductances around and along, and their slopes by ln Re_h."""
        if self.bearing.turbulence is None:
            return (1.0, 1.0), (0.0, 0.0)
        cells, faces = self.cells, self.fluidity.mean_at_faces().sheared[:, :-1]
        places = (
            (cells.at_faces(eccentricity, cells.face)[:, : faces.shape[1]], faces),
            (
                cells.at_ends(eccentricity, 1),
                _to_the_end(self.fluidity.sheared),
            ),
        )
        around, along = (turbulent_factors(self.bearing, speed, *place) for place in places)
        return (around[0][0], along[0][1]), (around[1][0], along[1][1])

    def walls(self, speed: float, thickness: Array) -> tuple[Array | float, Transfer | None]:
        """Return `sheared` and `transfer` of a `FilmFlow` at the thickness of the cells."""
        if self.bearing.turbulence is None or self.eddies is None:
            return 1.0, None
        place = self.bearing, speed, thickness, self.fluidity.sheared
        return turbulent_factors(*place)[0][3], turbulent_transfer(*place, self.eddies.shape[-1])

    def _response(self, position: Array, velocity: Array, speed: float) -> Array:
        """Return the force and its derivatives by x, y, vx, vy and speed side by side, shape (2, 6)."""
        c, all_lines = self.clearance, np.ones((1, len(self.cells.theta)))
        found = self.responses(position / c, velocity / c, float(speed), all_lines)[0]
        return float(self.bearing.force_scale) * found / np.array([1.0, c, c, c, c, 1.0])

    def responses(self, eccentricity: Array, squeeze: Array, speed: float, lines: Array) -> Array:
        """Return forces of some lines, and derivatives by eccentricity, squeeze and speed, shape (P, 2, 6).

        In the film A P = b, and F = -12 N^T P. With V = A^-1 N, dF = 12 V^T (dA P - db): the pressure and its
        slope vanish at the edge of a ruptured zone, so moving the edge adds nothing. V^T A P is a sum over
        faces of their conductance times the falls of V and P, V^T b one of what is dragged times that of V.

        Parameters
        ----------
        eccentricity, squeeze, speed
            As in `solve`.
        lines : ndarray, shape (P, N)
            1 for those of each of P parts between openings, 0 for others.
        """
        cells, e = self.cells, eccentricity
        found = self.solve(e, squeeze, speed)
        P, V = found.pressure, found.answers
        fall, at_end = V - np.roll(V, -1, axis=1), np.diff(V, axis=2, append=0.0) * np.diff(P, append=0.0)
        H, squared, cubed = (cells.at_faces(e, cells.face, k)[:, : P.shape[1]] for k in (1, 2, 3))
        ends = [cells.at_ends(e, k) for k in (1, 2, 3)]
        around, along, dragged = self._per_thickness
        (eased, onward), bends = self._eased(e, speed)
        around = around * eased * fall * (P - np.roll(P, -1, axis=0))
        along = along * onward * at_end
        bent, bent_along = cubed * around * bends[0], ends[2] * along * bends[1]
        by_reynolds = np.sum(bent + bent_along, axis=2)
        terms = squared * around, ends[1] * along, bent / H, bent_along / ends[0]
        around, along, bent, bent_along = (np.sum(each, axis=2) for each in terms)
        carried, dragged = np.sum(H * dragged * fall, axis=2), np.sum(dragged * fall, axis=2)
        n, n_lines = (cells.film * np.stack([np.cos(at), np.sin(at)]) for at in (cells.face, cells.theta))
        width, part = cells.width[:-1], lines[:, None, :]
        force = -((part * found.normal) @ (P @ width))[..., None]
        by_e = (part * (3.0 * around + bent + speed * dragged)) @ n.T
        by_e = by_e + (part * (3.0 * along + bent_along)) @ n_lines.T
        by_w = (part * (V @ width)) @ found.normal.T
        by_speed = (part * (carried + by_reynolds / (speed or 1.0))).sum(axis=2)[..., None]
        return np.asarray(12.0 * np.concatenate([force, -by_e, -by_w, by_speed], axis=2))


def _to_the_end(field: Array) -> Array:
    """Return a field of cells (N, M + 1) at the faces between them, shape (N, M)."""
    return 0.5 * (field[:, 1:] + field[:, :-1])
