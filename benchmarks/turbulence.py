"""Where laminar films fail, what accuracy of a turbulent film costs, and a battery of random scenes.

    python benchmarks/turbulence.py [--out FOLDER] [--scenes 40]

The battery has its ranges and its seed fixed below: bearings of one viscosity, from the onset to ten times
its Reynolds number. The reference is the quadrature with the full stress on 192 x 16 cells.
"""

from __future__ import annotations

import argparse
import math
import time
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.bearings import ReynoldsFilm, Turbulence, full_stress_forces
from rotorfilm.bearings.films.turbulence import onset
from rotorfilm.bearings.journal import ExtrapolatedFilm
from rotorfilm.scenes.scene import parse_scene

SIZE = {"radius": 0.25, "length": 0.4, "clearance": 5e-4}
SPEED, DENSITY = 100.0 * math.pi, 855.0
LABELS = (
    [(1090.0, 0.2), (1430.0, 0.2), (2350.0, 0.2), (5300.0, 0.3)],
    [(860.0, 0.45), (1150.0, 0.45), (1650.0, 0.45), (2400.0, 0.45)],
)
"""Where the lines of force and power are named: Reynolds number and eccentricity ratio."""

QUANTITIES = ("eccentricity_ratio", "power_loss", "stiffness", "damping")
EFFECT = Turbulence(closure="reichardt", density=DENSITY)


def bearing_at(reynolds: float, effect: Turbulence | None) -> rf.JournalBearing:
    """Return the bearing of 500 mm at a Reynolds number, by its viscosity."""
    mu = DENSITY * SPEED * SIZE["radius"] * SIZE["clearance"] / reynolds
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(96, 8)))
    return rf.JournalBearing(**SIZE, viscosity=mu, film=film, turbulence=effect)


def laminar_error(reynolds: float, eccentricity_ratio: float) -> tuple[float, float]:
    """Return the relative errors of force and power of a laminar film at a place."""
    place = SIZE["clearance"] * eccentricity_ratio * np.array([math.sin(0.9), -math.cos(0.9)])
    one, other = (bearing_at(reynolds, effect) for effect in (None, EFFECT))
    forces = [np.hypot(*film.force(place, [0.0, 0.0], SPEED)) for film in (one, other)]
    powers = [film.losses(place, [0.0, 0.0], SPEED).power_loss for film in (one, other)]
    return 1.0 - forces[0] / forces[1], 1.0 - powers[0] / powers[1]


def draw(folder: Path) -> None:
    """Draw where laminar theory fails, and work against precision."""
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2))
    numbers, places = np.geomspace(300.0, 10000.0, 16), np.linspace(0.1, 0.9, 9)
    found = np.array([[laminar_error(number, place) for number in numbers] for place in places])
    for k, (style, name) in enumerate((("-", "force"), ("--", "power loss"))):
        lines = left.contour(
            numbers, places, 100.0 * found[..., k], [5, 20, 40, 60], colors=f"C{k}", linestyles=style
        )
        left.clabel(lines, fmt="%d %%", fontsize=8, manual=LABELS[k])
        left.plot([], [], f"C{k}{style}", label=name)
    left.legend(loc="lower left")
    left.axvline(onset(SIZE["radius"], SIZE["clearance"]), color="k", lw=0.8, ls=":")
    left.set(xscale="log", xlabel="Reynolds number speed R c/nu [1]", ylabel="eccentricity ratio [1]")
    left.set_title("Error of the laminar film (dotted: onset)", fontsize=10)
    rows = work_and_precision()
    styles = {"laminar": "C3s-", "one Reynolds number": "C1D", "Ng & Pan": "C0o-", "quadrature": "C2^-"}
    for name, style in styles.items():
        some = [(1e3 * seconds, error) for kind, seconds, error in rows if kind == name]
        right.loglog(*zip(*some, strict=True), style, label=name)
    right.set(xlabel="CPU time of an equilibrium [ms]", ylabel="error of the power loss [1]")
    right.set_title("Bearing of 500 mm, Reynolds number 2154, no band", fontsize=10)
    right.set_ylim(1e-5, 1.0)
    right.set_xticks([0.2, 0.5, 1, 2, 5, 10], [0.2, 0.5, 1, 2, 5, 10])
    right.minorticks_off()
    right.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(folder / "chart_turbulence.png", dpi=120)


