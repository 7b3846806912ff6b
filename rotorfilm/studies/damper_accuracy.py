"""Error against cost of every squeeze film, cavitated and full, on random states."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from ..bearings.damper import (
    FiniteMapSqueeze,
    FiniteSqueeze,
    MapSqueeze,
    PorousCage,
    PorousDamper,
    PublishedSqueeze,
    ShortSqueeze,
    SqueezeCase,
    SqueezeFilm,
    SqueezeLaw,
)
from ..bearings.films.geometry import FullFilm, HalfSommerfeld
from ..core.errors import ValidityWarning, require_count, require_positive
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable
from .journal_accuracy import SEED, FilmCost, States, film_costs, relative_error

LARGEST = 0.9
"""Eccentricity ratio of the states at most."""

RADIUS, CLEARANCE, VISCOSITY, THICKNESS = 0.05, 1e-4, 0.01, 0.1
"""Of the damper that is compared; the thickness of its cage per length. Only ratios matter."""

SERIES = (1, 2, 3, 5, 10)
"""Axial modes of the truncated series, the last of which takes the rest."""

ROUNDS = 9


@dataclass(frozen=True)
class SeriesSqueeze:
    """Short film with few axial modes of Darcy's series: a rung of the ladder.

    Parameters
    ----------
    count : int
        Modes kept, the last with the weight of those beyond.
    """

    count: int

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper."""
        modes, kept = case.modes, slice(0, self.count)
        weight = modes.weight[kept].copy()
        weight[-1] += modes.weight[self.count :].sum()
        fewer = modes._replace(weight=weight, leak=modes.leak[kept], passage=modes.passage[kept])
        return ShortSqueeze().bind(case._replace(modes=fewer, feed=case.feed[kept]))


class SqueezeFamily(StrEnum):
    """What squeeze films of the ladder have in common; those of a solid or thin cage are reduced."""

    REDUCED = "reduced"
    SERIES = "series"
    MAP = "map"
    PUBLISHED = "published"
    FINITE = "finite length"


FAMILIES: dict[type[SqueezeLaw], SqueezeFamily] = {
    ShortSqueeze: SqueezeFamily.SERIES,
    SeriesSqueeze: SqueezeFamily.SERIES,
    MapSqueeze: SqueezeFamily.MAP,
    PublishedSqueeze: SqueezeFamily.PUBLISHED,
    FiniteSqueeze: SqueezeFamily.FINITE,
    FiniteMapSqueeze: SqueezeFamily.FINITE,
}


def squeeze_family(damper: PorousDamper) -> SqueezeFamily:
    """Return the family of a damper of the ladder."""
    if damper.cage is None or damper.cage.thin:
        return SqueezeFamily.REDUCED
    return FAMILIES[type(damper.film)]


@dataclass(frozen=True, kw_only=True)
class DamperRung(Readable):
    """Error and cost of one squeeze film.

    Attributes
    ----------
    name : str
    family : SqueezeFamily
    cavitated : bool
        Whether the film ruptures.
    median_error, high_error : float [1]
        Median and 99th percentile of |force - reference| / |reference|, the film of finite length.
    series_error : float [1]
        99th percentile against the short film with the whole series; what the length costs is not in it.
    cost : FilmCost
    """

    name: str
    family: SqueezeFamily
    cavitated: bool
    median_error: float
    high_error: float
    series_error: float
    cost: FilmCost


