"""Charts of bearings made of pads draw what the results say."""

import math

import numpy as np
import pytest
from draw_pads import CLEARANCE, JOURNAL, arc, draw, tilting

from rotorfilm import lobe_set
from rotorfilm.charts import plot_bearing_thresholds, plot_study
from rotorfilm.studies import StudyResult, StudyRow

TURN = 2.0 * math.pi / 60.0


def rung(name, **values):
    return StudyRow(name=name, family=name, label="", case="", values=values)


def test_coefficients_are_drawn_entry_by_entry():
    entries = ("xx", "xy", "yx", "yy")
    rungs = tuple(
        rung(
            "one",
            **{"S over the assembled clearance [1]": S, "least film/c [1]": film},
            **{f"K{ij} c/W [1]": first + k for k, ij in enumerate(entries)},
            **{f"C{ij} c speed/W [1]": 10 * (first + k) for k, ij in enumerate(entries)},
        )
        for S, film, first in ((0.1, 0.1, 1), (1.0, 0.9, 5))
    )
    shown = plot_study(StudyResult(study="bearings", reference="S so and so", rungs=rungs))
    drawn = [axes.get_lines()[0].get_ydata().tolist() for axes in shown]
    assert drawn == [[1, 5], [2, 6], [3, 7], [4, 8], [10, 50], [20, 60], [40, 80], [0.1, 0.9]]
    assert "S so and so" in shown[0].figure.get_suptitle()
    assert [axes.get_yscale() for axes in shown] == [
        *("log", "symlog", "symlog", "log"),
        *("log", "symlog", "log", "linear"),
    ]


def test_bearings_that_never_whirl_lie_on_the_edge():
    found = {
        "plain": ((100.0, "onset"), (200.0, "onset")),
        "tilting": ((None, "never"), (None, "never")),
        "weak": ((100.0, "onset"), (None, "not carried")),
    }
    rungs = tuple(
        rung(
            name,
            **{"load [N]": load, "threshold [rad/s]": speed and speed * TURN, "whirl [-]": met},
        )
        for name, both in found.items()
        for load, (speed, met) in zip((50.0, 500.0), both, strict=True)
    )
    conditions = {
        "mass [kg]": 10.0,
        "length/diameter [1]": 0.5,
        "searched from [rad/s]": 10.0,
        "searched to [rad/s]": 1000.0,
    }
    result = StudyResult(study="whirl", reference="", conditions=conditions, rungs=rungs)
    axes = plot_bearing_thresholds(result)
    lines = {line.get_label(): line for line in axes.get_lines()}
    top = 1000.0 / TURN
    assert lines["plain"].get_ydata() == pytest.approx([100.0, 200.0])
    assert lines["tilting: no whirl"].get_ydata() == pytest.approx([top, top])
    assert axes.get_ylim()[1] == pytest.approx(top)
    crosses = [line.get_xdata().tolist() for line in axes.get_lines() if line.get_marker() == "x"]
    assert crosses == [[], [], [500.0]]
    assert "no whirl at any speed searched" in axes.get_title()
    assert plot_bearing_thresholds(result, axes=axes) is axes


def test_films_of_pads_are_drawn_over_their_cost():
    rungs = [
        StudyRow(
            name=name,
            family=family,
            label="",
            case="",
            values={
                "median error [1]": 1e-4,
                "99 % error [1]": high,
                "force of a pad in a batch [s]": cost,
                "force of a pad alone, prepare() [s]": 10.0 * cost,
            },
        )
        for name, family, high, cost in (
            ("map", "map", 4e-3, 1e-7),
            ("grid", "grid", 2e-3, 1e-5),
        )
    ]
    conditions = {
        "length/diameter [1]": 0.5,
        "bearings [-]": "elliptical",
        "states of each bearing [1]": 4,
        "seed [-]": 1,
        "reference error, 99 % [1]": 1e-4,
    }
    result = StudyResult(study="pads", reference="a film", conditions=conditions, rungs=tuple(rungs))
    batch, alone = plot_study(result)
    filled = [line.get_data() for line in batch.get_lines() if line.get_markersize() == 7]
    assert np.ravel(filled) == pytest.approx([1e-7, 4e-3, 1e-5, 2e-3])
    texts = {text.get_text() for text in alone.texts}
    assert texts == {"map", "grid", "gray: error of the reference "}
    assert "reference: a film" in batch.figure.get_suptitle()


def test_picture_of_the_page_shows_the_clearances_as_they_are(tmp_path):
    for lobe in (*lobe_set("elliptical", preload=0.3), *lobe_set("offset_halves"), *tilting(True)):
        film = np.hypot(*arc(lobe)) - JOURNAL
        assert film.min() == pytest.approx(CLEARANCE * (1.0 - lobe.preload), abs=2e-4)
    assert math.sin(tilting(False)[0].closest) == pytest.approx(-1.0)
    assert draw(tmp_path / "pads.png").read_bytes().startswith(b"\x89PNG")
