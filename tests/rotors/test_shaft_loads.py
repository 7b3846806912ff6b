"""Cones, axial force, torque and springs against tilt, against closed forms."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from rotorfilm import InputError, LinearBearing
from rotorfilm.analysis import critical_speed_map, rotor_modes
from rotorfilm.rotors import (
    ClassicalBeam,
    FourthOrderBeam,
    LayeredElement,
    ShaftElement,
    ShaftRotor,
    Station,
    TiltSpring,
)

LENGTH, DIAMETER = 1.2, 0.05


def piece(steel, **changes):
    return ShaftElement(**({"length": LENGTH, "outer_diameter": DIAMETER, "material": steel} | changes))


def supported(elements, speed=0.0, **changes):
    stations = (Station(node=0, name="left"), Station(node=len(elements), name="right"))
    return ShaftRotor(elements=elements, stations=stations, speed=speed, **changes)


def plane_stiffness(rotor):
    """Stiffness of one plane, shape (n, n), and the places of the ends' deflections."""
    n = len(rotor.structure.coordinates)
    return rotor.structure.stiffness[:n, :n], [0, 2 * len(rotor.elements)]


def pinned_frequencies(rotor, speed, count):
    bearing = LinearBearing(stiffness=1e14)
    found = rotor_modes(rotor, {"left": bearing, "right": bearing}, speed)
    signed = np.sign(found.direction) * found.frequency
    return np.sort(signed[np.argsort(found.frequency)][:count])


@pytest.mark.closed_form
@pytest.mark.parametrize("force", [3e5, -1e5])
@pytest.mark.parametrize("speed", [0.0, 500.0])
def test_whirl_of_a_shaft_under_axial_force(steel, timoshenko, force, speed):
    """((s + P) b^2 - m p^2) (EI b^2 + s - j p^2 + 2 j speed p) - (s b)^2 = 0 with b = n pi / L."""
    whole = piece(steel, axial_force=force, shear_coefficient=0.886)
    exact, b = timoshenko(whole), np.pi / LENGTH
    one = np.polynomial.Polynomial([(exact.shear + force) * b**2, 0.0, -exact.mass])
    two = np.polynomial.Polynomial(
        [exact.bending * b**2 + exact.shear, 2.0 * exact.inertia * speed, -exact.inertia]
    )
    roots = np.sort((one * two - (exact.shear * b) ** 2).roots().real)
    lowest = np.sort(roots[np.argsort(np.abs(roots))[:2]])
    found = pinned_frequencies(supported(whole.split(12)), speed, 2)
    if speed == 0.0:  # a direction that nothing decides
        assert_allclose(np.abs(found), np.abs(lowest), rtol=1e-5)
    else:
        assert_allclose(found, lowest, rtol=1e-5)


@pytest.mark.closed_form
@pytest.mark.convergence
@pytest.mark.parametrize("beam", [ClassicalBeam(), FourthOrderBeam()])
def test_buckling_of_a_shaft_that_shears(steel, timoshenko, beam):
    """Compression at which the stiffness has no inverse: E / (1 + E / s), E = EI (pi / L)^2, s = kappa G A.

    Engesser's formula, for a force along the normal of the section's displacement w'.
    """
    exact = timoshenko(piece(steel, shear_coefficient=0.886))
    euler = exact.bending * (np.pi / LENGTH) ** 2
    wanted = euler / (1.0 + euler / exact.shear)
    errors = []
    for pieces in (8, 16, 32) if beam.order == 2 else (4, 8, 16):
        loads = []
        for force in (0.0, -1.0):
            rotor = supported(
                piece(steel, axial_force=force, shear_coefficient=0.886).split(pieces), beam=beam
            )
            matrix, ends = plane_stiffness(rotor)
            keep = np.setdiff1d(np.arange(len(matrix)), ends)
            loads.append(matrix[np.ix_(keep, keep)])
        factors = np.linalg.eigvals(np.linalg.solve(loads[0], loads[0] - loads[1])).real
        errors.append(1.0 / factors.max() / wanted - 1.0)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders[-1] == pytest.approx(beam.order, abs=0.3)
    assert abs(errors[-1]) < 1e-3


