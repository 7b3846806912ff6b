"""A shaft on a polymer bush: run-up through the critical speed, wear by melting, then a drop of the load."""

from dataclasses import replace

import numpy as np

from rotorfilm import BushReaction, RigidRotor, SpeedProfile, cosimulate, export_fmu, simulate
from rotorfilm.bearings import f4k20_bush

bush = f4k20_bush()
# Melting heat and damping of the liner are not in the source: round numbers of the right size.
# The temperature is named, so that trial states of the run, which may cool, are not warned of.
film = BushReaction(bush=bush, melting_heat=1e8, nodes=36, extent=1.4, retardation=2e-4, temperature=250.0)
load = 3750.0
critical = float(bush.critical_speed(load))

run_up = SpeedProfile(times=(0.0, 0.5), speeds=(0.8 * critical, 2.0 * critical))
rotor = RigidRotor(
    mass=50.0,
    speed=run_up,
    gravity=(0.0, 0.0),
    static_force=(0.0, -load),
    position=tuple(film.position([0.0, -load], speed=critical)),
)
motion = simulate(rotor, film, duration=0.6, samples=241, rtol=1e-5)
depth = np.array([motion[signal.name] for signal in film.states])
deepest = depth.max(axis=0)

begin = int(np.argmax(deepest > 1e-9))
print(f"critical speed {critical:.4f} rad/s; wear begins at {motion['speed'][begin]:.4f} rad/s")
for k in (0, begin, 160, 240):
    speed, angle, peak = (motion[name][k] for name in ("speed", "contact_angle", "maximum_pressure"))
    print(
        f"t = {motion.time[k]:.3f} s  speed {speed:6.3f} rad/s  wear {deepest[k] * 1e6:6.2f} um  "
        f"half angle {angle:.3f} rad  largest pressure {peak * 1e-6:.2f} MPa"
    )

# The load drops to a third; profile and shaft go on from where they are, the contact for a while as hot.
hot = bush.liner.melting_point
worn = replace(film, wear_depth=tuple(np.maximum(depth[:, -1], 0.0)), temperature=hot)
lighter = replace(
    rotor,
    speed=float(motion["speed"][-1]),
    static_force=(0.0, -load / 3.0),
    position=tuple(motion.position[:, -1]),
    velocity=tuple(motion.velocity[:, -1]),
)
after = simulate(lighter, worn, duration=0.05, samples=1001, rtol=1e-6)

# The same as two coupled FMUs.
for model, name in ((lighter, "shaft"), (worn, "bush")):
    start = dict(zip(("x", "y", "speed"), (*lighter.position, lighter.speed), strict=True))
    export_fmu(model, f"{name}.fmu", component=name, start=start if name == "bush" else {"force_y": load})
coupled = cosimulate("shaft.fmu", "bush.fmu", macro_step=5e-5, duration=0.05).trajectory
apart = np.abs(coupled.position - after.position).max()
print(f"coupled FMUs at 0.05 ms: {apart * 1e9:.1f} nm off the solution as one system")

rest, temperature = worn.rest([0.0, -load / 3.0], float(motion["speed"][-1]))
deeper = np.hypot(*rest) - np.hypot(*worn.position([0.0, -load / 3.0], 1.0))
print(f"it cools from {hot:.0f} to {temperature:.0f} K in the end, the shaft sinks by {deeper * 1e6:.1f} um")

unworn = float(bush.contact_angle(load / 3.0))
print(f"after the drop: half angle {after['contact_angle'][-1]:.3f} rad, of an unworn bush {unworn:.3f} rad")
print("speed at which wear begins / critical speed:", motion["speed"][begin] / critical)
