"""Small motions of a journal in a film that conserves its oil: exact derivatives, the cavity at its place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....model import Array
from .conserved_cells import FILM
from .conserved_film import ConservedFilm, ConservedState, Gap, direction
from .oil_kernel import oil_outflow, oil_response

KEEPS = 1e30
"""Storage [1/s] of cells that keep their oil."""

Complex = NDArray[np.complex128]


class SlowMotion(NamedTuple):
    """Stiffness and damping in motions slow against the time that oil takes to cross the cavity.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (2, 2)
        Of the dimensionless force over the eccentricity, K(0) [1/s] and dK/ds(0) [1].
    """

    stiffness: Array
    damping: Array


@dataclass(frozen=True, eq=False)
class FilmInMotion:
    """A steady film about which the journal moves a little, called for K(s) and dK/ds at one s.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
    scale : float
        Unit of the stiffness; with 1 it is without dimensions [1/s].
    """

    film: ConservedFilm
    state: ConservedState
    scale: float = 1.0

    @cached_property
    def _slopes(self) -> tuple[Array, Array]:
        return _slopes(self.film, self.state)

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) and dK/ds, shape (2, 2) each; the storage of the cavity as in `dynamic_stiffness`.

        Parameters
        ----------
        s : complex [1/s]
        """
        rate, by_s = _wave_rate(self.film, self.state, s)
        moved, held = self._slopes
        still = self._response(rate, moved + s * held)
        steeper = self._response(rate, held + self._room(by_s) * still)
        return self._stiffness(still), self._stiffness(steeper)

    def stiffness(self, s: complex, *, as_stepped: bool = False) -> Complex:
        """Return K(s) alone; see `dynamic_stiffness`.

        Parameters
        ----------
        s : complex [1/s]
        as_stepped : bool
        """
        rate = np.full((len(self.state.gap.line), 1), complex(s))
        if not as_stepped:
            rate, _ = _wave_rate(self.film, self.state, s)
        moved, held = self._slopes
        return self._stiffness(self._response(rate, moved + s * held))

    def _room(self, rate: Complex) -> Complex:
        """Return the storage of the cavity at a rate (N, M or 1), shape (N, M)."""
        room = self.state.gap.line[:, None] * self.film.cells.area
        return np.where(self.state.solution.full, 0.0, rate * room)

    def _response(self, rate: Complex, outflow: Complex) -> Complex | Array:
        return oil_response(self.state.equations, self.state.solution.full, self._room(rate), -outflow)

    def _stiffness(self, change: Complex | Array) -> Complex:
        return self.scale * _stiffness(self.film, self.state, change)


def dynamic_stiffness(
    film: ConservedFilm, state: ConservedState, s: complex, *, as_stepped: bool = False
) -> Complex:
    """Return K(s) of a steady film: dF = -K de for de e^(s t), shape (2, 2) [1/s].

    K(0) is that of equilibria.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
    s : complex [1/s]
    as_stepped : bool
        Whether waves of oil cross the cavity as in short steps in time on these cells, which blur them. By
        default they keep their phase: the storage of the cavity has (exp(2 s dxi/speed) - 1) speed/(2 dxi) in
        place of s, where the cells resolve the wave.
    """
    return FilmInMotion(film, state).stiffness(s, as_stepped=as_stepped)


def step_stiffness(film: ConservedFilm, state: ConservedState) -> Array:
    """Return K of a step in time: dF = -K de, the oil of the last step given, shape (2, 2) [1/s]."""
    moved, _ = _slopes(film, state)
    none = np.zeros(film.cells.opening.shape)
    return _stiffness(film, state, oil_response(state.equations, state.solution.full, none, -moved)).real


def slow_motion(film: ConservedFilm, state: ConservedState) -> SlowMotion:
    """Return K(0) and dK/ds(0) of a steady film."""
    moved, held = _slopes(film, state)
    none, full = np.zeros(film.cells.opening.shape), state.solution.full
    still = oil_response(state.equations, full, none, -moved)
    room = np.where(full, 0.0, state.gap.line[:, None] * film.cells.area)
    slow = oil_response(state.equations, full, none, -(held + room * still))
    return SlowMotion(_stiffness(film, state, still).real, _stiffness(film, state, slow).real)


