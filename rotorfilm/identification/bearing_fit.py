"""Parameters of a journal bearing from measurements, by least squares, with confidence intervals."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, ClassVar, NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2, norm, t as student

from ..analysis import equilibrium
from ..analysis.coefficients import film_coefficients
from ..bearings.journal import JournalBearing, heat_surplus
from ..core.errors import (
    ConvergenceError,
    InputError,
    ValidityWarning,
    require_kind,
    require_number,
    warn_user,
)
from ..core.frames import Column, ResultTable
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Readable, quantity
from ..core.results import Equilibrium
from .measurements import QUANTITIES, Measurements

# Parameters of a bearing that a fit may find: where they are, and how they are scaled.


KELVINS = 10.0
"""Unit of temperatures in a search [K]."""

TRANSFER = 100.0
"""Heat transfer of a housing, by the area of the bore, that is the unit of its conductance [W/(m^2 K)]."""

_BEARING = ("clearance", "length", "viscosity", "temperature")
_COOLING = ("supply_temperature", "ambient_temperature", "housing_conductance", "carry_over")
ZEROS = ("zero_x", "zero_y")
"""What the sensors show of a journal in the center of its bearing."""

NAMES = (*_BEARING, *_COOLING, *ZEROS)
_UNITS = dict(zip(NAMES, ("m", "m", "Pa s", "K", "K", "K", "W/K", "1", "m", "m"), strict=True))
_POSITIVE = ("clearance", "length", "viscosity")
_RANGE = {"housing_conductance": (0.0, math.inf), "carry_over": (0.0, 1.0)}


class Search(NamedTuple):
    """Free parameters of a bearing as numbers u of order 1, all 0 at the start, and what they are to predict.

    Lengths and the viscosity are start exp(u), so that they stay positive; the others start + unit u.
    """

    bearing: JournalBearing
    measured: Measurements
    names: tuple[str, ...]
    start: Array
    unit: Array
    positive: Array

    def values(self, u: Array) -> Array:
        """Return the parameters in SI units."""
        linear = self.start + self.unit * u
        return np.where(self.positive, self.start * np.exp(np.where(self.positive, u, 0.0)), linear)

    def slopes(self, u: Array) -> Array:
        """Return d values/du."""
        return np.where(self.positive, self.values(u), self.unit)

    def trial(self, u: Array) -> tuple[JournalBearing, Array]:
        """Return the bearing of these parameters, and what sensors show of a centered journal (2,) [m]."""
        found = dict(zip(self.names, self.values(u).tolist(), strict=True))
        bearing = self.bearing
        cooling = {name: found[name] for name in _COOLING if name in found}
        changed: dict[str, Any] = {name: found[name] for name in _BEARING if name in found}
        if cooling:
            assert bearing.cooling is not None
            changed["cooling"] = replace(bearing.cooling, **cooling)
        trial = replace(bearing, **changed) if changed else bearing
        return trial, np.array([found.get(name, 0.0) for name in ZEROS])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Ends of u."""
        ends = np.array([_RANGE.get(name, (-math.inf, math.inf)) for name in self.names])
        low, high = ((ends - self.start[:, None]) / self.unit[:, None]).T
        return low, high

    def predicted(self, u: Array) -> Array:
        """Return what trial parameters predict, shape (n, quantities)."""
        bearing, zero = self.trial(u)
        return np.array(
            [
                [_quantity(name, bearing, at, zero) for name in self.measured.names]
                for at in _rests(bearing, self.measured)
            ]
        )

    def residual(self, u: Array) -> Array:
        """Return (predicted - measured)/noise of the numbers that were measured."""
        return self._kept(self.predicted(u) - self.measured.table)

    def jacobian(self, u: Array) -> Array:
        """Return d residual/du."""
        columns = []
        for k, (name, slope) in enumerate(zip(self.names, self.slopes(u), strict=True)):
            exact = self._exact(u, name)
            columns.append(self._difference(u, k) if exact is None else self._kept(exact * slope))
        return np.stack(columns, axis=-1)

    def _exact(self, u: Array, name: str) -> Array | None:
        """Return d predicted/d(parameter); None where it needs differences."""
        names = self.measured.names
        table = np.zeros(self.measured.table.shape)
        if name in ZEROS:
            shown = "xy"[ZEROS.index(name)]
            return table + np.array([one == shown for one in names])
        if not set(names) <= {"x", "y", "temperature"}:
            return None
        (bearing, _), order = self.trial(u), ("x", "y", "temperature")
        for row, at in zip(table, _rests(bearing, self.measured), strict=True):
            slopes = rest_slopes(bearing, at, name)
            if slopes is None:
                return None
            row[:] = [slopes[order.index(one)] for one in names]
        return table

    def _difference(self, u: Array, k: int) -> Array:
        step = np.zeros(u.size)
        low, high = (ends[k] for ends in self.bounds)
        step[k] = STEP
        up, down = (step * (low < v < high) for v in (u[k] + STEP, u[k] - STEP))
        ends = self.residual(u + up), self.residual(u - down)
        return np.asarray((ends[0] - ends[1]) / float((up + down)[k]))

    def _kept(self, table: Array) -> Array:
        seen = np.isfinite(self.measured.table)
        return np.asarray((table / self.measured.scale)[seen])


