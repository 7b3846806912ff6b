"""Published cases of a rolling ball: measures by closed forms, verdicts, ladder and limits on small grids."""

from dataclasses import replace

import numpy as np
import pytest
from studies import contact_cases as cases, contact_limits as limits
from studies.contact_cases import Claim, Statement, amplitude, overshoot, statements, unrest, wave_speed

from rotorfilm import ContactGrid, PointContact
from rotorfilm.bearings import ContactRun, FixedSteps, SineLoad, perturbed
from rotorfilm.charts import plot_study, save
from rotorfilm.studies import contact_precision, decay_time


def run_of(time, delta):
    unused = np.zeros_like(time)
    return ContactRun(
        time=time, delta=delta, velocity=unused, central_film=2.0 * delta, minimum_film=unused,
        carried_load=unused, driven=unused, snapshots=(), final=None, complete=True, work={},
        asked="", memory=None,
    )  # fmt: skip


@pytest.fixture(scope="module")
def decaying():
    # Steps as uneven as those of an adaptive run.
    time = np.cumsum(np.random.default_rng(0).uniform(0.05, 0.2, 400))
    return run_of(time, -1.8 + 0.3 * np.exp(-time / 12.0) * np.cos(1.25 * time))


@pytest.mark.closed_form
def test_measures_of_a_decaying_oscillation(decaying):
    assert decay_time(decaying, -1.8) == pytest.approx(12.0, rel=2e-3)
    first = (decaying.delta[0] + 1.8) / 0.3
    assert overshoot(decaying, -1.8) == pytest.approx(np.exp(-np.pi / 1.25 / 12.0) / first, rel=0.01)
    assert decay_time(run_of(decaying.time, -1.8 + np.exp(-decaying.time)), -1.8) == 0.0
    assert overshoot(run_of(decaying.time, -1.8 + np.exp(-decaying.time)), -1.8) < 1e-3


@pytest.mark.closed_form
def test_amplitude_is_half_the_range_between_samples_too():
    time = np.arange(0.0, 20.0, 0.7)
    run = run_of(time, 0.4 * np.sin(1.1 * time) - 1.8)
    assert np.ptp(run.delta) < 0.799  # the samples alone miss the peaks
    assert amplitude(run, 3.0) == pytest.approx(0.4, rel=5e-3)
    assert amplitude(run, 3.0, name="central_film") == pytest.approx(0.8, rel=5e-3)
    assert amplitude(run, 0.0, 0.7) == pytest.approx(0.2 * np.sin(0.77), rel=1e-2)


@pytest.mark.closed_form
def test_unrest_is_what_a_period_changes():
    time = np.arange(0.0, 40.0, 0.05)
    steady = run_of(time, np.sin(2.0 * time))
    assert unrest(steady, np.pi, 40.0) < 1e-4
    growing = run_of(time, np.sin(2.0 * time) + 0.02 * time)
    assert unrest(growing, np.pi, 39.9) == pytest.approx(0.02 * np.pi, rel=0.02)


@pytest.mark.closed_form
def test_wave_speed_is_that_of_a_crest():
    contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(48, 8)))
    rest = contact.state(np.zeros(contact.grid.shape), 0.5)
    x = contact.grid.x[:, None] + 0.0 * contact.grid.y

    def at(t):
        crest = 0.02 * np.exp(-((x + 0.4 - 0.8 * t) ** 2) / 0.02)
        return replace(rest, t=t, thickness=rest.thickness + crest)

    assert wave_speed([at(t) for t in (0.1, 0.3, 0.6, 0.9)], rest, contact.grid.x) == pytest.approx(
        0.8, rel=1e-2
    )


def test_verdicts():
    def verdict(*holds):
        return Statement.judged(*(Claim("4", "text", "what", (1.0,), flag) for flag in holds)).verdict

    assert verdict(True, True, True) == verdict(False, False, True) == "confirmed"
    assert verdict(True, False, False) == "artefact of numerical damping"
    assert verdict(True, True, False) == "artefact of the grid"
    assert verdict(False, True, False) == "not confirmed"


