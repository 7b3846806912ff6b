"""Turbulence in the journal bearings of a `[shaft]`: each is decided at the highest speed asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ..analysis import RotorEquilibrium, rotor_equilibrium
from ..bearings.journal import TiltLevel
from ..bearings.linear import LinearBearing
from ..bearings.seal import AnnularSeal
from ..core.port import Reaction, freedoms_of
from ..rotors import ShaftRotor
from .oil_film_tables import decided, is_left_laminar
from .shared_tables import fastest_speed

if TYPE_CHECKING:
    from .scene import Scene
    from .shaft_table import BearingTable, ShaftTable

STIFF = 1e10
"""Stiffness of bearings [N/m] by which the weight is shared out."""

OVER_SPEEDS = ("critical_speed", "whirl_threshold")
"""Questions that are asked over the speeds of a shaft."""


@dataclass(frozen=True, kw_only=True)
class JournalStation:
    """A journal bearing of a shaft under its part of the weight, with what `turbulent` takes of a scene.

    Attributes
    ----------
    scene : Scene
    name : str
        Name of the bearing.
    speed : float [rad/s]
    """

    scene: Scene
    name: str
    speed: float

    @property
    def lubricant(self) -> Any:
        """Oil of the scene."""
        return self.scene.lubricant

    @cached_property
    def static_load(self) -> tuple[float, float]:
        """Static force on the journal [N], on stiff bearings."""
        shaft: ShaftTable = self.scene.shaft
        at = on_stiff_bearings(shaft.build(), shaft.build_bearings(), self.speed)
        x, y = at.loads[self.name].tolist()[:2]
        return x, y


def on_stiff_bearings(rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float) -> RotorEquilibrium:
    """Return the equilibrium of a shaft with stiff springs in place of its bearings but seals."""
    seals = {name: one for name, one in bearings.items() if isinstance(one, AnnularSeal)}
    stiff = {
        name: seals.get(name, LinearBearing(stiffness=STIFF))
        for name, bearing in bearings.items()
        if "z" not in freedoms_of(bearing)
    }
    return rotor_equilibrium(rotor, stiff, speed)


def highest_speed(scene: Scene) -> float:
    """Return the highest speed that the scene of a shaft asks about [rad/s].

    That of its operation for a question about an orbit or a run, the last of its speeds for a critical speed
    or a threshold, and the highest of all for a scene without a question.
    """
    shaft: ShaftTable = scene.shaft
    running = 0.0 if scene.operation is None else fastest_speed(scene)
    asked = "" if scene.question is None else scene.question.quantity
    if asked and asked not in OVER_SPEEDS:
        return running
    ranged = abs(shaft.speeds.last)
    if asked:
        return ranged
    return max(running, ranged, 0.0 if shaft.compressor is None else shaft.compressor.speed)


def decided_shaft(shaft: ShaftTable, scene: Scene) -> ShaftTable:
    """Return the table of a shaft with the turbulence of each journal bearing; see `decided`.

    With the band of transition a film is laminar at all speeds below its onset.
    """
    speed = highest_speed(scene)
    found = tuple(_decided_bearing(one, scene, speed) for one in shaft.bearings)
    return shaft if found == shaft.bearings else replace(shaft, bearings=found)


def _decided_bearing(bearing: BearingTable, scene: Scene, speed: float) -> BearingTable:
    if bearing.journal is None or bearing.tilt is TiltLevel.SECOND_ORDER:
        return bearing
    own = decided(bearing.journal, JournalStation(scene=scene, name=bearing.name, speed=speed))
    return bearing if own is bearing.journal else replace(bearing, journal=own)


def left_laminar(scene: Scene, speed: float) -> tuple[str, ...]:
    """Return the names of the bearings whose films are laminar above their onset at a speed [rad/s]."""
    return tuple(
        one.name
        for one in scene.shaft.bearings
        if one.journal is not None
        and is_left_laminar(one.journal, JournalStation(scene=scene, name=one.name, speed=speed))
    )
