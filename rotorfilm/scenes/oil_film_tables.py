"""What tables of bearings with an oil film share: turbulence, a film that conserves its oil, its numbers."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ..analysis import equilibrium
from ..bearings.films.mass_conserving import require_conserved_cells
from ..bearings.films.turbulence import CLOSURES, Turbulence, onset
from ..bearings.journal import ExtrapolatedFilm, JFOFilm, JournalBearing, ReynoldsFilm
from ..bearings.oil.oil import DENSITY, TAYLOR, TURBULENT, compression, film_reynolds
from ..core.errors import InputError, RotorfilmError, SceneError, ValidityWarning, brief
from .reading import COUNTS, Keyed, Quantity, Table, choose, flag, made_from, one_of, takes
from .shared_tables import Lubricant

AUTO, NONE = "auto", "none"
"""Laminar below the onset and turbulent above it; laminar at any Reynolds number."""

QUADRATURE = "reichardt"
"""The closure that the others fit, and that costs a film no more."""

NUMBER = Quantity("1")


@takes(flag, [NUMBER, NUMBER])
def read_band(where: str, value: Any) -> bool | tuple[float, ...]:
    """Read whether there is a band of transition, or the Reynolds numbers of its edges."""
    if isinstance(value, bool):
        return value
    if not isinstance(value, list):
        raise SceneError(f"{where} must be true, false or two Reynolds numbers, got {brief(value)}")
    return tuple(NUMBER(f"{where}[{k}]", entry) for k, entry in enumerate(value))


TABLE = Table(
    Keyed(
        Turbulence,
        {"closure": one_of(CLOSURES), "band": read_band, "density": Quantity("kg/m3"), "local": flag},
    )
)

CHOICES: Mapping[str, str | Turbulence] = {
    AUTO: AUTO,
    NONE: NONE,
    **{name: Turbulence(closure=name) for name in CLOSURES},
}


@takes(CHOICES, TABLE)
def read_turbulence(where: str, value: Any) -> str | Turbulence:
    """Read "auto", "none", the name of a closure, or a table of a `Turbulence`."""
    if isinstance(value, str):
        return choose(where, value, CHOICES)
    return TABLE(where, value)


def effect_of(table: Any) -> Turbulence | None:
    """Return the turbulence of the bearing of a table; None where it is laminar or not decided yet."""
    return table.turbulence if isinstance(table.turbulence, Turbulence) else None


# Whether a scene that leaves it open is turbulent.


HOTTER = 60.0
"""Kelvins by which the oil of a film may be warmer than the supply, for a first look."""


def decided(table: Any, scene: Any) -> Any:
    """Return the table of a bearing with its turbulence where that is "auto" and the film is turbulent.

    Above the onset, at the temperature of the laminar balance. A film that is named and not on a grid stays
    laminar. A turbulence that is named has the density of the scene's oil.
    """
    choice = getattr(table, "turbulence", NONE)
    if choice == NONE or not table.has_lubricant or (choice == AUTO and not _takes(table)):
        return table
    bearing = without_oil(table.build())
    if isinstance(choice, Turbulence):
        if bearing.is_warming and not choice.local:
            raise SceneError(
                "turbulence.local must be true where the film warms, because a temperature field needs the "
                "Reynolds number of each place, got false"
            )
        return replace(table, turbulence=on_oil(choice, bearing, scene))
    return replace(table, turbulence=turbulence_of(bearing, scene)) if is_above(bearing, scene) else table


def turbulence_of(bearing: Any, scene: Any) -> Turbulence:
    """Return the turbulence of a bearing above its onset, on its oil or on that of the scene."""
    return on_oil(Turbulence(closure=QUADRATURE), bearing, scene)


def on_oil(effect: Turbulence, bearing: Any, scene: Any) -> Turbulence:
    """Return a turbulence with the density of the scene's oil, unless it or the bearing has it already."""
    density = scene.lubricant.properties.density
    own = effect.density is not None or bearing.oil is not None or density == DENSITY
    return effect if own else replace(effect, density=density)


def is_left_laminar(table: Any, scene: Any) -> bool:
    """Return whether the film of a table is laminar above its onset, as it is named or asked to be."""
    choice = getattr(table, "turbulence", None)
    if choice is None or _is_tilted(table) or (choice == AUTO and _takes(table)):
        return False
    return effect_of(table) is None and is_above(without_oil(table.build()), scene)


def is_above(bearing: Any, scene: Any) -> bool:
    """Return whether a bearing of a scene is above the onset at the temperature of its laminar balance."""
    density, speed = scene.lubricant.properties.density, scene.speed
    if not _may_be(bearing, density, speed):
        return False
    warm = warmed(bearing, scene.static_load, speed) if bearing.is_warming else bearing
    return is_turbulent_at(warm, density, speed)


