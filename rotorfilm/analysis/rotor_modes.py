"""Whirl modes of a flexible rotor: frequency, damping, direction, and how they go with speed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig

from ..core.errors import InputError, require_finite, require_number, require_positive
from ..core.inputs import arguments
from ..core.model import Array, Reaction
from ..core.readable import Readable
from ..rotors import FlexibleRotor, require_flexible
from ..rotors.structure import Structure
from .frequency_dependent import motion_by_memory
from .modal_reduction import COUNTS, TOLERANCE, Condensed, counted, models, tally, usual_frequency
from .rotor_equilibrium import RotorEquilibrium, rest
from .rotor_matrices import remembering, rest_near, small_motion
from .truncation_error import WholeRotor, roundoff, whirl_errors

_OSCILLATES = 1e-6

_HELD = 1e-12
"""Stiffness force / the forces that cancel in it, below which nothing holds a shape."""


GROWN = 1e-4
"""Growth rate / frequency that is growth whatever the roundoff, whose bound is wide for light elements."""

_SAME = 1e-9
"""Relative difference below which two eigenvalues are one."""


class Whirls:
    """What eigenvalues say of whirl."""

    eigenvalues: NDArray[np.complex128]
    roundoff: Array | float

    _shown: ClassVar[tuple[str, ...]] = ("frequency", "log_decrement")

    @property
    def frequency(self) -> Array:
        """Damped frequency [rad/s], in the shape of the eigenvalues."""
        return self.eigenvalues.imag

    @property
    def log_decrement(self) -> Array:
        """Logarithm of the ratio of two successive amplitudes [1]: negative where the whirl grows."""
        return log_decrement(self.eigenvalues)

    @property
    def grows(self) -> NDArray[np.bool_]:
        """Whether a whirl grows by more than the roundoff of its eigenvalue, or 1e-4 of its frequency."""
        bound = np.minimum(self.roundoff, GROWN * np.abs(self.eigenvalues))
        return np.asarray(self.eigenvalues.real > bound)


@dataclass(frozen=True, kw_only=True)
class RotorModes(Whirls, Readable):
    """The oscillating modes of a rotor at a speed, by rising frequency.

    Attributes
    ----------
    speed : float [rad/s]
    eigenvalues : ndarray, shape (n,) [1/s]
        Those with a positive imaginary part, which is the damped frequency.
    shapes : ndarray, shape (N, n)
        Complex coordinates of the rotor.
    direction : ndarray, shape (n,) [1]
        From 1, whirl in circles with the rotation, to -1, in circles against it.
    frequency : ndarray, shape (n,) [rad/s]
        Damped frequency, the imaginary part of the eigenvalues.
    log_decrement : ndarray, shape (n,) [1]
        Negative where the whirl grows.
    error : float [1]
        Largest relative error of an eigenvalue by the shapes that were left out, estimated; 0 where none
        were.
    roundoff : ndarray, shape (n,) [1/s]
        How far roundoff may move an eigenvalue, by its condition: a growth rate below it is none.
    highest_frequency : float [rad/s]
        Up to which |s| the whirls are told; inf where all are.
    work : dict of str to int
        Rests of the rotor that were searched (equilibria); eigenproblems in the shapes kept; factorizations
        of matrices of all coordinates.
    """

    speed: float
    eigenvalues: NDArray[np.complex128]
    shapes: NDArray[np.complex128]
    direction: Array
    error: float = 0.0
    roundoff: Array | float = 0.0
    highest_frequency: float = math.inf
    work: dict[str, int] = field(default_factory=dict, compare=False)


def log_decrement(eigenvalues: ArrayLike) -> Array:
    """Return -2 pi Re / |Im| of eigenvalues [1]."""
    values = np.asarray(eigenvalues)
    return np.asarray(-2.0 * np.pi * values.real / np.abs(values.imag))


@arguments
def rotor_modes(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float, highest_frequency: float = math.inf
) -> RotorModes:
    """Return the whirl modes of a rotor on its films at a speed.

    Motion that nothing holds, as that of a weightless rotor without bearings as a whole, is no whirl. Up to a
    frequency a rotor moves in as many of its shapes as that needs.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        By the name of the station; linearized at the equilibrium of this speed.
    speed : float [rad/s]
        Of either sign; a rotor at rest counts as turning about +z.
    highest_frequency : float [rad/s]
        Whirls with a larger |s| may be left out, faster ones are. If infinite, all whirls of a rotor of up to
        160 coordinates (19 default elements); of others those up to the larger of twice the speed and
        the tenth frequency in a plane of the shaft on no bearings. `RotorModes.highest_frequency` tells it.

    Raises
    ------
    InputError
        If the speed is not finite, or the highest frequency not positive.
    EquilibriumError
        If there is no equilibrium.
    """
    with counted(*COUNTS) as work:
        motions = motions_at(rotor, bearings, speed, highest_frequency)
    return replace(whirls_of(motions, highest_frequency), work=dict(work))


class Motions(RotorModes):
    """The whirls at a speed, those beyond `highest_frequency` too, after motions that do not oscillate."""


def motions_at(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float, highest_frequency: float = math.inf
) -> Motions:
    """Return the whirl modes at a speed, and before them the motions that do not oscillate."""
    require_flexible(rotor)
    speed = require_number("speed", speed)
    require_range(highest_frequency)
    known_to = highest_frequency if highest_frequency < math.inf else usual_frequency(rotor, speed)
    found = (
        _motions(model, rest(model.structure, bearings, speed), known_to) for model in models(rotor, known_to)
    )
    return next(motions for motions in found if motions.error <= TOLERANCE)


def motions_about(rotor: FlexibleRotor, at: RotorEquilibrium) -> Motions:
    """Return the same about a rest that is known, with its K and C of the bearings."""
    known_to = usual_frequency(rotor, at.speed)
    found = (_motions(model, at, known_to) for model in models(rotor, known_to))
    return next(motions for motions in found if motions.error <= TOLERANCE)


def require_range(highest_frequency: float) -> None:
    """Raise InputError unless a highest frequency [rad/s] is positive; it may be infinite."""
    if highest_frequency != math.inf:
        require_positive("highest_frequency", highest_frequency)


def whirls_of(motions: Motions, highest_frequency: float = math.inf) -> RotorModes:
    """Return those of the motions that oscillate, as far as their error is known, to a frequency [rad/s]."""
    whirls = oscillates(motions.eigenvalues) & (np.abs(motions.eigenvalues) <= motions.highest_frequency)
    whirls &= motions.frequency <= highest_frequency
    return RotorModes(
        speed=motions.speed,
        eigenvalues=motions.eigenvalues[whirls],
        shapes=motions.shapes[:, whirls],
        direction=motions.direction[whirls],
        error=motions.error,
        roundoff=np.broadcast_to(motions.roundoff, whirls.shape)[whirls],
        highest_frequency=min(highest_frequency, motions.highest_frequency),
    )


def _motions(model: Condensed, at: RotorEquilibrium, known_to: float) -> Motions:
    """Return the motions of a model of a rotor, in the coordinates of the whole."""
    parts = [_part(model, at, part, known_to) for part in _frequencies(model.structure, abs(at.speed))]
    shapes = np.hstack([part.shapes for part in parts])
    return Motions(
        speed=at.speed,
        eigenvalues=np.concatenate([part.values for part in parts]),
        shapes=model.lifted(shapes),
        direction=directions(model.structure.mass, shapes, at.speed),
        error=max(part.error for part in parts),
        roundoff=np.concatenate([part.roundoff for part in parts]),
        highest_frequency=math.inf if model.space is None else known_to,
    )


def directions(mass: Any, shapes: np.ndarray, speed: float) -> Array:
    """Return the direction of shapes (N, m) as in `RotorModes`, with their mass matrix."""
    n = len(shapes) // 2
    turned = [shapes[:n] + sign * 1j * shapes[n:] for sign in (1.0, -1.0)]
    forward, backward = (np.sum(u.conj() * (mass[:n, :n] @ u), axis=0).real for u in turned)
    return np.asarray((-1.0 if speed < 0.0 else 1.0) * (forward - backward) / (forward + backward))


class _Band(NamedTuple):
    """Frequencies low <= Im s < high that have the hysteresis of one frequency [rad/s]."""

    frequency: float
    low: float
    high: float


class _Part(NamedTuple):
    """Eigenvalues of such a band, rising in frequency, shapes, largest relative error, roundoff of each."""

    values: NDArray[np.complex128]
    shapes: NDArray[np.complex128]
    error: float
    roundoff: Array


def _frequencies(structure: Structure, turn: float) -> tuple[_Band, ...]:
    if structure.hysteresis is None:
        return (_Band(0.0, 0.0, math.inf),)
    return _Band(0.5 * turn, 0.0, turn), _Band(2.0 * turn + 1.0, turn, math.inf)


def _part(model: Condensed, at: RotorEquilibrium, band: _Band, known_to: float) -> _Part:
    """Return the eigenvalues of a band; not of motion that nothing holds."""
    system = small_motion(model.structure, at, band.frequency)
    tally("eigenproblems")
    matrix = system.state_matrix()
    values, left, vectors = eig(matrix, left=True)
    rounded = roundoff(matrix, left, vectors)
    shapes = vectors[: len(system.mass)]
    whole, lifted = WholeRotor(model.whole, at, band.frequency), model.lifted(shapes)
    chosen = _is_held(whole, values, lifted) & (values.imag >= band.low) & (values.imag < band.high)
    order = np.flatnonzero(chosen)[np.argsort(values.imag[chosen])]
    if remembering(at):
        return _remembered(model, at, band, known_to, (values[order], shapes[:, order], rounded[order]))
    asked = [k for k in order if oscillates(values[k]) and abs(values[k]) <= known_to]
    error = 0.0
    if model.space is not None and asked:
        ends = model.lifted(np.linalg.solve(system.mass, left[len(system.mass) :, asked]))
        error = float(whirl_errors(model, whole, values[asked], lifted[:, asked], ends).max())
    return _Part(values[order].astype(complex), shapes[:, order].astype(complex), error, rounded[order])


def _remembered(
    model: Condensed,
    at: RotorEquilibrium,
    band: _Band,
    known_to: float,
    next_to: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> _Part:
    """Return the motions on films that remember next to those with K and C of one frequency."""
    found: list[tuple[complex, np.ndarray, float]] = []
    error, (starts, shapes, rounded) = 0.0, next_to
    for start, shape, rounding in zip(starts, shapes.T, rounded, strict=True):
        one = motion_by_memory(model.structure, at, band.frequency, complex(start), shape)
        if one is None or any(abs(one.value - other) <= _SAME * abs(other) for other, *_ in found):
            continue
        found.append((one.value, one.right, float(rounding)))
        if model.space is not None and oscillates(np.array(one.value)) and abs(one.value) <= known_to:
            whole = WholeRotor(model.whole, rest_near(at, one.value), band.frequency)
            ends = (model.lifted(vector[:, None]) for vector in (one.right, one.left))
            error = max(error, float(whirl_errors(model, whole, np.array([one.value]), *ends)[0]))
    found.sort(key=lambda motion: motion[0].imag)
    values = np.array([value for value, *_ in found], dtype=complex)
    vectors = np.array([vector for _, vector, _ in found], dtype=complex).reshape(-1, len(shapes))
    return _Part(values, vectors.T, error, np.array([rounding for *_, rounding in found]))


def _is_held(
    whole: WholeRotor, values: NDArray[np.complex128], shapes: NDArray[np.complex128]
) -> NDArray[np.bool_]:
    """Return which motions something holds."""
    size = np.abs(values)
    inertia = np.linalg.norm(whole.shaft.mass @ shapes, axis=0)
    damping = np.linalg.norm(whole.slope(0.0, shapes), axis=0)
    held = np.linalg.norm(whole.held(np.abs(shapes)), axis=0)
    return np.asarray(size * (size * inertia + damping) > _HELD * held)


def oscillates(values: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """Return which eigenvalues are those of whirl."""
    return np.asarray(values.imag > _OSCILLATES * np.abs(values))


def speeds_in_turn(speeds: ArrayLike) -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they rise or fall throughout."""
    grid = require_finite("speeds", speeds)
    steps = np.diff(grid) if grid.ndim == 1 else np.zeros(1)
    if not grid.size or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speeds must be a list of rising or of falling numbers, got {speeds!r}")
    return grid
