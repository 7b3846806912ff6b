from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import CouplingError, InputError
from rotorfilm.cosim import GaussSeidel, InProcessSlave, couple, critical_macro_step, inspect_coupling
from rotorfilm.cosim.partners import Partners

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

STEPS = np.arange(200.0)
ALTERNATION = (-1.0) ** STEPS


def inspected(x, y=None):
    force = np.stack([x, np.zeros_like(x) if y is None else y])
    return inspect_coupling(np.arange(force.shape[1]), force)


def run(case, degrees, steps):
    step = np.radians(degrees)
    return couple(
        InProcessSlave(case.rotor), InProcessSlave(case.film), macro_step=step, duration=steps * step
    )


@pytest.mark.closed_form
def test_a_saturated_alternation_is_found_with_its_amplitude():
    report = inspected(1.0 + 0.05 * ALTERNATION)
    assert report.chatter
    assert report.onset == 0.0
    assert_allclose(report.amplitude, 0.05 / np.sqrt(1.0 + 0.05**2), rtol=1e-12)


def test_an_alternation_is_found_where_it_begins():
    report = inspected(1.0 + 0.1 * ALTERNATION * (STEPS >= 100))
    assert report.chatter
    assert 90 <= report.onset <= 102


def test_an_alternation_on_top_of_a_resolved_motion_is_found():
    angle = np.radians(10.0) * STEPS
    assert inspected(np.cos(angle) + 0.05 * ALTERNATION, np.sin(angle)).chatter


def test_an_irregular_alternation_is_found():
    flips = ALTERNATION * (1.0 + 0.4 * np.sin(1.7 * STEPS))
    flips[::9] *= 0.2
    assert inspected(1.0 + 0.3 * flips).chatter


@pytest.mark.parametrize("ratio", [0.8, 0.95, 0.99])
def test_it_matters_whether_an_alternation_decays_or_grows(ratio):
    assert not inspected(1.0 + 0.5 * ALTERNATION * ratio**STEPS).chatter
    assert inspected(1.0 + 0.5 * ALTERNATION * ratio ** (STEPS[-1] - STEPS)).chatter


@pytest.mark.parametrize(
    "force",
    [
        np.zeros(200),
        np.ones(200),
        np.where(STEPS < 100, 1.0, 2.0),
        np.where(STEPS == 100, 50.0, 1.0),
        np.exp(-STEPS / 20.0),
        STEPS**2,
        np.cos(np.radians(20.0) * STEPS),
        1.0 + np.abs(np.sin(np.radians(10.0) * STEPS)),
        1.0 + 1e-3 * ALTERNATION,
        1.0 + 1e-9 * np.random.default_rng(1).standard_normal(200),
    ],
    ids=["zero", "constant", "step", "spike", "decay", "growth", "20 deg", "kinks", "tiny", "noise"],
)
def test_resolved_forces_do_not_alarm(force):
    report = inspected(force)
    assert not report.chatter
    assert report.onset is None
    assert report.amplitude == 0.0


def test_a_coarsely_resolved_rotating_force_does_not_alarm():
    angle = np.radians(75.0) * STEPS
    assert not inspected(np.cos(angle), np.sin(angle)).chatter


def test_a_run_too_short_to_judge_is_not_judged():
    for count in (0, 1, 2, 3, 13):
        assert not inspected(1.0 + 0.1 * ALTERNATION[:count]).chatter


@pytest.mark.closed_form
def test_bursts_of_a_force_that_jumps_make_a_run_coarse():
    angle = np.radians(2.0) * np.arange(721)
    burst = np.where(abs(np.arange(721) - 404) < 4, 5.0 * (-1.0) ** np.arange(721), 1.0)
    report = inspected(burst * np.cos(angle), burst * np.sin(angle))
    assert report.coarse
    assert not report.chatter
    assert report.onset == pytest.approx(395.0, abs=7.0)
    assert not inspected(np.cos(angle), np.sin(angle)).coarse


def test_short_runs_are_judged_as_well():
    assert inspected(np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0]), np.zeros(6)).coarse
    assert not inspected(np.array([1.0]), np.zeros(1)).coarse


def test_hold_defect_of_a_rotating_force_is_the_sine_of_half_the_step():
    angle = np.radians(8.0) * STEPS
    assert_allclose(inspected(np.cos(angle), np.sin(angle)).hold_defect, np.sin(np.radians(4.0)), rtol=1e-12)


def test_the_report_does_not_depend_on_the_unit_of_force():
    force = 1.0 + 0.05 * ALTERNATION
    assert_allclose(inspected(1e-9 * force).amplitude, inspected(1e9 * force).amplitude, rtol=1e-12)


