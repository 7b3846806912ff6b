"""The rungs of a journal film: which films can answer a scene, the cheapest first, and what is richer."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..analysis.coefficients import film_coefficients
from ..analysis.equilibrium import MAXIMUM_ECCENTRICITY
from ..bearings import journal
from ..bearings.films.law import FilmLaw
from ..bearings.reaction import InertialModel
from ..core import port
from ..core.answers import DISAGREEMENT, WorkUnit
from ..core.errors import InputError, require_vector
from ..core.model import Array
from ..core.port import largest_eccentricity_ratio, minimum_film
from ..core.results import Equilibrium
from .oil_film_tables import TABLE_RANGE, has_map

COARSE_MAP = journal.GroovedMapFilm(cells=(96, 8), nodes=(8, 48, 32))
"""Made in a fifth of the time of the map with openings, with errors some four times as large."""

ONE_NUMBER = "one Reynolds number"
"""Name of the cheapest film of a plain turbulent bearing."""

MEDIUM, FINE, FINEST = (192, 16), (384, 16), (768, 32)


def film_rungs(bearing: journal.JournalBearing, *, fixed: bool) -> tuple[FilmRung, ...]:
    """Return the films that can answer for a bearing, the cheapest first.

    Parameters
    ----------
    bearing : JournalBearing
    fixed : bool
        Whether the scene names the film of the bearing, so that no other may answer.
    """
    plain, tabulated = bearing.geometry.plain, has_map(bearing)
    if fixed:
        rungs = _named(bearing, tabulated)
    elif tabulated:
        rungs = [_map(bearing), *_plain_films(bearing, tabulated), *_grids(bearing, tabulated)]
    elif bearing.turbulence is not None and plain:
        rungs = [*_one_number(bearing), *_grids(bearing, tabulated)]
    elif plain:
        low, high = journal.MapFilm().slenderness_range
        own = [_map(bearing)] if low <= bearing.slenderness <= high else []
        rungs = [*_plain_films(bearing, tabulated), *_grids(bearing, tabulated), *own]
    else:
        maps = _grooved_maps(bearing)
        ready = [film for film in maps if not film.makes_map]
        rungs = [*ready, *_grids(bearing, tabulated), *(film for film in maps if film.makes_map)]
    return tuple(rungs)


def point_films(bearing: journal.JournalBearing, *, fixed: bool) -> tuple[FilmRung, ...]:
    """Return the films for some equilibria: a map that must be made first costs more than any grid."""
    films = film_rungs(bearing, fixed=fixed)
    return tuple(film for film in films if fixed or not film.makes_map)


def turn_films(
    bearing: journal.JournalBearing, *, fixed: bool, grids: tuple[tuple[int, int], ...], maps: bool
) -> tuple[FilmRung, ...]:
    """Return the films for states all round a turn: the map that is there, else the short film and grids.

    Parameters
    ----------
    bearing : JournalBearing
    fixed : bool
        Whether the scene names the film of the bearing.
    grids : tuple of (int, int)
        Cells of the grids worth taking.
    maps : bool
        Whether a map that must be made first is worth it.
    """
    films = tuple(_with_coarser_check(film) for film in film_rungs(bearing, fixed=fixed))
    if fixed:
        return films
    if films[0].bounded and not films[0].makes_map:
        return films[:1]
    return tuple(film for film in films if _is_kept(film, grids, maps=maps))


def _is_kept(film: FilmRung, grids: tuple[tuple[int, int], ...], *, maps: bool) -> bool:
    law = film.reaction.film
    on_grid = isinstance(law, journal.ExtrapolatedFilm) and law.film.cells in grids
    return (
        on_grid
        or isinstance(law, journal.ShortFilm)
        or (maps and isinstance(law, journal.MapFilm | journal.GroovedMapFilm))
    )


def _with_coarser_check(film: FilmRung) -> FilmRung:
    """Return a rung whose map is compared with a grid that may be sampled all round a turn."""
    if not film.bounded:
        return film
    return replace(film, rich=extrapolated(film.reaction, FINE), rich_name=grid_name(FINE))


def extrapolated(bearing: journal.JournalBearing, cells: tuple[int, int]) -> journal.JournalBearing:
    """Return the bearing with the film in two dimensions, extrapolated from two grids."""
    own = getattr(bearing.film, "mobility", None)
    grid = journal.ReynoldsFilm(cells=cells, mobility=own)
    return journal.fitted_bearing(bearing, journal.ExtrapolatedFilm(film=grid))


def _map(bearing: journal.JournalBearing) -> FilmRung:
    rung = _rung("map", bearing, journal.MapFilm(), _rich(False, FINEST), (1e-6, 1e-4), bounded=True)
    return rung if has_map(bearing) else replace(rung, making=MAP_MADE.nominal)


def _one_number(bearing: journal.JournalBearing) -> list[FilmRung]:
    """Return the film of one Reynolds number, from the laminar map; none where that is too long for it."""
    effect, (low, high) = bearing.turbulence, TABLE_RANGE
    if effect is None or not (effect.local and 2.0 * low <= bearing.slenderness <= high):
        return []
    whole = replace(bearing, turbulence=replace(effect, local=False))
    film = journal.fitted_bearing(whole, journal.MapFilm())
    rich = extrapolated(bearing, MEDIUM)
    return [FilmRung(ONE_NUMBER, film, rich, grid_name(MEDIUM), 0.1, 0.1)]


def _grooved_maps(bearing: journal.JournalBearing) -> list[FilmRung]:
    """Return the maps of a bearing with openings: a coarse one too, where the fine one is to be made."""
    low, high = journal.GroovedMapFilm().slenderness_range
    if not (journal.is_mappable(bearing.geometry) and low <= bearing.slenderness <= high):
        return []
    if bearing.turbulence is not None:
        return [_opened("map with grooves", bearing, journal.GroovedMapFilm(), (1e-3, 3e-2))]
    fine = _opened("map with grooves", bearing, journal.GroovedMapFilm(), (1e-5, 1e-3))
    coarse = _opened("coarse map with grooves", bearing, COARSE_MAP, (3e-4, 5e-3))
    return [coarse, fine] if fine.makes_map else [fine]


def _opened(
    name: str, bearing: journal.JournalBearing, film: journal.GroovedMapFilm, priors: tuple[float, float]
) -> FilmRung:
    rung = _rung(name, bearing, film, _rich(False, FINE), priors)
    return replace(rung, making=_making_time(rung.reaction))


def _making_time(bearing: journal.JournalBearing) -> float:
    """Return about how long the map with openings of a bearing takes [s]; 0 where it is there."""
    film = bearing.fitted_film
    return film.making_time(bearing.slenderness) if isinstance(film, journal.GroovedMapFilm) else 0.0


def _plain_films(bearing: journal.JournalBearing, tabulated: bool) -> list[FilmRung]:
    """Return films of closed form: they are for bearings without openings."""
    slim = min(bearing.slenderness**2, 1.0)
    arc, rich = journal.RotatingArc(), _rich(tabulated, FINE)
    return [
        _rung("short film", bearing, journal.ShortFilm(), rich, (0.1 * slim, 0.1 * slim)),
        *(
            _rung(
                f"splitting ({n}, all)",
                bearing,
                journal.SplittingFilm(order=(n, None), rupture=arc),
                rich,
                priors,
            )
            for n, priors in ((2, (2e-3, 5e-3)), (6, (1e-3, 3e-3)))
        ),
    ]


def _grids(bearing: journal.JournalBearing, tabulated: bool) -> list[FilmRung]:
    rich = _rich(tabulated, MEDIUM)
    coarse = _rung("2-D 48 x 4", bearing, journal.ReynoldsFilm(cells=(48, 4)), rich, (1e-3, 1e-3))
    levels = (
        ((48, 8), FINE, (3e-5, 1e-3)),
        ((96, 8), FINE, (5e-6, 3e-4)),
        ((192, 16), FINEST, (1e-6, 1e-4)),
        ((384, 16), FINEST, (5e-7, 5e-5)),
    )
    films = [journal.ExtrapolatedFilm(film=journal.ReynoldsFilm(cells=cells)) for cells, *_ in levels]
    finer = [
        _rung(grid_name(cells), bearing, film, _rich(tabulated, above), priors)
        for film, (cells, above, priors) in zip(films, levels, strict=True)
    ]
    if not tabulated:  # the free arc is found for length / diameter .1 to 4
        return [coarse, *finer]
    free = journal.SplittingFilm(order=(6, None), constant=True, rupture=journal.ComplementarityArc())
    arc = _rung("free arc (6+c, all)", bearing, free, _rich(tabulated, FINE), (1e-5, 1e-4))
    return [coarse, *finer[:2], arc, *finer[2:]]


def _named(bearing: journal.JournalBearing, tabulated: bool) -> list[FilmRung]:
    """Return the rung of a scene that names its film, after a coarser map of it where that is made sooner."""
    film, mapped = bearing.fitted_film, isinstance(bearing.fitted_film, journal.MapFilm)
    fine = mapped or (isinstance(film, journal.ReynoldsFilm) and film.cells[0] > 96)
    rich = _rich(tabulated and not mapped, FINEST if fine else FINE)
    rung = _rung(journal.film_name(film), bearing, bearing.film, rich, (0.0, 0.0), bounded=mapped)
    rung = replace(rung, making=_making_time(rung.reaction))
    if not (rung.makes_map and film == journal.GroovedMapFilm(geometry=bearing.geometry)):
        return [rung]
    return [_opened(journal.film_name(COARSE_MAP), bearing, COARSE_MAP, (0.0, 0.0)), rung]


def _rich(tabulated: bool, cells: tuple[int, int]) -> tuple[tuple[int, int] | None, str]:
    """Return the cells of the richer film, None for the map where there is one, and its name."""
    return (None, "map") if tabulated else (cells, grid_name(cells))


def grid_name(cells: tuple[int, int]) -> str:
    """Return the name of a film in two dimensions that is extrapolated from two grids."""
    return f"2-D {cells[0]} x {cells[1]} extr."


def _rung(
    name: str,
    bearing: journal.JournalBearing,
    film: FilmLaw,
    rich: tuple[tuple[int, int] | None, str],
    priors: tuple[float, float],
    bounded: bool = False,
) -> FilmRung:
    (cells, rich_name), grid, own = rich, grid_of(film), journal.fitted_bearing(bearing, film)
    richer = (
        journal.fitted_bearing(bearing, journal.MapFilm()) if cells is None else extrapolated(bearing, cells)
    )
    time = CALL_TIME if grid is None else CELL_TIME * math.prod(grid.cells)
    return FilmRung(name, own, richer, rich_name, *priors, bounded=bounded, call_time=time)


def grid_of(film: FilmLaw) -> journal.ReynoldsFilm | None:
    """Return the film in two dimensions that a law is, or is extrapolated from; None of any other."""
    own = film.film if isinstance(film, journal.ExtrapolatedFilm) else film
    return own if isinstance(own, journal.ReynoldsFilm) else None


# A candidate of films: one that may answer, and the richer one that its defect is sampled with.


MAP_MADE = WorkUnit("maps made", nominal=20.0)
"""WorkUnit of the work of making a map."""

CELL_TIME, CALL_TIME = 4e-7, 1e-5
"""About what a force with derivatives takes for each cell of a grid, and in closed form or by a map [s]."""


@dataclass(frozen=True)
class FilmCandidate:
    """A film that may answer, and the richer one that its defect is sampled with.

    A family adds `on_grid`, and bounds and wedges of its own.

    Attributes
    ----------
    name : str
    reaction : PlanarReaction
        The bearing with this film.
    rich : PlanarReaction
        With the richer one.
    rich_name : str
        Name of the richer film.
    position_prior, prior : float [1]
        Orders of magnitude of the error of a position, and of stiffness and damping; 0 if unknown.
    bounded : bool
        Whether the error has one verified bound in any motion.
    making : float [s]
        About how long the map takes that its first force makes; 0 where there is none to make.
    call_time : float [s]
        About what a force with derivatives takes.
    """

    name: str
    reaction: Any
    rich: Any
    rich_name: str
    position_prior: float
    prior: float
    bounded: bool = False
    making: float = 0.0
    call_time: float = CALL_TIME

    bound_name: ClassVar[str] = "verified bound of the map"
    """How `rest_bound` is known."""

    @property
    def makes_map(self) -> bool:
        """Whether its first force makes a map."""
        return self.making > 0.0

    @property
    def map_made(self) -> WorkUnit:
        """The work of making its map."""
        return WorkUnit(MAP_MADE.name, ("map", self.reaction), nominal=self.making)

    def at_temperature(self, temperature: float) -> Self:
        """Return the candidate with films of an oil at one temperature [K]."""
        own, rich = (one.at_temperature(temperature) for one in (self.reaction, self.rich))
        return replace(self, reaction=own, rich=rich)

    def frozen(self, film: Any) -> Self:
        """Return the candidate with the bearing replaced by a film that keeps its temperature."""
        return replace(self, reaction=film, bounded=False, making=0.0)

    def time(self, tangents: int) -> float:
        """Return about how long so many forces with derivatives take, with the map that is to be made [s]."""
        return self.making + tangents * self.call_time

    def prepare(self) -> dict[WorkUnit, int]:
        """Make what the first force would make, and return the work of that."""
        if not self.makes_map:
            return {}
        self.reaction.force([0.5 * minimum_radial_clearance(self.reaction), 0.0], [0.0, 0.0], 1.0)
        return {self.map_made: 1}

    def expected(self, tangents: int) -> dict[WorkUnit, int]:
        """Return the work of so many forces with derivatives."""
        return {self.tangents: tangents, **({self.map_made: 1} if self.makes_map else {})}

    @property
    def tangents(self) -> WorkUnit:
        """One force with derivatives; not to be tried where it would make a map."""
        about = CALL_TIME if self.makes_map else math.nan
        return WorkUnit(f"tangents of {self.name}", ("tangents", self.reaction), nominal=about)

    def defects(self, *, smooth: bool) -> WorkUnit:
        """Return the unit of the defects that correct one state, with exact or with smooth slopes."""
        name = f"defects{' and slopes' if smooth else ''} of {self.rich_name}"
        return WorkUnit(name, ("defects", smooth, self.rich))

    @property
    def has_losses(self) -> bool:
        """Whether power loss and flow of oil are known."""
        return True

    def with_pressure(self) -> Self | None:
        """Return the candidate if both films know their pressure, else None."""
        return self if has_pressure(self.reaction) and has_pressure(self.rich) else None

    def units(self, speed: float) -> dict[WorkUnit, Callable[[], object]]:
        """Return calls that do one unit of its work, at half the clearance."""
        own = self.reaction
        x, y = 0.3 * minimum_radial_clearance(own), 0.4 * minimum_radial_clearance(own)
        defects = {self.defects(smooth=k): one_defect(self, speed, smooth=k) for k in (False, True)}
        return {self.tangents: lambda: port.prepared_tangent(own)(x, y, 0.0, 0.0, speed), **defects}

    def batch_units(self, speed: float) -> dict[WorkUnit, Callable[[], object]]:
        """Return the same for states all round a turn."""
        position, still = np.array([0.3, 0.4]) * minimum_radial_clearance(self.reaction), np.zeros(2)

        def sampled(reaction: port.PlanarReaction) -> Callable[[], object]:
            return lambda: (reaction.force(position, still, speed), reaction.jacobian(position, still, speed))

        return {self.tangents: sampled(self.reaction), self.defects(smooth=False): sampled(self.rich)}

    def asked(self, equilibria: int = 1) -> tuple[Any, Callable[[], dict[WorkUnit, int]]]:
        """Return the bearing to solve with, and a call for the work of that; of about so many equilibria."""
        made, counted = self.prepare(), counted_calls(self.reaction)
        return counted, lambda: {self.tangents: counted.tangents, **made}

    def judged(self, *, smooth: bool, defects: int, tangents: int = 2) -> dict[WorkUnit, int]:
        """Return the work of an estimate by so many defects and tangents."""
        return {self.defects(smooth=smooth): defects, self.tangents: tangents}

    @property
    def speed_prior(self) -> float:
        """Order of magnitude of the error of a threshold."""
        return 0.3 * self.prior

    @property
    def is_close(self) -> bool:
        """Whether it is close enough to say that something does not exist."""
        return self.bounded or self.on_grid(self.reaction)

    def growth(self, at: Equilibrium, mass: float) -> float:
        """Return the growth rate [1/s] of the least stable whirl of a rigid rotor [kg] at an equilibrium."""
        return whirl_growth(film_coefficients(self.reaction, at.position, at.speed), mass)

    def rich_growth(self, at: Equilibrium, mass: float) -> tuple[float, str]:
        """Return that by the richer film at its own equilibrium, and why not to trust it."""
        moved = self.corrected(at, smooth=True)
        own = whirl_matrix(film_coefficients(self.reaction, at.position, at.speed), mass)
        first_order, exact = growths(own, whirl_matrix(moved, mass))
        if abs(first_order - exact) > DISAGREEMENT * abs(exact):
            doubt = "the perturbed eigenvalue disagrees with the exact one: not linear"
            return exact, moved.doubt or doubt
        return exact, moved.doubt

    def corrected(self, at: Equilibrium, *, smooth: bool) -> Corrected:
        """Return the equilibrium of the richer film as far as its defect tells."""
        return corrected(self, at, np.array(at.load), smooth=smooth)

    def least_film(self, bearing: Any, position: Array, speed: float) -> float:
        """Return the least film [m] in one of both bearings."""
        return float(minimum_film(bearing, position))

    def on_grid(self, bearing: Any) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        raise NotImplementedError

    def curvature_distance(self, position: Array) -> float:
        """Return the distance [m] by which the wedge of a journal at a position (2,) [m] is measured."""
        return float(np.hypot(*position))

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified bound of its error at rest at an eccentricity ratio; infinite without one."""
        return math.inf

    def rest_bound(self, at: Equilibrium, *, slopes: bool) -> float:
        """Return the verified bound of its error in an equilibrium; infinite without one.

        Of the force, relative to the load, or with `slopes` of K and C.
        """
        return self.bound(at.eccentricity_ratio, slopes=slopes)

    def loss_bound(self, eccentricity_ratio: float) -> float:
        """Return the same of power loss and side flow, at an eccentricity ratio."""
        return math.inf

    def motion_bound(self, amplitude: float) -> float:
        """Return the verified bound of K and C in motions as far as a distance / clearance, or infinity."""
        return math.inf

    @property
    def supply_temperature(self) -> float:
        """Of the fresh oil [K]; 0 without one."""
        cooling = getattr(self.reaction, "cooling", None)
        return 0.0 if cooling is None else float(cooling.supply_temperature)


