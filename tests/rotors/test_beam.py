"""Beam elements against uniform shafts in closed form."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import eigh
from scipy.optimize import brentq

from rotorfilm import InputError
from rotorfilm.rotors import ClassicalBeam, FourthOrderBeam, ShaftElement, cowper_coefficient
from rotorfilm.rotors.shaft_elements import Section, beam_matrices

BEAMS = [ClassicalBeam(), FourthOrderBeam()]


def plane(beam, section, length, pieces):
    """Return mass, polar and stiffness matrix of a free uniform shaft in one plane."""
    size = 2 * (pieces + 1) + beam.internal * pieces
    total = np.zeros((3, size, size))
    for k in range(pieces):
        inner = 2 * (pieces + 1) + beam.internal * k
        places = [*range(2 * k, 2 * k + 4), *range(inner, inner + beam.internal)]
        for matrix, part in zip(total, beam_matrices(beam, section, length / pieces)[:3], strict=True):
            matrix[np.ix_(places, places)] += part
    return total


def frequencies(beam, section, length, pieces, held=()):
    mass, _, stiffness = plane(beam, section, length, pieces)
    keep = np.setdiff1d(np.arange(len(mass)), held)
    squares = eigh(stiffness[np.ix_(keep, keep)], mass[np.ix_(keep, keep)], eigvals_only=True)
    return np.sqrt(np.maximum(squares, 0.0))


def observed_orders(errors):
    return np.log2(errors[:-1] / errors[1:])


@pytest.mark.parametrize("beam", BEAMS)
def test_rigid_motion_has_no_energy_and_the_right_inertia(beam):
    section, length = Section(bending=3.0, shear=5.0, mass=7.0, inertia=0.2), 1.5
    matrices = beam_matrices(beam, section, length)
    shift = np.array([1.0, 0.0, 1.0, 0.0, *[0.0] * beam.internal])
    turn = np.array([0.0, 1.0, length, 1.0, *[0.0] * beam.internal])
    assert_allclose(matrices.stiffness @ np.array([shift, turn]).T, 0.0, atol=1e-12)
    assert_allclose(shift @ matrices.mass @ shift, 7.0 * length)
    assert_allclose(turn @ matrices.mass @ turn, 7.0 * length**3 / 3.0 + 0.2 * length)
    assert_allclose(turn @ matrices.polar @ turn, 2.0 * 0.2 * length)


@pytest.mark.closed_form
@pytest.mark.parametrize("beam", BEAMS)
def test_a_cantilever_bends_and_shears_exactly_under_an_end_force(beam):
    section, length = Section(bending=3.0, shear=5.0, mass=1.0, inertia=0.1), 1.5
    stiffness = plane(beam, section, length, 3)[2]
    keep = np.arange(2, len(stiffness))
    force = np.zeros(len(stiffness))
    force[6] = 2.0
    moved = np.linalg.solve(stiffness[np.ix_(keep, keep)], force[keep])
    assert moved[4] == pytest.approx(2.0 * length**3 / (3 * 3.0) + 2.0 * length / 5.0, rel=1e-12)
    assert moved[5] == pytest.approx(2.0 * length**2 / (2 * 3.0), rel=1e-12)


@pytest.mark.closed_form
@pytest.mark.convergence
@pytest.mark.parametrize("diameter", [0.05, 0.1])
@pytest.mark.parametrize("mode", [1, 2, 3])
def test_simply_supported_shaft_with_shear_converges_at_fourth_order(steel, timoshenko, diameter, mode):
    beam = FourthOrderBeam()
    piece = ShaftElement(length=0.3, outer_diameter=diameter, material=steel, shear_coefficient=0.89)
    exact = timoshenko(piece)
    section = Section(exact.bending, exact.shear, exact.mass, exact.inertia)
    wanted = min(exact.whirl(mode, 0.0)[2:])
    grids = np.array([4, 8, 16])
    errors = np.array(
        [frequencies(beam, section, 0.3, n, (0, 2 * n))[mode - 1] / wanted - 1.0 for n in grids]
    )
    assert np.all(errors > 0.0), "a Rayleigh quotient is too high"
    assert observed_orders(errors)[-1] == pytest.approx(beam.order, abs=0.1)
    assert errors[-1] < 5e-5


@pytest.mark.convergence
def test_the_classical_element_with_shear_ends_in_second_order(steel, timoshenko):
    piece = ShaftElement(length=0.3, outer_diameter=0.05, material=steel, shear_coefficient=0.89)
    exact = timoshenko(piece)
    section = Section(exact.bending, exact.shear, exact.mass, exact.inertia)
    wanted = min(exact.whirl(1, 0.0)[2:])
    errors = np.array(
        [frequencies(ClassicalBeam(), section, 0.3, n, (0, 2 * n))[0] / wanted - 1.0 for n in (8, 16, 32)]
    )
    assert_allclose(observed_orders(errors), ClassicalBeam.order, atol=0.1)


@pytest.mark.closed_form
@pytest.mark.convergence
def test_without_shear_and_rotary_inertia_the_classical_element_is_of_fourth_order():
    """Simply supported: (n pi / L)^2; free: the roots of cos(b) cosh(b) = 1.

    The lowest eigenvalue carries round-off of the highest, which grows as n^4 while the error of the element
    falls as n^-4: up to 0.3 % of that error on 32 pieces, and a fifth on 48.
    """
    section = Section(bending=1.0, shear=math.inf, mass=1.0, inertia=0.0)
    free = [brentq(lambda b: math.cos(b) - 1.0 / math.cosh(b), low, high) for low, high in ((4, 5), (7, 8.5))]
    for wanted, held, skip in (([math.pi, 2 * math.pi], True, 0), (free, False, 2)):
        errors = np.array(
            [
                frequencies(ClassicalBeam(), section, 1.0, n, (0, 2 * n) if held else ())[skip : skip + 2]
                / np.square(wanted)
                - 1.0
                for n in (8, 16, 32)
            ]
        )
        assert_allclose(observed_orders(errors)[-1], 4.0, atol=0.05)
        assert np.all(errors[-1] < 1e-5)


@pytest.mark.closed_form
@pytest.mark.convergence
def test_free_shaft_with_shear_converges_to_its_closed_form():
    """Symmetric modes of a free Timoshenko shaft: no moment and no shear at z = +-1/2."""
    section = Section(bending=1.0, shear=60.0, mass=1.0, inertia=0.01)

    def wave_numbers(square):
        # kGA b^2 - m p^2 and EI b^2 + kGA - j p^2 as in the simply supported shaft, now for b^2
        a, j, s = section.bending, section.inertia, section.shear
        return np.roots([s * a, -square * (s * j + a), square * (square * j - s)])

    def defect(frequency):
        square = frequency**2
        one, two = sorted(wave_numbers(square))  # one < 0 < two
        k, b = math.sqrt(-one), math.sqrt(two)
        # w = A cosh(k z) + B cos(b z), theta = A p sinh(k z) - B q sin(b z)
        p, q = k + square / (section.shear * k), b - square / (section.shear * b)
        moment = (p * k * math.cosh(k / 2), -q * b * math.cos(b / 2))
        shear = ((k - p) * math.sinh(k / 2), (q - b) * math.sin(b / 2))
        return moment[0] * shear[1] - moment[1] * shear[0]

    wanted = brentq(defect, 10.0, 22.0, xtol=1e-13)
    errors = np.array([frequencies(FourthOrderBeam(), section, 1.0, n)[2] / wanted - 1.0 for n in (4, 8, 16)])
    assert 1e-12 < errors[-1] < 3e-6
    assert_allclose(observed_orders(errors), 4.0, atol=0.5)


def test_shear_coefficient_of_thin_tube_and_full_shaft():
    assert cowper_coefficient(0.3) == pytest.approx(6 * 1.3 / 8.8)
    assert cowper_coefficient(0.3, 1.0) == pytest.approx(2 * 1.3 / (4 + 3 * 0.3))
    assert cowper_coefficient(0.0) == pytest.approx(6.0 / 7.0)


def test_no_shear_needs_the_classical_element():
    section = Section(bending=1.0, shear=math.inf, mass=1.0, inertia=0.0)
    with pytest.raises(InputError, match="shear_coefficient must be finite for FourthOrderBeam"):
        beam_matrices(FourthOrderBeam(), section, 1.0)


@pytest.mark.closed_form
def test_a_clamped_element_answers_an_even_load_and_an_even_moment_exactly():
    """Work of q: q^2 (L^5/720 EI + L^3/12 kGA); of m: m^2 L^3/12 EI / (1 + kGA L^2/12 EI)."""
    beam, length = FourthOrderBeam(), 1.5
    section = Section(bending=3.0, shear=5.0, mass=1.0, inertia=0.0)
    inside = beam_matrices(beam, section, length).stiffness[4:, 4:]
    shapes = beam.shapes(length, 12 * 3.0 / (5.0 * length**2))[4:]
    for part, wanted in (
        (0, length**5 / (720 * 3.0) + length**3 / (12 * 5.0)),
        (1, length**3 / (12 * 3.0) / (1 + 5.0 * length**2 / (12 * 3.0))),
    ):
        load = np.array([length * shape[part].integ()(1.0) for shape in shapes])
        assert load @ np.linalg.solve(inside, load) == pytest.approx(wanted, rel=1e-12)
