"""Rotors: what a bearing carries, as Dynamic models."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .base_excitation import (
        BaseExcitedRotor as BaseExcitedRotor,
        BaseMotion as BaseMotion,
        ForcedRotor as ForcedRotor,
        SkewedCollar,
        TimeExcitedRotor,
        node_loads,
        translations,
    )
    from .cracked_rotor import (
        Breathing,
        CrackedRotor as CrackedRotor,
        GaschHinge as GaschHinge,
        JeffcottCrack as JeffcottCrack,
        MayesDaviesBreathing as MayesDaviesBreathing,
        OpenCrack as OpenCrack,
        ShaftCrack as ShaftCrack,
        crack_compliance as crack_compliance,
    )
    from .force_law import ForceLaw, LawRotor
    from .motor import LinearMotor as LinearMotor, MotorDrivenRotor as MotorDrivenRotor
    from .mounted import MountedRotor as MountedRotor, UnbalancePlane as UnbalancePlane, mount as mount
    from .prescribed_speed import SpeedInputRotor, SteadyRotor as SteadyRotor
    from .profile import SpeedProfile as SpeedProfile
    from .reduced_rotor import (
        ModallyDampedRotor as ModallyDampedRotor,
        ReducedRotor as ReducedRotor,
        Reduction as Reduction,
        reduce_rotor as reduce_rotor,
    )
    from .rigid import JeffcottRotor as JeffcottRotor, RigidRotor as RigidRotor, RigidShaft as RigidShaft
    from .shaft_elements import (
        Beam,
        ClassicalBeam as ClassicalBeam,
        Coupling as Coupling,
        Disk as Disk,
        ElasticMaterial as ElasticMaterial,
        FourthOrderBeam as FourthOrderBeam,
        LayeredElement as LayeredElement,
        Probe as Probe,
        ShaftElement as ShaftElement,
        Station as Station,
        Support as Support,
        TiltSpring as TiltSpring,
        Unbalance as Unbalance,
        cowper_coefficient,
    )
    from .shaft_rotor import ShaftRotor as ShaftRotor
    from .structure import FlexibleRotor as FlexibleRotor, require_flexible
else:
    show(__name__)
