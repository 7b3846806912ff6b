"""Plates whose cavity shuts: the load in steps of second order, halved there, and of first order there.

    python benchmarks/conserved_shutting.py

Gap .375 + .125 cos 4 pi t over |x| < .5, pressure .025 at the ends; the cavity shuts at t = .73239, where the
load jumps to that of the full film. Of some steps a period of the gap: the largest load after that over the
load of the full film at its time, and by how much the sum of load times step is off, over the jump times the
step.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotorfilm.bearings.films.mass_conserving import (
    ConservedCells,
    ConservedFilm,
    ConservedState,
    Gap,
    Supply,
    step_storage,
)

BEGIN, SHUT, END = 0.25, 0.73239, 0.748
FINE = 25600


class OilHistory(NamedTuple):
    """theta H now and one step ago, the length of that step, and the cells that are full."""

    content: np.ndarray
    before: np.ndarray
    length: float
    full: np.ndarray


def gap(t: float) -> float:
    """Return the gap."""
    return 0.375 + 0.125 * float(np.cos(4.0 * np.pi * t))


def full_load(t: np.ndarray) -> np.ndarray:
    """Return the load of the full film on half the plate."""
    rate = -0.5 * np.pi * np.sin(4.0 * np.pi * t)
    return 0.0125 - rate / (12.0 * (0.375 + 0.125 * np.cos(4.0 * np.pi * t)) ** 3)


def plates(cells: int) -> tuple[ConservedFilm, OilHistory]:
    """Return the film, and its memory where the plates are closest."""
    x = np.linspace(-0.5, 0.5, cells + 1)
    opening = np.full((x.size, 1), -1, dtype=np.int32)
    opening[0], opening[-1] = 0, 1
    grid = ConservedCells(x, np.full(x.size, 1.0 / cells), np.ones(1), opening)
    supply = Supply(np.full(2, 0.0125), np.zeros(2, dtype=bool), np.zeros(2), 0.0, 0.0)
    full, one = np.full((x.size, 1), gap(BEGIN)), np.ones((x.size, 1))
    return ConservedFilm(grid, np.inf, supply), OilHistory(full, full, 0.0, one)


def stepped(film: ConservedFilm, memory: OilHistory, at: Gap, dt: float) -> ConservedState:
    """Return the film after a step, of first order where the memory has no length."""
    ratio = dt / memory.length if memory.length else 1.0
    before = memory.before if memory.length else None
    return film.solve(at, 0.0, storage=step_storage(dt, memory.content, before, ratio), guess=memory.full)


def run(cells: int, steps: int, halvings: int | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, lengths and loads; steps halved at the jump, None for two of first order there."""
    film, memory = plates(cells)
    t, level, rows = BEGIN, 0, []
    while t < END - 1e-12:
        dt = 0.5 / steps / 2**level
        h = np.full((cells + 1, 1), gap(t + dt))
        at = Gap(h, h, np.hstack([h, h]))
        state = stepped(film, memory, at, dt)
        shuts = memory.full.min() == 0 and state.solution.full.min() == 1
        if halvings is not None and shuts and level < halvings:
            level += 1
            continue
        first_order = shuts and halvings is None
        if first_order:
            state = stepped(film, memory._replace(length=0.0), at, dt)
        length = 0.0 if first_order else dt
        memory = OilHistory(state.content, memory.content, length, state.solution.full)
        t += dt
        rows.append([t, dt, np.sum(state.solution.pressure[1:-1]) / cells + 0.0125 / cells])
        place = (t - BEGIN) / (2.0 * dt)
        level -= level > 0 and state.solution.full.min() == 1 and abs(place - round(place)) < 1e-9
    times, lengths, loads = np.array(rows).T
    return times, lengths, loads


def impulse(t: np.ndarray, dt: np.ndarray, load: np.ndarray, begin: float, end: float, jump: float) -> float:
    """Return the sum of load times step from `begin` to `end`, less what rectangles make of smooth parts."""
    inside = (t > begin + 1e-12) & (t < end + 1e-12)
    ends = np.interp(end, t, load) - np.interp(begin, t, load) - jump
    return float(np.sum((load * dt)[inside]) - 0.5 * dt.max() * ends)


if __name__ == "__main__":
    jump = float(full_load(np.array([SHUT]))[0])
    for cells in (64, 256):
        fine = run(cells, FINE, None)
        base = np.interp(SHUT - 1e-4, fine[0], fine[2])
        print(f"{cells} cells: steps, [halvings: largest load, error of the impulse]")
        for steps in (200, 400, 800):
            first = np.floor((SHUT - BEGIN) * 2.0 * steps)
            window = BEGIN + 0.5 / steps * (first - 2.0), BEGIN + 0.5 / steps * (first + 3.0)
            exact, found = impulse(*fine, *window, jump - base), []
            for halvings in (0, 1, 2, 4, None):
                t, dt, load = run(cells, steps, halvings)
                over = np.max((load / full_load(t))[t > SHUT])
                off = (impulse(t, dt, load, *window, jump - base) - exact) / (jump - base) * 2.0 * steps
                found.append(f"{'first order' if halvings is None else halvings}: {over:.3f}, {off:+.3f}")
            print(f"{steps}  " + "   ".join(found))