@pytest.mark.closed_form
@pytest.mark.parametrize("beam", [ClassicalBeam(), FourthOrderBeam()])
def test_a_slender_shaft_buckles_under_greenhills_torque(steel, timoshenko, beam):
    """Simply supported, a torque that follows the shaft: 2 pi E I / L (Greenhill 1883)."""
    thin = piece(steel, outer_diameter=0.01, shear_coefficient=0.886)
    wanted = 2.0 * np.pi * timoshenko(thin).bending / LENGTH
    matrices = []
    for torque in (0.0, 1.0):
        rotor = supported(piece(steel, outer_diameter=0.01, torque=torque).split(16), beam=beam)
        n = len(rotor.structure.coordinates)
        keep = np.setdiff1d(np.arange(2 * n), [0, 32, n, n + 32])
        matrices.append(rotor.structure.stiffness[np.ix_(keep, keep)])
    values = np.linalg.eigvals(np.linalg.solve(matrices[0], matrices[0] - matrices[1]))
    real = values[np.abs(values.imag) < 1e-6 * np.abs(values)].real
    assert 1.0 / real.max() == pytest.approx(wanted, rel=1e-3)


def test_torque_turns_with_the_shaft_of_either_hand(steel):
    """Mirrored in the x-z plane, torque and rotation change sign; the frequencies do not."""
    one = pinned_frequencies(supported(piece(steel, torque=2e4).split(6)), 300.0, 4)
    other = pinned_frequencies(supported(piece(steel, torque=-2e4).split(6)), -300.0, 4)
    none = pinned_frequencies(supported(piece(steel).split(6)), 300.0, 4)
    assert_allclose(np.sort(np.abs(one)), np.sort(np.abs(other)), rtol=1e-9)
    assert np.abs(np.abs(one) / np.abs(none) - 1.0).max() > 1e-4


@pytest.mark.closed_form
@pytest.mark.parametrize(("torque", "within"), [(0.0, 1e-8), (2e4, 5e-5)])
def test_undamped_critical_speeds_know_axial_force_and_torque(steel, torque, within):
    """The map against the modes of the same rotor; of the torque it leaves out what takes no energy back."""
    rotor = supported(piece(steel, torque=torque, axial_force=5e4).split(6))
    critical = critical_speed_map(rotor, [3e6], count=2)[:, 0]
    bearings = dict.fromkeys(("left", "right"), LinearBearing(stiffness=3e6))
    for speed in critical:
        modes = rotor_modes(rotor, bearings, float(speed))
        assert np.abs(modes.frequency / speed - 1.0).min() < within


@pytest.mark.closed_form
def test_mass_of_a_hollow_cone(steel):
    cone = piece(steel, end_outer_diameter=0.09, inner_diameter=0.03, end_inner_diameter=0.01)

    def area(z):
        return np.pi / 4 * ((0.05 + 0.04 * z) ** 2 - (0.03 - 0.02 * z) ** 2)

    wanted = 7810.0 * LENGTH * quad(area, 0.0, 1.0)[0]
    assert supported((cone,)).mass == pytest.approx(wanted, rel=1e-12)
    assert supported(cone.split(5)).mass == pytest.approx(wanted, rel=1e-12)


@pytest.mark.closed_form
@pytest.mark.convergence
@pytest.mark.parametrize(
    ("beam", "kappa", "order", "error"),
    [
        (ClassicalBeam(), np.inf, 4, 1e-6),
        (FourthOrderBeam(), 0.886, 4, 1e-7),
        (ClassicalBeam(), 0.886, 1, 3e-4),
    ],
)
def test_a_conical_cantilever_bends_and_shears_as_in_closed_form(steel, beam, kappa, order, error):
    """Unit force at the thin end: int (L - z)^2 / EI + 1 / kGA dz.

    The classical element has one shear strain: in a cone that shears it is slow, of second order in the end.
    """
    cone = piece(steel, end_outer_diameter=0.03, shear_coefficient=kappa)

    def compliance(z):
        d = 0.05 - 0.02 * z / LENGTH
        second, area = np.pi / 64 * d**4, np.pi / 4 * d**2
        return (LENGTH - z) ** 2 / (211e9 * second) + 1.0 / (kappa * 81.2e9 * area)

    wanted = quad(compliance, 0.0, LENGTH, epsrel=1e-12)[0]
    errors = []
    for pieces in (8, 16, 32):
        matrix, _ = plane_stiffness(supported(cone.split(pieces), beam=beam))
        keep = np.arange(2, len(matrix))
        force = np.zeros(len(matrix))
        force[2 * pieces] = 1.0
        errors.append(1.0 - np.linalg.solve(matrix[np.ix_(keep, keep)], force[keep])[2 * pieces - 2] / wanted)
    assert 0.0 < errors[-1] < error, "too stiff, as every displacement method"
    assert np.log2(errors[-2] / errors[-1]) > order - 0.5


