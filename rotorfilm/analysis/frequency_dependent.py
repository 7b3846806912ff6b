"""Motions of a rotor on frequency-dependent films, and how many of them grow."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from ..core.dynamic_stiffness import DynamicStiffness, InertialStiffness, states_rest, stiffnesses
from ..core.errors import ConvergenceError
from ..core.model import Array
from ..core.port import Complex, freedoms_of
from ..core.results import Coefficients, FrequencyDependentCoefficients, InertialCoefficients
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure
from . import rotor_matrices
from .coefficients import GROWTH_ROUNDOFF
from .modal_reduction import all_rows, models, usual_frequency
from .rotor_equilibrium import EquilibriumSearch, RotorEquilibrium

REACH = 20.0
"""Frequency / speed up to which exponents are told apart in the phase; few faster ones feel the oil."""

MOVED = 1e-2
"""Relative distance of a fast exponent that does from all with K and C of one frequency."""

CHECKED, TOLD = 16, 1e-8
"""One receptance in so many is solved directly, and the relative error up to which modes tell the others."""

_REAL = 1e-8


def frequency_dependent_motions(
    structure: Structure, at: RotorEquilibrium, frequency: float, values: np.ndarray, shapes: np.ndarray
) -> list[tuple[complex, np.ndarray, np.ndarray] | None]:
    """Return the motions on frequency-dependent films next to those on others (m,), (m, N); None for none.

    That is s [1/s] and its vectors, shape (N,): L(s) right = 0, left* L(s) = 0. A motion that decays faster
    than it turns may have no other next to it: the film's own exponents are many there.
    """
    if not len(values):
        return []
    found = rotor_matrices.whirls_near(structure, at, frequency, values, shapes)
    return [_upper(complex(s), *ends) if ended else None for s, *ends, ended in zip(*found, strict=True)]


def _upper(s: complex, right: np.ndarray, left: np.ndarray) -> tuple[complex, np.ndarray, np.ndarray]:
    """Return the motion of a pair that turns forward in time, or one whose exponent is real."""
    if abs(s.imag) <= _REAL * abs(s):
        return complex(s.real, 0.0), right, left
    return (s.conjugate(), right.conj(), left.conj()) if s.imag < 0.0 else (s, right, left)


def rotor_growing(structure: Structure, at: RotorEquilibrium, values: np.ndarray) -> int:
    """Return how many exponents of a rotor on frequency-dependent films grow, both of a pair.

    The determinant of all equations is that with K and C of one frequency, whose exponents are known, times
    det(1 + R (K(s) - K - s C)) with the receptance R of the journals on those films.

    Parameters
    ----------
    structure : Structure
        Structure without hysteresis.
    at : RotorEquilibrium
    values : ndarray [1/s]
        Exponents next to which the phase turns fast.
    """
    films = {name: _without_mass(film) for name, film in rotor_matrices.frequency_dependent_films(at).items()}
    still = {name: one for name, (one, _) in films.items()}
    near = replace(at, coefficients={**at.coefficients, **still})
    system, rows = rotor_matrices.second_order(structure, near), all_rows(structure, still)
    reference, vectors = np.linalg.eig(system.state_matrix())
    receptance = _receptance(system, rows, reference, vectors)

    def ratio(nu: Array) -> Complex:
        # Beside the axis, on which motion that nothing damps has its exponents.
        s = 1j * nu + GROWTH_ROUNDOFF * (nu + abs(at.speed))
        each, receptances = s[:, None, None], receptance(s)
        change = np.zeros((len(s), len(rows), len(rows)), dtype=complex)
        first = 0
        for film, motion in films.values():
            own = slice(first, first + len(film.stiffness))
            change[:, own, own] = stiffnesses(motion, s) - film.stiffness - each * film.damping
            first = own.stop
        return np.asarray(np.linalg.det(np.eye(len(rows)) + receptances @ change))

    own = [_poles(motion) for _, motion in films.values()]
    frequencies = _frequencies(reference, np.concatenate([values, *own]), abs(at.speed))
    held = rotor_matrices.holding(
        rotor_matrices.FullRotorModel(structure, near, 0.0), reference, vectors[: len(system.mass)]
    )
    bound = np.maximum(
        rotor_matrices.growth_roundoff(reference, held, at.speed),
        GROWTH_ROUNDOFF * (np.abs(reference) + abs(at.speed)),
    )
    known = int(np.sum(reference.real > bound)) + sum(map(_growing, own))
    return growing_count(ratio, frequencies, known)


def _receptance(
    system: rotor_matrices.SecondOrder, rows: Array, values: np.ndarray, vectors: np.ndarray
) -> Callable[[np.ndarray], Complex]:
    """Return displacements at rows (k, N) by unit forces there, (m, k, k), as a function of exponents (m,).

    They are sums over the eigenvectors (2 N, 2 N) where these tell them: some are solved directly besides.
    """
    mass, damping, stiffness = (np.asarray(part) for part in system)

    def direct(s: np.ndarray) -> Complex:
        each = s[:, None, None]
        return np.asarray(rows @ np.linalg.solve(stiffness + each**2 * mass + each * damping, rows.T))

    pushed = np.vstack([np.zeros(rows.T.shape), np.linalg.solve(mass, rows.T)])
    seen = rows @ vectors[: len(mass)]

    def by_modes(s: np.ndarray) -> Complex:
        found = (seen / (s[:, None, None] - values)) @ shares
        some = np.arange(0, len(s), CHECKED)
        exact = direct(s[some])
        sizes = np.abs(exact).max(axis=(1, 2))
        told = np.abs(found[some] - exact).max(axis=(1, 2)) <= TOLD * sizes
        return np.asarray(found) if told.all() else direct(s)

    try:
        shares = np.linalg.solve(vectors, pushed)
    except np.linalg.LinAlgError:  # as of free motion, whose two eigenvectors are one
        return direct
    return by_modes


def _poles(motion: DynamicStiffness) -> np.ndarray:
    """Return the exponents of the states of a bearing by themselves, if it tells them [1/s]."""
    at = getattr(motion, "at", None)
    return np.zeros(0) if at is None else np.linalg.eigvals(at.A)


def _growing(poles: np.ndarray) -> int:
    """Return how many states of a bearing grow by themselves: the phase counts them as missing."""
    return int(np.sum(poles.real > GROWTH_ROUNDOFF * np.abs(poles).max(initial=0.0)))


def _without_mass(film: FrequencyDependentCoefficients) -> tuple[Coefficients, DynamicStiffness]:
    """Return K and C of one frequency, and K(s), with an added mass on its own: it would grow with s^2."""
    motion = film.dynamic_stiffness
    if not isinstance(motion, InertialStiffness):
        return film, motion
    heavy = InertialCoefficients(
        stiffness=film.stiffness + film.frequency**2 * motion.mass,
        damping=film.damping,
        position=film.position,
        speed=film.speed,
        freedoms=freedoms_of(film),
        mass=motion.mass,
    )
    return heavy, motion.motion


def require_all_growing(
    rotor: FlexibleRotor, equilibria: EquilibriumSearch, speed: float, values: np.ndarray, growing: int
) -> None:
    """Raise ConvergenceError unless as many exponents of a rotor grow as were found.

    Rotors without frequency-dependent films are not asked, nor those with hysteresis, which has no K(s).
    """
    if not any(map(states_rest, equilibria.bearings.values())):
        return
    structure = next(models(rotor, usual_frequency(rotor, speed))).structure
    if structure.hysteresis is not None:
        return
    at = equilibria.at(structure, speed)
    if not rotor_matrices.frequency_dependent_films(at):
        return
    count = rotor_growing(structure, at, values)
    if count != growing:
        raise ConvergenceError(f"only {growing} of {count} growing motions were found at {speed:.6g} rad/s")


def _frequencies(reference: np.ndarray, found: np.ndarray, speed: float) -> Array:
    """Return frequencies from 0 on that tell apart what exponents and waves of oil do to the phase."""
    values, upper = np.concatenate([reference, found]), reference[reference.imag >= 0.0]
    slow = values[np.abs(values) <= REACH * speed]
    near = np.concatenate([slow, _moved(found, upper), _moved(upper, found)])
    width = np.abs(near.real) + GROWTH_ROUNDOFF * (np.abs(near.imag) + speed)
    beside = np.concatenate([near.imag + k * width for k in (-2.0, -0.5, 0.0, 0.5, 2.0)])
    top = 4.0 * max(float(np.abs(values).max()), speed)
    waves = speed * np.arange(1, 25) / 8.0
    return np.unique([0.0, *beside[beside > 0.0], *waves, *np.geomspace(0.01 * speed, top, 40)])


def _moved(values: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return which of some exponents have none of others near them."""
    if not len(others):
        return values
    distance = np.abs(values[:, None] - others).min(axis=1, initial=np.inf)
    return np.asarray(values[distance > MOVED * np.abs(values)])


