"""Rotors: what a bearing carries, as Dynamic models."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .cracked.breathing import (
        Breathing,
        GaschHinge as GaschHinge,
        MayesDaviesBreathing as MayesDaviesBreathing,
        OpenCrack as OpenCrack,
    )
    from .cracked.crack_compliance import crack_compliance as crack_compliance
    from .cracked.cracked_rotor import CrackedRotor as CrackedRotor
    from .cracked.cracks import JeffcottCrack as JeffcottCrack, ShaftCrack as ShaftCrack
    from .driven.base_motion import (
        BaseMotion as BaseMotion,
        ShakenBaseRotor as ShakenBaseRotor,
        translations,
    )
    from .driven.linear_motor import LinearMotor as LinearMotor
    from .driven.motor_driven import MotorDrivenRotor as MotorDrivenRotor
    from .force_law import ForceLaw
    from .jeffcott import JeffcottRotor as JeffcottRotor
    from .law_rotor import LawRotor
    from .mounted import MountedRotor as MountedRotor, mount as mount
    from .profile import SpeedProfile as SpeedProfile
    from .rigid import RigidRotor as RigidRotor
    from .rigid_shaft import RigidShaft as RigidShaft
    from .shaft.beam import (
        Beam,
        ClassicalBeam as ClassicalBeam,
        FourthOrderBeam as FourthOrderBeam,
        cowper_coefficient,
    )
    from .shaft.elements import (
        Coupling as Coupling,
        ElasticMaterial as ElasticMaterial,
        LayeredElement as LayeredElement,
        ShaftElement as ShaftElement,
    )
    from .shaft.modal_damping import ModallyDampedRotor as ModallyDampedRotor
    from .shaft.parts import (
        Disk as Disk,
        Probe as Probe,
        Station as Station,
        Support as Support,
        TiltSpring as TiltSpring,
        Unbalance as Unbalance,
    )
    from .shaft.reduce_rotor import Reduction as Reduction, reduce_rotor as reduce_rotor
    from .shaft.reduced_rotor import ReducedRotor as ReducedRotor
    from .shaft.shaft_rotor import ShaftRotor as ShaftRotor
    from .steady import SteadyRotor as SteadyRotor
    from .structure import FlexibleRotor as FlexibleRotor, require_flexible
else:
    show(__name__)
