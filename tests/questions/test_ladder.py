"""The walk up a ladder, on rungs made for it: what is chosen, refused, skipped, and what it costs."""

import math

import pytest
from hypothesis import given, strategies as st

from rotorfilm import FilmContactError, InputError, RotorfilmError
from rotorfilm.core.answers import ErrorEstimate, Ladder, RungResult, WorkUnit, beside_bound
from rotorfilm.questions.walk import Meter, walk

CALLS, MAPS, GRIDS = WorkUnit("calls"), WorkUnit("maps", nominal=7.0), WorkUnit("grids")


class Made:
    """A rung with a given error and work."""

    refines = ()
    shares = None

    def __init__(self, name, error, prior=0.0, work=1, doubt="", fails=False):
        self.name, self.error, self.prior, self.work, self.doubt, self.fails = (
            name,
            error,
            prior,
            work,
            doubt,
            fails,
        )
        self.asked = 0

    def answer(self, before):
        self.asked += 1
        if self.fails:
            raise self.fails if isinstance(self.fails, RotorfilmError) else RotorfilmError("the film cannot")
        return RungResult(1.0 + self.error, {CALLS: self.work})

    def estimate(self, found, before, tolerance):
        return ErrorEstimate(self.error, "by construction", doubt=self.doubt)

    def expected(self, done):
        return {CALLS: 10 * sum(done.values())}


def ladder(*rungs, refined=""):
    for rung in rungs:
        rung.refines = (ladder,) if rung.name in refined else ()
    return Ladder(rungs=rungs, unit="m", units={CALLS: lambda: None})


def test_first_rung_below_the_tolerance_is_chosen_and_the_rest_is_not_asked():
    rungs = [Made("a", 1e-1), Made("b", 1e-2), Made("c", 1e-3), Made("d", 1e-4)]
    answer = walk("wear", ladder(*rungs), 2e-3)
    assert (answer.model, answer.met, answer.error_estimate) == ("c", True, 1e-3)
    assert [report.verdict for report in answer.rungs] == ["refused", "refused", "chosen", "not needed"]
    assert rungs[3].asked == 0
    assert answer.next_model == "d"
    assert "1.5 x 0.1 is above the tolerance 0.002" in answer.rungs[0].reason


def test_margin_of_the_estimate_is_kept():
    assert not walk("wear", ladder(Made("a", 1e-3)), 1.4e-3).met
    assert walk("wear", ladder(Made("a", 1e-3)), 1.6e-3).met


def test_doubtful_estimate_is_refused_however_small():
    answer = walk("wear", ladder(Made("a", 1e-6, doubt="not linear"), Made("b", 1e-3)), 1e-2)
    assert answer.model == "b"
    assert answer.rungs[0].reason == "not linear"


def test_rung_without_an_answer_is_passed_over_with_its_reason():
    answer = walk("wear", ladder(Made("a", 0.0, fails=True), Made("b", 1e-3)), 1e-2)
    assert (answer.model, answer.rungs[0].reason) == ("b", "the film cannot")
    with pytest.raises(RotorfilmError, match="the film cannot"):
        walk("wear", ladder(Made("a", 0.0, fails=True)), 1e-2)


def test_rung_known_to_be_worse_than_a_refused_one_is_skipped():
    rungs = [Made("a", 1e-3), Made("b", 5e-2, prior=1e-2), Made("c", 1e-5, prior=1e-6)]
    answer = walk("wear", ladder(*rungs), 1e-4)
    assert answer.model == "c"
    assert rungs[1].asked == 0
    assert answer.rungs[1].verdict == "skipped"
    assert "a is closer and was refused" in answer.rungs[1].reason


def test_where_no_rung_meets_the_tolerance_the_closest_answers_and_says_so():
    answer = walk("wear", ladder(Made("a", 1e-2), Made("b", 1e-5), Made("c", 1e-4)), 1e-9)
    assert (answer.met, answer.model, answer.value) == (False, "b", 1.0 + 1e-5)
    assert answer.message == "no model meets the tolerance 1e-09; the closest is b, with an error of 1e-05"
    assert answer.next_model is None


def test_closest_of_refused_rungs_is_not_one_in_doubt():
    answer = walk("wear", ladder(Made("a", 1e-6, doubt="not linear"), Made("b", 1e-3)), 1e-9)
    assert answer.model == "b"


def test_cost_is_work_times_unit_cost():
    meter = Meter(Ladder(rungs=(), unit="m", units={CALLS: lambda: sum(range(20000))}))
    one = meter.predict({CALLS: 1})
    assert one > 0.0
    assert meter.cost({CALLS: 5}, 99.0) == pytest.approx(5.0 * one)
    assert meter.predict({MAPS: 2}) == 14.0
    assert math.isnan(meter.predict({WorkUnit("unknown"): 1}))
    assert meter.cost({GRIDS: 4}, 2.0) == pytest.approx(2.0)
    assert meter.predict({GRIDS: 6}) == pytest.approx(3.0)


