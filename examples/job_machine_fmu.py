"""Job d: the FMU of a machine, run by fmpy and by the importer of this package, with an unbalance set."""

from pathlib import Path

import fmpy
from matplotlib.figure import Figure

import rotorfilm as rf
from rotorfilm.charts import save
from rotorfilm.cosim import open_fmu
from rotorfilm.scenes import export_machine_fmu

steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
film = rf.JournalBearing(diameter="80 mm", length="40 mm", clearance="60 um", viscosity="20 mPa s")
rotor = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(4), speed=300.0,
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
    unbalances=(rf.Unbalance(node=2, unbalance=2e-4),), probes=(rf.Probe(node=2, name="middle"),),
)  # fmt: skip
export_machine_fmu(rotor, {"left": film, "right": film}, "machine.fmu", frequency=600.0)
started = {"machine.plane_2_unbalance": 2e-4, "machine.plane_2_unbalance_angle": 0.0}
run = fmpy.simulate_fmu("machine.fmu", start_values=started, stop_time=0.02, output=["machine.middle_x"])
print(run[:5])
axes = Figure().add_subplot(xlabel="time [s]", ylabel="middle, x [um]")
axes.plot(run["time"], 1e6 * run["machine.middle_x"])
save(axes, Path("job_machine_fmu.png"))
with open_fmu("machine.fmu") as other:
    other.start({})
    other.step(0.0, 0.02)
    end = other.get()["middle_x"]
print("importer of this package / fmpy:", end / run["machine.middle_x"][-1])
