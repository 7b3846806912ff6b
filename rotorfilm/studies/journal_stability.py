"""Whirl threshold of a rigid rotor by every journal film, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..analysis import critical_mass, damping_has_rank_one, speed_parameter
from ..bearings.journal import JournalBearing, ReynoldsFilm, fitted_bearing, tension
from ..core.errors import InputError, require_finite
from ..core.model import Array
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..core.results import Coefficients
from .journal_accuracy import (
    LARGE,
    SPEED,
    TENSION,
    chosen_rungs,
    comparison_bearing,
    random_states,
    require_cells,
)
from .study import States, StudyModel, table

THRESHOLD_CELLS = (384, 16)
"""Finer grid of the reference; each derivative is a mean of eight solutions on it."""

ECCENTRICITY_RATIOS = tuple(np.linspace(0.05, 0.95, 46).tolist())
"""Where thresholds are computed."""

TENSION_STATES = 400
"""Random states of large motion in which tension is looked for."""


def journal_stability(
    slenderness: float,
    *,
    eccentricity_ratio: Sequence[float] = ECCENTRICITY_RATIOS,
    rungs: Sequence[StudyModel] | None = None,
    cells: tuple[int, int] = THRESHOLD_CELLS,
    report: Report = silent,
) -> JournalStability:
    """Return the whirl threshold of a rigid rotor by every rung and by the two-dimensional reference.

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
    error; undivided, since the derivatives err by first order as the edge of the ruptured zone jumps.
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
    judged = []
    for number, rung in enumerate(rungs):
        report((number + 1) / (len(rungs) + 1), f"whirl threshold by {rung.name}")
        judged.append(_judged(rung, bearing, ratios, exact, sample))
    return JournalStability(
        slenderness=slenderness,
        eccentricity_ratio=tuple(ratios.tolist()),
        speed_parameter=exact,
        reference=f"2-D film, {around} x {along} cells, averaged over {PLACES} positions within a cell",
        reference_error=_largest_gap(rough, exact),
        rungs=tuple(judged),
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
        Coefficients(
            stiffness=-slopes[:, :2, k],
            damping=-slopes[:, 2:4, k],
            position=states.position[:, k],
            speed=SPEED,
        )
        for k in range(len(ratios))
    ]
    borders = [critical_mass(at) for at in matrices]
    parameters = tuple(
        None
        if border.mass is None
        else speed_parameter(speed=SPEED, clearance=bearing.clearance, mass=border.mass, load=load)
        for border, load in zip(borders, force.T, strict=True)
    )
    return parameters, tuple(border.reason for border in borders), matrices


def _judged(
    rung: StudyModel,
    bearing: JournalBearing,
    ratios: Array,
    exact: Parameters,
    sample: States,
) -> RungStability:
    own = fitted_bearing(bearing, rung.law)
    parameters, reasons, matrices = _curve(own, ratios)
    at_rest = tension(rung.law, *own.kinematics(*_static_states(own, ratios)), own.slenderness)
    moving = tension(rung.law, *own.kinematics(*sample), own.slenderness)
    return RungStability(
        name=rung.name,
        family=rung.family,
        label=rung.label,
        speed_parameter=parameters,
        deviation=_deviation(parameters, exact),
        reasons=reasons,
        rank_one=tuple(damping_has_rank_one(at) for at in matrices),
        asymmetry=tuple(_asymmetry(at.damping) for at in matrices),
        static_tension=tuple(at_rest.tolist()),
        tension_share=float(np.mean(moving > TENSION)),
    )


def _asymmetry(damping: Array) -> float:
    return float(abs(damping[0, 1] - damping[1, 0]) / np.max(np.abs(damping)))


def _largest_gap(rough: Parameters, exact: Parameters) -> float:
    pairs = zip(_deviation(rough, exact), exact, strict=True)
    gaps = [abs(gap) for gap, x in pairs if gap is not None and x is not None and x <= HIGHEST]
    return max(gaps, default=0.0)


def _deviation(values: Parameters, exact: Parameters) -> Parameters:
    pairs = zip(values, exact, strict=True)
    return tuple(None if v is None or x is None else v / x - 1.0 for v, x in pairs)


# Whirl thresholds by the rungs of the ladder, and which of them are wrong.


TOLERANCE = 0.05
"""Relative deviation from which a threshold counts as wrong."""

ASYMMETRY = 0.01
"""|C_xy - C_yx| / max |C| from which damping counts as unsymmetric; exact for films with a potential: 0."""

HIGHEST = 5.0
"""Speed parameter up to which a threshold is judged: further up it rises so steeply that a shift of the
eccentricity ratio by 0.001 changes it by several per cent."""


