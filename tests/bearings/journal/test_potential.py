"""Potential of the full film: symmetries, limits, and two independent discretizations against each other."""

import math

import numpy as np
import pytest
from map_nodes import grid_potential, richardson_potential
from map_potential import (
    RitzResolution,
    Source,
    default_resolution,
    directed_potential,
    potential,
)
from scipy.integrate import quad

from rotorfilm import ConvergenceError, InputError
from rotorfilm.bearings.journal import ShortFilm

STATES = [(0.3, 0.5), (0.8, 0.2), (0.95, 0.9)]


def source(chi, turn, slenderness, magnitude=1.0, mirror=1.0):
    cosine = 2.0 * turn - 1.0
    return Source(chi, -mirror * magnitude * math.sqrt(1.0 - cosine**2), magnitude * cosine, slenderness)


@pytest.mark.closed_form
@pytest.mark.parametrize(("chi", "turn"), STATES)
def test_homogeneous_of_degree_two(chi, turn):
    resolution = default_resolution(chi, 1.0)
    one = directed_potential(source(chi, turn, 1.0), resolution)
    three = directed_potential(source(chi, turn, 1.0, magnitude=3.0), resolution)
    assert three.log == pytest.approx(one.log + 2.0 * math.log(3.0), abs=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize(("chi", "turn"), STATES)
def test_mirror(chi, turn):
    resolution = default_resolution(chi, 1.0)
    one = directed_potential(source(chi, turn, 1.0), resolution)
    other = directed_potential(source(chi, turn, 1.0, mirror=-1.0), resolution)
    assert other.log == pytest.approx(one.log, abs=1e-10)
    np.testing.assert_allclose(other.force, one.force * [-1.0, 1.0], rtol=1e-7, atol=1e-7)


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.1, 1.0, 4.0])
def test_isotropic_at_the_center(slenderness):
    films = [potential(0.0, turn, slenderness) for turn in (0.0, 0.3, 0.7, 1.0)]
    logs = [film.log for film in films]
    assert np.ptp(logs) < 1e-8
    for turn, film in zip((0.0, 0.3, 0.7, 1.0), films, strict=True):
        g = source(0.0, turn, slenderness)
        np.testing.assert_allclose(film.force, [2.0 * g.sine, 2.0 * g.cosine], atol=1e-7)


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.25, 2.0])
def test_parity_at_the_center(slenderness):
    # L(-chi, T) = L(chi, 1 - T), so dL/dchi at chi = 0 is odd about T = 1/2.
    for turn in (0.0, 0.2, 0.45):
        slope = potential(0.0, turn, slenderness).chi_slope
        assert abs(slope) > 0.01
        assert potential(0.0, 1.0 - turn, slenderness).chi_slope == pytest.approx(-slope, abs=1e-5)


@pytest.mark.closed_form
def test_parity_of_the_grid():
    forward, _ = grid_potential(Source(0.6, 0.6, -0.8, 1.0), (96, 8))
    backward, _ = grid_potential(Source(-0.6, -0.6, 0.8, 1.0), (96, 8))
    assert backward == pytest.approx(forward, rel=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize(("chi", "turn"), STATES)
def test_euler_and_envelope(chi, turn):
    # g . dJ/dg = 2 J, and dL/dchi at a fixed region is the total derivative at the free ends.
    film, g = potential(chi, turn, 1.0), source(chi, turn, 1.0)
    assert film.force @ [g.sine, g.cosine] == pytest.approx(2.0, abs=1e-10)
    step = 1e-3 * (1.0 - chi)
    difference = (potential(chi + step, turn, 1.0).log - potential(chi - step, turn, 1.0).log) / (2.0 * step)
    assert film.chi_slope == pytest.approx(difference, rel=5e-5)


@pytest.mark.closed_form
@pytest.mark.parametrize(("chi", "turn"), STATES)
def test_force_is_the_gradient(chi, turn):
    angle, g = 1e-3, source(chi, turn, 0.5)
    across = np.array([g.cosine, -g.sine])
    logs = [
        directed_potential(
            Source(
                chi, g.sine + s * math.tan(angle) * across[0], g.cosine + s * math.tan(angle) * across[1], 0.5
            ),
            default_resolution(chi, 0.5),
        ).log
        for s in (-1.0, 1.0)
    ]
    film = potential(chi, turn, 0.5)
    assert film.force @ across == pytest.approx((logs[1] - logs[0]) / (2.0 * math.tan(angle)), abs=3e-5)


@pytest.mark.closed_form
@pytest.mark.parametrize(("chi", "turn"), [(0.3, 0.3), (0.7, 0.9)])
def test_short_limit(chi, turn):
    # Reynolds rupture tends to the half circle where g < 0, the difference falling as (L/D)^2.
    errors = []
    for slenderness in (0.04, 0.02):
        g = source(chi, turn, slenderness)
        w = np.array([g.cosine, g.sine])
        short = 0.5 * ShortFilm().force(np.array([chi, 0.0]), w, slenderness) @ w
        errors.append(math.exp(potential(chi, turn, slenderness).log) / -short - 1.0)
    assert errors[1] == pytest.approx(0.0, abs=1e-3)
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.05)


