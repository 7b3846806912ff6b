"""Charts of a ladder: verdicts, marks and labels."""

import numpy as np
import pytest

from rotorfilm.charts import (
    NoteMark,
    new_axes,
    plot_journal_stability,
    plot_study,
    plot_thresholds,
    verdict_table,
)
from rotorfilm.charts.canvas import FAMILY_COLORS, FAMILY_WIDTHS, place_labels
from rotorfilm.charts.whirl_verdicts import verdicts
from rotorfilm.studies import StudyResult, StudyRow, journal_rungs
from rotorfilm.studies.journal_stability import by_film


def accuracy(family, time, error):
    values = {
        "median error [1]": 0.1 * error,
        "99 % error [1]": error,
        "force in a batch [s]": time,
        "force alone, prepare() [s]": 10.0 * time,
    }
    return StudyRow(name=family, family=family, label="x", case="", values=values)


def stability(family, parameters, exact, *, rank_one=0, asymmetry=0.0, share=0.0):
    rows = []
    for ratio, parameter, right in zip((0.2, 0.5, 0.9), parameters, exact, strict=True):
        gap = None if None in (parameter, right) else parameter / right - 1.0
        values = {
            "eccentricity ratio [1]": ratio,
            "speed sqrt(c m/W) [1]": parameter,
            "reference [1]": right,
            "deviation [1]": gap,
            "deviation above 0.05 [-]": int(gap is not None and abs(gap) > 0.05),
            "none where the reference has one [-]": int(right is not None and parameter is None),
            "one where the reference has none [-]": int(right is None and parameter is not None),
            "damping of rank one [-]": rank_one,
            "|Cxy - Cyx|/max|C| [1]": asymmetry,
            "tension/largest pressure at rest [1]": 0.0,
            "states of large motion in tension [1]": share,
        }
        rows.append(StudyRow(name=f"{family} x", family=family, label="x", case="", values=values))
    return rows


@pytest.fixture
def thresholds():
    exact = (2.6, 2.5, None)
    return StudyResult(
        study="stability",
        reference="2-D",
        conditions={"length/diameter [1]": 0.5, "error of the reference [1]": 1e-3},
        rungs=(
            *stability("map", exact, exact),
            *stability("fixed arc", (2.6, 2.0, 4.0), exact, share=0.8),
            *stability("published", (None, None, None), exact, rank_one=1, asymmetry=0.5),
        ),
    )


def test_every_family_has_a_color_and_a_width():
    assert {rung.family for rung in journal_rungs()} == set(FAMILY_COLORS) == set(FAMILY_WIDTHS)
    assert len(set(FAMILY_WIDTHS.values())) == len(FAMILY_WIDTHS)
    assert len(set(FAMILY_COLORS.values())) == len(FAMILY_COLORS)


def test_verdicts_tell_the_four_faults(thresholds):
    good, fixed, first = map(verdicts, by_film(thresholds).values())
    assert good == ("0 %", "nowhere", "none", "0")
    assert fixed == ("20 %", "0.5 to 0.9", "80 % of states", "0")
    assert first == ("rank-1 damping", "0.2 to 0.5", "none", "50 %")
    table = verdict_table(thresholds)
    assert list(table.columns[1].values) == ["0 %", "20 %", "rank-1 damping"]


def test_stability_marks_missing_thresholds_and_dots_wrong_ones(thresholds):
    picture = plot_journal_stability(thresholds)
    top, below = picture.panels
    (crosses,) = [one for one in top.marks if getattr(one, "marker", "") == "x"]
    np.testing.assert_array_equal(crosses.x, [0.2, 0.5])
    np.testing.assert_array_equal(top.curves["fixed arc"].y, [2.6, np.nan, np.nan])
    assert top.curves["fixed arc"].width == FAMILY_WIDTHS["fixed arc"]
    assert [one.text for one in top.marks if isinstance(one, NoteMark)] == [
        "published x: no threshold exists"
    ]
    gaps = [one.y for one in below.marks if getattr(one, "color", "") == FAMILY_COLORS["fixed arc"]]
    np.testing.assert_allclose(gaps, [[0.03, 20.0, np.nan]])
    assert [len(axes.get_lines()) > 3 for axes in picture.draw()] == [True, True]
    assert picture.to_plotly().to_json()


def test_wider_curves_lie_below_and_the_working_point_is_marked(thresholds):
    curves = plot_thresholds(thresholds, point=(0.3, 1.0)).panels[0].curves
    widths = [curves[name].width for name in ("fixed arc", "published", "map")]
    drawn = [name for name in curves if name in FAMILY_WIDTHS]
    assert [FAMILY_WIDTHS[name] for name in drawn] == sorted(widths, reverse=True)
    assert (curves["working point"].x, curves["working point"].y) == ([0.3], [1.0])


def test_accuracy_draws_both_costs_and_the_gain_of_the_map():
    rungs = (accuracy("short film", 1e-6, 1.0), accuracy("2-D", 3.5e-3, 1e-4), accuracy("map", 1e-7, 1e-5))
    conditions = {
        "length/diameter [1]": 0.5,
        "states [1]": 9,
        "seed [-]": 1,
        "squeeze above wedge [1]": 0.5,
        "reference error, median [1]": 1e-6,
        "reference error, 99 % [1]": 1e-5,
    }
    picture = plot_study(StudyResult(study="journal", reference="2-D", conditions=conditions, rungs=rungs))
    batch, single = picture.panels
    places = {name: (*one.x, *one.y) for name, one in batch.curves.items() if one.marker == "o"}
    assert places == {"short film": (1e-6, 1.0), "2-D": (3.5e-3, 1e-4), "map": (1e-7, 1e-5)}
    notes = [one.text for one in batch.marks if isinstance(one, NoteMark)]
    assert notes == ["map 35 000 times cheaper", "x", "x", "x"]
    assert batch.y_limits == single.y_limits
    assert "states: 9; seed: 1;" in picture.title
    assert picture.to_plotly().to_json()
    axes = picture.draw()
    assert [axes[1].get_legend() is None, axes[0].get_legend() is None] == [False, True]
    assert {"map 35 000 times cheaper", "x"} == {text.get_text() for text in axes[0].texts}
    assert batch.y == "99 % error [1] filled, median error [1] open"


def test_labels_of_close_points_do_not_overlap():
    axes = new_axes("crowded")
    x, y = np.random.default_rng(1).uniform(0.3, 0.7, (2, 12))
    axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    place_labels(axes, [NoteMark(*point, "a label") for point in zip(x, y, strict=True)])
    figure = axes.get_figure()
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in axes.texts]
    assert len(boxes) == 12
    overlaps = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i] if a.overlaps(b)]
    assert not overlaps
