"""Films of lobed and tilting-pad bearings that may answer a question, and their ladders."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...analysis import coefficients, equilibrium
from ...analysis.harmonic_balance import StatefulTurn, TurnEquations, basis, first_wave, resampled
from ...core.answers import DISAGREEMENT, ErrorEstimate, Ladder, RungResult, Work, WorkUnit
from ...core.errors import FilmContactError
from ...core.model import Array
from ...core.port import at_balanced_temperature
from ...core.results import Equilibrium
from ...questions.film_ladders import film_ladders
from ...questions.film_motions import OrbitRung, orbit_ladder, wave_change, wave_value
from ...questions.film_statics import static_ladder, whirl_ladder
from ...questions.quantities import FORCE, ORBIT_UNITS as ORBITS, QUANTITIES
from ...scenes.film_rungs import CALL_TIME, CELL_TIME, STEP, Corrected, FilmCandidate, corrected, grid_name
from .. import pads
from .table import pad_film_name, quasi_static_scene

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# The films that may answer for a bearing of fixed pads, the cheapest first, and what is richer.


COARSE_MAP = pads.PadMapFilm(resolution=pads.PadResolution(cells=(48, 4), nodes=(12, 9, 40)))
"""Made in a tenth of the time of the map of a pad, with errors some ten times as large."""

TURBULENT_MAP = pads.PadMapFilm(reynolds_cells=24)
"""The map of a turbulent bearing, over the Reynolds number too."""

GRIDS = (((48, 4), (1e-4, 2e-3)), ((96, 8), (1e-5, 1e-3)), ((192, 16), (2e-6, 5e-4)))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

TURN_GRIDS = ((48, 4), (96, 8))
"""Those for states all round a turn."""

FINE, FINEST = (192, 16), (384, 32)
"""Cells of richer films."""


@dataclass(frozen=True)
class PadCandidate(FilmCandidate):
    """A film of pads that may answer for a bearing of fixed ones, or so many cells of those with recesses.

    Attributes
    ----------
    reaction : LobedBearing or PressureDamBearing
        Reaction with this film.
    rich : LobedBearing or PressureDamBearing
        With the richer one.
    """

    reaction: pads.LobedBearing | pads.PressureDamBearing
    rich: pads.LobedBearing | pads.PressureDamBearing

    def on_grid(self, bearing: pads.LobedBearing | pads.PressureDamBearing) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        return isinstance(bearing, pads.PressureDamBearing) or isinstance(bearing.film, pads.PadGridFilm)

    def curvature_distance(self, position: Array) -> float:
        """Return the distance [m] from the center of curvature of the pad that has the least film.

        With recesses from the farthest one.
        """
        bearing, c = self.reaction, self.reaction.clearance
        if isinstance(bearing, pads.PressureDamBearing):
            return float(max(np.hypot(*(position - c * np.array(pad.center))) for pad in bearing.pads))
        near = min(bearing.lobes, key=lambda lobe: float(lobe.least_film(position / c)))
        return float(np.hypot(*(position - c * np.array(near.center))))

    def rest_bound(self, at: Equilibrium, *, slopes: bool) -> float:
        """Return the bounds of the maps of all pads together in an equilibrium; infinite without maps."""
        bearing = self.reaction
        if isinstance(bearing, pads.PressureDamBearing) or not isinstance(bearing.film, pads.PadMapFilm):
            return math.inf
        place, film = (at.position, at.speed), bearing.film_at_speed
        shares = (pads.lobe_share(bearing, film, lobe, *place) for lobe in bearing.lobes)
        force, stiffness, damping = (sum(parts) for parts in zip(*shares, strict=True))
        if not slopes:
            return force / math.hypot(*at.load)
        found = coefficients(bearing, at.position, at.speed)
        return float(max(stiffness / np.abs(found.stiffness).max(), damping / np.abs(found.damping).max()))


def lobed_candidates(bearing: pads.LobedBearing, *, fixed: bool) -> tuple[PadCandidate, ...]:
    """Return the films that can answer for a bearing of fixed pads: maps that are there, grids, other maps.

    Parameters
    ----------
    bearing : LobedBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    if fixed:
        film = bearing.film
        fine = isinstance(film, pads.PadGridFilm) and math.prod(film.cells) >= math.prod(FINE)
        return (_lobed_candidate(bearing, film, pad_film_name(film), FINEST if fine else FINE, (0.0, 0.0)),)
    maps = _maps(bearing)
    ready = [film for film in maps if not film.makes_map]
    grids = [
        _lobed_candidate(
            bearing,
            pads.PadGridFilm(cells=cells),
            grid_name(cells),
            FINEST if cells == FINE else FINE,
            priors,
        )
        for cells, priors in GRIDS
    ]
    return (*ready, *grids, *(film for film in maps if film.makes_map))


