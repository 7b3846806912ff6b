"""Rotors: what a bearing carries, as Dynamic models."""

from .force_law import ForceLaw
from .jeffcott import JeffcottRotor
from .law_rotor import LawRotor
from .mounted import MountedRotor, mount
from .profile import SpeedProfile
from .rigid import RigidRotor
from .rigid_shaft import RigidShaft
from .shaft.beam import Beam, ClassicalBeam, FourthOrderBeam, cowper_coefficient
from .shaft.elements import Coupling, ElasticMaterial, LayeredElement, ShaftElement
from .shaft.parts import Disk, Probe, Station, Support, TiltSpring, Unbalance
from .shaft.reduce_rotor import Reduction, reduce_rotor
from .shaft.reduced_rotor import ReducedRotor
from .shaft.shaft_rotor import ShaftRotor
from .steady import SteadyRotor
from .structure import FlexibleRotor
