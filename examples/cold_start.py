"""Cold start and run-up of a bearing that warms: its temperature over time, in Python and as an FMU.

The bearing has one thermal state, the temperature of film and bush. It follows the balance of the heat within
half a minute, and the journal follows it at once. `simulate` integrates rotor and bearing as one system; the
FMU, which needs no Python, is given the motion of the journal, as by another simulator.
"""

import tempfile
from pathlib import Path

import fmpy
import numpy as np

from rotorfilm import (
    Cooling,
    HeatedBearing,
    JournalBearing,
    Oil,
    RigidRotor,
    SpeedProfile,
    equilibrium,
    export_fmu,
    simulate,
)

RPM, CELSIUS, DURATION, LOAD = np.pi / 30.0, 273.15, 90.0, [0.0, -525.0]
fresh, around = 37.1 + CELSIUS, 20.0 + CELSIUS
cooling = Cooling(supply_temperature=fresh, ambient_temperature=around, housing_conductance=0.8)
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, oil=Oil.iso_vg(100), cooling=cooling)
slow, fast = (equilibrium(bearing, LOAD, speed * RPM) for speed in (600.0, 1500.0))
steady = SpeedProfile(times=(0.0,), speeds=(fast.speed,))
rising = SpeedProfile(times=(0.0, 20.0), speeds=(slow.speed, fast.speed))
STARTS = {
    "cold start at 1500 rpm": (15.0 + CELSIUS, steady),
    "run-up from 600 rpm": (slow.temperature, rising),
}


def in_fmpy(film, motion):
    """Return the temperature of the film in its FMU, which is given the motion of the journal."""
    names = ("x", "y", "vx", "vy", "speed")
    series = [motion.time, *(motion[name] for name in names)]
    given = np.rec.fromarrays(series, names=["time", *(f"film.{name}" for name in names)])
    with tempfile.TemporaryDirectory() as folder:
        path = export_fmu(film, Path(folder, "film.fmu"), component="film", start={"speed": fast.speed})
        run = fmpy.simulate_fmu(
            str(path), stop_time=DURATION, step_size=0.05, output_interval=0.05, input=given,
            output=["film.film_temperature"],
        )  # fmt: skip
    return np.interp(motion.time, run["time"], run["film.film_temperature"])


off = []
for title, (start, profile) in STARTS.items():
    film = HeatedBearing(bearing=bearing, start_temperature=start)
    rest = equilibrium(bearing.at_temperature(start), LOAD, profile.speeds[0])
    rotor = RigidRotor(mass=525.0 / 9.80665, speed=profile, position=tuple(rest.position))
    motion = simulate(rotor, film, duration=DURATION, samples=1801, rtol=1e-6)
    warm, power = motion["film_temperature"], motion["power_loss"]
    half = motion.time[np.argmax(warm > 0.5 * (warm[0] + warm[-1]))]
    print(
        f"{title}: {warm[0] - CELSIUS:.1f} to {warm[-1] - CELSIUS:.1f} degC, half of it after {half:.1f} s,"
    )
    print(f"    power {power[0]:.0f} W, at most {power.max():.0f} W, at the end {power[-1]:.0f} W")
    off.append(np.abs(in_fmpy(film, motion) - warm).max())
print(f"balance at 1500 rpm: {fast.temperature - CELSIUS:.2f} degC, {fast.losses.power_loss:.0f} W")
print("largest difference of the temperatures, FMU and Python [K]:", max(off))