@dataclass(frozen=True, kw_only=True)
class RungStability(Readable):
    """Whirl threshold by one rung, over the eccentricity ratios of a `JournalStability`.

    Attributes
    ----------
    name, family, label : str
        Of the film; see `StudyModel`.
    speed_parameter : tuple of n floats or None [1]
        speed * sqrt(clearance * mass / load) at the onset of whirl; None where there is none.
    deviation : tuple of n floats or None [1]
        Of the speed parameter from the reference, relative; None where one of the two has none.
    reasons : tuple of n str
        Why there is no threshold; empty where there is one.
    rank_one : tuple of n bool
        Whether det C = 0, so that stability does not depend on the mass.
    asymmetry : tuple of n floats [1]
        |C_xy - C_yx| / max |C|.
    static_tension : tuple of n floats [1]
        Largest tension of the film at rest / its largest pressure.
    tension_share : float [1]
        Share of random states of large motion in which the film carries more tension than `TENSION`.
    """

    name: str
    family: str
    label: str
    speed_parameter: tuple[float | None, ...]
    deviation: tuple[float | None, ...]
    reasons: tuple[str, ...]
    rank_one: tuple[bool, ...]
    asymmetry: tuple[float, ...]
    static_tension: tuple[float, ...]
    tension_share: float

    @property
    def in_tension(self) -> bool:
        """Whether the film carries tension at rest or in large motion."""
        return self.tension_share > 0.0 or max(self.static_tension) > TENSION

    @property
    def unsymmetric(self) -> bool:
        """Whether the damping matrix is unsymmetric by more than `ASYMMETRY` somewhere."""
        return max(self.asymmetry) > ASYMMETRY

    @property
    def has_threshold(self) -> bool:
        """Whether it predicts whirl anywhere."""
        return any(value is not None for value in self.speed_parameter)


@dataclass(frozen=True, kw_only=True)
class JournalStability(Readable):
    """Whirl threshold over the eccentricity ratio, by every rung.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    eccentricity_ratio : tuple of n floats [1]
    speed_parameter : tuple of n floats or None [1]
        Of the reference.
    reference : str
        What it is.
    reference_error : float [1]
        Estimate of its largest relative error, where it is judged.
    tolerance, asymmetry_tolerance, tension_tolerance : float [1]
        From which a threshold, a damping matrix and a film are marked.
    highest : float [1]
        Speed parameter of the reference up to which thresholds are judged.
    rungs : tuple of RungStability
    """

    slenderness: float
    eccentricity_ratio: tuple[float, ...]
    speed_parameter: tuple[float | None, ...]
    reference: str
    reference_error: float
    tolerance: float = TOLERANCE
    asymmetry_tolerance: float = ASYMMETRY
    tension_tolerance: float = TENSION
    highest: float = HIGHEST
    rungs: tuple[RungStability, ...]

    @property
    def judged(self) -> tuple[bool, ...]:
        """Where the reference has a threshold not above `highest`."""
        return tuple(value is not None and value <= self.highest for value in self.speed_parameter)

    def wrong(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where a judged threshold is off by more than the tolerance."""
        pairs = zip(self.judged, rung.deviation, strict=True)
        return tuple(judged and gap is not None and abs(gap) > self.tolerance for judged, gap in pairs)

    def missing(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where the reference has a judged threshold and the rung has none."""
        pairs = zip(self.judged, rung.speed_parameter, strict=True)
        return tuple(judged and value is None for judged, value in pairs)

    def invented(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where the rung has a threshold not above `highest` and the reference has none at all."""
        pairs = zip(self.speed_parameter, rung.speed_parameter, strict=True)
        return tuple(exact is None and value is not None and value <= self.highest for exact, value in pairs)

    def largest_deviation(self, rung: RungStability) -> float | None:
        """Return the largest |deviation| of a judged threshold [1]; None where the rung has none."""
        pairs = zip(self.judged, rung.deviation, strict=True)
        return max((abs(gap) for judged, gap in pairs if judged and gap is not None), default=None)

    def columns(self) -> dict[str, list[object]]:
        """Return one row for each rung and eccentricity ratio, headings with units."""
        return table([row for rung in self.rungs for row in self._rows(rung)])

    def _rows(self, rung: RungStability) -> list[dict[str, object]]:
        wrong, missing, invented = self.wrong(rung), self.missing(rung), self.invented(rung)
        return [
            {
                "family [-]": rung.family,
                "label [-]": rung.label,
                "eccentricity ratio [1]": ratio,
                "speed sqrt(c m/W) [1]": rung.speed_parameter[k],
                "reference [1]": self.speed_parameter[k],
                "deviation [1]": rung.deviation[k],
                f"deviation above {self.tolerance:g} [-]": int(wrong[k]),
                "none where the reference has one [-]": int(missing[k]),
                "one where the reference has none [-]": int(invented[k]),
                "damping of rank one [-]": int(rung.rank_one[k]),
                "|Cxy - Cyx|/max|C| [1]": rung.asymmetry[k],
                "tension/largest pressure at rest [1]": rung.static_tension[k],
                "states of large motion in tension [1]": rung.tension_share,
                "why none [-]": rung.reasons[k],
                "length/diameter [1]": self.slenderness,
                "error of the reference [1]": self.reference_error,
            }
            for k, ratio in enumerate(self.eccentricity_ratio)
        ]


# The two-dimensional film without the jitter of its grid: the reference for derivatives.


PLACES = 8
"""Positions of the journal within a cell."""


@dataclass(frozen=True, kw_only=True)
class AveragedFilm:
    """A plain `ReynoldsFilm` whose Jacobian is averaged over positions of the journal within a cell.

    The edge of the ruptured zone jumps from node to node, so that the Jacobian, which holds it,
    errs by first order, with a sign that changes as the journal turns by a cell. The force errs by second
    order and is extrapolated; the Jacobian is that of the film, not of the extrapolation.

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
