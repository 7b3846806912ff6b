"""Porous squeeze-film damper: the four figures of Akhverdiev et al. with correct physics (damper_paper.png).

Their equations damp with the wrong sign, hold a wedge term though the race does not spin, and are linear,
so that nothing in them can jump; what they conclude is checked here. Their B is B_s/2 at L/D = 1/2, which
they do not give. `damper_feed.py` judges what they say of feed and transients.
"""

import math

import numpy as np
from matplotlib.figure import Figure

import rotorfilm as rf
from rotorfilm.analysis import cartesian_state
from rotorfilm.charts import plot_eccentricity, plot_phase, plot_transmissibility, plot_transmitted

RADIUS, LENGTH, CLEARANCE, MASS, SPEED = 0.05, 0.025, 1e-4, 10.0, 400.0
UNIT = MASS * CLEARANCE
U = np.linspace(0.01, 0.6, 400)


def support(B, phi=0.0, grading=0.0, spring=0.4, suction=0.0, ends=None):
    """Return damper and springs; suction is A_0 of the paper, ends its P_H and P_K."""
    viscosity = 2.0 * B * MASS * SPEED * CLEARANCE**3 / (RADIUS * LENGTH**3)
    H = 0.1 * LENGTH
    cage = rf.PorousCage(thickness=H, permeability=phi * CLEARANCE**3 / H, grading=grading) if phi else None
    feed = None
    if suction:
        inflow = -suction * phi * math.exp(-grading) * (RADIUS / H) ** 2 * CLEARANCE * SPEED
        feed = rf.RadialFeed(inflow=inflow, cosine=True)
    if ends:
        pressure = viscosity * SPEED * (RADIUS / CLEARANCE) ** 2
        feed = rf.bearings.AxialFeed(start_pressure=ends[0] * pressure, end_pressure=ends[1] * pressure)
    dimensions = {"radius": RADIUS, "length": LENGTH, "clearance": CLEARANCE, "viscosity": viscosity}
    damper = rf.PorousDamper(**dimensions, cage=cage, feed=feed)
    return rf.with_springs(damper, MASS * (spring * SPEED) ** 2) if spring else damper


def orbits(reaction, unbalances=U):
    """Return the synchronous orbits at speed ratio 1."""
    rotor = rf.RigidRotor(mass=MASS, speed=SPEED, unbalance=UNIT, gravity=(0.0, 0.0))
    return rf.synchronous_orbits(rotor, reaction, UNIT * unbalances)


def transient(reaction, beta=-2.8, rate=0.0):
    """Return T and T_r(T) from eps = .6 (figure 4); their -2.8 may be beta [rad] or its rate."""
    rotor = rf.RigidRotor(mass=MASS, speed=SPEED, unbalance=0.4 * UNIT, gravity=(0.0, 0.0))
    start = cartesian_state((0.6, beta, 0.0, (1.0 + rate) * SPEED), CLEARANCE)
    run = rf.simulate(rotor, reaction, duration=20.0 / SPEED, samples=301, initial_state=start, rtol=1e-5)
    return SPEED * run.time, rf.analysis.transmitted_ratio(run, rotor)


cases = {"solid": {}, "porous": {"phi": 0.001, "grading": 0.1}}
fed = {**cases, "porous, suction": {**cases["porous"], "suction": 0.1}}
fed["porous, fed at the ends"] = {**cases["porous"], "ends": (0.2, 0.15)}
figure = Figure(figsize=(11.0, 8.0), layout="constrained")
(top, right), (low, last) = figure.subplots(2, 2)
plot_transmitted({label: transient(support(0.12, **case)) for label, case in fed.items()}).draw(top)
thin = {label: orbits(support(0.04, **case)) for label, case in cases.items()}
thick = {label: orbits(support(0.12, **case)) for label, case in cases.items()}
soft = {"porous, no spring": orbits(support(0.12, phi=0.01, grading=0.1, spring=0.0))}
plot_transmissibility(thin, unit=UNIT).draw(right)
plot_eccentricity({**thick, **soft}, unit=UNIT).draw(low)
plot_phase({**thick, **soft}, unit=UNIT).draw(last)
for axes, title in zip(
    (top, right, low, last), ("B = 0.12", "B = 0.04", "B = 0.12", "B = 0.12"), strict=True
):
    axes.set_title(f"{title}, dotted: unstable, cross: contact")
figure.savefig("damper_paper.png", dpi=110)

solid, porous = ([fold.unbalance / UNIT for fold in found.folds] for found in thin.values())
print(f"jump to the right with permeability: {porous[0] > solid[0]} ({solid[0]:.4f} -> {porous[0]:.4f})")
for name, number, at in (("lower", 0, 0.35), ("upper", -1, 0.5)):
    parts = [found.branches[number] for found in thin.values()]
    dense, leaky = (np.interp(at * UNIT, part.unbalance, part.eccentricity_ratio) for part in parts)
    print(f"smaller orbits of the porous damper, {name} branch: {leaky < dense}")
peaks = [found.branches[-1].transmissibility.max() for found in thin.values()]
print(f"greatest transmissibility smaller at this speed: {peaks[1] < peaks[0]}")
print("unbalance ratio at which the rotor on the solid damper jumps:", solid[0])
