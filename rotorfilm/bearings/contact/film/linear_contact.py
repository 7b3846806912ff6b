"""The equations of a point contact linearized at a state, and products with them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ....model import Array
from .film_equations import ContactEquations, Derivatives


class Closure(NamedTuple):
    """The scalar equation beside the film's: approach * delta + load * (integral of p) = value."""

    approach: float
    load: float
    value: float


class Place(NamedTuple):
    """Where equations are linearized: enough to make the factors of a preconditioner again.

    Attributes
    ----------
    pressure : ndarray, shape (n,)
    film : ndarray, shape (samples,)
    wet : ndarray of bool, shape (n,)
    closure : Closure
    rate : float
    """

    pressure: Array
    film: Array
    wet: np.ndarray
    closure: Closure
    rate: float


class LinearContact(NamedTuple):
    """The linearized equations on the cells with film; the others keep their pressure.

    Attributes
    ----------
    equations : ContactEquations
    place : Place
    derivatives : Derivatives
    by_delta : ndarray, shape (n,)
        Derivatives by the approach, 0 on cells without film.
    """

    equations: ContactEquations
    place: Place
    derivatives: Derivatives
    by_delta: Array

    def product(self, x: Array) -> Array:
        """Return the product with changes of the pressures and, last, of the approach."""
        wet, closure = self.place.wet, self.place.closure
        pressure = np.where(wet, x[:-1], 0.0)
        by_pressure, by_film = self.derivatives
        bent = self.equations.sampling.deflection(pressure)
        film = by_pressure @ pressure + by_film @ bent + self.by_delta * x[-1]
        load = closure.approach * x[-1] + closure.load * self.equations.load(pressure)
        return np.append(np.where(wet, film, x[:-1]), load)

    def solved(self, right: Array) -> Array:
        """Return the answer to a right side by a dense matrix, for graded cells."""
        wet, closure = np.flatnonzero(self.place.wet), self.place.closure
        by_pressure, by_film = self.derivatives
        bent: Any = self.equations.sampling.deflection
        matrix = np.zeros((len(wet) + 1, len(wet) + 1))
        matrix[:-1, :-1] = by_pressure[wet][:, wet].toarray() + by_film[wet] @ bent.matrix[:, wet]
        matrix[:-1, -1], matrix[-1, -1] = self.by_delta[wet], closure.approach
        matrix[-1, :-1] = closure.load * self.equations.area[wet]
        found = np.linalg.solve(matrix, np.append(right[wet], right[-1]))
        answer = right.copy()
        answer[wet], answer[-1] = found[:-1], found[-1]
        return answer


def linearized(equations: ContactEquations, place: Place) -> LinearContact:
    """Return the equations linearized at a place."""
    derivatives = equations.derivatives(place.pressure, place.film, place.rate)
    by_delta = derivatives.by_film @ np.ones(derivatives.by_film.shape[1])
    return LinearContact(equations, place, derivatives, np.where(place.wet, by_delta, 0.0))