def any_candidate(film: Any) -> FilmCandidate:
    """Return a film as a candidate of which nothing is known beforehand."""
    return FilmCandidate("", film, film, "", 0.0, 0.0)


def with_losses(films: Sequence[FilmCandidate], wanted: str) -> tuple[Any, ...]:
    """Return the films whose losses are known; InputError where there is none, as they are wanted."""
    known = tuple(film for film in films if film.has_losses)
    if known:
        return known
    raise InputError(f"film must be a law with losses for {wanted}, as map or reynolds, got {films[0].name}")


def with_pressures(films: Sequence[FilmCandidate], wanted: str) -> tuple[Any, ...]:
    """Return the films whose pressure is known, as their richer ones'; InputError where there is none."""
    known = tuple(film for one in films if (film := one.with_pressure()) is not None)
    if known:
        return known
    raise InputError(f"film must have a pressure for {wanted}, such as reynolds, got {films[0].name}")


def has_pressure(bearing: Any) -> bool:
    """Return whether the film of a bearing knows its pressure, place by place."""
    if isinstance(bearing, journal.JournalBearing):
        return isinstance(
            bearing.film, journal.ReynoldsFilm | journal.ExtrapolatedFilm | journal.SplittingFilm
        )
    return isinstance(bearing, journal.JFOFilm) or hasattr(bearing, "pressure")


