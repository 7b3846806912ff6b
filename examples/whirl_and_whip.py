"""Run-up of a slender shaft on two full films: whirl at half the speed, then whip at the shaft's frequency.

The rotor of whirl_and_whip.toml; rotor and films are one nonlinear model, integrated by `simulate_rotor`.
"""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from rotorfilm import Scene, SpeedProfile, mount, rotor_equilibrium, simulate_rotor
from rotorfilm.analysis import run_orbits, run_spectra
from rotorfilm.charts import plot_run_orbits, plot_spectrogram, plot_waterfall
from rotorfilm.scenes.solve_shaft import solve_rotor

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
shaft = scene.shaft.build()
first, last, rise, duration = 1000.0 * RPM, 6000.0 * RPM, 0.8, 1.5
rest = rotor_equilibrium(shaft, films, first).displacement
run_up = SpeedProfile(times=(0.0, rise), speeds=(first, last))
model = mount(replace(shaft, speed=run_up, initial=(*rest, *0.0 * rest)), films)
run = simulate_rotor(model, duration=duration, samples=3001, rtol=1e-6)
time, disk = run.time, run["disk_x"] + 1j * run["disk_y"]


def whirl_frequency(begin: float, end: float) -> float:
    """Return the forward frequency that is strongest between two times [rad/s]."""
    part = disk[(time >= begin) & (time < end)]
    spectrum = np.abs(np.fft.fft((part - part.mean()) * np.hanning(len(part)), 16 * len(part)))
    frequencies = 2.0 * np.pi * np.fft.fftfreq(16 * len(part), time[1])
    slow = (frequencies > 0.0) & (frequencies < 0.8 * run_up.speed(begin))
    return float(frequencies[slow][np.argmax(spectrum[slow])])


plot_spectrogram(run_spectra(run, "disk", run_up, windows=60)).save("whirl_and_whip.png")
plot_waterfall(run_spectra(run, "disk", run_up, windows=30)).save("waterfall.png")
plot_run_orbits(run_orbits(run, np.linspace(1500.0, 5500.0, 6) * RPM, "left", run_up)).save(
    "orbits_run_up.png"
)

whip = whirl_frequency(1.0, duration)
swing = 0.5 * np.ptp(disk.real[time > 1.4]) * 1e6
print(f"at {last / RPM:.0f} rpm the disk moves by +-{swing:.0f} um at {whip / last:.3f} of the speed")
print("frequency of the whip / first critical speed:", whip / critical)