def curves_of(solution, decay):
    """Return made-up curves of all cases: oscillations at 1.25/sqrt(W) that decay in `decay` sqrt(W)."""
    time = np.linspace(0.0, 40.0, 801)
    rest, pressed, states = solution.rest, solution.pressed, []
    for t in cases.WAVE_TIMES:
        crest = 0.05 * np.exp(-((solution.contact.grid.x + 0.8 - t) ** 2) / 0.05)
        states.append(replace(rest, t=t, thickness=rest.thickness + crest[:, None]))

    def swing(W, at, size):
        late = np.maximum(time - at, 0.0)
        if W == 0.0:
            return size * np.exp(-late)
        return size * np.exp(-late / (decay * np.sqrt(W))) * np.cos(1.25 * late / np.sqrt(W))

    free = [replace(run_of(time, rest.delta + swing(W, 0.0, 0.3)), snapshots=states) for W in (0.0, 0.5, 1.0)]
    step = [
        run_of(
            time, np.where(time < 1.0, rest.delta, pressed.delta + swing(W, 1.0, rest.delta - pressed.delta))
        )
        for W in (0.3, 1.0, 3.0)
    ]
    driven = [run_of(time, rest.delta + size * np.sin(time)) for size in (0.3, 0.2, 0.1)]
    sweep = [run_of(time, rest.delta + size * np.sin(w * time)) for size, w in ((0.3, 1), (0.4, 2), (0.1, 5))]
    return {"4.1": free, "4.2": step, "4.3, A = 0.2": driven, "4.3, A = 0.5": sweep}


@pytest.fixture(scope="module")
def made_up():
    contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(48, 24)))
    rest = contact.stationary()
    pressed = contact.stationary(1.7, near=rest)
    names = ("published", "same grid", "converged")
    solutions = tuple(
        cases.CaseSolution(name, contact, rest, pressed, FixedSteps(step=0.2)) for name in names
    )
    made = [curves_of(s, decay) for s, decay in zip(solutions, (6.0, 60.0, 60.0), strict=True)]
    curves = {
        section: [
            cases.CaseRun(name, tuple(one[section][k] for one in made)) for k, (name, _) in enumerate(plan)
        ]
        for section, plan in cases.case_plan(40.0).items()
    }
    claims = [statements(one, solution) for one, solution in zip(made, solutions, strict=True)]
    rows = [Statement.judged(*row) for row in zip(*claims, strict=True)]
    return cases.ContactCases(solutions, curves, rows)


@pytest.mark.closed_form
def test_statements_judge_known_curves(made_up):
    verdicts = {(row.text, row.measure): row for row in made_up.statements}
    by_text = {text: row for (text, _), row in verdicts.items()}
    ratio = by_text["almost twice as long for W = 1 as for W = 0.5"]
    assert float(ratio.converged) == pytest.approx(np.sqrt(2.0), rel=0.01)
    assert ratio.verdict == "not confirmed"
    left = by_text["for W = 0.3 they have decayed wholly before the load falls, for W = 3 not"]
    assert left.verdict == "artefact of numerical damping"
    wave = by_text["a modulation of the film moves along the contact at the rolling speed, to 10 %"]
    assert float(wave.converged.split(",")[0]) == pytest.approx(1.0, abs=0.03)
    assert wave.verdict == "confirmed"
    decay = by_text["the decay takes longer with larger W"]
    found = [float(number) for number in decay.published.split(",")]
    assert found == pytest.approx([6.0 * np.sqrt(0.5), 6.0], rel=0.02)
    for name in ("delta", "H0"):
        assert by_text[f"omega = 2 has the largest amplitude of {name}"].verdict == "confirmed"
        assert by_text[f"the amplitude of {name} falls with W"].verdict == "confirmed"


@pytest.mark.long
def test_cases_become_a_table_curves_and_figures(made_up, tmp_path):
    table = made_up.columns()
    assert set(table["section"]) == {"4", "4.1", "4.2", "4.3"}
    series = made_up.series()
    assert {len(column) for column in series.values()} == {12 * 3 * 801}
    axes = cases.plot_contact_cases(made_up)
    assert len(axes) == 12
    assert save(axes[0], tmp_path / "cases.png").stat().st_size > 50_000


@pytest.mark.long
def test_cases_run_by_a_plan(monkeypatch):
    # All that a case takes from a solution, on a grid so coarse that it costs nothing.
    monkeypatch.setattr(cases, "statements", lambda runs, solution: [])
    told = []

    def free(solution):
        return cases.loaded_motion(solution, W=1.0, load=lambda t: 1.1, duration=0.4)

    monkeypatch.setattr(cases, "case_plan", lambda settle: {"4.1": [("W = 1", free)]})
    result = cases.contact_cases(24, tolerance=1e-2, report=lambda fraction, text: told.append(fraction))
    assert [run.time[-1] for run in result.curves["4.1"][0].runs] == pytest.approx([0.4] * 3)
    assert told == sorted(told)


