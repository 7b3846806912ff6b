"""Making a reduced law of any point contact: computed, or interpolated between operating points on disk."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import ConvexHull, QhullError

from ...core.errors import InputError, ValidityWarning, require_positive
from ...core.inputs import arguments
from ...core.model import Array, Linearization
from .contact_law import (
    FREQUENCIES,
    LOADS,
    ContactLaw,
    ContactPoint,
    fit_static_law,
    kept_points,
    operating_point,
    transfer,
    under_load,
)
from .point_contact import PointContact, warn_of_alternating

if TYPE_CHECKING:
    from .point_contact import RollingBall

SLOWEST = 0.3
"""Frequency below which a misfit of the damping counts less."""


@arguments
def reduce_contact(contact: PointContact, order: int = 5, load: float = 1.0) -> ContactLaw:
    """Return the dimensionless law of a contact: z = delta, force in Hertzian loads, time in its unit.

    This takes seven stationary solutions under loads about `load`, and dense linear solutions at 33
    frequencies: some seconds on 40 x 40 cells, a minute on 64 x 64. The result is kept on disk (in
    $ROTORFILM_CACHE, or in the platform's cache folder) and reused.

    Parameters
    ----------
    contact : PointContact
    order : int
        States of the dynamic part.
    load : float [1]
        Load f about which the law is fitted. Its dynamic stiffness is that under this load, and it holds for
        loads from 0.2 to 3 times as large. The rectangle of the grid is in Hertzian radii of this load.

    Warns
    -----
    ValidityWarning
        If the fitted damping is negative at some frequency, or the pressure alternates from cell to cell.
    """
    require_positive("load", load)
    equations = under_load(contact.equations, load)
    return _scaled(_law(operating_point(equations), equations.ellipse.load, order), load)


@arguments
def interpolate_contact(contact: PointContact, order: int = 5, load: float = 1.0) -> ContactLaw:
    """Return the law of a contact by interpolation between operating points on disk.

    The points must have the same grid, scheme and lubricant; `reduce_contact` writes them and explains the
    arguments. The errors of the law include that of the interpolation, which is measured by leaving out
    points.

    Raises
    ------
    InputError
        If the contact does not lie among at least four operating points in V and Q0.
    """
    require_positive("load", load)
    equations = under_load(contact.equations, load)
    point, load_error, damping_error = point_between(kept_points(equations), equations.V, equations.Q0)
    law = _law(point, equations.ellipse.load, order)
    static, damping = law.static_error + load_error, law.damping_error + damping_error
    return _scaled(replace(law, static_error=static, damping_error=damping), load)


@arguments
def reduce_ball(ball: RollingBall, contact: PointContact, order: int = 5, load: float = 1.0) -> ContactLaw:
    """Return the reduced law of a rolling ball in SI units, from its contact (`ball.contact(...)`).

    The argument `load` is relative to the load of the ball; `reduce_contact` explains all arguments.
    """
    return in_si(ball, contact, reduce_contact(contact, order, load))


def in_si(ball: RollingBall, contact: PointContact, law: ContactLaw) -> ContactLaw:
    """Return a dimensionless law of the contact of a ball in the units of the ball."""
    if (contact.V, contact.Q0) != (ball.V, ball.Q0):
        raise InputError(
            f"contact must be of the ball, with V = {ball.V!r} and Q0 = {ball.Q0!r}, got {contact!r}"
        )
    return replace(
        law,
        film_scale=law.film_scale * ball.film_scale,
        time_scale=law.time_scale * ball.time_scale,
        force_scale=law.force_scale * ball.load,
    )


def in_series(laws: list[ContactLaw], shares: Array, order: int) -> tuple[Linearization, float]:
    """Return force over approach of contacts in series beside the static one, and the error of its damping.

    To first order in what films add to the stiffness k: Z = k + sum of share^2 (Z_c - Z_c(0)), where a
    contact has the `share` k/k_c of the approach.

    Parameters
    ----------
    laws : list of ContactLaw
        Laws in SI.
    shares : ndarray, shape (n,)
        Sum 1.
    order : int
        Order of the result.
    """
    unit = max(law.time_scale for law in laws)
    value = np.zeros(len(FREQUENCIES), dtype=complex)
    for law, share in zip(laws, shares, strict=True):
        s = 1j * FREQUENCIES * law.time_scale / unit
        per = law.force_scale / law.film_scale
        value -= share**2 * per * transfer(Linearization(law.A, law.B, law.C, law.D), s)
    scale = float(np.max(abs(value)))
    fit = fit_transfer(FREQUENCIES, value / scale, order, 1.0 / np.maximum(FREQUENCIES, SLOWEST))[0]
    missed = (transfer(fit, 1j * FREQUENCIES) - value / scale).imag / FREQUENCIES
    error = float(np.max(abs(missed)) / np.max(abs(value.imag / scale / FREQUENCIES)))
    return Linearization(fit.A / unit, fit.B / unit, fit.C * scale, fit.D * scale), error


def _law(point: ContactPoint, unit: float, order: int) -> ContactLaw:
    """Return the law of a point in its own units, `unit` being the integral of the dry pressure."""
    offset, span, exponent, error = fit_static_law(point.delta, np.array(LOADS))
    change = -(point.stiffness[1:] - point.stiffness[0].real) / unit
    system, _ = fit_transfer(FREQUENCIES, change, order, 1.0 / np.maximum(FREQUENCIES, SLOWEST))
    law = ContactLaw(
        offset=offset,
        span=span,
        exponent=exponent,
        operating=float(point.delta[LOADS.index(1.0)]),
        **system._asdict(),
        static_error=error,
        damping_error=_damping_error(system, change),
    )
    _require_damping(law)
    warn_of_alternating(point.checkerboard, point.V, point.Q0, stacklevel=5)
    return law


def _scaled(law: ContactLaw, load: float) -> ContactLaw:
    """Return a law made in the Hertzian units of `load` in those of the unit load."""
    growth = load ** (1.0 / 3.0)
    return replace(law, film_scale=growth**2, time_scale=growth, force_scale=float(load))


def _damping_error(system: Linearization, change: np.ndarray) -> float:
    damping = -change.imag / FREQUENCIES
    fitted = -transfer(system, 1j * FREQUENCIES).imag / FREQUENCIES
    return float(np.max(abs(fitted - damping)) / np.max(abs(damping)))


def _require_damping(law: ContactLaw) -> None:
    frequency = np.geomspace(1e-2, 1e3, 400)
    damping = -transfer(Linearization(law.A, law.B, law.C, law.D), 1j * frequency).imag / frequency
    if damping.min() < -1e-3 * damping.max():
        warnings.warn(
            "the law must damp at every frequency, got negative damping at "
            f"{frequency[damping.argmin()]:.3g}: take another order",
            ValidityWarning,
            stacklevel=5,
        )


# An operating point of a contact between those on disk, with the error of the interpolation.


FEWEST = 4
"""Points that an interpolation takes at least: three span a plane, and one must be left out."""

CURVED = 8
"""Points from which on the interpolation reproduces quadratic functions, not only linear ones."""

ASKED = 4
"""Nearest points that are left out, one after the other, to measure the error."""

MARGIN = 2.0
"""Stated error / the largest of those measured: the end of the film moves cell by cell, which adds noise."""


def point_between(points: Sequence[ContactPoint], V: float, Q0: float) -> tuple[ContactPoint, float, float]:
    """Return the point at (V, Q0) from points around it, smooth in ln V and ln Q0, and two errors.

    They are that of the load at an approach, relative to the load, and that of Im Z/omega, to the largest.

    Approaches, films and stiffnesses are interpolated by cubic radial functions. The error is twice the
    largest made when one of the nearest points is left out and interpolated from the others.

    Raises
    ------
    InputError
        If (V, Q0) is not among the points, or there are too few.
    """
    places = np.log([(point.V, point.Q0) for point in points]).reshape(-1, 2)
    target = np.log((V, Q0))
    if len(points) < FEWEST or not _inside(places, target):
        raise InputError(
            f"V and Q0 must lie among at least {FEWEST} operating points on disk, got {V:.6g} and {Q0:.6g} "
            f"with {len(points)} of this grid and lubricant: compute the point itself, or more around it"
        )
    values = np.array([_flat(point) for point in points])
    nearest = np.argsort(np.linalg.norm(places - target, axis=1))[:ASKED]
    errors = []
    for k in nearest:
        others = np.arange(len(places)) != k
        errors.append(_error(points[k], _smooth(places[others], values[others], places[k])))
    load_error, damping_error = MARGIN * np.max(errors, axis=0)
    found = _unflat(_smooth(places, values, target), V, Q0, max(point.checkerboard for point in points))
    return found, float(load_error), float(damping_error)


def _smooth(places: Array, values: Array, target: Array) -> Array:
    degree = 2 if len(places) >= CURVED else 1
    try:
        smooth = RBFInterpolator(places, values, kernel="cubic", degree=degree)
    except np.linalg.LinAlgError:
        # On a line there is no second direction; that the target lies on it has been checked.
        smooth = RBFInterpolator(places, values, kernel="linear", degree=0)
    return np.asarray(smooth(target[None])[0], dtype=float)


def _inside(places: Array, target: Array) -> bool:
    try:
        hull = ConvexHull(places)
    except (QhullError, ValueError):
        return False
    return bool(np.all(hull.equations[:, :2] @ target + hull.equations[:, 2] <= 1e-9))


def _flat(point: ContactPoint) -> Array:
    # Re Z changes with the film as a whole, Im Z by orders of magnitude over the frequency.
    damping = point.stiffness[1:].imag / FREQUENCIES
    return np.concatenate([point.delta, np.log(point.central_film), point.stiffness.real, damping])


def _unflat(values: Array, V: float, Q0: float, checkerboard: float) -> ContactPoint:
    delta, film, real, damping = np.split(values, np.cumsum([len(LOADS), len(LOADS), len(FREQUENCIES) + 1]))
    stiffness = real + 1j * np.append(0.0, damping * FREQUENCIES)
    return ContactPoint(float(V), float(Q0), delta, np.exp(film), stiffness, checkerboard)


def _error(point: ContactPoint, values: Array) -> tuple[float, float]:
    guess = _unflat(values, point.V, point.Q0, 0.0)
    slope = np.gradient(np.log(LOADS), point.delta)
    load = float(np.max(abs(slope * (guess.delta - point.delta))))
    true, found = (p.stiffness[1:].imag / FREQUENCIES for p in (point, guess))
    return load, float(np.max(abs(found - true)) / np.max(abs(true)))


# Vector fitting: a stable state space of given order through samples of a transfer function.
#
# After Gustavsen and Semlyen (1999), for functions that vanish at s = 0: f(s) = s sum of r_k/(s - p_k). The
# poles are moved to the zeros of a fitted denominator, and those that land in the right half-plane are
# mirrored, so the result is stable by construction; its static gain is exactly zero.


ROUNDS = 40
"""Relocations of the poles."""


def fit_transfer(
    frequency: Array, value: np.ndarray, order: int, weight: Array
) -> tuple[Linearization, float]:
    """Return a fit of samples f(i omega), D = C A^-1 B, and its largest weighted deviation from them.

    Parameters
    ----------
    frequency : ndarray, shape (n,) [1]
        omega > 0, rising.
    value : ndarray of complex, shape (n,)
    order : int
        Number of states, at least 1.
    weight : ndarray, shape (n,)
        Weight by which deviations count.

    Raises
    ------
    InputError
        If there are fewer samples than the fit has unknowns.
    """
    if order < 1 or 2 * len(frequency) < 2 * order + 1:
        raise InputError(f"order must be from 1 to {len(frequency) - 1}, got {order!r}")
    s = 1j * frequency
    A, B = _start(frequency, order)
    fits = []
    for _ in range(ROUNDS):
        A, B = _canonical(_relocated(A, B, s, value, weight))
        fits.append(_fitted(A, B, s, value, weight))
    return min(fits, key=lambda fit: fit[1])


def _start(frequency: Array, order: int) -> tuple[Array, Array]:
    """Return weakly damped pole pairs spread over the frequencies, and one real pole if the order is odd."""
    pairs = np.geomspace(max(frequency[0], 1e-2 * frequency[-1]), frequency[-1], max(order // 2, 1))[
        : order // 2
    ]
    poles = [-0.3 * w + 1j * w for w in pairs]
    return _canonical(np.array([*poles, *np.conj(poles), *([-frequency[-1] / 3.0] * (order % 2))]))


def _canonical(poles: np.ndarray) -> tuple[Array, Array]:
    """Return the real matrices A and B of stable poles: a 2 x 2 block for each pair."""
    stable = -abs(poles.real) + 1j * poles.imag
    size = len(stable)
    A, B, k = np.zeros((size, size)), np.zeros(size), 0
    for pole in stable[stable.imag > 0.0]:
        A[k : k + 2, k : k + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
        B[k] = 2.0
        k += 2
    for pole in stable[stable.imag == 0.0]:
        A[k, k], B[k] = pole.real, 1.0
        k += 1
    return A, B


def _basis(A: Array, B: Array, s: np.ndarray) -> np.ndarray:
    """Return (s - A)^-1 B at each s, shape (n, order)."""
    return np.stack([np.linalg.solve(value * np.eye(len(A)) - A, B.astype(complex)) for value in s])


def _relocated(A: Array, B: Array, s: np.ndarray, value: np.ndarray, weight: Array) -> np.ndarray:
    """Return the zeros of the denominator 1 + c (s - A)^-1 B fitted together with the numerator."""
    basis = _basis(A, B, s)
    rows = np.hstack([s[:, None] * basis, -value[:, None] * basis])
    solution = _least_squares(rows, value, weight)
    return np.linalg.eigvals(A - np.outer(B, solution[len(A) :]))


def _fitted(
    A: Array, B: Array, s: np.ndarray, value: np.ndarray, weight: Array
) -> tuple[Linearization, float]:
    basis = s[:, None] * _basis(A, B, s)
    residues = _least_squares(basis, value, weight)
    error = float(np.max(weight * abs(basis @ residues - value)))
    # s (s - A)^-1 B = B + A (s - A)^-1 B
    return Linearization(A, B[:, None], (residues @ A)[None], np.array([[residues @ B]])), error


def _least_squares(rows: np.ndarray, value: np.ndarray, weight: Array) -> Array:
    """Return the real solution; columns are scaled to one size first."""
    weighted = weight[:, None] * rows
    real = np.vstack([weighted.real, weighted.imag])
    scale = np.maximum(np.linalg.norm(real, axis=0), 1e-300)
    wanted = np.concatenate([(weight * value).real, (weight * value).imag])
    return np.linalg.lstsq(real / scale, wanted, rcond=None)[0] / scale