def _is_tilted(table: Any) -> bool:
    """Return whether the journal of a table keeps a tilt: its film is laminar."""
    return getattr(table, "tilt", None) is not None


def _takes(table: Any) -> bool:
    if _is_tilted(table):
        return False
    film = getattr(table, "film", None)
    if film is None or isinstance(film, ReynoldsFilm) or getattr(table, "conserves", False):
        return True
    from ..bearings.pads import PadGridFilm

    return isinstance(film, PadGridFilm)


def without_oil(bearing: Any) -> Any:
    """Return the bearing of a film that conserves its oil, or any other as it is."""
    return bearing.bearing if isinstance(bearing, JFOFilm) else bearing


def _may_be(bearing: Any, density: float, speed: float) -> bool:
    """Return whether a film is turbulent, or would be with its oil hotter than it may get."""
    if not bearing.is_warming:
        return is_turbulent_at(bearing, density, speed)
    oil, cooling = bearing.cooled
    hot = min(cooling.supply_temperature + HOTTER, oil.law.temperature_range[1])
    return is_turbulent_at(bearing.at_temperature(hot), density, speed)


def is_turbulent_at(bearing: Any, density: float, speed: float) -> bool:
    """Return whether the Reynolds number of a bearing of one temperature is above the onset.

    The density [kg/m3] is that of a bearing that has a viscosity and no oil.
    """
    R, c = bearing.radius, bearing.onset_clearance
    own = bearing.film_density if bearing.oil is not None else density
    return film_reynolds(R, c, bearing.film_viscosity, own, speed).reynolds > onset(R, c)


def quick(bearing: Any) -> Any:
    """Return a bearing with a film on a coarse grid."""
    if isinstance(bearing, JournalBearing):
        return replace(bearing, film=ExtrapolatedFilm(film=ReynoldsFilm(cells=(48, 8))))
    from ..bearings import pads  # which scenes of plain bearings do without

    if isinstance(bearing, pads.PressureDamBearing):
        return replace(bearing, cells=(32, 8))
    return replace(bearing, film=pads.PadGridFilm(cells=(48, 4)))


