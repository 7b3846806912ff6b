"""What all bearings made of pads are given: dimensions, one of two clearances, and the lubricant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...errors import InputError, require_each, require_positive
from ..oil import Cooling, Oil
from ..oil.lubricant import require_lubricant
from ..oil.warm_bearing import WarmBearing

_ROUNDOFF = 5e-14
"""Force that a map or a grid leaves of a few pads, over viscosity length radius^3 speed/clearance^2."""


@dataclass(frozen=True, kw_only=True)
class PadBearing(WarmBearing):
    """Pads around a journal, as `LobedBearing`, `PressureDamBearing` and `TiltingPadBearing` have them.

    A bearing adds its pads, `preloads` and `extents`.

    Parameters
    ----------
    radius : float [m]
        Journal radius; or `diameter`, twice that.
    length : float [m]
        Axial length of the pads.
    pad_clearance : float or None [m]
        Radial clearance c_p of a pad: its radius of curvature less that of the journal. Give this or the
        assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p, as drawings and ROSS have it: the least gap around a centered journal; for
        pads of one preload.
    viscosity : float or None [Pa s]
        Dynamic viscosity of the lubricant, the same at all temperatures; None where `oil` is given.
    oil : Oil or None
        The lubricant by its viscosity over temperature, in place of `viscosity`.
    temperature : float or None [K]
        Of the films, where the oil is given; None leaves it to the heat balance, with `cooling`, of a journal
        at rest: `equilibrium` finds it.
    cooling : Cooling or None
        What takes the heat away; needed for a heat balance only. Its carry-over is from pad to pad.

    Raises
    ------
    InputError
        If a dimension is not finite and positive, viscosity and oil are not one of both, an oil has neither
        temperature nor cooling, there are not one of both clearances, or it is not below the radius.
    """

    radius: float
    length: float
    pad_clearance: float | None = None
    assembled_clearance: float | None = None
    viscosity: float | None = None
    oil: Oil | None = None
    temperature: float | None = None
    cooling: Cooling | None = None

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "length")
        require_lubricant(self.viscosity, self.oil, self.temperature, self.cooling)
        self._require_clearance()

    def _require_clearance(self) -> None:
        given = {name: getattr(self, name) for name in ("pad_clearance", "assembled_clearance")}
        told = {name: value for name, value in given.items() if value is not None}
        if len(told) != 1:
            raise InputError(f"pad_clearance or assembled_clearance must be given, one of both, got {given}")
        for name, value in told.items():
            require_positive(name, value)
        preloads = sorted(set(self.preloads))
        if self.pad_clearance is None and len(preloads) > 1:
            raise InputError(f"pads must have one preload for an assembled_clearance, got {preloads}")
        if self.clearance >= self.radius:
            raise InputError(
                f"pad clearance must be below the radius {self.radius!r}, got {self.clearance!r}"
            )

    @property
    def preloads(self) -> Sequence[float]:
        """Preload of each pad [1], or the one that all have."""
        raise NotImplementedError

    @property
    def extents(self) -> Sequence[float]:
        """Angle that each pad covers [rad], or the one that all cover."""
        raise NotImplementedError

    @property
    def clearance(self) -> float:
        """Radial clearance c_p of a pad [m], the unit of eccentricity ratios."""
        if self.pad_clearance is not None:
            return self.pad_clearance
        assert self.assembled_clearance is not None  # one of both is given
        return self.assembled_clearance / (1.0 - self.preloads[0])

    @property
    def bore_clearance(self) -> float:
        """Clearance c_b of the assembled bearing [m], that of the pads with most preload."""
        return self.clearance * (1.0 - max(self.preloads))

    def force_noise(self, speed: float) -> float:
        """Return what roundoff leaves of the force [N], as pads press each other; see `NoisyReaction`."""
        return _ROUNDOFF * self.force_scale * abs(speed)
