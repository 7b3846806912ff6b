"""A scene: a shaft on a polymer bush, run up through melting, then unloaded; two FMUs coupled by fmpy."""

from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

from rotorfilm import Scene, SpeedProfile, export_fmu

scene = Scene.load(Path(__file__).with_name("bush.toml"))
film, load = scene.bush.reaction(), -scene.static_load[1]
critical = float(film.bush.critical_speed(load))
start, drop, end, step = 0.7 * critical, scene.excitation.start, 0.45, 1e-4
at = film.position(scene.static_load, critical)
run_up = SpeedProfile(times=(0.0, 0.3), speeds=(start, scene.speed))
rotor = replace(scene.rotor, speed=run_up, position=tuple(at))
export_fmu(rotor, "shaft.fmu", component="shaft", start={"force_y": load})
export_fmu(film, "bush.fmu", component="bush", start={"x": at[0], "y": at[1], "speed": start})


class Fmu:
    """An FMU for co-simulation, by the names of its variables."""

    def __init__(self, name):
        """Open, instantiate and initialize it."""
        about = fmpy.read_model_description(f"{name}.fmu")
        self.name, self.references = name, {v.name: v.valueReference for v in about.modelVariables}
        self.fmu = FMU2Slave(
            guid=about.guid,
            modelIdentifier=name,
            unzipDirectory=fmpy.extract(f"{name}.fmu"),
            instanceName=name,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def get(self, *names):
        """Return variables."""
        return self.fmu.getReal([self.references[f"{self.name}.{name}"] for name in names])

    def set(self, names, values):
        """Set variables."""
        self.fmu.setReal([self.references[f"{self.name}.{name}"] for name in names], values)


shaft, bush = Fmu("shaft"), Fmu("bush")
motion, force = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")
margin = f"event_{film.nodes}"  # friction heat less losses: melting begins where it turns positive
rows = []
for k in range(round(end / step)):
    if k == round(drop / step):  # the load is a tunable parameter of the shaft
        shaft.set(["static_force_y"], [-load + scene.excitation.load[1]])
    shaft.set(force, bush.get(*force))
    for fmu in (shaft, bush):
        fmu.fmu.doStep(k * step, step)
        if fmu is shaft:
            bush.set(motion, shaft.get(*motion))
    rows.append([(k + 1) * step, *bush.get("speed", margin, "contact_angle", "friction_torque", *force)])
t, speed, surplus, angle, torque, fx, fy = np.array(rows).T
begin = int(np.argmax(surplus > 0.0))
last = int(np.searchsorted(t, drop))
print(f"melting begins at {speed[begin]:.4f} rad/s, critical speed {critical:.4f} rad/s")
print(f"half contact angle: {angle[0]:.3f} rad unworn, {angle[last - 1]:.3f} worn, {angle[-1]:.3f} unloaded")
unworn = float(film.bush.contact_angle(load - scene.excitation.load[1]))
print(f"an unworn bush would touch on {unworn:.3f} rad under the small load")
# Friction carries a part of the load, so the pressure is less by sqrt(1 + f^2) and melting begins later.
print("speed at which melting begins / critical speed:", speed[begin] / critical / np.sqrt(1.01))
