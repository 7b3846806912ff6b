"""Whirl modes of a flexible rotor: frequency, damping, direction, and how they go with speed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator
from scipy.linalg import eig
from scipy.optimize import linear_sum_assignment

from ..core.errors import (
    ConvergenceError,
    InputError,
    brief,
    require_finite,
    require_number,
    require_positive,
)
from ..core.frames import Column, ResultTable
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import Bearings
from ..core.readable import Drawable, Readable, table_of
from ..rotors import FlexibleRotor, require_flexible
from ..rotors.structure import Structure
from . import modal_reduction
from .critical import Crossing, crossings
from .frequency_dependent import frequency_dependent_motions
from .rotor_equilibrium import EquilibriumSearch, RotorEquilibrium
from .rotor_matrices import (
    HELD,
    FullRotorModel,
    frequency_dependent_films,
    growth_roundoff,
    holding,
    joined_whirls,
    oscillates,
    roundoff,
    small_motion,
    whirl_errors,
)
from .threads import one_blas_thread

_ASIDE = 1e-12
"""Energy in the planes / that of axial and torsional motion, below which it is roundoff."""

GROWN = 1e-4
"""Growth rate / frequency that is growth whatever the roundoff, whose bound is wide for light elements."""

_SAME = 1e-9
_NEW_SHAPE = 1e-2
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
    def damping_ratio(self) -> Array:
        """Share of the critical damping [1], -Re s / |s|: negative where the whirl grows."""
        return np.asarray(-self.eigenvalues.real / np.abs(self.eigenvalues))

    @property
    def grows(self) -> NDArray[np.bool_]:
        """Whether motion grows by more than the roundoff of its eigenvalue, or a whirl by 1e-4 / radian."""
        bound = np.minimum(self.roundoff, GROWN * np.abs(self.eigenvalues))
        return np.asarray(
            self.eigenvalues.real > np.where(oscillates(self.eigenvalues), bound, self.roundoff)
        )


CIRCULAR = 0.1
"""Direction beyond which a whirl counts as forward or, negative, backward."""


def senses(direction: ArrayLike) -> NDArray[np.str_]:
    """Return "forward", "backward" or "mixed" for directions as in `RotorModes`; empty words for nan."""
    turns = np.asarray(direction, dtype=float)
    words = np.where(turns > CIRCULAR, "forward", np.where(turns < -CIRCULAR, "backward", "mixed"))
    return np.where(np.isnan(turns), "", words)


KINDS = ("lateral", "axial", "torsional")
"""Kinds of modes, in the order of `RotorModes.energy`."""


@dataclass(frozen=True, kw_only=True)
class RotorModes(Whirls, Readable):
    """The oscillating modes of a rotor at a speed, by rising frequency.

    Attributes
    ----------
    speed : float [rad/s]
    eigenvalues : ndarray, shape (n,) [1/s]
        Eigenvalues with a positive imaginary part, which is the damped frequency.
    shapes : ndarray, shape (N, n)
        Complex coordinates of the rotor.
    direction : ndarray, shape (n,) [1]
        From 1 (circular forward whirl) to -1 (circular backward whirl); 0 for axial and torsional motion.
    frequency : ndarray, shape (n,) [rad/s]
        Damped frequency, the imaginary part of the eigenvalues.
    log_decrement : ndarray, shape (n,) [1]
        Negative where the whirl grows.
    error : float [1]
        Estimated largest relative error of an eigenvalue due to neglected mode shapes; 0 if none were
        neglected.
    roundoff : ndarray, shape (n,) [1/s]
        How far roundoff may move an eigenvalue. A growth rate below this is not significant.
    highest_frequency : float [rad/s]
        Largest |s| up to which all modes are listed; inf if all modes are.
    work : dict of str to int
        Counters: equilibria that were searched; eigenproblems in the reduced coordinates (shapes);
        factorizations of matrices of all coordinates.
    energy : ndarray, shape (3, n) [1]
        Share of lateral, axial and torsional motion in the kinetic energy of the mode.
    """

    speed: float
    eigenvalues: NDArray[np.complex128]
    shapes: NDArray[np.complex128]
    direction: Array
    error: float = 0.0
    roundoff: Array | float = 0.0
    highest_frequency: float = math.inf
    work: dict[str, int] = field(default_factory=dict, compare=False)
    energy: Array = field(default_factory=lambda: np.zeros((3, 0)), compare=False)

    _tabled: ClassVar[tuple[str, ...]] = (
        "eigenvalues",
        "shapes",
        "direction",
        "roundoff",
        "energy",
        "frequency",
        "log_decrement",
    )

    def to_table(self) -> ResultTable:
        """Return a row for each mode: frequency, log decrement, damping ratio, whirl and kind."""
        kinds = np.array(KINDS)[self.energy.argmax(axis=0)] if self.energy.size else ""
        return ResultTable(
            (
                Column("mode", "", np.arange(1, len(self.eigenvalues) + 1)),
                *whirl_columns(self.eigenvalues, self.direction),
                Column("kind", "", np.broadcast_to(kinds, self.eigenvalues.shape)),
            ),
            "modes",
            "mode",
            {"speed": self.speed},
            {"speed": "rad/s"},
        )

    def _pages(self) -> Iterator[ResultTable]:
        yield self.to_table()


def whirl_columns(eigenvalues: NDArray[np.complex128], direction: Array) -> tuple[Column, ...]:
    """Return what a table says of whirls: frequency twice, log decrement, damping ratio, sense."""
    turns = eigenvalues.imag / (2.0 * np.pi)
    with np.errstate(invalid="ignore"):
        ratio = -eigenvalues.real / np.abs(eigenvalues)
    return (
        Column("frequency", "Hz", turns),
        Column("frequency_rpm", "rpm", 60.0 * turns, "frequency"),
        Column("log_decrement", "1", log_decrement(eigenvalues)),
        Column("damping_ratio", "1", ratio),
        Column("whirl", "", senses(direction)),
    )


def log_decrement(eigenvalues: ArrayLike) -> Array:
    """Return -2 pi Re / |Im| of eigenvalues [1]."""
    values = np.asarray(eigenvalues)
    return np.asarray(-2.0 * np.pi * values.real / np.abs(values.imag))


@one_blas_thread
@arguments
def rotor_modes(
    rotor: FlexibleRotor, bearings: Bearings, speed: float, highest_frequency: float = math.inf
) -> RotorModes:
    """Return the whirl modes of a rotor on its films at a speed.

    Rigid-body motion without restoring force, for example of a weightless rotor without bearings, is not
    listed. With a `highest_frequency` the rotor is reduced to the mode shapes that this frequency needs.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        Bearings by the name of the station; linearized at the equilibrium of this speed.
    speed : float [rad/s]
        Speed of either sign; a rotor at rest counts as turning about +z.
    highest_frequency : float [rad/s]
        Modes with a higher frequency are left out. If infinite, a rotor of up to 160 coordinates (19 default
        elements) gets all its modes. A larger rotor gets those up to the larger of two limits: twice the
        speed, and the tenth frequency of the free shaft in a plane. `RotorModes.highest_frequency` holds the
        limit that was used.

    Raises
    ------
    InputError
        If the speed is not finite, or the highest frequency not positive.
    EquilibriumError
        If there is no equilibrium.
    """
    with modal_reduction.counted(*modal_reduction.COUNTS) as work:
        motions = motions_at(rotor, EquilibriumSearch(bearings), speed, highest_frequency)
    return replace(whirls_of(motions, highest_frequency), work=dict(work))


def motions_at(
    rotor: FlexibleRotor, equilibria: EquilibriumSearch, speed: float, highest_frequency: float = math.inf
) -> RotorModes:
    """Return the whirls at a speed, also beyond `highest_frequency`, and motions that do not oscillate."""
    require_flexible(rotor)
    speed = require_number("speed", speed)
    require_range(highest_frequency)
    known_to = (
        highest_frequency if highest_frequency < math.inf else modal_reduction.usual_frequency(rotor, speed)
    )
    reach = _FAR * highest_frequency
    found = (
        _motions(model, equilibria.at(model.structure, speed), known_to, reach)
        for model in modal_reduction.models(rotor, known_to)
    )
    return next(motions for motions in found if motions.error <= modal_reduction.TOLERANCE)


def motions_about(rotor: FlexibleRotor, at: RotorEquilibrium) -> RotorModes:
    """Return the same about a rest that is known, with its K and C of the bearings."""
    known_to = modal_reduction.usual_frequency(rotor, at.speed)
    found = (_motions(model, at, known_to) for model in modal_reduction.models(rotor, known_to))
    return next(motions for motions in found if motions.error <= modal_reduction.TOLERANCE)


def require_range(highest_frequency: float) -> None:
    """Raise InputError unless a highest frequency [rad/s] is positive; it may be infinite."""
    if highest_frequency != math.inf:
        require_positive("highest_frequency", highest_frequency)


def whirls_of(motions: RotorModes, highest_frequency: float = math.inf) -> RotorModes:
    """Return those of the motions that oscillate, as far as their error is known, to a frequency [rad/s]."""
    whirls = oscillates(motions.eigenvalues) & (np.abs(motions.eigenvalues) <= motions.highest_frequency)
    whirls &= motions.frequency <= highest_frequency
    return replace(
        motions,
        eigenvalues=motions.eigenvalues[whirls],
        shapes=motions.shapes[:, whirls],
        direction=motions.direction[whirls],
        energy=motions.energy[:, whirls],
        roundoff=np.broadcast_to(motions.roundoff, whirls.shape)[whirls],
        highest_frequency=min(highest_frequency, motions.highest_frequency),
    )


_FAR = 4.0
"""Frequency with synchronous K and C, over the highest one asked for, beyond which motions are left out."""


def _motions(
    model: modal_reduction.Condensed, at: RotorEquilibrium, known_to: float, reach: float = math.inf
) -> RotorModes:
    """Return the motions of a model of a rotor, in the coordinates of the whole.

    On frequency-dependent films those beyond a frequency `reach` [rad/s] are left out.
    """
    parts = [_part(model, at, part, known_to, reach) for part in bands_of(model.structure, abs(at.speed))]
    values, vectors, errors, rounded = zip(*parts, strict=True)
    shapes = np.hstack(vectors)
    return RotorModes(
        speed=at.speed,
        eigenvalues=np.concatenate(values),
        shapes=model.lifted(shapes),
        direction=directions(model.structure, shapes, at.speed),
        energy=energies(model.structure, shapes),
        error=max(errors),
        roundoff=np.concatenate(rounded),
        highest_frequency=math.inf if model.space is None else known_to,
    )


def directions(structure: Structure, shapes: np.ndarray, speed: float) -> Array:
    """Return the direction of shapes (N, m) as in `RotorModes`."""
    n, mass = len(structure.coordinates), structure.mass
    x, y, others = np.split(shapes, (n, 2 * n))
    turned = [x + sign * 1j * y for sign in (1.0, -1.0)]
    forward, backward = (np.sum(u.conj() * (mass[:n, :n] @ u), axis=0).real for u in turned)
    aside = 2.0 * np.sum(others.conj() * (mass[2 * n :, 2 * n :] @ others), axis=0).real
    whirl, sense = forward + backward, -1.0 if speed < 0.0 else 1.0
    return np.where(whirl > _ASIDE * aside, sense * (forward - backward) / (whirl + aside), 0.0)


def energies(structure: Structure, shapes: np.ndarray) -> Array:
    """Return the kinetic energy of shapes (N, m) as in `RotorModes`."""
    n = 2 * len(structure.coordinates)
    energy = (shapes.conj() * (structure.mass @ shapes)).real
    twists = np.array(["twist" in name for name, *_ in structure.others], dtype=bool)
    parts = energy[:n].sum(axis=0), energy[n:][~twists].sum(axis=0), energy[n:][twists].sum(axis=0)
    return np.stack(parts) / np.where((whole := sum(parts)) > 0.0, whole, 1.0)


Band = tuple[float, float, float]
"""Frequencies low <= Im s < high that have the hysteresis of one frequency [rad/s]: that one, low, high."""

Part = tuple[NDArray[np.complex128], NDArray[np.complex128], float, Array]
"""Eigenvalues of such a band, rising in frequency, shapes, largest relative error, roundoff of each."""


def bands_of(structure: Structure, turn: float) -> tuple[Band, ...]:
    """Return the bands of frequencies of a rotor that turns at a speed [rad/s]; one without hysteresis."""
    if structure.hysteresis is None:
        return ((0.0, 0.0, math.inf),)
    return (0.5 * turn, 0.0, turn), (2.0 * turn + 1.0, turn, math.inf)


def _part(
    model: modal_reduction.Condensed, at: RotorEquilibrium, band: Band, known_to: float, reach: float
) -> Part:
    """Return the eigenvalues of a band; not of motion that nothing holds."""
    frequency, low, high = band
    system = small_motion(model.structure, at, frequency)
    modal_reduction.tally("eigenproblems")
    matrix = system.state_matrix()
    values, *both = eig(matrix, left=True)
    upper = values.imag >= 0.0  # the others are their conjugates
    values, (left, vectors) = values[upper], (one[:, upper] for one in both)
    shapes = vectors[: len(system.mass)]
    whole, lifted = FullRotorModel(model.whole, at, frequency), model.lifted(shapes)
    held = holding(whole, values, lifted)
    rounded = np.minimum(roundoff(matrix, left, vectors), growth_roundoff(values, held, at.speed))
    follows = bool(frequency_dependent_films(at))  # where K(s) takes a motion tells of which band it is
    chosen = (held > HELD) & (values.imag >= 0.0 if follows else (values.imag >= low) & (values.imag < high))
    order = np.flatnonzero(chosen)[np.argsort(values.imag[chosen])]
    if follows:
        return _frequency_dependent_part(
            model, whole, band, (known_to, reach), (values[order], shapes[:, order], rounded[order])
        )
    asked = [k for k in order if oscillates(values[k]) and abs(values[k]) <= known_to]
    error = 0.0
    if model.space is not None and asked:
        ends = model.lifted(np.linalg.solve(system.mass, left[len(system.mass) :, asked]))
        error = float(whirl_errors(model, whole, values[asked], lifted[:, asked], ends).max())
    return values[order].astype(complex), shapes[:, order].astype(complex), error, rounded[order]


FURTHEST = 4.0
"""Size of exponents with K and C of one frequency, over the highest frequency, beyond which those that decay
are not followed to K(s): where they end is beyond it too."""


def _frequency_dependent_part(
    model: modal_reduction.Condensed,
    whole: FullRotorModel,
    band: Band,
    bounds: tuple[float, float],
    next_to: tuple[np.ndarray, np.ndarray, np.ndarray],
) -> Part:
    """Return the motions on frequency-dependent films in a band, next to those with K and C of one frequency.

    The bounds are the frequencies up to which their error is asked for, and up to which they are.

    Whirl in which the states of a film take part as much as the shaft, as that of a body between two
    reactions, is next to none of these, but known where the states are.
    """
    found: list[tuple[complex, np.ndarray, float]] = []
    ends: list[np.ndarray] = []
    (known_to, reach), error, (starts, shapes, rounded), (frequency, low, high) = bounds, 0.0, next_to, band
    at = whole.at
    told = [hasattr(film.dynamic_stiffness, "at") for film in frequency_dependent_films(at).values()]
    known = all(told)
    # Without states that are known the joined system is that of the starts.
    own, ways, roundings = (
        joined_whirls(model, whole, frequency) if any(told) else (starts[:0], shapes[:, :0], rounded[:0])
    )
    partner = _continued((starts, shapes), (own, ways), model.structure.mass) if known else {}
    alone = [k for k in range(len(starts)) if k not in partner]
    begun, ways_of_all = np.concatenate([starts[alone], own]), np.hstack([shapes[:, alone], ways])
    followed = np.flatnonzero(
        (begun.imag <= reach) & ((begun.real >= 0.0) | (np.abs(begun) <= FURTHEST * known_to))
    )
    motions = frequency_dependent_motions(
        model.structure, at, frequency, begun[followed], ways_of_all.T[followed]
    )
    rounding_of_all = [*rounded[alone], *roundings]
    for k, one in zip(followed.tolist(), motions, strict=True):
        start, rounding = begun[k], rounding_of_all[k]
        if one is None:
            # Those that matter are among the eigenvalues with all states, in the band of their hysteresis.
            elsewhere = (known and k < len(alone)) or not low <= start.imag < high
            if elsewhere or start.imag <= -start.real:
                continue
            raise ConvergenceError(f"the whirl near {start:.6g} rad/s was not found by inverse iteration")
        if not low <= one[0].imag < high or _is_among(one[0], one[1], found):
            continue
        s, *vectors = one
        found.append((s, vectors[0], float(rounding)))
        ends.append(vectors[1])
    asked = [k for k, (s, *_) in enumerate(found) if oscillates(np.array(s)) and abs(s) <= known_to]
    if model.space is not None and asked:
        known_values = np.array([found[k][0] for k in asked])
        both = (np.stack([rows[k] for k in asked], 1) for rows in ([one for _, one, _ in found], ends))
        near = whole.near(known_values)
        error = float(whirl_errors(model, near, known_values, *map(model.lifted, both)).max())
    found.sort(key=lambda motion: motion[0].imag)
    values = np.array([value for value, *_ in found], dtype=complex)
    right = np.array([vector for _, vector, _ in found], dtype=complex).reshape(-1, len(shapes))
    return values, right.T, error, np.array([rounding for *_, rounding in found])


_ALIKE = 0.1
"""Difference of two eigenvalues, over the sum of their sizes, below which one may continue the other."""


def _continued(
    starts: tuple[np.ndarray, np.ndarray], own: tuple[np.ndarray, np.ndarray], mass: Any
) -> dict[int, int]:
    """Return which motion with all states of the films each of the `starts` leads to, where that is clear.

    Both are eigenvalues and shapes.
    """
    before, after = (
        RotorModes(speed=0.0, eigenvalues=values, shapes=shapes, direction=values.real)
        for values, shapes in (own, starts)
    )
    apart = np.abs(own[0][:, None] - starts[0]) / np.abs(own[0][:, None] + starts[0])
    return {k: j for k, j in matches(before, after, mass).items() if apart[j, k] < _ALIKE}


def _is_among(value: complex, shape: np.ndarray, found: list[tuple[complex, np.ndarray, float]]) -> bool:
    """Return whether a motion is one of those found; of equal values, whether its shape is made of theirs."""
    equal = [other for s, other, _ in found if abs(value - s) <= _SAME * abs(s)]
    if not equal:
        return False
    known, _ = np.linalg.qr(np.array(equal).T)
    left = shape - known @ (known.conj().T @ shape)
    return bool(np.linalg.norm(left) < _NEW_SHAPE * np.linalg.norm(shape))


def speeds_in_turn(speeds: ArrayLike) -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they rise or fall throughout."""
    grid = require_finite("speeds", speeds)
    steps = np.diff(grid) if grid.ndim == 1 else np.zeros(1)
    if not grid.size or not (np.all(steps > 0.0) or np.all(steps < 0.0)):
        raise InputError(f"speeds must be a list of rising or of falling numbers, got {brief(speeds)}")
    return grid


