"""Run-ups on mass-conserving films: each step has a matrix of its own, which is not inverted."""

import math
import sys

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.analysis.stepped_run import refined


def machine():
    steel = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    rotor = rf.ShaftRotor(
        elements=rf.ShaftElement(length=0.8, outer_diameter=0.05, material=steel).split(4),
        disks=(rf.Disk.solid(2, outer_diameter=0.28, inner_diameter=0.05, density=7810.0, width=0.07),),
        stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
        speed=rf.SpeedProfile(times=(0.0, 1.0), speeds=(100.0, 300.0)),
    )
    groove = rf.Groove(center=math.pi / 2.0, width=0.3)
    size = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.05}
    film = rf.JFOFilm(bearing=rf.JournalBearing(**size, grooves=(groove,)), cells=(36, 4))
    return rotor, {"left": film, "right": film}


def test_a_run_up_inverts_a_matrix_for_each_kind_of_step(monkeypatch):
    run = rf.simulate(*machine(), duration=0.01)
    assert run.work["steps"] > 20
    assert run.work["inverses"] == 2
    monkeypatch.setattr(sys.modules[refined.__module__], "refined", lambda *given: None)
    inverted = rf.simulate(*machine(), duration=0.01)
    assert inverted.work["inverses"] > 20
    np.testing.assert_allclose(run["left_y"], inverted["left_y"], rtol=0.0, atol=1e-9 * 1e-4)


@pytest.mark.closed_form
def test_a_solution_is_refined_from_a_matrix_nearby_or_refused():
    rng = np.random.default_rng(1)
    matrix, right, scale = np.eye(8) + 0.1 * rng.normal(size=(8, 8)), rng.normal(size=(8, 2)), np.ones(8)
    near = np.linalg.inv(matrix + 1e-3 * rng.normal(size=(8, 8)))
    found = refined(matrix, near, right, scale)
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=0.0, atol=1e-12)
    assert refined(matrix, -near, right, scale) is None
