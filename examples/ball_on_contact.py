"""A ball on a lubricated plane as coupled FMUs: the full film in Python beside its reduced law in C.

The ball rolls at 0.9 m/s under 10 N, which swing by a third. Both couplings are compared with the full film
and the ball solved as one system.
"""

from pathlib import Path
from time import perf_counter

import control
import numpy as np

from rotorfilm import ContactGrid, RollingBall, export_fmu, reduce_ball
from rotorfilm.bearings import FixedSteps, SineLoad, moving_contact
from rotorfilm.cosim import open_fmu

ball = RollingBall(
    radius=0.01, mass=0.1, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
    pressure_coefficient=5e-9, speed=0.9, load=10.0,
)  # fmt: skip
contact = ball.contact(ContactGrid(cells=(24, 24)))
rest = contact.stationary()
swing = SineLoad(amplitude=0.3, frequency=2.0)  # in units of load and time_scale
step, steps = 0.05 * ball.time_scale, 120
whole = contact.simulate(
    rest, duration=0.05 * steps, W=ball.W, load=swing, control=FixedSteps(step=0.025)
)  # one system

law, full = reduce_ball(ball, contact), moving_contact(ball, contact)
z0 = rest.delta * ball.film_scale
mass = control.ss(
    [[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0 / ball.mass]], [[1.0, 0.0]], [[0.0]],
    inputs=["push"], outputs=["z"], states=["z", "vz"],
)  # fmt: skip
files = {
    "ball": export_fmu(mass, Path("ball.fmu"), component="ball"),
    "full film": export_fmu(full, Path("film.fmu"), component="film", start={"z": z0}),
    "reduced law": export_fmu(law, Path("law.fmu"), component="law", start={"z": z0}),
}


def couple(film_file):
    """Return the approach [m] after each step: the ball first, under the force extrapolated to mid-step."""
    with open_fmu(files["ball"]) as body, open_fmu(film_file) as film:
        film.start({"z": z0})
        force = before = film.get()["force_z"]
        approach = [z0]
        for k in range(steps):
            middle = (k + 0.5) * step / ball.time_scale
            push = 1.5 * force - 0.5 * before - ball.load * swing(middle)
            body.start({"push": push}) if k == 0 else body.set({"push": push})
            body.step(k * step, step)
            approach.append(z0 + body.get()["z"])
            film.set({"z": approach[-1]})
            film.step(k * step, step)
            before, force = force, film.get()["force_z"]
        return np.array(approach)


expected = np.interp(0.05 * np.arange(steps + 1), whole.time, whole.delta) * ball.film_scale
motion = expected - z0
for name in ("full film", "reduced law"):
    begin = perf_counter()
    error = couple(files[name]) - expected
    rms = np.sqrt(np.mean(error**2) / np.mean(motion**2))
    print(f"{name}: rms error of the approach {rms:.2%}, {perf_counter() - begin:.2f} s")
print("error of the reduced law / motion:", rms)
