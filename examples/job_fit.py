"""Job i: the clearance and the viscosity of a machine from measured positions of its journal."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

import rotorfilm as rf

machine = rf.JournalBearing(diameter="100 mm", length="50 mm", clearance="92 um", viscosity="22 mPa s")
speed, load = np.linspace(100.0, 400.0, 7), np.array([0.0, -4000.0])
places = np.array([rf.equilibrium(machine, load, one).position for one in speed])
places += 2e-7 * np.random.default_rng(1).standard_normal(places.shape)
measured = rf.Measurements(speed=speed, load=load, values={"x": places[:, 0], "y": places[:, 1]})
ordered = replace(machine, clearance=8e-5, viscosity=0.03)
found = rf.fit_bearing(ordered, measured, free=("clearance", "viscosity"))
print(found)
as_run = replace(machine, **{name: one.value for name, one in found.parameters.items()})
fitted = np.array([rf.equilibrium(as_run, load, one).position for one in speed])
axes = Figure().add_subplot(xlabel="x [um]", ylabel="y [um]", title="measured and fitted places")
axes.plot(*(1e6 * places.T), "o", *(1e6 * fitted.T), "-")
axes.figure.savefig("job_fit.png")
print("clearance found / true:", as_run.clearance / machine.clearance)
