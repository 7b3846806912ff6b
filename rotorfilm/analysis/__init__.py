"""Analyses: equilibrium, coefficients, modes, thresholds, unbalance response, orbits and transients."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .api617 import (
        AxialStage as AxialStage,
        DisturbingStage as DisturbingStage,
        Impeller as Impeller,
        StabilityCurve as StabilityCurve,
        StabilityLevelOne as StabilityLevelOne,
        StabilityLevelTwo as StabilityLevelTwo,
        stability_level_one as stability_level_one,
        stability_level_two as stability_level_two,
    )
    from .axial_torsional import (
        AxialSpring as AxialSpring,
        AxialStatics as AxialStatics,
        AxialTorsionalModes as AxialTorsionalModes,
        TorsionalSpring as TorsionalSpring,
        axial_modes as axial_modes,
        axial_response as axial_response,
        axial_statics as axial_statics,
        collar_response as collar_response,
        stress_stiffened as stress_stiffened,
        torsional_modes as torsional_modes,
    )
    from .basins import BasinScan as BasinScan, basin_scan as basin_scan
    from .circular_orbits import (
        BistableMap,
        Fold,
        OrbitBranch,
        OrbitCoefficients,
        OrbitsOverSpeed as OrbitsOverSpeed,
        SynchronousOrbits,
        bistability_limit as bistability_limit,
        bistable_map as bistable_map,
        cartesian_state,
        orbit_coefficients as orbit_coefficients,
        orbit_system as orbit_system,
        orbits_over_speed as orbits_over_speed,
        polar_acceleration,
        polar_series,
        small_motion_transmissibility as small_motion_transmissibility,
        synchronous_orbits as synchronous_orbits,
        transmitted_ratio as transmitted_ratio,
    )
    from .clearance_check import (
        ClearanceCheck as ClearanceCheck,
        clearance_check as clearance_check,
        vibration_limit as vibration_limit,
    )
    from .closed_loop import (
        DeflectedShape as DeflectedShape,
        base_response as base_response,
        base_system as base_system,
        closed_loop as closed_loop,
        deflected_shape as deflected_shape,
        harmonic_response as harmonic_response,
        receptance as receptance,
        rotor_system as rotor_system,
        rotor_transmissibility as rotor_transmissibility,
        transmissibility as transmissibility,
        unbalance_response as unbalance_response,
    )
    from .coefficients import (
        VariableCompliance as VariableCompliance,
        coefficient_table as coefficient_table,
        coefficients as coefficients,
        dynamic_stiffness as dynamic_stiffness,
        frozen_coefficients as frozen_coefficients,
        quasi_static_coefficients as quasi_static_coefficients,
        variable_compliance as variable_compliance,
    )
    from .compiled_march import simulate_rotor as simulate_rotor
    from .continuation import (
        Bifurcation as Bifurcation,
        HopfPoint as HopfPoint,
        OrbitCurve as OrbitCurve,
        OrbitEvent as OrbitEvent,
        continue_orbits as continue_orbits,
        hopf_point as hopf_point,
    )
    from .cracked_response import CrackedResponse as CrackedResponse, cracked_response as cracked_response
    from .critical import critical_speed_map as critical_speed_map
    from .equilibrium import (
        HeatedEquilibrium as HeatedEquilibrium,
        equilibria as equilibria,
        equilibrium as equilibrium,
        heated_equilibrium as heated_equilibrium,
    )
    from .linearize import (
        FilmSystem as FilmSystem,
        OperatingPoint as OperatingPoint,
        film_system as film_system,
        linearize as linearize,
    )
    from .many_runs import simulate_many as simulate_many
    from .nonlinear_system import ModelSystem, to_nlsys as to_nlsys
    from .periodic_orbit import PeriodicOrbit as PeriodicOrbit, periodic_orbit as periodic_orbit
    from .rotor_equilibrium import (
        RotorEquilibrium as RotorEquilibrium,
        rotor_equilibrium as rotor_equilibrium,
    )
    from .rotor_modes import (
        Campbell as Campbell,
        CriticalSpeed as CriticalSpeed,
        RotorModes as RotorModes,
        campbell as campbell,
        critical_speeds as critical_speeds,
        resonant_speeds as resonant_speeds,
        rotor_modes as rotor_modes,
    )
    from .rotor_thresholds import (
        RotorThreshold as RotorThreshold,
        StabilityChange as StabilityChange,
        rotor_threshold as rotor_threshold,
        stability_changes as stability_changes,
    )
    from .run_spectra import (
        RunAmplitudes as RunAmplitudes,
        RunOrbits as RunOrbits,
        RunSpectra as RunSpectra,
        RunSpectrum as RunSpectrum,
        RunWhirl as RunWhirl,
        run_amplitudes as run_amplitudes,
        run_orbits as run_orbits,
        run_spectra as run_spectra,
        run_spectrum as run_spectrum,
        run_whirl as run_whirl,
        whirl_verdict,
    )
    from .shaft_statics import (
        ShaftStatics as ShaftStatics,
        rigid_support_speed as rigid_support_speed,
        shaft_statics as shaft_statics,
    )
    from .simulate import (
        RingContacts as RingContacts,
        ring_contacts as ring_contacts,
        simulate as simulate,
        time_response as time_response,
    )
    from .unbalance_margins import (
        MeshConvergence as MeshConvergence,
        ResonancePeak as ResonancePeak,
        SeparationMargins as SeparationMargins,
        amplification_factor as amplification_factor,
        bow_response as bow_response,
        mesh_convergence as mesh_convergence,
        mode_unbalances as mode_unbalances,
        required_margin as required_margin,
        residual_unbalance as residual_unbalance,
        separation_margins as separation_margins,
        tracked_response as tracked_response,
    )
    from .whirl import (
        CriticalMass as CriticalMass,
        VerifiedCriticalMass as VerifiedCriticalMass,
        VerifiedThreshold as VerifiedThreshold,
        critical_mass as critical_mass,
        damping_has_rank_one,
        speed_parameter,
        threshold_near,
        whirl_threshold as whirl_threshold,
    )
else:
    show(__name__)