def sudden_slopes(film: ConservedFilm, state: ConservedState) -> Array:
    """Return d force / d (e_x, e_y, their rates, speed) of a film whose cells keep their oil, shape (2, 5).

    So it answers at once, to a motion too quick for oil to cross the cavity. `state` has no storage.
    """
    moved, held = _slopes(film, state)
    gap, solution = state.gap, state.solution
    thinned = np.where(solution.full, 0.0, -solution.theta * _widening(film, gap))
    still = np.zeros(gap.line.shape)
    carrying = state.equations._replace(around=still[:, None], along=still, center=still, end_pressure=0.0)
    none = np.zeros(film.cells.opening.shape)
    dragged = [oil_outflow(carrying, none, theta) for theta in thinned]
    by_speed = oil_outflow(carrying._replace(wedge=0.5 * film.carried(gap)), none, solution.theta)
    right = -np.concatenate([moved + np.array(dragged), held, by_speed[None]])
    keeps = np.where(solution.full, 0.0, KEEPS * film.cells.area)
    change = oil_response(state.equations, solution.full, keeps, np.where(solution.full, right, 0.0)).real
    pressure = np.where(solution.full, change, 0.0)
    return np.asarray(-12.0 * np.tensordot(film.weights, pressure, ((1, 2), (1, 2))))


def _widening(film: ConservedFilm, gap: Gap) -> Array:
    """Return d log(room) / d (e_x, e_y), shape (2, N, M): an opening is one cell, if not held."""
    cells, by_line = film.cells, -direction(film.cells.angle)
    widening = np.where(cells.opening == FILM, (by_line / gap.line)[:, :, None], 0.0)
    for opening in np.flatnonzero(film.supply.fed):
        part = np.where(cells.opening == opening, cells.area, 0.0).sum(axis=1)
        change = by_line @ part / (gap.line @ part)
        widening = np.where(cells.opening == opening, change[:, None, None], widening)
    return widening


def speed_slope(film: ConservedFilm, state: ConservedState) -> Array:
    """Return d force / d speed of a steady film, shape (2,)."""
    still, solution = np.zeros(state.gap.line.shape), state.solution
    carried = state.equations._replace(
        wedge=0.5 * film.carried(state.gap), around=still[:, None], along=still, store=still
    )
    moved = oil_outflow(carried, solution.pressure, solution.theta)
    change = oil_response(state.equations, solution.full, np.zeros(moved.shape), -moved[None])[0].real
    return -12.0 * np.tensordot(film.weights, np.where(solution.full, change, 0.0), 2)


def _slopes(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return d outflow / d(e_x, e_y), of the steady flow and what s multiplies, shape (2, N, M) each."""
    cells, gap, solution = film.cells, state.gap, state.solution
    by_line, by_face = -direction(cells.angle), -direction(cells.face)
    moved = []
    for line, face in zip(by_line, by_face, strict=True):
        slope = Gap(line, face, 3.0 * gap.face**2 * face)
        turned = film.equations(slope, state.rate)._replace(
            along=3.0 * gap.line**2 * line * cells.extent / film.slenderness**2,
            store=state.equations.store / gap.line * line,
        )
        moved.append(oil_outflow(turned, solution.pressure, solution.theta))
    held = solution.theta * cells.area * by_line[:, :, None]
    return np.array(moved), held


def _wave_rate(film: ConservedFilm, state: ConservedState, s: complex) -> tuple[Complex, Complex]:
    """Return what stands for s in the storage of the cavity, shape (N, M or 1), and its derivative by s."""
    speed = 2.0 * abs(state.rate) * film.dragged
    turn = 2.0 * s * film.cells.extent[:, None]
    resolved = np.abs(turn) <= speed
    phase = np.where(resolved, turn, 0.0) / np.where(speed > 0.0, speed, 1.0)
    known = np.where(phase == 0.0, 1.0, phase)
    return np.asarray(s * np.where(phase == 0.0, 1.0, np.expm1(phase) / known)), np.exp(phase)


def _stiffness(film: ConservedFilm, state: ConservedState, change: Complex | Array) -> Complex:
    """Return 12 integral of n dP for the changes (2, N, M) by e_x and e_y."""
    pressure = np.where(state.solution.full, change, 0.0)
    return np.asarray(12.0 * np.tensordot(film.weights, pressure, ((1, 2), (1, 2))), dtype=complex)
