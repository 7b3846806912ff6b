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
from abc import abstractmethod
from collections.abc import Callable, Mapping
from ctypes import addressof
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple, Protocol, TypeVar, cast, runtime_checkable

import numpy as np

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_inside,
    warn_user,
)
from ...core.model import Array
from ...native import FilmKernel, JournalKernel, Status
from ...native.film_call import FilmCall, address_of
from ...native.film_kernels import Batch, ResponseKernel, static_rate as static_rate
from ...native.loss_kernels import LossKernel
from ..reaction import broadcast_state, without_overflow
from .geometry import FilmGeometry
from .mobility import Mobility, sheared_gap

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

    def at_scale(self, reynolds_scale: float) -> FilmLaw | None:
        """Return the law in a bearing of this radius times clearance over viscosity [m3/kg s].

        None if the law does not change with the Reynolds number, density |speed| times that.
        """
        return None

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundKernel | None:
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
    F_e = Q f_chi e_r^T + (J F - F_w J w + Q f_phi) e_t^T / chi, where f_g = -A - A_turn g (dt/dg)^T. Only a
    film that is held in the bearing has f_phi = -A_attitude g.
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


# The film of one bearing by a film law in numpy: kinematics, scaling, and mirrored rotation.


ROUNDOFF = 1e-14
"""A source below this fraction of its two terms is their cancellation, hence zero."""


@dataclass(frozen=True, kw_only=True)
class BoundLaw:
    """A film of one bearing in SI units: over any film law.

    Parameters
    ----------
    law : FilmLaw
    slenderness : float [1]
        Length / diameter.
    clearance : float [m]
    force_per_rate : float [N s]
        viscosity length radius^3 / clearance^2.
    mirrored : bool
        Whether backward rotation is mirrored. The arc of `FixedArc` follows the sense of rotation. Pads and
        grooves do not: a law fitted to them takes any source, and is left as it is.
    """

    law: FilmLaw
    slenderness: float
    clearance: float
    force_per_rate: float
    mirrored: bool

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return (force_x, force_y) [N] for numbers; raises what the bearing's `force` raises."""
        force_x, force_y = self.force(*broadcast_state((x, y), (vx, vy), speed)).tolist()
        return force_x, force_y

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) [N] and the ten entries of the Jacobian, row by row, for numbers."""
        state = broadcast_state((x, y), (vx, vy), speed)
        force_x, force_y = self.force(*state).tolist()
        return force_x, force_y, self.jacobian(*state).ravel().tolist()

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...); raise InputError where it overflows."""
        return without_overflow(self._force, position, velocity, speed)

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force/d(x, y, vx, vy, speed), shape (2, 5, ...); raise InputError where it overflows."""
        return without_overflow(self._jacobian, position, velocity, speed)

    def _force(self, position: Array, velocity: Array, speed: Array) -> Array:
        eccentricity, source = kinematics(position, velocity, speed, self.clearance)
        mirror = self._mirror(speed)
        film = self._in_mirror("force", (2,), mirror, eccentricity, source)
        return self.force_per_rate * mirror * film

    def _jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        eccentricity, source = kinematics(self._off_center(position), velocity, speed, self.clearance)
        mirror = self._mirror(speed)
        film = self._in_mirror("jacobian", (2, 4), mirror, eccentricity, source)
        film = self.force_per_rate * mirror[:, None] * film * np.tile(mirror, (2, *(1,) * speed.ndim))
        by_eccentricity, by_source = film[:, :2], film[:, 2:]
        # w = v/c - (speed/2) (-e_y, e_x), so the columns of F_w (z^ x .) are (F_wy, -F_wx).
        turned = np.stack([by_source[:, 1], -by_source[:, 0]], axis=1)
        by_position = (by_eccentricity - 0.5 * speed * turned) / self.clearance
        by_speed = 0.5 * (by_source[:, 0] * eccentricity[1] - by_source[:, 1] * eccentricity[0])
        return np.concatenate([by_position, by_source / self.clearance, by_speed[:, None]], axis=1)

    def _in_mirror(
        self, what: str, shape: tuple[int, ...], mirror: Array, eccentricity: Array, source: Array
    ) -> Array:
        """Return what the law says where nothing is mirrored, and what its image says where something is."""
        image, turned = options(self.law, FilmOptions).mirrored(), mirror[1] < 0.0
        e, w = mirror * eccentricity, mirror * source
        if image is None or not turned.any():
            return np.asarray(getattr(self.law, what)(e, w, self.slenderness))
        found = np.empty((*shape, *turned.shape))
        for law, some in ((self.law, ~turned), (image, turned)):
            found[..., some] = getattr(law, what)(e[:, some], w[:, some], self.slenderness)
        return found

    def _off_center(self, position: Array) -> Array:
        """Return the position, moved onto the circle `CENTER` * clearance where it is inside that.

        A law in polar axes has its derivative at the center as a limit; moving the position, and the source
        with it, takes the limit along x.
        """
        distance = np.hypot(position[0], position[1])
        on_circle = np.stack([np.full_like(distance, CENTER * self.clearance), np.zeros_like(distance)])
        return np.where(distance < CENTER * self.clearance, on_circle, position)

    def _mirror(self, speed: Array) -> Array:
        """Return the signs (1, +-1) of the reflection that makes the rotation positive, shape (2, ...)."""
        mirror = np.ones((2, *speed.shape))
        if self.mirrored:
            mirror[1] -= 2.0 * (speed < 0.0)
        return mirror


def kinematics(position: Array, velocity: Array, speed: Array, clearance: float) -> tuple[Array, Array]:
    """Return the eccentricity and the source w = v/c - (speed/2) z^ x e of the film laws.

    Raises FilmContactError where the journal touches the wall.
    """
    require_inside(position, clearance)
    eccentricity = position / clearance
    squeeze = velocity / clearance
    wedge = eccentricity[::-1] * (0.5 * speed)
    wedge[1] *= -1.0
    source = squeeze + wedge
    terms = (abs(squeeze) + abs(wedge)).max(axis=0)
    source *= abs(source).max(axis=0) > ROUNDOFF * terms
    return eccentricity, source


# Film laws of the C library: one dimensionless, and as the film of one bearing in SI units.


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
        return self._answer(eccentricity, source, slenderness, slopes=False).reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the source vanishes, in a plain bearing off the center only.
        """
        found = self._answer(eccentricity, source, slenderness, slopes=True)
        return found.reshape(2, 4, *eccentricity.shape[1:])

    def _answer(self, e: Array, w: Array, slenderness: float, *, slopes: bool) -> Array:
        kernel, state = self._kernel(slenderness), (e.reshape(2, -1), w.reshape(2, -1))
        batch = (kernel.jacobian if slopes else kernel.force)(*state)
        report_law(batch, *state, kernel)
        return batch.values

    def bind(self, *, slenderness: float, clearance: float, force_scale: float) -> BoundKernel:
        """Return this film in one bearing, in SI units; see `FilmOptions`."""
        return BoundKernel(JournalKernel(self._kernel(slenderness), clearance, force_scale), clearance)