def search_of(bearing: JournalBearing, measured: Measurements, names: Sequence[str]) -> Search:
    """Return the search for free parameters; raise InputError for one that the bearing does not have."""
    if not names or len(set(names)) < len(names):
        raise InputError(f"free must name different parameters, got {tuple(names)!r}")
    start = np.array([_value(bearing, name) for name in names])
    unit = np.array([_unit(bearing, name) for name in names])
    positive = np.array([name in _POSITIVE for name in names])
    return Search(bearing, measured, tuple(names), start, unit, positive)


def _value(bearing: JournalBearing, name: str) -> float:
    """Return a parameter of a bearing."""
    if name not in NAMES:
        raise InputError(f"free must be among {', '.join(NAMES)}, got {name!r}")
    if name in ZEROS:
        return 0.0
    if name == "ambient_temperature" and bearing.cooling is not None:
        return bearing.cooling.ambient
    value = getattr(bearing if name in _BEARING else bearing.cooling, name, None)
    if value is None:
        raise InputError(f"free must be parameters that the bearing has, and it has no {name}, got {name!r}")
    return float(value)


def _unit(bearing: JournalBearing, name: str) -> float:
    """Return the size of a parameter whose u is linear."""
    if name.endswith("temperature"):
        return KELVINS
    if name == "housing_conductance":
        return TRANSFER * 2.0 * math.pi * bearing.radius * bearing.length
    return bearing.clearance if name in ZEROS else 1.0


# Parameters of a journal bearing from measurements, by least squares, with confidence intervals.


STEP = 6e-6
"""Step of central differences, in the units of the search."""

APART = 1e-5
"""Smallest singular value of the scaled Jacobian, in the largest, of parameters that can be told apart."""

TAKES_PART = 0.1
"""Part of a parameter in a direction that the measurements do not see, from which it is named."""

TOLERANCE = 1e-12

CHANCE = 0.999
"""Share of fits whose misfit is as stated, beyond which one is doubted."""


@dataclass(frozen=True, kw_only=True)
class FittedParameter(Readable):
    """A fitted parameter with its uncertainty, in its SI unit.

    Attributes
    ----------
    value : float
        Value of the best fit to the measurements.
    standard_error : float
        Standard deviation of the value.
    low, high : float
        Ends of its confidence interval.
    """

    value: float
    standard_error: float
    low: float
    high: float


