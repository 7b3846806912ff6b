"""What joins the nodes of a shaft: pieces of shaft of a material, and couplings."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...errors import InputError, require_non_negative, require_number, require_positive
from ...inputs.si_arguments import quantities
from .beam import POINTS, Beam, BeamMatrices, Section, beam_matrices, cowper_coefficient, round_section


@quantities
@dataclass(frozen=True, kw_only=True)
class ElasticMaterial:
    """An elastic material.

    Parameters
    ----------
    young_modulus, shear_modulus : float [Pa]
        Elastic moduli in tension and in shear.
    density : float [kg/m3]
    """

    young_modulus: float
    shear_modulus: float
    density: float

    def __post_init__(self) -> None:
        for name in ("young_modulus", "shear_modulus", "density"):
            require_positive(name, getattr(self, name))

    @property
    def poisson_ratio(self) -> float:
        """E / (2 G) - 1 [1]."""
        return self.young_modulus / (2.0 * self.shear_modulus) - 1.0


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftElement:
    """A piece of shaft between two nodes: a cylinder, or a cone where a diameter changes along it.

    Parameters
    ----------
    length, outer_diameter, inner_diameter : float [m]
        Diameters at the first node, and along the whole element unless it is a cone.
    material : ElasticMaterial
    shear_coefficient : float or None [1]
        kappa; by default that of Cowper for a round section (in the middle of a cone), infinite for a section
        that does not shear.
    end_outer_diameter, end_inner_diameter : float or None [m]
        Diameters at the second node of a cone; None for the same as at the first.
    axial_force : float [N]
        Static tension; negative for compression.
    torque : float [N m]
        Static torque, which follows the tilt of the shaft.
    mass_damping, stiffness_damping : float [1/s, s]
        Proportional damping alpha M + beta K of this piece alone against the ground, besides that of the
        rotor.

    Raises
    ------
    InputError
        If a dimension is not positive, or the bore is not below the outer diameter.
    """

    length: float
    outer_diameter: float
    inner_diameter: float = 0.0
    material: ElasticMaterial
    shear_coefficient: float | None = None
    end_outer_diameter: float | None = None
    end_inner_diameter: float | None = None
    axial_force: float = 0.0
    torque: float = 0.0
    mass_damping: float = 0.0
    stiffness_damping: float = 0.0

    def __post_init__(self) -> None:
        require_positive("length", self.length)
        require_non_negative("mass_damping", self.mass_damping)
        require_non_negative("stiffness_damping", self.stiffness_damping)
        require_number("axial_force", self.axial_force)
        require_number("torque", self.torque)
        outer, inner = self._ends
        for prefix, out, bore in zip(("", "end_"), outer, inner, strict=True):
            require_positive(f"{prefix}outer_diameter", out)
            require_non_negative(f"{prefix}inner_diameter", bore)
            if bore >= out:
                raise InputError(
                    f"{prefix}inner_diameter must be below {prefix}outer_diameter {out!r}, got {bore!r}"
                )
        if self.shear_coefficient is not None and not self.shear_coefficient > 0.0:
            raise InputError(f"shear_coefficient must be positive, got {self.shear_coefficient!r}")

    @property
    def _ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Outer and inner diameter at both nodes [m]."""
        out, bore = self.end_outer_diameter, self.end_inner_diameter
        return (
            (self.outer_diameter, self.outer_diameter if out is None else out),
            (self.inner_diameter, self.inner_diameter if bore is None else bore),
        )

    @property
    def tapered(self) -> bool:
        """Whether a diameter changes along the element."""
        return any(start != end for start, end in self._ends)

    def split(self, pieces: int) -> tuple[ShaftElement, ...]:
        """Return this piece of shaft as so many equally long elements."""
        if pieces < 1:
            raise InputError(f"pieces must be at least 1, got {pieces!r}")
        short = replace(self, length=self.length / pieces)
        if not self.tapered:
            return (short,) * pieces
        outer, inner = (np.linspace(*ends, pieces + 1).tolist() for ends in self._ends)
        return tuple(
            replace(
                short,
                outer_diameter=outer[k],
                inner_diameter=inner[k],
                end_outer_diameter=outer[k + 1],
                end_inner_diameter=inner[k + 1],
            )
            for k in range(pieces)
        )

    def section(self) -> Section:
        """Return stiffness and inertia of the cross section: of a cone, along it."""
        places = POINTS if self.tapered else 0.0
        outer, inner = (start + (end - start) * places for start, end in self._ends)
        kappa = self.shear_coefficient
        if kappa is None:
            (a, b), (c, d) = self._ends
            kappa = cowper_coefficient(self.material.poisson_ratio, (c + d) / (a + b))
        return round_section(
            outer_diameter=outer,
            inner_diameter=inner,
            young_modulus=self.material.young_modulus,
            shear=kappa * self.material.shear_modulus,
            density=self.material.density,
        )

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        return beam_matrices(beam, self.section(), self.length)


