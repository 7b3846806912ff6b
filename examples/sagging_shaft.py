"""A shaft sags: what its bearings feel, and the errors of cheaper models of a tilted journal.

The rotor of Friswell et al. (2010) of flexible_rotor.toml, whose sag tilts both journals. The chart has the
errors of the levels against the film over the whole length, with those of slices that each have the aligned
force.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.bearings import ExtrapolatedFilm, MomentCarryingJournal, TiltLevel
from rotorfilm.bearings.journal.tilt_map import TiltMap
from rotorfilm.charts import new_axes

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


shares, errors = np.linspace(0.05, 0.59, 8), {}
for share in shares:
    place = np.array([0.0, -0.6 * c, 0.0, 0.4 * c * share / arm])
    exact = full.force(place, still, 220.0)
    levels = {"closed form": closed, "second order": second}
    found = {name: level.force(place, still, 220.0) for name, level in levels.items()}
    for name, force in {**found, "seven slices: wrong": slices(place)}.items():
        error = np.hypot(*(force - exact)[2:]) / np.hypot(*exact[2:])
        errors.setdefault(name, []).append(100.0 * error)
axes = new_axes("Error of the moment [%] over the share of the film that a tilt takes [1]")
for (name, error), style in zip(errors.items(), ("-", "--", ":"), strict=True):
    axes.semilogy(shares, error, style, label=name)
axes.legend()
axes.figure.savefig("sagging_shaft.png")
print("threshold with tilt / aligned:", thresholds[1] / thresholds[0])