@dataclass(frozen=True, kw_only=True, eq=False)
class BearingFit(Readable):
    """A bearing fitted to measurements.

    Attributes
    ----------
    parameters : dict of str to FittedParameter
        Result for each free parameter, by its name.
    confidence : float [1]
        Confidence of each interval by itself.
    correlation : ndarray, shape (m, m) [1]
        Correlation of the errors of the parameters, in their order.
    misfit : float [1]
        Root mean square of the residuals, relative to the noise of each quantity, or to its size if no noise
        was given.
    highest_misfit : float [1]
        Misfit that the stated noise stays below in 999 of 1000 fits; infinite if no noise was given.
    residuals : dict of str to ndarray, shape (n,)
        Measured minus fitted values, by quantity, in its SI unit; not-a-number where nothing was measured.
    bearing : JournalBearing
        Bearing with the fitted parameters.
    evaluations : int
        Number of evaluations of all measured quantities.
    """

    parameters: dict[str, FittedParameter]
    confidence: float
    correlation: Array
    misfit: float
    highest_misfit: float
    residuals: dict[str, Array]
    bearing: JournalBearing
    evaluations: int

    _shown: ClassVar[tuple[str, ...]] = ("verdict",)
    _tabled: ClassVar[tuple[str, ...]] = ("parameters", "residuals")

    @property
    def verdict(self) -> str:
        """Whether the stated noise explains the residuals."""
        if self.misfit <= self.highest_misfit:
            return (
                "the stated noise explains the misfit" if self.highest_misfit < math.inf else "no noise given"
            )
        return (
            f"the misfit is {self.misfit:.3g} times the stated noise, more than chance explains "
            f"({self.highest_misfit:.3g}): noise, model or fixed parameters are wrong"
        )

    def to_table(self) -> ResultTable:
        """Return a row for each parameter: value, standard error and interval, in its SI unit."""
        names, found = list(self.parameters), list(self.parameters.values())
        numbers = ("value", "standard_error", "low", "high")
        return ResultTable(
            (
                Column("parameter", "", np.array(names, dtype=object)),
                Column("unit", "", np.array([_UNITS.get(name, "") for name in names], dtype=object)),
                *(Column(key, "", np.array([getattr(one, key) for one in found])) for key in numbers),
            ),
            "BearingFit",
            "parameter",
            {"misfit": self.misfit, "confidence": self.confidence, "verdict": self.verdict},
            {"misfit": "1", "confidence": "1"},
        )

    def _pages(self) -> Iterator[ResultTable]:
        names, units, *numbers = self.to_table().columns
        columns = (
            Column(one.name, "", np.array(list(map(quantity, one.values, units.values)), dtype=object))
            for one in numbers
        )
        yield ResultTable((names, *columns), f"parameters, intervals of {self.confidence:.0%} confidence")
        left = (Column(name, QUANTITIES.get(name, ""), values) for name, values in self.residuals.items())
        yield ResultTable(tuple(left), "measured less fitted")


