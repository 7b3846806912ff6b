"""Job b: a rotor with two disks on plain bearings and on tilting pads: modes, response, stability."""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import plot_campbell, plot_unbalance_response

steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
shaft = rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(6)
disk = {"density": 7810.0, "width": 0.06, "outer_diameter": 0.3}
rotor = rf.ShaftRotor(
    elements=shaft, disks=(rf.Disk.solid(2, **disk), rf.Disk.solid(4, **disk)), speed=0.0,
    stations=(rf.Station(node=0, name="left"), rf.Station(node=6, name="right")),
    unbalances=(rf.Unbalance(node=2, unbalance="200 g mm"),),
)  # fmt: skip
speeds = np.linspace(1000.0, 9000.0, 12) * np.pi / 30.0
size = {"diameter": "80 mm", "length": "40 mm", "viscosity": "20 mPa s"}
plain = rf.JournalBearing(**size, clearance="60 um")
pads = rf.TiltingPadBearing(
    **size, assembled_clearance="60 um", preload=0.3, extent="60 deg", pivots=rf.even_pivots(5)
)
for name, film in {"plain": plain, "pads": pads}.items():
    films = {"left": film, "right": film}
    chart = rf.campbell(rotor, films, speeds, 1000.0)
    print(name, chart, rf.rotor_threshold(rotor, films, speeds), sep="\n")
    plot_campbell(chart).save(f"job_two_disks_{name}.png")
response = rf.unbalance_response(rotor, films, speeds)
plot_unbalance_response(response).save("job_two_disks_response.png")
print("modes that grow on tilting pads:", int((np.nan_to_num(chart.log_decrement, nan=1.0) < 0.0).sum()))
