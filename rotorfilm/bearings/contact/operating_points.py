"""Operating points of a contact: what its reduced law is made of, computed once and kept on disk.

A contact under another load is one under the unit load with other V and Q0 and other Hertzian units, so an
operating point (V, Q0, load) is kept as the (V, Q0) that it has in its own units.
"""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...errors import FileWarning, InputError, warn_user
from ...model import Array
from ...sources import source_digest
from ..films.table_cache import cache_folder, cached, read_kept
from .film.checkerboard import checkerboard
from .film.contact_newton import Contact
from .film.film_equations import ContactEquations
from .film.pressure_fluid import BarusViscosity, DowsonHigginsonDensity, RoelandsViscosity
from .film.small_motion import SmallMotion
from .film.stationary import follow, stationary

LOADS = (0.2, 0.35, 0.6, 1.0, 1.5, 2.2, 3.0)
"""Loads f of the stationary contacts of a point."""

FREQUENCIES = np.geomspace(0.05, 6.0, 32)
"""Angular frequencies of its dynamic stiffness."""

SLOW = 1e-6
"""Frequency that stands for 0, where the linearized equations have their static stiffness."""

_FIELDS = ("V", "Q0", "delta", "central_film", "stiffness", "checkerboard")


class ContactPoint(NamedTuple):
    """Stationary contacts about an operating point, and the dynamic stiffness there.

    Attributes
    ----------
    V, Q0 : float [1]
    delta, central_film : ndarray, shape (7,) [1]
        Approach and central film thickness under the loads `LOADS`.
    stiffness : ndarray of complex, shape (33,) [1]
        Z = -d(integral of p)/d(delta) under the unit load, first at rest, then at `FREQUENCIES`.
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell under the unit load.
    """

    V: float
    Q0: float
    delta: Array
    central_film: Array
    stiffness: np.ndarray
    checkerboard: float


def under_load(equations: ContactEquations, load: float) -> ContactEquations:
    """Return the equations, on the same grid, in the Hertzian units of `load` times their unit load.

    Hertzian radius and pressure grow with the cube root of the load: V = 24 mu0 u R^2/(p_H a^3) falls with
    its power 4/3, Q0 and the pressure ratios of the lubricant grow with its cube root.
    """
    growth = load ** (1.0 / 3.0)
    viscosity, density = equations.viscosity, equations.density
    if isinstance(viscosity, RoelandsViscosity):
        viscosity = replace(viscosity, pressure_ratio=growth * viscosity.pressure_ratio)
    if isinstance(density, DowsonHigginsonDensity):
        density = replace(density, pressure_ratio=growth * density.pressure_ratio)
    return replace(
        equations, V=equations.V / growth**4, Q0=equations.Q0 * growth, viscosity=viscosity, density=density
    )


def operating_point(equations: ContactEquations) -> ContactPoint:
    """Return the point of some equations under the unit load; from disk if it was computed before.

    Seven stationary and 33 dense linear solutions: some seconds on 40 x 40 cells, a minute on 64 x 64.

    Raises
    ------
    ConvergenceError
        If a stationary contact is not found.

    Warns
    -----
    FileWarning
        If the point on disk is damaged, or cannot be written: it will be computed again next time.
    """
    return cached(
        _path(equations),
        from_bytes=_point,
        build=lambda: _computed(equations),
        to_bytes=_bytes,
        what="the operating point",
    )


def kept_points(equations: ContactEquations) -> list[ContactPoint]:
    """Return the points on disk that differ from some equations in V and Q0 at most, sorted by these.

    Warns
    -----
    FileWarning
        Of a damaged point, which is left out.
    """
    found = []
    for path in sorted(cache_folder().glob(f"contact-{_family(equations)}-*.npz")):
        try:
            found.append(_point(read_kept(path)))
        except (OSError, InputError) as error:
            warn_user(f"an operating point is left out: {error}", FileWarning)
    return sorted(found, key=lambda point: (point.V, point.Q0))


def _computed(equations: ContactEquations) -> ContactPoint:
    contacts = list(_stationary(equations))
    at = contacts[LOADS.index(1.0)]
    small = SmallMotion(equations, at.pressure, at.delta)
    return ContactPoint(
        float(equations.V),
        float(equations.Q0),
        np.array([contact.delta for contact in contacts]),
        np.array([equations.central_film(contact.pressure, contact.delta) for contact in contacts]),
        np.array([small.stiffness(1j * w) for w in (SLOW, *FREQUENCIES)]),
        checkerboard(at.pressure.reshape(equations.grid.shape), equations.grid, 1.0),
    )


def _stationary(equations: ContactEquations) -> Iterator[Contact]:
    contact = stationary(equations, LOADS[0])
    yield contact
    for load in LOADS[1:]:
        contact = follow(equations, contact, load)
        yield contact


def _path(equations: ContactEquations) -> Path:
    place = _digest(repr((f"{equations.V:.12g}", f"{equations.Q0:.12g}")))
    return cache_folder() / f"contact-{_family(equations)}-{place}.npz"


def _family(equations: ContactEquations) -> str:
    """Return a digest of all that decides a point but V and Q0.

    The pressure ratios of one lubricant go with its Q0: of Roelands' law and of the density what counts is
    their quotient.
    """
    fluid: list[Any] = [type(equations.viscosity).__name__]
    if not isinstance(equations.viscosity, BarusViscosity | RoelandsViscosity):
        fluid.append(repr(equations.viscosity))
    if isinstance(equations.viscosity, RoelandsViscosity):
        fluid += [
            f"{equations.viscosity.exponent:.9g}",
            f"{equations.viscosity.pressure_ratio / equations.Q0:.9g}",
        ]
    if equations.density is not None:
        fluid.append(f"{equations.density.pressure_ratio / equations.Q0:.9g}")
    return _digest(
        repr((source_digest(__name__), equations.grid, equations.scheme, equations.ellipse, fluid))
    )


def _digest(key: str) -> str:
    return hashlib.sha256(key.encode()).hexdigest()[:16]


def _bytes(point: ContactPoint) -> bytes:
    buffer = io.BytesIO()
    values: Any = {name: np.asarray(getattr(point, name)) for name in _FIELDS}
    np.savez(buffer, **values)
    return buffer.getvalue()


def _point(content: bytes) -> ContactPoint:
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        values = {name: file[name] for name in _FIELDS}
    scalars = {name: float(values[name]) for name in ("V", "Q0", "checkerboard")}
    return ContactPoint(**{**values, **scalars})