def maximum_pressure(bearing: Any, position: Array, speed: float) -> float:
    """Return the largest pressure [Pa] in the film of a bearing, its journal at rest at a position (2,) [m].

    That at a node of its grid, the finer one of an extrapolated film; of pads the largest on any of them.
    """
    if isinstance(bearing, journal.JFOFilm):
        return float(np.max(bearing.solve(position, speed).pressure))
    if not isinstance(bearing, journal.JournalBearing):
        pressures = (bearing.pressure(k, position, np.zeros(2), speed) for k in range(len(bearing.pads)))
        return max(float(np.max(one.pressure)) for one in pressures)
    law = replace(bearing, film=grid_of(bearing.film) or bearing.film)
    found = journal.film_state(law, position, np.zeros(2), speed).maximum_pressure
    assert found is not None  # see `has_pressure`
    return found


# The whirl of a rigid rotor on K and C.


def whirl_matrix(found: Any, mass: float) -> Array:
    """Return the matrix (4, 4) of a rigid rotor [kg] on coefficients, of positions and velocities."""
    zero, one = np.zeros((2, 2)), np.eye(2)
    return np.block([[zero, one], [-found.stiffness / mass, -found.damping / mass]])


def whirl_growth(found: Any, mass: float) -> float:
    """Return the growth rate of the least stable whirl on coefficients [1/s]."""
    return float(np.max(np.linalg.eigvals(whirl_matrix(found, mass)).real))


