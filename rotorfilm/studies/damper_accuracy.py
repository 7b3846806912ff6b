"""Error against cost of every squeeze film, cavitated and full, on random states."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace

import numpy as np

from ..bearings import damper
from ..bearings.films.geometry import FullFilm, HalfSommerfeld
from ..core.errors import ValidityWarning, require_count, require_positive
from ..core.progress import Report, silent
from .study import (
    SEED,
    States,
    Study,
    StudyCase,
    StudyModel,
    StudyResult,
    film_times,
    relative_error,
    run_study,
    spread,
)

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

    def bind(self, case: damper.SqueezeCase) -> damper.SqueezeFilm:
        """Return the film of one damper."""
        modes, kept = case.modes, slice(0, self.count)
        weight = modes.weight[kept].copy()
        weight[-1] += modes.weight[self.count :].sum()
        fewer = modes._replace(weight=weight, leak=modes.leak[kept], passage=modes.passage[kept])
        return damper.ShortSqueeze().bind(case._replace(modes=fewer, feed=case.feed[kept]))


REDUCED, SERIES_FILM, MAP, PUBLISHED, FINITE = "reduced", "series", "map", "published", "finite length"
FAMILIES: dict[type[damper.SqueezeLaw], str] = {
    damper.ShortSqueeze: SERIES_FILM,
    SeriesSqueeze: SERIES_FILM,
    damper.MapSqueeze: MAP,
    damper.PublishedSqueeze: PUBLISHED,
    damper.FiniteSqueeze: FINITE,
    damper.FiniteMapSqueeze: FINITE,
}
"""What squeeze films of the ladder have in common; those of a solid or thin cage are reduced."""


CASES = {"cavitated": True, "full film": False}
"""Whether films rupture, by the names of the cases."""


def damper_accuracy(
    slenderness: float,
    permeability_number: float,
    *,
    states: int = 200,
    seed: int = SEED,
    rounds: int = ROUNDS,
    report: Report = silent,
) -> StudyResult:
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
        Rounds of timing; the shortest counts.
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
    cases = []
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        # Rungs outside their range are the point.
        for kind, cavitated in CASES.items():
            models = damper_models(slenderness, permeability_number, cavitated=cavitated)
            # The closest film of finite length comes first, the whole series last.
            finite = next(one.law for one in models if one.family == FINITE)
            whole = [one.law for one in models if one.family == SERIES_FILM][-1]
            forces = finite.force(*drawn), whole.force(*drawn)
            cases.append(StudyCase(name=kind, models=models, at=cavitated, reference=forces))
    study = Study(
        name="damper",
        solve=lambda model, case: model.law.force(*drawn),
        quantities=lambda model, case, force: {
            "film [-]": model.name,
            "cavitated [-]": case.at,
            **spread(relative_error(force, case.reference[0]), "median", "99 %"),
            # which leaves out the length
            **spread(relative_error(force, case.reference[1]), "99 %", of=" against the short film"),
        },
        costs=film_times(
            "force in a batch [s]", "force alone, prepare() [s]", drawn, lambda law: law, rounds=rounds
        ),
    )
    conditions = {
        "length/diameter [1]": slenderness,
        "permeability number [1]": permeability_number,
        "states [1]": states,
        "seed [-]": seed,
    }
    return run_study(study, cases, reference="film of finite length", conditions=conditions, report=report)


def compared_damper(
    slenderness: float, permeability_number: float = 0.0, *, grading: float = 0.0
) -> damper.PorousDamper:
    """Return a short full film with a cage of this Phi; solid at 0."""
    length = 2.0 * RADIUS * slenderness
    thickness = THICKNESS * length
    cage = None
    if permeability_number:
        permeability = permeability_number * CLEARANCE**3 / thickness
        cage = damper.PorousCage(thickness=thickness, permeability=permeability, grading=grading)
    return damper.PorousDamper(
        radius=RADIUS, length=length, clearance=CLEARANCE, viscosity=VISCOSITY, cage=cage, extent=FullFilm()
    )


def damper_models(slenderness: float, permeability_number: float, *, cavitated: bool) -> list[StudyModel]:
    """Return the models that are compared."""
    dampers = damper_rungs(slenderness, permeability_number, cavitated=cavitated)
    reduced = {name: one.cage is None or one.cage.thin for name, one in dampers.items()}
    return [
        StudyModel(name=name, family=REDUCED if reduced[name] else FAMILIES[type(one.film)], law=one)
        for name, one in dampers.items()
    ]


def damper_rungs(
    slenderness: float, permeability_number: float, *, cavitated: bool
) -> dict[str, damper.PorousDamper]:
    """Return the dampers that are compared, by name; the last is of finite length, on a map."""
    cavitation = HalfSommerfeld() if cavitated else FullFilm()
    whole = replace(compared_damper(slenderness, permeability_number, grading=0.1), extent=cavitation)
    assert whole.cage is not None
    full: dict[str, damper.SqueezeLaw] = (
        {} if cavitated else {"published": damper.PublishedSqueeze(), "finite length": damper.FiniteSqueeze()}
    )
    return {
        "solid cage": replace(whole, cage=None),
        "Morgan-Cameron": replace(whole, cage=replace(whole.cage, thin=True)),
        **{f"series, {n}": replace(whole, film=SeriesSqueeze(n)) for n in SERIES},
        "series, whole": whole,
        "map": replace(whole, film=damper.MapSqueeze()),
        **{name: replace(whole, film=film) for name, film in full.items()},
        "finite length, map": replace(whole, film=damper.FiniteMapSqueeze()),
    }


def _states(count: int, seed: int) -> States:
    rng = np.random.default_rng(seed)
    chi, phi = rng.uniform(0.0, LARGEST, count), rng.uniform(-np.pi, np.pi, count)
    position = CLEARANCE * chi * np.stack([np.cos(phi), np.sin(phi)])
    return States(position, 0.04 * rng.normal(size=(2, count)), np.zeros(count))
