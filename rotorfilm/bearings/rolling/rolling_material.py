"""What balls and rings are made of."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import InputError, require_each, require_number, require_positive
from ...inputs.si_arguments import quantities


@quantities
@dataclass(frozen=True, kw_only=True)
class RollingMaterial:
    """An elastic material of balls or rings; `steel` and `silicon_nitride` are the usual two.

    Parameters
    ----------
    young_modulus : float [Pa]
    poisson_ratio : float [1]
    density : float [kg/m3]

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    young_modulus: float
    poisson_ratio: float
    density: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "young_modulus", "density")
        if not -1.0 < require_number("poisson_ratio", self.poisson_ratio) <= 0.5:
            raise InputError(f"poisson_ratio must be above -1 and at most 0.5, got {self.poisson_ratio!r}")

    @classmethod
    def steel(cls) -> RollingMaterial:
        """Return bearing steel by usual figures of catalogs: 207 GPa, 0.3, 7800 kg/m3."""
        return cls(young_modulus=207e9, poisson_ratio=0.3, density=7800.0)

    @classmethod
    def silicon_nitride(cls) -> RollingMaterial:
        """Return the ceramic of hybrid bearings by usual figures of catalogs: 314 GPa, 0.26, 3200 kg/m3."""
        return cls(young_modulus=314e9, poisson_ratio=0.26, density=3200.0)

    @property
    def compliance(self) -> float:
        """(1 - nu^2)/E [1/Pa]."""
        return (1.0 - self.poisson_ratio**2) / self.young_modulus