# Whirl modes over speed, and critical speeds.


PEAK_SPEEDS = 21
"""Speeds across a resonance, two half-widths to each side."""

LEAST_DECREMENT = 1e-6
"""Logarithmic decrement below which a resonance counts as undamped."""


@dataclass(frozen=True, kw_only=True)
class Campbell(Whirls, Drawable):
    """Whirl modes over speed.

    Attributes
    ----------
    speeds : ndarray, shape (n_speeds,) [rad/s]
    eigenvalues : ndarray, shape (n_modes, n_speeds) [1/s]
        Eigenvalues by mode; nan where a mode does not oscillate, or is much faster than the requested modes.
    direction : ndarray, shape (n_modes, n_speeds) [1]
        Direction as in `RotorModes`; nan likewise.
    frequency : ndarray, shape (n_modes, n_speeds) [rad/s]
        Damped frequency, the imaginary part of the eigenvalues.
    log_decrement : ndarray, shape (n_modes, n_speeds) [1]
        Negative where the whirl grows.
    error : float [1]
        Largest `RotorModes.error` of all speeds.
    roundoff : ndarray, shape (n_modes, n_speeds) [1/s]
        Roundoff as in `RotorModes`; nan likewise.
    highest_frequency : float [rad/s]
        Modes that stay above this frequency are left out; inf if no mode is left out.
    work : dict of str to int
        Sum of `RotorModes.work` over all speeds.
    """

    speeds: Array
    eigenvalues: NDArray[np.complex128]
    direction: Array
    error: float = 0.0
    roundoff: Array | float = 0.0
    highest_frequency: float = math.inf
    work: dict[str, int] = field(default_factory=dict, compare=False)

    _tabled: ClassVar[tuple[str, ...]] = (
        "speeds",
        "eigenvalues",
        "direction",
        "roundoff",
        "frequency",
        "log_decrement",
    )

    @property
    def crossings(self) -> tuple[CriticalSpeed, ...]:
        """Critical speeds by interpolation between the speeds; `critical_speeds` finds all of them."""
        found: list[CriticalSpeed] = []
        for values, direction in zip(self.eigenvalues, self.direction, strict=True):
            known = np.isfinite(values)
            if np.count_nonzero(known) > 1:
                order = np.flatnonzero(known)[np.argsort(self.speeds[known])]
                rows = np.stack([values.imag, log_decrement(values), direction])[:, order]
                found += _crossed(self.speeds[order], *rows)
        return tuple(sorted(found, key=lambda one: one.speed))

    def to_table(self) -> ResultTable:
        """Return a row for each speed and mode; the columns are those of `RotorModes.to_table`."""
        modes, count = self.eigenvalues.shape
        known = np.isfinite(self.eigenvalues).T.ravel()
        columns = (
            Column("speed", "rad/s", np.repeat(self.speeds, modes)),
            Column("mode", "", np.tile(np.arange(1, modes + 1), count)),
            *whirl_columns(self.eigenvalues.T.ravel(), self.direction.T.ravel()),
        )
        return ResultTable(tuple(one._replace(values=one.values[known]) for one in columns), "Campbell")

    def _pages(self) -> Iterator[ResultTable]:
        """Yield frequencies and log decrements of the modes over speed, and the critical speeds."""
        speed = Column("speed", "rad/s", self.speeds)
        hertz, grows = self.frequency / (2.0 * np.pi), self.grows
        words = [
            [
                "" if np.isnan(value) else f"{value:.4g} {sense[:1].upper()}{'*' if unstable else ' '}"
                for value, sense, unstable in zip(*row, strict=True)
            ]
            for row in zip(hertz, senses(self.direction), grows, strict=True)
        ]
        title = "frequency [Hz] by mode; F forward, B backward, M mixed, * grows"
        yield ResultTable(
            (speed, *(Column(f"{k}", "", np.array(w)) for k, w in enumerate(words, start=1))), title
        )
        decrements = (Column(f"{k}", "", one) for k, one in enumerate(self.log_decrement, start=1))
        yield ResultTable((speed, *decrements), "log decrement by mode")
        if found := self.crossings:
            yield table_of(found, "critical speeds, interpolated")


