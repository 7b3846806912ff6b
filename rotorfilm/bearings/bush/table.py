"""`[bush]`: a polymer bush that wears by melting, by default the example of Evtushenko & Kovalenko (1993)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Annotated, Any

from ...core.errors import SceneError, brief
from ...core.limits import WORN_NODES
from ...core.progress import Report, silent
from ...core.readable import Readable
from ...core.signals import units
from ...scenes.reading import Count, Quantity, Taking, fields_of, made_from, named, one_of, takes
from .. import bush as bushes

if TYPE_CHECKING:
    from ...scenes.scene import Scene

MATERIALS = {"f4k20": bushes.f4k20_bush}
"""Bushes whose data a scene may take, by name: filled PTFE F4K20 on a steel shaft, Evtushenko & Kovalenko
(1993), section 4."""

SHAFT_HEATS = {"exact": bushes.ExactShaft, "approximate": bushes.ApproximateShaft}
BALANCES = {"contact": bushes.ContactBalance, "global": bushes.GlobalBalance}
MELTINGS = {"shared": bushes.SharedMelting, "local": bushes.LocalMelting}

PARTS = ("geometry", "liner", "shaft", "conductivity")
"""Parameters of a bush that are parts of it, or of several parts."""

FRICTION = (Quantity("1"), Quantity("1/K"), Quantity("1/K2"))


@takes(Quantity("1"), *(list(FRICTION[:count]) for count in (1, 2, 3)))
def _read_friction(where: str, value: Any) -> bushes.Friction:
    """Read a coefficient of friction: one number, or f0, f1 [1/K], f2 [1/K2] of f0 + f1 T + f2 T^2."""
    numbers = value if isinstance(value, list) else [value]
    if not 1 <= len(numbers) <= 3:
        raise SceneError(f"{where} must be one number or up to three, [f0, f1, f2], got {brief(value)}")
    f = [read(f"{where}[{k}]", x) for k, (read, x) in enumerate(zip(FRICTION, numbers, strict=False))]
    return bushes.Friction(f0=f[0], f1=f[1] if len(f) > 1 else 0.0, f2=f[2] if len(f) > 2 else 0.0)


@dataclass(frozen=True, kw_only=True)
@fields_of(bushes.BushReaction, without=("bush", "wear_depth", "temperature"))
@fields_of(
    bushes.BushGeometry,
    bushes.LinerMaterial,
    bushes.ShaftMaterial,
    bushes.MeltingBush,
    without=PARTS,
    optional=True,
)
class BushTable(Taking):
    """`[bush]`: a polymer bush; values that are not given are those of its material.

    Parameters
    ----------
    melting_heat : float [J/m3]
        Heat that melts a unit of volume of the liner; the source does not give it.
    material : str
        A name of `MATERIALS`, which gives all data that the table does not.
    liner_conductivity : float or None [W/(m K)]
        Thermal conductivity of the liner.
    shaft_conductivity : float or None [W/(m K)]
        Thermal conductivity of the shaft.
    melting_point : float or None [K]
        Above the ambient temperature, as all temperatures here.
    friction : Friction or None
        In a file one number or `[f0, f1, f2]`.
    shaft_heat : ShaftHeat
        In a file "exact" or "approximate".
    balance : HeatBalance
        In a file "contact" or "global".
    melting : MeltingRule
        In a file "shared" or "local".
    nodes : int
        Nodes of the worn profile.
    """

    material: Annotated[str, one_of(MATERIALS)] = "f4k20"
    liner_conductivity: float | None = None
    shaft_conductivity: float | None = None
    friction: Annotated[bushes.Friction | None, _read_friction] = None
    shaft_heat: Annotated[bushes.ExactShaft | bushes.ApproximateShaft, named(SHAFT_HEATS)] = field(
        default_factory=bushes.ExactShaft
    )
    balance: Annotated[bushes.ContactBalance | bushes.GlobalBalance, named(BALANCES)] = field(
        default_factory=bushes.ContactBalance
    )
    melting: Annotated[bushes.SharedMelting | bushes.LocalMelting, named(MELTINGS)]
    nodes: Annotated[int, Count(WORN_NODES)]

    def __post_init__(self) -> None:
        self.reaction()

    def build(self) -> bushes.MeltingBush:
        """Return the bush; raise InputError where a value breaks its rule."""
        of = MATERIALS[self.material]()

        def given(part: Any, **values: Any) -> Any:
            """Return a part of the bush with what the table has of it."""
            own = {f.name: getattr(self, f.name) for f in fields(part) if hasattr(self, f.name)} | values
            return replace(part, **{name: value for name, value in own.items() if value is not None})

        return given(
            of,
            geometry=given(of.geometry),
            liner=given(of.liner, conductivity=self.liner_conductivity),
            shaft=given(of.shaft, conductivity=self.shaft_conductivity),
        )

    def wear(self) -> bushes.BushWear:
        """Return the model with one state, for a load that does not fall."""
        return bushes.BushWear(bush=self.build(), melting_heat=self.melting_heat)

    def reaction(self) -> bushes.BushReaction:
        """Return the model with a worn profile, a bearing for a rotor."""
        return made_from(bushes.BushReaction, self, bush=self.build())


# Contact and critical speeds of the unworn bush.


@dataclass(frozen=True, kw_only=True)
class BushAnswer(Readable):
    """What a scene with a bush answers.

    Attributes
    ----------
    bush : MeltingBush
    contact : BushContact
        The unworn bush at its melting point.
    settlement : float [m]
        Up to which the liner may wear.
    contact_angle : float [rad]
        Half the contact angle at that settlement.
    onset_speed : float [rad/s]
        Critical speed there, omega_*.
    operation : dict of str to float
        Outputs of the unworn bush at the speed asked for; empty without one.
    """

    bush: bushes.MeltingBush
    contact: bushes.BushContact
    settlement: float
    contact_angle: float
    onset_speed: float
    operation: dict[str, float]

    def _own_units(self) -> dict[str, str]:
        return units(bushes.BushWear(bush=self.bush, melting_heat=1.0).outputs)


def solve_bush(bush: bushes.MeltingBush, load: float, speed: float | None, settlement: float) -> BushAnswer:
    """Return contact and critical speeds, and where a speed [rad/s] is given the operation there, unworn."""
    operation: dict[str, float] = {}
    if speed is not None:
        # The melting heat scales nothing but the rate of wear, which is left out.
        model = bushes.BushWear(bush=bush, melting_heat=1.0)
        values = model.output(0.0, model.initial_state, [load, speed]).tolist()
        operation = {
            s.name: value for s, value in zip(model.outputs, values, strict=True) if s.name != "melt_rate"
        }
    return BushAnswer(
        bush=bush,
        contact=bush.contact(load),
        settlement=settlement,
        contact_angle=float(bush.angle_at(settlement)),
        onset_speed=bush.onset_speed(load, settlement),
        operation=operation,
    )


def answer_bush(scene: Scene, report: Report = silent) -> BushAnswer:
    """Return contact and critical speeds of the unworn bush of a scene."""
    load = math.hypot(*scene.static_load)
    return solve_bush(scene.bush.build(), load, scene.speed, 0.0)
