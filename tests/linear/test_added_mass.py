"""Flexible rotors whose films add a mass: every linear analysis beside own dense matrices."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import eig
from scipy.optimize import brentq

import rotorfilm as rf
from rotorfilm.analysis.rotor_matrices import FullRotorModel, second_order

SPEED = 300.0
SEAL = rf.AnnularSeal(
    radius=0.1,
    length=0.03,
    clearance=3e-4,
    pressure_drop=6e5,
    viscosity=1e-3,
    density=1000.0,
    inlet_swirl=0.4,
)
SPRING = rf.LinearBearing(stiffness=5e7, damping=2e4)
DAMPER = rf.with_springs(
    reaction=rf.SqueezeFilmDamper(
        radius=0.08, length=0.03, clearance=1.5e-4, viscosity=5e-3, density=900.0, extent=rf.FullFilm()
    ),
    stiffness=2e7,
)
STEEL = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7850.0)


LIGHT = replace(DAMPER.reactions[0], density=0.0)


def pump(pieces=4, **changes):
    middle = pieces // 2
    given = {
        "elements": rf.ShaftElement(length=1.0, outer_diameter=0.07, material=STEEL).split(pieces),
        "disks": (rf.Disk(node=middle, mass=40.0, diametral_inertia=0.3, polar_inertia=0.5),),
        "stations": (
            rf.Station(node=0, name="left"),
            rf.Station(node=middle, name="seal"),
            rf.Station(node=pieces, name="right"),
        ),
        "unbalances": (rf.Unbalance(node=middle, unbalance=1e-3),),
        "gravity": (0.0, 0.0),
        "speed": SPEED,
    }
    return rf.ShaftRotor(**(given | changes))


def held(film=SEAL):
    return {"left": SPRING, "seal": film, "right": SPRING}


def dense(rotor, bearings, speed):
    """Return M, C, K of all, assembled here from the shaft's matrices and K, C, M of each bearing."""
    s = rotor.structure
    mass, damping = np.array(s.mass), s.damping + speed * s.gyroscopic
    stiffness = s.stiffness + speed * s.circulation
    half = len(mass) // 2
    for station in rotor.stations:
        found = rf.coefficients(bearings[station.name], [0.0, 0.0], speed)
        own = np.ix_(*[[2 * station.node, 2 * station.node + half]] * 2)
        damping[own] += found.damping
        stiffness[own] += found.stiffness
        if isinstance(found, rf.bearings.InertialCoefficients):
            mass[own] += found.mass
    return mass, damping, stiffness


def whirls(rotor, bearings, speed):
    """Return the eigenvalues of the pencil that swing, by rising frequency."""
    M, C, K = dense(rotor, bearings, speed)
    n = len(M)
    zero, one = np.zeros((n, n)), np.eye(n)
    values = eig(np.block([[zero, one], [-K, -C]]), np.block([[one, zero], [zero, M]]), right=False)
    values = values[values.imag > 1e-6 * np.abs(values)]
    return values[np.argsort(values.imag)]


@pytest.mark.closed_form
@pytest.mark.parametrize("film", [SEAL, DAMPER], ids=["seal", "damper"])
def test_modes_of_the_dense_pencil(film):
    rotor, bearings = pump(), held(film)
    found = rf.rotor_modes(rotor, bearings, SPEED)
    expected = whirls(rotor, bearings, SPEED)
    assert_allclose(found.eigenvalues, expected, rtol=1e-6)
    light = replace(film, added_mass=False) if film is SEAL else rf.Parallel((LIGHT, film.reactions[1]))
    without = rf.rotor_modes(rotor, held(light), SPEED).eigenvalues
    assert abs(without[0] - expected[0]) > 1e-3 * abs(expected[0])


