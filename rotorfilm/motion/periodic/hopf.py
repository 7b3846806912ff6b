"""The onset of whirl: the Hopf bifurcation of a rotor at rest in its films, and its criticality."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from ...errors import ConvergenceError, InputError, require_finite
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Readable
from ...rotors import MountedRotor
from ..compiled.modal import Complex, ModalRotor, journal_rows, modal_rotor, take_apart
from .modal_films import film_forces
from .rest import Rest, force_columns, leading, rest_of

STENCIL = 3
"""Points on either side in the differences of the films' exact slopes: sixth order."""

REACH = 0.03
"""Distance of the outermost of them, in the film thickness left."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HopfPoint(Readable):
    """Where a rotor at rest begins to whirl as a parameter changes.

    With a the amplitude of the whirl in clearances (root of the sum of squares of the first harmonics of all
    journals) its growth is crossing (parameter - onset) + growth_curvature a^2, to leading order.

    Attributes
    ----------
    parameter : float
        The onset.
    frequency : float [rad/s]
        Of the whirl.
    speed : float [rad/s]
    position : ndarray, shape (2 n_bearings,) [m]
        Of the journals at rest.
    shape : ndarray of complex, shape (2 n_bearings,) [m]
        First harmonic of the journals in a whirl of amplitude 1.
    crossing : float
        Change of the growth rate with the parameter [1/s per its unit].
    growth_curvature : float [1/s]
        Change of the growth rate with a^2; over the frequency it is the first Lyapunov coefficient.
    """

    parameter: float
    frequency: float
    speed: float
    position: Array
    shape: Complex
    crossing: float
    growth_curvature: float

    @property
    def lyapunov(self) -> float:
        """First Lyapunov coefficient [1], for the amplitude in clearances."""
        return self.growth_curvature / self.frequency

    @property
    def supercritical(self) -> bool:
        """Whether small stable whirl begins here; else large whirl coexists with the rest below the onset."""
        return self.growth_curvature < 0.0

    @property
    def parameter_curvature(self) -> float:
        """(parameter - onset) / a^2 of the small orbits."""
        return -self.growth_curvature / self.crossing


class _Onset(NamedTuple):
    modal: ModalRotor
    rest: Rest
    value: complex


@arguments
def hopf_point(family: Callable[[float], MountedRotor], bounds: tuple[float, float]) -> HopfPoint:
    """Return where a rotor at rest loses stability to whirl, and the criticality of that.

    Parameters
    ----------
    family : callable
        From the parameter to the rotor in its bearings. Its unbalance does not matter.
    bounds : (float, float)
        Two values of the parameter, stable at one and unstable at the other.

    Raises
    ------
    InputError
        If the rest is stable, or unstable, at both.
    ConvergenceError
        If it is lost there without whirl.
    EquilibriumError
        If there is no rest.

    Notes
    -----
    The growth of small whirl follows from the second and third derivatives of the film forces (Kuznetsov,
    Elements of applied bifurcation theory: the first Lyapunov coefficient by projection on the mode).
    These are differences of sixth order of the exact first derivatives.
    """
    low, high = (float(value) for value in require_finite("bounds", bounds))

    def growth(parameter: float) -> float:
        return _onset(family, parameter).value.real

    ends = growth(low), growth(high)
    if ends[0] * ends[1] > 0.0:
        raise InputError(
            f"bounds must be stable at one end and unstable at the other, got growth rates {ends} 1/s"
        )
    parameter = brentq(growth, low, high, xtol=1e-13 * max(abs(low), abs(high)), rtol=1e-14)
    at = _onset(family, parameter)
    if abs(at.value.imag) <= 1e-6 * max(abs(at.modal.parts.speed), abs(at.value)):
        raise ConvergenceError(f"rest must be lost to whirl, but is lost without at {parameter:.9g}")
    step = 1e-4 * (high - low)
    crossing = (growth(parameter + step) - growth(parameter - step)) / (2.0 * step)
    shape, curvature = growth_curvature(at.modal, at.rest, at.value.imag)
    return HopfPoint(
        parameter=parameter,
        frequency=float(at.value.imag),
        speed=at.modal.parts.speed,
        position=at.rest.position,
        shape=shape,
        crossing=crossing,
        growth_curvature=curvature,
    )


def _onset(family: Callable[[float], MountedRotor], parameter: float) -> _Onset:
    mounted = family(parameter)
    parts = take_apart(mounted)
    modal = modal_rotor(parts, parts.speed)
    rest = rest_of(mounted, modal)
    value = leading(rest.matrix)[0]
    return _Onset(modal, rest, complex(value.real, abs(value.imag)))


def growth_curvature(modal: ModalRotor, rest: Rest, frequency: float) -> tuple[Complex, float]:
    """Return the whirling mode of the journals and the change of its growth with the squared amplitude.

    With A q = i w q, p' A = i w p', p' q = 1 and the forms B, C of second and third derivatives,

        2 c = p' (C(q, q, q*) - 2 B(q, A^-1 B(q, q*)) + B(q*, (2 i w - A)^-1 B(q, q))),

    and the growth of x = z q + z* q* changes by Re c |z|^2.
    """
    A = rest.matrix
    q = _eigenvector(A, 1j * frequency)
    p = _eigenvector(A.T, 1j * frequency).conj()
    rows = journal_rows(modal.parts)
    units = np.repeat(modal.parts.lengths, 2)
    positions = (rows @ q).reshape(-1, 4)[:, :2].ravel()
    q = q / (2.0 * np.linalg.norm(positions / units))
    p = p / np.vdot(p, q).conj()
    form = _Forms(modal, rest, frequency)
    real, imaginary = q.real, q.imag
    qq, q_star = form.second(q, q), form.second(q, q.conj())
    cubic = (
        form.third(real, real)
        + form.third(imaginary, real)
        + 1j * (form.third(real, imaginary) + form.third(imaginary, imaginary))
    )
    eye = np.eye(len(A))
    total = cubic - 2.0 * form.second(q, np.linalg.solve(A, q_star))
    total = total + form.second(q.conj(), np.linalg.solve(2j * frequency * eye - A, qq))
    shape = 2.0 * (rows @ q).reshape(-1, 4)[:, :2].ravel()
    return shape, float(0.5 * np.vdot(p, total).real)


def _eigenvector(matrix: Array, value: complex) -> Complex:
    values, vectors = np.linalg.eig(matrix)
    return vectors[:, int(np.argmin(np.abs(values - value)))]


class _Forms:
    """Second and third derivatives of the accelerations along directions of the state."""

    def __init__(self, modal: ModalRotor, rest: Rest, frequency: float) -> None:
        self._modal, self._rest, self._frequency = modal, rest, frequency
        self._rows = journal_rows(modal.parts)
        self._push = force_columns(modal)
        self._gap = modal.parts.lengths - np.hypot(*rest.position.reshape(-1, 2).T)
        s = np.arange(-STENCIL, STENCIL + 1.0)
        powers = np.linalg.inv(np.vander(s, increasing=True))
        self._points, self._first, self._second = s, powers[1], 2.0 * powers[2]

    def second(self, u: Complex, v: Complex) -> Complex:
        """Return B(u, v)."""
        real, imaginary = self._slopes(u.real)[0], self._slopes(u.imag)[0]
        return self._forced(real, v) + 1j * self._forced(imaginary, v)

    def third(self, u: Array, v: Array) -> Complex:
        """Return C(u, u, v) for real u."""
        return self._forced(self._slopes(u)[1], v)

    def _forced(self, slopes: Array, v: Complex) -> Complex:
        motion = (self._rows @ v).reshape(-1, 4)
        force = np.einsum("brk,bk->br", slopes.reshape(-1, 2, 4), motion).ravel()
        return self._push @ force

    def _slopes(self, u: Array) -> tuple[Array, Array]:
        """Return first and second derivative of the films' slopes (2 n, 4) along a direction."""
        motion = (self._rows @ u).reshape(-1, 4)
        size = np.abs(motion / np.array([1.0, 1.0, self._frequency, self._frequency])).max(axis=1)
        if not np.any(size > 0.0):
            none = np.zeros((2 * len(self._gap), 4))
            return none, none
        step = REACH / STENCIL * float(np.min(self._gap[size > 0.0] / size[size > 0.0]))
        moved = motion[:, :, None] * (step * self._points)
        position = self._rest.position[:, None] + moved[:, :2].reshape(-1, len(self._points))
        _, stiffness, damping = film_forces(
            self._modal, position, np.ascontiguousarray(moved[:, 2:].reshape(-1, len(self._points)))
        )
        slopes = np.concatenate([stiffness, damping], axis=1)
        return slopes @ self._first / step, slopes @ self._second / step**2