def least_stable(matrix: Array) -> tuple[complex, port.Complex, port.Complex]:
    """Return the eigenvalue with the largest real part, its left and its right vector, left right = 1."""
    values, right = np.linalg.eig(matrix)
    k = int(np.argmax(values.real + 1e-12 * np.abs(values.imag)))
    return complex(values[k]), np.linalg.inv(right)[k], right[:, k]


def growths(own: Array, other: Array) -> tuple[float, float]:
    """Return the growth rate [1/s] that the least stable mode of `own` has in `other`: first order, exact.

    With the right and left eigenvectors r, l of a mode the first order of its change is l (other - own) r.
    """
    value, left, right = least_stable(own)
    shifted = value + left @ (other - own) @ right
    exact = np.linalg.eigvals(other)
    return float(shifted.real), float(exact[np.argmin(np.abs(exact - shifted))].real)


# A journal at rest, of which quantities are functions.


class JournalEquilibrium:
    """A journal at rest on a film, of which quantities are functions.

    It adds its equilibrium `at`, K and C, losses and temperatures.
    """

    at: Equilibrium

    @property
    def eccentricity_ratio(self) -> float:
        """Distance from the center of the bearing / clearance."""
        return self.at.eccentricity_ratio

    @property
    def attitude_angle(self) -> float:
        """Angle from the load [rad], in the sense of rotation."""
        return self.at.attitude_angle

    @property
    def minimum_film(self) -> float:
        """Least film [m]."""
        return self.at.minimum_film


