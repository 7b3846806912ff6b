"""A rotor on its film as an FMU in a loop of one's own around fmpy.

From the center the journal settles until its film carries the weight. Any other loop has the same calls.
"""

import fmpy.simulation

import rotorfilm as rf

bearing = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
rotor = rf.mount(rf.RigidRotor(mass=53.5, speed=157.0), {"": bearing})
path = str(rf.export_fmu(rotor, "rotor.fmu", component="rotor"))
about = fmpy.read_model_description(path)
force = [variable.valueReference for variable in about.modelVariables if variable.name == "rotor.force_y"]
fmu = fmpy.simulation.instantiate_fmu(fmpy.extract(path), about, "CoSimulation")
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.exitInitializationMode()
for k in range(2000):
    fmu.doStep(1e-3 * k, 1e-3)
print("force of the film / weight:", fmu.getReal(force)[0] / (53.5 * 9.80665))
