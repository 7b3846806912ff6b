"""Inputs and results are equal where their fields are, arrays number by number, and then hash alike."""

from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.bearings import BallSupport, ContactLaw, FrequencyDependentReaction

BEARING = rf.JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)


def law(error=0.0):
    A, B, C = np.array([[-2.0]]), np.array([[1.0]]), np.array([[0.2]])
    return ContactLaw(
        offset=0.3, span=2.1, exponent=1.55, operating=-1.8, A=A, B=B, C=C, D=C @ np.linalg.solve(A, B),
        static_error=error, damping_error=0.0, film_scale=1e-6, time_scale=1e-4, force_scale=50.0,
    )  # fmt: skip


def table(cross=0.0):
    matrix = np.array([[[1e6, cross], [0.0, 1e6]]] * 2)
    return rf.TabulatedBearing(speeds=[100.0, 200.0], stiffness=matrix, damping=1e-3 * matrix)


MADE = {
    "table": (table, 1.0),
    "contact law": (law, 1.0),
    "balls": (lambda at=0.0: BallSupport(law=law(at), angles=(0.0, 2.0, 4.0)), 1.0),
    "equilibrium": (lambda load=-900.0: rf.equilibrium(BEARING, [0.0, load], 300.0), -901.0),
    "coefficients": (lambda y=-3e-5: rf.coefficients(BEARING, [0.0, y], 300.0), -3.1e-5),
}


@pytest.mark.parametrize("name", MADE)
def test_what_is_made_alike_is_equal_and_hashes_alike(name):
    make, other = MADE[name]
    one, again, different = make(), make(), make(other)
    assert (one == again) is True
    assert (one != again) is False
    assert (one == different) is False
    assert (one == 3) is False
    assert hash(one) == hash(again)
    assert {one: "found"}[again] == "found"


def test_a_shape_is_compared_and_a_sign_of_zero_is_not():
    one, other = table(0.0), table(-0.0)
    assert one == other
    assert hash(one) == hash(other)
    assert replace(one, speeds=[100.0, 201.0]) != one
    at = rf.equilibrium(BEARING, [0.0, -900.0], 300.0)
    assert at == replace(at)
    assert at != replace(at, position=at.position[:1])


def test_a_list_is_the_array_of_its_numbers():
    one, system = [[-300.0]], {"C": [[[1.0], [0.0]]], "D": [np.eye(2)], "speeds": [100.0]}
    made = [
        FrequencyDependentReaction(A=[one], B=[[[1.0, 0.0]]], **system, band=kind([1.0, 500.0]))
        for kind in (list, tuple, np.array)
    ]
    assert made[0] == made[1] == made[2]
    assert len(set(made)) == 1


def test_numbers_that_are_not_known_are_equal_and_hash_alike():
    unknown = [table(), table()]
    for one in unknown:
        one.stiffness.setflags(write=True)
        one.stiffness[0, 0, 1] = np.nan
    assert unknown[0] == unknown[1]
    assert hash(unknown[0]) == hash(unknown[0]) == hash(unknown[1])
    assert {unknown[0]} == set(unknown)
