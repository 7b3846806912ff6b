"""Job e: transmissibility of a squeeze-film damper over the unbalance with its jump, and its Bode plot."""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import picture_of

film = rf.SqueezeFilmDamper(
    diameter="100 mm", length="20 mm", clearance="100 um", viscosity="5 mPa s", film=rf.bearings.MapSqueeze()
)
support = rf.with_springs(film, 2e6)
rotor = rf.RigidRotor(mass=30.0, speed=600.0, unbalance=1e-3, gravity=(0.0, 0.0))
orbits = rf.synchronous_orbits(rotor, support, np.linspace(1e-5, 4e-3, 300))
print(*orbits.folds, sep="\n")
picture_of(orbits, "transmissibility").save("job_damper_jump.png")
picture_of(orbits, "phase").save("job_damper_phase.png")
print("jumps:", len(orbits.folds))
