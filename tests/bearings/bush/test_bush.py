"""The polymer bush: the example of Evtushenko & Kovalenko (1993), identities, and refused input."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from rotorfilm import Friction, InputError, MeltingBush
from rotorfilm.bearings import (
    ApproximateShaft,
    BushGeometry,
    ExactShaft,
    GlobalBalance,
    LinerMaterial,
    f4k20_bush,
)

BUSH = f4k20_bush()
PUBLISHED = replace(BUSH, shaft_heat=ApproximateShaft())
RATIOS = (3e-3, 7e-3, 1e-2)
LOADS = np.array(RATIOS) * 3e8 * 12.5e-3 * 0.1


@pytest.mark.literature
def test_contact_angles_and_settlements_of_section_4():
    angles = BUSH.contact_angle(LOADS)
    np.testing.assert_allclose(angles, [0.135, 0.178, 0.201], atol=5e-4)
    ratios = BUSH.settlement(angles) / BUSH.geometry.radius
    np.testing.assert_allclose(ratios, [-0.479e-2, -0.456e-2, -0.441e-2], atol=5e-6)


@pytest.mark.literature
def test_last_contact_angle_of_section_4():
    assert BUSH.angle_at(0.0) == pytest.approx(0.521, abs=5e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", RATIOS)
def test_contact_of_the_example_by_root_finding(ratio):
    """Formula (2.17) with the numbers of section 4, solved without this package."""
    thickness, clearance = math.log(14.5 / 13.0), 0.5 / 13.0
    gap = clearance - thickness * 8e-5 * 1.4 / 0.6 * 250.0
    stiffness = thickness * 0.2 / 1.2

    def imbalance(a):
        return (a - 0.5 * math.sin(2.0 * a)) * gap / math.cos(a) - stiffness * ratio

    alpha = brentq(imbalance, 1e-6, 1.5, xtol=1e-15)
    load = ratio * 3e8 * 12.5e-3 * 0.1
    assert BUSH.contact_angle(load) == pytest.approx(alpha, rel=1e-12)
    assert BUSH.settlement(alpha) == pytest.approx(13e-3 * (gap / math.cos(alpha) - clearance), rel=1e-11)
    assert BUSH.angle_at(0.0) == pytest.approx(math.acos(gap / clearance), rel=1e-14)


@pytest.mark.literature
def test_printed_speeds_are_lower_than_the_printed_formulas_give():
    """14.5 to 14.8 % for all six numbers: the source does not say which f(T) it used."""
    printed = np.array([7.96, 4.51, 3.55, 29.99, 12.85, 8.99])
    computed = [*PUBLISHED.critical_speed(LOADS), *(PUBLISHED.onset_speed(load, 0.0) for load in LOADS)]
    np.testing.assert_allclose(computed / printed, 1.1465, atol=0.0025)
    # Only the product of friction and speed enters, so one friction coefficient would explain all six.
    factor = float(np.mean(computed / printed))
    sticky = replace(PUBLISHED, friction=Friction(f0=0.1 * factor))
    tuned = [*sticky.critical_speed(LOADS), *(sticky.onset_speed(load, 0.0) for load in LOADS)]
    np.testing.assert_allclose(tuned, printed, rtol=2e-3)


@pytest.mark.closed_form
def test_critical_speed_balances_the_heat_of_the_assumed_pressure():
    """(2.14)-(2.16) by quadrature, with (2.13) written out for the example."""
    load, alpha = float(LOADS[2]), float(PUBLISHED.contact_angle(LOADS[2]))
    unit = load / 0.1 / (12.5e-3 * (alpha - 0.5 * math.sin(2.0 * alpha)))
    mean = quad(lambda phi: unit * (math.cos(phi) - math.cos(alpha)), -alpha, alpha)[0] / (2.0 * alpha)
    outer = quad(lambda phi: 235.0 + 4.0 * math.cos(phi), -alpha, alpha)[0] / (2.0 * alpha)
    liner = 0.39 / (13e-3 * math.log(14.5 / 13.0)) * (250.0 - outer)
    assert PUBLISHED.mean_pressure(load, alpha) == pytest.approx(mean, rel=1e-12)
    assert PUBLISHED.maximum_pressure(load, alpha) == pytest.approx(unit * (1.0 - math.cos(alpha)), rel=1e-12)
    assert PUBLISHED.liner_flux(alpha) == pytest.approx(liner, rel=1e-12)
    speed = (PUBLISHED.shaft_flux(alpha) + liner) / (12.5e-3 * 0.1 * mean)
    assert PUBLISHED.critical_speed(load) == pytest.approx(speed, rel=1e-12)


def test_exact_shaft_flux_lowers_the_critical_speed():
    assert PUBLISHED.shaft_conductance / BUSH.shaft_conductance == pytest.approx(1.0222, abs=1e-4)
    assert np.all(BUSH.critical_speed(LOADS) < PUBLISHED.critical_speed(LOADS))


def test_critical_speed_grows_with_the_angle_and_so_ends_at_omega_star():
    angles = np.linspace(0.05, 1.5, 200)
    assert np.all(np.diff(BUSH.critical_speed(3e3, angles)) > 0.0)
    last = BUSH.critical_speed(LOADS[1], BUSH.angle_at(0.0))
    assert BUSH.onset_speed(float(LOADS[1]), 0.0) == pytest.approx(last, rel=1e-12)


@pytest.mark.closed_form
def test_global_balance_multiplies_the_shaft_flux_by_pi_over_alpha():
    whole = replace(BUSH, balance=GlobalBalance())
    alpha = float(BUSH.contact_angle(LOADS[0]))
    assert whole.shaft_flux(alpha) == pytest.approx(BUSH.shaft_flux(alpha) * math.pi / alpha, rel=1e-14)
    ratios = whole.critical_speed(LOADS) / BUSH.critical_speed(LOADS)
    assert ratios[0] == pytest.approx(21.5, abs=0.05)
    last = BUSH.angle_at(0.0)
    assert whole.critical_speed(3e3, last) / BUSH.critical_speed(3e3, last) == pytest.approx(5.6, abs=0.05)


def test_the_settlement_gives_the_angle_back():
    angles = np.array([0.1, 0.5, 1.0])
    np.testing.assert_allclose(BUSH.angle_at(BUSH.settlement(angles)), angles, rtol=1e-12)


def test_a_warmer_contact_is_wider():
    cold, warm = BUSH.contact_angle(3e3, 0.0), BUSH.contact_angle(3e3, 100.0)
    assert cold < warm < BUSH.contact_angle(3e3)


def test_contact_collects_what_the_methods_say():
    at = BUSH.contact(3750.0)
    assert at.contact_angle == BUSH.contact_angle(3750.0)
    assert at.critical_speed == BUSH.critical_speed(3750.0)
    assert at.settlement == BUSH.settlement(at.contact_angle)
    assert (at.load, at.liner_flux) == (3750.0, BUSH.liner_flux(at.contact_angle))


@pytest.mark.parametrize(
    ("f", "least"),
    [((0.1, 0.0, 0.0), 0.1), ((0.1, -2e-4, 1e-6), 0.09), ((0.1, 1e-4, 0.0), 0.1), ((0.1, 0.0, -1e-6), 0.06)],
)
def test_least_friction(f, least):
    assert Friction(f0=f[0], f1=f[1], f2=f[2]).least(200.0) == pytest.approx(least)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"shaft_heat": ExactShaft},
            r"shaft_heat must be ExactShaft\(\) or ApproximateShaft\(\), got <class",
        ),
        ({"balance": None}, r"balance must be ContactBalance\(\) or GlobalBalance\(\), got None"),
        ({"outer_mean": math.nan}, "outer_mean must be a single finite number, got nan"),
        ({"outer_swing": -1.0}, "outer_swing must be finite and not negative, got -1.0"),
        (
            {"outer_mean": 246.0},
            r"outer_mean \+ outer_swing must be below the melting point 250.0, got 250.0",
        ),
        ({"friction": Friction(f0=0.1, f1=-5e-4)}, "friction must be positive up to the melting point, got"),
        (
            {"geometry": BushGeometry(radius=13e-3, outer_radius=14.5e-3, shaft_radius=12.94e-3, length=0.1)},
            r"radius - shaft_radius must exceed the part .* closes, 0\.00509597 radii, got 0\.0046",
        ),
    ],
)
def test_bad_parameters_are_named(change, message):
    with pytest.raises(InputError, match=message):
        replace(BUSH, **change)


@pytest.mark.parametrize(
    ("part", "change", "message"),
    [
        (BUSH.geometry, {"length": 0.0}, "length must be finite and positive, got 0.0"),
        (BUSH.geometry, {"shaft_radius": 0.014}, "shaft_radius must be below the radius 0.013, got 0.014"),
        (BUSH.geometry, {"outer_radius": 0.01}, "outer_radius must exceed the radius 0.013, got 0.01"),
        (BUSH.liner, {"poisson_ratio": 0.5}, "poisson_ratio must be at least 0 and below 0.5, got 0.5"),
        (BUSH.liner, {"melting_point": math.inf}, "melting_point must be finite and positive, got inf"),
        (BUSH.shaft, {"air_transfer": -1.0}, "air_transfer must be finite and positive, got -1.0"),
        (BUSH.friction, {"f1": math.nan}, "f1 must be a single finite number, got nan"),
    ],
)
def test_bad_parts_are_named(part, change, message):
    with pytest.raises(InputError, match=message):
        replace(part, **change)


def test_bad_arguments_are_named():
    with pytest.raises(InputError, match=r"load must not be negative, got -1\.0"):
        BUSH.contact_angle(-1.0)
    with pytest.raises(InputError, match="load must be finite, got nan"):
        BUSH.contact_angle(math.nan)
    with pytest.raises(InputError, match="load must be positive for a critical speed, got 0"):
        BUSH.critical_speed(0.0)
    with pytest.raises(InputError, match=r"settlement must be at least -6\.6\d*e-05 m, .*got -0\.001"):
        BUSH.angle_at(-1e-3)
    with pytest.raises(InputError, match="temperature must leave a clearance, got 5000"):
        BUSH.contact_angle(1.0, 5000.0)


@pytest.mark.parametrize("clearance", [70e-6, 1e-3])
def test_small_and_large_clearances(clearance):
    geometry = replace(BUSH.geometry, shaft_radius=13e-3 - clearance)
    bush = replace(BUSH, geometry=geometry)
    assert 0.0 < bush.contact_angle(3e3) < math.pi / 2
    assert math.isfinite(bush.critical_speed(3e3))


def test_batches_keep_their_shape():
    loads = LOADS[:, None] * np.ones(4)
    assert BUSH.contact_angle(loads).shape == (3, 4)
    assert BUSH.critical_speed(loads).shape == (3, 4)


def test_it_says_what_it_is():
    assert isinstance(BUSH, MeltingBush)
    assert isinstance(BUSH.liner, LinerMaterial)
    assert "shear_modulus=300000000.0" in repr(BUSH)