@arguments
def fit_bearing(
    bearing: JournalBearing,
    measured: Measurements,
    *,
    free: Sequence[str] = ("clearance",),
    confidence: float = 0.95,
) -> BearingFit:
    """Return the bearing parameters that fit measurements best.

    Parameters
    ----------
    bearing : JournalBearing
        Bearing with a first guess of its parameters. Its temperature may be given, or follow from the heat
        balance.
    measured : Measurements
    free : sequence of str
        Among "clearance", "length" [m], "viscosity" [Pa s] or "temperature" [K] of the film,
        "supply_temperature", "ambient_temperature" [K], "housing_conductance" [W/K], "carry_over" of the
        cooling, and "zero_x", "zero_y" [m], the sensor reading for a centered journal.
    confidence : float [1]
        Confidence of the intervals, above 0 and below 1.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the measurements do not determine all free parameters; the message
        names these.
    EquilibriumError
        If a trial bearing does not carry a load.
    ConvergenceError
        If the search does not end.

    Notes
    -----
    Least squares over scaled parameters. Positions and temperatures have exact derivatives by the clearance,
    by the viscosity or temperature of the film and, without openings, by the cooling. All others are central
    differences. The covariance is that of the linearized problem, (J^T J)^-1. If no noise was given, it is
    multiplied by the mean square of the residuals, and the interval uses Student's distribution.

    Examples
    --------
    >>> start = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    >>> seen = {"x": [31.3e-6, 21.9e-6], "y": [-17.8e-6, -8.5e-6]}
    >>> data = Measurements(speed=[100.0, 200.0], load=[0.0, -500.0], values=seen)
    >>> fit = fit_bearing(start, data, free=("clearance", "viscosity"))
    >>> sorted(fit.parameters)
    ['clearance', 'viscosity']
    """
    require_kind("bearing", bearing, JournalBearing, "a JournalBearing with a first guess")
    require_kind("measured", measured, Measurements, "Measurements")
    if not 0.0 < require_number("confidence", confidence) < 1.0:
        raise InputError(f"confidence must be above 0 and below 1, got {confidence!r}")
    search = search_of(bearing, measured, free)
    spare = measured.count - len(free)
    if spare < (measured.noise is None):
        raise InputError(
            "free must be fewer parameters than there are measured numbers, "
            f"got {len(free)} for {measured.count}"
        )
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # A trial that the search only passes through is nobody's answer; that of the result is warned of.
        start = np.zeros(len(free))
        search.residual(start)  # which tells what the bearing cannot predict
        _require_apart(search, search.jacobian(start))
        found = least_squares(
            search.residual,
            start,
            search.jacobian,
            bounds=search.bounds,
            xtol=TOLERANCE,
            ftol=TOLERANCE,
            gtol=TOLERANCE,
        )
        if not found.success:
            raise ConvergenceError(f"the fit must end, and did not: {found.message}", found.x)
        J = search.jacobian(found.x)
        _require_apart(search, J)
    inverse = np.linalg.inv(J.T @ J)
    excess = 1.0 if measured.noise is not None else 2.0 * found.cost / spare
    half = (1.0 + confidence) / 2.0
    quantile = float(norm.ppf(half) if measured.noise is not None else student.ppf(half, spare))
    error = np.sqrt(excess * np.diag(inverse))
    ends = [search.values(np.clip(found.x + side * quantile * error, *search.bounds)) for side in (-1.0, 1.0)]
    columns = (search.values(found.x), error * search.slopes(found.x), *ends)
    left = measured.table - search.predicted(found.x)
    stated = measured.noise is not None and spare > 0
    fit = BearingFit(
        parameters={
            name: FittedParameter(value=value, standard_error=sigma, low=low, high=high)
            for name, value, sigma, low, high in zip(search.names, *np.array(columns).tolist(), strict=True)
        },
        confidence=confidence,
        correlation=inverse / np.sqrt(np.outer(np.diag(inverse), np.diag(inverse))),
        misfit=math.sqrt(2.0 * found.cost / measured.count),
        highest_misfit=math.sqrt(float(chi2.ppf(CHANCE, spare)) / measured.count) if stated else math.inf,
        residuals=dict(zip(measured.names, left.T, strict=True)),
        bearing=search.trial(found.x)[0],
        evaluations=int(found.nfev),
    )
    if fit.misfit > fit.highest_misfit:
        warn_user(fit.verdict, ValidityWarning)
    return fit


@lru_cache(maxsize=4)
def _rests(bearing: JournalBearing, measured: Measurements) -> tuple[Equilibrium, ...]:
    """Return the equilibria of a bearing at the rows of measurements."""
    return tuple(equilibrium(bearing, load, speed) for speed, load in measured.rows)


def _quantity(name: str, bearing: JournalBearing, at: Equilibrium, zero: Array) -> float:
    """Return what a bearing at rest predicts for one quantity."""
    if name in ("x", "y"):
        k = "xy".index(name)
        return float(at.position[k] + zero[k])
    if name == "temperature":
        if at.temperature is None:
            raise InputError("bearing must have its temperature left to the heat balance for a measured one")
        return at.temperature
    if name in ("power_loss", "side_flow"):
        if at.losses is None:
            raise InputError(f"bearing must have a film with losses, as MapFilm, for a measured {name}")
        return float(getattr(at.losses, name))
    film = film_coefficients(bearing, at.position, at.speed)
    matrix = film.stiffness if name[0] == "k" else film.damping
    return float(matrix["xy".index(name[1]), "xy".index(name[2])])