@dataclass(frozen=True, eq=False)
class BoundKernel:
    """A film of one bearing in SI units: over the C kernel.

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

    def compiled(self) -> FilmCall:
        """Return the force for loops in C; see `core.port.Reaction`."""
        kernel = self.kernel
        address, data = address_of(kernel.function), addressof(kernel.struct)
        return FilmCall(address, data, owner=self, beyond=self.beyond, mass=kernel.mass_call)

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
        return self._answer(self.kernel.force, position, velocity, speed).reshape(position.shape)

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""
        if position.ndim == 1:
            x, y = position.tolist()
            vx, vy = velocity.tolist()
            return np.array(self.tangent(x, y, vx, vy, float(speed))[2]).reshape(2, 5)
        found = self._answer(self.kernel.jacobian, position, velocity, speed)
        return found.reshape(2, 5, *position.shape[1:])

    def _answer(
        self, ask: Callable[[Array, Array, Array], Batch], position: Array, velocity: Array, speed: Array
    ) -> Array:
        q, v, omega = position.reshape(2, -1), velocity.reshape(2, -1), speed.ravel()
        batch = ask(q, v, omega)
        if batch.status:
            at = np.argmax(np.hypot(*q)) if batch.status == Status.AT_WALL else batch.first
            (x, y), (vx, vy) = q[:, at].tolist(), v[:, at].tolist()
            self.report(batch.status, x, y, vx, vy, float(np.broadcast_to(omega, q.shape[1:])[at]))
        return batch.values

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
    where = f"eccentricity ratio {chi:.6g}{beside_speed(kernel)}"
    warn_user(f"{where} is beyond the map of the film; its force is {continued(kernel)}")


def beside_speed(kernel: FilmKernel) -> str:
    """Return what tells of the axis of a map over the Reynolds number; empty where it has none."""
    return " at this Reynolds number" if kernel.sped else ""


def continued(kernel: FilmKernel) -> str:
    """Return how the force of a film goes on beyond its map, and the error of that."""
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


# Shear and flow of a film: what decides its power loss, its torques and the oil that leaves it.
#
# The torque on the journal is viscosity omega R^3 L/c times a shear integral Sigma = int int alpha/H
# dtheta dzeta, 0 < zeta < 1 along the length, plus (E x F)_z/2. A full film has alpha = 1. Behind its
# end the oil runs in streamers between both walls, with the thickness H_r at which the film ended:
# alpha = min(1, H_r/H). The side flow is c R L times the source over the film, w . int int n dtheta
# dzeta with H = 1 - e . n, for nothing crosses the free ends. Sigma depends on the direction of the
# source alone; the flow grows with it.


class FilmLosses(NamedTuple):
    """Shear and flow of films, dimensionless.

    Attributes
    ----------
    shear_film : ndarray, shape (...) [1]
        Sigma of the film that carries pressure.
    shear_streamers : ndarray, shape (...) [1]
        Sigma of the streamers in the ruptured zone.
    gap : callable
        It returns `shear_gap`, Sigma of a gap that is full all around, except in the openings.
    side_flow : ndarray, shape (...) [1/s]
        Flow out of both ends of the film / (clearance radius length), without that straight out of openings.
    inflow : ndarray, shape (openings, ...) [1/s]
        Oil that leaves each opening into the films beside it, of the same unit; openings in the order of
        `FilmGeometry.openings`.
    arriving : ndarray, shape (openings, ...) [1/s]
        Oil that comes to each opening from the films and streamers beside it.
    slopes : ndarray, shape (3, 4, ...), or None
        Derivatives of shear_film, shear_streamers and side_flow by (eccentricity, source); None where the
        film law has none. Not-a-number where the source vanishes.
    """

    shear_film: Array
    shear_streamers: Array
    gap: Callable[[], Array]
    side_flow: Array
    inflow: Array
    arriving: Array
    slopes: Array | None = None

    @property
    def shear(self) -> Array:
        """Sigma of film and streamers [1], shape (...)."""
        return self.shear_film + self.shear_streamers

    @property
    def shear_gap(self) -> Array:
        """Sigma of a gap that is full all around [1], shape (...)."""
        return self.gap()


def kernel_losses(
    kernel: LossKernel, eccentricity: Array, source: Array, geometry: FilmGeometry | None = None
) -> FilmLosses:
    """Return the losses of a film by its kernel at states (2, ...), without the flows of openings."""
    shape = eccentricity.shape[1:]
    batch = kernel.losses(eccentricity.reshape(2, -1), source.reshape(2, -1))
    film, streamers, flow = batch.losses.reshape(3, *shape)
    none = np.empty((0, *shape))
    gap = partial(gap_shear, eccentricity, geometry or FilmGeometry())
    return FilmLosses(film, streamers, gap, flow, none, none, batch.slopes.reshape(3, 4, *shape))


def gap_shear(
    eccentricity: Array,
    geometry: FilmGeometry,
    mobility: Mobility | None = None,
    per_thickness: Array | None = None,
) -> Array:
    """Return Sigma of a gap that is full all around, except in the openings, at eccentricities (2, ...).

    Where a mobility changes with the speed, its X per thickness (...) is asked for.
    """
    films = [span for span in geometry.spans() if span.film > 0.0]
    if mobility is not None:
        flat, shape = eccentricity.reshape(2, -1), eccentricity.shape[1:]
        grown = mobility.per_thickness if per_thickness is None else per_thickness
        own = mobility, np.broadcast_to(grown, shape).ravel(), flat
        eased = [span.film * sheared_gap(*own, span.start, span.end)[0] for span in films]
        return np.asarray(np.sum(eased, axis=0)).reshape(shape)
    chi, away = np.hypot(*eccentricity), np.arctan2(-eccentricity[1], -eccentricity[0])
    parts = [
        span.film * (gap_integral(chi, span.end - away) - gap_integral(chi, span.start - away))
        for span in films
    ]
    return np.asarray(np.sum(parts, axis=0))


def gap_integral(chi: Array | float, angle: Array | float) -> Array:
    """Return the integral of 1/(1 + chi cos t) from 0 to an angle of any size.

    On a pad chi may be above 1: then the film between 0 and the angle must be open.
    """
    turns = np.round(angle / (2.0 * np.pi))
    rest = 0.5 * (angle - 2.0 * np.pi * turns)
    closed = np.asarray(chi) < 1.0
    root = np.sqrt(np.abs((1.0 - chi) * (1.0 + chi)))
    ratio = np.sqrt(np.abs((1.0 - chi) / (1.0 + chi)))
    bent = np.arctan2(ratio * np.sin(rest), np.cos(rest)) + np.pi * turns
    if not closed.all():
        bent = np.where(closed, bent, np.arctanh(np.where(closed, 0.0, ratio * np.tan(rest))))
    return np.asarray(2.0 / root * bent)


def squared_integral(chi: Array | float, angle: Array | float) -> Array:
    """Return the integral of 1/(1 + chi cos t)^2 from 0 to an angle of any size."""
    edge = chi * np.sin(angle) / (1.0 + chi * np.cos(angle))
    return np.asarray((gap_integral(chi, angle) - edge) / ((1.0 - chi) * (1.0 + chi)))