@pytest.mark.closed_form
def test_long_limit_of_pure_approach():
    # g = cos gamma: H^3 u' = sin gamma, u = (1/H^2 - 1/(1 + chi)^2)/(2 chi); the ends cost a share ~ D/L.
    chi = 0.7

    def moment(gamma):
        return (1.0 / (1.0 + chi * math.cos(gamma)) ** 2 - 1.0 / (1.0 + chi) ** 2) * math.cos(gamma)

    long = 6.0 * quad(moment, 0.0, 2.0 * math.pi)[0] / (2.0 * chi)
    shares = [-math.exp(potential(chi, 1.0, slenderness).log) / long for slenderness in (2.5, 5.0)]
    assert 2.0 * shares[1] - shares[0] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.convergence
@pytest.mark.parametrize(("chi", "turn", "slenderness"), [(0.0, 0.6, 0.25), (0.5, 0.5, 1.0), (0.9, 0.1, 0.5)])
def test_order_of_the_grid(chi, turn, slenderness):
    J = -math.exp(potential(chi, turn, slenderness).log)
    g = source(chi, turn, slenderness)
    errors = [grid_potential(g, cells)[0] / J - 1.0 for cells in ((96, 8), (192, 16))]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.02)


@pytest.mark.convergence
@pytest.mark.parametrize(
    ("chi", "turn", "slenderness"),
    [
        (0.2, 0.1, 0.1),
        (0.6, 0.5, 0.25),
        (0.9, 0.5, 0.5),
        (0.9, 0.05, 1.0),
        (0.8, 0.8, 1.0),
        (0.5, 0.5, 2.0),
        (0.5, 0.5, 4.0),
        (0.9, 0.15, 4.0),
    ],
)
def test_two_discretizations_agree(chi, turn, slenderness):
    film = potential(chi, turn, slenderness)
    J, force, error = richardson_potential(source(chi, turn, slenderness), (96, 8))
    assert abs(J) == pytest.approx(math.exp(film.log), rel=8e-5)
    assert abs(J / math.exp(film.log) + 1.0) < error / abs(J)
    np.testing.assert_allclose(force / J, film.force, atol=3e-4 * np.hypot(*film.force))


@pytest.mark.convergence
@pytest.mark.parametrize(("chi", "slenderness"), [(0.5, 1.0), (0.999, 1.0)])
def test_truncation(chi, slenderness):
    for turn in (0.1, 0.95):
        fine = potential(chi, turn, slenderness, RitzResolution(40, 20, 5))
        assert potential(chi, turn, slenderness).log == pytest.approx(fine.log, abs=1e-6)


def test_arguments():
    with pytest.raises(InputError, match="chi must be in"):
        potential(1.0, 0.5, 1.0)
    with pytest.raises(InputError, match="turn must be in"):
        potential(0.5, 1.5, 1.0)
    with pytest.raises(InputError, match="slenderness must be finite and positive"):
        potential(0.5, 0.5, math.nan)


def test_a_film_without_a_gap_is_refused():
    with pytest.raises(ConvergenceError, match="dry gap"):
        potential(0.3, 1.0, 40.0)
