"""Draw the pictures that native/kernels/kernel_list.h names, into rotorfilm/fmu/native/data/.

    python tools/draw_icons.py

They are 96 pixels wide, on no background.
"""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrow, Rectangle

from rotorfilm.native.resource import kernel_table

OUT = Path(__file__).parents[1] / "rotorfilm" / "fmu" / "native" / "data"
STEEL, OIL, INK = "#7a8794", "#f2b233", "#1d2b36"


def draw_journal(axes: Axes) -> None:
    """Draw a journal, out of center in its film, and its sense of rotation."""
    axes.add_patch(Circle((0, 0), 0.95, color=STEEL))
    axes.add_patch(Circle((0, 0), 0.72, color=OIL))
    axes.add_patch(Circle((0.09, -0.09), 0.56, facecolor="white", edgecolor=INK, lw=2))
    angle = np.linspace(0.6, 2.6, 40)
    axes.plot(0.09 + 0.33 * np.cos(angle), -0.09 + 0.33 * np.sin(angle), color=INK, lw=2)
    axes.add_patch(FancyArrow(-0.18, 0.09, -0.03, -0.06, head_width=0.16, head_length=0.14, color=INK, lw=0))


def draw_grooved_journal(axes: Axes) -> None:
    """Draw the same with two axial grooves."""
    for x in (-0.86, 0.6):
        axes.add_patch(Rectangle((x, -0.13), 0.26, 0.26, color=OIL, zorder=1))
    draw_journal(axes)
    axes.patches[2].set_zorder(0.5)


def draw_lobed_journal(axes: Axes) -> None:
    """Draw a journal between two pads, each an arc about a center of its own."""
    axes.add_patch(Circle((0, 0), 0.95, color=STEEL))
    axes.add_patch(Circle((0, 0), 0.78, color=OIL))
    for side in (-1.0, 1.0):
        angle = side * np.linspace(0.18, np.pi - 0.18, 60)
        x, y = 0.82 * np.cos(angle), 0.82 * np.sin(angle) - 0.2 * side
        axes.fill(np.append(x, 0.95 * np.cos(angle[::-1])), np.append(y, 0.95 * np.sin(angle[::-1])), STEEL)
    axes.add_patch(Circle((0, 0), 0.56, facecolor="white", edgecolor=INK, lw=2))
    angle = np.linspace(0.6, 2.6, 40)
    axes.plot(0.33 * np.cos(angle), 0.33 * np.sin(angle), color=INK, lw=2)
    axes.add_patch(FancyArrow(-0.27, 0.18, -0.03, -0.06, head_width=0.16, head_length=0.14, color=INK, lw=0))


def draw_tilting_journal(axes: Axes) -> None:
    """Draw a journal on five pads, each on a pivot."""
    axes.add_patch(Circle((0, 0), 0.95, color=STEEL))
    axes.add_patch(Circle((0, 0), 0.82, color="white"))
    axes.add_patch(Circle((0, 0), 0.62, color=OIL))
    for middle in -0.5 * np.pi + 0.4 * np.pi * np.arange(5):
        angle = middle + np.linspace(-0.48, 0.48, 20)
        x = np.append(0.62 * np.cos(angle), 0.76 * np.cos(angle[::-1]))
        y = np.append(0.62 * np.sin(angle), 0.76 * np.sin(angle[::-1]))
        axes.fill(x, y, INK)
        axes.add_patch(Circle((0.8 * np.cos(middle), 0.8 * np.sin(middle)), 0.07, color=STEEL))
    axes.add_patch(Circle((0, 0), 0.54, facecolor="white", edgecolor=INK, lw=2))


def draw_short_journal(axes: Axes) -> None:
    """Draw a shaft in a short bearing, from the side."""
    for y in (-0.85, 0.45):
        axes.add_patch(Rectangle((-0.25, y), 0.5, 0.4, color=STEEL))
    axes.add_patch(Rectangle((-0.25, -0.45), 0.5, 0.9, color=OIL))
    axes.add_patch(Rectangle((-0.95, -0.4), 1.9, 0.75, facecolor="white", edgecolor=INK, lw=2))


def draw_contact(axes: Axes) -> None:
    """Draw a ball on a plane with the film between them."""
    axes.add_patch(Rectangle((-0.95, -0.85), 1.9, 0.3, color=STEEL))
    axes.add_patch(Rectangle((-0.95, -0.55), 1.9, 0.16, color=OIL))
    axes.add_patch(Circle((0, 0.2), 0.66, facecolor="white", edgecolor=INK, lw=2))
    axes.add_patch(FancyArrow(-0.35, 0.2, 0.5, 0.0, head_width=0.2, head_length=0.2, color=INK, lw=0))


