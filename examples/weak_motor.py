"""A motor too weak for its rotor: at the critical speed all of its torque makes whirl (Sommerfeld 1902).

The same rotor with a weak and a strong motor; power tells where the weak one hangs.
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import rotorfilm as rf
from rotorfilm.charts import new_axes

mass, stiffness, damping, unbalance = 10.0, 1e5, 40.0, 4e-3
critical = (stiffness / mass) ** 0.5
springs = rf.LinearBearing(stiffness=stiffness, damping=damping)
rotor = rf.RigidRotor(mass=mass, speed=0.7 * critical, unbalance=unbalance, gravity=(0.0, 0.0))
axes = new_axes("Speed / critical speed over time [s], with a weak and a strong motor")
ends = []
for stall in (0.3, 2.0):
    motor = rf.rotors.LinearMotor(stall_torque=stall, idle_speed=2.0 * critical)
    driven = rf.MotorDrivenRotor(rotor=rotor, inertia=5e-3, torque=motor)
    run = rf.simulate(driven, springs, duration=2.5, samples=501, rtol=1e-5)
    axes.plot(run.time, run["speed"] / critical, label=f"stall torque {stall} N m")
    ends.append(run["speed"][-200:].mean())
axes.legend()
axes.figure.savefig(Path("weak_motor.png"))


def left_over(speed: float) -> float:
    """Return the torque of the weak motor less that of steady whirl [N m]: damping times speed times r^2."""
    radius = unbalance * speed**2 / np.hypot(stiffness - mass * speed**2, damping * speed)
    return 0.3 * (1.0 - 0.5 * speed / critical) - damping * speed * radius**2


print(f"strong motor: {ends[1] / critical:.2f} of the critical speed; weak one: {ends[0] / critical:.3f}")
print("speed of the weak motor / speed by balance of power:", ends[0] / brentq(left_over, 70.0, critical))
