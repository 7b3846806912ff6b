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
        "DamperGroups",
        "Friction",
        "JournalBearing",
        "LinerMaterial",
        "MeltingBush",
        "PorousCage",
        "PorousDamper",
        "RadialFeed",
        "ShaftMaterial",
        "Sprung",
        "build_groove_map",
        "damper_groups",
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
        "FiniteMapSqueeze",
        "FiniteSqueeze",
        "FixedArc",
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
        "PublishedSqueeze",
        "ReynoldsArc",
        "Pad",
        "ReynoldsFilm",
        "RotatingArc",
        "SharedMelting",
        "ShortFilm",
        "ShortSqueeze",
        "SpectralArcFilm",
        "SplittingFilm",
    ),
    "fmu": ("export_fmu",),
    "linear": (
        "CriticalMass",
        "OperatingPoint",
        "closed_loop",
        "coefficients",
        "critical_mass",
        "equilibrium",
        "linearize",
        "orbit_coefficients",
        "orbit_system",
        "small_motion_transmissibility",
        "to_nlsys",
        "transmissibility",
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
    "results": ("CircularOrbit", "Coefficients", "Equilibrium", "Trajectory", "WhirlThreshold"),
    "rotors": ("RigidRotor", "SpeedProfile"),
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