# The exponents of a rigid rotor on a frequency-dependent film: roots of det(K(s) + s^2 mass).


STARTS = (0.5, 0.3, 1.0)
"""Frequencies / speed whose stiffness and damping give the first exponents."""

NEUTRAL = 1e-6
"""Growth rate / frequency of a whirl that begins or ceases to grow."""

CONVERGED = 1e-13
_STEPS = 20
_SAME = 1e-8
_TOP = 4.0
_DECADES = 4.0


def counted_exponents(
    film: FrequencyDependentCoefficients, mass: float
) -> tuple[NDArray[np.complex128], int]:
    """Return exponents of a rigid mass [kg] on a film, by Newton's method from the least damped one on.

    Returns
    -------
    values : ndarray, shape (n,) [1/s]
        Values by falling real part, those with imaginary part >= 0: all that grow, or one that is damped,
        which need not be the least damped, where `growing` is 0.
    growing : int
        How many grow, both of a pair, by the phase of the determinant.

    Raises
    ------
    ConvergenceError
        If not all of those that grow are found.
    """
    found: list[complex] = []
    growing: int | None = None
    for start in _starts(film, mass):
        value = _refined(film.dynamic_stiffness, mass, start)
        if value is None or any(abs(value - one) <= _SAME * abs(one) for one in found):
            continue
        found = sorted([*found, value], key=lambda one: -one.real)
        known = sum(2 if one.imag else 1 for one in found if one.real > 0.0)
        if abs(found[0].real) <= NEUTRAL * abs(found[0]):  # on the border itself nothing is counted
            return np.array(found), known
        growing = rigid_growing(film, mass) if growing is None else growing
        if known == growing:
            return np.array(found), growing
    raise ConvergenceError(
        f"only {len(found)} of {growing} growing motions of a mass of {mass:.6g} kg on the film were found: "
        f"{found}"
    )


