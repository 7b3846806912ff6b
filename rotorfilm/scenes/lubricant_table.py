"""`[lubricant]`: the oil of a scene, what cools it, and properties for the checks of what films leave out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any, Self

from ..bearings.oil import Cooling, Oil
from ..bearings.oil.oil import BULK_MODULUS, grade_number
from ..core.errors import InputError, SceneError, brief, require_non_negative, require_positive
from ..core.units import CELSIUS
from .reading import Count, Taking, fields_of, made_from, takes, text

WARM, HOT = 40.0 + CELSIUS, 100.0 + CELSIUS
"""Temperatures of `viscosity_40` and `viscosity_100` [K]."""


@takes(Count(9999), text)
def read_grade(where: str, value: Any) -> int:
    """Read an ISO viscosity grade, as "ISO VG 46" or 46."""
    number = grade_number(value)
    if number is None or isinstance(value, float):
        raise SceneError(f"{where} must be an ISO viscosity grade such as 'ISO VG 46', got {brief(value)}")
    return number


@dataclass(frozen=True, kw_only=True)
class Lubricant:
    """Properties of an oil at one temperature.

    Parameters
    ----------
    density : float [kg/m3]
    heat_capacity : float [J/(kg K)]
        Per mass.
    conductivity : float [W/(m K)]
    thinning : float [1/K]
        -d ln(viscosity)/d temperature.
    bulk_modulus : float [Pa]
        Pressure per relative change of volume.
    """

    density: float = 900.0
    heat_capacity: float = 2000.0
    conductivity: float = 0.15
    thinning: float = 0.04
    bulk_modulus: float = BULK_MODULUS


@dataclass(frozen=True, kw_only=True)
@fields_of(Cooling, without=("full_gap",))
class LubricantTable(Taking):
    """`[lubricant]`: an oil by its viscosity over temperature, what cools it, and further properties.

    Where it gives a viscosity and a bearing gives none, that bearing runs on this oil, in the balance of its
    heat. Otherwise the properties serve the checks of what the films leave out; what is not given is assumed,
    of the order of a mineral oil (`Lubricant`), and warnings that rest on it are no better.

    Parameters
    ----------
    grade : int or None
        ISO viscosity grade, as "ISO VG 46": the kinematic viscosity at 40 degC. That at 100 degC is assumed
        unless it is given.
    viscosity_40, viscosity_100 : float or None [m2/s]
        Kinematic viscosity at 40 and 100 degC.
    supply_temperature : float or None [K]
        Of the fresh oil; required with a viscosity.
    density : float or None [kg/m3]
        At 15 degC, of an oil with a viscosity here.
    heat_capacity : float or None [J/(kg K)]
        Per mass.
    conductivity : float or None [W/(m K)]
        Thermal conductivity of the oil.
    thinning : float or None [1/K]
        -d ln(viscosity)/d temperature; with `viscosity_40` alone the same at all temperatures.
    bulk_modulus : float [Pa]
        Pressure per relative change of volume.
    """

    grade: Annotated[int | None, read_grade] = None
    viscosity_40: float | None = None
    viscosity_100: float | None = None
    supply_temperature: float | None = None
    density: float | None = None
    heat_capacity: float | None = None
    conductivity: float | None = None
    thinning: float | None = None
    bulk_modulus: float = Lubricant.bulk_modulus

    def __post_init__(self) -> None:
        for name in ("density", "heat_capacity", "conductivity", "thinning", "bulk_modulus"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        require_non_negative("housing_conductance", self.housing_conductance)
        if not self.has_viscosity:
            return
        if self.grade is not None and self.viscosity_40 is not None:
            raise InputError(
                f"grade must not be given beside viscosity_40, which it is, got VG {self.grade} and "
                f"{self.viscosity_40!r}"
            )
        _ = self.oil, self.cooling

    @property
    def has_viscosity(self) -> bool:
        """Whether the table says how viscous the oil is."""
        return self.grade is not None or self.viscosity_40 is not None or self.viscosity_100 is not None

    @property
    def oil(self) -> Oil:
        """The oil; InputError where its viscosity over temperature is not given."""
        given: dict[str, Any] = {
            "reference_density": self.density,
            "fixed_heat_capacity": self.heat_capacity,
            "conductivity": self.conductivity,
        }
        further = {name: value for name, value in given.items() if value is not None}
        warm = self.viscosity_40 if self.grade is None else 1e-6 * self.grade
        if warm is not None and self.viscosity_100 is not None:
            return Oil.two_points((WARM, warm), (HOT, self.viscosity_100), **further)
        if self.grade is not None:
            return Oil.iso_vg(self.grade, **further)
        if warm is None or self.thinning is None:
            raise InputError(
                "viscosity_40 and viscosity_100 must be given, or viscosity_40 and thinning, or a grade, "
                f"got {self.viscosity_40!r}, {self.viscosity_100!r} and {self.thinning!r}"
            )
        density = float(Oil.constant(1.0, **further).density(WARM))
        return Oil.thinning_at(warm * density, WARM, self.thinning, **further)

    @property
    def cooling(self) -> Cooling:
        """What cools the oil; InputError where the supply temperature is not given."""
        if self.supply_temperature is None:
            raise InputError("supply_temperature must be given where the oil has a viscosity, got None")
        return made_from(Cooling, self)

    @property
    def properties(self) -> Lubricant:
        """What the checks of left-out physics need: as given, of the fresh oil, or assumed."""
        known: dict[str, float] = {"bulk_modulus": self.bulk_modulus}
        if self.has_viscosity:
            oil, fresh = self.oil, self.cooling.supply_temperature
            known |= {
                "density": float(oil.density(fresh)),
                "heat_capacity": float(oil.heat_capacity(fresh)),
                "conductivity": oil.conductivity,
                "thinning": float(oil.thinning(fresh)),
            }
        names = ("density", "heat_capacity", "conductivity", "thinning")
        given = {name: getattr(self, name) for name in names if getattr(self, name) is not None}
        return Lubricant(**{**known, **given})


class OiledTable(Taking):
    """The table of a bearing, a dataclass with `viscosity`, `oil` and `cooling`, on the oil of a scene."""

    not_keys = ("oil", "cooling", "temperature")

    @property
    def has_lubricant(self) -> bool:
        """Whether there is a viscosity, or the oil of the scene."""
        return self.viscosity is not None or self.oil is not None

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has a viscosity or an oil.

        Parameters
        ----------
        where : str
            Its name in the file, for messages.
        lubricant : LubricantTable

        Raises
        ------
        InputError
            If neither gives a viscosity.
        """
        if self.has_lubricant:
            return self
        if not lubricant.has_viscosity:
            raise InputError(f"{where}.viscosity is required where [lubricant] gives no grade or viscosity")
        return replace(self, oil=lubricant.oil, cooling=lubricant.cooling)  # type: ignore[type-var]