@pytest.mark.closed_form
def test_jeffcott_with_a_seal_at_its_disk():
    """The determinant of two masses in u = x + i y, a polynomial: no matrices of the package."""
    own = {"mass": 20.0, "journal_mass": 3.0, "stiffness": 4e6}
    rotor = rf.JeffcottRotor(**own, speed=SPEED, gravity=(0.0, 0.0), disk_station="disk", unbalance=1e-3)
    bearings = {"": SPRING, "disk": SEAL}
    K, k, C, c, M = SEAL.matrices(SPEED)
    assert M > 1.0
    disk = np.array([20.0 + M, C - 1j * c, K - 1j * k + 4e6])
    journal = np.array([3.0, 2e4, 5e7 + 4e6])
    roots = np.roots(np.polysub(np.polymul(disk, journal), [4e6**2]))
    forward = np.where(roots.imag > 0.0, roots, roots.conj())  # the other half whirls backward
    found = rf.rotor_modes(rotor, bearings, SPEED)
    assert_allclose(found.eigenvalues, forward[np.argsort(forward.imag)], rtol=1e-10)
    s = 1j * SPEED
    pull = 1e-3 * SPEED**2
    moved = pull * np.polyval(journal, s) / (np.polyval(disk, s) * np.polyval(journal, s) - 4e6**2)
    response = rf.unbalance_response(rotor, bearings, [SPEED])
    x, y, force = (
        response.frdata[response.output_labels.index(name), 0, 0]
        for name in ("disk_x", "disk_y", "disk_housing_force_x")
    )
    assert_allclose([x, y], [moved, -1j * moved], rtol=1e-10)
    assert_allclose(force, (K - 1j * k + s * (C - 1j * c) + s**2 * M) * moved, rtol=1e-10)


