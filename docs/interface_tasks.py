"""The interface page of the site: every public name once, by what one wants to do."""

from pathlib import Path

from rotorfilm.core import published
from rotorfilm.core.sources import homes

TASKS = {
    "Journal bearings and their films": (
        "bearings.journal",
        "bearings.films",
        "bearings.oil",
    ),
    "Bearings made of pads": ("bearings.pads",),
    "Thrust bearings": ("bearings.thrust",),
    "Squeeze-film dampers": ("bearings.damper",),
    "Ball bearings": ("bearings.rolling",),
    "Lubricated rolling contacts": ("bearings.contact",),
    "Bushes that wear": ("bearings.bush",),
    "Seals, rings that are rubbed, cracks": (
        "bearings.rub",
        "bearings.seal",
        "analysis.cracked_response",
        "analysis.simulate",
        "rotors.cracked_rotor",
    ),
    "Springs, tables, bearings of your own": (
        "bearings.linear",
        "bearings.own_reaction",
        "bearings.assemblies",
        "bearings.series",
        "bearings.linear_system",
        "core.port",
    ),
    "Equilibrium and coefficients": (
        "analysis.coefficients",
        "analysis.equilibrium",
        "analysis.rotor_equilibrium",
        "core.results.Coefficients",
        "core.results.FrequencyDependentCoefficients",
        "core.results.InertialCoefficients",
        "core.results.ReducedCoefficients",
        "core.results.Equilibrium",
    ),
    "Stability, critical speeds, Campbell diagrams": (
        "analysis.whirl",
        "analysis.rotor_modes",
        "analysis.continuation",
        "core.results.WhirlThreshold",
    ),
    "Response, and systems for python-control": ("analysis",),
    "Rotors": (
        "rotors",
        "scenes.ross",
    ),
    "Results and rotors in files": ("core.saved_results", "scenes.save_scene"),
    "Motion over time": (
        "analysis.compiled_march",
        "core.results.Trajectory",
    ),
    "Orbits": (
        "analysis.circular_orbits",
        "analysis.periodic_orbit",
        "analysis.basins",
        "core.results.CircularOrbit",
    ),
    "Bearings fitted to measurements": ("identification",),
    "FMUs": (
        "fmu",
        "scenes.export_scene",
    ),
    "Coupling in co-simulation": ("cosim",),
    "Scenes, questions, sweeps": (
        "scenes",
        "sweeps",
    ),
    "Models of your own: protocols and signals": (
        "core.model",
        "core.signals",
    ),
    "Errors and warnings": ("core.errors",),
}
"""Headings, and below each the folders, modules or names it shows: the longest that fits a name takes it."""


def home(name: str) -> str:
    """Return where a public name lives, below the package, as `analysis.whirl.whirl_threshold`."""
    module = published()[name]
    while name in homes(module):
        module, _ = homes(module)[name]
    return f"{module.partition('.')[2]}.{name}"


def fitting(name: str) -> list[tuple[int, str, str]]:
    """Return length, heading and place of all that fit a public name, the longest last."""
    path = f"{home(name)}."
    return sorted(
        (len(place), heading, place)
        for heading, places in TASKS.items()
        for place in places
        if path.startswith(f"{place}.")
    )


def tasks() -> dict[str, list[str]]:
    """Return the public names under each heading."""
    found: dict[str, list[str]] = {heading: [] for heading in TASKS}
    for name in sorted(published()):
        fits = fitting(name)
        if not fits:
            raise ValueError(f"TASKS of {Path(__file__).name} must have a place for {home(name)}")
        found[fits[-1][1]].append(name)
    return found


def write(path: Path) -> None:
    """Write the page of all public names."""
    lines = ["Interface", "=========", ""]
    for heading, names in tasks().items():
        lines += [heading, "-" * len(heading), "", ".. autosummary::", "   :toctree: _interface", ""]
        lines += [f"   {published()[name]}.{name}" for name in names] + [""]
    path.write_text("\n".join(lines))
