"""Error against cost of the models of a film's heat: one temperature, a field, layers across the film."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from time import process_time
from typing import Any

import numpy as np

from ..analysis import coefficients, equilibrium, heated_equilibrium
from ..bearings import journal
from ..bearings.films.geometry import Groove
from ..bearings.oil import Cooling, Oil
from ..core.model import Array
from ..core.port import Reaction
from ..core.progress import Report, part_of, silent
from ..core.units import CELSIUS
from .study import Study, StudyCase, StudyModel, StudyResult, run_study, timed

# Models of a film's heat: as cold as the supply, one temperature, a field, layers across the film.


CELLS, LAYERS = (80, 8), 12
REFERENCE_CELLS, REFERENCE_LAYERS = (160, 12), 20
"""Of the models with fields, and of the reference: cells around the film and along half of it."""


class HeatModel(StrEnum):
    """Models of a film's heat, from the cheapest to the richest."""

    SUPPLY = "T0"
    BALANCE = "T1"
    HOUSING = "T1 housing"
    ADIABATIC = "T2"
    BUSH = "T2 bush"
    LAYERS = "T3"

    @property
    def label(self) -> str:
        """Return the model in words."""
        return f"{self.value[:2]}, {_SAID[self]}"


_SAID = {
    HeatModel.SUPPLY: "as cold as the supply",
    HeatModel.BALANCE: "heat balance",
    HeatModel.HOUSING: "with housing",
    HeatModel.ADIABATIC: "over the film",
    HeatModel.BUSH: "with bush",
    HeatModel.LAYERS: "across the film",
}

ONE_TEMPERATURE = (HeatModel.SUPPLY, HeatModel.BALANCE, HeatModel.HOUSING)
"""Models in which a film has one temperature."""


HeatAnswer = tuple[Array, dict[str, float]]
"""Where the journal rests (2,) [m], and columns of the table: load along -y, stiffness along it."""


def answered(case: HeatCase, model: HeatModel, *, cells: tuple[int, int], layers: int) -> HeatAnswer:
    """Return what a model says of a case, those with fields on so many cells and layers."""
    if model in ONE_TEMPERATURE:
        return _with_one_temperature(bearing_of(case, model), case)
    profile: journal.FilmProfile = (
        journal.LayeredTemperature(layers) if model is HeatModel.LAYERS else journal.MeanTemperature()
    )
    at = _warm(case, cells, profile, adiabatic=model is HeatModel.ADIABATIC)
    state: journal.HeatedState = at.state
    return _answer(at.rest.position, case, state.film, state.power_loss, state.maximum_temperature)


def heated_film(
    case: HeatCase, *, cells: tuple[int, int] = REFERENCE_CELLS, layers: int = REFERENCE_LAYERS
) -> journal.HeatedState:
    """Return the film of a case under its load, with its bush, over so many cells and layers."""
    return _warm(case, cells, journal.LayeredTemperature(layers)).state


def _warm(
    case: HeatCase, cells: tuple[int, int], profile: journal.FilmProfile, *, adiabatic: bool = False
) -> Any:
    """Return the equilibrium of a case with a field of temperature, in its bush or adiabatic walls."""
    walls = {} if adiabatic else {"walls": case.ring}
    film = journal.HeatedFilm(bearing=case.bearing, cells=cells, profile=profile, **walls)
    return heated_equilibrium(film, case.load, case.speed)


def position_error(answer: HeatAnswer, reference: HeatAnswer) -> float:
    """Return how far a journal is from where a reference has it, in its eccentricity."""
    return float(np.hypot(*(answer[0] - reference[0])) / np.hypot(*reference[0]))


def bearing_of(case: HeatCase, model: HeatModel) -> journal.JournalBearing:
    """Return the bearing of a model with one temperature; a housing takes what the bush would, all round."""
    bearing, (_, cooling) = case.bearing, case.bearing.cooled
    if model is HeatModel.SUPPLY:
        return bearing.at_temperature(cooling.supply_temperature)
    if model is HeatModel.BALANCE:
        return bearing
    taken = 2.0 * math.pi * bearing.radius * bearing.length * case.ring.mean_transfer(bearing.radius)
    ambient = case.ring.ambient_temperature
    housed = replace(cooling, housing_conductance=taken, ambient_temperature=ambient)
    return replace(bearing, cooling=housed)


def _with_one_temperature(bearing: journal.JournalBearing, case: HeatCase) -> HeatAnswer:
    at = equilibrium(bearing, case.load, case.speed)
    temperature = bearing.temperature if at.temperature is None else at.temperature
    assert temperature is not None
    assert at.losses is not None
    film = bearing.at_temperature(temperature)
    return _answer(at.position, case, film, float(at.losses.power_loss), temperature)


def _answer(
    position: Array, case: HeatCase, film: Reaction, power_loss: float, temperature: float
) -> HeatAnswer:
    x, y = position
    return position, {
        "eccentricity ratio [1]": float(np.hypot(x, y)) / case.bearing.clearance,
        "attitude angle [rad]": math.atan2(x, -y) * math.copysign(1.0, case.speed),
        "power loss [W]": power_loss,
        "temperature, or largest [K]": temperature,
        "stiffness yy [N/m]": float(coefficients(film, position, case.speed).stiffness[1, 1]),
    }


