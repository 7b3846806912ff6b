"""Waves of the races of a ball bearing."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import require_count, require_each, require_number
from ...inputs.si_arguments import quantities


@quantities
@dataclass(frozen=True, kw_only=True)
class Waviness:
    """One wave of the races of one ring: amplitude cos(lobes (angle - angle of the ring) + phase).

    With Z balls, lobes of m Z move the shaft along itself and change its stiffness, those of m Z + 1 and
    m Z - 1 move it across.

    Parameters
    ----------
    inner : bool
        Whether it is on the inner ring, which turns, or on the outer one, which stands.
    lobes : int
        Around the circumference.
    radial_amplitude : float [m]
        Added radially to the distance of the groove centers: positive where it takes clearance.
    axial_amplitude : float [m]
        The same along the thrust that the row carries.
    phase : float [rad]
        At the angle of the ring, from +x.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    inner: bool
    lobes: int
    radial_amplitude: float
    axial_amplitude: float = 0.0
    phase: float = 0.0

    def __post_init__(self) -> None:
        require_count("lobes", self.lobes)
        require_each(self, require_number, "radial_amplitude", "axial_amplitude", "phase")

    @property
    def numbers(self) -> tuple[float, float, float, float, float]:
        """As the compiled kernel reads it."""
        return float(self.inner), float(self.lobes), self.radial_amplitude, self.axial_amplitude, self.phase
