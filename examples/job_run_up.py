"""Job c: a nonlinear run-up through the onset of whirl: waterfall, amplitudes and orbits."""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import picture_of

film = rf.JournalBearing(diameter="100 mm", length="50 mm", clearance="100 um", viscosity="20 mPa s")
load, mass = (0.0, -500.0), 50.0
onset = rf.whirl_threshold(film, load, mass).speed
profile = rf.SpeedProfile((0.0, 2.0), (0.6 * onset, 1.3 * onset))
rotor = rf.RigidRotor(
    mass=mass, speed=profile, unbalance="500 g mm", gravity=(0.0, 0.0), static_force=load,
    position=tuple(rf.equilibrium(film, load, 0.6 * onset).position),
)  # fmt: skip
run = rf.simulate(rotor, film, duration=2.0, times=np.linspace(0.0, 2.0, 20001))
for kind in ("waterfall", "amplitude", "orbits"):
    picture_of(run, kind).save(f"job_run_up_{kind}.png")
found = rf.analysis.run_spectra(run, windows=40)
print(rf.analysis.run_amplitudes(run))
last = found.whirl_amplitude[-1]
print("whirl frequency / speed at the end:", found.frequency[last.argmax()] / found.speed[-1])