def whirl_exponent(film: FrequencyDependentCoefficients, mass: float) -> complex:
    """Return the exponent that Newton's method finds from the least damped one with K, C of half the speed.

    Raises
    ------
    ConvergenceError
        If it finds none.
    """
    value = _refined(film.dynamic_stiffness, mass, next(_starts(film, mass)))
    if value is None:
        raise ConvergenceError(
            f"Newton's method must find the whirl of {mass:.6g} kg at {film.speed:.6g} rad/s"
        )
    return value


def _starts(film: FrequencyDependentCoefficients, mass: float) -> Iterator[complex]:
    """Yield exponents with the stiffness and damping of a few frequencies, the least damped first."""
    for share in STARTS:
        nu = share * abs(film.speed)
        K = film.dynamic_stiffness.stiffness(1j * nu)
        near = _pencil(K.real, K.imag / nu, mass)
        yield from sorted(near[near.imag >= 0.0].tolist(), key=lambda one: -one.real)


def rigid_growing(film: FrequencyDependentCoefficients, mass: float) -> int:
    """Return how many exponents of a rigid mass [kg] on a film grow.

    det(K(i nu) - mass nu^2) is counted against (k + i c nu - mass nu^2)^2, critically damped.
    """
    speed, motion = abs(film.speed), film.dynamic_stiffness
    k = float(np.abs(film.stiffness).max())
    c = float(np.abs(film.damping).max())

    def ratio(nu: Array) -> Complex:
        D = stiffnesses(motion, 1j * nu) - np.multiply.outer(mass * nu**2, np.eye(2))
        return np.asarray(np.linalg.det(D) / (math.sqrt(k) + 1j * nu * math.sqrt(mass)) ** 4)

    own = math.sqrt(k / mass)
    top = _TOP * max(own, c / mass, speed)
    low = min(own, speed) * 10.0 ** (-0.5 * _DECADES)
    waves = np.arange(1, 25) * 0.125 * speed
    frequencies = np.unique([0.0, *np.geomspace(low, top, 24), *waves[waves < top]])
    return growing_count(ratio, frequencies, _growing(_poles(film.dynamic_stiffness)))


def _pencil(stiffness: np.ndarray, damping: np.ndarray, mass: float) -> NDArray[np.complex128]:
    """Return the roots of det(stiffness + s damping + s^2 mass), shape (4,)."""
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness / mass, -damping / mass]])
    return np.asarray(np.linalg.eigvals(matrix), dtype=complex)


def _refined(motion: DynamicStiffness, mass: float, s: complex) -> complex | None:
    """Return the exponent next to another, by successive linear problems; None if they lead nowhere."""
    for _ in range(_STEPS):
        K, slope = motion(s)
        near = _pencil(K - s * slope, slope, mass)
        before, s = s, complex(near[np.argmin(np.abs(near - s))])
        if not math.isfinite(abs(s)):
            return None
        if abs(s - before) <= CONVERGED * abs(s):
            return complex(s.real, abs(s.imag)) if abs(s.imag) > _SAME * abs(s) else complex(s.real, 0.0)
    return None


# How many exponents grow, by the phase of a determinant: what no search for them can miss.


STEP = 0.6
"""Largest turn of the phase from one frequency to the next [rad]."""

NEAR_ONE = 0.5
"""Distance of D/E from 1 at the last frequency."""

