"""A melting bush from settings in text, and what the command line says about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from ...bearings.bush import BushContact, BushWear, MeltingBush, f4k20_bush
from ...errors import InputError, brief
from ...readable.result import Readable
from ...signals import units
from ...units import parse_quantity

SETTINGS: dict[str, tuple[str, str]] = {
    "radius": ("geometry", "m"),
    "outer_radius": ("geometry", "m"),
    "shaft_radius": ("geometry", "m"),
    "length": ("geometry", "m"),
    "shear_modulus": ("liner", "Pa"),
    "poisson_ratio": ("liner", "1"),
    "expansion": ("liner", ""),
    "liner_conductivity": ("liner", ""),
    "melting_point": ("liner", "K"),
    "shaft_conductivity": ("shaft", ""),
    "air_transfer": ("shaft", ""),
    "f0": ("friction", "1"),
    "f1": ("friction", ""),
    "f2": ("friction", ""),
    "outer_mean": ("", "K"),
    "outer_swing": ("", "K"),
}
"""Part of the bush and unit of each setting; an empty unit stands for a plain SI number."""


@dataclass(frozen=True, kw_only=True)
class BushAnswer(Readable):
    """What `rotorfilm bush` prints.

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

    bush: MeltingBush
    contact: BushContact
    settlement: float
    contact_angle: float
    onset_speed: float
    operation: dict[str, float]

    def _own_units(self) -> dict[str, str]:
        return units(BushWear(bush=self.bush, melting_heat=1.0).outputs)


def bush_from_settings(settings: Mapping[str, str]) -> MeltingBush:
    """Return the bush of `f4k20_bush` with some values changed.

    Parameters
    ----------
    settings : mapping of str to str
        Values by name, a key of `SETTINGS`, as `{"shaft_radius": "12.4 mm", "f0": "0.12"}`.

    Raises
    ------
    InputError
        If a name is unknown, or a value is no quantity in its unit or out of range.
    """
    parts: dict[str, dict[str, Any]] = {}
    for name, text in settings.items():
        if name not in SETTINGS:
            raise InputError(f"setting must be one of {', '.join(SETTINGS)}, got {name!r}")
        part, unit = SETTINGS[name]
        field = "conductivity" if name.endswith("conductivity") else name
        parts.setdefault(part, {})[field] = _number(name, text, unit)
    bush = f4k20_bush()
    own = parts.pop("", {})
    return replace(
        bush, **own, **{part: replace(getattr(bush, part), **values) for part, values in parts.items()}
    )


def solve_bush(bush: MeltingBush, load: float, speed: float | None, settlement: float) -> BushAnswer:
    """Return contact and critical speeds, and where a speed [rad/s] is given the operation there, unworn."""
    operation: dict[str, float] = {}
    if speed is not None:
        # The melting heat scales nothing but the rate of wear, which is left out.
        model = BushWear(bush=bush, melting_heat=1.0)
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


def _number(name: str, text: str, unit: str) -> float:
    try:
        return parse_quantity(text, unit) if unit else parse_quantity(float(text), "1")
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    except ValueError:
        raise InputError(f"{name} must be a plain SI number, got {brief(text)}") from None
