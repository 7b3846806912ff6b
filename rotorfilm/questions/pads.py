"""What bearings of fixed pads bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import equilibrium
from ..analysis.harmonic_balance import StatefulTurn, TurnEquations, basis, first_wave, resampled
from ..bearings.pads import TiltingPadBearing
from ..core.answers import DISAGREEMENT, ErrorEstimate, Found, Ladder, Work, WorkUnit
from ..core.errors import FilmContactError
from ..core.model import Array
from ..scenes.export_scene import film_models
from ..scenes.families import Family, SceneModels
from ..scenes.pad_candidates import (
    DamCandidate,
    LobedCandidate,
    TiltingCandidate,
    dam_candidates,
    few_forces,
    lobed_candidates,
    many_forces,
    tilting_candidates,
)
from ..scenes.pad_tables import DamTable, LobedTable, TiltingTable, quick_pads
from .coupling import coupling_ladder
from .film_motions import (
    FORCE,
    ORBIT_UNITS as ORBITS,
    SampledOrbitRung,
    blade_loss_ladder,
    orbit_ladder,
    wave_change,
    wave_value,
)
from .film_statics import Films, static_ladder
from .film_thresholds import whirl_ladder
from .quantities import QUANTITIES

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# Ladders of bearings of fixed pads: those of journals, by films of pads.


PAD_STATICS = [quantity for quantity in QUANTITIES if quantity != "maximum_temperature"]
"""Static quantities of pads, whose films have one temperature."""


def fixed_ladders(points: Films, turns: Films) -> dict[str, Callable[[Scene, str], Ladder]]:
    """Return the ladders by quantity, of candidates for some equilibria and for states all round a turn."""
    return {
        **dict.fromkeys(PAD_STATICS, partial(static_ladder, points)),
        **dict.fromkeys(ORBITS, partial(orbit_ladder, turns)),
        "whirl_threshold": partial(whirl_ladder, points),
        "blade_loss_peak": partial(blade_loss_ladder, turns),
        "cosimulation_error": coupling_ladder,
    }


# What bearings of fixed pads bring to scenes and questions.


def _all(scene: Scene) -> tuple[LobedCandidate, ...]:
    return lobed_candidates(scene.table("lobed_journal").build(), fixed=scene.film_is_given)


LOBED = Family(
    table=LobedTable,
    ladders=fixed_ladders(
        lambda scene: few_forces(_all(scene), fixed=scene.film_is_given),
        lambda scene: many_forces(_all(settled_scene(scene)), fixed=scene.film_is_given),
    ),
    models=film_models,
    example={
        "lobed_journal": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "preset": "elliptical",
            "assembled_clearance": "70 um",
            "preload": 0.5,
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# What pressure dams bring to scenes and questions.


def _dam_films(scene: Scene, *, turns: bool = False) -> tuple[DamCandidate, ...]:
    scene = settled_scene(scene) if turns else scene
    return dam_candidates(scene.table("pressure_dam").build(), fixed=scene.film_is_given, turns=turns)


PRESSURE_DAM = Family(
    table=DamTable,
    ladders=fixed_ladders(_dam_films, partial(_dam_films, turns=True)),
    models=film_models,
    example={
        "pressure_dam": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "pad_clearance": "80 um",
            "depth": "140 um",
            "end": "145 deg",
            "share": 0.75,
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# Questions about tilting pads: K and C are those at the shaft's frequency.


def tilting_static_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity of tilting pads, K and C at the frequency of the shaft."""
    ladder = static_ladder(_films, scene, quantity)
    if not QUANTITIES[quantity].slopes:
        return ladder
    return replace(ladder, within=f"{ladder.within}, whirl of {abs(scene.speed):.6g} rad/s, once a turn")


def _films(scene: Scene) -> tuple[TiltingCandidate, ...]:
    return tilting_candidates(scene.table("tilting_pad").build(), fixed=scene.film_is_given)


# The orbit that an unbalance makes on tilting pads, which move in time with the journal.


FEW_SAMPLES = 15
"""Samples over a turn of a linear orbit."""

ORBIT_STEPS = 6
"""Newton steps that an orbit takes about."""