def quiet(call: Callable[..., Any], *arguments: Any) -> Any:
    """Return what a call returns without its warnings; None where it has no answer."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            return call(*arguments)
        except RotorfilmError:
            return None


def warmed(bearing: Any, load: tuple[float, float], speed: float, by: Any = None) -> Any:
    """Return a bearing at the temperature of its balance, or of fresh oil where it has no equilibrium.

    The balance is that of the bearing `by`, by default one with a film on a coarse grid.
    """
    at = quiet(equilibrium, by or quick(bearing), load, speed)
    temperature = None if at is None else at.temperature
    return bearing.at_temperature(bearing.coldest() if temperature is None else temperature)


# What a scene says of a turbulent film.


def other_band(effect: Turbulence) -> Turbulence:
    """Return the same closure without a band of transition, or with one where there is none."""
    return replace(effect, band=effect.band is False)


def turbulent_remarks(bearing: Any, speed: float, load: tuple[float, float]) -> tuple[str, ...]:
    """Return what a scene says of a turbulent bearing: its numbers, and what the band changes."""
    effect = bearing.turbulence
    if effect is None:
        return ()
    pair = quick(bearing), replace(quick(bearing), turbulence=other_band(effect))
    own, other = (quiet(equilibrium, one, load, speed) for one in pair)
    if own is None or other is None:
        return ()
    lost, less = (float(at.losses.power_loss) for at in (own, other))
    return (
        f"turbulence: {said_of(bearing, own, speed)}; {_without(effect)} the film takes {1e-3 * less:.4g} kW "
        f"in place of {1e-3 * lost:.4g} kW, at eccentricity ratio {other.eccentricity_ratio:.3f} in place of "
        f"{own.eccentricity_ratio:.3f}",
    )


def said_of(bearing: Any, at: Any, speed: float) -> str:
    """Return Reynolds number, its range, closure and band of a bearing in an equilibrium."""
    warm = bearing if at.temperature is None else bearing.at_temperature(at.temperature)
    R, c, effect = bearing.radius, bearing.clearance, bearing.turbulence
    density = effect.density or warm.film_density
    reynolds = film_reynolds(R, c, warm.film_viscosity, density, speed).reynolds
    least, edges = at.minimum_film / c, effect.edges(R, bearing.onset_clearance)
    band = "no band of transition" if edges is None else f"band {edges[0]:.4g} to {edges[1]:.4g}"
    return (
        f"Reynolds number {reynolds:.4g}, from {least * reynolds:.3g} in the thinnest film on, onset at "
        f"{onset(R, bearing.onset_clearance):.4g}; closure {effect.closure}, {band}"
    )


def _without(effect: Turbulence) -> str:
    return "with a band" if effect.band is False else "without the band, behind which no measurement stands,"


# The films of journals, lobes, dams and tilting pads: those that conserve their oil, their numbers.


@dataclass(frozen=True, kw_only=True)
class ConservedOil:
    """`film = {name = "jfo"}`: the film that conserves its oil, which is no quasi-static law; see `JFOFilm`.

    Parameters
    ----------
    cells : tuple of int
        Cells around the film and along half the length.
    """

    cells: tuple[int, int] = (144, 12)

    def __post_init__(self) -> None:
        require_conserved_cells(self.cells)


CONSERVING: dict[str, Callable[[], Keyed[Any]]] = {
    "jfo": lambda: Keyed(ConservedOil, {"cells": COUNTS["cells"]})
}
"""`film = {name = "jfo"}` of all bearings with a film."""


class ConservingTable:
    """The table of a bearing whose film may conserve its oil; it adds `film` and `bearing`."""

    if TYPE_CHECKING:
        film: Any
        bearing: Any

    @property
    def conserves(self) -> bool:
        """Whether the film is one that conserves its oil: named so, or with keys that no other takes."""
        return isinstance(self.film, ConservedOil) or bool(self._supply_keys)

    @property
    def _supply_keys(self) -> list[str]:
        return []

    @property
    def named_film(self) -> Any:
        """The film law that the file names; None of one that conserves its oil."""
        return None if isinstance(self.film, ConservedOil) else self.film

    def require_law(self, what: str) -> None:
        """Raise InputError if the film conserves its oil: it has no force in any motion, as that takes."""
        if self.conserves:
            keys = " and ".join(self._supply_keys or ["film"])
            raise InputError(
                f"film must be a quasi-static film law (leave out {keys}) for {what}, "
                "got a mass-conserving (JFO) film"
            )

    def conserved(self, bearing: Any, cells: tuple[int, int] | None = None) -> JFOFilm:
        """Return the film of a bearing that conserves its oil, on cells that by default are the file's."""
        own = self.film if isinstance(self.film, ConservedOil) else ConservedOil()
        return made_from(JFOFilm, self, bearing=bearing, cells=cells or own.cells)

    def build(self) -> Any:
        """Return the bearing, or its film that conserves the oil; InputError for a bad value."""
        return self._built

    @cached_property
    def _built(self) -> Any:
        bearing = self.bearing()
        return self.conserved(bearing) if self.conserves else bearing


def require_law(table: Any, what: str) -> None:
    """Raise InputError if the film of any table conserves its oil, which has no force in any motion."""
    if isinstance(table, ConservingTable):
        table.require_law(what)


def film_of_cells(film: JFOFilm) -> str:
    """Return what a film that conserves its oil is called in print."""
    return f"JFOFilm(cells={film.cells})"


# Which journals the map that comes with the package holds.


TABLE_RANGE = (0.1, 4.0)
"""Length / diameter of the map that is there from the start; other bearings have to make theirs."""


def has_map(bearing: JournalBearing) -> bool:
    """Return whether the map that comes with the package holds a bearing."""
    low, high = TABLE_RANGE
    return bearing.turbulence is None and bearing.geometry.plain and low <= bearing.slenderness <= high


ATMOSPHERE = 1e5
"""Ambient pressure [Pa], as much tension as a cavity that opens at vapor pressure takes."""


def film_numbers(
    dimensions: tuple[float, float, float, float], oil: Lubricant, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the numbers of `journal_numbers` that need no film.

    Parameters
    ----------
    dimensions : (float, float, float, float) [m], [m], [m], [Pa s]
        Radius, length, clearance and viscosity.
    oil : Lubricant
    speed : float [rad/s]
    load : (float, float) [N]
    """
    (R, L, c, mu), omega = dimensions, abs(speed)
    kinematic = mu / oil.density
    compressed = compression(load, R, L, oil.bulk_modulus)
    flow = film_reynolds(R, c, mu, oil.density, omega)
    return {
        "reynolds": flow.reynolds,
        "taylor": flow.taylor,
        "turbulence": flow.turbulence,
        "taylor_limit": TAYLOR,
        "turbulent": TURBULENT,
        "inertia": omega * c**2 / kinematic,
        "peclet": omega * c**2 * oil.density * oil.heat_capacity / oil.conductivity,
        "pressure": compressed * oil.bulk_modulus / ATMOSPHERE,
        "compression": compressed,
        "mean_pressure": 1e-6 * compressed * oil.bulk_modulus,
        "tilt": 2e3 * c / L,
    }
