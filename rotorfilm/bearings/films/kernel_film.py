"""Film laws of the C library: one dimensionless, and as the film of one bearing in SI units."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from ...core.errors import ConvergenceError, InputError, require_inside, warn_user
from ...core.model import Array
from ...native import FilmKernel, JournalKernel, Status
from ...native.film_kernels import Batch, ResponseKernel
from .law import FilmOptions, vanishing_source, wall_contact


class KernelFilm(FilmOptions):
    """A film law in compiled code, as that of `ShortFilm`, `MapFilm`, `GroovedMapFilm` and `ReynoldsFilm`."""

    @abstractmethod
    def _kernel(self, slenderness: float) -> FilmKernel:
        """Return the compiled film of a bearing."""

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        InputError
            If the film is not for this slenderness, or a state is not finite.
        FilmContactError
            If an eccentricity ratio is not below 1.
        """
        e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
        kernel = self._kernel(slenderness)
        batch = kernel.force(e, w)
        report_law(batch, e, w, kernel)
        return batch.values.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the source vanishes, in a plain bearing off the center only.
        """
        e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
        kernel = self._kernel(slenderness)
        batch = kernel.jacobian(e, w)
        report_law(batch, e, w, kernel)
        return batch.values.reshape(2, 4, *eccentricity.shape[1:])

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundKernel:
        """Return this film in one bearing, in SI units; see `FilmOptions`."""
        return BoundKernel(JournalKernel(self._kernel(slenderness), clearance, force_scale), clearance)


@dataclass(frozen=True, eq=False)
class BoundKernel:
    """A film of one bearing in SI units: `law.BoundFilm` over the C kernel.

    Parameters
    ----------
    kernel : ResponseKernel
        The compiled film of the bearing.
    clearance : float [m]
        Its radial clearance.
    """

    kernel: ResponseKernel
    clearance: float

    @property
    def beyond(self) -> str:
        """How the force goes on beyond the map of the film; empty where it has none."""
        film = self.kernel.film
        return continued(film) if film.is_table else ""

    def require_inside(self, position: Array) -> None:
        """Raise FilmContactError where a journal at a position (2,) [m] touches."""
        require_inside(position, self.clearance)

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return (force_x, force_y) [N] for numbers, as fast as Python can ask."""
        force_x, force_y, status = self.kernel.call(x, y, vx, vy, speed)
        if status:
            self.report(status, x, y, vx, vy, speed)
        return force_x, force_y

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) [N] and the ten entries of the Jacobian, row by row, for numbers."""
        force_x, force_y, derivatives, status = self.kernel.tangent(x, y, vx, vy, speed)
        if status:
            self.report(status, x, y, vx, vy, speed)
        return force_x, force_y, derivatives

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.call(x, y, vx, vy, float(speed)))
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), speed.ravel()
        batch = self.kernel.force(q, v, omega)
        self._report_batch(batch, q, v, omega)
        return batch.values.reshape(position.shape)

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.tangent(x, y, vx, vy, float(speed))[2]).reshape(2, 5)
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), speed.ravel()
        batch = self.kernel.jacobian(q, v, omega)
        self._report_batch(batch, q, v, omega)
        return batch.values.reshape(2, 5, *position.shape[1:])

    def _report_batch(self, batch: Batch, q: Array, v: Array, omega: Array) -> None:
        if batch.status:
            at = np.argmax(np.hypot(*q)) if batch.status == Status.AT_WALL else batch.first
            (x, y), (vx, vy) = q[:, at].tolist(), v[:, at].tolist()
            self.report(batch.status, x, y, vx, vy, float(np.broadcast_to(omega, q.shape[1:])[at]))

    def report(self, status: int, x: float, y: float, vx: float, vy: float, speed: float) -> None:
        """Raise, or warn, about a state that has this status."""
        if status == Status.NOT_FINITE:
            raise InputError(
                "position, velocity and speed must be finite and not overflow, "
                f"got ({x!r}, {y!r}) m, ({vx!r}, {vy!r}) m/s and {speed!r} rad/s"
            )
        if status == Status.AT_WALL:
            self.require_inside(np.array([x, y]))
        if status == Status.STUCK:
            e = np.array([x, y]) / self.clearance
            raise endless_search(
                e, np.array([vx, vy]) / self.clearance - 0.5 * speed * np.array([-e[1], e[0]])
            )
        _report_film(status, float(np.hypot(x, y)) / self.clearance, self.kernel.film)


def report_law(batch: Batch, e: Array, w: Array, kernel: FilmKernel) -> None:
    """Raise, or warn, about the most severe status of a batch of eccentricities and sources (2, n)."""
    if not batch.status:
        return
    at = e[:, batch.first]
    if batch.status == Status.STUCK:
        raise endless_search(at, w[:, batch.first])
    if batch.status == Status.NOT_FINITE:
        raise InputError(
            "eccentricity and source must be finite and not overflow, "
            f"got {at.tolist()} and {w[:, batch.first].tolist()} 1/s"
        )
    _report_film(batch.status, float(np.hypot(*at)), kernel)


def _report_film(status: int, chi: float, kernel: FilmKernel) -> None:
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status == Status.AT_WALL:
        raise wall_contact(chi)
    if status == Status.UNDEFINED:
        raise vanishing_source(chi)
    warn_user(f"eccentricity ratio {chi:.6g} is beyond the map of the film; its force is {continued(kernel)}")


def continued(kernel: FilmKernel) -> str:
    """Return how the force of a film goes on beyond its map, and how far it is off there."""
    if not kernel.error:
        return "extrapolated there, with an error that is not known"
    where = " where no opening is near" if kernel.openings else ""
    return f"continued as that of a film at the wall, within {kernel.error:g} %{where}"


def endless_search(eccentricity: Array, source: Array) -> ConvergenceError:
    """Return the error of a film whose edge is not found, at one state (2,)."""
    return ConvergenceError(
        "the search for the ruptured zone must end, and did not at "
        f"eccentricity {eccentricity.tolist()}, source {source.tolist()} 1/s"
    )
