"""Job b: a rotor with two disks on plain bearings and on tilting pads: modes, response, stability."""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import picture_of, plot_unbalance_response

steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
shaft = rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(6)
disks = tuple(rf.Disk.solid(node, density=7810.0, width=0.06, outer_diameter=0.3) for node in (2, 4))
ends = (rf.Station(node=0, name="left"), rf.Station(node=6, name="right"))
plane = rf.Unbalance(node=2, unbalance="200 g mm")
rotor = rf.ShaftRotor(elements=shaft, disks=disks, stations=ends, unbalances=(plane,), speed=0.0)
speeds = np.linspace(1000.0, 9000.0, 12) * np.pi / 30.0
size = {"diameter": "80 mm", "length": "40 mm", "viscosity": "20 mPa s"}
five = {"assembled_clearance": "60 um", "preload": 0.3, "extent": "60 deg", "pivots": rf.even_pivots(5)}
for film in (rf.JournalBearing(**size, clearance="60 um"), rf.TiltingPadBearing(**size, **five)):
    films = {"left": film, "right": film}
    chart = rf.campbell(rotor, films, speeds, 1000.0)
    print(film, chart, rf.rotor_threshold(rotor, films, speeds), sep="\n")
    picture_of(chart).save(f"job_two_disks_{type(film).__name__}.png")
plot_unbalance_response(rf.unbalance_response(rotor, films, speeds)).save("job_two_disks_response.png")
print("modes that grow on tilting pads:", int((np.nan_to_num(chart.log_decrement, nan=1.0) < 0.0).sum()))
