"""The ladder of squeeze films in one run: error against the rung above, cost, and the cost of orbit branches.

Error: difference of the force vector over random states (uniform eccentricity ratio and directions), relative
to the norm of the reference force, median and 99 %. References: films of finite length on Darcy's layer, full
and cavitated. The chart adds the damping of small motion over the grading, the published one
beside that of the layer.

    python benchmarks/damper.py [CHART.png]
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from time import process_time

import fmpy
import numpy as np
from fmu import compile_c
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from rotorfilm import (
    FiniteMapSqueeze,
    FiniteSqueeze,
    FullFilm,
    PorousCage,
    PorousDamper,
    RigidRotor,
    ShortSqueeze,
    export_fmu,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.bearings import MapSqueeze, PublishedSqueeze

COUNT, LARGEST = 200, 0.9
C, R = 1e-4, 0.05


def states() -> tuple[np.ndarray, np.ndarray]:
    """Return positions [m] and velocities [m/s], shape (2, COUNT)."""
    rng = np.random.default_rng(2)
    chi, phi = rng.uniform(0.0, LARGEST, COUNT), rng.uniform(-np.pi, np.pi, COUNT)
    return C * chi * np.stack([np.cos(phi), np.sin(phi)]), 0.04 * rng.normal(size=(2, COUNT))


def timed(call, repeats: int = 5) -> float:
    """Return the shortest time [s] of one call."""
    times = []
    for _ in range(repeats):
        begin = process_time()
        call()
        times.append(process_time() - begin)
    return min(times)


def damper(slenderness: float, phi: float, **change) -> PorousDamper:
    """Return a damper of the given L/D and permeability number; H/L = 0.1."""
    length = 2.0 * R * slenderness
    cage = PorousCage(thickness=0.1 * length, permeability=phi * C**3 / (0.1 * length), grading=0.1)
    return PorousDamper(radius=R, length=length, clearance=C, viscosity=0.01, cage=cage, **change)


def ladder(slenderness: float, phi: float) -> dict[str, tuple[float, float, float]]:
    """Print and return time of a force [s], median and 99 % error of every rung."""
    pi, full = damper(slenderness, phi), damper(slenderness, phi, extent=FullFilm())
    reference = replace(full, film=FiniteSqueeze())
    thin = replace(full.cage, thin=True)
    finite = replace(pi, film=FiniteMapSqueeze())
    rungs = {
        "published (small motion)": (replace(full, film=PublishedSqueeze()), reference),
        "solid": (replace(full, cage=None), reference),
        "Morgan-Cameron": (replace(full, cage=thin), reference),
        "Darcy": (full, reference),
        "Darcy, finite length": (reference, reference),
        "cavitated, solid": (replace(pi, cage=None), finite),
        "cavitated, Morgan-Cameron": (replace(pi, cage=thin), finite),
        "cavitated, Darcy": (pi, finite),
        "cavitated, Darcy, map": (replace(pi, film=MapSqueeze()), finite),
        "cavitated, finite length, map": (finite, finite),
    }
    q, v = states()
    found = {}
    print(f"\nL/D = {slenderness}, Phi = {phi}: time of a force in a batch, median and 99 % error")
    for name, (film, above) in rungs.items():
        expected = above.force(q, v)
        errors = np.linalg.norm(film.force(q, v) - expected, axis=0) / np.linalg.norm(expected, axis=0)
        film.force(q, v)  # a map makes its table
        cost = timed(lambda film=film: film.force(q, v)) / COUNT
        found[name] = (cost, *np.quantile(errors, (0.5, 0.99)))
        print(f"{name:31s}{1e6 * cost:10.2f} us{found[name][1]:12.1e}{found[name][2]:12.1e}")
    return found


def orbits() -> None:
    """Print the cost of all orbits at 200 unbalances."""
    rotor = RigidRotor(mass=10.0, speed=400.0, unbalance=1e-3, gravity=(0.0, 0.0))
    unbalances = 1e-3 * np.linspace(0.005, 1.0, 200)
    for name, phi in (("solid", None), ("porous", 0.001)):
        film = damper(0.25, phi or 1.0)
        film = replace(film, viscosity=4.096e-4, cage=film.cage if phi else None)
        support = with_springs(film, 2.56e5)
        cost = timed(lambda support=support: synchronous_orbits(rotor, support, unbalances))
        print(f"orbits of a {name} damper at 200 unbalances, with folds and stability: {1e3 * cost:.0f} ms")


def native() -> None:
    """Print the cost of a force in C: the map's kernel, and a step of the FMU that carries it."""
    film = replace(damper(0.25, 0.001), film=MapSqueeze())
    rng = np.random.default_rng(1)
    chi, phi = rng.uniform(0.0, 0.95, 2000), rng.uniform(-np.pi, np.pi, 2000)
    rest = np.column_stack([0.05 * rng.normal(size=(2000, 2)), np.zeros(2000)])
    rows = np.column_stack([C * chi * np.cos(phi), C * chi * np.sin(phi), rest])
    tables = film.native().tables
    cells = [count - 5 for count in tables["coefficients"].shape[1:]]
    head = [*cells, tables["map"][0], tables["center"][0], C, film.force_scale]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        path = export_fmu(film, folder / "film.fmu", component="film")
        np.array([*head, *tables["coefficients"].ravel()]).tofile(folder / "kernel.bin")
        rows.tofile(folder / "states.bin")
        description = fmpy.read_model_description(str(path))
        files = Path(fmpy.extract(str(path), unzipdir=str(folder / "files")))
        first = next(v.valueReference for v in description.modelVariables if v.name == "film.x")
        arguments = [
            compile_c("fmu_host.c", folder / "host"),
            next((files / "binaries").rglob("film.*")),
            (files / "resources").as_uri(),
            description.guid,
            first,
            folder / "kernel.bin",
            folder / "states.bin",
            400,
            4,
        ]
        ran = subprocess.run(list(map(str, arguments)), capture_output=True, text=True, check=True)
    bare, whole, error = map(float, ran.stdout.split())
    print(f"force in C: kernel {bare:.0f} ns, FMU (set, step, get) {whole:.0f} ns, difference {error:.0e}")


