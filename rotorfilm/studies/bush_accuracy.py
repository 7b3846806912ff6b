"""The tiers of the melting bush under a growing load: error of the contact angle beside the cost of the run.

The reference is an exact reduction. While the contact grows its edge is unworn, so that the integrals of the
contact condition against cos(phi) and 1 close, whatever the shape of the pressure:

    c F(alpha) = a_1 N + W,   2 c (tan(alpha) - alpha) = a_1 Q + V,   W' = g N,   V' = g Q

with W, V the integrals of the wear against cos(phi) and 1, N and Q those of the pressure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp

from ..bearings import bush as bushes
from ..core.model import Array, Dynamic
from ..core.progress import Report, silent
from .study import Study, StudyCase, StudyModel, StudyResult, run_study, timed

HEAT = 1e8
"""Melting heat [J/m3]; it scales the time and nothing else."""

LOADS = (3000.0, 4500.0)
"""Load at the beginning and at the end [N]."""

SPEED, DURATION = 12.0, 1.0
SAMPLES = 41
TIGHT = {"rtol": 1e-10, "atol": 1e-15}
USUAL = {"rtol": 1e-6, "atol": 1e-12}

COOLINGS = tuple(np.linspace(0.02, 0.3, 15).tolist())
"""Biot numbers kappa_1 R_1/lambda_1 of the shaft."""

STUBBINESSES = (0.1, 0.25, 0.5, 1.0)
"""Shaft radius / half length of the bush."""


BUSH = Study(
    name="bush",
    solve=lambda model, case: model.law(),
    quantities=lambda model, case, angle: {
        "tier": model.name,
        "family": model.family,
        "angle error [1]": float(np.abs(angle / case.reference - 1.0).max()),
    },
    costs=timed("time of the run [s]", perf_counter),
    keeps_answers=True,
)


def bush_tiers(
    nodes: Sequence[int] = (17, 33, 65, 129),
    steps: Sequence[int] = (20, 200, 2000),
    *,
    report: Report = silent,
) -> StudyResult:
    """Return error and cost of every tier, one run each, and the error of the closed form of the shaft.

    Parameters
    ----------
    nodes : sequence of int
        Nodes of the worn profiles, on 1.5 rad.
    steps : sequence of int
        Steps of the published stage.
    report : Report
    """
    bush, times = bushes.f4k20_bush(), np.linspace(0.0, DURATION, SAMPLES)
    exact = two_moments(bush, times, **TIGHT)
    worn = bushes.BushReaction(bush=bush, melting_heat=HEAT, extent=1.5)
    local = replace(worn, nodes=max(nodes), melting=bushes.LocalMelting())
    runs: dict[str, dict[str, Callable[[], Array]]] = {
        "two moments": {"two moments": lambda: two_moments(bush, times, **USUAL)},
        "BushWear": {"BushWear": lambda: _one_state(bush, times)},
        "BushReaction": {
            f"BushReaction, {n} nodes": partial(worn_run, times, replace(worn, nodes=n)) for n in nodes
        },
        "LocalMelting: another law": {f"LocalMelting, {local.nodes} nodes": lambda: worn_run(times, local)},
        "as published": {f"as published, {n} steps": partial(published_run, bush, times, n) for n in steps},
    }
    models = [
        StudyModel(name=name, family=family, law=run)
        for family, tiers in runs.items()
        for name, run in tiers.items()
    ]
    return run_study(
        BUSH,
        [StudyCase(models=models, reference=exact)],
        reference="two moments of the wear, integrated at 1e-10",
        notes={"times": times, "exact": exact, "shaft": shaft_flux_errors()},
        report=report,
    )


def shaft_flux_errors(
    coolings: Sequence[float] = COOLINGS, stubbinesses: Sequence[float] = STUBBINESSES
) -> dict[str, list[float]]:
    """Return the error of the closed form (2.13) of the heat into the shaft, for all pairs of its numbers.

    Parameters
    ----------
    coolings : sequence of float [1]
        Biot numbers of the shaft, air_transfer radius / conductivity.
    stubbinesses : sequence of float [1]
        Radius of the shaft / half length of the bush.

    Returns
    -------
    dict of str to list of float
        Columns of a table; the error is relative to the mixed problem.
    """
    pairs = [(cooling, stubbiness) for stubbiness in stubbinesses for cooling in coolings]
    return {
        "cooling [1]": [cooling for cooling, _ in pairs],
        "stubbiness [1]": [stubbiness for _, stubbiness in pairs],
        "error of the closed form [1]": [
            bushes.approximate_flux(*pair) / bushes.exact_flux(*pair) - 1.0 for pair in pairs
        ],
    }


def two_moments(bush: bushes.MeltingBush, times: Array, *, rtol: float, atol: float) -> Array:
    """Return half the contact angle [rad] at the times [s], by the two moments of the wear."""
    law = bush.law
    gap = law.gap(law.melting)
    work = law.pressure_work * SPEED * law.coefficient(law.melting)

    def angle(t: float, moment: float) -> float:
        return float(bushes.arc_angle((law.compliance * float(bush.load_ratio(_load(t))) + moment) / gap))

    def rate(t: float, state: Array) -> list[float]:
        a = angle(t, state[0])
        total = (2.0 * gap * (math.tan(a) - a) - state[1]) / law.compliance
        kept = max(0.0, work - 2.0 * a * law.losses(a) / total) / (HEAT * bush.geometry.radius)
        return [kept * float(bush.load_ratio(_load(t))), kept * total]

    run = solve_ivp(rate, (0.0, DURATION), [0.0, 0.0], t_eval=times, rtol=rtol, atol=atol)
    return np.array([angle(t, moment) for t, moment in zip(times, run.y[0], strict=True)])


def _load(t: float) -> float:
    return LOADS[0] + (LOADS[1] - LOADS[0]) * t / DURATION


def _one_state(bush: bushes.MeltingBush, times: Array) -> Array:
    model = bushes.BushWear(bush=bush, melting_heat=HEAT)
    return _output(times, model, 0, lambda t, wear: [_load(t), SPEED])


def worn_run(times: Array, model: bushes.BushReaction) -> Array:
    """Return half the contact angle [rad] at the times [s], by a worn profile."""

    def point(t: float, wear: Array) -> list[float]:
        return [*model.position([0.0, -_load(t)], 0.0, wear).tolist(), 0.0, 0.0, SPEED]

    return _output(times, model, 3, point)


def _output(
    times: Array, model: Dynamic, number: int, inputs: Callable[[float, Array], list[float]]
) -> Array:
    """Return one output of a model at the times, with inputs that depend on time and state."""
    run = solve_ivp(
        lambda t, x: model.derivative(t, x, inputs(t, x)),
        (0.0, DURATION),
        model.initial_state,
        t_eval=times,
        rtol=USUAL["rtol"],
        atol=USUAL["atol"],
    )
    return np.array([model.output(t, x, inputs(t, x))[number] for t, x in zip(times, run.y.T, strict=True)])


def published_run(bush: bushes.MeltingBush, times: Array, steps: int) -> Array:
    """Return half the contact angle [rad] at the times [s], by the published stage in so many steps."""
    law = bush.law
    unit = bush.geometry.radius * HEAT / (law.liner * bush.outer_swing)
    grid = np.linspace(0.0, DURATION, steps + 1)
    loads = np.array([_load(t) for t in grid])
    stage = bushes.published_stage(bush, loads, SPEED, grid / unit)
    return np.interp(times, grid, stage.contact_angle)
