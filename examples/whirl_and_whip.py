"""Run-up of a slender shaft on two full films: whirl at half the speed, then whip at the shaft's frequency.

The rotor of whirl_and_whip.toml, reduced; rotor and films are one nonlinear model, integrated by scipy.
"""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from rotorfilm import Scene, SpeedProfile, mount, reduce_rotor, rotor_equilibrium
from rotorfilm.charts import new_figure, save
from rotorfilm.scenes.shaft.solve_shaft import solve_rotor

RPM = math.pi / 30.0
scene = Scene.load(Path(__file__).with_name("whirl_and_whip.toml"))
linear = solve_rotor(scene)
critical = next(one.speed for one in linear.critical_speeds if one.direction > 0.0)
onset = linear.threshold
print(
    f"linear: first critical speed {critical / RPM:.0f} rpm; from {onset.speed / RPM:.0f} rpm on it whirls",
    end="",
)
print(f" at {onset.whirl_ratio:.3f} of the speed")

films = scene.shaft.build_bearings()
reduction = reduce_rotor(scene.shaft.build(), frequency=400.0, tolerance=1e-2)
small = reduction.rotor
print(f"reduced from {linear.states} states to {len(small.states)}, error {reduction.error:.1e} to 400 rad/s")

first, last, rise, duration = 1000.0 * RPM, 6000.0 * RPM, 0.8, 1.5
rest = rotor_equilibrium(small, films, first).displacement
run_up = SpeedProfile(times=(0.0, rise), speeds=(first, last))
model = mount(replace(small, speed=run_up, initial=(*rest, *0.0 * rest)), films)
nominal = np.array([signal.nominal for signal in model.states])
time = np.linspace(0.0, duration, 3001)
run = solve_ivp(
    lambda t, x: model.derivative(t, x, []),
    (0.0, duration),
    model.initial_state,
    method="Radau",
    jac=lambda t, x: model.linearization(t, x, []).A,
    t_eval=time,
    rtol=1e-4,
    atol=1e-4 * nominal,
)
names = [signal.name for signal in model.outputs]
outputs = np.array([model.output(t, x, []) for t, x in zip(run.t, run.y.T, strict=True)]).T
disk = outputs[names.index("disk_x")] + 1j * outputs[names.index("disk_y")]


def whirl_frequency(begin: float, end: float) -> float:
    """Return the forward frequency that is strongest between two times [rad/s]."""
    part = disk[(time >= begin) & (time < end)]
    spectrum = np.abs(np.fft.fft((part - part.mean()) * np.hanning(len(part)), 16 * len(part)))
    frequencies = 2.0 * np.pi * np.fft.fftfreq(16 * len(part), time[1])
    slow = (frequencies > 0.0) & (frequencies < 0.8 * run_up.speed(begin))
    return float(frequencies[slow][np.argmax(spectrum[slow])])


axes = new_figure(size=(6.4, 4.0)).subplots()
axes.plot(time, disk.real * 1e6, linewidth=0.6, label="disk, x")
axes.plot(time, outputs[names.index("left_x")] * 1e6, linewidth=0.6, label="left journal, x")
axes.set(xlabel=f"time [s]; 1000 to 6000 rpm in {rise} s", ylabel="displacement [um]", title="Whirl and whip")
axes.legend()
save(axes, Path("whirl_and_whip.png"))

whip = whirl_frequency(1.0, duration)
swing = 0.5 * np.ptp(disk.real[time > 1.4]) * 1e6
print(f"at {last / RPM:.0f} rpm the disk moves by +-{swing:.0f} um at {whip / last:.3f} of the speed")
print("frequency of the whip / first critical speed:", whip / critical)