def work_and_precision() -> list[tuple[str, float, float]]:
    """Return closure, time of an equilibrium [s] and error of the power, against the full stress."""
    rich = replace(bearing_at(2154.0, replace(EFFECT, band=False)), film=grid((192, 16)))
    known = reference(rich, (0.0, -3e5), SPEED)["power_loss"]
    found = []
    effects = {"laminar": None, "Ng & Pan": "ng_pan", "quadrature": "reichardt"}
    for name, closure in effects.items():
        effect = closure and Turbulence(closure=closure, band=False, density=DENSITY)
        for cells in ((32, 8), (48, 8), (96, 8), (192, 16)):
            found.append((name, *_work(replace(bearing_at(2154.0, effect), film=grid(cells)), known)))
    whole = Turbulence(closure="reichardt", band=False, density=DENSITY, local=False)
    scaled = replace(bearing_at(2154.0, whole), film=rf.MapFilm())
    return [*found, ("one Reynolds number", *_work(scaled, known))]


def _work(bearing: rf.JournalBearing, known: float) -> tuple[float, float]:
    """Return the CPU time of an equilibrium [s] and the error of its power, which is known [W]."""
    own = rf.equilibrium(bearing, [0.0, -3e5], SPEED).losses.power_loss
    begin = time.process_time()
    for _ in range(20):
        rf.equilibrium(bearing, [0.0, -3e5], SPEED)
    return (time.process_time() - begin) / 20, abs(own / known - 1.0)


def one_number(count: int) -> np.ndarray:
    """Return errors of force and power of one Reynolds number at random places, and its estimate, (3, n).

    The reference has the number of each place, on the same grid. The last row is the estimate of the
    eccentricity ratio in equilibrium over its error.
    """
    random, found = np.random.default_rng(7), []
    for _ in range(count):
        ratio, slenderness, Re = random.uniform((300.0, 0.3, 1.1), (1500.0, 1.2, 10.0))
        clearance, eps = 0.25 / ratio, random.uniform(0.1, 0.85)
        mu = DENSITY * SPEED * 0.25 * clearance / (Re * onset(0.25, clearance))
        size = {"radius": 0.25, "length": 0.5 * slenderness, "clearance": clearance, "viscosity": mu}
        local = rf.JournalBearing(**size, turbulence=EFFECT, film=grid((96, 8)))
        whole = replace(local, turbulence=replace(EFFECT, local=False), film=rf.MapFilm())
        place, still = eps * clearance * np.array([math.sin(0.9), -math.cos(0.9)]), np.zeros(2)
        force, own = (each.force(place, still, SPEED) for each in (local, whole))
        power, lost = (each.losses(place, still, SPEED).power_loss for each in (local, whole))
        cheap = rf.equilibrium(whole, -force, SPEED)
        step = np.linalg.solve(
            local.jacobian(cheap.position, still, SPEED)[:, :2],
            force - local.force(cheap.position, still, SPEED),
        )
        about = abs(float(np.hypot(*(cheap.position + step))) / clearance - cheap.eccentricity_ratio)
        away = np.hypot(*(own - force)) / np.hypot(*force), abs(lost / power - 1.0)
        found.append((*away, about / abs(cheap.eccentricity_ratio - eps)))
    return np.array(found).T


def grid(cells: tuple[int, int]) -> ExtrapolatedFilm:
    """Return a film extrapolated from two grids."""
    return ExtrapolatedFilm(film=ReynoldsFilm(cells=cells))


