"""Bearing reactions for rotor dynamics, handed to any simulator.

The public names below load on first use, so that `import rotorfilm` costs nothing that is not needed.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "bearings": (
        "AxialFeed",
        "BushGeometry",
        "BushReaction",
        "BushWear",
        "ContactLaw",
        "DamperGroups",
        "Friction",
        "JournalBearing",
        "LinearBearing",
        "LinerMaterial",
        "MeltingBush",
        "PointContact",
        "PorousCage",
        "PorousDamper",
        "RadialFeed",
        "RollingBall",
        "ShaftMaterial",
        "Sprung",
        "build_groove_map",
        "damper_groups",
        "f4k20_bush",
        "film_state",
        "perturbed",
        "published_stage",
        "reduce_ball",
        "reduce_contact",
        "ride",
    ),
    "cosim": ("CoSimulation", "CouplingReport", "cosimulate", "coupling_stability", "critical_macro_step"),
    "films": (
        "AdaptiveSteps",
        "ApproximateShaft",
        "BarusViscosity",
        "ComplementarityArc",
        "ContactBalance",
        "ContactGrid",
        "ContactRun",
        "ContactState",
        "DowsonHigginsonDensity",
        "ExactShaft",
        "ExtrapolatedFilm",
        "FilmLaw",
        "FiniteMapSqueeze",
        "FiniteSqueeze",
        "FixedArc",
        "FixedSteps",
        "FullFilm",
        "GlobalBalance",
        "Groove",
        "GrooveMapTable",
        "GroovedMapFilm",
        "HalfSommerfeld",
        "LocalMelting",
        "MapFilm",
        "MapSqueeze",
        "MapTable",
        "Pad",
        "PublishedSqueeze",
        "ReynoldsArc",
        "ReynoldsFilm",
        "RoelandsViscosity",
        "RotatingArc",
        "SharedMelting",
        "ShortFilm",
        "ShortSqueeze",
        "SineLoad",
        "SpectralArcFilm",
        "SplittingFilm",
        "StaggeredScheme",
        "StepLoad",
        "UpwindScheme",
    ),
    "fmu": ("export_fmu",),
    "linear": (
        "Campbell",
        "CriticalMass",
        "CriticalSpeed",
        "OperatingPoint",
        "RotorEquilibrium",
        "RotorModes",
        "RotorThreshold",
        "campbell",
        "closed_loop",
        "coefficients",
        "critical_mass",
        "critical_speed_map",
        "critical_speeds",
        "equilibrium",
        "linearize",
        "orbit_coefficients",
        "orbit_system",
        "rotor_equilibrium",
        "rotor_modes",
        "rotor_system",
        "rotor_threshold",
        "small_motion_transmissibility",
        "to_nlsys",
        "transmissibility",
        "unbalance_response",
        "whirl_threshold",
    ),
    "model": ("Dynamic", "Linearization", "Model", "Reaction", "Stepped", "Switched"),
    "orbits": (
        "bistability_limit",
        "bistable_map",
        "orbits_over_speed",
        "synchronous_orbits",
        "transmitted_ratio",
    ),
    "reduce": ("Reduction", "reduce_rotor"),
    "results": ("CircularOrbit", "Coefficients", "Equilibrium", "Trajectory", "WhirlThreshold"),
    "rotors": (
        "ClassicalBeam",
        "Coupling",
        "Disk",
        "ElasticMaterial",
        "FlexibleRotor",
        "FourthOrderBeam",
        "JeffcottRotor",
        "MountedRotor",
        "Probe",
        "ReducedRotor",
        "RigidRotor",
        "RigidShaft",
        "ShaftElement",
        "ShaftRotor",
        "SpeedProfile",
        "Station",
        "Support",
        "Unbalance",
        "mount",
    ),
    "scenes": ("Answer", "Scene", "bundled_scene"),
    "signals": ("Signal",),
    "transient": ("simulate",),
    "errors": (
        "ContactError",
        "ConvergenceError",
        "CouplingError",
        "EquilibriumError",
        "FilmContactError",
        "FmuError",
        "FmuFileError",
        "FmuRunError",
        "InputError",
        "PartialResultError",
        "RotorfilmError",
        "SceneError",
        "UndefinedDerivativeError",
        "ValidityWarning",
    ),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME_OF)


def __getattr__(name: str) -> Any:
    """Import a public name from its home on first use (PEP 562)."""
    if name == "__version__":
        from importlib.metadata import version

        return version(__name__)
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME_OF[name]}", __name__), name)


def __dir__() -> list[str]:
    return [*globals(), *__all__]