_HALVINGS, _DOUBLINGS, _MOST_POINTS = 40, 40, 100_000


def growing_count(ratio: Callable[[Array], Complex], frequencies: Array, reference: int = 0) -> int:
    """Return how many roots s of a determinant D(s) of real motions have a positive real part.

    Let E(s) have the same degree and a known number of such roots. While s goes from 0 to i infinity, D/E
    turns by pi for each root that E has more (the principle of the argument; roots off the real line come in
    pairs).

    Parameters
    ----------
    ratio : callable
        Ratio from frequencies nu (n,) [rad/s] to D(i nu)/E(i nu), real at 0, and 1 at infinity.
    frequencies : ndarray, shape (n,) [rad/s]
        Rising from 0, close enough that no whole turn falls between two of them; steps in which the phase
        turns far are halved. From the last they are doubled until D/E is near 1, so that the phase stays
        within a quarter of a turn beyond them.
    reference : int
        The number of such roots of E.

    Raises
    ------
    ConvergenceError
        If the phase jumps: a root on the imaginary axis itself; if D/E does not come near 1.
    """
    points, values = frequencies, ratio(frequencies)
    while abs(values[-1] - 1.0) > NEAR_ONE and len(points) < len(frequencies) + _DOUBLINGS:
        further = 2.0 * points[-1:]
        points, values = np.append(points, further), np.append(values, ratio(further))
    if not abs(values[-1] - 1.0) <= NEAR_ONE:
        raise ConvergenceError(
            "the inertia must outweigh the stiffness at high frequencies to count growing motions, but D/E "
            f"is {values[-1]:.3g} at {points[-1]:.3g} rad/s"
        )
    at = points[1:]
    for _ in range(_HALVINGS + 1):
        # By phases: a product of two small values may underflow.
        turns = np.angle(np.exp(1j * np.diff(np.angle(values))))
        far = np.flatnonzero(~(np.abs(turns) <= STEP) | (values[:-1] == 0.0))
        if not len(far):
            return reference - round((turns.sum() - np.angle(values[-1])) / math.pi)
        if len(points) > _MOST_POINTS:
            break
        halves = 0.5 * (points[far] + points[far + 1])
        at, values = points[far + 1], np.insert(values, far + 1, ratio(halves))
        points = np.insert(points, far + 1, halves)
    raise ConvergenceError(
        f"growing motions cannot be counted: the phase jumps at {at[0]:.8g} rad/s, where a motion neither "
        "grows nor decays"
    )


# The rigid masses at which a frequency-dependent film lets a whirl neither grow nor decay.


RATIOS = np.concatenate([np.geomspace(0.01, 0.1, 6, endpoint=False), np.linspace(0.1, 3.0, 59)])
"""Whirl ratios between which a border is looked for; oil crosses the cavity in half a turn or more."""


def mass_borders(film: FrequencyDependentCoefficients) -> list[tuple[float, float]]:
    """Return all masses with det(K(i nu) - mass nu^2) = 0, and the frequency nu of each, the lightest first.

    With K = A + i B the imaginary part gives k = mass nu^2 = (Axx Byy + Ayy Bxx - Axy Byx - Ayx Bxy) /
    (Bxx + Byy), the real part a function of nu alone, (Axx - k)(Ayy - k) - Axy Ayx - det B.
    """
    grid = RATIOS * abs(film.speed)
    values = [_residue(film, float(nu)) for nu in grid]
    found = []
    for low, high, one, other in zip(grid, grid[1:], values, values[1:], strict=False):
        if (one > 0.0) != (other > 0.0):
            nu = float(brentq(lambda nu: _residue(film, nu), low, high, xtol=1e-13 * high))
            mixed, trace = _stiffness(film.dynamic_stiffness.stiffness(1j * nu))
            if mixed * trace > 0.0:
                found.append((mixed / trace / nu**2, nu))
    return sorted(found)


def _stiffness(K: np.ndarray) -> tuple[float, float]:
    """Return numerator and denominator of k."""
    A, B = K.real, K.imag
    mixed = A[0, 0] * B[1, 1] + A[1, 1] * B[0, 0] - A[0, 1] * B[1, 0] - A[1, 0] * B[0, 1]
    return float(mixed), float(np.trace(B))


def _residue(film: FrequencyDependentCoefficients, nu: float) -> float:
    """Return the real part of the determinant where the imaginary part is 0, times trace(B)^2, scaled."""
    K = film.dynamic_stiffness.stiffness(1j * nu)
    K = K / np.abs(K).max()
    mixed, trace = _stiffness(K)
    off = K.real[0, 1] * K.real[1, 0] + float(np.linalg.det(K.imag))
    return float((trace * K.real[0, 0] - mixed) * (trace * K.real[1, 1] - mixed) - trace**2 * off)
