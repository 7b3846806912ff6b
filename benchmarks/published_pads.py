"""Bearings made of pads against printed figures: rows of docs/accuracy.md, computed.

    python benchmarks/published_pads.py

The figures are those of Lund & Thomsen (1978) and Nicholas, Barrett & Leader (1980) as quoted in the tests of
ROSS 3.1 (ross/tests/test_fluid_film_literature.py), and six bearings by another discretization: finite
volumes of 128 x 16 cells a pad, extrapolated, which share no code with these films.
"""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from rotorfilm import (
    Lobe,
    LobedBearing,
    PressureDamBearing,
    TiltingPadBearing,
    coefficients,
    critical_mass,
    equilibrium,
    lobe_set,
    pressure_dam_pads,
)
from rotorfilm.bearings import PadGridFilm

RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 300.0
FILM = PadGridFilm(cells=(192, 16))
INCH, MIL, LB = 0.0254, 25.4e-6, 4.4482216

ELLIPTICAL = (
    (0.5, 1.0, 0.211, 0.260, 87.79, (6.65, 4.36, -3.21, 0.86), (13.09, -2.23, 3.70)),
    (0.5, 1.0, 0.120, 0.350, 81.80, (4.99, 3.54, -1.52, 1.14), (9.04, -0.01, 2.49)),
)
GROOVES = (
    (0.0, 0.5, 0.917, 0.372, 57.45, (2.12, 4.01, -1.30, 1.85), (7.70, 2.06, 3.23)),
    (0.0, 0.5, 0.379, 0.570, 45.43, (3.33, 3.64, -0.43, 1.68), (6.76, 1.87, 1.89)),
    (0.0, 1.0, 0.635, 0.224, 63.54, (1.62, 5.33, -1.57, 1.56), (10.80, 1.70, 3.41)),
    (0.0, 1.0, 0.159, 0.559, 44.33, (2.73, 3.36, -0.48, 1.48), (6.94, 1.78, 1.74)),
)
"""Lund & Thomsen: preload, L/D, S, eps, phi [deg], Kxx Kxy Kyx Kyy, Bxx Bxy Byy; x is along the load."""

STEP_STIFFNESS, STEP_DAMPING = (6.82, 1.64, -24.3, 6.68), (125.0, -59.0, -59.0, 443.0)
"""Of the first of these [1e4 lb/in] and [lb s/in]."""

STEPS = ((2.2, 2.4, 145.0, 0.29, 7.5), (2.4, 5.5, 90.0, 0.22, 4.6), (1.8, 0.0, 145.0, 0.03, 2.1))
"""Nicholas et al.: clearance, depth [mil], end of the dam [deg], eps, threshold speed."""

FIXED = (
    (
        (90, 210, 330),
        100,
        1.0,
        0.5,
        2.0,
        (0.1715, -0.2228),
        (12.80, 2.81, -14.16, 9.13),
        (18.51, -7.13, 19.22),
    ),
    (
        (0, 90, 180, 270),
        75,
        1.0,
        0.5,
        1.5,
        (0.2066, -0.1410),
        (5.20, 4.46, -8.47, 7.75),
        (10.56, -3.10, 17.52),
    ),
    ((170, 350), 160, 1.0, 1.0, 2.0, (0.0045, -0.3121), (7.75, 0.00, -12.48, 9.10), (8.11, -8.22, 20.29)),
)
"""Angles of the least film, extent, L/D, offset, load, place, K, C; preload .5."""

TILTING = (
    ((45, 135, 225, 315), 75, 0.7, 0.5, 0.5, 1.0, -0.1219, (6.536, 6.536), (7.590, 7.590)),
    ((270, 342, 54, 126, 198), 60, 0.5, 0.3, 0.5, 0.6, -0.2623, (1.128, 2.573), (2.118, 3.182)),
    ((90, 162, 234, 306, 18), 60, 0.5, 0.0, 0.6, 0.6, -0.4637, (1.580, 2.251), (1.615, 2.200)),
)
"""Pivots, extent, L/D, preload, offset, load, y, Kxx Kyy, Cxx Cyy at the frequency of the shaft."""


class Gap(NamedTuple):
    """Largest distances of one kind of bearing from what is printed, and of how many figures."""

    bearing: str
    place: float
    angle: float
    stiffness: float
    damping: float


def lund_and_thomsen(name: str, rows: tuple[Any, ...]) -> Gap:
    """Return the distances: eps, phi [deg], K c_p/W and C c_p omega/W."""
    worst = []
    for preload, slenderness, S, eps, phi, K, B in rows:
        lobes = lobe_set("elliptical", preload=preload)
        bearing = LobedBearing(**dimensions(slenderness), lobes=lobes, film=FILM)
        at, stiffness, damping = rest(bearing, 1.0 / (math.pi * S))
        load = 1.0 / (math.pi * S)
        (a, b), (c, d) = stiffness / load
        (e, f), (_, h) = damping / load
        worst.append(
            (
                abs(at.eccentricity_ratio - eps),
                abs(math.degrees(at.attitude_angle) - phi),
                largest((d, -c, -b, a), K),
                largest((h, -f, e), B),
            )
        )
    return Gap(name, *np.max(worst, axis=0).tolist())