def reference(bearing: rf.JournalBearing, load: tuple[float, float], speed: float) -> dict[str, object]:
    """Return quantities of an equilibrium on the quadrature, moved as the full stress moves it."""
    at = rf.equilibrium(bearing, load, speed)
    linear, full = full_stress_forces(bearing, at.position, speed)
    at = rf.equilibrium(bearing, np.array(load) + full - linear, speed)
    film = rf.coefficients(bearing, at.position, speed)
    return {
        "eccentricity_ratio": at.eccentricity_ratio,
        "power_loss": at.losses.power_loss,
        "stiffness": film.stiffness,
        "damping": film.damping,
    }


def battery(count: int) -> tuple[int, int, int, int]:
    """Return claims met and made, and estimates within a factor of two (or below 0.3 %) and made."""
    random, claims, kept, close, made = np.random.default_rng(42), 0, 0, 0, 0
    for k in range(count):
        ratio, slenderness = random.uniform(300.0, 1500.0), random.uniform(0.3, 1.2)
        radius, Re = random.uniform(0.05, 0.4), random.uniform(1.1, 10.0)
        speed, eps = random.uniform(100.0, 1000.0), random.uniform(0.2, 0.85)
        closure, quantity = ("auto", "ng_pan", "none")[k % 3], QUANTITIES[k % 4]
        clearance = radius / ratio
        mu = DENSITY * speed * radius * clearance / (Re * onset(radius, clearance))
        length = 2.0 * radius * slenderness
        size = {"radius": radius, "length": length, "clearance": clearance, "viscosity": mu}
        rich = rf.JournalBearing(**size, turbulence=EFFECT, film=grid((192, 16)))
        place = eps * clearance * np.array([math.sin(0.9), -math.cos(0.9)])
        load = float(np.hypot(*rich.force(place, [0.0, 0.0], speed)))
        named = f'{{ closure = "{closure}", density = {DENSITY} }}' if closure == "ng_pan" else f'"{closure}"'
        lines = [f"{name} = {value!r}" for name, value in size.items()]
        tolerance = 10.0 ** random.uniform(-2.0, -0.7)
        text = [
            "schema = 1",
            "[journal]",
            *lines,
            f"turbulence = {named}",
            "[lubricant]",
            f"density = {DENSITY}",
        ]
        text += ["[operation]", f"speed = {speed}", f"load = {load}", "[question]"]
        text += [f'quantity = "{quantity}"', f"tolerance = {tolerance}"]
        answer = parse_scene("\n".join(text), "battery").ask()
        known = np.asarray(reference(rich, (0.0, -load), speed)[quantity])
        truth = float(np.abs(answer.value - known).max() / np.abs(known).max())
        claims, kept = claims + answer.met, kept + (answer.met and truth <= tolerance)
        off = answer.error_estimate / max(truth, 1e-12)
        good = 0.5 <= off <= 2.0 or max(truth, answer.error_estimate) < 3e-3
        made, close = made + 1, close + good
        print(
            f"{k:2d} {closure:7s} {quantity:18s} Re/onset {Re:4.1f} eps {eps:.2f} true {truth:.2e} "
            f"estimate {answer.error_estimate:.2e} tolerance {tolerance:.2e} {answer.met} {good}",
            flush=True,
        )
    return kept, claims, close, made


def main() -> None:
    """Draw the chart and run the battery."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path())
    parser.add_argument("--scenes", type=int, default=40)
    given = parser.parse_args()
    with warnings.catch_warnings(action="ignore"):
        draw(given.out)
        for row in work_and_precision():
            print("{} {:.4f} s, error {:.1e}".format(*row))
        if not given.scenes:
            return
        for name, row in zip(
            ("force", "power", "estimate over error"), one_number(given.scenes), strict=True
        ):
            print(f"one Reynolds number, {name}: {np.quantile(row, (0.05, 0.1, 0.5, 0.9, 0.95))}")
        kept, claims, close, made = battery(given.scenes)
    print(f"tolerances met where claimed: {kept} of {claims}")
    print(f"estimates within a factor of two: {close} of {made}")


if __name__ == "__main__":
    main()