@pytest.mark.closed_form
def test_few_shapes_of_a_long_chain_take_the_mass():
    rotor, bearings = pump(32), held()
    found = rf.rotor_modes(rotor, bearings, SPEED, 3e3)
    expected = whirls(rotor, bearings, SPEED)
    count = len(found.eigenvalues)
    assert len(found.shapes) > 160
    assert 0.0 < found.error < 1e-6
    assert_allclose(found.eigenvalues, expected[:count], rtol=1e-6)
    M, C, K = dense(rotor, bearings, SPEED)
    s = 1j * SPEED
    load = SPEED**2 * rotor.structure.unbalance @ np.array([1.0, -1.0j])
    moved = np.linalg.solve(s**2 * M + s * C + K, load)
    response = rf.unbalance_response(rotor, bearings, [SPEED])
    at = rf.coefficients(SEAL, [0.0, 0.0], SPEED)
    journal = moved[[32, 32 + len(M) // 2]]
    force = (at.stiffness + s * at.damping + s**2 * at.mass) @ journal
    assert_allclose(told(response, "seal_x", "seal_y"), journal, rtol=2e-6)
    assert_allclose(told(response, "seal_housing_force_x", "seal_housing_force_y"), force, rtol=2e-6)


def told(response, *labels):
    return [response.frdata[response.output_labels.index(label), 0, 0] for label in labels]


@pytest.mark.closed_form
def test_state_space_and_transmissibility_are_the_dense_solution():
    rotor, bearings = pump(), held()
    at = rf.rotor_equilibrium(rotor, bearings, SPEED)
    system = rf.rotor_system(rotor, at)
    values = system.poles()
    swings = np.sort(values[values.imag > 1e-6 * np.abs(values)].imag)
    assert_allclose(swings, whirls(rotor, bearings, SPEED).imag, rtol=1e-8)
    M, C, K = dense(rotor, bearings, SPEED)
    push, found = rotor.structure.journals.T, rf.coefficients(SEAL, [0.0, 0.0], SPEED)
    s = 1j * SPEED
    moved = np.linalg.solve(s**2 * M + s * C + K, push)
    force = (found.stiffness + s * found.damping + s**2 * found.mass) @ push[:, 2:4].T @ moved
    rows = [system.output_labels.index(f"seal_housing_force_{axis}") for axis in "xy"]
    assert_allclose(system(s, squeeze=False)[rows], force, rtol=1e-9)
    carried = rf.rotor_transmissibility(rotor, bearings, [SPEED])
    rows = [carried.output_labels.index(f"seal_housing_force_{axis}") for axis in "xy"]
    assert_allclose(carried.frdata[rows, :, 0], force, rtol=1e-9)


@pytest.mark.closed_form
def test_ground_that_shakes_moves_no_mass_of_the_fluid():
    """The fluid feels the shaft's way from the ground; the ground pushes the shaft's own mass only."""
    rotor, bearings, frequency = pump(), held(), 250.0
    at = rf.rotor_equilibrium(rotor, bearings, SPEED)
    M, C, K = dense(rotor, bearings, SPEED)
    n = len(M)
    along = np.zeros((n, 2))
    along[: n // 2 : 2, 0] = along[n // 2 :: 2, 1] = 1.0
    along[2 * 5 : n // 2, 0] = along[n // 2 + 2 * 5 :, 1] = 0.0  # inner shapes of elements
    s = 1j * frequency
    moved = np.linalg.solve(s**2 * M + s * C + K, -rotor.structure.mass @ along)
    response, system = rf.base_response(rotor, at, [frequency]), rf.base_system(rotor, at)
    rows = [response.output_labels.index(f"seal_{axis}") for axis in "xy"]
    expected = moved[[4, 4 + n // 2]]
    assert_allclose(response.frdata[rows, :, 0], expected, rtol=1e-8, atol=1e-12 * abs(expected).max())
    assert_allclose(system(s, squeeze=False), response.frdata[:, :, 0], rtol=1e-7, atol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("pieces", [4, 32])
def test_critical_speeds_where_the_mass_changes_with_the_speed(pieces):
    """The slip of the dense eigenvalues past the speed, by brentq."""
    rotor, bearings = pump(pieces), held()
    found = rf.critical_speeds(rotor, bearings, np.linspace(50.0, 900.0, 10))

    def lead(speed, k):
        return whirls(pump(), bearings, speed)[k].imag - speed

    wanted = [brentq(lead, 300.0, 700.0, args=(k,), xtol=1e-9) for k in (0, 1)]
    assert len(found) == 2
    tolerance = 1e-8 if pieces == 4 else 1e-4  # elements, an eighth as long
    assert_allclose([one.speed for one in found], wanted, rtol=tolerance)


@pytest.mark.closed_form
def test_threshold_on_a_seal_that_swirls():
    """Fluid that comes in turning drives the shaft: the dense pencil has no growth at the threshold."""
    rotor = pump()
    bearings = held(replace(SEAL, inlet_swirl=1.2)) | dict.fromkeys(
        ("left", "right"), rf.LinearBearing(stiffness=5e7, damping=1e3)
    )
    found = rf.rotor_threshold(rotor, bearings, np.linspace(100.0, 3000.0, 15))
    values = whirls(rotor, bearings, found.speed)
    worst = values[np.argmax(values.real / np.abs(values))]
    assert abs(worst.real) < 1e-8 * abs(worst)
    assert_allclose(worst.imag, found.whirl_frequency, rtol=1e-6)


def test_motion_too_fast_for_the_fluid_is_told():
    with pytest.warns(rf.ValidityWarning, match="transit time of the seal"):
        rf.rotor_equilibrium(pump(), held(), 1e5)


@pytest.mark.closed_form
def test_what_errors_are_estimated_from_has_the_mass():
    """L(s) x, its adjoint and L'(s) x of the whole rotor beside dense ones; one motion, two masses."""
    rotor, bearings, s = pump(), held(), -30.0 + 470.0j
    at = rf.rotor_equilibrium(rotor, bearings, SPEED)
    whole, (M, C, K) = FullRotorModel(rotor.assembly, at, SPEED), dense(rotor, bearings, SPEED)
    x = np.random.default_rng(2).normal(size=(len(M), 2)) + 0.3j
    L = s**2 * M + s * C + K
    for found, wanted in (
        (whole.forces(s, x), L @ x),
        (whole.adjoint_forces(s, x), L.conj().T @ x),
        (whole.slope(s, x), (2.0 * s * M + C) @ x),
    ):
        assert_allclose(found, wanted, rtol=1e-12, atol=1e-9 * np.abs(wanted).max())
    system = second_order(rotor.structure, at)
    moved = system.weighing(2.0 * rotor.structure.mass)
    assert_allclose(moved.state_matrix(), system.state_matrix(), rtol=1e-7, atol=1e-3)