def _crossed(speeds: Array, frequency: Array, decrement: Array, direction: Array) -> Iterator[CriticalSpeed]:
    """Yield where a frequency that is known at rising speeds crosses that of the rotation."""
    ways = PchipInterpolator(speeds, np.stack([frequency - np.abs(speeds), decrement, direction], axis=-1))
    roots = PchipInterpolator(speeds, frequency - np.abs(speeds)).roots(extrapolate=False)
    for speed in roots[np.isfinite(roots)]:
        _, there, sense = ways(speed)
        yield CriticalSpeed(speed=float(speed), log_decrement=float(there), direction=float(sense))


_BEYOND = 1.5
"""How far modes of a rotor of many elements are followed / the highest frequency."""


@dataclass(frozen=True, kw_only=True)
class CriticalSpeed(Readable):
    """A speed at which a whirl has the frequency of the rotation.

    Attributes
    ----------
    speed : float [rad/s]
        Critical speed, with the sign of the speeds searched.
    log_decrement : float [1]
        Log decrement of that whirl.
    direction : float [1]
        Direction as in `RotorModes`; an unbalance excites forward whirl.
    """

    speed: float
    log_decrement: float
    direction: float

    _shown: ClassVar[tuple[str, ...]] = ("whirl",)

    @property
    def whirl(self) -> str:
        """The whirl at this speed: forward, backward or mixed."""
        return str(senses(self.direction))