@dataclass(frozen=True, kw_only=True, eq=False)
class FilmRest(JournalEquilibrium):
    """A journal at or near its equilibrium on a film that may answer, or on the richer one.

    Attributes
    ----------
    at : Equilibrium
        Of the film that may answer.
    film : FilmCandidate
    bearing : PlanarReaction
        Bearing with one of both films.
    position : ndarray, shape (2,) [m]
    matrices : callable
        Returns K and C there.
    """

    at: Equilibrium
    film: FilmCandidate
    bearing: Any
    position: Array
    matrices: Callable[[], Any]

    @property
    def coefficients(self) -> Any:
        """K and C."""
        return self.matrices()

    @property
    def eccentricity_ratio(self) -> float:
        """Distance from the center of the bearing / clearance."""
        return float(np.hypot(*self.position)) / float(self.bearing.clearance)

    @property
    def attitude_angle(self) -> float:
        """Angle from the load [rad], in the sense of rotation."""
        return attitude(self.position, self.at.load, self.at.speed)

    @property
    def minimum_film(self) -> float:
        """Least film [m]."""
        return self.film.least_film(self.bearing, self.position, self.at.speed)

    @property
    def losses(self) -> Any:
        """Power loss and flow of oil."""
        return self.bearing.losses(self.position, np.zeros(2), self.at.speed)

    @property
    def temperature(self) -> float:
        """At which the heat of the film balances [K]."""
        return float(self.bearing.balanced_temperature(self.position, np.zeros(2), self.at.speed))

    @property
    def maximum_temperature(self) -> float:
        """That of a film of one temperature [K]."""
        return self.temperature

    @property
    def maximum_pressure(self) -> float:
        """Largest pressure in the film [Pa]."""
        return maximum_pressure(self.bearing, self.position, self.at.speed)


