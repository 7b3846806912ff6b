"""Quantities that a bearing with a film is asked for: each is a row of data."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..analysis import coefficients
from ..core.answers import relative_change
from ..core.results import Equilibrium
from ..scenes.film_rungs import FilmCandidate, grid_of, with_losses, with_pressures

AMPLITUDE, PHASE, FORCE = "unbalance_amplitude", "unbalance_phase", "unbalance_force"
ORBIT_UNITS = {AMPLITUDE: "m", PHASE: "rad", FORCE: "N"}
"""Quantities of an orbit that an unbalance makes, and their units."""

# Distances of a value from a better one, in the unit of the tolerance.


def relative(value: Any, better: Any, supply: float = 0.0) -> float:
    """Return the largest difference relative to the largest entry of the better value."""
    return relative_change(value, better)


def absolute(value: Any, better: Any, supply: float = 0.0) -> float:
    """Return the difference itself, as of an angle [rad]."""
    return float(abs(better - value))


def relative_rise(value: Any, better: Any, supply: float) -> float:
    """Return the difference of two temperatures relative to the rise of the better one above supply [K]."""
    return float(abs(better - value)) / (float(better) - supply)


# Verified bounds of a film's error in an equilibrium, for the quantities of one kind.


Bound = Callable[[FilmCandidate, Equilibrium], float]


def _of_position(length: Callable[[Equilibrium], float]) -> Bound:
    """Return the bound of a change of position, relative to a length [m]."""

    def bound(film: FilmCandidate, at: Equilibrium) -> float:
        force = film.rest_bound(at, slopes=False)
        if not math.isfinite(force):
            return force
        stiffness = coefficients(film.reaction, at.position, at.speed).stiffness
        moved = force * math.hypot(*at.load) * float(np.linalg.norm(np.linalg.inv(stiffness), 2))
        return moved / length(at)

    return bound


def _of_slopes(film: FilmCandidate, at: Equilibrium) -> float:
    return film.rest_bound(at, slopes=True)


def _of_losses(film: FilmCandidate, at: Equilibrium) -> float:
    return film.loss_bound(at.eccentricity_ratio)


def _of_heat(film: FilmCandidate, at: Equilibrium) -> float:
    return 2.0 * film.loss_bound(at.eccentricity_ratio)  # that of power / flow


def _of_none(film: FilmCandidate, at: Equilibrium) -> float:
    return math.inf


def _none(rich: Any) -> float:
    return 0.0


def _pressure_error(rich: Any) -> float:
    """Return the error of the largest pressure on a grid: it falls with the fourth power of its short cells.

    1.3e-4 is the median of random journals with 16 cells along half the length, and 2e-4 nearly the most.
    """
    grid = grid_of(rich.film) if hasattr(rich, "film") else None
    return 12.0 / grid.cells[1] ** 4 if grid is not None else 0.0


class FilmQuantity(NamedTuple):
    """One quantity of a journal at rest.

    Attributes
    ----------
    unit : str
    value : callable
        Takes a `JournalEquilibrium` and returns the quantity in SI.
    bound : callable
        Takes a film and an equilibrium and returns the verified bound of the error, which may be infinite.
    distance : callable
        Takes a value, a better one and the supply temperature [K], and returns the error of the first.
    position : bool
        Whether it follows from the position of the journal alone.
    slopes : bool
        Whether it is a derivative of the force.
    scaled : bool
        Whether grids change it by about the same share, coarse ones or fine.
    films : callable or None
        Takes films and the quantity, and returns those that know it; None where all do.
    judge_error : callable
        Takes the richer bearing that judges another one, and returns its own error.
    """

    unit: str
    value: Callable[[Any], Any]
    bound: Bound
    distance: Callable[[Any, Any, float], float] = relative
    position: bool = False
    slopes: bool = False
    scaled: bool = False
    films: Callable[[Sequence[FilmCandidate], str], Sequence[FilmCandidate]] | None = None
    judge_error: Callable[[Any], float] = _none


_way = _of_position(lambda at: float(np.hypot(*at.position)))
_gap = _of_position(lambda at: at.minimum_film)

QUANTITIES = {
    "eccentricity_ratio": FilmQuantity("1", lambda r: r.eccentricity_ratio, _way, position=True, scaled=True),
    "minimum_film": FilmQuantity("m", lambda r: r.minimum_film, _gap, position=True, scaled=True),
    "attitude_angle": FilmQuantity("rad", lambda r: r.attitude_angle, _way, absolute, position=True),
    "stiffness": FilmQuantity("N/m", lambda r: r.coefficients.stiffness, _of_slopes, slopes=True),
    "damping": FilmQuantity("N s/m", lambda r: r.coefficients.damping, _of_slopes, slopes=True),
    "power_loss": FilmQuantity(
        "W", lambda r: float(r.losses.power_loss), _of_losses, scaled=True, films=with_losses
    ),
    "side_flow": FilmQuantity(
        "m^3/s", lambda r: float(r.losses.side_flow), _of_losses, scaled=True, films=with_losses
    ),
    "maximum_pressure": FilmQuantity(
        "Pa",
        lambda r: r.maximum_pressure,
        _of_none,
        scaled=True,
        films=with_pressures,
        judge_error=_pressure_error,
    ),
    "temperature": FilmQuantity("K", lambda r: r.temperature, _of_heat, relative_rise),
    "maximum_temperature": FilmQuantity("K", lambda r: r.maximum_temperature, _of_heat, relative_rise),
}
"""Quantities of a journal at rest, by their names."""

TEMPERATURES = ("temperature", "maximum_temperature")
"""Those of an oil whose heat balances."""
