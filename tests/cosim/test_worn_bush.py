"""A rotor FMU on the FMU of a bush that wears: the film has states of its own."""

import numpy as np
import pytest

from rotorfilm.analysis import simulate
from rotorfilm.bearings.bush import BushReaction, f4k20_bush
from rotorfilm.cosim import cosimulate
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import RigidRotor

LOAD = 3750.0


@pytest.mark.convergence
def test_coupled_fmus_converge_to_the_monolithic_solution_while_the_bush_wears(tmp_path):
    bush = BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=24, extent=1.4, retardation=2e-4)
    x, y = bush.position([0.0, -LOAD], 1.0)
    rotor = RigidRotor(
        mass=50.0, speed=12.0, gravity=(0.0, 0.0), static_force=(0.0, -LOAD), position=(float(x), float(y))
    )
    export_fmu(rotor, tmp_path / "rotor.fmu", component="rotor", start={"force_y": LOAD})
    export_fmu(bush, tmp_path / "bush.fmu", component="bush", start={"x": x, "y": y, "speed": 12.0})
    exact = simulate(rotor, bush, duration=0.005, samples=6)
    assert exact["wear_12"][-1] > 1e-6
    errors = []
    for step in (1e-4, 5e-5, 2.5e-5):
        run = cosimulate(tmp_path / "rotor.fmu", tmp_path / "bush.fmu", macro_step=step, duration=0.005)
        every = round(1e-3 / step)
        errors.append(np.abs(run.trajectory["y"][::every] - exact["y"]).max())
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 1.0, atol=0.1)
