"""How oil whirl begins, and where it coexists with the rest: a rigid rotor on a short bearing.

At two loads, eccentricity ratio .1 and .2 at the threshold of whirl, over the speed: the onset and its
criticality, the whirl orbits stable or not, their folds; and below the first threshold, where initial
positions lead. The stable whirl of the lighter rotor reaches 5 % below the threshold.
"""

import math
from pathlib import Path

import numpy as np

from rotorfilm import (
    JournalBearing,
    RigidRotor,
    ShortFilm,
    coefficients,
    continue_orbits,
    critical_mass,
    equilibrium,
    hopf_point,
    mount,
)
from rotorfilm.analysis import Bifurcation, basin_scan
from rotorfilm.charts import new_figure, plot_basin, plot_orbit_curves, save

C, LOAD = 1e-4, 500.0
bearing = JournalBearing(radius=0.05, length=0.02, clearance=C, viscosity=0.02, film=ShortFilm())


def threshold(eps):
    """Return the speed [rad/s] and the mass [kg] of a rotor that begins to whirl at an eccentricity ratio."""
    sigma = (1 - eps**2) ** 2 / (eps * math.sqrt(16 * eps**2 + math.pi**2 * (1 - eps**2)))
    speed = sigma * 4 * C**2 * LOAD / (bearing.viscosity * bearing.radius * bearing.length**3)
    at = equilibrium(bearing, [LOAD, 0.0], speed)
    return speed, critical_mass(coefficients(bearing, at.position, speed)).mass


def family(speed, mass):
    """Return the rotor in its bearing over the speed / threshold."""

    def build(ratio):
        rotor = RigidRotor(mass=mass, speed=ratio * speed, gravity=(LOAD / mass, 0.0))
        return mount(rotor, {"": bearing})

    return build


curves = {}
for eps, low in ((0.1, 0.94), (0.2, 0.98)):
    rotors = family(*threshold(eps))
    onset = hopf_point(rotors, (0.97, 1.03))
    kind = "super" if onset.supercritical else "sub"
    print(f"eps {eps}: onset at {onset.parameter:.6f}, {kind}critical, Lyapunov {onset.lyapunov:.4f}")
    curve = continue_orbits(rotors, onset, bounds=(low, 1.03), tolerance=1e-6, most=60)
    for event in curve.events:
        print(f"  {event.kind.value} at {event.parameter:.5f}, amplitude {event.orbit.amplitude:.3f} C")
    curves[f"eccentricity ratio {eps} at the threshold"] = curve

figure = new_figure(size=(11.0, 5.0))
left, right = figure.subplots(1, 2)
plot_orbit_curves(curves, parameter="speed / threshold of whirl").draw(left)
left.set_title("Whirl of a short bearing (dashed: unstable)")

light = family(*threshold(0.1))(0.97)
line = np.linspace(-0.97, 0.97, 29)
grid = C * np.stack(np.meshgrid(line, line))
inside = np.hypot(*grid) < 0.97 * C
rest = basin_scan(light, [[0.0], [0.0]], turns=1).rest
scan = basin_scan(light, grid[:, inside] - rest[:, None], turns=100, rtol=1e-4)
print(f"{np.mean(scan.whirls):.0%} of the positions within .97 C lead into whirl, 3 % below the threshold")
save(plot_basin(scan, clearance=C).draw(right)[0], Path("whirl_bifurcation.png"))

small = next(event for event in curve.events if event.kind is Bifurcation.FOLD)
print("fold of the small cycle / threshold:", small.parameter)
