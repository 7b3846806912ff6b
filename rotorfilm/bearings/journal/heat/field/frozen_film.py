"""The film of a given viscosity field: its force with exact derivatives, at frozen temperature."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .....model import Array, Tangent
from ....films.bound_law import kinematics
from ....films.conserved.fluidity import Fluidity
from ....films.ring.stencil_film import Stencil, StencilSolution, solve_stencil
from ....reaction import NOMINAL_SPEED, StaticReaction
from .film_cells import FilmCells, thickness


class FilmSolution(NamedTuple):
    """A film at one state.

    Attributes
    ----------
    stencil : Stencil
    solution : StencilSolution
        With the response of the pressure to the two components of the force.
    normal : ndarray, shape (2, N)
    """

    stencil: Stencil
    solution: StencilSolution
    normal: Array

    def force(self, cells: FilmCells) -> Array:
        """Return the force on the journal in the film's units [1/s], shape (2,)."""
        return -12.0 * (self.normal @ (self.solution.pressure @ cells.width[:-1]))

    def pumped(self, cells: FilmCells) -> float:
        """Return the power of the supply, pressure times flow into the film [1/s^2].

        The flow straight out of the openings at the bearing's end is no part of it.
        """
        stencil, pressure = self.stencil, self.solution.pressure
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
    clearance : float [m]
        Radial clearance.
    force_per_rate : float [N s]
        viscosity length radius^3 / clearance^2 of the viscosity that the fluidity is relative to.
    frozen_at : (float, float) or None [m]
        Position of the journal at which it was; None of fresh oil.
    """

    cells: FilmCells
    fluidity: Fluidity
    empty: np.ndarray
    clearance: float
    force_per_rate: float
    frozen_at: tuple[float, float] | None = None

    @property
    def nominal_force(self) -> float:
        """Typical force [N]."""
        return self.force_per_rate * NOMINAL_SPEED * min(1.0, self.cells.slenderness**2)

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
        """Return force and derivatives as one function of five numbers; see `model.TangentReaction`."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            found = self._response(np.array((x, y)), np.array((vx, vy)), speed)
            force_x, force_y = found[:, 0].tolist()
            return force_x, force_y, found[:, 1:].ravel().tolist()

        return tangent

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return about where a journal rests [m]: where the film is frozen; see `reactions.resting`."""
        return self.frozen_at

    def solve(self, eccentricity: Array, squeeze: Array, speed: float) -> FilmSolution:
        """Return the film of one state.

        Parameters
        ----------
        eccentricity : ndarray, shape (2,) [1]
            Position / clearance.
        squeeze : ndarray, shape (2,) [1/s]
            Velocity / clearance.
        speed : float [rad/s]
        """
        cells, normal, faces = self.cells, self.cells.normal(), self.fluidity.mean_at_faces()
        width, H = cells.width[:-1], thickness(eccentricity, cells.face)
        across = cells.slenderness**-2 * ((cells.face - np.roll(cells.face, 1)) % (2.0 * np.pi))
        dragged = speed * H[:, None] * faces.dragged[:, :-1]
        stencil = Stencil(
            around=(H**3 / cells.gap)[:, None] * faces.pressed[:, :-1] * width,
            along=(thickness(eccentricity, cells.theta) ** 3 * across)[:, None]
            * _to_the_end(self.fluidity.pressed)
            * cells.conductance,
            source=width * (np.roll(dragged, 1, axis=0) - dragged + (squeeze @ normal)[:, None]),
            held=self.empty | cells.held[:, None],
        )
        value = np.broadcast_to(cells.value[:, None], stencil.source.shape)
        unit = normal[:, :, None] * width
        return FilmSolution(stencil, solve_stencil(stencil, value, stencil.source > 0.0, unit), normal)

    def _response(self, position: Array, velocity: Array, speed: float) -> Array:
        """Return the force and its derivatives by x, y, vx, vy and speed side by side, shape (2, 6).

        In the film A P = b, and F = -12 N^T P. With V = A^-1 N, dF = 12 V^T (dA P - db): the pressure and its
        slope vanish at the edge of a ruptured zone, so moving the edge adds nothing.
        """
        e, _ = kinematics(position, velocity, np.asarray(speed), self.clearance)
        found = self.solve(e, velocity / self.clearance, float(speed))
        pressure, V = found.solution.pressure, found.solution.answers
        width = self.cells.width[:-1]
        response = np.empty((2, 6))
        response[:, 0] = found.force(self.cells)
        changes = [
            *(bent.outflow(pressure) - bent.source for bent in self._bent(e, float(speed), found.stencil)),
            *(-normal[:, None] * width for normal in found.normal),
            -self._dragged_in(thickness(e, self.cells.face)),
        ]
        response[:, 1:] = 12.0 * np.tensordot(V, np.stack(changes), axes=([1, 2], [1, 2]))
        response[:, 1:5] /= self.clearance
        return self.force_per_rate * response

    def _bent(self, e: Array, speed: float, stencil: Stencil) -> list[Stencil]:
        """Return the derivatives of the stencil by the eccentricity."""
        bent = []
        at_face, at_line = (self._directions(angles) for angles in (self.cells.face, self.cells.theta))
        for n_face, n_line in zip(at_face, at_line, strict=True):
            bent.append(
                Stencil(
                    around=-3.0 * (n_face / thickness(e, self.cells.face))[:, None] * stencil.around,
                    along=-3.0 * (n_line / thickness(e, self.cells.theta))[:, None] * stencil.along,
                    source=speed * self._dragged_in(-n_face),
                    held=stencil.held,
                )
            )
        return bent

    def _directions(self, angles: Array) -> Array:
        return np.stack([np.cos(angles), np.sin(angles)])

    def _dragged_in(self, H: Array) -> Array:
        """Return what walls at unit speed drag into each cell, over thickness H (N,) at the faces."""
        dragged = H[:, None] * self.fluidity.mean_at_faces().dragged[:, :-1] * self.cells.width[:-1]
        return np.roll(dragged, 1, axis=0) - dragged


def _to_the_end(field: Array) -> Array:
    """Return a field of cells (N, M + 1) at the faces between them, shape (N, M)."""
    return 0.5 * (field[:, 1:] + field[:, :-1])