@dataclass(frozen=True, kw_only=True)
class StatefulOrbitRung(SampledOrbitRung[TiltingCandidate]):
    """The orbit on tilting pads of one film, by its equations over a turn."""

    @property
    def points(self) -> WorkUnit:
        """The pads at one state and time, with derivatives."""
        nominal = self.film.time(1)
        return WorkUnit(f"states of {self.film.name}", ("states", self.film), nominal=nominal)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity of the orbit, from that of a lower rung if there is one."""
        bearing = self.film.reaction
        if not self.samples:
            turn, count = self._equations(bearing, FEW_SAMPLES).linear(self._rest(bearing)), FEW_SAMPLES
        else:
            start = self._rest(bearing)[:, None] if before is None else before.solution.places
            turn, count = self._equations(bearing, self.samples).orbit(start), ORBIT_STEPS * self.samples
        return Found(self._value(turn), {self.points: count}, turn)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change by two steps with the richer film, at twice the samples, by this one's slopes."""
        places = found.solution.places
        samples = 2 * places.shape[1] + 1
        places = resampled(places, samples)
        own, rich = (self._equations(one, samples) for one in (self.film.reaction, self.film.rich))
        try:
            matrix = own.matrix(own.residual(places, slopes=True)[1])
            first = rich.step(matrix, rich.residual(places)[0])
            second = rich.step(matrix, rich.residual(places + first)[0])
        except FilmContactError:
            return ErrorEstimate(math.inf, "defect", doubt="the orbit leaves the clearance: not linear")
        better = rich.turn(places + first + second)
        error = wave_change(self.quantity, found.value, self._value(better))
        left = float(np.linalg.norm(second[:2])) / max(float(np.linalg.norm(first[:2])), 1e-300)
        doubt = f"a second step is {left:.0%} of the first: not linear" if left > DISAGREEMENT else ""
        method = f"defect of {self.film.rich_name}, {samples} samples"
        return ErrorEstimate(error, method, {self.points: samples}, doubt=doubt)

    def expected(self, done: Work) -> Work:
        """Return some Newton steps at these samples."""
        return {self.points: ORBIT_STEPS * self.samples if self.samples else FEW_SAMPLES}

    def _equations(self, bearing: TiltingPadBearing, samples: int) -> TurnEquations:
        return TurnEquations(self.rotor, bearing.evaluated, bearing.clearance, samples)

    def _rest(self, bearing: TiltingPadBearing) -> Array:
        speed = self.rotor.profile.speeds[0]
        position = equilibrium(bearing, self.rotor.static_force, speed).position
        return np.concatenate([position, bearing.at_rest().state(position, speed)])

    def _value(self, turn: StatefulTurn) -> float:
        rows = turn.force if self.quantity == FORCE else turn.places[:2]
        samples = rows.shape[1]
        wave = first_wave(rows @ basis(samples // 2, samples).back.T)
        # Over the angle of the rotor, not time: the unbalance turns with the phase at negative speed too.
        speed = abs(self.rotor.profile.speeds[0])
        return wave_value(self.quantity, wave, speed, self.rotor.unbalance_angle)


# What tilting pads bring to scenes and questions.


def tilting_models(scene: Scene) -> SceneModels:
    """Return the tilting pads of a scene and its rotor, all at rest, the films as warm as there."""
    scene = settled_scene(scene)
    models = film_models(scene)
    bearing = scene.table("tilting_pad").build()
    rest = np.array([models.start["x"], models.start["y"]])
    pads = bearing.at_rest().pad_states(rest, scene.speed)
    places = pads.tilts if bearing.pivot_stiffness is None else [*pads.tilts, *pads.pivot_deflections]
    return models._replace(bearing=replace(bearing, start=tuple(float(place) for place in places)))


TILTING = Family(
    table=TiltingTable,
    ladders={
        **dict.fromkeys(PAD_STATICS, tilting_static_ladder),
        **dict.fromkeys(
            ORBITS, partial(orbit_ladder, lambda scene: _films(settled_scene(scene)), rung=StatefulOrbitRung)
        ),
        "whirl_threshold": partial(whirl_ladder, _films, levels=False),
    },
    models=tilting_models,
    example={
        "tilting_pad": {
            "diameter": "100 mm",
            "length": "50 mm",
            "viscosity": "20 mPa s",
            "assembled_clearance": "70 um",
            "preload": 0.3,
            "pad_count": 5,
            "loading": "between_pads",
            "extent": "60 deg",
        },
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "200 kg"},
    },
)


# Pads on an oil: in motion their films keep the temperature that they have at rest.


def is_warm(scene: Scene) -> bool:
    """Return whether the bearing of a scene runs on an oil, as warm as its films get."""
    return bool(scene.film_table.build().is_warming)


def settled_scene(scene: Scene) -> Scene:
    """Return a scene whose films keep the temperature that they have with the journal at rest."""
    if not is_warm(scene):
        return scene
    bearing: Any = scene.bearing
    at = equilibrium(quick_pads(bearing), scene.static_load, scene.speed)
    name = next(name for name, table in scene.others.items() if table is scene.film_table)
    kept: Any = replace(scene.film_table, temperature=at.temperature)  # type: ignore[type-var]
    return replace(scene, others={**scene.others, name: kept})
