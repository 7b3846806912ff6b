"""What every journal film law answers, and how a polar law becomes a Cartesian one.

Notation, for all films: the eccentricity e = (x, y)/c and the source w = v/c - (speed/2) z^ x e [1/s]
carry the whole kinematics of an isotropic film. With chi = |e|, e_r = e/chi and e_t = z^ x e_r,

    w.e_t = g_s = chi (phidot - speed/2),    w.e_r = g_c = chidot,

and the film, h = c (1 + chi cos gamma), is fed by g = g_s sin gamma + g_c cos gamma, gamma being measured
from the line of maximum film. A polar law answers with the 2 x 2 matrix A of (F_t, F_r) = -A (g_s, g_c).
Forces are in units of viscosity * length * radius^3 / clearance^2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple, Protocol, TypeVar, cast, runtime_checkable

import numpy as np

from ...errors import FilmContactError, UndefinedDerivativeError
from ...model import Array
from ...native.loss_kernels import LossKernel
from .film_losses import FilmLosses
from .geometry import FilmGeometry

CENTER = 1e-8
"""Eccentricity ratio below which the derivative is taken on this circle, or that of the centered film."""

TINY = 1e-290
"""Eccentricity ratio below which roundoff would spoil its direction."""

CHUNK = 2048
"""States evaluated at once, which bounds the memory of a large batch."""


@runtime_checkable
class FilmLaw(Protocol):
    """A dimensionless film force with exact derivatives, isotropic unless the bearing holds the film."""

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal [viscosity length radius^3 / clearance^2 / s].

        Parameters
        ----------
        eccentricity : ndarray, shape (2, ...) [1]
            Journal position / clearance, inside the unit circle.
        source : ndarray, shape (2, ...) [1/s]
            velocity / clearance - (speed/2) z^ x eccentricity.
        slenderness : float [1]
            Bearing length / diameter.

        Returns
        -------
        ndarray, shape (2, ...)

        Raises
        ------
        FilmContactError
            If an eccentricity reaches the unit circle.
        """

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...)."""


class BoundFilm(Protocol):
    """A film in one bearing: dimensions inside, SI units outside, nothing between it and its own loop."""

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return (force_x, force_y) [N] for numbers; raises what the bearing's `force` raises."""

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) and the ten entries of `jacobian` row by row, for numbers."""

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...), for float arrays of equal batch shape."""

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""