@pytest.mark.closed_form
def test_a_cone_that_is_none_is_the_cylinder(steel):
    cylinder = piece(steel)
    same = piece(steel, end_outer_diameter=DIAMETER, end_inner_diameter=0.0)
    nearly = piece(steel, end_outer_diameter=DIAMETER * (1 + 1e-12))
    for other in (same, nearly):
        for one, two in zip(
            cylinder.matrices(FourthOrderBeam()), other.matrices(FourthOrderBeam()), strict=True
        ):
            assert_allclose(two, one, rtol=1e-9, atol=1e-9 * np.abs(one).max())


@pytest.mark.closed_form
def test_layers_share_force_and_torque(steel):
    inner, outer = piece(steel), piece(steel, inner_diameter=0.05, outer_diameter=0.08)
    loaded = piece(steel, axial_force=3.0, torque=2.0)
    sleeve = piece(steel, inner_diameter=0.05, outer_diameter=0.08, axial_force=1.0)
    both = LayeredElement(layers=(loaded, sleeve))
    assert (both.axial_force, both.torque) == (4.0, 2.0)
    cone = LayeredElement(
        layers=(inner, piece(steel, inner_diameter=0.05, outer_diameter=0.08, end_outer_diameter=0.09))
    )
    plain = LayeredElement(layers=(inner, outer))
    assert supported((cone,)).mass > supported((plain,)).mass


@pytest.mark.closed_form
def test_tilt_springs_hold_a_cantilever(steel):
    """One end pinned and held by a spring against tilt: end deflection L^3 / 3 EI + L / kGA + L^2 / k."""
    spring = TiltSpring(node=0, stiffness=((4e4, 1e3), (-2e3, 5e4)), damping=7.0)
    rotor = ShaftRotor(elements=piece(steel).split(4), tilt_springs=(spring,), speed=0.0)
    free = ShaftRotor(elements=piece(steel).split(4), speed=0.0)
    n = len(rotor.structure.coordinates)
    keep = np.setdiff1d(np.arange(2 * n), [0, n])
    force = np.zeros(2 * n)
    force[8] = 1.0
    moved = np.linalg.solve(rotor.structure.stiffness[np.ix_(keep, keep)], force[keep])
    exact = rotor.elements[0].section()
    tilts = np.linalg.solve(spring.stiffness, [LENGTH, 0.0])
    own = LENGTH**3 / (3.0 * exact.bending) + LENGTH / exact.shear
    assert moved[7] == pytest.approx(own + LENGTH * tilts[0], rel=1e-9)
    assert moved[n - 1 + 7] == pytest.approx(LENGTH * tilts[1], rel=1e-9)
    extra = rotor.structure.damping - free.structure.damping
    assert extra[1, 1] == extra[n + 1, n + 1] == 7.0
    assert np.abs(extra).sum() == 14.0


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"end_outer_diameter": 0.0}, "end_outer_diameter must be finite and positive, got 0"),
        ({"end_inner_diameter": 0.06}, "end_inner_diameter must be below end_outer_diameter 0.05, got 0.06"),
        ({"axial_force": np.nan}, "axial_force must be a single finite number, got nan"),
        ({"torque": np.inf}, "torque must be a single finite number, got inf"),
    ],
)
def test_bad_loads_and_cones_are_named(steel, changes, match):
    with pytest.raises(InputError, match=match):
        piece(steel, **changes)


def test_bad_tilt_springs_are_named(steel):
    with pytest.raises(InputError, match="stiffness must be a number or 2 x 2 numbers"):
        TiltSpring(node=0, stiffness=(1.0, 2.0))
    with pytest.raises(InputError, match="tilt_springs must be on a node 0 to 1, got node 2"):
        ShaftRotor(elements=(piece(steel),), tilt_springs=(TiltSpring(node=2, stiffness=1.0),), speed=0.0)
