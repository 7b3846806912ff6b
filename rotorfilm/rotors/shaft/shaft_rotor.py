"""A flexible shaft of Timoshenko beam elements with disks, in any number of bearings."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...errors import InputError, require_non_negative
from ...inputs.si_arguments import quantities
from ...model import Array
from ...units import STANDARD_GRAVITY
from ..profile import SpeedProfile
from ..structure import FlexibleRotor, Structure, check_motion
from .assembly import assemble, chain_matrices, check_nodes
from .beam import Beam, FourthOrderBeam
from .elements import Coupling, ShaftPiece
from .parts import Disk, Probe, Station, TiltSpring, Unbalance


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftRotor(FlexibleRotor):
    """A shaft that bends and shears, with rotary inertia and gyroscopic effect: a Dynamic model.

    Node i is where element i begins; the last element ends at the last node. z runs along the shaft. The
    tilt of a plane is theta = dw/dz of a section that does not shear.

    Parameters
    ----------
    elements : tuple of ShaftElement, LayeredElement and Coupling
        From the first node to the last.
    speed : float or SpeedProfile [rad/s]
        Angular speed about +z.
    stations : tuple of Station
        Where bearings act; each is an input force_x, force_y and an output x, y, vx, vy.
    disks : tuple of Disk
    tilt_springs : tuple of TiltSpring
        Springs against the tilt of nodes, besides what acts at the stations.
    unbalances : tuple of Unbalance
    probes : tuple of Probe
        Nodes whose displacement is an output.
    internal_damping : float [s]
        Damping of the rotating shaft: stress = E (strain + internal_damping * strain rate). It acts on
        elements and couplings and drives forward whirl slower than the shaft.
    mass_damping, stiffness_damping : float [1/s, s]
        Proportional damping alpha M + beta K of shaft and disks against the ground: it does not turn with the
        shaft. A mode w of a free shaft has the damping ratio alpha / (2 w) + beta w / 2.
    loss_factor : float [1]
        Hysteresis of the rotating shaft: bent to and fro at any frequency in its own frame, stress leads
        strain by the angle with this tangent. For modes, thresholds and unbalance response only; over time
        it raises InputError.
    gravity : tuple of two floats [m/s2]
    beam : Beam
        The element: `FourthOrderBeam()`, or `ClassicalBeam()` as published rotors were computed with.
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.

    Raises
    ------
    InputError
        If an argument breaks its rule; of a part that is on no node, the message names the node.

    Examples
    --------
    >>> steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    >>> piece = ShaftElement(length=1.5, outer_diameter=0.05, material=steel)
    >>> rotor = ShaftRotor(
    ...     elements=piece.split(6), speed=100.0, stations=(Station(node=0, name="left"), Station(node=6))
    ... )
    >>> [signal.name for signal in rotor.inputs]
    ['left_force_x', 'left_force_y', 'force_x', 'force_y']
    """

    elements: tuple[ShaftPiece, ...]
    speed: float | SpeedProfile
    stations: tuple[Station, ...] = ()
    disks: tuple[Disk, ...] = ()
    tilt_springs: tuple[TiltSpring, ...] = ()
    unbalances: tuple[Unbalance, ...] = ()
    probes: tuple[Probe, ...] = ()
    internal_damping: float = 0.0
    mass_damping: float = 0.0
    stiffness_damping: float = 0.0
    loss_factor: float = 0.0
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    beam: Beam = field(default_factory=FourthOrderBeam)
    initial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if all(isinstance(element, Coupling) for element in self.elements):
            raise InputError(f"elements must hold at least one ShaftElement, got {self.elements!r}")
        for name in ("internal_damping", "mass_damping", "stiffness_damping", "loss_factor"):
            require_non_negative(name, getattr(self, name))
        check_nodes(
            len(self.elements) + 1,
            {
                "stations": self.stations,
                "disks": self.disks,
                "tilt_springs": self.tilt_springs,
                "unbalances": self.unbalances,
                "probes": self.probes,
            },
        )
        check_motion(self)

    @property
    def positions(self) -> Array:
        """Where the nodes are along the shaft, shape (n_nodes,) [m]."""
        return np.cumsum([0.0, *(element.length for element in self.elements)])

    @property
    def mass(self) -> float:
        """Mass of shaft and disks, without the housings [kg]."""
        size = len(self.assembly.coordinates)
        shift = np.zeros(2 * size)
        shift[0 : 2 * (len(self.elements) + 1) : 2] = 1.0
        return float(shift @ (self.assembly.mass @ shift))

    @property
    def bending(self) -> Any:
        """Stiffness of bending and shear in one plane, without bearings and loads, sparse, (N / 2, N / 2)."""
        return chain_matrices(self.elements, self.disks, self.beam, len(self.assembly.coordinates))[2]

    def assembled(self) -> Structure:
        """Return the matrices of the rotor."""
        return assemble(
            elements=self.elements,
            disks=self.disks,
            stations=self.stations,
            tilt_springs=self.tilt_springs,
            probes=self.probes,
            unbalances=self.unbalances,
            internal_damping=self.internal_damping,
            mass_damping=self.mass_damping,
            stiffness_damping=self.stiffness_damping,
            loss_factor=self.loss_factor,
            gravity=self.gravity,
            beam=self.beam,
        )