def centered_damping(damper: PorousDamper) -> float:
    """Return the damping in small motion per that of a solid cage."""
    solid = replace(damper, cage=None, film=ShortSqueeze())
    return damper.jacobian([0.0, 0.0], [1.0, 0.0])[0, 2] / solid.jacobian([0.0, 0.0], [1.0, 0.0])[0, 2]


def draw(found: dict[str, tuple[float, float, float]], path: Path) -> None:
    """Draw accuracy over cost, and damping over the grading."""
    figure = Figure(figsize=(13.5, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    rungs = {name: values for name, values in found.items() if values[2] > 0.0}
    for name, (cost, median, high) in rungs.items():
        left.errorbar(1e6 * cost, median, yerr=[[0.0], [high - median]], fmt="o", capsize=5, label=name)
    left.set(xscale="log", yscale="log", xlabel="CPU time of one force in a batch [us]")
    left.set(ylabel="force error [1], dot: median, bar: 99 %", title="L/D = 0.25, Phi = 0.001")
    left.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.02, 1.0))
    left.xaxis.set_minor_formatter(NullFormatter())
    gradings = np.linspace(0.0, 4.0, 81)
    full = damper(0.25, 0.02, extent=FullFilm())
    variants = {
        "Darcy": (full, {}),
        "Morgan-Cameron": (full, {"thin": True}),
        "Darcy, vented": (full, {"vented": True}),
        "published (signs corrected)": (replace(full, film=PublishedSqueeze()), {}),
    }
    right.set_prop_cycle(
        color=["tab:blue", "tab:orange", "tab:green", "tab:red"], linestyle=["-", "--", "-.", ":"]
    )
    for label, (film, change) in variants.items():
        cages = [replace(film.cage, grading=value, **change) for value in gradings]
        right.plot(gradings, [centered_damping(replace(film, cage=cage)) for cage in cages], label=label)
    right.set(
        xlabel="grading [1]",
        ylabel="damping / that of a solid cage [1]",
        title="small motion, Phi = 0.02, H/L = 0.1",
    )
    right.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.02, 1.0))
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    import warnings

    warnings.simplefilter("ignore")  # rungs outside their range are the point
    results = [ladder(slenderness, phi) for slenderness in (0.25, 0.5) for phi in (0.001, 0.1)]
    orbits()
    native()
    if len(sys.argv) > 1:
        draw(results[0], Path(sys.argv[1]))
