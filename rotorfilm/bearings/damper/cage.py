"""The cage of a damper, and what feeds lubricant to its film."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import InputError, require_each, require_number, require_positive
from ...inputs.si_arguments import quantities
from .porous_layer import PorousLayer


@quantities
@dataclass(frozen=True, kw_only=True)
class PorousCage:
    """A porous ring around the film, Darcy's law in it: k(y) = permeability exp(grading y/thickness), y <= 0.

    Parameters
    ----------
    thickness : float [m]
        H, radial thickness of the layer.
    permeability : float [m2]
        A, through the layer, at its face to the film.
    grading : float [1]
        lambda; positive where the layer is tighter at its back.
    anisotropy : float [1]
        k_z/k_y: permeability along the layer, per that through it.
    vented : bool
        Whether the back of the layer is open to `supply_pressure`; otherwise it is sealed.
    supply_pressure : float [Pa]
        Gauge pressure at a vented back.
    thin : bool
        Morgan & Cameron's layer in place of Darcy's: no pressure drop through a sealed layer, no flow along a
        vented one.

    Raises
    ------
    InputError
        If a value breaks its rule, or there is a supply pressure behind a sealed back.
    """

    thickness: float
    permeability: float
    grading: float = 0.0
    anisotropy: float = 1.0
    vented: bool = False
    supply_pressure: float = 0.0
    thin: bool = False

    def __post_init__(self) -> None:
        require_each(self, require_positive, "thickness", "permeability", "anisotropy")
        require_each(self, require_number, "grading", "supply_pressure")
        if self.supply_pressure and not self.vented:
            raise InputError(f"supply_pressure must be 0 behind a sealed back, got {self.supply_pressure!r}")

    def layer(self, length: float, clearance: float) -> PorousLayer:
        """Return this cage in the units of a film of a length and a clearance [m]."""
        return PorousLayer(
            permeability_number=self.permeability * self.thickness / clearance**3,
            grading=self.grading,
            thickness_ratio=self.thickness / length,
            anisotropy=self.anisotropy,
            vented=self.vented,
            thin=self.thin,
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class RadialFeed:
    """Lubricant pressed through the layer: a given velocity at the back of a sealed layer, or at the film.

    What the layer passes from its back to the film, the rest leaving by the layer's ends, follows from
    Darcy's law (95 % at H/L = 0.1); through a thin layer or a solid cage (jets) it is all.

    Parameters
    ----------
    inflow : float [m/s]
        Velocity towards the film, its largest along the axis; negative for suction.
    cosine : bool
        Whether the velocity falls as cos(pi z/length) from the middle to the ends; otherwise it is uniform.
    at_film : bool
        Whether it is what enters a film without pressure; otherwise what enters the back of the layer, as in
        Akhverdiev et al. (11).
    """

    inflow: float
    cosine: bool = False
    at_film: bool = False

    def __post_init__(self) -> None:
        require_number("inflow", self.inflow)


@quantities
@dataclass(frozen=True, kw_only=True)
class AxialFeed:
    """Lubricant fed at the ends of film and layer.

    Parameters
    ----------
    start_pressure, end_pressure : float [Pa]
        Gauge pressure at z = -length/2 and z = length/2. Zero is the pressure at which the film ruptures.
    """

    start_pressure: float
    end_pressure: float

    def __post_init__(self) -> None:
        require_number("start_pressure", self.start_pressure)
        require_number("end_pressure", self.end_pressure)
