import math
import sys

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import brentq, minimize_scalar

from rotorfilm import EquilibriumError, InputError, ValidityWarning
from rotorfilm.analysis import coefficients, critical_mass, equilibrium, speed_parameter, whirl_threshold
from rotorfilm.bearings.journal import SplittingFilm
from rotorfilm.bearings.pads import PadGridFilm, TiltingPadBearing
from rotorfilm.core.errors import warn_user

SPEED = 1500 * math.pi / 30
LOAD = [0.0, -525.0]
MASS = 525 / 9.80665


def growth(ocvirk, eps, w):
    """Return the largest real part of the roots of w^2 q'' + C q' + K q = 0 (time in 1/speed, load 1)."""
    K, C = ocvirk.stiffness(eps), ocvirk.damping(eps)
    lower = np.hstack([-K, -C]) / w**2
    return np.linalg.eigvals(np.vstack([np.hstack([np.zeros((2, 2)), np.eye(2)]), lower])).real.max()


def eigenvalue_threshold(ocvirk, eps):
    """Return w = speed sqrt(c m / W) at the border, from the closed forms by eigenvalues alone."""
    return brentq(lambda w: growth(ocvirk, eps, w), 1.0, 50.0, xtol=1e-12)


def parameter_at(bearing, ocvirk, eps):
    load = ocvirk.load(eps, SPEED)
    at = equilibrium(bearing, [0.0, -load], SPEED)
    mass = critical_mass(coefficients(bearing, at.position, SPEED)).mass
    return math.inf if mass is None else SPEED * math.sqrt(bearing.clearance * mass / load)


@pytest.mark.closed_form
@pytest.mark.parametrize(("eps", "printed"), [(0.1, 2.741279), (0.3, 2.605786), (0.5, 2.541731)])
def test_thresholds_of_the_short_bearing(bearing, ocvirk, eps, printed):
    expected = eigenvalue_threshold(ocvirk, eps)
    load = ocvirk.load(eps, SPEED)
    found = whirl_threshold(bearing, [0.0, -load], load * (expected / SPEED) ** 2 / bearing.clearance)
    assert found.speed == pytest.approx(SPEED, rel=1e-9)
    assert found.speed_parameter == pytest.approx(expected, abs=1e-6)
    assert found.speed_parameter == pytest.approx(printed, abs=1e-6)
    assert found.equilibrium.eccentricity_ratio == pytest.approx(eps, abs=1e-9)
    assert found.exists
    assert found.reason == ""


@pytest.mark.closed_form
def test_lowest_threshold_of_the_short_bearing(bearing, ocvirk):
    lowest = minimize_scalar(
        lambda eps: parameter_at(bearing, ocvirk, eps), bounds=(0.3, 0.6), method="bounded"
    )
    reference = minimize_scalar(
        lambda eps: eigenvalue_threshold(ocvirk, eps), bounds=(0.3, 0.6), method="bounded"
    )
    assert lowest.fun == pytest.approx(reference.fun, abs=1e-6)
    assert lowest.fun == pytest.approx(2.531706, abs=1e-6)


@pytest.mark.closed_form
def test_short_bearing_is_stable_at_any_speed_beyond_eps_756030(bearing, ocvirk):
    for eps, exists in ((0.756029, True), (0.756031, False)):
        assert math.isfinite(parameter_at(bearing, ocvirk, eps)) == exists
        assert (growth(ocvirk, eps, 1e5) > 0.0) == exists


@pytest.mark.closed_form
@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_whirl_ratio_tends_to_one_half(bearing):
    assert whirl_threshold(bearing, LOAD, 0.01).whirl_ratio == pytest.approx(0.5, abs=1e-6)


def test_speed_is_the_border_between_decay_and_growth(bearing):
    found = whirl_threshold(bearing, LOAD, MASS)
    assert found.critical_mass == pytest.approx(MASS, rel=1e-10)
    at = {ratio: equilibrium(bearing, LOAD, ratio * found.speed) for ratio in (0.99, 1.01)}
    masses = {r: critical_mass(coefficients(bearing, e.position, e.speed)).mass for r, e in at.items()}
    assert masses[0.99] > MASS > masses[1.01]


@pytest.mark.long
@settings(max_examples=10, deadline=None)
@given(turn=st.floats(-math.pi, math.pi))
def test_direction_of_the_load_does_not_matter(bearing, turn):
    expected = whirl_threshold(bearing, LOAD, MASS, (500.0, 2000.0))
    found = whirl_threshold(bearing, [525 * math.cos(turn), 525 * math.sin(turn)], MASS, (500.0, 2000.0))
    assert found.speed == pytest.approx(expected.speed, rel=1e-9)
    assert found.whirl_ratio == pytest.approx(expected.whirl_ratio, rel=1e-9)


@pytest.mark.literature
def test_threshold_of_the_second_approximation(with_film):
    # c m speed^2 / W = 3.81 at L/D = .5 and eps = .5 (Sussi & Fridman 1978, second approximation)
    bearing = with_film(SplittingFilm(order=(2, 1)))
    bearing = type(bearing)(radius=0.03, length=0.03, clearance=1e-4, viscosity=0.1, film=bearing.film)
    load = -bearing.force([5e-5, 0.0], [0.0, 0.0], SPEED)
    at = equilibrium(bearing, load, SPEED)
    mass = critical_mass(coefficients(bearing, at.position, SPEED)).mass
    assert bearing.clearance * mass * SPEED**2 / math.hypot(*load) == pytest.approx(3.81, abs=0.005)
    assert whirl_threshold(bearing, load, mass).speed == pytest.approx(SPEED, rel=1e-8)


