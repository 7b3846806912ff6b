"""Figure 2 of Evtushenko & Kovalenko (1993), drawn again, and their printed numbers beside computed ones."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from rotorfilm.bearings import ApproximateShaft, GlobalBalance, f4k20_bush, published_stage
from rotorfilm.charts import plot_contact_pressure, plot_critical_speed, save

exact = f4k20_bush()
bush = replace(exact, shaft_heat=ApproximateShaft())  # the closed form (2.13) that the source calculates with
whole = replace(exact, balance=GlobalBalance())
loads = np.array([3e-3, 7e-3, 1e-2]) * bush.force_unit
printed = {  # section 4, by load
    "alpha0 [rad]": (0.135, 0.178, 0.201),
    "beta0 / R": (-0.479e-2, -0.456e-2, -0.441e-2),
    "omega_c(alpha0) [1/s]": (7.96, 4.51, 3.55),
    "omega_* [1/s]": (29.99, 12.85, 8.99),
}


def row(name, model):
    """Return the three numbers of a row of the table, by the formulas of a model."""
    alpha = model.contact_angle(loads)
    return {
        "alpha0 [rad]": alpha,
        "beta0 / R": model.settlement(alpha) / model.geometry.radius,
        "omega_c(alpha0) [1/s]": model.critical_speed(loads),
        "omega_* [1/s]": [model.onset_speed(load, 0.0) for load in loads],
    }[name]


heads = ("printed", "printed formulas", "exact shaft heat", "whole shaft")
print(f"{'':22}" + "".join(f"{head:>32}" for head in heads))
for name, source in printed.items():
    cells = (source, row(name, bush), row(name, exact), row(name, whole))
    print(f"{name:22}" + "".join(f"{'  '.join(f'{value:.5g}' for value in cell):>32}" for cell in cells))
last = float(bush.angle_at(0.0))
print(f"alpha_hat, at zero settlement: {last:.6f} rad (printed 0.521)")

# All six speeds differ by one factor, which a friction coefficient at the melting point would explain.
computed = np.array([row("omega_c(alpha0) [1/s]", bush), row("omega_* [1/s]", bush)])
factors = computed / [printed["omega_c(alpha0) [1/s]"], printed["omega_* [1/s]"]]
needed = 0.1 * factors.mean()
print(
    f"""Speeds of the printed formulas are {factors.min():.4f} to {factors.max():.4f} of the printed ones.
They go as 1/f(T_*): f = 0.1 as printed; f = {needed:.4f} would give the printed speeds. The source lets
friction depend on temperature, gives f0 and f2 but no f1, and does not define f(T). Nothing is tuned here.
Exact shaft heat: the closed form is 2.2 % high. Whole shaft: what the shaft conducts away leaves through its
whole circumference, but friction makes it on the arc of contact only."""
)

curves = {}
for load, ratio in zip(loads, (3e-3, 7e-3, 1e-2), strict=True):
    angles = np.linspace(bush.contact_angle(load), last, 100)
    curves[f"N = {ratio:g}"] = (angles, bush.critical_speed(load, angles) / bush.critical_speed(load))
save(plot_critical_speed(curves), Path("bush_critical_speed.png"))

stage = published_stage(bush, loads[2], 9.0, np.linspace(0.0, 1e-4, 401))
pressures, assumed = {}, {}
for k in (0, 40, 400):
    alpha, label = stage.contact_angle[k], f"t = {stage.times[k]:.0e}"
    angles = np.linspace(-alpha, alpha, 201)
    pressures[label] = (angles, stage.pressure(angles)[k])
    shape = (np.cos(angles) - np.cos(alpha)) / (1.0 - np.cos(alpha))
    assumed[label] = (angles, bush.maximum_pressure(loads[2], alpha) * shape)
save(plot_contact_pressure(pressures, assumed=assumed, modulus=3e8), Path("bush_pressure.png"))
print("alpha_hat [rad]:", last)
