"""Making a reduced law of any point contact: computed, or interpolated between operating points on disk."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...errors import InputError, ValidityWarning, require_positive
from ...inputs.kinds import arguments
from ...model import Array, Linearization
from .between_points import point_between
from .contact_law import ContactLaw, transfer
from .operating_points import FREQUENCIES, LOADS, ContactPoint, kept_points, operating_point, under_load
from .point_contact import ALTERNATING, PointContact
from .rational_fit import fit_transfer
from .static_law import fit_static_law

if TYPE_CHECKING:
    from .rolling_ball import RollingBall

SLOWEST = 0.3
"""Frequency below which a misfit of the damping counts less."""


@arguments
def reduce_contact(contact: PointContact, order: int = 5, load: float = 1.0) -> ContactLaw:
    """Return the dimensionless law of a contact: z = delta, force in Hertzian loads, time in its unit.

    Takes seven stationary solutions under loads about `load` and dense linear solutions at 33 frequencies:
    some seconds on 40 x 40 cells, a minute on 64 x 64. They are kept on disk (in $ROTORFILM_CACHE, or the
    platform's folder for caches) and found again.

    Parameters
    ----------
    contact : PointContact
    order : int
        States of the dynamic part.
    load : float [1]
        f, about which the law is made: its dynamic stiffness is that under `load`, and its loads reach from
        0.2 to 3 times as much. The rectangle is then the grid's in the Hertzian radii of that load.

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
    """Return the law of a contact from operating points on disk of the same grid, scheme and lubricant.

    For the arguments see `reduce_contact`, which puts points on disk. The errors of the law include those
    of the interpolation, measured by leaving out points.

    Raises
    ------
    InputError
        If the contact does not lie among at least four operating points in V and Q0.
    """
    require_positive("load", load)
    equations = under_load(contact.equations, load)
    between = point_between(kept_points(equations), equations.V, equations.Q0)
    law = _law(between.point, equations.ellipse.load, order)
    return _scaled(
        replace(
            law,
            static_error=law.static_error + between.load_error,
            damping_error=law.damping_error + between.damping_error,
        ),
        load,
    )


@arguments
def reduce_ball(ball: RollingBall, contact: PointContact, order: int = 5, load: float = 1.0) -> ContactLaw:
    """Return the law of a rolling ball in SI, from its contact (`ball.contact(...)`).

    `load` is relative to that of the ball; for it and the others see `reduce_contact`.
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
        In SI.
    shares : ndarray, shape (n,)
        Sum 1.
    order : int
        Of the result.
    """
    unit = max(law.time_scale for law in laws)
    value = np.zeros(len(FREQUENCIES), dtype=complex)
    for law, share in zip(laws, shares, strict=True):
        s = 1j * FREQUENCIES * law.time_scale / unit
        per = law.force_scale / law.film_scale
        value -= share**2 * per * transfer(Linearization(law.A, law.B, law.C, law.D), s)
    scale = float(np.max(abs(value)))
    fit = fit_transfer(FREQUENCIES, value / scale, order, 1.0 / np.maximum(FREQUENCIES, SLOWEST)).system
    missed = (transfer(fit, 1j * FREQUENCIES) - value / scale).imag / FREQUENCIES
    error = float(np.max(abs(missed)) / np.max(abs(value.imag / scale / FREQUENCIES)))
    return Linearization(fit.A / unit, fit.B / unit, fit.C * scale, fit.D * scale), error


def _law(point: ContactPoint, unit: float, order: int) -> ContactLaw:
    """Return the law of a point in its own units, `unit` being the integral of the dry pressure."""
    static = fit_static_law(point.delta, np.array(LOADS))
    change = -(point.stiffness[1:] - point.stiffness[0].real) / unit
    fit = fit_transfer(FREQUENCIES, change, order, 1.0 / np.maximum(FREQUENCIES, SLOWEST))
    law = ContactLaw(
        offset=static.offset,
        span=static.span,
        exponent=static.exponent,
        operating=float(point.delta[LOADS.index(1.0)]),
        **fit.system._asdict(),
        static_error=static.error,
        damping_error=_damping_error(fit.system, change),
    )
    _require_damping(law)
    if point.checkerboard > ALTERNATING:
        warnings.warn(
            f"pressure must not alternate from cell to cell by more than {ALTERNATING:.1%}, got "
            f"{point.checkerboard:.1%} at V = {point.V:.4g}, Q0 = {point.Q0:.4g}: use UpwindScheme() or "
            "more cells",
            ValidityWarning,
            stacklevel=4,
        )
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