@pytest.mark.long
@pytest.mark.literature
def test_the_published_scheme_contradicts_figures_6_and_7():
    # Its text has amplitudes that fall with W, and omega = 2 with the largest.
    # Euler takes (1 - exp(-i omega dt))/dt for i omega.
    contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(16, 12)))
    rest = contact.stationary()
    small, k, c, dt = 0.02, 1.54, 0.03, 0.2

    def amplitudes(W, omega):
        load = SineLoad(amplitude=small, frequency=omega)
        control = FixedSteps(step=dt, order=1)
        run = contact.simulate(rest, duration=18.0, W=W, load=load, control=control)
        s = (1.0 - np.exp(-1j * omega * dt)) / dt
        return amplitude(run, 18.0 - 2.0 * np.pi), 2.0 * np.pi / 3.0 * small / abs(W * s**2 + c * s + k)

    (light, by_hand), (heavy, by_hand_too) = amplitudes(0.1, 1.0), amplitudes(1.0, 1.0)
    assert (light, heavy) == pytest.approx((by_hand, by_hand_too), rel=0.05)
    assert heavy > 2.0 * light
    assert heavy > 2.0 * amplitudes(1.0, 2.0)[0]


@pytest.mark.literature
@pytest.mark.long
def test_published_step_halves_the_travelling_film_and_hides_the_decay():
    # Case 4.1 on 24 cells: decay times 3.2 and 6.0 by the published steps, 50 to 70 by the equations.
    contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(24, 24)))
    rest = contact.stationary()
    start = perturbed(contact, rest, -0.2)
    times = {}
    for W in (0.5, 1.0):
        for name, control in (("Euler", FixedSteps(step=0.2, order=1)), ("BDF2", FixedSteps(step=0.05))):
            run = contact.simulate(start, duration=14.0, W=W, control=control, snapshots=(0.8,))
            times[name, W] = decay_time(run, rest.delta, 2.0)
            times[name, W, "wave"] = np.ptp((run.snapshots[0].thickness - rest.thickness)[12:19, 0])
    assert times["Euler", 0.5] == pytest.approx(3.2, rel=0.03)
    assert times["Euler", 1.0] == pytest.approx(6.0, rel=0.03)
    assert 1.7 < times["Euler", 1.0] / times["Euler", 0.5] < 2.3
    assert times["BDF2", 1.0] / times["BDF2", 0.5] < 1.4
    assert times["BDF2", 0.5] > 40.0
    assert times["Euler", 1.0, "wave"] < 0.8 * times["BDF2", 1.0, "wave"]


@pytest.mark.long
@pytest.mark.closed_form
def test_limits_are_those_of_the_scheme(monkeypatch):
    monkeypatch.setattr(limits, "SPAN", 1.0)
    result = limits.contact_limits(24, steps=(0.1, 1.0), amplitudes=(0.5, 60.0), inertias=(1.0,))
    assert np.isinf(result.reached[0, 0])
    assert np.isfinite(result.reached[1, 1])
    # Euler damps at k dt/(2 W) in first order, beside which the physical damping is little.
    assert result.shown[0, 0] == pytest.approx(2.0 / (1.57 * 0.1 + 2.0 / result.physical[0]), rel=0.03)
    assert 40.0 < result.physical[0] < 90.0
    assert result.columns()["time of failure or decay time"].count(None) == np.isinf(result.reached).sum()
    assert len(limits.plot_contact_limits(result)) == 2


@pytest.mark.long
def test_ladder_ranks_time_schemes_and_reduced_laws():
    result = contact_precision(32, duration=2.0, tolerance=1e-4, orders=(2, 5))
    errors = {rung.name: rung["rms error of delta"] for rung in result.rungs}
    assert errors["Euler, 24 cells, dt 0.2"] > 3.0 * errors["BDF2, 24 cells, dt 0.1"]
    assert errors["reduced law, order 5"] < errors["reduced law, order 2"]
    assert len(result.columns()["cost [s]"]) == len(result.rungs)
    plot_study(result)