def test_cost_of_the_next_rung_is_predicted_from_the_work_done():
    answer = walk("wear", ladder(Made("a", 1e-3, work=4), Made("b", 1e-5)), 1e-2)
    assert answer.next_cost == pytest.approx(10.0 * answer.cost)


@given(
    errors=st.lists(st.floats(1e-9, 1.0), min_size=1, max_size=8),
    factors=st.lists(st.floats(1e-3, 3.0), min_size=8, max_size=8),
    refined=st.text("01234567"),
    tolerances=st.tuples(st.floats(1e-9, 1.0), st.floats(1e-9, 1.0)),
)
def test_tighter_tolerance_never_chooses_a_less_accurate_rung(errors, factors, refined, tolerances):
    rungs = [Made(str(k), error, prior=error * factors[k]) for k, error in enumerate(errors)]
    loose, tight = (
        walk("wear", ladder(*rungs, refined=refined), t) for t in (max(tolerances), min(tolerances))
    )
    if loose.met:
        assert tight.error_estimate <= loose.error_estimate
        assert int(tight.model) >= int(loose.model) or not tight.met


def test_steps_are_not_refined_where_that_no_longer_helps():
    rungs = [Made("a", 0.5), Made("b", 0.3), Made("c", 0.296), Made("d", 0.29), Made("e", 0.2)]
    answer = walk("wear", ladder(*rungs, refined="abcd"), 0.1)
    assert [report.verdict for report in answer.rungs] == [
        "refused",
        "refused",
        "refused",
        "skipped",
        "refused",
    ]
    assert answer.rungs[3].reason == "finer steps do not help: b has an error of 0.3, c of 0.3"
    assert [rung.asked for rung in rungs] == [1, 1, 1, 0, 1]


def test_contact_found_by_the_richest_rung_that_found_anything_is_the_answer():
    below, wall = Made("a", 0.5), Made("b", 0.1, fails=FilmContactError("to the wall"))
    with pytest.raises(FilmContactError, match="to the wall"):
        walk("wear", ladder(below, wall, Made("c", 0.1, fails=True)), 1e-2)
    assert walk("wear", ladder(below, wall, Made("d", 1e-3)), 1e-2).model == "d"


def test_two_errors_of_a_bound_add_up():
    kept = beside_bound(9e-4, 1e-3, "defect", {})
    assert (kept.error, kept.bound) == (pytest.approx(1.9e-3), True)
    about = beside_bound(2e-3, 1e-3, "defect", {})
    assert (about.error, about.bound) == (2e-3, False)


def test_tolerance_must_be_positive():
    with pytest.raises(InputError, match=r"tolerance must be finite and positive, got 0.0"):
        walk("wear", ladder(Made("a", 1.0)), 0.0)


class Apart(Made):
    """A rung with a value of its own beside an error that it claims."""

    def __init__(self, name, value, error, doubt=""):
        super().__init__(name, error, doubt=doubt)
        self.value = value

    def answer(self, before):
        return RungResult(self.value, {CALLS: self.work})


def test_a_refused_rung_keeps_no_estimate_that_a_richer_one_contradicts():
    """Their values are farther apart than both estimates: the cheaper one is off by that distance."""
    rungs = ladder(Apart("cheap", 1.567, 0.029), Apart("between", 1.5, 1.3), Apart("rich", 0.671, 0.05))
    answer = walk("wear", rungs, 1e-3)
    assert (answer.model, answer.value, answer.error_estimate) == ("rich", 0.671, 0.05)
    cheap, between, _ = answer.rungs
    assert cheap.error_estimate == pytest.approx(1.567 / 0.671 - 1.0)
    assert cheap.reason.endswith("; rich is 1.3 away")
    assert between.error_estimate == 1.3  # which says as much itself


def test_a_contradiction_by_a_rung_in_doubt_leaves_no_trust():
    rungs = ladder(Apart("cheap", 1.5, 0.03), Apart("rich", 1.0, 0.1, doubt="not linear"))
    answer = walk("wear", rungs, 1e-3)
    assert answer.model == "rich"
    assert answer.message == "no model can be trusted; the closest may be rich: not linear"


def test_angles_and_errors_of_schemes_are_compared_as_the_ladder_says():
    rungs = (Apart("cheap", 1e-9, 0.01), Apart("rich", 2e-9, 0.02))
    alike = Ladder(rungs=rungs, unit="rad", distance=lambda angle, other: abs(angle - other))
    assert walk("attitude_angle", alike, 1e-3).error_estimate == 0.01
    assert walk("wear", ladder(*rungs), 1e-3).error_estimate == 0.02