@one_blas_thread
@arguments
def campbell(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike, highest_frequency: float = math.inf
) -> Campbell:
    """Return the whirl modes of a rotor on its films over a range of speeds.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling speeds, of either sign. They must be close enough that modes can be followed from
        one speed to the next.
    highest_frequency : float [rad/s]
        Modes that stay above it are left out. If infinite, the limit is that of `rotor_modes`: a shaft of
        more than 19 elements has only its lower modes. `Campbell.highest_frequency` holds the limit that was
        used.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    grid = speeds_in_turn(speeds)
    require_range(highest_frequency)
    equilibria, furthest = EquilibriumSearch(bearings), _BEYOND * highest_frequency
    with modal_reduction.counted(*modal_reduction.COUNTS) as work:
        motions = (motions_at(rotor, equilibria, float(speed), furthest) for speed in grid)
        points = [whirls_of(one, furthest) for one in motions]
    tracks = tracked(points, rotor.assembly.mass)
    values = np.full((len(tracks), len(grid)), complex(math.nan, math.nan))
    direction, rounded = np.full((2, len(tracks), len(grid)), math.nan)
    for row, track in enumerate(tracks):
        for column, k in track.items():
            values[row, column] = points[column].eigenvalues[k]
            direction[row, column] = points[column].direction[k]
            rounded[row, column] = np.asarray(points[column].roundoff)[k]
    lowest = np.nanmin(np.abs(values.imag), axis=1) if len(tracks) else np.zeros(0)
    order = [k for k in np.argsort(lowest) if lowest[k] <= highest_frequency]
    return Campbell(
        speeds=grid,
        eigenvalues=values[order],
        direction=direction[order],
        error=max(point.error for point in points),
        roundoff=rounded[order],
        highest_frequency=min(highest_frequency, *(point.highest_frequency for point in points)),
        work=dict(work),
    )


@one_blas_thread
@arguments
def critical_speeds(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike
) -> modal_reduction.TupleWithOperations[CriticalSpeed]:
    """Return all damped critical speeds, rising: where a whirl has the frequency of the rotation.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling speeds, of either sign: they set the range and the first steps of the search.

    Returns
    -------
    TupleWithOperations
        A tuple of `CriticalSpeed` with the counters `work`.

    Raises
    ------
    InputError
        If the speeds break their rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds, or between them.
    ConvergenceError
        If the list cannot be proven complete in some intervals, for example where coefficients of a bearing
        jump and a whirl leaps far across the frequency of the rotation. Also if a search takes too many
        equilibria. The message names the likely cause. `partial` has those found in all of the range.

    Notes
    -----
    Within a step of speeds the state matrix is diag(s) plus small numbers, in the eigenvectors at the middle
    of the step. These numbers bound how far each eigenvector can change (by Brouwer's theorem; it is unique
    by that of Earle and Hamilton 1970). Gershgorin's circles bound all other eigenvalues. A step is proven if
    only the bounded eigenvalues can reach the line Im s = |speed|, and if their frequencies all grow more
    slowly than the speed, or all faster. Each of them then crosses the line at most once, and Newton's method
    finds whether it does. Other steps are halved, up to 14 times.

    The proof holds for the mode shapes that are kept, whose eigenvalues have an estimated error of at most
    1e-6. The critical speeds found are solved in all coordinates. For films it assumes that their K and C
    bend within a step at most twice as much as the parabola through both ends and the middle. For
    frequency-dependent films it holds for whirls with |Re s| up to three times the speed. Where K and C jump,
    for example where a tilting pad becomes loaded, the same is proven on a straight path between both sides
    of the jump. A whirl that crosses on this path, and that changes by at most 5 %, has a critical speed at
    the jump, which is known to 1/16384 of a step of `speeds`. Without damping, and with a symmetric
    stiffness that is the same at all speeds, the number of critical speeds is also checked in all
    coordinates, by Sylvester's law of inertia.
    """
    grid = speeds_in_turn(speeds)
    require_flexible(rotor)
    rotor = modal_reduction.whirling(rotor, bearings)
    with modal_reduction.counted(*modal_reduction.COUNTS) as work:
        try:
            found = crossings(rotor, bearings, grid)
        except ConvergenceError as failure:
            failure.partial = modal_reduction.TupleWithOperations(_listed(rotor, failure.partial or ()), work)
            raise
    return modal_reduction.TupleWithOperations(_listed(rotor, found), work)


def _listed(rotor: FlexibleRotor, found: Iterable[Crossing]) -> list[CriticalSpeed]:
    return [
        CriticalSpeed(
            speed=one.speed,
            log_decrement=float(log_decrement(one.value)),
            direction=float(directions(rotor.assembly, one.right[:, None], one.speed)[0]),
        )
        for one in found
    ]


@one_blas_thread
@arguments
def resonant_speeds(speeds: ArrayLike, critical: Sequence[CriticalSpeed]) -> Array:
    """Return the speeds with more points around each critical speed, so that resonance peaks are resolved.

    Parameters
    ----------
    speeds : array_like, shape (n,) [rad/s]
        Rising.
    critical : sequence of CriticalSpeed
        Critical speeds, as `critical_speeds` returns them. Those without damping are skipped, since their
        peak is infinite.

    Returns
    -------
    ndarray, shape (m,) [rad/s]
        Rising speeds within the range of `speeds`: the given ones, and 21 around each resonance, up to two
        half-widths to each side. The half-width of a peak is speed log_decrement / (2 pi).
    """
    grid, width = np.asarray(speeds, dtype=float), np.linspace(-2.0, 2.0, PEAK_SPEEDS)
    damped = [one for one in critical if abs(one.log_decrement) > LEAST_DECREMENT]
    near = [one.speed * (1.0 + width * abs(one.log_decrement) / (2.0 * np.pi)) for one in damped]
    every = np.unique(np.concatenate([grid, *near]))
    return every[(every >= grid[0]) & (every <= grid[-1])]


# Which whirl at one speed is which at another.


def matches(before: RotorModes, after: RotorModes, mass: Any) -> dict[int, int]:
    """Return the mode of `before` that each mode of `after` continues, by eigenvalue and shape."""
    if not (before.eigenvalues.size and after.eigenvalues.size):
        return {}
    product = np.abs(before.shapes.conj().T @ (mass @ after.shapes)) ** 2
    sizes = [np.sum(m.shapes.conj() * (mass @ m.shapes), axis=0).real for m in (before, after)]
    likeness = product / np.outer(*sizes)
    scale = np.abs(before.eigenvalues)[:, None] + np.abs(after.eigenvalues)
    apart = np.abs(before.eigenvalues[:, None] - after.eigenvalues) / scale
    cost = apart + 0.2 * (1.0 - likeness)
    rows, columns = linear_sum_assignment(cost)
    return {int(c): int(r) for r, c in zip(rows, columns, strict=True) if apart[r, c] < 0.5}


def tracked(points: list[RotorModes], mass: Any) -> list[dict[int, int]]:
    """Return, for each mode, its index among the modes of each speed at which it was found."""
    tracks: list[dict[int, int]] = [{0: k} for k in range(len(points[0].eigenvalues))]
    current = list(range(len(tracks)))
    for column in range(1, len(points)):
        before, after = points[column - 1], points[column]
        partner = matches(before, after, mass)
        following = []
        for k in range(len(after.eigenvalues)):
            if k in partner:
                following.append(current[partner[k]])
            else:
                tracks.append({})
                following.append(len(tracks) - 1)
            tracks[following[-1]][column] = k
        current = following
    return tracks
