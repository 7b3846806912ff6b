"""Job j: a force law of your own, and a table of another program, under one rotor."""

from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import picture_of

Path("foreign.csv").write_text(
    "n [rpm],Khh [N/mm],Kvv [N/mm],Chh [N s/mm],Cvv [N s/mm]\n"
    "1000,80e3,120e3,300,500\n9000,60e3,90e3,90,120\n"
)
names = {"speed": "n", "kxx": "Khh", "kyy": "Kvv", "cxx": "Chh", "cyy": "Cvv"}
foreign = rf.TabulatedBearing.from_csv("foreign.csv", columns=names)
print(foreign)
picture_of(foreign).save("job_foreign_bearing.png")
own = rf.as_reaction(
    lambda x, y, vx, vy, speed: (-1e8 * x - 1e5 * vx, -1e8 * y - 1e5 * vy), clearance="0.1 mm"
)
steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
rotor = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(4), speed=0.0,
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
)  # fmt: skip
found = rf.critical_speeds(
    rotor, {"left": own, "right": foreign}, np.linspace(1100.0, 8900.0, 9) * np.pi / 30.0
)
print(found)
print("first critical speed [rpm]:", found[0].speed * 30.0 / np.pi)