def draw_bush(axes: Axes) -> None:
    """Draw a shaft that has sunk into the liner of its bush."""
    axes.add_patch(Circle((0, 0), 0.95, color=STEEL))
    axes.add_patch(Circle((0, 0), 0.8, color=OIL))
    axes.add_patch(Circle((0, 0), 0.6, color="white"))
    axes.add_patch(Circle((0, -0.18), 0.52, facecolor="white", edgecolor=INK, lw=2))


def draw_worn_bush(axes: Axes) -> None:
    """Draw the same with the nodes of its worn profile."""
    draw_bush(axes)
    for angle in np.linspace(-2.3, -0.84, 6):
        axes.add_patch(Circle((0.52 * np.cos(angle), -0.18 + 0.52 * np.sin(angle)), 0.07, color=INK))


def draw_damper(axes: Axes) -> None:
    """Draw a ring of film in a porous cage, a race that does not turn, and springs."""
    axes.add_patch(Circle((0, 0), 0.95, color=STEEL))
    for angle in np.linspace(0, 2 * np.pi, 20, endpoint=False):
        axes.add_patch(Circle((0.83 * np.cos(angle), 0.83 * np.sin(angle)), 0.05, color="white"))
    axes.add_patch(Circle((0, 0), 0.72, color=OIL))
    axes.add_patch(Circle((0.05, -0.07), 0.6, facecolor="white", edgecolor=INK, lw=2))
    x = np.linspace(-0.42, 0.52, 9)
    axes.plot(x, -0.07 + 0.16 * np.array([0, 0, 1, -1, 1, -1, 1, 0, 0]), color=INK, lw=2)


def draw_thrust(axes: Axes) -> None:
    """Draw six sector pads around a shaft."""
    for first in np.arange(6) * np.pi / 3.0:
        angle = first + np.linspace(0.0, 0.8, 20)
        x = np.append(0.93 * np.cos(angle), 0.42 * np.cos(angle[::-1]))
        y = np.append(0.93 * np.sin(angle), 0.42 * np.sin(angle[::-1]))
        axes.fill(x, y, facecolor=OIL, edgecolor=INK, lw=1.5)
    axes.add_patch(Circle((0, 0), 0.3, facecolor="white", edgecolor=INK, lw=2))


def draw_rotor(axes: Axes) -> None:
    """Draw a shaft with a disk and its unbalance."""
    axes.add_patch(Rectangle((-0.95, -0.1), 1.9, 0.2, color=STEEL))
    axes.add_patch(Rectangle((-0.18, -0.75), 0.36, 1.5, facecolor="white", edgecolor=INK, lw=2))
    axes.add_patch(Circle((0, 0.52), 0.12, color=OIL))


def draw_rotor_system(axes: Axes) -> None:
    """Draw the same in two films."""
    for x in (-0.8, 0.52):
        axes.add_patch(Rectangle((x, -0.42), 0.28, 0.84, color=INK))
        axes.add_patch(Rectangle((x, -0.22), 0.28, 0.44, color=OIL))
    draw_rotor(axes)


def draw_linear(axes: Axes) -> None:
    """Draw a block with a step response."""
    axes.add_patch(Rectangle((-0.9, -0.75), 1.8, 1.5, facecolor="white", edgecolor=INK, lw=2))
    t = np.linspace(0, 1, 100)
    response = 1 - np.exp(-3.5 * t) * np.cos(14 * t)
    axes.plot(-0.75 + 1.5 * t, -0.55 + 0.65 * response, color=OIL, lw=2.5)


def main() -> None:
    """Draw all of them, 96 pixels wide, each by the function of its name."""
    OUT.mkdir(exist_ok=True)
    mpl.rcParams["savefig.transparent"] = True
    for name in sorted({picture for _, picture in kernel_table().values()}):
        figure = Figure(figsize=(1, 1), dpi=96)
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set(xlim=(-1, 1), ylim=(-1, 1), aspect="equal")
        axes.axis("off")
        globals()[f"draw_{name}"](axes)
        figure.savefig(OUT / f"{name}.png", metadata={"Software": None})
        print(OUT / f"{name}.png")


if __name__ == "__main__":
    main()