def few_forces(candidates: Sequence[PadCandidate], *, fixed: bool) -> tuple[PadCandidate, ...]:
    """Return the candidates for some equilibria: a map that must be made first costs more than any grid."""
    return tuple(film for film in candidates if fixed or not film.makes_map)


def many_forces(candidates: Sequence[PadCandidate], *, fixed: bool) -> tuple[PadCandidate, ...]:
    """Return the candidates for states all round a turn: the finest grid costs more than any map."""
    kept = [pads.PadGridFilm(cells=cells) for cells in TURN_GRIDS]
    return tuple(
        film
        for film in candidates
        if fixed or isinstance(film.reaction.film, pads.PadMapFilm) or film.reaction.film in kept
    )


def _maps(bearing: pads.LobedBearing) -> list[PadCandidate]:
    """Return the maps of the pads, a coarse one too where the fine one is to be made; or none."""
    extents = {lobe.extent for lobe in bearing.lobes}
    if not all(pads.is_pad_mappable(extent, bearing.slenderness) for extent in extents):
        return []
    if bearing.turbulence is not None:
        return [_lobed_candidate(bearing, TURBULENT_MAP, "pad map", FINE, (1e-3, 2e-2))]
    coarse = _lobed_candidate(bearing, COARSE_MAP, "coarse pad map", FINE, (1e-4, 1e-3))
    fine = _lobed_candidate(bearing, pads.PadMapFilm(), "pad map", FINE, (1e-5, 5e-4))
    return [coarse, fine] if fine.makes_map else [fine]


def _lobed_candidate(
    bearing: pads.LobedBearing,
    film: pads.PadFilm,
    name: str,
    rich: tuple[int, int],
    priors: tuple[float, float],
) -> PadCandidate:
    cells = math.prod(film.cells) if isinstance(film, pads.PadGridFilm) else 0
    own, richer = replace(bearing, film=film), replace(bearing, film=pads.PadGridFilm(cells=rich))
    call_time = len(bearing.lobes) * (CELL_TIME * cells or CALL_TIME)
    making = own.making_time()
    return PadCandidate(name, own, richer, grid_name(rich), *priors, making=making, call_time=call_time)


# The films that may answer for a bearing of pads with recesses: grids of ever more cells.


LEVELS = (((32, 8), (2e-4, 5e-3)), ((64, 16), (5e-5, 1e-3)), ((128, 32), (5e-6, 5e-4)))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

DAM_FINE, DAM_FINEST = (128, 32), (256, 64)
"""Cells of richer films."""


def dam_candidates(
    bearing: pads.PressureDamBearing, *, fixed: bool, turns: bool = False
) -> tuple[PadCandidate, ...]:
    """Return the cells that can answer for a bearing of pads with recesses, the fewest first.

    Parameters
    ----------
    bearing : PressureDamBearing
    fixed : bool
        Whether the scene names the cells.
    turns : bool
        Whether they are for states all round a turn, which are too many for the most cells.
    """
    if fixed:
        return (_dam_candidate(bearing, DAM_FINEST, (0.0, 0.0)),)
    levels = LEVELS[:-1] if turns else LEVELS
    return tuple(
        _dam_candidate(replace(bearing, cells=cells), DAM_FINE if turns or not k else DAM_FINEST, priors)
        for k, (cells, priors) in enumerate(levels)
    )


def _dam_candidate(
    bearing: pads.PressureDamBearing, cells: tuple[int, int], priors: tuple[float, float]
) -> PadCandidate:
    rich, calls = replace(bearing, cells=cells), len(bearing.pads) * CELL_TIME * math.prod(bearing.cells)
    names = pad_film_name(bearing), pad_film_name(rich)
    return PadCandidate(names[0], bearing, rich, names[1], *priors, call_time=calls)


# The films that may answer for a bearing of tilting pads, the cheapest first, and what is richer.


TILTING_GRIDS = (((48, 4), (1e-4, 1e-3)), ((96, 8), (1e-5, 2e-4)), ((192, 16), (1e-6, 5e-5)))
"""Cells, and orders of magnitude of the error of a position, and of K and C."""

