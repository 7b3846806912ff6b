"""Model Exchange: rotor and film FMUs integrated as one system are the monolithic solution."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import JournalBearing
from rotorfilm.analysis import simulate
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import export_fmu, extracted, instantiated
from rotorfilm.rotors import RigidRotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(mass=53.5, speed=157.0, unbalance=2e-3, position=(2e-5, -4e-5))
TURN = 2.0 * np.pi / 157.0


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_coupled_model_exchange_is_the_monolithic_solution(version, tmp_path):
    paths = [
        export_fmu(model, tmp_path / f"{name}.fmu", version, component=name)
        for name, model in {"rotor": ROTOR, "film": BEARING}.items()
    ]
    with extracted(paths[0]) as rotor_files, extracted(paths[1]) as film_files:
        rotor, film = (instantiated(*files, exchange=True) for files in (rotor_files, film_files))
        references = {
            v.name: v.valueReference for files in (rotor_files, film_files) for v in files[0].modelVariables
        }
        motion = ("x", "y", "vx", "vy", "speed")
        forces = ("force_x", "force_y")

        def slope(t, x):
            rotor.move(t, x)
            moved = rotor.get([references[f"rotor.{name}"] for name in motion])
            film.set([references[f"film.{name}"] for name in motion], moved)
            pressed = film.get([references[f"film.{name}"] for name in forces])
            rotor.set([references[f"rotor.{name}"] for name in forces], pressed)
            return rotor.derivatives(4)

        try:
            rotor.initialize([], [])
            film.initialize([], [])
            scale = np.array([signal.nominal for signal in ROTOR.states])
            end = solve_ivp(slope, (0.0, TURN), rotor.states(4), "DOP853", rtol=1e-10, atol=1e-10 * scale).y[
                :, -1
            ]
        finally:
            rotor.close()
            film.close()
    exact = simulate(ROTOR, BEARING, duration=TURN, times=np.array([0.0, TURN]), rtol=1e-10)
    assert_allclose(end[:2] / BEARING.clearance, exact.position[:, -1] / BEARING.clearance, atol=1e-8)
