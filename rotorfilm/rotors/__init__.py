"""Rotors: what a bearing carries, as Dynamic models."""

from .beam import Beam, ClassicalBeam, FourthOrderBeam, cowper_coefficient
from .force_law import ForceLaw
from .jeffcott import JeffcottRotor
from .law_rotor import LawRotor
from .mounted import MountedRotor, mount
from .parts import (
    Coupling,
    Disk,
    ElasticMaterial,
    LayeredElement,
    Probe,
    ShaftElement,
    Station,
    Support,
    TiltSpring,
    Unbalance,
)
from .profile import SpeedProfile
from .reduced import ReducedRotor
from .rigid import RigidRotor
from .rigid_shaft import RigidShaft
from .shaft import ShaftRotor
from .steady import SteadyRotor
from .structure import FlexibleRotor

__all__ = [
    "Beam",
    "ClassicalBeam",
    "Coupling",
    "Disk",
    "ElasticMaterial",
    "FlexibleRotor",
    "ForceLaw",
    "FourthOrderBeam",
    "JeffcottRotor",
    "LawRotor",
    "LayeredElement",
    "MountedRotor",
    "Probe",
    "ReducedRotor",
    "RigidRotor",
    "RigidShaft",
    "ShaftElement",
    "ShaftRotor",
    "SpeedProfile",
    "Station",
    "SteadyRotor",
    "Support",
    "TiltSpring",
    "Unbalance",
    "cowper_coefficient",
    "mount",
]
