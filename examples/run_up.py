"""Run-up through a bistable range: the rotor falls to the small orbit later than it jumps back.

Steady orbits say where: the large orbit ends where the unbalance at its fold is that of the rotor, the small
one likewise. A porous damper has both, since its film is bounded; a run takes a little longer to leave.
"""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from rotorfilm import synchronous_orbits
from rotorfilm.bearings.damper.answer import couple_damper
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.scenes import Scene, run_damper

scene = Scene.load(Path(__file__).with_name("run_up.toml"))
models = damper_models(scene)
steady = replace(models.rotor, speed=350.0)


def excess(speed, number):
    """Return the unbalance at a fold of the steady response above that of the rotor [kg m]."""
    folds = synchronous_orbits(replace(steady, speed=speed), models.support).folds
    return folds[number].unbalance - steady.unbalance


# The jump up is at fold 0, in unbalance and over a falling speed; the fall at fold 1.
up, down = (brentq(excess, 290.0, 420.0, args=(number,), xtol=1e-3) for number in (0, 1))
print(f"steady orbits: jump up at {up:.1f} rad/s, fall at {down:.1f} rad/s")
between = synchronous_orbits(steady, models.support).at(steady.unbalance)[1].eccentricity_ratio


def jumps(run):
    """Return the speeds at which the orbit, averaged over 30 ms, falls and jumps up."""
    speed, count = run.trajectory["speed"], round(0.03 / np.mean(np.diff(run.trajectory.time)))
    radius = np.convolve(run.eccentricity_ratio, np.ones(count) / count, "same")
    top = int(np.argmax(speed))
    fall = np.nonzero(radius[count:top] > between)[0][-1] + count
    rise = np.nonzero(radius[top:-count] > between)[0][0] + top
    return speed[fall], speed[rise]


with tempfile.TemporaryDirectory() as folder:
    coupled = jumps(couple_damper(scene, Path(folder)))
print(f"run-up by two FMUs: falls at {coupled[0]:.1f} rad/s, jumps up at {coupled[1]:.1f} rad/s")
fall, rise = jumps(run_damper(scene))
print(f"run-up as one system: falls at {fall:.1f} rad/s, jumps up at {rise:.1f} rad/s")
print("width of the hysteresis, run / steady orbits:", (fall - rise) / (down - up))
