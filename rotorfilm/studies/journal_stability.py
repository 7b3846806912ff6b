"""Whirl threshold of a rigid rotor by every journal film, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from ..analysis import critical_mass, damping_has_rank_one, speed_parameter
from ..bearings.journal import JournalBearing, ReynoldsFilm, fitted_bearing, tension
from ..core.errors import InputError, require_finite
from ..core.model import Array
from ..core.progress import Report, silent
from ..core.results import Coefficients, coefficients_of_slopes
from .journal_accuracy import (
    LARGE,
    SPEED,
    TENSION,
    chosen_rungs,
    comparison_bearing,
    random_states,
    require_cells,
)
from .study import States, StudyModel, StudyResult, StudyRow

THRESHOLD_CELLS = (384, 16)
"""Finer grid of the reference; each derivative is a mean of eight solutions on it."""

ECCENTRICITY_RATIOS = tuple(np.linspace(0.05, 0.95, 46).tolist())
"""Where thresholds are computed."""

TENSION_STATES = 400
"""Random states of large motion in which tension is looked for."""

TOLERANCE = 0.05
"""Relative deviation from which a threshold counts as wrong."""

ASYMMETRY = 0.01
"""|C_xy - C_yx| / max |C| from which damping counts as unsymmetric; exact for films with a potential: 0."""

HIGHEST = 5.0
"""Speed parameter up to which a threshold is judged: further up it rises so steeply that a shift of the
eccentricity ratio by 0.001 changes it by several per cent."""

RATIO, PARAMETER, REFERENCE = "eccentricity ratio [1]", "speed sqrt(c m/W) [1]", "reference [1]"
DEVIATION, WRONG = "deviation [1]", f"deviation above {TOLERANCE:g} [-]"
MISSING, INVENTED = "none where the reference has one [-]", "one where the reference has none [-]"
RANK_ONE, UNSYMMETRIC = "damping of rank one [-]", "|Cxy - Cyx|/max|C| [1]"
AT_REST, MOVING = "tension/largest pressure at rest [1]", "states of large motion in tension [1]"
LENGTH, OWN_ERROR = "length/diameter [1]", "error of the reference [1]"
"""Headings of the table."""


def journal_stability(
    slenderness: float,
    *,
    eccentricity_ratio: Sequence[float] = ECCENTRICITY_RATIOS,
    rungs: Sequence[StudyModel] | None = None,
    cells: tuple[int, int] = THRESHOLD_CELLS,
    report: Report = silent,
) -> StudyResult:
    """Return the whirl threshold of a rigid rotor by every rung and by the two-dimensional reference.

    A row for each rung and eccentricity ratio has speed * sqrt(clearance * mass / load) at the onset of
    whirl, None where there is none, and its faults. Faults are a threshold up to `HIGHEST` with an error
    above `TOLERANCE`, one that is missing or invented, damping of rank one or unsymmetric, and tension in the
    film.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter, 0.1 to 4.
    eccentricity_ratio : sequence of float [1]
        Each above 0 and below 1.
    rungs : sequence of StudyModel, optional
        `journal_rungs()` by default.
    cells : tuple of int
        Cells of the finest grid of the reference, multiples of 16 and at least (64, 16).
    report : callable
        Told how far the job is.

    Raises
    ------
    InputError
        If an argument is out of range, or there are no rungs.

    Notes
    -----
    The reference is `AveragedFilm`. Its distance from the same on a grid with half the cells estimates its
    error. It is not divided, since the edge of the ruptured zone jumps and the derivatives are of first
    order.
    """
    rungs = chosen_rungs(rungs)
    ratios = _required_ratios(eccentricity_ratio)
    require_cells(cells)
    bearing = comparison_bearing(slenderness)
    report(0.0, "two-dimensional reference")
    around, along = cells
    exact, rough = (
        _curve(fitted_bearing(bearing, AveragedFilm(film=ReynoldsFilm(cells=grid))), ratios)[0]
        for grid in (cells, (around // 2, along // 2))
    )
    sample = random_states(LARGE, count=TENSION_STATES, clearance=bearing.clearance)
    found: list[StudyRow] = []
    for number, rung in enumerate(rungs):
        report((number + 1) / (len(rungs) + 1), f"whirl threshold by {rung.name}")
        found += _points(rung, bearing, ratios, exact, sample)
    return StudyResult(
        study="stability",
        reference=f"2-D film, {around} x {along} cells, averaged over {PLACES} positions within a cell",
        conditions={LENGTH: slenderness, OWN_ERROR: _largest_gap(rough, exact)},
        rungs=tuple(found),
    )


Parameters = tuple[float | None, ...]
"""Speed parameters at the onset of whirl, one for each ratio; None where there is none."""


def _required_ratios(eccentricity_ratio: Sequence[float]) -> Array:
    ratios = require_finite("eccentricity_ratio", eccentricity_ratio)
    if ratios.ndim != 1 or ratios.size == 0 or np.any((ratios <= 0.0) | (ratios >= 1.0)):
        raise InputError(f"eccentricity_ratio must hold numbers within (0, 1), got {eccentricity_ratio!r}")
    return ratios


def _static_states(bearing: JournalBearing, ratios: Array) -> States:
    position = bearing.clearance * np.stack([ratios, np.zeros_like(ratios)])
    return States(position, np.zeros_like(position), np.full(len(ratios), SPEED))


def _curve(bearing: JournalBearing, ratios: Array) -> tuple[Parameters, tuple[str, ...], list[Coefficients]]:
    """Return thresholds, why there is none, and the coefficients behind them, one entry for each ratio."""
    states = _static_states(bearing, ratios)
    force, slopes = bearing.force(*states), bearing.jacobian(*states)
    matrices = [
        coefficients_of_slopes(slopes[:, :, k], states.position[:, k], SPEED) for k in range(len(ratios))
    ]
    borders = [critical_mass(at) for at in matrices]
    parameters = tuple(
        None
        if border.mass is None
        else speed_parameter(speed=SPEED, clearance=bearing.clearance, mass=border.mass, load=load)
        for border, load in zip(borders, force.T, strict=True)
    )
    return parameters, tuple(border.reason for border in borders), matrices


def _points(
    rung: StudyModel, bearing: JournalBearing, ratios: Array, exact: Parameters, sample: States
) -> Iterator[StudyRow]:
    """Yield what a rung says at each eccentricity ratio."""
    own = fitted_bearing(bearing, rung.law)
    still, moving = (
        tension(rung.law, *own.kinematics(*states), own.slenderness)
        for states in (_static_states(own, ratios), sample)
    )
    share = float(np.mean(moving > TENSION))
    rows = zip(ratios.tolist(), *_curve(own, ratios), exact, still.tolist(), strict=True)
    for ratio, parameter, reason, at, right, pulled in rows:
        judged, gap = is_judged(right), _deviation(parameter, right)
        C = at.damping
        values = {
            "family [-]": rung.family,
            "label [-]": rung.label,
            RATIO: ratio,
            PARAMETER: parameter,
            REFERENCE: right,
            DEVIATION: gap,
            WRONG: int(judged and gap is not None and abs(gap) > TOLERANCE),
            MISSING: int(judged and parameter is None),
            INVENTED: int(right is None and is_judged(parameter)),
            RANK_ONE: int(damping_has_rank_one(at)),
            UNSYMMETRIC: float(abs(C[0, 1] - C[1, 0]) / np.max(np.abs(C))),
            AT_REST: pulled,
            MOVING: share,
            "why none [-]": reason,
        }
        yield StudyRow(name=rung.name, family=rung.family, label=rung.label, case="", values=values)


def is_judged(parameter: float | None) -> bool:
    """Return whether a threshold is one, and not above `HIGHEST`."""
    return parameter is not None and parameter <= HIGHEST


def _deviation(value: float | None, exact: float | None) -> float | None:
    return None if value is None or exact is None else value / exact - 1.0


def _largest_gap(rough: Parameters, exact: Parameters) -> float:
    gaps = (_deviation(value, x) for value, x in zip(rough, exact, strict=True) if is_judged(x))
    return max((abs(gap) for gap in gaps if gap is not None), default=0.0)


def by_film(result: StudyResult) -> dict[str, list[StudyRow]]:
    """Return the rows of each film."""
    return {name: list(rows) for name, rows in groupby(result.rungs, key=lambda rung: rung.name)}


# The two-dimensional film without the jitter of its grid: the reference for derivatives.


PLACES = 8
"""Positions of the journal within a cell."""


@dataclass(frozen=True, kw_only=True)
class AveragedFilm:
    """A plain `ReynoldsFilm` whose Jacobian is averaged over positions of the journal within a cell.

    The edge of the ruptured zone jumps from node to node, so the Jacobian, which depends on it, has an error
    of first order. Its sign changes as the journal turns by a cell. The force is of second order and is
    extrapolated; the Jacobian is that of the film, not of the extrapolation.

    Parameters
    ----------
    film : ReynoldsFilm
    """

    film: ReynoldsFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the extrapolated force on the journal, shape (2, ...); see `FilmLaw.force`."""
        return self.film.extrapolated(eccentricity, source, slenderness)[0]

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`."""
        turned = []
        for R in cell_turns(self.film.cells[0]):
            here = self.film.jacobian(_turned(R, eccentricity), _turned(R, source), slenderness)
            turned.append(np.einsum("ji,jk...,kl->il...", R, here, np.kron(np.eye(2), R)))
        return np.mean(turned, axis=0)


def cell_turns(around: int, places: int = PLACES) -> list[Array]:
    """Return the rotations (2, 2) that move the journal across one of so many cells in equal steps."""
    angles = 2.0 * np.pi / around * np.arange(places) / places
    return [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in angles]


def _turned(rotation: Array, vectors: Array) -> Array:
    return np.tensordot(rotation, vectors, axes=1)