def _require_apart(search: Search, jacobian: Array) -> None:
    """Raise InputError if some parameters, or some mixture of them, leave the measurements as they are."""
    sizes = np.linalg.norm(jacobian, axis=0)
    blind = [name for name, size in zip(search.names, sizes, strict=True) if not size > 0.0]
    if blind:
        raise InputError(f"free must be parameters that the measurements depend on, got {', '.join(blind)}")
    _, singular, directions = np.linalg.svd(jacobian / sizes, full_matrices=False)
    if jacobian.shape[0] >= sizes.size and singular[-1] > APART * singular[0]:
        return
    mixed = [n for n, part in zip(search.names, np.abs(directions[-1]), strict=True) if part > TAKES_PART]
    raise InputError(
        f"free must be parameters that the measurements tell apart, got {' and '.join(mixed)}: "
        "together they change nothing that was measured"
    )


# How position and temperature of a journal at rest change with parameters of its bearing, exactly.
#
# At rest the force F(q, T, p) balances the load and the heat B(q, T, p) is zero, so that with z = (q, T)
#
#     dz/dp = -(d(F, B)/dz)^-1 d(F, B)/dp.
#
# Where a parameter is the clearance c, at a held position q, since the film knows e = q/c alone,
#
#     dF/dc = -(2 F + F_q q)/c,   dP/dc = -(P + P_q q)/c,   dQ/dc = (Q - Q_q q)/c
#
# for the power P and the flow Q.


RELATIVE_STEP = 1e-3
"""Step of a central difference of the heat capacity over temperature, which is a parabola."""


def rest_slopes(bearing: JournalBearing, at: Equilibrium, name: str) -> Array | None:
    """Return d(x, y, temperature)/d(parameter), shape (3,); None where only differences tell.

    The parameter is one of `NAMES` but the zeros of sensors.
    """
    if bearing.supply_pressure > 0.0:
        return None
    film = bearing if at.temperature is None else bearing.at_temperature(at.temperature)
    still = at.position, np.zeros(2), at.speed
    force, by_position = film.force(*still), film.jacobian(*still)[:, :2]
    by_name = _force_slope(film, force, by_position @ at.position, name)
    if at.temperature is None:
        return None if by_name is None else np.append(np.linalg.solve(by_position, -by_name), 0.0)
    try:
        power, flow, _ = film.heat_jacobian(*still)[:, :2]
    except InputError:
        return None
    oil, cooling = bearing.cooled
    heat = film.film_heat(*still)
    supply, T, c = cooling.supply_temperature, at.temperature, bearing.clearance
    capacity = float(oil.volumetric_heat(supply))
    carried = capacity * (T - supply)
    heated = {
        "clearance": (-heat.power - power @ at.position - carried * (heat.flow - flow @ at.position)) / c,
        "supply_temperature": heat.flow * (capacity - (T - supply) * _capacity_slope(bearing, supply)),
        "ambient_temperature": cooling.housing_conductance,
        "housing_conductance": cooling.ambient - T,
        "carry_over": 0.0,
    }
    if name not in heated:
        return None
    if name == "supply_temperature" and cooling.ambient_temperature is None:
        heated[name] += cooling.housing_conductance
    _, cools = heat_surplus(heat, oil, cooling, T)
    by_temperature = -float(oil.law.thinning(T)) * force
    slopes = np.block([[by_position, by_temperature[:, None]], [power - carried * flow, cools]])
    known = np.append(np.zeros(2) if by_name is None else by_name, heated[name])
    return np.asarray(np.linalg.solve(slopes, -known))


def _force_slope(film: JournalBearing, force: Array, moved: Array, name: str) -> Array | None:
    """Return the derivative of the force by a parameter at held position q and temperature; None for others.

    `moved` is F_q q.
    """
    if name == "clearance":
        return np.asarray(-(2.0 * force + moved) / film.clearance)
    if name == "viscosity":
        return np.asarray(force / film.film_viscosity)
    if name == "temperature" and film.oil is not None and film.temperature is not None:
        return np.asarray(-float(film.oil.law.thinning(film.temperature)) * force)
    return None


def _capacity_slope(bearing: JournalBearing, temperature: float) -> float:
    oil, _ = bearing.cooled
    step = RELATIVE_STEP * temperature
    ends = oil.volumetric_heat(np.array([temperature - step, temperature + step]))
    return float(ends[1] - ends[0]) / (2.0 * step)
