"""`[thrust]` of a scene: a thrust bearing of fixed or tilting pads, on one side of the collar or on both."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from ...analysis import coefficients, equilibrium
from ...core.dynamic_stiffness import quasi_static
from ...core.errors import EquilibriumError, InputError, require_given, require_number, require_positive
from ...core.model import Array
from ...core.port import Reaction, static_force
from ...core.progress import Report, silent
from ...core.readable import Readable
from ...core.results import Coefficients, Equilibrium
from ...scenes.families import messages, remarks_of
from ...scenes.reading import Count, fields_of, made_from
from ...scenes.shared_tables import Lubricant, OiledTable, oil_remarks
from .. import thrust
from ..assemblies import Parallel
from ..films.turbulence import stiffening
from ..own_reaction import as_reaction

if TYPE_CHECKING:
    from ...scenes.scene import Scene

NARROW, WEDGE = 0.5, 50.0
"""Films over the pivots or lands, over the least film, between which that is sought."""

MOST_PADS = 64
"""Most pads of one side."""

OF_PLACE = ("gap", "side", "start", "extrapolated", "tabulated")
"""Fields of the pads that the scene of a bearing alone does not need."""

PIVOTED = ("pivot_width", "line_pivot")
FIXED = ("taper_depth", "taper_share", "step_depth", "step_share", "step_width", "continuous")

Pads = thrust.ThrustBearing | thrust.TiltingThrustBearing


@dataclass(frozen=True, kw_only=True)
@fields_of(thrust.TiltingThrustBearing, thrust.ThrustBearing, without=OF_PLACE)
class ThrustTable(OiledTable):
    """`[thrust]`: a thrust bearing of sector pads, fixed or tilting, on one side of the collar or on both.

    Parameters
    ----------
    pads : int
        Number of equal pads of one side.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    pivot_arc : float or None [1]
        Place of the pivot as part of the arc from the leading edge: with it the pads tilt.
    cells : (int, int) or None
        Of the film around a pad and across it; if the file does not say, 64 x 16, or what a question needs.
    play : float or None [m]
        Sum of both films of a double-acting bearing with the same pads on both sides of the collar; then the
        viscosity must be given.
    axial_load : float or None [N]
        Load that presses the collar onto the pads; of a pair onto those that push along +z, and negative
        onto the others. Required unless a question asks for the load.
    smallest_film : float or None [m]
        Least film that is allowed, at which a question asks for the load.
    """

    pads: Annotated[int, Count(MOST_PADS)]
    pivot_arc: float | None = None
    cells: tuple[int, int] | None = None
    play: float | None = None
    axial_load: float | None = None
    smallest_film: float | None = None

    def __post_init__(self) -> None:
        require_given(self, require_positive, "play", "smallest_film")
        self._require_load()
        mistaken = FIXED if self.tilts else PIVOTED
        where = "beside pivot_arc" if self.tilts else "without pivot_arc"
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name in mistaken and value != field.default:
                raise InputError(f"{field.name} must be left out {where}, got {value!r}")
        if self.has_lubricant:
            self.build()
        else:  # until `on` gives the oil, the other values are checked beside any viscosity
            table: Any = self
            replace(table, viscosity=1.0)

    def _require_load(self) -> None:
        if self.axial_load is None:
            return
        least = -np.inf if self.play is not None else 0.0
        if not require_number("axial_load", self.axial_load) > least or not self.axial_load:
            raise InputError(
                f"axial_load must press the collar onto the pads, positive or of a pair not zero, "
                f"got {self.axial_load!r}"
            )

    @property
    def tilts(self) -> bool:
        """Whether the pads stand on pivots."""
        return self.pivot_arc is not None

    def one_side(self) -> Any:
        """Return the pads that push along +z; InputError where a value breaks its rule."""
        cells = self.cells or thrust.ThrustBearing.cells
        return made_from(
            thrust.TiltingThrustBearing if self.tilts else thrust.ThrustBearing, self, cells=cells
        )

    def build(self) -> Pads | Parallel:
        """Return the bearing; InputError where a value breaks its rule."""
        pads = self.one_side()
        if self.play is None:
            return pads
        if pads.is_warming:
            raise InputError(
                "viscosity must be given with play, because each side has a temperature of its own, got "
                f"{self.viscosity!r}"
            )
        return thrust.double_acting(pads, self.play)

    def under_shaft(self) -> Parallel:
        """Return the bearing with its axial load, from a table where the pads have one.

        Raises
        ------
        InputError
            If it has no viscosity, or pads on one side have no load.
        """
        if self.viscosity is None:
            raise InputError("viscosity must be given for the thrust bearing of a shaft, got None")
        pads = self.one_side()
        with suppress(InputError):
            pads = replace(pads, tabulated=True)
        if self.play is not None:
            pair = thrust.double_acting(pads, self.play)
            return pair if self.axial_load is None else Parallel((pair, _pushed(self.load[0], self.play)))
        return Parallel((replace(pads, gap=pads.film_scale), _pushed(self.load[0], pads.film_scale)))

    @property
    def load(self) -> tuple[float, float, float]:
        """The external force along z and no moments [N], [N m]; InputError where it is not given."""
        if self.axial_load is None:
            raise InputError("thrust.axial_load is required for an equilibrium, got none")
        return -self.axial_load, 0.0, 0.0


def _pushed(force: float, film: float) -> Reaction:
    """Return a steady force along z [N] on a shaft that moves by about a film [m]."""
    return as_reaction(
        lambda z, vz, speed: (force,),
        jacobian=lambda z, vz, speed: ((0.0, 0.0, 0.0),),
        freedoms=("z",),
        clearance=min(film, 1e-2),
        nominal_force=abs(force),
        name="axial_load",
    )


def pads_load(bearing: Any, position: Array, speed: float) -> float:
    """Return the force along z [N] of the pads of a bearing under a shaft, without its axial load."""
    if not isinstance(bearing, Parallel):
        found: Array = static_force(quasi_static(bearing), position, np.zeros(3), speed)
        return float(found[0])
    films = [one for one in bearing.reactions if isinstance(one, Parallel | thrust.SectorPads)]
    return sum(pads_load(one, position, speed) for one in films)


def thrust_models(scene: Scene) -> tuple[Any, dict[str, float]]:
    """Return the bearing of a scene as it becomes an FMU, and its start values.

    Its z is counted from the equilibrium under the axial load, at which it starts.

    Raises
    ------
    InputError, EquilibriumError
        As `answer_thrust`.
    """
    rest = thrust_rest(scene.thrust.build(), scene.thrust.load, scene.speed)
    sides = tuple(replace(one, gap=one.gap + one.side * float(rest.position[0])) for one in rest.sides)
    return sides[0] if len(sides) == 1 else Parallel(sides), {"speed": scene.speed}


# What a thrust bearing answers: its equilibrium, stiffness and damping, losses and temperature.


@dataclass(frozen=True, kw_only=True)
class ThrustData(Readable):
    """A thrust bearing as it was understood.

    Attributes
    ----------
    inner_radius, outer_radius : float [m]
        Radii of the pads.
    pads : int
        Number of pads of one side.
    pad_arc : float [rad]
        Angle of one pad.
    viscosity : float [Pa s]
        Viscosity of the films, or of fresh oil where their temperature follows from a balance of heat.
    pivot_arc : float or None [1]
        Place of the pivot as part of the arc from the leading edge; None for fixed pads.
    play : float or None [m]
        Sum of both films of a double-acting bearing; None for pads on one side.
    axial_load : float [N]
        Load that presses the collar onto the pads.
    """

    inner_radius: float
    outer_radius: float
    pads: int
    pad_arc: float
    viscosity: float
    pivot_arc: float | None
    play: float | None
    axial_load: float


@dataclass(frozen=True, kw_only=True)
class ThrustAnswer(Readable):
    """What a thrust bearing does under its axial load.

    Attributes
    ----------
    bearing : ThrustData
    model : str
        The film that answered.
    equilibrium : Equilibrium
        Of z and both tilts; of an oil with the temperature of the film in the balance of its heat.
    coefficients : Coefficients
        Stiffness and damping over z and tilts at the frequency of the speed.
    losses : ThrustLosses
        Of both sides, if there are two.
    leaving_temperature : float or None [K]
        Temperature of the oil that leaves the pads, for which questions ask; None of a given viscosity.
    remarks : tuple of str
        What the physics of the film leaves out and should not.
    """

    bearing: ThrustData
    model: str
    equilibrium: Equilibrium
    coefficients: Coefficients
    losses: thrust.ThrustLosses
    leaving_temperature: float | None = None
    remarks: tuple[str, ...] = ()


class ThrustRest(NamedTuple):
    """A collar at rest.

    Attributes
    ----------
    position : ndarray, shape (3,) [m], [rad]
        z and both tilts.
    speed : float [rad/s]
    bearing : ThrustBearing, TiltingThrustBearing or Parallel
        At the temperature of its film.
    at : Equilibrium or None
        None where the place was given, not the load.
    """

    position: Array
    speed: float
    bearing: Any
    at: Equilibrium | None = None

    @property
    def sides(self) -> tuple[Any, ...]:
        """The pads on one side, or on both."""
        return tuple(self.bearing.reactions) if isinstance(self.bearing, Parallel) else (self.bearing,)

    @property
    def coefficients(self) -> Coefficients:
        """Stiffness and damping at the frequency of the speed."""
        return coefficients(self.bearing, self.position, self.speed)

    @property
    def load(self) -> float:
        """Axial load that the film carries, towards -z [N]."""
        return float(static_force(quasi_static(self.bearing), self.position, np.zeros(3), self.speed)[0])

    @property
    def losses(self) -> thrust.ThrustLosses:
        """Those of all sides together."""
        each = [one.losses(self.position, np.zeros(3), self.speed) for one in self.sides]
        return each[0] if len(each) == 1 else both_sides(*each)

    @property
    def leaving_temperature(self) -> float:
        """Temperature of the oil that leaves the pads, half the rise above that of the film [K]."""
        pads, losses = self.sides[0], self.losses
        oil, cooling = pads.cooled
        assert pads.temperature is not None  # or there is no film
        heat = losses.power_loss - cooling.housing_conductance * (pads.temperature - cooling.ambient)
        return pads.temperature + 0.5 * heat / (
            float(oil.volumetric_heat(cooling.supply_temperature)) * losses.inflow
        )


def both_sides(front: thrust.ThrustLosses, back: thrust.ThrustLosses) -> thrust.ThrustLosses:
    """Return the losses of both sides of a collar together."""
    kinds: dict[str, Any] = {"highest_pressure": max, "minimum_film": min, "film_share": np.mean}
    pairs = {one.name: (getattr(front, one.name), getattr(back, one.name)) for one in fields(front)}
    return thrust.ThrustLosses(**{name: kinds.get(name, sum)(pair) for name, pair in pairs.items()})


def thrust_rest(bearing: Any, load: tuple[float, float, float], speed: float) -> ThrustRest:
    """Return the equilibrium of a collar under a force along z [N] and moments [N m] at a speed [rad/s]."""
    at = equilibrium(bearing, load, speed)
    warm = bearing if at.temperature is None else bearing.at_temperature(at.temperature)
    return ThrustRest(at.position, speed, warm, at)


def rest_at_film(bearing: Any, film: float, speed: float) -> ThrustRest:
    """Return the aligned collar where the pads that push along +z have a least film [m].

    Raises
    ------
    InputError
        If a pair has no play for such a film.
    EquilibriumError
        If the film carries no load at this speed.
    """
    pads: Any = bearing.reactions[0] if isinstance(bearing, Parallel) else bearing

    def excess(over: float) -> float:
        return float(pads.minimum_film([over * film - pads.gap, 0.0, 0.0])) - film

    if not excess(NARROW) < 0.0 < excess(WEDGE):
        raise InputError(
            f"smallest_film must be a film thickness that the lands of the pads can have, got {film!r} m"
        )
    place = np.array([film * brentq(excess, NARROW, WEDGE, rtol=1e-10) - pads.gap, 0.0, 0.0])
    if isinstance(bearing, Parallel) and place[0] > 0.0:
        raise InputError(
            f"smallest_film must leave at least half of the play, {pads.gap!r} m, over pivots or lands, got "
            f"{film!r} m"
        )
    if not pads.is_warming:
        return _carrying(ThrustRest(place, speed, bearing), film)
    fresh = bearing.at_temperature(bearing.cooled[1].supply_temperature)
    _carrying(ThrustRest(place, speed, fresh), film)
    temperature = bearing.balanced_temperature(place, np.zeros(3), speed)
    return ThrustRest(place, speed, bearing.at_temperature(temperature))


def _carrying(rest: ThrustRest, film: float) -> ThrustRest:
    """Return a rest at a least film [m] whose load is positive; EquilibriumError for others."""
    if not rest.load > 0.0:
        raise EquilibriumError(
            f"the pads must carry a load at smallest_film {film!r} m, got {rest.load:.6g} N at "
            f"{rest.speed!r} rad/s; {thrust.SENSE}"
        )
    return rest


def answer_thrust(scene: Scene, report: Report = silent) -> ThrustAnswer:
    """Return the equilibrium of the collar of a scene on its thrust bearing, and what follows from it.

    Raises
    ------
    InputError
        If the scene has no speed or no axial load.
    EquilibriumError
        If the film cannot carry the load.
    """
    table: ThrustTable = scene.required("thrust", "a thrust bearing")
    load, bearing = table.load, table.build()
    report(0.0, "equilibrium")
    rest = thrust_rest(bearing, load, scene.speed)
    assert rest.at is not None  # of a load
    pads = table.one_side()
    return ThrustAnswer(
        bearing=made_from(ThrustData, table, viscosity=pads.film_viscosity),
        model=film_name(pads),
        equilibrium=rest.at,
        coefficients=rest.coefficients,
        losses=rest.losses,
        leaving_temperature=rest.leaving_temperature if pads.is_warming else None,
        remarks=(
            *oil_remarks(scene.tables, scene.lubricant),
            *thrust_remarks(rest, scene.lubricant.properties),
        ),
    )


def film_name(pads: Pads) -> str:
    """Return what the film of pads is called in print."""
    extrapolated = " extr." if pads.extrapolated else ""
    heat = ", T1" if pads.is_warming else ""
    return f"2-D {pads.cells[0]} x {pads.cells[1]}{extrapolated} on each pad{heat}"


# What the physics of thrust films leaves out, judged by numbers of a rest.


def thrust_numbers(rest: ThrustRest, oil: Lubricant) -> dict[str, float]:
    """Return the numbers of a rest that decide on remarks.

    Returns
    -------
    dict of str to float
        reynolds : speed times mean radius times mean film over kinematic viscosity, of the thicker side.
        turbulent : where turbulence begins; turbulence : how much more such a film resists, else 0.
        tilt : tilt of the collar [mrad] that closes the least film of fixed pads; of tilting pads infinite.
        warming : rise of temperature along a pad [K] that the viscosity given does not know; else 0.
        thinning : relative loss of viscosity by half of it.
    """
    thickest = max(rest.sides, key=lambda one: one.gap + one.side * float(rest.position[0]))
    flow = thickest.reynolds(rest.position, rest.speed, oil.density)
    losses, pads = rest.losses, rest.sides[0]
    warming = 0.0
    if pads.oil is None and losses.inflow > 0.0:
        warming = losses.power_loss / (oil.density * oil.heat_capacity * losses.inflow)
    return {
        "reynolds": flow,
        "turbulent": thrust.TURBULENT_PADS,
        "turbulence": stiffening(flow) if flow > thrust.TURBULENT_PADS else 0.0,
        "tilt": np.inf if pads.tilts else 1e3 * losses.minimum_film / pads.outer_radius,
        "warming": warming,
        "thinning": -np.expm1(-0.5 * oil.thinning * warming),
    }


def thrust_remarks(rest: ThrustRest, oil: Lubricant) -> tuple[str, ...]:
    """Return the neglected effects that matter, one line each."""
    return messages(remarks_of("hot", "thrust"), thrust_numbers(rest, oil))
