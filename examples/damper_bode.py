"""Transmissibility of a squeeze-film damper in Bode form: force on the housing per force on the rotor.

Small motion of a full film beside its springs. Whatever the damping, the housing feels the whole force at
sqrt(2 K/m), more below, less above.
"""

import control

import rotorfilm as rf

damper = rf.PorousDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=5e-4, extent=rf.FullFilm())
support = rf.with_springs(damper, 2.56e5)
rotor = rf.RigidRotor(mass=10.0, speed=400.0, gravity=(0.0, 0.0))
ratio = rf.small_motion_transmissibility(rotor, support, name="damper")
plot = control.bode_plot(ratio, (10.0, 2000.0), dB=True)
plot.figure.savefig("damper_bode.png")
print("gain at sqrt(2 K/m):", abs(ratio(1j * (2.0 * 2.56e5 / 10.0) ** 0.5)))
