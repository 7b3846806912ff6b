"""Bearing reactions for rotor dynamics, handed to any simulator.

The public names below load on first use, so that `import rotorfilm` costs nothing that is not needed.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "bearings": (
        "BushGeometry",
        "BushReaction",
        "BushWear",
        "Friction",
        "JournalBearing",
        "LinearBearing",
        "LinerMaterial",
        "MeltingBush",
        "ShaftMaterial",
        "TabulatedBearing",
        "build_groove_map",
        "f4k20_bush",
        "film_state",
        "published_stage",
    ),
    "cosim": ("CoSimulation", "CouplingReport", "cosimulate", "coupling_stability", "critical_macro_step"),
    "films": (
        "ApproximateShaft",
        "ComplementarityArc",
        "ContactBalance",
        "ExactShaft",
        "ExtrapolatedFilm",
        "FilmLaw",
        "FixedArc",
        "FullFilm",
        "GlobalBalance",
        "Groove",
        "GrooveTable",
        "GroovedMapFilm",
        "HalfSommerfeld",
        "LocalMelting",
        "MapFilm",
        "MapTable",
        "ReynoldsArc",
        "Pad",
        "ReynoldsFilm",
        "RotatingArc",
        "SharedMelting",
        "ShortFilm",
        "SpectralArcFilm",
        "SplittingFilm",
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
        "coefficient_table",
        "coefficients",
        "critical_mass",
        "critical_speed_map",
        "critical_speeds",
        "equilibrium",
        "linearize",
        "rotor_equilibrium",
        "rotor_modes",
        "rotor_system",
        "rotor_threshold",
        "to_nlsys",
        "transmissibility",
        "unbalance_response",
        "whirl_threshold",
    ),
    "model": ("Dynamic", "Linearization", "Model", "Reaction", "Stepped", "Switched"),
    "reduce": ("Reduction", "reduce_rotor"),
    "results": ("Coefficients", "Equilibrium", "Trajectory", "WhirlThreshold"),
    "rotors": (
        "ClassicalBeam",
        "Coupling",
        "Disk",
        "ElasticMaterial",
        "FlexibleRotor",
        "FourthOrderBeam",
        "JeffcottRotor",
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
        "Support",
        "Unbalance",
        "mount",
    ),
    "scenes": ("Answer", "RossRotor", "Scene", "bundled_scene", "read_ross"),
    "signals": ("Signal",),
    "transient": ("simulate",),
    "errors": (
        "ContactError",
        "ConvergenceError",
        "CouplingError",
        "EquilibriumError",
        "FilmContactError",
        "FmuError",
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
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME_OF[name]}", __name__), name)


def __dir__() -> list[str]:
    return [*globals(), *__all__]