MAP_CALL = 2e-4
"""About what the force of pads at rest takes by a map [s]: each is looked for in all its tilts."""

LOOKS, CALLS = 60, 8
"""Films of one pad in the search for its tilt at rest, and forces with derivatives of an equilibrium."""


@dataclass(frozen=True)
class TiltingCandidate(FilmCandidate):
    """A film of pads that may answer for a bearing of tilting ones.

    Attributes
    ----------
    reaction : TiltingPadBearing
        Reaction with this film.
    rich : TiltingPadBearing
        With the richer one.
    """

    reaction: pads.TiltingPadBearing
    rich: pads.TiltingPadBearing

    @property
    def tangents(self) -> WorkUnit:
        """One answer."""
        return WorkUnit(f"answers of {self.name}", ("answers", self), nominal=self.time(CALLS))

    def units(self, speed: float) -> dict[WorkUnit, Callable[[], object]]:
        """Return none: work is timed while it is done."""
        return {}

    batch_units = units

    def asked(self, equilibria: int = 1) -> tuple[Any, Callable[[], dict[WorkUnit, int]]]:
        """Return the bearing to solve with, and a call for the work of so many equilibria."""
        return self.reaction, lambda: {self.tangents: equilibria}

    def expected(self, tangents: int) -> dict[WorkUnit, int]:
        """Return one answer."""
        return {self.tangents: 1}

    def judged(self, *, smooth: bool, defects: int, tangents: int = 2) -> dict[WorkUnit, int]:
        """Return one estimate."""
        return {WorkUnit(f"estimates by {self.rich_name}", ("estimates", self)): 1}

    @property
    def speed_prior(self) -> float:
        """Order of magnitude of the error of a threshold."""
        return self.prior

    @property
    def is_close(self) -> bool:
        """Return that all films of tilting pads are close enough to say that something does not exist."""
        return True

    def growth(self, at: Equilibrium, mass: float) -> float:
        """Return the growth rate [1/s] of the least stable mode of a rigid rotor [kg] with the pads."""
        film = at_balanced_temperature(self.reaction, at.position, at.speed)
        return float(film.at_rest().modes(at.position, at.speed, mass)[0].real)

    def rich_growth(self, at: Equilibrium, mass: float) -> tuple[float, str]:
        """Return that by the richer film at its own equilibrium, and why not to trust it."""
        moved = self.corrected(at, smooth=False)
        return float(self.rich.at_rest().modes(moved.position, at.speed, mass)[0].real), moved.doubt

    def least_film(self, bearing: pads.TiltingPadBearing, position: Array, speed: float) -> float:
        """Return the least film [m] over all pads, each in its tilt."""
        return float(bearing.at_rest().pad_states(position, speed).film_thickness.min())

    def corrected(self, at: Equilibrium, *, smooth: bool) -> Corrected:
        """Return the equilibrium of the richer film; smooth slopes are those once a turn."""
        films = self.reaction.at_rest(), self.rich.at_rest()
        resting = FilmCandidate(self.name, *films, self.rich_name, self.position_prior, self.prior)
        found = corrected(resting, at, np.array(at.load), smooth=False)
        if not smooth:
            return found
        film = self.rich.at_rest().matrices(found.position, at.speed, smooth_slopes).reduced(abs(at.speed))
        return replace(found, slopes=-np.concatenate([film.stiffness, film.damping], axis=1))


def smooth_slopes(bearing: pads.TiltingPadBearing, e: Array, w: Array) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads on a grid, the latter by differences over `STEP`."""
    return pads.differenced_slopes(bearing, e, w, STEP)


def tilting_candidates(bearing: pads.TiltingPadBearing, *, fixed: bool) -> tuple[TiltingCandidate, ...]:
    """Return the films that can answer for a bearing of tilting pads: the map if it is there, and grids.

    Parameters
    ----------
    bearing : TiltingPadBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    if fixed:
        film = bearing.film
        return (_tilting_candidate(bearing, film, pad_film_name(film), (0.0, 0.0)),)
    grids = [
        _tilting_candidate(bearing, pads.PadGridFilm(cells=cells), grid_name(cells), priors)
        for cells, priors in TILTING_GRIDS
    ]
    if not pads.is_pad_mappable(bearing.extent, bearing.slenderness):
        return tuple(grids)
    film, priors = (pads.PadMapFilm(), (2e-5, 1e-3))
    if bearing.turbulence is not None:
        film, priors = TURBULENT_MAP, (1e-3, 2e-2)
    fine = _tilting_candidate(bearing, film, "pad map", priors)
    return tuple(grids) if fine.makes_map else (fine, *grids)


