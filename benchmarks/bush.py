"""The tiers of the melting bush in one run, accuracy beside cost, and the figure of docs/bush.md.

A load grows from 3 to 4.5 kN within a second at 12 rad/s, with the example of the source. Reference: the two
moments of the wear, an exact reduction of the worn profile under a load that grows (tests/bearings). Baseline
of the cost: that reduction in plain Python with scipy's brentq, what a competent user would write.

    python benchmarks/bush.py [FIGURE.png]
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotorfilm import BushReaction, BushWear
from rotorfilm.bearings import (
    ApproximateShaft,
    LocalMelting,
    approximate_flux,
    exact_flux,
    f4k20_bush,
    published_stage,
)
from rotorfilm.charts import new_axes, plot_contact_pressure, plot_critical_speed

BUSH, HEAT, SPEED, END = f4k20_bush(), 1e8, 12.0, 1.0
TOLERANCES = {"rtol": 1e-6, "atol": 1e-12}


def load(t: float) -> float:
    return 3000.0 + 1500.0 * t


def two_moments(t_eval: np.ndarray, **options) -> np.ndarray:
    """Return half the contact angle at the times, by W and V alone."""
    gap, compliance = float(BUSH.gap(250.0)), BUSH.compliance
    shaft, liner, unit = BUSH.shaft_conductance * 250.0, BUSH.liner_conductance, BUSH.force_unit
    work = 3e8 * 12.5e-3 * 0.1 * SPEED

    def angle(t, moment):
        value = (compliance * load(t) / unit + moment) / gap
        return brentq(lambda a: (a - 0.5 * math.sin(2.0 * a)) - value * math.cos(a), 1e-9, 1.57, xtol=1e-14)

    def rate(t, state):
        a = angle(t, state[0])
        total = (2.0 * gap * (math.tan(a) - a) - state[1]) / compliance
        lost = shaft + liner * (250.0 - 235.0 - 4.0 * math.sin(a) / a)
        kept = max(0.0, work - 2.0 * a * lost / total) / (HEAT * 13e-3)
        return [kept * load(t) / unit, kept * total]

    run = solve_ivp(rate, (0.0, END), [0.0, 0.0], t_eval=t_eval, **(TOLERANCES | options))
    return np.array([angle(t, moment) for t, moment in zip(t_eval, run.y[0], strict=True)])


def one_state(t_eval: np.ndarray) -> np.ndarray:
    model = BushWear(bush=BUSH, melting_heat=HEAT)
    run = solve_ivp(
        lambda t, x: model.derivative(t, x, [load(t), SPEED]), (0.0, END), [0.0], t_eval=t_eval, **TOLERANCES
    )
    return np.array([model.output(t, x, [load(t), SPEED])[0] for t, x in zip(t_eval, run.y.T, strict=True)])


def profile(t_eval: np.ndarray, model: BushReaction) -> np.ndarray:
    def point(t, wear):
        return [*model.position([0.0, -load(t)], 0.0, wear), 0.0, 0.0, SPEED]

    run = solve_ivp(
        lambda t, wear: model.derivative(t, wear, point(t, wear)),
        (0.0, END),
        model.initial_state,
        t_eval=t_eval,
        **TOLERANCES,
    )
    return np.array([model.output(t, v, point(t, v))[3] for t, v in zip(t_eval, run.y.T, strict=True)])


def published(t_eval: np.ndarray) -> np.ndarray:
    unit = 13e-3**2 * BUSH.thickness_ratio * HEAT / (4.0 * 0.39)
    grid = np.linspace(0.0, END, 2001)
    stage = published_stage(BUSH, load(grid), SPEED, grid / unit)
    return np.interp(t_eval, grid, stage.contact_angle)


def table(figure: str | None) -> None:
    times = np.linspace(0.0, END, 41)
    exact = two_moments(times, rtol=1e-10, atol=1e-15)
    worn = BushReaction(bush=BUSH, melting_heat=HEAT, extent=1.5)
    runs = {
        "two moments, plain Python": lambda: two_moments(times),
        "as published, 2000 steps": lambda: published(times),
        "BushWear": lambda: one_state(times),
        **{
            f"BushReaction, {n} nodes": lambda n=n: profile(times, replace(worn, nodes=n))
            for n in (17, 33, 65, 129)
        },
        "the same with LocalMelting, 65 nodes": lambda: profile(
            times, replace(worn, nodes=65, melting=LocalMelting())
        ),
    }
    print(f"{'':38}{'angle error':>12}{'time':>10}{'ratio':>8}")
    base, found = None, {"exact": exact}
    for name, run in runs.items():
        begin = perf_counter()
        angle = run()
        took = perf_counter() - begin
        base = took if base is None else base
        found[name] = angle
        print(f"{name:38}{np.abs(angle / exact - 1.0).max():12.1e}{took * 1e3:8.0f} ms{took / base:8.1f}")
    if figure is not None:
        draw(figure, times, found)


def draw(path: str, times: np.ndarray, found: dict[str, np.ndarray]) -> None:
    """Draw critical speed, published pressure, error of the closed form, and the tiers."""
    first = new_axes("Critical speed, by load N", size=(11.0, 8.0))
    figure = first.get_figure()
    first.remove()
    panels = figure.subplots(2, 2)
    for panel in panels.flat:
        panel.set_prop_cycle(
            color=["tab:blue", "tab:orange", "tab:green", "tab:red"], linestyle=["-", "--", "-.", ":"]
        )
    bush = replace(BUSH, shaft_heat=ApproximateShaft())
    speeds = {}
    for ratio in (3e-3, 7e-3, 1e-2):
        force = ratio * bush.force_unit
        angles = np.linspace(bush.contact_angle(force), bush.angle_at(0.0), 100)
        speeds[f"N = {ratio:g}"] = (angles, bush.critical_speed(force, angles) / bush.critical_speed(force))
    plot_critical_speed(speeds).draw(panels[0, 0])[0].set_title("Critical speed as the bush wears, by load")
    stage = published_stage(bush, 3750.0, 9.0, np.linspace(0.0, 1e-4, 401))
    angles = np.linspace(-0.55, 0.55, 401)
    pressures = {f"t = {stage.times[k]:g}": (angles, stage.pressure(angles)[k]) for k in (0, 40, 400)}
    plot_contact_pressure(pressures, modulus=3e8).draw(panels[0, 1])[0].set_title(
        "Pressure as published, N = 0.01"
    )
    cooling = np.linspace(0.02, 0.3, 30)
    for mu in (0.1, 0.25, 0.5, 1.0):
        error = [100.0 * (approximate_flux(lam, mu) / exact_flux(lam, mu) - 1.0) for lam in cooling]
        panels[1, 0].plot(cooling, error, label=f"shaft radius / half length = {mu:g}")
    panels[1, 0].set(
        title="Error of the closed form of the shaft heat (2.13)",
        xlabel="Biot number of the shaft [1]",
        ylabel="error [%]",
    )
    for name in ("exact", "BushWear", "BushReaction, 33 nodes", "as published, 2000 steps"):
        panels[1, 1].plot(times, found[name], label=name)
    panels[1, 1].set(
        title="Load growing from 3 to 4.5 kN, 12 rad/s", xlabel="time [s]", ylabel="half contact angle [rad]"
    )
    for panel in panels.flat:
        panel.grid(visible=True, alpha=0.3)
        panel.legend(fontsize=8)
    figure.savefig(path, dpi=100, metadata={"Software": "rotorfilm"})


if __name__ == "__main__":
    table(sys.argv[1] if len(sys.argv) > 1 else None)
