"""A shaft sags: what its bearings feel, and the errors of cheaper models of a tilted journal.

The rotor of Friswell et al. (2010) of flexible_rotor.toml, whose sag tilts both journals. The chart has the
errors of the levels against the film over the whole length, with those of slices that each have the aligned
force; and beside it the errors over the cost of a force.
"""

from dataclasses import replace
from pathlib import Path
from time import process_time

import matplotlib.pyplot as plt
import numpy as np

import rotorfilm as rf
from rotorfilm.bearings import ExtrapolatedFilm, MomentCarryingJournal, TiltLevel
from rotorfilm.bearings.journal.tilt_map import TiltMap

scene = rf.Scene.load(Path(__file__).with_name("flexible_rotor.toml"))
aligned, speeds = scene.shaft.build_bearings(), [200.0, 245.0]
shaft = scene.shaft.build()
feeling = replace(shaft, stations=tuple(replace(one, feels_tilt=True) for one in shaft.stations))
grid = replace(aligned["left"], film=ExtrapolatedFilm(film=rf.ReynoldsFilm(cells=(64, 8))))
full = MomentCarryingJournal(bearing=grid)
held = dict.fromkeys(aligned, full)
rest = rf.rotor_equilibrium(feeling, held, 220.0)
told = full.estimate(rest.coefficients["left"].position, 220.0)
print(f"an end lies {told.end_shift:.2f} clearances beside the middle, {told.share:.0%} of the aligned film")
thresholds = [rf.rotor_threshold(*pair, speeds).speed for pair in ((shaft, aligned), (feeling, held))]
print(f"threshold of stability: aligned {thresholds[0]:.1f} rad/s, with tilt {thresholds[1]:.1f} rad/s")

plain = replace(grid, film=rf.MapFilm())
table = TiltMap(plain.slenderness, (64, 8)).built()
second = MomentCarryingJournal(bearing=plain, level=TiltLevel.SECOND_ORDER, tilt_map=table)
closed = MomentCarryingJournal(bearing=plain, level=TiltLevel.CLOSED_FORM)
arm, c, still = 0.5 * plain.length, plain.clearance, np.zeros(4)


def slices(place):
    """Return force and moment of seven slices, each with the aligned force of a seventh of the length."""
    z = arm * (np.arange(7) - 3.0) / 3.5
    own = place[:2, None] + np.stack([place[3] * z, -place[2] * z])
    f = plain.force(own, np.zeros((2, 7)), np.full(7, 220.0)) / 7.0
    return np.array([*f.sum(axis=1), -(z * f[1]).sum(), (z * f[0]).sum()])


def cost(reaction, count):
    """Return the CPU time of a force over that of the aligned map [1], on average of so many."""
    times = []
    for one, size, many in ((reaction, len(reaction.inputs) // 2, count), (plain, 2, 20000)):
        state = np.repeat(np.array([0.0, -0.6 * c, 0.1 * c / arm, 0.2 * c / arm])[:size, None], many, axis=1)
        begin = process_time()
        one.prepared_force(state, np.zeros((size, many)), np.full(many, 220.0))
        times.append((process_time() - begin) / many)
    return times[0] / times[1]


shares, errors = np.linspace(0.05, 0.59, 8), {}
for share in shares:
    place = np.array([0.0, -0.6 * c, 0.0, 0.4 * c * share / arm])
    exact = full.force(place, still, 220.0)
    levels = {"closed form": closed, "second order": second}
    found = {name: level.force(place, still, 220.0) for name, level in levels.items()}
    for name, force in {**found, "seven slices: wrong": slices(place)}.items():
        error = np.hypot(*(force - exact)[2:]) / np.hypot(*exact[2:])
        errors.setdefault(name, []).append(100.0 * error)
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained", sharey=True)
for (name, error), style in zip(errors.items(), ("-", "--", ":"), strict=True):
    left.semilogy(shares, error, style, label=name)
left.set(xlabel="share of the film that a tilt takes [1]", ylabel="error of the moment [%]")
left.legend()
levels, errors["64 x 8 cells"] = {**levels, "64 x 8 cells": full}, 8 * [0.1]  # of its grid
for (name, level), mark in zip(levels.items(), ("o", "s", "D"), strict=True):
    right.loglog(cost(level, 3 if level is full else 20000), errors[name][4], mark, label=name)
right.set(xlabel="CPU time of a force over the aligned map's [1]", title="at a share of 0.36", xlim=(1, 1e5))
right.legend()
figure.savefig("sagging_shaft.png")
print("threshold with tilt / aligned:", thresholds[1] / thresholds[0])