@dataclass(frozen=True, kw_only=True)
class DamperAccuracy(Readable):
    """Error against cost of the ladder of squeeze films.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    permeability_number : float [1]
        Phi of the cage; H/L = 0.1, grading 0.1.
    states, seed : int
    rungs : tuple of DamperRung
    """

    slenderness: float
    permeability_number: float
    states: int
    seed: int
    rungs: tuple[DamperRung, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        rows = [
            {
                "film [-]": rung.name,
                "cavitated [-]": rung.cavitated,
                "median error [1]": rung.median_error,
                "99 % error [1]": rung.high_error,
                "99 % error against the short film [1]": rung.series_error,
                "force in a batch [s]": rung.cost.force_time,
                "force alone, prepare() [s]": rung.cost.call_time,
                "batch [1]": rung.cost.batch,
                "length/diameter [1]": self.slenderness,
                "permeability number [1]": self.permeability_number,
                "states [1]": self.states,
                "seed [-]": self.seed,
            }
            for rung in self.rungs
        ]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


def damper_accuracy(
    slenderness: float,
    permeability_number: float,
    *,
    states: int = 200,
    seed: int = SEED,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> DamperAccuracy:
    """Measure error and cost of every squeeze film in one run.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    permeability_number : float [1]
        Phi of the porous cage.
    states : int
        Random states: eccentricity ratio uniform to 0.9, directions uniform.
    seed : int
    rounds : int
        Of timing; the shortest counts.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    for name, value in (("slenderness", slenderness), ("permeability_number", permeability_number)):
        require_positive(name, value)
    require_count("states", states, 1)
    drawn = _states(states, seed)
    rungs: list[DamperRung] = []
    # Rungs outside their range are the point.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        for part, cavitated in enumerate((True, False)):
            dampers = damper_rungs(slenderness, permeability_number, cavitated=cavitated)
            share = part_of(report, 0.5 * part, 0.5 * (part + 1))
            costs = film_costs(dampers, drawn, rounds=rounds, report=share)
            rungs += _compared(dampers, costs.values(), drawn, cavitated=cavitated)
    return DamperAccuracy(
        slenderness=slenderness,
        permeability_number=permeability_number,
        states=states,
        seed=seed,
        rungs=tuple(rungs),
    )


def compared_damper(
    slenderness: float, permeability_number: float = 0.0, *, grading: float = 0.0
) -> PorousDamper:
    """Return a short full film with a cage of this Phi; solid at 0."""
    length = 2.0 * RADIUS * slenderness
    thickness = THICKNESS * length
    cage = None
    if permeability_number:
        permeability = permeability_number * CLEARANCE**3 / thickness
        cage = PorousCage(thickness=thickness, permeability=permeability, grading=grading)
    return PorousDamper(
        radius=RADIUS,
        length=length,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        cage=cage,
        extent=FullFilm(),
    )


def damper_rungs(
    slenderness: float, permeability_number: float, *, cavitated: bool
) -> dict[str, PorousDamper]:
    """Return the dampers that are compared, by name; the last is of finite length, on a map."""
    cavitation = HalfSommerfeld() if cavitated else FullFilm()
    whole = replace(compared_damper(slenderness, permeability_number, grading=0.1), extent=cavitation)
    assert whole.cage is not None
    full: dict[str, SqueezeLaw] = (
        {} if cavitated else {"published": PublishedSqueeze(), "finite length": FiniteSqueeze()}
    )
    return {
        "solid cage": replace(whole, cage=None),
        "Morgan-Cameron": replace(whole, cage=replace(whole.cage, thin=True)),
        **{f"series, {n}": replace(whole, film=SeriesSqueeze(n)) for n in SERIES},
        "series, whole": whole,
        "map": replace(whole, film=MapSqueeze()),
        **{name: replace(whole, film=film) for name, film in full.items()},
        "finite length, map": replace(whole, film=FiniteMapSqueeze()),
    }


def _compared(
    dampers: Mapping[str, PorousDamper], costs: Iterable[FilmCost], states: States, *, cavitated: bool
) -> list[DamperRung]:
    forces = [damper.force(*states) for damper in dampers.values()]
    families = [squeeze_family(damper) for damper in dampers.values()]
    pairs = list(zip(families, forces, strict=True))
    # The closest film of finite length comes first, the whole series last.
    reference = next(force for family, force in pairs if family is SqueezeFamily.FINITE)
    whole = [force for family, force in pairs if family is SqueezeFamily.SERIES][-1]
    rungs = []
    for name, family, force, cost in zip(dampers, families, forces, costs, strict=True):
        errors = relative_error(force, reference)
        rungs.append(
            DamperRung(
                name=name,
                family=family,
                cavitated=cavitated,
                median_error=float(np.median(errors)),
                high_error=float(np.quantile(errors, 0.99)),
                series_error=float(np.quantile(relative_error(force, whole), 0.99)),
                cost=cost,
            )
        )
    return rungs


def _states(count: int, seed: int) -> States:
    rng = np.random.default_rng(seed)
    chi, phi = rng.uniform(0.0, LARGEST, count), rng.uniform(-np.pi, np.pi, count)
    position = CLEARANCE * chi * np.stack([np.cos(phi), np.sin(phi)])
    return States(position, 0.04 * rng.normal(size=(2, count)), np.zeros(count))
