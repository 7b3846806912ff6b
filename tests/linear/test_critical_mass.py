import numpy as np
import pytest

from rotorfilm import Coefficients, LinearBearing, whirl_threshold
from rotorfilm.analysis import critical_mass
from rotorfilm.analysis.whirl import is_stable


def film(stiffness, damping, speed=1.0):
    return Coefficients(
        stiffness=np.array(stiffness, dtype=float),
        damping=np.array(damping, dtype=float),
        position=np.zeros(2),
        speed=speed,
    )


def roots(at, mass):
    """Return the eigenvalues of m q'' + C q' + K q = 0."""
    lower = np.hstack([-at.stiffness, -at.damping]) / mass
    return np.linalg.eigvals(np.vstack([np.hstack([np.zeros((2, 2)), np.eye(2)]), lower]))


def random_films(count):
    rng = np.random.default_rng(1)
    for _ in range(count):
        yield film(*rng.normal(size=(2, 2, 2)) + 1.5 * np.eye(2), speed=rng.uniform(-2, 2))


@pytest.mark.closed_form
def test_border_is_where_an_eigenvalue_crosses():
    found = 0
    for at in random_films(300):
        border = critical_mass(at)
        if border.mass is None:
            continue
        found += 1
        rightmost = max(roots(at, border.mass), key=lambda root: (round(root.real, 6), root.imag))
        assert rightmost == pytest.approx(1j * border.whirl_frequency, abs=1e-8)
        assert roots(at, 0.99 * border.mass).real.max() < 0 < roots(at, 1.01 * border.mass).real.max()
        assert border.whirl_ratio == pytest.approx(border.whirl_frequency / abs(at.speed))
        assert border.reason == ""
    assert found > 50


@pytest.mark.closed_form
def test_reasons_tell_the_truth_for_light_and_heavy_rotors():
    seen = set()
    for at in random_films(300):
        reason = critical_mass(at).reason
        seen.add(reason)
        stable = [bool(roots(at, mass).real.max() < 0) for mass in (1e-3, 1e3)]
        if reason.startswith("stable whatever"):
            assert stable == [True, True]
        elif "unstable whatever" in reason or "statically unstable" in reason:
            assert stable == [False, False]
        elif "not positive" in reason:
            assert not stable[0]
    assert len(seen) == 5


@pytest.mark.closed_form
def test_routh_agrees_with_the_eigenvalues():
    verdicts = set()
    for at in random_films(300):
        for mass in (0.1, 1.0, 10.0):
            verdict = is_stable(at, mass)
            assert verdict == bool(roots(at, mass).real.max() < 0)
            verdicts.add(verdict)
    assert verdicts == {True, False}


@pytest.mark.closed_form
def test_symmetric_axes_in_closed_form():
    # K = k + q J, C = c: whirl at q / c, and k = m (q / c)^2
    border = critical_mass(film([[9.0, 6.0], [-6.0, 9.0]], [[3.0, 0.0], [0.0, 3.0]], speed=4.0))
    assert border.whirl_frequency == pytest.approx(2.0)
    assert border.mass == pytest.approx(9.0 / 4.0)
    assert border.whirl_ratio == pytest.approx(0.5)


@pytest.mark.parametrize("angle", np.linspace(0.0, np.pi, 7))
def test_damping_of_rank_one_gives_a_reason_in_any_axes(angle):
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    damping = R @ np.outer([1.0, 3.0], [2.0, 1e-3]) @ R.T
    border = critical_mass(film(R @ [[2.0, 1.0], [-1.0, 2.0]] @ R.T, damping))
    assert border.mass is None
    assert "rank 1" in border.reason


@pytest.mark.closed_form
def test_skew_damping_does_no_work():
    """As a gyroscopic force: all motion of a rotor on springs is neutral, of any mass."""
    at = film(1e6 * np.eye(2), [[0.0, 500.0], [-500.0, 0.0]], speed=100.0)
    for mass in (0.1, 10.0, 1e3):
        assert np.abs(roots(at, mass).real).max() < 1e-9 * np.abs(roots(at, mass)).max()
    assert critical_mass(at).reason.startswith("damping does no work (C = -C^T): whirl neither grows nor")
    bearing = LinearBearing(stiffness=1e6, damping=((0.0, 500.0), (-500.0, 0.0)))
    onset = whirl_threshold(bearing, [0.0, -100.0], 10.0, speed_range=(1.0, 1e4))
    assert onset.speed is None
    assert onset.reason == critical_mass(at).reason


def test_whirl_ratio_needs_rotation():
    border = critical_mass(film([[9.0, 6.0], [-6.0, 9.0]], 3.0 * np.eye(2), speed=0.0))
    assert border.whirl_ratio is None
    assert border.whirl_frequency == pytest.approx(2.0)
