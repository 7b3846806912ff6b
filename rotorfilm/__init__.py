"""Bearing reactions for rotor dynamics, handed to any simulator.

What most scripts need is here; the rest is public in its package, as `rotorfilm.analysis.basin_scan`.
Names and packages load on first use, so that `import rotorfilm` costs nothing that is not needed.
"""

from typing import TYPE_CHECKING

from .core.sources import offer, show

if TYPE_CHECKING:
    from .analysis import (
        OperatingPoint as OperatingPoint,
        base_response as base_response,
        base_system as base_system,
        campbell as campbell,
        closed_loop as closed_loop,
        coefficients as coefficients,
        continue_orbits as continue_orbits,
        cracked_response as cracked_response,
        critical_mass as critical_mass,
        critical_speed_map as critical_speed_map,
        critical_speeds as critical_speeds,
        equilibrium as equilibrium,
        film_system as film_system,
        heated_equilibrium as heated_equilibrium,
        hopf_point as hopf_point,
        linearize as linearize,
        orbit_coefficients as orbit_coefficients,
        periodic_orbit as periodic_orbit,
        ring_contacts as ring_contacts,
        rotor_equilibrium as rotor_equilibrium,
        rotor_modes as rotor_modes,
        rotor_system as rotor_system,
        rotor_threshold as rotor_threshold,
        rotor_transmissibility as rotor_transmissibility,
        separation_margins as separation_margins,
        shaft_statics as shaft_statics,
        simulate as simulate,
        simulate_rotor as simulate_rotor,
        small_motion_transmissibility as small_motion_transmissibility,
        stability_level_one as stability_level_one,
        stability_level_two as stability_level_two,
        synchronous_orbits as synchronous_orbits,
        transmissibility as transmissibility,
        unbalance_response as unbalance_response,
        variable_compliance as variable_compliance,
        whirl_threshold as whirl_threshold,
    )
    from .bearings import (
        AnnularSeal as AnnularSeal,
        BallBearing as BallBearing,
        BallSupport as BallSupport,
        BearingPair as BearingPair,
        BushReaction as BushReaction,
        BushWear as BushWear,
        ContactGrid as ContactGrid,
        ContactLaw as ContactLaw,
        Cooling as Cooling,
        DamperSupply as DamperSupply,
        EndSeal as EndSeal,
        FeedHole as FeedHole,
        FiniteMapSqueeze as FiniteMapSqueeze,
        FiniteSqueeze as FiniteSqueeze,
        FrequencyDependentReaction as FrequencyDependentReaction,
        Friction as Friction,
        FullFilm as FullFilm,
        Groove as Groove,
        GroovedMapFilm as GroovedMapFilm,
        HeatedBearing as HeatedBearing,
        HeatedFilm as HeatedFilm,
        HeatedJFOFilm as HeatedJFOFilm,
        JFODamper as JFODamper,
        JFOFilm as JFOFilm,
        JournalBearing as JournalBearing,
        LinearBearing as LinearBearing,
        Lobe as Lobe,
        LobedBearing as LobedBearing,
        MapFilm as MapFilm,
        MeltingBush as MeltingBush,
        MomentCarryingBalls as MomentCarryingBalls,
        Oil as Oil,
        Pad as Pad,
        Parallel as Parallel,
        PointContact as PointContact,
        PorousCage as PorousCage,
        PorousDamper as PorousDamper,
        PressureDamBearing as PressureDamBearing,
        RadialFeed as RadialFeed,
        ReynoldsFilm as ReynoldsFilm,
        RollingBall as RollingBall,
        RollingMaterial as RollingMaterial,
        RubRing as RubRing,
        RunningBalls as RunningBalls,
        ShortFilm as ShortFilm,
        ShortSqueeze as ShortSqueeze,
        SplittingFilm as SplittingFilm,
        SqueezeFilmDamper as SqueezeFilmDamper,
        StaticBalls as StaticBalls,
        TabulatedBearing as TabulatedBearing,
        ThrustBearing as ThrustBearing,
        TiltingPadBearing as TiltingPadBearing,
        VariableComplianceBalls as VariableComplianceBalls,
        as_reaction as as_reaction,
        back_to_back as back_to_back,
        even_pivots as even_pivots,
        face_to_face as face_to_face,
        film_state as film_state,
        lobe_set as lobe_set,
        lubricated_balls as lubricated_balls,
        pressure_dam_pads as pressure_dam_pads,
        reduce_ball as reduce_ball,
        reduce_contact as reduce_contact,
        tandem as tandem,
        with_springs as with_springs,
    )
    from .core import (
        Coefficients as Coefficients,
        ContactError as ContactError,
        ConvergenceError as ConvergenceError,
        CouplingError as CouplingError,
        Dynamic as Dynamic,
        Equilibrium as Equilibrium,
        EquilibriumError as EquilibriumError,
        FilmContactError as FilmContactError,
        FmuError as FmuError,
        InputError as InputError,
        Linearization as Linearization,
        Model as Model,
        PartialResultError as PartialResultError,
        Reaction as Reaction,
        RotorfilmError as RotorfilmError,
        SceneError as SceneError,
        Stepped as Stepped,
        Trajectory as Trajectory,
        UndefinedDerivativeError as UndefinedDerivativeError,
        ValidityWarning as ValidityWarning,
        WhirlThreshold as WhirlThreshold,
    )
    from .cosim import (
        Auto as Auto,
        GaussSeidel as GaussSeidel,
        Jacobi as Jacobi,
        Newton as Newton,
        SIExp3 as SIExp3,
        cosimulate as cosimulate,
        coupling_stability as coupling_stability,
        critical_macro_step as critical_macro_step,
    )
    from .fmu import (
        export_fmu as export_fmu,
        export_ssp as export_ssp,
    )
    from .identification import (
        Measurements as Measurements,
        fit_bearing as fit_bearing,
    )
    from .rotors import (
        BaseExcitedRotor as BaseExcitedRotor,
        BaseMotion as BaseMotion,
        ClassicalBeam as ClassicalBeam,
        Coupling as Coupling,
        CrackedRotor as CrackedRotor,
        Disk as Disk,
        ElasticMaterial as ElasticMaterial,
        JeffcottRotor as JeffcottRotor,
        MotorDrivenRotor as MotorDrivenRotor,
        Probe as Probe,
        RigidRotor as RigidRotor,
        RigidShaft as RigidShaft,
        ShaftElement as ShaftElement,
        ShaftRotor as ShaftRotor,
        SpeedProfile as SpeedProfile,
        Station as Station,
        Unbalance as Unbalance,
        mount as mount,
        reduce_rotor as reduce_rotor,
    )
    from .scenes import (
        Scene as Scene,
        bundled_scene as bundled_scene,
        export_rotor_fmu as export_rotor_fmu,
        read_ross as read_ross,
        to_ross as to_ross,
    )
    from .sweeps import (
        sweep as sweep,
    )

    __version__: str
else:
    show(__name__)

offer("plot_result", f"{__name__}.charts")  # which `plot()` of results calls
offer("TabulatedBearing", f"{__name__}.bearings")  # which `coefficient_table` makes
offer("simulate_rotor", f"{__name__}.analysis")  # which the reference of an FMU calls
offer("whirl_verdict", f"{__name__}.analysis")  # which a printed run calls
offer("ask", f"{__name__}.questions")  # which scenes with a question call
offer("report_scene", f"{__name__}.reports")  # which `report()` of scenes calls
offer("ladders_of", f"{__name__}.questions")  # which a new scene lists