@pytest.mark.parametrize("load", [[0.0, -525.0], [525.0, 0.0], [300.0, 400.0]])
@pytest.mark.parametrize("modes", [1, 3, None])
def test_first_approximation_has_no_threshold(with_film, load, modes):
    found = whirl_threshold(with_film(SplittingFilm(order=(1, modes))), load, MASS)
    assert not found.exists
    assert found.speed is None
    assert found.whirl_ratio is None
    assert found.reason.startswith("damping matrix has rank 1")


@pytest.mark.parametrize(
    ("stiffness", "damping", "reason"),
    [
        ([[1e6, 0.0], [0.0, 2e6]], [[1e3, 0.0], [0.0, 1e3]], "stable at every speed from"),
        ([[1e6, 5e6], [-5e6, 1e6]], [[1e2, 0.0], [0.0, 1e2]], "unstable at every speed from"),
        ([[1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, 1.0]], "no static equilibrium at any speed from"),
    ],
)
def test_reason_where_there_is_no_threshold(linear_film, stiffness, damping, reason):
    found = whirl_threshold(linear_film(stiffness, damping), LOAD, MASS)
    assert not found.exists
    assert found.equilibrium is None
    assert found.reason.startswith(reason)


class GivesWayFilm:
    """A film that carries nothing between two speeds."""

    def __init__(self, film, low, high):
        self.film, self.low, self.high = film, low, high
        self.clearance, self.jacobian = film.clearance, film.jacobian

    def force(self, position, velocity, speed):
        carries = not self.low < speed < self.high
        return carries * self.film.force(position, velocity, speed)


def test_an_equilibrium_lost_in_mid_range_is_not_bridged(bearing):
    onset = whirl_threshold(bearing, LOAD, MASS).speed
    for low, high in ((0.7 * onset, 1.4 * onset), (0.3 * onset, 0.5 * onset)):
        film = GivesWayFilm(bearing, low, high)
        with pytest.raises(EquilibriumError, match="let the film carry the load: at speed") as caught:
            whirl_threshold(film, LOAD, MASS, (10.0, 10.0 * onset))
        assert low < float(str(caught.value).split("at speed ")[1].split()[0]) < high


def test_speeds_too_low_to_carry_the_load_are_passed_over(bearing):
    onset = whirl_threshold(bearing, LOAD, MASS).speed
    film = GivesWayFilm(bearing, 0.0, 0.5 * onset)
    assert whirl_threshold(film, LOAD, MASS).speed == pytest.approx(onset, rel=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_speed_parameter_is_the_speed_in_units_of_the_free_fall_across_the_clearance(sense):
    # load = weight: w = speed sqrt(c / g)
    found = speed_parameter(speed=sense * 100.0, clearance=1e-4, mass=7.0, load=[7.0 * 6.0, -7.0 * 8.0])
    assert found == pytest.approx(100.0 * math.sqrt(1e-4 / 10.0), rel=1e-14)


def test_threshold_outside_the_range_asked_for(bearing):
    onset = whirl_threshold(bearing, LOAD, MASS).speed
    assert whirl_threshold(bearing, LOAD, MASS, (10.0, 0.9 * onset)).reason.startswith(
        "stable at every speed"
    )
    assert whirl_threshold(bearing, LOAD, MASS, (1.1 * onset, 1e4)).reason.startswith(
        "unstable at every speed"
    )
    assert whirl_threshold(bearing, LOAD, MASS, (10.0, 1.1 * onset)).speed == pytest.approx(onset, rel=1e-10)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((LOAD, -1.0), "mass must be finite and positive, got -1.0"),
        (([0.0, 0.0], MASS), "load must not be zero"),
        ((LOAD, MASS, (0.0, 10.0)), "speed_range must be"),
        ((LOAD, MASS, (20.0, 10.0)), "speed_range must be"),
        ((LOAD, MASS, (1.0, math.nan)), "speed_range must be finite"),
    ],
)
def test_bad_arguments(bearing, arguments, message):
    with pytest.raises(InputError, match=message):
        whirl_threshold(bearing, *arguments)


PADS = TiltingPadBearing(
    radius=0.05,
    length=0.05,
    pad_clearance=1e-4,
    viscosity=0.02,
    pivots=tuple(np.radians([270.0, 342.0, 54.0, 126.0, 198.0])),
    extent=math.pi / 3.0,
    film=PadGridFilm(cells=(16, 4)),
)


@pytest.mark.parametrize("pads", [False, True])
def test_a_search_says_what_is_doubtful_of_the_threshold_alone(bearing, monkeypatch, pads):
    """Each rest says its speed: those of the scan and of the refinement are only passed."""

    def doubted(reaction, load, speed):
        warn_user(f"{speed!r}")
        return equilibrium(reaction, load, speed)

    monkeypatch.setattr(sys.modules["rotorfilm.analysis.whirl"], "equilibrium", doubted)
    unit = PADS.force_scale * 300.0
    case = (PADS, [0.0, -0.05 * unit], unit / 9.0, (200.0, 600.0)) if pads else (bearing, LOAD, MASS)
    with pytest.warns(ValidityWarning) as said:
        found = whirl_threshold(*case)
    assert {str(one.message) for one in said} == {f"{found.speed!r}"}
    assert not pads or found.equilibrium.pads.unloaded.any()