class FilmOptions:
    """What a film law may have besides `force` and `jacobian`: what it leaves as it is here, it has not."""

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length / diameter that this law takes."""
        return 0.0, math.inf

    @property
    def slenderness_limit(self) -> float:
        """Largest length / diameter for which this law is meant; beyond, a bearing warns."""
        return math.inf

    def fitted(self, geometry: FilmGeometry) -> FilmLaw | None:
        """Return the law in a bearing of this geometry; None if it can represent no openings nor supply."""
        return None

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundFilm | None:
        """Return the film of one bearing in compiled code; None if there is none.

        The force_scale is viscosity length radius^3 / clearance^2 [N s].
        """
        return None

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]] | None:
        """Return the kernel of the C library that is a bearing of this length/diameter, and its tables."""
        return None

    def tabulated(self, slenderness: float) -> FilmLaw | None:
        """Return this law with the table that it would make on first use; None if it makes none."""
        return None

    def mirrored(self) -> FilmLaw | None:
        """Return this law in a bearing seen in a mirror, y to -y; None if it is its own image."""
        return None

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses | None:
        """Return shear and flow at eccentricities e and sources w (2, ...); None if the law does not know.

        Between openings the oil runs at `rate` (...) [1/s], speed/2; by default as for a journal at rest.
        """
        return None

    def loss_kernel(self, slenderness: float) -> LossKernel | None:
        """Return shear and flow with slopes in compiled code; None if there are none."""
        return None


Kind = TypeVar("Kind")


def options(law: object, kind: type[Kind]) -> Kind:
    """Return the options of any law, of a `kind` such as `FilmOptions`.

    A law that does not derive from it, but has one of them under its name, has that one.
    """
    if isinstance(law, kind):
        return law
    names = [name for name in dir(kind) if not name.startswith("_") and hasattr(law, name)]
    own = type(kind.__name__, (kind,), {name: getattr(law, name) for name in names})
    return cast(Kind, own())


class PolarFrame(NamedTuple):
    """The journal's state in polar axes, batch axis first.

    Attributes
    ----------
    chi : ndarray, shape (B,)
        Eccentricity ratio.
    axes : ndarray, shape (B, 2, 2)
        Columns e_t and e_r.
    source : ndarray, shape (B, 2)
        (g_s, g_c) [1/s].
    """

    chi: Array
    axes: Array
    source: Array

    @property
    def turn(self) -> Array:
        """Direction t of the source, g = |g| cos(gamma - t), shape (B,) [rad]."""
        return np.arctan2(self.source[:, 0], self.source[:, 1])


class PolarResponse(NamedTuple):
    """The matrix A (B, 2, 2), order (sin, cos), and its derivatives; that by the attitude is often None."""

    A: Array
    A_chi: Array
    A_turn: Array
    A_attitude: Array | None = None


Respond = Callable[[PolarFrame], PolarResponse]
"""A polar law: what it answers in a frame."""


def polar_frame(eccentricity: Array, source: Array, floor: float = 0.0) -> PolarFrame:
    """Return the polar frame of states given as (2, B); a chi below `floor` is raised to it."""
    chi = np.hypot(eccentricity[0], eccentricity[1])
    off_center = chi > 0.0
    # Denormal numbers have too few digits for a direction.
    lifted = np.where(chi < TINY, 2.0**600, 1.0) * eccentricity
    safe = np.where(off_center, np.hypot(lifted[0], lifted[1]), 1.0)
    cos = np.where(off_center, lifted[0] / safe, 1.0)
    sin = np.where(off_center, lifted[1] / safe, 0.0)
    axes, polar = np.empty((chi.size, 2, 2)), np.empty((chi.size, 2))
    axes[:, 0, 0], axes[:, 1, 0] = -sin, cos
    axes[:, 0, 1], axes[:, 1, 1] = cos, sin
    polar[:, 0] = cos * source[1] - sin * source[0]
    polar[:, 1] = cos * source[0] + sin * source[1]
    return PolarFrame(np.maximum(chi, floor), axes, polar)


def cartesian_force(frame: PolarFrame, A: Array) -> Array:
    """Return the Cartesian force, shape (2, B), of the polar law with matrix A (B, 2, 2)."""
    return np.einsum("bij,bjk,bk->ib", -frame.axes, A, frame.source)


def cartesian_jacobian(frame: PolarFrame, response: PolarResponse) -> Array:
    """Return d force / d (eccentricity, source), shape (2, 4, B), of a polar law.

    With F = Q f(chi, phi, Q^T w), Q = (e_t, e_r) and J the quarter turn, F_w = Q f_g Q^T and
    F_e = Q f_chi e_r^T + (J F - F_w J w + Q f_phi) e_t^T / chi, where f_g = -A - A_turn g (dt/dg)^T and
    f_phi = -A_attitude g, which only a film has that is held in the bearing.
    """
    g, Q = frame.source, frame.axes
    squared = np.einsum("bi,bi->b", g, g)
    turn_slope = np.stack([g[:, 1], -g[:, 0]], -1) / np.where(squared > 0.0, squared, 1.0)[:, None]
    f_source = -response.A - np.einsum("bij,bj,bk->bik", response.A_turn, g, turn_slope)
    F_source = Q @ f_source @ Q.swapaxes(-1, -2)
    F = -np.einsum("bij,bjk,bk->bi", Q, response.A, g)
    F_chi = -np.einsum("bij,bjk,bk->bi", Q, response.A_chi, g)
    w = np.einsum("bij,bj->bi", Q, g)
    F_angle = _quarter_turn(F) - np.einsum("bij,bj->bi", F_source, _quarter_turn(w))
    if response.A_attitude is not None:
        F_angle -= np.einsum("bij,bjk,bk->bi", Q, response.A_attitude, g)
    F_across = F_angle / frame.chi[:, None]
    F_eccentricity = F_chi[:, :, None] * Q[:, None, :, 1] + F_across[:, :, None] * Q[:, None, :, 0]
    return np.moveaxis(np.concatenate([F_eccentricity, F_source], axis=-1), 0, -1)


def polar_force(respond: Respond, eccentricity: Array, source: Array, chunk: int = CHUNK) -> Array:
    """Return the force (2, ...) of a polar law, which answers for `chunk` states at once.

    Raises FilmContactError where there is no film.
    """
    e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
    require_film(e)
    force = np.empty(e.shape)
    for part in _chunks(e.shape[1], chunk):
        frame = polar_frame(e[:, part], w[:, part])
        force[:, part] = cartesian_force(frame, respond(frame).A)
    return force.reshape(eccentricity.shape)


def polar_jacobian(
    respond: Respond, eccentricity: Array, source: Array, *, turns: bool, chunk: int = CHUNK
) -> Array:
    """Return d force / d (eccentricity, source), shape (2, 4, ...), of a polar law.

    A law whose film `turns` with the source raises UndefinedDerivativeError where the source vanishes, any
    law FilmContactError where there is no film.
    """
    e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
    require_film(e)
    jacobian = np.empty((2, 4, e.shape[1]))
    for part in _chunks(e.shape[1], chunk):
        frame = polar_frame(e[:, part], w[:, part], floor=CENTER)
        if turns:
            require_direction(frame)
        jacobian[:, :, part] = cartesian_jacobian(frame, respond(frame))
    return jacobian.reshape(2, 4, *eccentricity.shape[1:])


def require_film(eccentricity: Array) -> None:
    """Raise FilmContactError unless every eccentricity (2, B) leaves a film."""
    chi = np.hypot(eccentricity[0], eccentricity[1])
    if not np.all(chi < 1.0):
        raise wall_contact(float(np.max(chi)))


def wall_contact(chi: float) -> FilmContactError:
    """Return the error of a film that is squeezed out, at eccentricity ratio chi."""
    return FilmContactError(f"eccentricity ratio must be below 1, got {chi:.9g}")


def require_direction(frame: PolarFrame) -> None:
    """Raise UndefinedDerivativeError where the source vanishes.

    There a film whose arc turns with the source has a force of zero but a derivative that depends on
    the direction of approach: at rest without rotation, and in exact half-speed whirl.
    """
    vanishing = ~np.any(frame.source, axis=-1)
    if np.any(vanishing):
        raise vanishing_source(frame.chi[vanishing][0])


def vanishing_source(chi: float) -> UndefinedDerivativeError:
    """Return the error of a film without derivative, since nothing drives it at eccentricity ratio chi."""
    return UndefinedDerivativeError(
        "source w = velocity/clearance - (speed/2) z^ x eccentricity must not vanish where a "
        f"derivative is asked for, got w = 0 at eccentricity ratio {chi:.6g}"
    )


def _chunks(size: int, chunk: int) -> list[slice]:
    return [slice(begin, begin + chunk) for begin in range(0, size, chunk)]


def _quarter_turn(vectors: Array) -> Array:
    return np.stack([-vectors[:, 1], vectors[:, 0]], -1)
