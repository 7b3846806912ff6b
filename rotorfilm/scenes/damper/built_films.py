"""The films of a damper with seals or inertia as rungs: without and with inertia, short and finite.

Each is judged by orbits and motions of the richest film beside what that leaves out itself: the second order
of the inertia, the edge of a ruptured film that it moves, oil that runs around between seals.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from ...bearings.damper import (
    FiniteMapSqueeze,
    FiniteSqueeze,
    JudgedDamper,
    MapSqueeze,
    PorousDamper,
    ShortSqueeze,
    SqueezeLaw,
)
from ...bearings.films.cavitation import FullFilm
from ...errors import InputError
from ...rotors import RigidRotor
from .damper_films import DEFECT_CELLS, AnyDamperFilm, DamperFilm, damper_films, quiet, with_changes
from .damper_table import DamperTable

NO_INERTIA = ", no inertia"


@dataclass(frozen=True, kw_only=True)
class BuiltDamperFilm(DamperFilm):
    """A film between seals, or with inertia, that may answer.

    Attributes
    ----------
    speed : float [rad/s]
        Of the rotor, with which it whirls.
    """

    speed: float

    def bound(self, eccentricity_ratio: float = 0.0, *, slopes: bool = False) -> float:
        """Return infinity: what it leaves out is estimated, not bounded."""
        return math.inf

    @cached_property
    def rich(self) -> JudgedDamper:
        """The damper with the richest film, and what that leaves out."""
        damper = with_changes(self.rich_shape, film=self.rich_law)
        return JudgedDamper(damper=damper, frequency=abs(self.speed))

    @cached_property
    def moving(self) -> PorousDamper:
        """The damper on the map of its film, where it has one."""
        law = MapSqueeze() if isinstance(self.law, ShortSqueeze) else self.law
        return with_changes(self.shape, film=law)

    @cached_property
    def rich_moving(self) -> JudgedDamper:
        """The same as on orbits."""
        return self.rich


def orbit_films(table: DamperTable, rotor: RigidRotor) -> tuple[AnyDamperFilm, ...]:
    """Return the films that can answer for the orbits of a rotor at one speed, the cheapest first.

    Raises
    ------
    InputError
        If the rotor is held off the center, the supply differs around the damper, or the inertia of the oil
        is no model at this speed.
    """
    if any(table.offset):
        raise InputError(
            "offset must be left out for a question about circular orbits, which are centered: a run, or "
            f"blade_loss_peak, has it, got {table.offset!r}"
        )
    return built_films(table, rotor.profile.speeds[0]) if table.is_built else damper_films(table)


@quiet()
def built_films(table: DamperTable, speed: float) -> tuple[BuiltDamperFilm, ...]:
    """Return the films of a damper with seals or inertia, the cheapest first; one that a scene names alone.

    Parameters
    ----------
    table : DamperTable
    speed : float [rad/s]

    Raises
    ------
    InputError
        If the inertia of the oil is no model at this speed.
    """
    whole = replace(table, film=None).build()
    whole.require_range(speed)
    laws = [law for law in _laws(table) if table.film is None] or [_named(table)]
    shapes = {NO_INERTIA: with_changes(whole, density=0.0), "": whole} if table.density else {"": whole}
    return tuple(
        BuiltDamperFilm(
            name=f"{name}{inertia}",
            shape=shape,
            law=law,
            rich_shape=whole,
            rich_law=_richest(table, law),
            prior=0.02 * min(whole.slenderness**2, 1.0) if isinstance(law, ShortSqueeze) else 0.0,
            speed=speed,
        )
        for name, law in laws
        for inertia, shape in shapes.items()
        if table.film is None or not inertia
    )


def _laws(table: DamperTable) -> list[tuple[str, SqueezeLaw]]:
    short: list[tuple[str, SqueezeLaw]] = [] if table.needs_length else [("short film", ShortSqueeze())]
    if isinstance(table.extent, FullFilm):
        return [*short, ("finite film", FiniteSqueeze())]
    return short if table.seals is not None else [*short, ("finite film", FiniteMapSqueeze())]


def _named(table: DamperTable) -> tuple[str, SqueezeLaw]:
    law = table.film or ShortSqueeze()
    return type(law).__name__, law


def _richest(table: DamperTable, own: SqueezeLaw) -> SqueezeLaw:
    if isinstance(table.extent, FullFilm):
        return FiniteSqueeze()
    if table.seals is not None:
        return ShortSqueeze()
    return own if isinstance(own, FiniteMapSqueeze) else FiniteMapSqueeze(cells=DEFECT_CELLS)
