"""Linear analysis: equilibrium, coefficients, whirl, and systems for python-control."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .campbell import (
        Campbell as Campbell,
        CriticalSpeed as CriticalSpeed,
        campbell as campbell,
        critical_speeds as critical_speeds,
        resonant_speeds as resonant_speeds,
    )
    from .certified.bow import bow_response as bow_response
    from .certified.cross_coupling import (
        AxialStage as AxialStage,
        DisturbingStage as DisturbingStage,
        Impeller as Impeller,
    )
    from .certified.level_one import (
        StabilityLevelOne as StabilityLevelOne,
        stability_level_one as stability_level_one,
    )
    from .certified.level_two import (
        StabilityLevelTwo as StabilityLevelTwo,
        stability_level_two as stability_level_two,
    )
    from .certified.margins import (
        ResonancePeak as ResonancePeak,
        SeparationMargins as SeparationMargins,
        amplification_factor as amplification_factor,
        required_margin as required_margin,
        separation_margins as separation_margins,
    )
    from .certified.mesh_convergence import (
        MeshConvergence as MeshConvergence,
        mesh_convergence as mesh_convergence,
    )
    from .certified.order_tracking import tracked_response as tracked_response
    from .certified.placement import (
        mode_unbalances as mode_unbalances,
        residual_unbalance as residual_unbalance,
    )
    from .certified.rigid_support import rigid_support_speed as rigid_support_speed
    from .certified.shaft_statics import ShaftStatics as ShaftStatics, shaft_statics as shaft_statics
    from .certified.stability_curve import StabilityCurve as StabilityCurve
    from .closed_loop import closed_loop as closed_loop, transmissibility as transmissibility
    from .coefficients import coefficient_table as coefficient_table, coefficients as coefficients
    from .critical.speed_map import critical_speed_map as critical_speed_map
    from .critical_mass import (
        CountedMass as CountedMass,
        CriticalMass as CriticalMass,
        critical_mass as critical_mass,
        damping_has_rank_one,
    )
    from .equilibrium import equilibrium as equilibrium
    from .heated_equilibrium import (
        HeatedEquilibrium as HeatedEquilibrium,
        heated_equilibrium as heated_equilibrium,
    )
    from .linearize import OperatingPoint as OperatingPoint, linearize as linearize
    from .memory.counted_threshold import CountedThreshold as CountedThreshold, threshold_near
    from .memory.film_system import FilmSystem as FilmSystem, film_system as film_system
    from .nonlinear_system import ModelSystem, to_nlsys as to_nlsys
    from .orbit_coefficients import (
        OrbitCoefficients,
        orbit_coefficients as orbit_coefficients,
        orbit_system as orbit_system,
        small_motion_transmissibility as small_motion_transmissibility,
    )
    from .rotor_modes import RotorModes as RotorModes, rotor_modes as rotor_modes
    from .rotor_rest import RotorEquilibrium as RotorEquilibrium, rotor_equilibrium as rotor_equilibrium
    from .rotor_system import (
        base_response as base_response,
        base_system as base_system,
        rotor_system as rotor_system,
        rotor_transmissibility as rotor_transmissibility,
        unbalance_response as unbalance_response,
    )
    from .rotor_threshold import (
        RotorThreshold as RotorThreshold,
        StabilityChange as StabilityChange,
        rotor_threshold as rotor_threshold,
        stability_changes as stability_changes,
    )
    from .straight.axial_statics import (
        AxialStatics as AxialStatics,
        axial_statics as axial_statics,
        tensioned as tensioned,
    )
    from .straight.straight_motion import (
        StraightModes as StraightModes,
        ThrustBearing as ThrustBearing,
        TwistSpring as TwistSpring,
        axial_modes as axial_modes,
        axial_response as axial_response,
        twist_modes as twist_modes,
    )
    from .whirl import speed_parameter, whirl_threshold as whirl_threshold
else:
    show(__name__)
