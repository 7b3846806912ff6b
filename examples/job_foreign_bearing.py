"""Job j: a force law of your own, and a table of another program, under one rotor."""

from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import picture_of

names = {"speed": "n", "kxx": "Khh", "kyy": "Kvv", "cxx": "Chh", "cyy": "Cvv"}
foreign = rf.TabulatedBearing.from_csv(Path(__file__).with_name("foreign.csv"), columns=names)
picture_of(foreign).save("job_foreign_bearing.png")
own = rf.as_reaction(lambda x, y, vx, vy, speed: (-1e8 * x - 1e5 * vx, -1e8 * y - 1e5 * vy), clearance=1e-4)
steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
shaft = rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(4)
ends = (rf.Station(node=0, name="left"), rf.Station(node=4, name="right"))
rotor, speeds = rf.ShaftRotor(elements=shaft, stations=ends, speed=0.0), np.linspace(115.0, 930.0, 9)
found = rf.critical_speeds(rotor, {"left": own, "right": foreign}, speeds)
print(foreign, found, sep="\n")
print("first critical speed [rpm]:", found[0].speed * 30.0 / np.pi)
