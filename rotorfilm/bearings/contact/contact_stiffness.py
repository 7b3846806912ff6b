"""The dynamic stiffness of a point contact over frequency, relative to that of the dry contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_kind
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Readable
from .film.small_motion import SmallMotion
from .operating_points import SLOW
from .point_contact import PointContact


@dataclass(frozen=True, kw_only=True)
class ContactStiffness(Readable):
    """Stiffness and damping of small harmonic motions about a contact at rest, over the dry stiffness.

    Attributes
    ----------
    frequency : ndarray, shape (n,) [1]
        Angular frequencies, in the inverse of the unit of time.
    stiffness : ndarray, shape (n,) [1]
        Re Z/k_H, Z = -d(force)/d(approach), k_H the same of the dry contact.
    damping : ndarray, shape (n,) [1]
        Im Z/(frequency k_H), in the unit of time.
    central_film : float [1]
        Film thickness at the center at rest.
    """

    frequency: Array
    stiffness: Array
    damping: Array
    central_film: float


@arguments
def dynamic_stiffness(contact: PointContact, frequency: ArrayLike) -> ContactStiffness:
    """Return stiffness and damping of a contact under the unit load over the frequency.

    One dense linear solution each: .05 s on 40 x 40 cells, a second on 64 x 64.

    Parameters
    ----------
    contact : PointContact
    frequency : array_like, shape (n,) [1]
        Angular frequencies, in the inverse of the contact's unit of time; 0 is the limit of slow motion.

    Raises
    ------
    InputError
        If a frequency is negative or not finite.
    ConvergenceError
        If the contact at rest is not found.

    Examples
    --------
    >>> grid = ContactGrid(cells=(24, 24), half_width=1.5)
    >>> contact = PointContact(V=0.1, Q0=5.0, ellipticity=4.0, grid=grid)
    >>> dynamic_stiffness(contact, [0.0, 2.0]).damping.round(3).tolist()
    [0.043, 0.014]
    """
    require_kind("contact", contact, PointContact, "a PointContact")
    rate = np.atleast_1d(require_finite("frequency", frequency))
    if rate.ndim != 1 or rate.min() < 0.0:
        raise InputError(f"frequency must be a list of numbers, none negative, got {frequency!r}")
    state = contact.stationary()
    small = SmallMotion(contact.equations, state.levels[0].pressure, state.delta)
    omega = np.maximum(rate, SLOW)
    answer = np.array([small.stiffness(1j * w) for w in omega]) / contact.equations.ellipse.slope
    return ContactStiffness(
        frequency=rate,
        stiffness=answer.real.copy(),
        damping=answer.imag / omega,
        central_film=state.central_film,
    )