# Bearings that warm, on which models of heat are compared.


AMBIENT = 30.0 + CELSIUS
"""Around the bush [K]."""

RING = 2.0
"""Outer radius of the bush over that of the bearing."""


@dataclass(frozen=True, kw_only=True)
class HeatCase:
    """A bearing that warms under its load.

    Attributes
    ----------
    name : str
    bearing : JournalBearing
        Its temperature left to the heat balance, without housing.
    force : float [N]
        Load along -y.
    speed : float [rad/s]
    """

    name: str
    bearing: journal.JournalBearing
    force: float
    speed: float

    @property
    def load(self) -> list[float]:
        """External force on the journal, shape (2,) [N]."""
        return [0.0, -self.force]

    @property
    def ring(self) -> journal.BushRing:
        """The steel bush around it."""
        return journal.BushRing(outer_radius=RING * self.bearing.radius, ambient_temperature=AMBIENT)


def two_grooves(width: float) -> tuple[Groove, Groove]:
    """Return two grooves of a width [rad] at right angles to a load along -y."""
    return Groove(center=0.0, width=width), Groove(center=np.pi, width=width)


def _case(
    name: str,
    size: tuple[float, float, float],
    oil: tuple[int, float],
    run: tuple[float, float],
    grooves: int,
) -> HeatCase:
    """Return a case of radius, length, clearance [m], grade and supply [degC], load [N] and speed [rpm]."""
    bearing = journal.JournalBearing(
        radius=size[0],
        length=size[1],
        clearance=size[2],
        oil=Oil.iso_vg(oil[0]),
        cooling=Cooling(supply_temperature=oil[1] + CELSIUS),
        grooves=two_grooves(np.radians(20.0)) if grooves else (),
    )
    return HeatCase(name=name, bearing=bearing, force=run[0], speed=run[1] * np.pi / 30.0)


HEAT_CASES = (
    _case("textbook, VG 100", (0.05, 0.03, 1e-4), (100, 37.1), (525.0, 1500.0), 0),
    _case("two grooves, VG 46", (0.05, 0.05, 75e-6), (46, 45.0), (5e3, 3000.0), 2),
    _case("turbine, VG 32", (0.1, 0.16, 150e-6), (32, 45.0), (3e4, 3000.0), 2),
    _case("small, VG 22", (0.01, 0.01, 20e-6), (22, 50.0), (100.0, 6e4), 0),
)
"""Between them the thinning of the oil by its rise is 2 to 40, the Peclet number 20 to 90."""


# Error against cost of the models of a film's heat: one temperature, a field, layers across the film.


ROUNDS = 5
"""Runs of a model with one temperature, the shortest of which counts."""


def _quantities(model: StudyModel, case: StudyCase, answer: HeatAnswer) -> dict[str, object]:
    numbers, exact = case.at[1], case.reference
    own, power = model.law is None, "power loss [W]"
    return {
        "bearing [-]": case.at[0].name,
        "thinning x rise E [1]": numbers.thinning_rise,
        "Peclet number [1]": numbers.peclet,
        "Nahme number [1]": numbers.nahme,
        "model [-]": model.name,
        **answer[1],
        "error of the position [1]": None if own else position_error(answer, exact),
        "error of the power [1]": None if own else abs(answer[1][power] / exact[1][power] - 1.0),
    }


HEAT = Study(
    name="heat",
    solve=lambda model, case: answered(case.at[0], model.law, cells=CELLS, layers=LAYERS),
    quantities=_quantities,
    costs=timed("CPU time [s]", process_time),
)

HEAT_MODELS = (
    *(
        StudyModel(
            name=model.value,
            family=model,
            label=model.label,
            law=model,
            repeats=ROUNDS if model in ONE_TEMPERATURE else 1,
        )
        for model in HeatModel
    ),
    StudyModel(name="reference", family="reference"),
)
"""The last has a row of the table and no mark."""


def heat_accuracy(
    cases: Sequence[HeatCase] = HEAT_CASES,
    *,
    cells: tuple[int, int] = REFERENCE_CELLS,
    layers: int = REFERENCE_LAYERS,
    report: Report = silent,
) -> StudyResult:
    """Return error and cost of all models of heat.

    Parameters
    ----------
    cases : sequence of HeatCase
    cells : tuple of int
        Cells of the reference.
    layers : int
        Layers of the reference.
    report : callable, optional
        Told how far the job is.
    """
    studied = []
    for number, case in enumerate(cases):
        report(0.5 * number / len(cases), f"reference of {case.name}")
        exact = answered(case, HeatModel.LAYERS, cells=cells, layers=layers)
        cold = equilibrium(bearing_of(case, HeatModel.SUPPLY), case.load, case.speed)
        numbers = journal.heat_numbers(case.bearing, cold.position, case.speed)
        told = f"E = {numbers.thinning_rise:.2g}, Pe = {numbers.peclet:.2g}, Na = {numbers.nahme:.2g}"
        studied.append(
            StudyCase(name=f"{case.name}: {told}", models=HEAT_MODELS, at=(case, numbers), reference=exact)
        )
    text = f"temperature over {cells[0]} x {cells[1]} cells and in {layers} layers across the film"
    return run_study(HEAT, studied, reference=text, report=part_of(report, 0.5, 1.0))