def attitude(position: Array, load: Array, speed: float) -> float:
    """Return the angle [rad] from a load [N] to a position (2,) [m], in the sense of rotation."""
    (x, y), (load_x, load_y) = position, load
    turned = math.atan2(load_x * y - load_y * x, load_x * x + load_y * y)
    return math.copysign(1.0, speed) * turned


def minimum_radial_clearance(bearing: port.PlanarReaction) -> float:
    """Return how far a journal may go from the center in any direction [m]."""
    return float(minimum_film(bearing, np.zeros(2)))


# One rung of a journal film: a bearing with a film that may answer, what it costs, and its error.


MAP_BOUNDS = ((0.95, 2e-5, 1e-3), (0.999, 4e-4, math.inf))
"""Eccentricity ratio up to which, and largest error of a position and of K, C there: docs/accuracy.md."""

LOSS_BOUNDS = ((0.95, 1e-3), (0.99, 3e-3))
"""Eccentricity ratio up to which, and largest error of power loss and side flow there: docs/accuracy.md."""


@dataclass(frozen=True)
class FilmRung(FilmCandidate):
    """A film that may answer for a journal bearing.

    The verified bound of `bounded` ones is `MAP_BOUNDS`; maps with openings have one at rest.

    Attributes
    ----------
    reaction : JournalBearing
        Reaction with this film.
    rich : JournalBearing
        With the richer one.
    """

    reaction: journal.JournalBearing
    rich: journal.JournalBearing

    @property
    def has_losses(self) -> bool:
        """Whether its law knows power loss and flow of oil."""
        return journal.has_losses(self.reaction)

    def with_pressure(self) -> FilmRung | None:
        """Return the candidate beside a richer film on a grid, as a map knows no pressure."""
        if not has_pressure(self.reaction):
            return None
        grid = grid_of(self.reaction.film)
        fine = grid is not None and math.prod(grid.cells) >= math.prod(MEDIUM)
        cells = FINEST if fine else FINE
        return replace(self, rich=extrapolated(self.reaction, cells), rich_name=grid_name(cells))

    def on_grid(self, bearing: journal.JournalBearing) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        return isinstance(bearing.film, journal.ReynoldsFilm | journal.ExtrapolatedFilm)

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified bound of its error at rest at an eccentricity ratio; infinite without one."""
        if self.bounded:
            for amplitude, position, slope in MAP_BOUNDS:
                if eccentricity_ratio <= amplitude:
                    return slope if slopes else position
        film = self.reaction.fitted_film if isinstance(self.reaction, journal.JournalBearing) else None
        if isinstance(film, journal.GroovedMapFilm):
            return film.built_table(self.reaction.slenderness).bound(eccentricity_ratio, slopes=slopes)
        return math.inf

    def loss_bound(self, eccentricity_ratio: float) -> float:
        """Return the same of power loss and side flow."""
        within = (bound for amplitude, bound in LOSS_BOUNDS if eccentricity_ratio <= amplitude)
        return next(within, math.inf) if self.bounded else math.inf

    def motion_bound(self, amplitude: float) -> float:
        """Return the verified bound of K and C in motions as far as a distance / clearance, or infinity."""
        return MAP_BOUNDS[0][2] if self.bounded and amplitude <= MAP_BOUNDS[0][0] else math.inf


# What the richer film of a candidate makes of an equilibrium: its tangent there, and a few linear steps.


STEP = 0.05
"""Step of differences of a two-dimensional film in its source, relative to the wedge; less in a thin film.

