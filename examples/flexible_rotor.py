"""A flexible rotor on two oil films: loads, Campbell diagram, threshold of whip, unbalance response.

The rotor of Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines (2010), section 5.9: a steel shaft
of 1.5 m x 50 mm with two disks, on springs in example 5.9.1 and on films in example 5.9.6.
"""

import math
from dataclasses import replace

import numpy as np

from rotorfilm import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    JournalBearing,
    LinearBearing,
    Probe,
    ShaftElement,
    ShaftRotor,
    Station,
    Unbalance,
    campbell,
    critical_speeds,
    reduce_rotor,
    rotor_equilibrium,
    rotor_modes,
    rotor_threshold,
    unbalance_response,
)
from rotorfilm.analysis import resonant_speeds
from rotorfilm.charts import plot_campbell, plot_rotor, plot_unbalance_response

RPM = math.pi / 30.0
steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
rotor = ShaftRotor(
    elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
    disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
    stations=(Station(node=0, name="left"), Station(node=6, name="right")),
    probes=(Probe(node=2, name="small"), Probe(node=4, name="large")),
    unbalances=(Unbalance(node=2, unbalance=1e-3),),
    speed=1500.0 * RPM,
)
film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
films = {"left": film, "right": film}

at = rotor_equilibrium(rotor, films, 1500.0 * RPM)
for name, load in at.loads.items():
    K = at.coefficients[name].stiffness
    print(f"{name}: {-load[1]:.1f} N, Kxx {K[0, 0]:.4g}, Kyy {K[1, 1]:.4g} N/m at 1500 rpm")

speeds = np.linspace(200.0, 4600.0, 89) * RPM
chart = campbell(rotor, films, speeds, highest_frequency=600.0)
critical = critical_speeds(rotor, films, speeds)
for one in critical:
    print(f"critical: {one.speed / RPM:.0f} rpm, decrement {one.log_decrement:.3f}, {one.direction:+.2f}")
plot_campbell(chart, critical=critical).save("campbell.png")
plot_rotor(rotor, films).save("rotor.png")

onset = rotor_threshold(rotor, films, speeds)
print(f"whip from {onset.speed / RPM:.1f} rpm, at {onset.whirl_ratio:.4f} of the speed")
small = reduce_rotor(rotor, frequency=500.0, tolerance=1e-3).rotor
again = rotor_threshold(small, films, speeds).speed
print(f"with {len(small.states)} states for {len(rotor.states)}: {again / RPM:.1f} rpm")

response = unbalance_response(rotor, films, resonant_speeds(speeds[speeds < onset.speed], critical))
outputs = ["small_x", "small_y", "left_x", "left_y"]
shown = plot_unbalance_response(response, outputs, critical=critical, threshold=onset.speed)
shown.save("unbalance_response.png")


book = replace(rotor, beam=ClassicalBeam())  # as the book has it
modes = rotor_modes(book, dict.fromkeys(films, LinearBearing(stiffness=1e6)), 4000.0 * RPM)
print("on springs of 1 MN/m at 4000 rpm [rad/s]:", *np.round(modes.frequency[:5], 2))
print("first forward whirl (printed 87.80):", modes.frequency[1])
