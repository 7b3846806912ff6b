"""`[damper]`: a squeeze-film damper with its retainer springs in scene files, schema 1."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, NamedTuple

from ...core.errors import InputError, ValidityWarning, require_given, require_non_negative
from ...rotors import RigidRotor
from ...scenes.families import SceneModels
from ...scenes.reading import Keyed, Taking, Variant, fields_of, made_from
from ...scenes.shared_tables import BladeLossTable, RunUpTable, UnbalanceTable, require_kind, require_steps
from .. import damper as dampers
from ..assemblies import Parallel, with_springs
from ..films.geometry import FullFilm, HalfSommerfeld

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# `[damper.seals]`: seals at both ends of a squeeze film, by leakage, by their gap or by a leak test.


WAYS = (("leakage",), ("gap", "gap_length"), ("flow", "pressure"))
"""Keys of each way to say how seals leak."""


@dataclass(frozen=True, kw_only=True)
class SealsTable:
    """`[damper.seals]`: equal seals at both ends.

    Parameters
    ----------
    leakage : float or None [m2/(Pa s)]
        Volume per time, circumference and pressure; 0 for tight seals, as O-rings.
    gap : float or None [m]
        Instead: radial width of a narrow gap.
    gap_length : float or None [m]
        Its length along the axis.
    flow, pressure : float or None [m3/s], [Pa]
        Instead: of a leak test, out of one end.
    uncertainty : float [1]
        Uncertainty of the leakage, relative; an answer then says how far it may move.
    """

    leakage: float | None = None
    gap: float | None = None
    gap_length: float | None = None
    flow: float | None = None
    pressure: float | None = None
    uncertainty: float = 0.0

    def __post_init__(self) -> None:
        given = tuple(name for way in WAYS for name in way if getattr(self, name) is not None)
        if given not in WAYS:
            raise InputError(
                "seals must have leakage, or gap and gap_length, or flow and pressure, got "
                f"{', '.join(given) or 'none'}"
            )
        _ = self.seal(viscosity=1.0, radius=1.0)

    def seal(self, *, viscosity: float, radius: float) -> dampers.EndSeal:
        """Return the seals of a film of a viscosity [Pa s] and a radius [m]."""
        if self.gap is not None and self.gap_length is not None:
            found = dampers.gap_seal(height=self.gap, length=self.gap_length, viscosity=viscosity)
        elif self.flow is not None and self.pressure is not None:
            found = dampers.leak_test_seal(flow=self.flow, pressure=self.pressure, radius=radius)
        else:
            found = dampers.EndSeal(leakage=self.leakage or 0.0)
        return replace(found, uncertainty=self.uncertainty)


# `[damper]`: a squeeze-film damper with its retainer springs in scene files, schema 1.


CELLS = (48, 8)
"""Of a film that conserves its oil and is stepped through in time."""

FEEDS = {"radial": dampers.RadialFeed, "axial": dampers.AxialFeed}
"""`feed = {kind = "radial", ...}`: how lubricant is fed, through the cage or at both ends."""

LARGEST_AROUND = 0.2
"""Excess of the damping of a sealed short film, beyond which it is not asked."""

EXTENTS = {"half_sommerfeld": HalfSommerfeld, "full": FullFilm}

SQUEEZES: dict[str, Keyed[dampers.SqueezeLaw]] = {
    "short": Keyed(dampers.ShortSqueeze),
    "map": Keyed(dampers.MapSqueeze),
    "finite": Keyed(dampers.FiniteSqueeze),
    "finite_map": Keyed(dampers.FiniteMapSqueeze),
    "published": Keyed(dampers.PublishedSqueeze),
}
"""`film = {name = "short"}`: squeeze films by their names in scene files."""


@dataclass(frozen=True, kw_only=True)
@fields_of(dampers.PorousDamper)
class DamperTable(Taking):
    """`[damper]`: a squeeze-film damper and its retainer springs.

    Parameters
    ----------
    extent : FullFilm or HalfSommerfeld
        Whether the film carries tension.
    feed : RadialFeed, AxialFeed or None
        Besides a supply pressure at a vented back of the cage.
    stiffness : float [N/m]
        Stiffness of the retainer springs, which carry the static load; 0 for none.
    supply : DamperSupply or None
        Supply of a solid cage and a film that ruptures: then the oil is conserved in it, unless a film law is
        named.
    density : float [kg/m3]
        Density of the oil, whose inertia then is part of the answer; 0 without inertia.
    seals : SealsTable or None
        Seals at both ends; None for open ends.
    offset : (float, float) [m]
        Static place of the rotor off the center of the film, where the springs hold it.
    feed_flow : float or None [m3/s]
        Feed flow of oil fed to the film, which says whether air is drawn in.
    air_fraction : float [1]
        Measured volume of air per volume of oil and air at ambient pressure: damping and mass are the least
        that it leaves.
    film : SqueezeLaw or None
        The film law; if the file does not say, the short film, or what the question of the scene needs.
    """

    extent: Annotated[FullFilm | HalfSommerfeld, Variant("kind", EXTENTS)]
    feed: Annotated[dampers.RadialFeed | dampers.AxialFeed | None, Variant("kind", FEEDS)] = None
    film: Annotated[dampers.SqueezeLaw | None, Variant("name", SQUEEZES)] = None
    seals: SealsTable | None = None
    stiffness: float = 0.0
    supply: dampers.DamperSupply | None = None
    offset: tuple[float, float] = (0.0, 0.0)
    feed_flow: float | None = None
    air_fraction: float = 0.0

    def __post_init__(self) -> None:
        require_non_negative("stiffness", self.stiffness)
        self._require_offset()
        require_given(self, require_non_negative, "feed_flow")
        if self.supply is not None:
            self.conserved(self.supply)
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            # Which film answers is not known yet; a run of this one warns when it is built.
            self.build()

    def build(self) -> dampers.PorousDamper:
        """Return the damper without its springs; raise InputError where a value breaks its rule.

        Its film laws know no supply. Two lands beside a groove are one of them, in oil twice as viscous.
        """
        film = self.film or (dampers.FiniteSqueeze() if self.needs_length else dampers.ShortSqueeze())
        groove = None if self.supply is None else self.supply.circumferential_groove
        if groove is not None:
            land, twice = 0.5 * (self.length - groove), 2.0 * self.viscosity
            return made_from(dampers.PorousDamper, self, film=film, seals=None, length=land, viscosity=twice)
        damper = made_from(dampers.PorousDamper, self, film=film, seals=self.seal)
        if not self.air_fraction:
            return damper
        aired = dampers.aerated_damper(damper, self.air_fraction)
        return replace(damper, viscosity=aired.viscosity, density=aired.density)

    @property
    def seal(self) -> dampers.EndSeal | None:
        """The seals, None for open ends."""
        if self.seals is None:
            return None
        return self.seals.seal(viscosity=self.viscosity, radius=self.radius)

    @property
    def needs_length(self) -> bool:
        """Whether seals are so tight that the oil of a full film runs around, not out: no short film."""
        return self.seal is not None and isinstance(self.extent, FullFilm) and self.around > LARGEST_AROUND

    @property
    def around(self) -> float:
        """How much too large the damping of a short film with these seals is [1]."""
        if self.seal is None:
            return 0.0
        leak = 12.0 * self.viscosity * self.radius * self.seal.leakage / self.clearance**3
        s = 0.5 * self.length / self.radius
        if leak == 0.0:
            return math.inf
        return (s**2 / 3.0 + s / leak) / dampers.land_share(s, leak).real - 1.0

    @property
    def is_built(self) -> bool:
        """Whether seals or the inertia of the oil are in it."""
        return self.seals is not None or self.density > 0.0

    def _require_offset(self) -> None:
        place = math.hypot(*self.offset)
        if place and not self.stiffness:
            raise InputError(
                f"stiffness must be positive for a rotor at an offset, got offset {self.offset!r}: without "
                "springs a weight lets it down to the wall"
            )
        if place and place >= self.clearance:
            raise InputError(f"offset must be below the clearance {self.clearance!r}, got {self.offset!r}")

    @property
    def load(self) -> tuple[float, float]:
        """The static force that holds the rotor at its offset [N]."""
        return self.stiffness * self.offset[0], self.stiffness * self.offset[1]

    def conserved(self, supply: dampers.DamperSupply) -> dampers.JFODamper:
        """Return the damper that conserves its oil, with its springs; raise InputError where it cannot."""
        alone = {"cage": None, "feed": None, "extent": HalfSommerfeld(), "seals": None, "density": 0.0}
        for name, wanted in {**alone, "offset": (0.0, 0.0), "air_fraction": 0.0}.items():
            if getattr(self, name) != wanted:
                raise InputError(
                    f"{name} must be left out beside supply, as the film that conserves its oil has a solid "
                    f"cage, open ends and no inertia, and ruptures, got {getattr(self, name)!r}"
                )
        return made_from(dampers.JFODamper, self, supply=supply)

    def support(self) -> dampers.PorousDamper | Parallel | dampers.JFODamper:
        """Return the damper with its springs, if it has some; with a supply that which conserves its oil."""
        if self.supply is not None and self.film is None:
            return replace(self.conserved(self.supply), cells=CELLS)
        return self.plain()

    def plain(self) -> dampers.PorousDamper | Parallel:
        """Return the damper of a film that knows no supply, with its springs, if it has some."""
        damper = self.build()
        return with_springs(damper, self.stiffness) if self.stiffness else damper


# Rotor and damper of a scene, as they are run.


class DamperScene(NamedTuple):
    """The models of a scene with a damper.

    Attributes
    ----------
    rotor : RigidRotor
        Rotor at the center of the damper, or its offset, at rest.
    support : PorousDamper, Parallel or JFODamper
    start : float [s]
        When the excitation begins: until then nothing moves, and the run counts from there.
    duration : float [s]
    step : float [s]
        Time between samples, or exchanges of a coupled run.
    """

    rotor: RigidRotor
    support: dampers.PorousDamper | Parallel | dampers.JFODamper
    start: float
    duration: float
    step: float


def damper_models(scene: Scene) -> DamperScene:
    """Return rotor and damper of a scene.

    An unbalance is that of `[rigid_rotor]`, there from the start, or that of the excitation: `unbalance`,
    `blade_loss` or `run_up`.

    Raises
    ------
    InputError
        If the scene lacks a damper or a rotor, has two unbalances, or another excitation.
    """
    excitation = scene.excitation
    if scene.damper is None or scene.rigid_rotor is None:
        raise InputError("damper and rigid_rotor are required for a run on a damper, got a scene without")
    rotor, start, duration = scene.rigid_rotor.build(scene.speed, scene.damper.load), 0.0, 0.0
    rotor = replace(rotor, position=scene.damper.offset)
    require_kind(excitation, ("unbalance", "blade_loss", "run_up"))
    if isinstance(excitation, UnbalanceTable):
        rotor = excitation.given_to(rotor)
    if isinstance(excitation, BladeLossTable):
        start, duration = excitation.start, scene.time_of(2.0 * math.pi * excitation.revolutions)
        rotor = replace(rotor, unbalance_angle=rotor.unbalance_angle + scene.speed * start)
    if isinstance(excitation, RunUpTable):
        profile = excitation.profile(scene.speed)
        rotor, duration = replace(rotor, speed=profile), profile.times[-1]
    duration = duration or scene.duration
    require_steps("excitation", duration * abs(scene.speed), scene.cosimulation)
    return DamperScene(rotor, scene.damper.support(), start, duration, scene.macro_step)


def damper_fmus(scene: Scene) -> SceneModels:
    """Return the damper of a scene, springs included, and its rotor, at rest in the center.

    Raises
    ------
    InputError
        As `damper_models`, and if the oil of the damper has mass.
    """
    if scene.damper is not None and scene.damper.density:
        raise InputError(
            "damper.density must be 0 for a damper apart from its rotor: an exchange of accelerations "
            "diverges where the oil is heavier than the rotor; rotorfilm fmu build writes both as one "
            "system.fmu, got "
            f"{scene.damper.density!r}"
        )
    models = damper_models(scene)
    return SceneModels("damper", models.support, models.rotor, {}, models.step, models.duration)