# Below the limit: 14.75 deg at eps .7, 10.1 deg at eps .9; transients, orbits and steps must not alarm.
@pytest.mark.parametrize(
    ("eccentricity", "w", "unbalance", "offset", "degrees"),
    [
        (0.7, 1.0, 0.0, -0.02, 13.0),
        (0.7, 1.0, 0.0, -0.3, 10.0),
        (0.9, 1.0, 0.0, -0.01, 9.0),
        (0.9, 1.0, 0.0, -0.5, 5.0),
        (0.7, 1.0, 0.3, 0.0, 4.0),
        (0.8, 1.0, 0.5, 0.0, 2.0),
        (0.9, 1.0, 0.3, 0.0, 1.0),
        (0.5, 2.0, 0.5, 0.0, 10.0),
        (0.3, 1.5, 0.7, 0.0, 9.0),
    ],
)
def test_good_runs_do_not_alarm(nondimensional, eccentricity, w, unbalance, offset, degrees):
    case = nondimensional(eccentricity, w=w, unbalance=unbalance, offset=(offset, 0.0))
    assert not run(case, degrees, int(4 * 360 / degrees)).coupling.chatter


def test_film_at_a_sudden_load_does_not_alarm(nondimensional):
    case = nondimensional(0.3)
    heavier = replace(case, rotor=replace(case.rotor, static_force=(3.0, 1.0)))
    assert not run(heavier, 3.0, 400).coupling.chatter


@pytest.mark.parametrize("factor", [1.02, 1.2, 1.3, 1.5])
@pytest.mark.parametrize(("eccentricity", "limit"), [(0.7, 14.753), (0.9, 10.136)])
def test_plausible_runs_past_the_limit_are_caught(nondimensional, eccentricity, limit, factor):
    case = nondimensional(eccentricity, offset=(-0.005, 0.0))
    with pytest.raises(CouplingError, match="macro_step must be below the stability limit") as caught:
        run(case, factor * limit, 120)
    result = caught.value.partial
    assert result.coupling.chatter
    assert 16 <= result.trajectory.time.size <= 121  # it is stopped as soon as it is sure
    assert result.watch.warnings
    assert result.watch.spectral_radius > 0.95 * factor


def test_what_is_caught_looks_like_an_answer(nondimensional):
    """20 % past the limit at eps .9: the mean force is right, the position steady but 3-7 % of C off."""
    case = nondimensional(0.9)
    rotor = replace(case.rotor, position=tuple(0.999 * case.state[:2]))
    step, scheme = np.radians(12.16), GaussSeidel()
    bench = Partners(InProcessSlave(rotor), {"": InProcessSlave(case.film)}, scheme.needs)
    samples = [bench.start()]
    for n in range(400):  # as `couple`, but without its watch
        samples.append(scheme.step(bench, samples[-4:], n * step, step))
    forces = np.array([sample.force for sample in samples])
    positions = np.array([sample.motion.position for sample in samples])
    assert_allclose(forces[200:, 0].mean(), -1.0, atol=0.01)
    assert 1.4 < np.abs(forces[:, 0]).max() < 2.4
    assert_allclose(np.ptp(positions[200:], axis=0), 0.0, atol=1e-3)
    assert 0.03 < np.hypot(*(positions[-1] - case.state[:2])) < 0.07
    with pytest.raises(CouplingError, match="macro_step must be below the stability limit") as caught:
        run(replace(case, rotor=rotor), 12.16, 400)
    assert caught.value.partial.trajectory.time.size < 200


# A rotating eccentricity passes the local limit on part of the orbit only.
@pytest.mark.parametrize(
    ("eccentricity", "w", "unbalance", "degrees"),
    [(0.7, 1.0, 0.3, 9.0), (0.5, 1.0, 0.6, 18.0), (0.8, 1.0, 0.5, 4.0), (0.5, 2.0, 0.5, 20.0)],
)
def test_chatter_on_part_of_an_orbit_is_caught(nondimensional, eccentricity, w, unbalance, degrees):
    case = nondimensional(eccentricity, w=w, unbalance=unbalance)
    with pytest.raises(CouplingError, match="macro_step must be"):
        run(case, degrees, int(20 * 360 / degrees))


def test_bad_input_is_named():
    with pytest.raises(InputError, match=r"force must have shape \(k, 3\), got \(2, 4\)"):
        inspect_coupling([0.0, 1.0, 2.0], np.zeros((2, 4)))
    with pytest.raises(InputError, match="force must be finite"):
        inspect_coupling([0.0, 1.0], np.full((2, 2), np.nan))


@pytest.mark.parametrize(
    ("unbalance", "fraction", "steps"), [(0.2, 0.7, 600), (0.3, 0.7, 60), (0.3, 0.3, 200)]
)
def test_a_journal_thrown_past_the_local_limit_is_no_answer(nondimensional, unbalance, fraction, steps):
    # Below the critical macro step of the equilibrium the orbit reaches eccentricities where it is shorter.
    case = nondimensional(0.9, 1.0, unbalance=unbalance)
    limit = critical_macro_step(case.rotor, case.film, state=case.rotor.initial_state).macro_step
    with pytest.raises(CouplingError, match="macro_step must be") as caught:
        run(case, np.degrees(fraction * limit), steps)
    assert caught.value.partial.coupling.coarse or caught.value.partial.coupling.chatter
