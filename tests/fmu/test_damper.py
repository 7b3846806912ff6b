"""A porous damper as an FMU in Python: coupled with the rotor's FMU it moves as the monolithic pair does."""

import numpy as np
import pytest

from rotorfilm import PorousCage, PorousDamper, RigidRotor, cosimulate, export_fmu, simulate, with_springs
from rotorfilm.fmu.python.codec import class_modules, decode, encode

CAGE = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
DAMPER = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=1.2e-3, cage=CAGE)
SUPPORT = with_springs(DAMPER, 2.56e5)
ROTOR = RigidRotor(
    mass=10.0, speed=400.0, unbalance=4e-4, gravity=(0.0, 0.0), position=(3e-5, 0.0), velocity=(0.0, 0.012)
)


def test_damper_comes_back_from_its_data():
    again = decode(encode(SUPPORT), {name: name for name in class_modules(SUPPORT)})
    q, v = [3e-5, 1e-5], [0.01, 0.02]
    assert again.reactions[0].cage == CAGE
    np.testing.assert_array_equal(again.force(q, v), SUPPORT.force(q, v))


def test_coupled_fmus_follow_the_monolithic_solution(tmp_path):
    film = export_fmu(SUPPORT, tmp_path / "damper.fmu", backend="python", component="film")
    rotor = export_fmu(ROTOR, tmp_path / "rotor.fmu", component="rotor")
    duration = 0.005
    reference = simulate(ROTOR, SUPPORT, duration=duration, samples=6)
    errors = []
    for step in (1e-4, 5e-5):
        coupled = cosimulate(str(rotor), str(film), macro_step=step, duration=duration)
        every = round(1e-3 / step)
        errors.append(
            np.abs(coupled.trajectory.position[:, ::every] - reference.position).max() / DAMPER.clearance
        )
    assert errors[1] < 0.02
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.35)
