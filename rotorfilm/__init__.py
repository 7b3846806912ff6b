"""Bearing reactions for rotor dynamics, handed to any simulator.

The public names below load on first use, so that `import rotorfilm` costs nothing that is not needed.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "bearings": (
        "ContactLaw",
        "JournalBearing",
        "PointContact",
        "RollingBall",
        "film_state",
        "perturbed",
        "reduce_ball",
        "reduce_contact",
        "ride",
    ),
    "cosim": ("CoSimulation", "CouplingReport", "cosimulate", "coupling_stability", "critical_macro_step"),
    "films": (
        "AdaptiveSteps",
        "BarusViscosity",
        "ComplementarityArc",
        "ContactGrid",
        "ContactRun",
        "ContactState",
        "DowsonHigginsonDensity",
        "ExtrapolatedFilm",
        "FilmLaw",
        "FixedArc",
        "FixedSteps",
        "FullFilm",
        "Groove",
        "HalfSommerfeld",
        "MapFilm",
        "MapTable",
        "Pad",
        "ReynoldsArc",
        "ReynoldsFilm",
        "RoelandsViscosity",
        "RotatingArc",
        "ShortFilm",
        "SineLoad",
        "SpectralArcFilm",
        "SplittingFilm",
        "StaggeredScheme",
        "StepLoad",
        "UpwindScheme",
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
        "to_nlsys",
        "transmissibility",
        "whirl_threshold",
    ),
    "model": ("Dynamic", "Linearization", "Model", "Reaction", "Stepped"),
    "results": ("Coefficients", "Equilibrium", "Trajectory", "WhirlThreshold"),
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
