"""Where the published scheme of a rolling ball fails: load steps it cannot take, decay it makes up itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...bearings.contact import (
    ContactState,
    FixedSteps,
    PointContact,
    SmallMotion,
    StaggeredScheme,
    StepLoad,
)
from ...errors import ConvergenceError
from ...model import Array
from ...progress import Report, part_of, silent
from .contact_cases import PUBLISHED_CELLS, as_published, published_contact

STEPS = (0.05, 0.1, 0.2, 0.5, 1.0)
AMPLITUDES = (0.7, 1.5, 3.0, 5.0, 8.0)
INERTIAS = (0.1, 0.3, 0.5, 1.0, 3.0)
SPAN = 4.0
"""Time after a load step within which a run has to hold."""

STIFFNESS = 1.57
"""Static stiffness of the contact, from which the search for its natural motion starts."""


class ContactLimits(NamedTuple):
    """Where implicit Euler with fixed steps on the published grid ends, and what it does to the decay.

    Attributes
    ----------
    steps, load_steps, inertias : tuple of float
        Lengths of the steps; load steps at W = 1; inertias W.
    reached : ndarray, shape (steps, load_steps)
        Time after the load step at which the run failed, infinite if it did not.
    physical : ndarray, shape (inertias,)
        Decay time of small oscillations by the linearized equations.
    shown : ndarray, shape (steps, inertias)
        Decay time that the scheme shows.
    """

    steps: tuple[float, ...]
    load_steps: tuple[float, ...]
    inertias: tuple[float, ...]
    reached: np.ndarray
    physical: np.ndarray
    shown: np.ndarray

    def columns(self) -> dict[str, list[object]]:
        """Return both maps as one table; no time of failure where a run holds, dt = 0 for the equations."""
        rows = [
            ("load step", step, a, float(self.reached[i, j]) if np.isfinite(self.reached[i, j]) else None)
            for i, step in enumerate(self.steps)
            for j, a in enumerate(self.load_steps)
        ]
        rows += [
            ("decay time", step, W, float(self.shown[i, j]))
            for i, step in enumerate(self.steps)
            for j, W in enumerate(self.inertias)
        ]
        rows += [
            ("decay time", 0.0, W, float(time)) for W, time in zip(self.inertias, self.physical, strict=True)
        ]
        headings = ("map", "dt", "amplitude or W", "time of failure or decay time")
        return dict(zip(headings, map(list, zip(*rows, strict=True)), strict=True))


def contact_limits(
    cells: int = PUBLISHED_CELLS,
    steps: Sequence[float] = STEPS,
    amplitudes: Sequence[float] = AMPLITUDES,
    inertias: Sequence[float] = INERTIAS,
    report: Report = silent,
) -> ContactLimits:
    """Return the limits of the published scheme on its grid, or one of `cells` x `cells`; a minute."""
    contact = published_contact(cells, StaggeredScheme())
    with as_published():
        rest = contact.stationary()
    s = natural_motions(contact, rest, inertias, part_of(report, 0.0, 0.3))
    reached = np.full((len(steps), len(amplitudes)), np.inf)
    for i, step in enumerate(steps):
        for j, amplitude in enumerate(amplitudes):
            report(0.3 + 0.7 * (i + j / len(amplitudes)) / len(steps), f"dt = {step:g}, A = {amplitude:g}")
            reached[i, j] = _reached(contact, rest, step, amplitude)
    shown = np.array([step / np.log(np.abs(1.0 - step * s)) for step in steps])
    return ContactLimits(tuple(steps), tuple(amplitudes), tuple(inertias), reached, -1.0 / s.real, shown)


def natural_motions(
    contact: PointContact, rest: ContactState, inertias: Sequence[float], report: Report = silent
) -> Array:
    """Return s of the natural motions exp(s t) about rest with some inertias, by the linearized equations."""
    small = SmallMotion(contact.equations, rest.levels[0].pressure, rest.delta)
    found = []
    for number, W in enumerate(inertias):
        report(number / len(inertias), f"natural motion, W = {W:g}")
        found.append(small.natural_motion(W, 1j * np.sqrt(STIFFNESS / W)))
    return np.array(found)


def _reached(contact: PointContact, rest: ContactState, step: float, amplitude: float) -> float:
    load, control = StepLoad(amplitude=amplitude, start=step), FixedSteps(step=step, order=1)
    try:
        with as_published():
            contact.simulate(rest, duration=step + SPAN, W=1.0, load=load, control=control)
    except ConvergenceError as error:
        return float(error.partial.time[-1] - step)
    return np.inf
