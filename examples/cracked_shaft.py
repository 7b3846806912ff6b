"""A shaft with a breathing crack: its motion once, twice and three times per turn, over the speed.

Weight opens and closes the crack: a horizontal shaft shows it at a half and a third of its critical speed.
"""

from dataclasses import replace

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_axes

steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7800.0)
shaft = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.0, outer_diameter=0.05, material=steel).split(2),
    speed=100.0,
    stations=(rf.Station(node=0, name="left"), rf.Station(node=2, name="right")),
    disks=(rf.Disk.solid(1, density=7800.0, width=0.05, outer_diameter=0.35, inner_diameter=0.05),),
    probes=(rf.Probe(node=1, name="disk"),),
    beam=rf.ClassicalBeam(),
)
springs = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=5e7, damping=2e3))
crack = rf.rotors.ShaftCrack(element=0, depth=0.015)


def response(speed: float) -> rf.analysis.CrackedResponse:
    """Return the periodic motion at a speed [rad/s]."""
    cracked = rf.CrackedRotor(rotor=replace(shaft, speed=speed), crack=crack)
    return rf.cracked_response(rf.mount(cracked, springs), harmonics=3, steps=24)


natural = rf.rotor_modes(shaft, springs, 1.0).frequency[0]
shares = np.unique(
    [*np.linspace(0.3, 0.56, 27), *np.linspace(0.32, 0.35, 25), *np.linspace(0.485, 0.515, 31)]
)
series = np.array([np.abs(response(share * natural).series["disk_y"]) for share in shares])
axes = new_axes("Motion of the disk of a cracked shaft")
for times in (1, 2, 3):
    axes.semilogy(shares, 1e6 * series[:, times], label=f"{times} per turn")
axes.set(xlabel="speed / critical speed", ylabel="amplitude of disk_y [um]")
axes.legend()
axes.figure.savefig("cracked_shaft.png")
peak = shares[series[:, 2].argmax()]
print(f"critical speed {natural:.1f} rad/s; twice per turn resounds at {peak:.3f} of it")
print("twice the speed of that resonance / critical speed:", 2.0 * peak)