def _tilting_candidate(
    bearing: pads.TiltingPadBearing, film: pads.PadFilm, name: str, priors: tuple[float, float]
) -> TiltingCandidate:
    rich, call_time = (96, 8), MAP_CALL
    if isinstance(film, pads.PadGridFilm):
        rich = 2 * film.cells[0], 2 * film.cells[1]
        call_time = LOOKS * len(bearing.pivots) * CELL_TIME * math.prod(film.cells)
    own, richer = replace(bearing, film=film), replace(bearing, film=pads.PadGridFilm(cells=rich))
    making = own.making_time()
    return TiltingCandidate(name, own, richer, grid_name(rich), *priors, making=making, call_time=call_time)


PAD_STATICS = [name for name in QUANTITIES if name != "maximum_pressure"]
"""Static quantities of pads, of which only those with recesses tell a pressure."""


# What bearings of fixed pads bring to scenes and questions.


def _all(scene: Scene) -> tuple[PadCandidate, ...]:
    return lobed_candidates(scene.table("lobed_journal").bearing(), fixed=scene.film_is_given)


LOBED = film_ladders(
    lambda scene: few_forces(_all(scene), fixed=scene.film_is_given),
    lambda scene: many_forces(_all(quasi_static_scene(scene)), fixed=scene.film_is_given),
    PAD_STATICS,
)


# What pressure dams bring to scenes and questions.


def _dam_films(scene: Scene, *, turns: bool = False) -> tuple[PadCandidate, ...]:
    scene = quasi_static_scene(scene) if turns else scene
    return dam_candidates(scene.table("pressure_dam").bearing(), fixed=scene.film_is_given, turns=turns)


PRESSURE_DAM = film_ladders(_dam_films, partial(_dam_films, turns=True), [*PAD_STATICS, "maximum_pressure"])


# Questions about tilting pads: K and C are those at the shaft's frequency.


def tilting_static_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a static quantity of tilting pads, K and C at the frequency of the shaft."""
    ladder = static_ladder(_films, scene, quantity)
    if not QUANTITIES[quantity].slopes:
        return ladder
    return replace(ladder, within=f"{ladder.within}, whirl of {abs(scene.speed):.6g} rad/s, once a turn")


def _films(scene: Scene) -> tuple[TiltingCandidate, ...]:
    return tilting_candidates(scene.table("tilting_pad").bearing(), fixed=scene.film_is_given)


# The orbit that an unbalance makes on tilting pads, which move in time with the journal.


FEW_SAMPLES = 15
"""Samples over a turn of a linear orbit."""

ORBIT_STEPS = 6
"""Newton steps that an orbit takes about."""


@dataclass(frozen=True, kw_only=True)
class StatefulOrbitRung(OrbitRung):
    """The orbit on tilting pads of one film, by its equations over a turn."""

    @property
    def points(self) -> WorkUnit:
        """The pads at one state and time, with derivatives."""
        nominal = self.film.time(1)
        return WorkUnit(f"states of {self.film.name}", ("states", self.film), nominal=nominal)

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the quantity of the orbit, from that of a lower rung if there is one."""
        bearing = self.film.reaction
        if not self.samples:
            turn, count = self._equations(bearing, FEW_SAMPLES).linear(self._rest(bearing)), FEW_SAMPLES
        else:
            start = self._rest(bearing)[:, None] if before is None else before.solution.places
            turn, count = self._equations(bearing, self.samples).orbit(start), ORBIT_STEPS * self.samples
        return RungResult(self._value(turn), {self.points: count}, turn)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
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

    def _equations(self, bearing: pads.TiltingPadBearing, samples: int) -> TurnEquations:
        return TurnEquations(self.rotor, bearing.evaluated, bearing.clearance, samples)

    def _rest(self, bearing: pads.TiltingPadBearing) -> Array:
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


TILTING = {
    **dict.fromkeys(PAD_STATICS, tilting_static_ladder),
    **dict.fromkeys(
        ORBITS, partial(orbit_ladder, lambda scene: _films(quasi_static_scene(scene)), rung=StatefulOrbitRung)
    ),
    "whirl_threshold": partial(whirl_ladder, _films, levels=False),
}
