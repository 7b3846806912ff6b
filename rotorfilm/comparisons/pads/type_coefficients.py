"""Stiffness and damping of all types of bearings over the Sommerfeld number."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import ValidityWarning
from ...linear import coefficients, equilibrium
from ...model import Array
from ...progress import Report, silent
from ...readable.result import Readable
from .bearing_types import CLEARANCE, RADIUS, VISCOSITY, BearingType, chosen_types, positive_numbers

SPEED = 300.0
"""Of the journal [rad/s]; of isothermal films it cancels out."""

SOMMERFELD = tuple(np.geomspace(0.05, 5.0, 25).tolist())

CONVENTION = (
    "S = viscosity * speed/(2 pi) * length * diameter * (radius/c)^2 / load, K c/load, C c speed/load, "
    "c the assembled clearance of all types"
)


@dataclass(frozen=True, kw_only=True)
class TypeCoefficients(Readable):
    """Stiffness and damping of one type of bearing over n Sommerfeld numbers.

    Attributes
    ----------
    name : str
    stiffness_number : ndarray, shape (n, 2, 2) [1]
        K c/load, of tilting pads at the frequency of the shaft.
    damping_number : ndarray, shape (n, 2, 2) [1]
        C c speed/load, likewise.
    film_ratio : ndarray, shape (n,) [1]
        Least film / c.
    """

    name: str
    stiffness_number: Array
    damping_number: Array
    film_ratio: Array


@dataclass(frozen=True, kw_only=True)
class BearingCoefficients(Readable):
    """Stiffness and damping of all types of bearings over the Sommerfeld number.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    convention : str
        What S, K and C are made dimensionless with.
    sommerfeld : ndarray, shape (n,) [1]
        S, over the assembled clearance.
    types : tuple of TypeCoefficients
        Of each bearing.
    """

    slenderness: float
    convention: str
    sommerfeld: Array
    types: tuple[TypeCoefficients, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return a row for each type and Sommerfeld number, headings with units."""
        rows = [row for one in self.types for row in self._rows(one)]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}

    def _rows(self, one: TypeCoefficients) -> Iterator[dict[str, object]]:
        for k, S in enumerate(self.sommerfeld.tolist()):
            row: dict[str, object] = {"bearing [-]": one.name, "S over the assembled clearance [1]": S}
            for symbol, unit, matrix in (
                ("K", "c/W", one.stiffness_number[k]),
                ("C", "c speed/W", one.damping_number[k]),
            ):
                row |= {
                    f"{symbol}{a}{b} {unit} [1]": float(matrix[i, j])
                    for i, a in enumerate("xy")
                    for j, b in enumerate("xy")
                }
            row["least film/c [1]"] = float(one.film_ratio[k])
            yield row | {"length/diameter [1]": self.slenderness}


def bearing_coefficients(
    slenderness: float,
    *,
    sommerfeld: Sequence[float] = SOMMERFELD,
    types: Sequence[BearingType] | None = None,
    report: Report = silent,
) -> BearingCoefficients:
    """Return K and C of all types of bearings under a load along -y over the Sommerfeld number.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    sommerfeld : sequence of float [1]
        S over the assembled clearance.
    types : sequence of BearingType, optional
        Those of `bearing_types` by default.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    numbers = positive_numbers("sommerfeld", sommerfeld)
    chosen = chosen_types(slenderness, types)
    found = []
    for done, one in enumerate(chosen):
        report(done / len(chosen), one.name)
        found.append(_type_coefficients(one, slenderness, numbers))
    return BearingCoefficients(
        slenderness=slenderness, convention=CONVENTION, sommerfeld=numbers, types=tuple(found)
    )


def loads(slenderness: float, sommerfeld: Array) -> Array:
    """Return the loads [N] of Sommerfeld numbers at `SPEED`."""
    length = 2.0 * RADIUS * slenderness
    turns = SPEED / (2.0 * math.pi)
    unit = VISCOSITY * turns * length * 2.0 * RADIUS * (RADIUS / CLEARANCE) ** 2
    return np.asarray(unit / sommerfeld)


def _type_coefficients(one: BearingType, slenderness: float, sommerfeld: Array) -> TypeCoefficients:
    stiffness, damping, films = [], [], []
    # Unloaded pads have no film, which is an answer.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        for load in loads(slenderness, sommerfeld).tolist():
            at = equilibrium(one.bearing, (0.0, -load), SPEED)
            film = coefficients(one.bearing, at.position, SPEED)
            stiffness.append(film.stiffness * CLEARANCE / load)
            damping.append(film.damping * CLEARANCE * SPEED / load)
            films.append(at.minimum_film / CLEARANCE)
    return TypeCoefficients(
        name=one.name,
        stiffness_number=np.array(stiffness),
        damping_number=np.array(damping),
        film_ratio=np.array(films),
    )
