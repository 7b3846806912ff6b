"""Motion that nothing damps, whose growth rate is roundoff and no threshold; hysteresis of each whirl."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    Disk,
    ElasticMaterial,
    FrequencyDependentReaction,
    LinearBearing,
    ShaftElement,
    ShaftRotor,
    Station,
    coefficients,
    rotor_modes,
    rotor_threshold,
    whirl_threshold,
)
from rotorfilm.analysis import critical_mass

pytestmark = pytest.mark.closed_form

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)


def shaft(diameter: float, elements: int, **fields: object) -> ShaftRotor:
    """Return a shaft of 1 m with a disk in its middle and stations at both ends."""
    return ShaftRotor(
        elements=ShaftElement(length=1.0, outer_diameter=diameter, material=STEEL).split(elements),
        speed=100.0,
        stations=(Station(node=0, name="left"), Station(node=elements, name="right")),
        disks=(Disk(node=elements // 2, mass=20.0, polar_inertia=0.2, diametral_inertia=0.1),),
        **fields,
    )


def springs(
    stiffness: np.ndarray, slope: np.ndarray, speeds: tuple[float, ...]
) -> FrequencyDependentReaction:
    """Return springs without states whose stiffness is linear in the speed."""
    tables = [-(stiffness + speed * slope) for speed in speeds]
    none = (len(speeds), 0, 0), (len(speeds), 0, 2), (len(speeds), 2, 0)
    A, B, C = map(np.zeros, none)
    return FrequencyDependentReaction(A=A, B=B, C=C, D=tables, speeds=speeds)


def oscillators(seen: np.ndarray, damping: float = 0.0) -> FrequencyDependentReaction:
    """Return springs of 1.2e6 N/m with two oscillators of 400 rad/s that push the shaft."""
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-(400.0**2) * np.eye(2), -damping * np.eye(2)]])
    B = np.vstack([np.zeros((2, 2)), 100.0 * np.eye(2)])
    C = np.hstack([1e7 * seen, np.zeros((2, 2))])
    return FrequencyDependentReaction(A=A, B=B, C=C, D=-1.2e6 * np.eye(2), damping=damping * np.eye(2))


@pytest.mark.parametrize("turn", [0.1, 0.4, 0.7, 1.3])
def test_flutter_without_damping_begins_where_two_frequencies_meet(turn):
    """Cross coupling q = a speed couples springs k1, k2 into flutter beyond q = (k1 - k2) / 2, not before."""
    Q = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    symmetric, skew = Q @ np.diag([3e6, 2e6]) @ Q.T, np.array([[0.0, 1e3], [-1e3, 0.0]])
    bearing = springs(symmetric, skew, (10.0, 2000.0))
    found = whirl_threshold(bearing, (0.0, -500.0), 40.0, (10.0, 2000.0))
    assert found.speed == pytest.approx(500.0, rel=1e-9)
    none = whirl_threshold(
        springs(symmetric, 0.0 * skew, (10.0, 2000.0)), (0.0, -500.0), 40.0, (10.0, 2000.0)
    )
    assert "stable at every speed" in none.reason


@pytest.mark.parametrize(
    ("diameter", "elements", "whole"), [(0.05, 2, False), (0.05, 3, True), (0.02, 16, True)]
)
def test_a_free_shaft_has_no_threshold(diameter, elements, whole):
    """Rigid-body motion and precession of a shaft that nothing holds, along and about its axis too."""
    rotor = shaft(diameter, elements, axial=whole, torsional=whole, gravity=(0.0, 0.0))
    found = rotor_threshold(rotor, {}, [10.0, 500.0, 3000.0])
    assert found.reason == "stable at every speed given"
    assert not rotor_modes(rotor, {}, 500.0).grows.any()


@pytest.mark.parametrize("seen", [np.eye(2), np.ones((2, 2))])
def test_states_without_damping_do_not_grow(seen):
    """Of oscillators that push along one line only, a motion stays that no shaft feels: it is none of its."""
    rotor = shaft(0.05, 3, torsional=True)
    bearings = {"left": oscillators(seen), "right": LinearBearing(stiffness=(1e6, 2e6))}
    assert rotor_threshold(rotor, bearings, [50.0, 900.0]).reason == "stable at every speed given"
    assert not rotor_modes(rotor, bearings, 300.0).grows.any()


@pytest.mark.parametrize("frequency", [None, 300.0])
def test_states_without_damping_have_no_critical_mass(frequency):
    found = critical_mass(coefficients(oscillators(np.eye(2)), [0.0, 0.0], 300.0, frequency))
    assert "no damping" in found.reason


def test_each_mode_has_the_hysteresis_of_its_own_frequency():
    """Springs told as a reaction with K(s) give the modes of the same springs, slower and faster ones."""
    rotor, speed = shaft(0.05, 4, loss_factor=0.02), 400.0
    stiffness, damping = np.array([[1e6, 2e5], [1e5, 2e6]]), 300.0 * np.eye(2)
    linear = LinearBearing(stiffness=stiffness, damping=damping)
    told = replace(springs(stiffness, 0.0 * stiffness, (speed,)), damping=damping)
    wanted, found = (
        rotor_modes(rotor, {"left": one, "right": one}, speed).eigenvalues for one in (linear, told)
    )
    assert np.count_nonzero(wanted.imag < speed) == 2
    assert_allclose(found, wanted, rtol=1e-9)


def test_hysteresis_and_states_together():
    """The modes are eigenvalues of rotor and states with the hysteresis of slower, or of faster, whirl."""
    rotor, speed, film = shaft(0.05, 3, loss_factor=0.02), 400.0, oscillators(np.eye(2), 20.0)
    found = rotor_modes(rotor, {"left": film, "right": film}, speed)
    s = rotor.assembly
    given = (s.mass, s.stiffness, s.gyroscopic, s.hysteresis)
    mass, still, turning, bending = (one.toarray() for one in given)
    rows = np.asarray(s.journals)
    J = np.array([[0.0, 1.0], [-1.0, 0.0]])
    values = []
    for hysteresis, low, high in (
        (np.kron(J, bending), 0.0, speed),
        (1j * np.kron(np.eye(2), bending), speed, np.inf),
    ):
        n, A, B, C = (
            len(mass),
            np.kron(np.eye(2), film.A),
            np.kron(np.eye(2), film.B),
            np.kron(np.eye(2), film.C),
        )
        felt = rows.reshape(2, 2, n).reshape(4, n)
        K = still + hysteresis + felt.T @ (1.2e6 * felt)
        D = speed * turning + felt.T @ (20.0 * felt)
        top = np.hstack([np.zeros((n, n)), np.eye(n), np.zeros((n, len(A)))])
        middle = np.linalg.solve(mass, np.hstack([-K, -D, felt.T @ C]))
        whole = np.vstack([top, middle, np.hstack([B @ felt, np.zeros((len(A), n)), A])])
        own = np.linalg.eigvals(whole)
        values.append(own[(own.imag > 1.0) & (own.imag >= low) & (own.imag < high)])
    wanted = np.concatenate(values)
    wanted = wanted[np.argsort(wanted.imag)]
    assert_allclose(found.eigenvalues, wanted, rtol=1e-7)