@quantities
@dataclass(frozen=True, kw_only=True)
class LayeredElement:
    """Pieces of shaft inside each other, as a shaft and its sleeve: one deflection and tilt for all.

    Parameters
    ----------
    layers : tuple of ShaftElement
        Of equal length and proportional damping.
    """

    layers: tuple[ShaftElement, ...]

    def __post_init__(self) -> None:
        lengths = {layer.length for layer in self.layers}
        if len(lengths) != 1:
            raise InputError(f"layers must be of equal length, got {sorted(lengths)}")
        dampings = {(layer.mass_damping, layer.stiffness_damping) for layer in self.layers}
        if len(dampings) != 1:
            raise InputError(
                f"layers must have equal mass_damping, stiffness_damping, got {sorted(dampings)}"
            )

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.layers[0].length

    @property
    def axial_force(self) -> float:
        """Static tension of all layers [N]."""
        return sum(layer.axial_force for layer in self.layers)

    @property
    def torque(self) -> float:
        """Static torque of all layers [N m]."""
        return sum(layer.torque for layer in self.layers)

    @property
    def mass_damping(self) -> float:
        """Proportional damping of each layer by its mass [1/s]."""
        return self.layers[0].mass_damping

    @property
    def stiffness_damping(self) -> float:
        """Proportional damping of each layer by its stiffness [s]."""
        return self.layers[0].stiffness_damping

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        sections = [layer.section() for layer in self.layers]
        return beam_matrices(
            beam, Section(*(sum(parts) for parts in zip(*sections, strict=True))), self.length
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class Coupling:
    """An elastic coupling without length or mass between two nodes; its flanges are disks.

    Parameters
    ----------
    stiffness : float [N/m]
        Against deflection of one side from the other.
    tilt_stiffness : float [N m/rad]
        Against tilt of one side from the other.
    axial_stiffness : float or None [N/m]
        Along the shaft; for its axial modes.
    twist_stiffness : float or None [N m/rad]
        About the shaft; for its torsional modes.
    """

    stiffness: float
    tilt_stiffness: float
    axial_stiffness: float | None = None
    twist_stiffness: float | None = None

    length = 0.0
    axial_force = 0.0
    torque = 0.0
    mass_damping = 0.0
    stiffness_damping = 0.0

    def __post_init__(self) -> None:
        require_positive("stiffness", self.stiffness)
        require_non_negative("tilt_stiffness", self.tilt_stiffness)
        for name in ("axial_stiffness", "twist_stiffness"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))

    def matrices(self, beam: Beam) -> BeamMatrices:
        """Return the matrices of one plane."""
        springs = np.diag((self.stiffness, self.tilt_stiffness))
        none = np.zeros((4, 4))
        elastic = np.asarray(np.kron([[1.0, -1.0], [-1.0, 1.0]], springs), dtype=float)
        return BeamMatrices(none, none, elastic, none, none)


ShaftPiece = ShaftElement | LayeredElement | Coupling
"""What joins one node to the next."""
