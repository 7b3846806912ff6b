"""Job d: the FMU of a machine at rest in its films, run by fmpy, which sets the unbalance."""

import fmpy

import rotorfilm as rf
from rotorfilm.charts import picture_of
from rotorfilm.scenes import export_machine_fmu

steel = rf.ElasticMaterial(young_modulus="211 GPa", shear_modulus="81.2 GPa", density=7810.0)
film = rf.JournalBearing(diameter="80 mm", length="40 mm", clearance="60 um", viscosity="20 mPa s")
shaft = rf.ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(4)
ends = (rf.Station(node=0, name="left"), rf.Station(node=4, name="right"))
plane = rf.Unbalance(node=2, unbalance=0.0)
rotor = rf.ShaftRotor(elements=shaft, stations=ends, unbalances=(plane,), speed=300.0)
export_machine_fmu(rotor, {"left": film, "right": film}, "machine.fmu", frequency=600.0)
run = fmpy.simulate_fmu("machine.fmu", start_values={"machine.plane_2_unbalance": 2e-4}, stop_time=0.02)
journal = {axis: run[f"machine.left_{axis}"] for axis in "xy"}
picture_of(rf.Trajectory(time=run["time"], signals=journal, work={})).save("job_machine_fmu.png")
print("film force at rest / half the weight:", run["machine.left_force_y"][0] / (4.9033 * rotor.mass))