Its own derivative in the source belongs to cells that are full or empty, and jumps when one changes sides;
a difference over many such jumps does not. The pressure at the wall is as wide as the square root of the gap,
and so is the squeeze, relative to the wedge, that moves its edge.
"""

NEUTRAL = 1e-9
"""Stiffness in one direction over that in the other below which it is none: where one tilting pad carries."""


def tangent(
    bearing: port.PlanarReaction,
    position: Array,
    speed: float,
    *,
    smooth: bool,
    curvature_distance: float | None = None,
) -> tuple[Array, Array]:
    """Return force (2,) [N] at rest, and d force/d(x, y, vx, vy) (2, 4).

    Parameters
    ----------
    bearing : PlanarReaction
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    smooth : bool
        Whether the derivatives in the source are taken from differences, `STEP`: of a film on a grid.
    curvature_distance : float [m]
        Curvature distance by which the wedge is measured; None for the distance from the center.
    """
    rest = np.zeros(2)
    slopes = bearing.jacobian(position, rest, speed)[:, :4]
    if not smooth:
        return bearing.force(position, rest, speed), slopes
    distance = float(np.hypot(*position)) if curvature_distance is None else curvature_distance
    thin = math.sqrt(port.relative_film(bearing, position))
    rate = STEP * min(1.0, 2.0 * thin) * 0.5 * abs(speed) * distance
    velocities = rate * np.concatenate([np.zeros((2, 1)), *(k * np.eye(2) for k in (-2, -1, 1, 2))], axis=1)
    force = bearing.force(np.repeat(position[:, None], 9, axis=1), velocities, np.full(9, speed))
    low2, low, high, high2 = np.split(force[:, 1:], 4, axis=1)
    by_velocity = (low2 - 8.0 * low + 8.0 * high - high2) / (12.0 * rate)
    # The wedge moves with the journal, w = v/c - (speed/2) z^ x e, so its share follows.
    change = by_velocity - slopes[:, 2:]
    by_position = slopes[:, :2] - 0.5 * speed * np.stack([change[:, 1], -change[:, 0]], axis=1)
    return force[:, 0], np.concatenate([by_position, by_velocity], axis=1)


@dataclass(frozen=True, kw_only=True)
class Corrected:
    """Where the richer film would have its equilibrium, by one linear step from another's.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    slopes : ndarray, shape (2, 4)
        d force/d(x, y, vx, vy) of the richer film there.
    doubt : str
        Why it must not be trusted.
    """

    position: Array
    slopes: Array
    doubt: str

    @property
    def stiffness(self) -> Array:
        """Stiffness [N/m]."""
        return -self.slopes[:, :2]

    @property
    def damping(self) -> Array:
        """Damping [N s/m]."""
        return -self.slopes[:, 2:]


def corrected(film: FilmCandidate, at: Equilibrium, load: Array, *, smooth: bool) -> Corrected:
    """Return the equilibrium of the richer film as far as its defect tells.

    With the defect d = F_rich + W at the equilibrium of the cheap film the position moves by K^-1 d; two more
    defects there, with the same K, take out what is of second and third order. The first step is tried with
    both films' K: where the results disagree by more than 30 % it is too long to be linear. The slopes are
    those of the richer film where that ends.
    """
    force, rich = tangent(film.rich, at.position, at.speed, smooth=False)
    cheap = film.reaction.jacobian(at.position, np.zeros(2), at.speed)[:, :4]
    step, other = (_step(slopes, force + load) for slopes in (rich, cheap))
    doubt = ""
    gap, longest = float(np.hypot(*(step - other))), float(max(np.hypot(*step), np.hypot(*other)))
    if gap > DISAGREEMENT * longest:
        doubt = f"the stiffnesses of both films disagree on the error by {gap / longest:.0%}: not linear"
    position = at.position
    for further in range(3):
        if further:
            step = _step(rich, film.rich.force(position, np.zeros(2), at.speed) + load)
        position = position + step
        if float(minimum_film(film.rich, position)) <= (1.0 - MAXIMUM_ECCENTRICITY) * film.rich.clearance:
            return Corrected(position=at.position, slopes=rich, doubt="the error is larger than the gap")
    slopes = rich_tangent(film, position, at.speed)[1] if smooth else rich
    return Corrected(position=position, slopes=slopes, doubt=doubt)


def _step(slopes: Array, force: Array) -> Array:
    """Return by how much a force (2,) [N] moves the journal, least where nothing holds it in a direction."""
    return np.asarray(np.linalg.lstsq(-slopes[:, :2], force, rcond=NEUTRAL)[0])


def rich_tangent(film: FilmCandidate, position: Array, speed: float) -> tuple[Array, Array]:
    """Return force and slopes of the richer film, smooth where it lives on a grid."""
    smooth = film.on_grid(film.rich)
    return tangent(
        film.rich, position, speed, smooth=smooth, curvature_distance=film.curvature_distance(position)
    )


def one_defect(film: FilmCandidate, speed: float, *, smooth: bool) -> Callable[[], object]:
    """Return a call that does the work of `corrected` for one candidate."""
    bearing = film.rich
    position = np.array([0.3, 0.4]) * minimum_radial_clearance(bearing)

    def one() -> None:
        tangent(bearing, position, speed, smooth=False)
        for _ in range(2):
            bearing.force(position, np.zeros(2), speed)
        if smooth:
            rich_tangent(film, position, speed)

    return one


# A reaction that counts its evaluations: the work of a rung.


class Counted(InertialModel):
    """A static reaction, and how many forces and tangents it was asked for.

    Parameters
    ----------
    reaction : PlanarReaction
        Reaction without states.
    """

    def __init__(self, reaction: port.PlanarReaction) -> None:
        self._reaction = reaction
        self.forces = 0
        self.tangents = 0

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return self._reaction.clearance

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the reaction is meant."""
        return largest_eccentricity_ratio(self._reaction)

    @property
    def nominal_force(self) -> float:
        """Nominal force [N]."""
        return self._reaction.outputs[0].nominal

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force (2, ...) [N], one count for each state."""
        result = self._reaction.force(position, velocity, speed)
        self.forces += int(np.prod(result.shape[1:], dtype=int))
        return result

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d force/d(x, y, vx, vy, speed) (2, 5, ...), one count for each state."""
        result = self._reaction.jacobian(position, velocity, speed)
        self.tangents += int(np.prod(result.shape[2:], dtype=int))
        return result

    prepared_force, prepared_jacobian = force, jacobian

    @property
    def has_inertia(self) -> bool:
        """Whether the reaction has an added mass, which comes with its forces."""
        return port.inertial(self._reaction) is not None

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass [kg], shape (2, 2, ...)."""
        return self._reaction.mass(position, velocity, speed)  # type: ignore[attr-defined]

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""
        return self._reaction.mass_slopes(position, velocity, speed)  # type: ignore[attr-defined]

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the inertia of the reaction ends, at a frequency [rad/s]."""
        heavy = port.inertial(self._reaction)
        if heavy is not None:
            heavy.require_range(frequency)

    def prepare_tangent(self) -> port.Tangent:
        """Return force and derivatives as a function of five numbers."""
        call = port.prepared_tangent(self._reaction)

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            self.tangents += 1
            return call(x, y, vx, vy, speed)

        return tangent


class WorkCountingWalledReaction(Counted):
    """The same of a reaction that says itself where its journal touches."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film [m], shape (...), of journals at positions (2, ...) [m]."""
        return minimum_film(self._reaction, require_vector("position", position))


def counted_calls(reaction: port.PlanarReaction) -> Counted:
    """Return a reaction that counts its evaluations."""
    return (WorkCountingWalledReaction if port.has_wall(reaction) else Counted)(reaction)