def prototype() -> Iterator[Gap]:
    """Yield the distances from another discretization: place / c_p, K and C over their largest entry."""
    fixed, tilting = [], []
    for angles, extent, slenderness, offset, load, place, K, C in FIXED:
        arc = math.radians(extent)
        lobes = [
            Lobe(start=math.radians(at) - offset * arc, extent=arc, preload=0.5, offset=offset)
            for at in angles
        ]
        bearing = LobedBearing(**dimensions(slenderness), lobes=tuple(lobes), film=FILM)
        at, stiffness, damping = rest(bearing, load)
        found = damping.ravel()[[0, 1, 3]]
        fixed.append(
            (
                largest(at.position / CLEARANCE, place),
                0.0,
                largest(stiffness.ravel(), K) / np.abs(K).max(),
                largest(found, C) / np.abs(C).max(),
            )
        )
    for angles, extent, slenderness, preload, offset, load, y, K, C in TILTING:
        bearing = TiltingPadBearing(
            **dimensions(slenderness),
            pivots=tuple(np.radians(angles).tolist()),
            extent=math.radians(extent),
            preload=preload,
            pivot_offset=offset,
            film=FILM,
        )
        at, stiffness, damping = rest(bearing, load)
        tilting.append(
            (
                largest(at.position / CLEARANCE, (0.0, y)),
                0.0,
                largest(np.diag(stiffness), K) / max(K),
                largest(np.diag(damping), C) / max(C),
            )
        )
    yield Gap("fixed", *np.max(fixed, axis=0).tolist())
    yield Gap("tilting", *np.max(tilting, axis=0).tolist())


def nicholas() -> Gap:
    """Return the distances: eps, relative threshold speed, K and C over their largest entry."""
    found = []
    for clearance, depth, end, eps, threshold in STEPS:
        bearing = PressureDamBearing(
            diameter=25.4e-3,
            length=25.4e-3,
            pad_clearance=clearance * MIL,
            viscosity=7.60e-6 * 6894.757,
            pads=pressure_dam_pads(depth=depth * MIL, end=math.radians(end), share=0.75),
        )
        speed, load = 8000.0 * math.pi / 30.0, 66.278
        at = equilibrium(bearing, (0.0, -load), speed)
        film = coefficients(bearing, at.position, speed)
        # Frozen coefficients: a rotor of the weight of the load whirls from where its mass is critical.
        onset = speed * math.sqrt(bearing.clearance * critical_mass(film).mass / load)
        K, C = film.stiffness.ravel() * INCH / (1e4 * LB), film.damping.ravel() * INCH / LB
        gaps = largest(K, STEP_STIFFNESS) / 24.3, largest(C, STEP_DAMPING) / 443.0
        known = gaps if not found else (0.0, 0.0)  # of the first only
        found.append((abs(at.eccentricity_ratio - eps), abs(onset / threshold - 1.0), *known))
    return Gap("steps", *np.max(found, axis=0).tolist())


def dimensions(slenderness: float) -> dict[str, float]:
    """Return journal, oil and clearance of a pad."""
    length = 2.0 * RADIUS * slenderness
    return {"radius": RADIUS, "length": length, "viscosity": VISCOSITY, "pad_clearance": CLEARANCE}


def rest(bearing: LobedBearing | TiltingPadBearing, load: float) -> tuple[Any, np.ndarray, np.ndarray]:
    """Return the equilibrium under a load along -y, K and C, in viscosity length radius^3 speed / c_p^2."""
    unit = bearing.force_scale * SPEED
    at = equilibrium(bearing, (0.0, -load * unit), SPEED)
    film = coefficients(bearing, at.position, SPEED)
    return at, film.stiffness * CLEARANCE / unit, film.damping * CLEARANCE * SPEED / unit


def largest(found: Any, printed: Any) -> float:
    """Return the largest distance of two rows of figures."""
    return float(np.abs(np.subtract(found, printed)).max())


def rows() -> list[str]:
    """Return the rows of docs/accuracy.md."""
    lines = []
    tables = ("elliptical, preload 0.5, L/D 1", ELLIPTICAL), ("two grooves, L/D 0.5 and 1", GROOVES)
    for name, table in tables:
        gap = lund_and_thomsen(name, table)
        load = "of the load per pad clearance"
        errors = (
            f"{gap.place:.3f}",
            f"{gap.angle:.2f} deg",
            f"{gap.stiffness:.2f} {load}",
            f"{gap.damping:.2f} {load}",
        )
        source = "Lund & Thomsen (1978), 2 to 3 digits"
        for quantity, error in zip(("eccentricity ratio", "attitude angle", "K", "C"), errors, strict=True):
            lines.append(f"| `LobedBearing` | {quantity} | {name} | {source} | {error} |")
    gap = nicholas()
    errors = f"{gap.place:.2f}", *(f"{100.0 * e:.1f} %" for e in (gap.angle, gap.stiffness, gap.damping))
    source = "Nicholas, Barrett & Leader (1980), 1 to 3 digits"
    for quantity, error in zip(("eccentricity ratio", "threshold", "K", "C"), errors, strict=True):
        lines.append(f"| `PressureDamBearing` | {quantity} | L/D 1 | {source} | {error} |")
    kinds = (
        ("`LobedBearing`", "three and four lobes, offset halves"),
        ("`TiltingPadBearing`", "three bearings"),
    )
    for (bearing, kind), gap in zip(kinds, prototype(), strict=True):
        errors = f"{gap.place:.1e}", f"{100.0 * gap.stiffness:.2f} %", f"{100.0 * gap.damping:.2f} %"
        for quantity, error in zip(("place", "K", "C"), errors, strict=True):
            lines.append(f"| {bearing} | {quantity} | {kind} | another discretization | {error} |")
    return lines


if __name__ == "__main__":
    warnings.simplefilter("ignore")  # of unloaded pads
    sys.stdout.write("\n".join(rows()) + "\n")
