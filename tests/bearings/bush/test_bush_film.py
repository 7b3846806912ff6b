"""Arc functions of the bush, and heat into its shaft: series, inverses, finite volumes."""

import math

import mpmath
import numpy as np
import pytest
from families.bush_truth import finite_volume_flux
from hypothesis import given, strategies as st

from rotorfilm import ValidityWarning
from rotorfilm.bearings import ApproximateShaft, ContactBalance, ExactShaft, GlobalBalance
from rotorfilm.bearings.bush import contact_arc as contact, melting as bush_shaft

ANGLES = [1e-6, 1e-3, 0.1, 0.3, 0.499999, 0.5, 0.500001, 0.8, 1.2, 1.55]


def exact(alpha):
    """Return the arc functions at alpha, computed with 40 digits from their definitions."""
    with mpmath.workdps(40):
        a = mpmath.mpf(alpha)
        segment = a - mpmath.sin(2 * a) / 2
        moment = mpmath.sin(a) - a * mpmath.cos(a)
        values = {
            "segment": segment,
            "moment": moment,
            "arc_function": segment / mpmath.cos(a),
            "mean_weight": moment / (a * segment),
            "peak_weight": (1 - mpmath.cos(a)) / segment,
            "sinc": mpmath.sin(a) / a,
        }
        return {name: float(value) for name, value in values.items()}


@pytest.mark.closed_form
@pytest.mark.parametrize("alpha", ANGLES)
def test_arc_functions_keep_their_digits(alpha):
    for name, value in exact(alpha).items():
        assert getattr(contact, name)(alpha) == pytest.approx(value, rel=2e-14), name


@pytest.mark.closed_form
@pytest.mark.parametrize("alpha", ANGLES[1:-1])
@pytest.mark.parametrize("name", ["arc_function", "mean_weight", "peak_weight", "sinc"])
def test_slopes_are_those_of_the_functions(alpha, name):
    slope = getattr(contact, "arc_slope" if name == "arc_function" else f"{name}_slope")
    with mpmath.workdps(40):
        functions = {
            "arc_function": lambda a: (a - mpmath.sin(2 * a) / 2) / mpmath.cos(a),
            "mean_weight": lambda a: (mpmath.sin(a) - a * mpmath.cos(a)) / (a * (a - mpmath.sin(2 * a) / 2)),
            "peak_weight": lambda a: (1 - mpmath.cos(a)) / (a - mpmath.sin(2 * a) / 2),
            "sinc": lambda a: mpmath.sin(a) / a,
        }
        expected = float(mpmath.diff(functions[name], mpmath.mpf(alpha)))
    # The difference of two terms near 1/alpha^2 costs the square of alpha in digits.
    assert slope(alpha) == pytest.approx(expected, rel=1e-11 + 2e-16 / alpha**2)


@pytest.mark.long
@given(st.floats(-18, 6))
def test_the_angle_inverts_the_arc_function(exponent):
    value = 10.0**exponent
    alpha = contact.arc_angle(value)
    assert 0.0 < alpha < math.pi / 2
    # A relative error of alpha near pi/2 is F cot(alpha) times larger in F.
    assert contact.arc_function(alpha) == pytest.approx(value, rel=1e-13 + 1e-15 * value)


def test_the_angle_of_no_load_is_zero_and_arrays_keep_their_shape():
    np.testing.assert_allclose(contact.arc_angle([[0.0, 1.0]]), [[0.0, contact.arc_angle(1.0)]])


def test_the_mean_pressure_is_the_mean_of_the_assumed_one():
    alpha = 0.4
    phi, weights = np.polynomial.legendre.leggauss(20)
    shape = np.cos(alpha * phi) - math.cos(alpha)
    load = alpha * weights @ (shape * np.cos(alpha * phi))
    assert contact.mean_weight(alpha) == pytest.approx(0.5 * (weights @ shape) / load, rel=1e-13)
    assert contact.peak_weight(alpha) == pytest.approx((1.0 - math.cos(alpha)) / load, rel=1e-13)


