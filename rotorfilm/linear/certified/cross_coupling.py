"""The cross-coupled stiffness that the stages of a compressor are expected to have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ...errors import InputError, require_positive
from ...inputs.si_arguments import in_si, quantities

CENTRIFUGAL, AXIAL = 3.0, 1.5
"""Factors Bc and Bt of API 617."""

MOLECULAR_WEIGHT = 10.0
"""Molecular weight per unit of the factor, in the formula of Wachel."""


@runtime_checkable
class DisturbingStage(Protocol):
    """What disturbs a rotor: an impeller, a stage of blades, or one of one's own."""

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Impeller:
    """An impeller of a centrifugal compressor, with the cross-coupling that API 617 anticipates.

        q = alford_factor power / (|speed| diameter width) discharge_density / suction_density

    Parameters
    ----------
    power : float [W]
        Of this impeller, at the operating condition.
    diameter : float [m]
        Outer diameter of the impeller, Dc.
    width : float [m]
        The smaller of the widths of impeller and diffuser at the discharge, Hc.
    suction_density, discharge_density : float [kg/m3]
        Of the gas before and behind the impeller.
    alford_factor : float [1]
        Bc: 3 in API 617, molecular weight / 10 in the formula of Wachel (`Impeller.wachel`).

    Raises
    ------
    InputError
        If a number is not positive, or the gas is thinner at the discharge than at the suction.

    Notes
    -----
    Modified Alford equation, API 617, 7th ed. (2002), part 1, 2.6.5.5, and its successor in the 8th ed.;
    Wachel & von Nimitz (1981), J. Petroleum Technology 33, 2252-2260. Power / speed is the torque, so that in
    SI there is no other constant: the published C = 9.55 (N m/s, mm, rpm, kN/mm) and 63 (hp, in, rpm,
    klbf/in) are 30 / pi in those units, rounded.
    """

    power: float
    diameter: float
    width: float
    suction_density: float
    discharge_density: float
    alford_factor: float = CENTRIFUGAL

    def __post_init__(self) -> None:
        for name in ("power", "diameter", "width", "suction_density", "discharge_density", "alford_factor"):
            require_positive(name, getattr(self, name))
        if self.discharge_density < self.suction_density:
            raise InputError(
                f"discharge_density must be at least suction_density {self.suction_density!r}, "
                f"got {self.discharge_density!r}"
            )

    @classmethod
    @in_si
    def wachel(
        cls,
        *,
        power: float,
        diameter: float,
        width: float,
        suction_density: float,
        discharge_density: float,
        molecular_weight: float,
    ) -> Impeller:
        """Return an impeller by the formula of Wachel, in which a heavy gas disturbs more.

        Parameters
        ----------
        power, diameter, width, suction_density, discharge_density : float [W, m, m, kg/m3, kg/m3]
        molecular_weight : float [1]
            Of the gas; 30 is the factor of API 617.
        """
        require_positive("molecular_weight", molecular_weight)
        return cls(
            power=power,
            diameter=diameter,
            width=width,
            suction_density=suction_density,
            discharge_density=discharge_density,
            alford_factor=molecular_weight / MOLECULAR_WEIGHT,
        )

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""
        gap = abs(speed) * self.diameter * self.width
        return self.alford_factor * self.power / gap * self.discharge_density / self.suction_density


@quantities
@dataclass(frozen=True, kw_only=True)
class AxialStage:
    """A stage of axial blades, with the cross-coupling of Alford that API 617 anticipates.

        q = alford_factor power / (|speed| diameter height)

    Parameters
    ----------
    power : float [W]
        Of this stage.
    diameter : float [m]
        Pitch diameter of the blades, Dt.
    height : float [m]
        Effective height of the blades, Ht.
    alford_factor : float [1]
        Bt, 1.5 in API 617.

    Raises
    ------
    InputError
        If a number is not positive.

    Notes
    -----
    Alford (1965), J. Eng. Power 87, 333-334; API 617 as for `Impeller`.
    """

    power: float
    diameter: float
    height: float
    alford_factor: float = AXIAL

    def __post_init__(self) -> None:
        for name in ("power", "diameter", "height", "alford_factor"):
            require_positive(name, getattr(self, name))

    def cross_coupling(self, speed: float) -> float:
        """Return the anticipated cross-coupled stiffness [N/m] at an angular speed [rad/s]."""
        return self.alford_factor * self.power / (abs(speed) * self.diameter * self.height)
