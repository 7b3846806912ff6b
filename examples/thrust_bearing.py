"""The thrust bearing of a compressor: film, temperature, stiffness, power and pressure (thrust.png)."""

import math

import matplotlib.pyplot as plt
import numpy as np

import rotorfilm as rf
from rotorfilm.bearings import TiltingThrustBearing

bearing = TiltingThrustBearing(
    inner_diameter="80 mm",
    outer_diameter="160 mm",
    pads=8,
    pad_arc="38 deg",
    pivot_arc=0.6,
    oil=rf.Oil.iso_vg(32),
    cooling=rf.Cooling(supply_temperature=318.15, carry_over=0.7),
    cells=(32, 16),
)
load, speed = 20e3, 10_000 * math.pi / 30.0
at = rf.equilibrium(bearing, [-load, 0.0, 0.0], speed)
warm = bearing.at_temperature(at.temperature)
losses, place = at.losses, at.position
slow = rf.coefficients(warm, place, speed, frequency=0.0)
once = rf.coefficients(warm, place, speed)
held, _ = warm.held_coefficients(place, speed)
print(f"least film {at.minimum_film * 1e6:.1f} um, over the pivots {place[0] * 1e6:.1f} um")
print(f"temperature of the film {at.temperature - 273.15:.1f} degC, power {losses.power_loss:.0f} W")
for name, K in (("slow", slow.stiffness), ("once a turn", once.stiffness), ("with held pads", held)):
    print(f"axial stiffness {name}: {K[0, 0] / 1e6:.0f} MN/m")

figure, axes = plt.subplots(figsize=(5.6, 4.6), subplot_kw={"projection": "polar"}, layout="constrained")
for pad in range(bearing.pads):
    found = warm.pressure(pad, place, np.zeros(3), speed)
    drawn = axes.pcolormesh(
        found.angle, found.radius * 1e3, found.pressure.T / 1e6, cmap="viridis", shading="gouraud", vmin=0.0
    )
    axes.plot(found.angle[0] * np.ones(2), found.radius[[0, -1]] * 1e3, color="white", lw=1)
axes.set(ylim=(0, 80), yticks=[], xticklabels=[], title="Pressure on pads of 40 to 80 mm radius, rotation +z")
axes.grid(visible=False)
figure.colorbar(drawn, label="pressure [MPa]")
figure.savefig("thrust.png", dpi=110)

print("static stiffness over twice the load per pivot film:", slow.stiffness[0, 0] * place[0] / (2.0 * load))
