"""The ladder of journal films: its reference, the errors it measures, and what it says of tension."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import FullFilm, Groove, InputError
from rotorfilm.bearings import HalfSommerfeld
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    ExtrapolatedFilm,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
    fitted_bearing,
    middle_pressure,
    tension,
)
from rotorfilm.core import to_plain, write_csv
from rotorfilm.studies import (
    LARGE,
    SMALL,
    StateRange,
    comparison_bearing,
    journal_accuracy,
    journal_rungs,
    pareto_front,
    random_states,
    reference_force,
    relative_error,
    study,
)
from rotorfilm.studies.journal_accuracy import SPEED, squeeze_share

CELLS = (384, 16)
WANTED = (
    "short film",
    "published (1, 1)",
    "fixed arc (2, all)",
    "rotating arc (2, all)",
    "free arc (4+c, 8)",
    "2-D 48 x 4",
    "2-D 96 x 8",
    "2-D 192 x 16",
    "map",
)


def chosen(*names):
    return [rung for rung in journal_rungs() if rung.name in names]


@pytest.fixture(scope="module")
def result():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study, "SHORTEST_RUN", 1e-4)  # no test reads how long a force takes
        return journal_accuracy(0.25, states=40, rungs=chosen(*WANTED), cells=CELLS, rounds=1)


def by_name(result):
    return {rung.name: rung for rung in result.rungs}


def test_names_of_the_rungs_are_unique():
    names = [rung.name for rung in journal_rungs()]
    assert len(set(names)) == len(names) >= 20


@pytest.mark.parametrize("slenderness", [0.25, 1.0])
def test_reference_and_map_agree_within_their_errors(slenderness):
    # Two solvers that share nothing: finite volumes with an active set, and a Ritz method with curved ends.
    bearing = comparison_bearing(slenderness)
    states = random_states(LARGE, count=60, clearance=bearing.clearance)
    reference, own = reference_force(bearing, states, cells=CELLS)
    assert np.quantile(own, 0.99) < 3e-4
    error = relative_error(bearing.force(*states), reference)
    assert np.median(error) < 3.0 * np.median(own)
    assert np.quantile(error, 0.99) < np.quantile(own, 0.99) + 2e-5


@pytest.mark.convergence
def test_estimated_error_of_the_reference_bounds_what_finer_grids_change():
    bearing = comparison_bearing(0.5)
    states = random_states(LARGE, count=40, clearance=bearing.clearance, seed=3)
    coarse, error = reference_force(bearing, states, cells=(128, 16))
    change = relative_error(coarse, reference_force(bearing, states, cells=(512, 16))[0])
    for share in (0.5, 0.99):
        assert np.quantile(change, share) < 1.5 * np.quantile(error, share)
    assert np.quantile(change, 0.99) > 0.02 * np.quantile(error, 0.99)


def test_states_fill_their_ranges():
    bearing = comparison_bearing(0.5)
    position, velocity, speed = states = random_states(LARGE, count=4000, clearance=bearing.clearance)
    ratio = np.hypot(*position) / bearing.clearance
    outward = position / np.hypot(*position)
    squeeze = np.sum(velocity * outward, axis=0) / (bearing.clearance * SPEED)
    whirl = (outward[0] * velocity[1] - outward[1] * velocity[0]) / (np.hypot(*position) * SPEED)
    for values, (lowest, highest) in ((ratio, (0.05, 0.95)), (squeeze, (-0.5, 0.5)), (whirl, (-0.5, 1.5))):
        span = highest - lowest
        assert lowest <= values.min() < lowest + 0.01 * span
        assert highest - 0.01 * span < values.max() <= highest
    assert np.all(speed == SPEED)
    assert 0.4 < squeeze_share(bearing, states) < 0.7  # strong squeeze is in it


def test_same_seed_gives_the_same_states():
    first, second, other = (random_states(SMALL, count=5, clearance=1.0, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.velocity, second.velocity)
    assert not np.array_equal(first.velocity, other.velocity)


def test_short_film_errs_as_documented():
    # docs/accuracy.md: 6 / 28 % (median / 90 %) against the converged film on the same arc, L/D .25.
    bearing = comparison_bearing(0.25)
    states = random_states(LARGE, count=400, clearance=bearing.clearance)
    exact = fitted_bearing(bearing, SpectralArcFilm(rupture=RotatingArc(), degree=16)).force(*states)
    error = relative_error(fitted_bearing(bearing, ShortFilm()).force(*states), exact)
    assert np.median(error) == pytest.approx(0.06, abs=0.015)
    assert np.quantile(error, 0.9) == pytest.approx(0.28, abs=0.08)


@pytest.mark.long
def test_errors_rank_the_rungs(result):
    rung = by_name(result)
    assert rung["map"]["99 % error [1]"] < result.conditions["reference error, 99 % [1]"] + 2e-5
    assert 3e-3 < rung["2-D 96 x 8"]["99 % error [1]"] < 8e-3
    assert (
        rung["rotating arc (2, all)"]["median error [1]"]
        < 0.2 * rung["fixed arc (2, all)"]["median error [1]"]
    )
    assert rung["fixed arc (2, all)"]["99 % error [1]"] > 1.0
    assert all(r["median error [1]"] <= r["99 % error [1]"] <= r["largest error [1]"] for r in result.rungs)


@pytest.mark.convergence
def test_two_dimensional_film_converges_with_its_order(result):
    errors = [
        by_name(result)[f"2-D {cells}"]["median error [1]"] for cells in ("48 x 4", "96 x 8", "192 x 16")
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, ReynoldsFilm.order, atol=0.1)


def test_each_family_is_closer_to_reynolds_rupture(result):
    names = ("published (1, 1)", "rotating arc (2, all)", "free arc (4+c, 8)", "map")
    rungs = [by_name(result)[name] for name in names]
    median, high = [rung["median error [1]"] for rung in rungs], [rung["99 % error [1]"] for rung in rungs]
    assert median[0] > 10.0 * median[1] > 100.0 * median[2] > 1000.0 * median[3]
    assert high[0] > 1.0 > high[1] > high[2] > 10.0 * high[3]
    assert median[3] < 1e-5
    assert high[3] < 1e-4


def test_only_the_fixed_arc_carries_tension(result):
    in_tension = {name for name, rung in by_name(result).items() if rung["states in tension [1]"] > 0.0}
    assert in_tension == {"published (1, 1)", "fixed arc (2, all)"}
    assert by_name(result)["fixed arc (2, all)"]["states in tension [1]"] > 0.5


def test_fixed_arc_carries_no_tension_at_rest_and_nothing_else_in_fast_whirl():
    e = np.array([[0.6, 0.6], [0.0, 0.0]])
    w = np.array([[0.0, 0.0], [-0.3, 0.3]])  # at rest; whirl at the full speed
    for film in (SplittingFilm(order=(2, None)), SpectralArcFilm()):
        np.testing.assert_allclose(tension(film, e, w, 0.5), [0.0, 1.0], atol=1e-9)
    for film in (ShortFilm(), MapFilm(), ReynoldsFilm(), SpectralArcFilm(rupture=ComplementarityArc())):
        np.testing.assert_allclose(tension(film, e, w, 0.5), 0.0, atol=1e-9)


@pytest.mark.closed_form
def test_full_film_at_rest_pulls_as_much_as_it_pushes():
    # Sommerfeld: without rupture the pressure of a static film is odd about the line of centers.
    e, w = np.array([[0.6], [0.0]]), np.array([[0.0], [-0.3]])
    full = ReynoldsFilm(cavitation=FullFilm())
    for film in (full, ExtrapolatedFilm(film=full)):
        np.testing.assert_allclose(tension(film, e, w, 0.5), 1.0, atol=1e-9)
    np.testing.assert_array_equal(tension(ReynoldsFilm(cavitation=HalfSommerfeld()), e, w, 0.5), 0.0)


def test_tension_of_a_film_that_nobody_knows_is_refused():
    class Unknown:
        force = jacobian = None

    with pytest.raises(InputError, match="film must be one whose pressure is known"):
        tension(Unknown(), np.zeros((2, 1)), np.ones((2, 1)), 0.5)


def test_fitted_bearing_keeps_what_the_film_does_not_touch():
    grooved = replace(comparison_bearing(0.5), film=ReynoldsFilm(), grooves=(Groove(center=1.0),))
    assert fitted_bearing(grooved, ReynoldsFilm(cells=(48, 4))).grooves == grooved.grooves
    with pytest.raises(InputError, match="film must represent the bearing's geometry"):
        fitted_bearing(grooved, ShortFilm())


@pytest.mark.parametrize("w", [(0.0, -0.3), (0.3, -0.1)])
def test_middle_pressure_is_that_of_the_two_dimensional_film(w):
    film = SplittingFilm(order=(16, None), constant=True, rupture=ComplementarityArc())
    e = np.array([0.6, 0.0])
    angle, pressure = middle_pressure(film, e[:, None], np.array(w)[:, None], 0.5)
    field = ReynoldsFilm(cells=(384, 16)).solve(e, np.array(w), 0.5)
    # gamma is measured from the line of maximum film, opposite to the journal at +x.
    there = np.interp(
        (angle[0] + np.pi) % (2.0 * np.pi), field.angle, field.pressure[:, 0], period=2.0 * np.pi
    )
    np.testing.assert_allclose(pressure[0], there, atol=5e-3 * field.pressure.max())


@pytest.mark.parametrize("order", [(1, 1), (2, 1), (4, 1)])
def test_pressure_of_the_first_axial_mode_makes_the_force(order):
    # With one axial mode the pressure is the middle one times sin(pi z/b), so the force is its integral.
    film, e, w = SplittingFilm(order=order), np.array([[0.5], [0.0]]), np.array([[0.2], [-0.3]])
    gamma, pressure = middle_pressure(film, e, w, 0.5)
    toward = np.stack([np.cos(gamma[0]), np.sin(gamma[0])])  # of the pressure's normal, from the maximum film
    integral = np.trapezoid(pressure[0] * toward, gamma[0], axis=1)
    # The film pushes the journal away from the wall: at gamma = pi (+x) towards -x.
    expected = 12.0 * (2.0 / np.pi) * integral
    np.testing.assert_allclose(film.force(e, w, 0.5)[:, 0], expected, rtol=5e-3)


def test_pareto_front_keeps_what_nothing_beats():
    costs, errors = [3.0, 1.0, 2.0, 1.0, 4.0], [0.1, 1.0, 2.0, 0.5, 0.1]
    assert pareto_front(costs, errors) == [3, 0]
    assert pareto_front([1.0], [1.0]) == [0]


def test_csv_round_trip(result, tmp_path):
    path = write_csv(tmp_path / "table.csv", result.columns())
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    assert [f"{row['family [-]']} {row['label [-]']}".strip() for row in rows] == list(by_name(result))
    for row, rung in zip(rows, result.rungs, strict=True):
        assert float(row["99 % error [1]"]) == pytest.approx(rung["99 % error [1]"], rel=1e-8)
        assert float(row["force in a batch [s]"]) == pytest.approx(rung["force in a batch [s]"], rel=1e-8)
        assert (int(row["states [1]"]), int(row["seed [-]"])) == (40, 1978)
    assert all("[" in heading for heading in rows[0])


def test_result_is_json(result):
    plain = json.loads(json.dumps(to_plain(result), allow_nan=False))
    assert plain["rungs"][0]["values"]["batch [1]"] >= 8


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: comparison_bearing(5.0), r"slenderness \(L/D\) must be from 0.1 to 4.0, got 5.0"),
        (lambda: comparison_bearing(-1.0), "slenderness must be finite and positive, got -1.0"),
        (lambda: journal_accuracy(0.5, states=0), "states must be an integer, at least 1, got 0"),
        (lambda: StateRange(eccentricity_ratio=(0.5, 1.0)), "eccentricity_ratio must rise within"),
        (lambda: journal_accuracy(0.5, states=4.5), "states must be an integer, at least 1, got 4.5"),
        (lambda: journal_accuracy(0.5, rounds=0), "rounds must be an integer, at least 1, got 0"),
        (lambda: journal_accuracy(0.5, rungs=[]), "rungs must hold at least one StudyModel"),
        (lambda: journal_accuracy(0.5, cells=(384, 20)), "cells must be two multiples of 16"),
        (
            lambda: random_states(LARGE, count=3, clearance=1.0, seed=-1),
            "seed must be an integer, at least 0",
        ),
        (lambda: StateRange(squeeze=np.inf), "squeeze must be a single finite number, got inf"),
        (lambda: StateRange(whirl=(-np.inf, 1.0)), "whirl must be a single finite number, got -inf"),
        (lambda: StateRange(squeeze=0.0), "squeeze and whirl must span a range, got 0.0"),
    ],
)
def test_mistakes_are_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
