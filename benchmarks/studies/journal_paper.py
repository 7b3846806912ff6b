"""Journal bearing by splitting: figures 2 to 5 of Sussi & Fridman (1978), with their misprints corrected.

Load coefficient, locus of the journal, stiffness and damping over the eccentricity ratio, in the first and
the second approximation as they have them, beside Reynolds rupture (journal_paper.png). They do not give the
length; here length/diameter is 0.5. Their film covers half of the circumference.
"""

import numpy as np
from matplotlib.figure import Figure

import rotorfilm as rf

RADIUS, LENGTH, CLEARANCE, VISCOSITY, SPEED = 0.05, 0.05, 1e-4, 0.02, 314.0
SIZE = {"radius": RADIUS, "length": LENGTH, "clearance": CLEARANCE, "viscosity": VISCOSITY}
CHI = np.linspace(0.05, 0.9, 35)
FILMS = {
    "first approximation": (rf.SplittingFilm(order=(1, 1)), "--"),
    "second approximation": (rf.SplittingFilm(order=(2, 1)), "-"),
    "Reynolds rupture": (rf.MapFilm(), ":"),
}
PSI = CLEARANCE / RADIUS
UNIT = VISCOSITY * LENGTH / PSI**3
COLORS = {"xx": "C0", "xy": "C1", "yx": "C2", "yy": "C3"}


def at_rest(bearing, chi):
    """Return the position of the journal under a load along -y, the load coefficient, K and C."""
    force = bearing.force([chi * CLEARANCE, 0.0], [0.0, 0.0], SPEED)
    turn = 0.5 * np.pi - np.arctan2(force[1], force[0])  # the film carries along +y
    position = chi * CLEARANCE * np.array([np.cos(turn), np.sin(turn)])
    found = rf.coefficients(bearing, position, SPEED)
    mean_pressure = np.hypot(*force) / (2.0 * RADIUS * LENGTH)
    return (
        position / CLEARANCE,
        mean_pressure * PSI**2 / (VISCOSITY * SPEED),
        found.stiffness / (UNIT * SPEED),
        found.damping / UNIT,
    )


figure = Figure(figsize=(11.0, 8.5), layout="constrained")
(load, path), (stiffness, damping) = figure.subplots(2, 2)
damped = {}
for label, (film, style) in FILMS.items():
    bearing = rf.JournalBearing(**SIZE, film=film)
    place, carried, K, C = (np.array(part) for part in zip(*(at_rest(bearing, x) for x in CHI), strict=True))
    load.semilogy(CHI, carried, style, color="C0", label=label)
    path.plot(*place.T, style, color="C0", label=label)
    for axes, matrix, name in ((stiffness, K, "K"), (damping, C, "C")):
        for (i, j), color in zip(np.ndindex(2, 2), COLORS.values(), strict=True):
            solid = f"{name}{'xy'[i]}{'xy'[j]}" if style == "-" else None
            axes.plot(CHI, matrix[:, i, j], style, color=color, label=solid)
    damped[label] = C
load.set(title="Figure 2", ylabel="load coefficient q psi$^2$/(mu omega) [1]")
path.set(title="Figure 3: journal, load along -y", xlabel="x / clearance [1]", ylabel="y / clearance [1]")
path.set_aspect("equal")
wall = np.linspace(-np.pi, 0.0, 91)
path.plot(np.cos(wall), np.sin(wall), color="0.7", linewidth=0.8)
stiffness.set(title="Figure 4", ylabel="stiffness / (mu omega b psi$^{-3}$) [1]")
damping.set(title="Figure 5", ylabel="damping / (mu b psi$^{-3}$) [1]")
for axes in (load, stiffness, damping):
    axes.set_xlabel("eccentricity ratio [1]")
for axes in (stiffness, damping):
    axes.set_yscale("symlog", linthresh=1.0)
for axes in (load, path, stiffness, damping):
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8)
figure.suptitle("Length/diameter 0.5. Dashed: first, solid: second approximation, dotted: Reynolds rupture")
figure.savefig("journal_paper.png", dpi=110)

k = int(np.argmin(np.abs(CHI - 0.5)))
for label, C in damped.items():
    print(f"{label}: damping xy {C[k, 0, 1]:.4f}, yx {C[k, 1, 0]:.4f}, determinant {np.linalg.det(C[k]):.3g}")
second = damped["second approximation"][k]
print("damping xy / yx in the second approximation:", second[0, 1] / second[1, 0])