@pytest.mark.convergence
@pytest.mark.parametrize(("cooling", "stubbiness"), [(402.0 * 0.0125 / 25.35, 0.25), (0.02, 1.0), (0.3, 0.1)])
def test_the_exact_flux_is_the_limit_of_finite_volumes(cooling, stubbiness):
    coarse, middle, fine = (finite_volume_flux(cooling, stubbiness, cells) for cells in (48, 96, 192))
    assert math.log2((middle - coarse) / (fine - middle)) == pytest.approx(2.0, abs=0.05)
    # The square-root edge leaves an error as the size of the cell there, cells^-3.
    twice = [(4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0]
    limit = (8.0 * twice[1] - twice[0]) / 7.0
    assert bush_shaft.exact_flux(cooling, stubbiness) == pytest.approx(limit, rel=2e-7)


@pytest.mark.convergence
@pytest.mark.parametrize(("cooling", "stubbiness"), [(0.02, 0.1), (0.02, 1.0), (0.3, 0.1), (0.3, 1.0)])
def test_more_functions_and_a_longer_integral_change_nothing(cooling, stubbiness, monkeypatch):
    usual = bush_shaft.exact_flux(cooling, stubbiness)
    monkeypatch.setattr(bush_shaft, "FUNCTIONS", 24)
    monkeypatch.setattr(bush_shaft, "CUTOFF", 5000.0)
    bush_shaft._nodes.cache_clear()
    more = bush_shaft.exact_flux(cooling, stubbiness)
    bush_shaft._nodes.cache_clear()
    assert usual == pytest.approx(more, rel=3e-8)


@pytest.mark.closed_form
def test_a_long_bush_loses_heat_at_its_ends_only():
    # Far from the ends the shaft is at T_*: the total loss, flux / stubbiness, does not depend on the length.
    short, long_ = bush_shaft.exact_flux(0.1, 0.2) / 0.2, bush_shaft.exact_flux(0.1, 0.1) / 0.1
    assert long_ == pytest.approx(short, rel=1e-6)


@pytest.mark.closed_form
def test_a_well_insulated_shaft_is_a_fin():
    # One-dimensional fin, small Biot number: loss per circumference sqrt(Bi/2) (1 + O(Bi)).
    cooling = 1e-4
    loss = bush_shaft.exact_flux(cooling, 0.2) / 0.2
    assert loss == pytest.approx(math.sqrt(0.5 * cooling), rel=1e-2)


@pytest.mark.literature
def test_the_closed_form_is_high_by_what_the_kernel_approximation_allows():
    """The source states 3 % for its kernel; the flux is at most that high, and never low."""
    errors = [
        bush_shaft.approximate_flux(cooling, stubbiness) / bush_shaft.exact_flux(cooling, stubbiness) - 1.0
        for cooling in np.linspace(0.02, 0.3, 5)
        for stubbiness in (0.1, 0.25, 0.5, 1.0)
    ]
    assert min(errors) > 0.006
    assert max(errors) < 0.03


def test_the_closed_form_warns_beyond_the_range_of_the_source():
    with pytest.warns(ValidityWarning, match="must not exceed 0.3 for ApproximateShaft, got 0.4"):
        ApproximateShaft().flux(0.4, 0.25)


def test_rules_are_interchangeable():
    assert ExactShaft().flux(0.2, 0.25) == bush_shaft.exact_flux(0.2, 0.25)
    assert ApproximateShaft().flux(0.2, 0.25) == bush_shaft.approximate_flux(0.2, 0.25)
    assert ContactBalance().share(0.3) == 1.0
    assert ContactBalance().share_slope(0.3) == 0.0
    h = 1e-4
    slope = (GlobalBalance().share(0.3 + h) - GlobalBalance().share(0.3 - h)) / (2.0 * h)
    assert GlobalBalance().share_slope(0.3) == pytest.approx(slope, rel=1e-6)
    assert GlobalBalance().share(math.pi) == 1.0
