"""Charts of bearings made of pads draw what the results say."""

import math
from dataclasses import replace

import numpy as np
import pytest
from draw_pads import CLEARANCE, JOURNAL, arc, draw, tilting

from rotorfilm import lobe_set
from rotorfilm.charts import NoteMark, plot_bearing_thresholds, plot_study
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
    picture = plot_study(StudyResult(study="bearings", reference="S so and so", rungs=rungs))
    drawn = [list(panel.curves["one"].y) for panel in picture.panels]
    assert drawn == [[1, 5], [2, 6], [3, 7], [4, 8], [10, 50], [20, 60], [40, 80], [0.1, 0.9]]
    assert "S so and so" in picture.title
    assert [panel.log for panel in picture.panels] == ["xy"] * 7 + ["x"]
    assert picture.draw()
    turned = (rungs[0], replace(rungs[1], values={**rungs[1].values, "Kxy c/W [1]": -6.0}))
    panel = plot_study(StudyResult(study="bearings", reference="", rungs=turned)).panels[1]
    dotted, solid = panel.marks
    np.testing.assert_array_equal([dotted.y, solid.y], [[np.nan, 6.0], [2.0, np.nan]])
    assert (dotted.dash, panel.y) == (":", "Kxy c/W [1], negative dotted")


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
    (panel,) = plot_bearing_thresholds(result).panels
    top = 1000.0 / TURN
    assert panel.curves["plain"].y == pytest.approx([100.0, 200.0])
    assert panel.curves["tilting: no whirl"].y == pytest.approx([top, top])
    assert panel.y_limits[1] == pytest.approx(top)
    crosses = [one.x for one in panel.marks if getattr(one, "marker", "") == "x"]
    assert crosses == [[], [], [500.0]]
    assert "no whirl at any speed searched" in panel.title
    assert "weight" in {getattr(one, "label", "") for one in panel.marks}
    assert plot_bearing_thresholds(result).to_plotly().to_json()


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
    picture = plot_study(
        StudyResult(study="pads", reference="a film", conditions=conditions, rungs=tuple(rungs))
    )
    batch, alone = picture.panels
    places = [(*one.x, *one.y) for one in batch.curves.values()]
    assert places == [(1e-7, 4e-3), (1e-5, 2e-3)]
    assert {one.text for one in alone.marks if isinstance(one, NoteMark)} == {"map", "grid"}
    assert "error of the reference" in {getattr(one, "label", "") for one in alone.marks}
    assert "reference: a film" in picture.title


def test_picture_of_the_page_shows_the_clearances_as_they_are(tmp_path):
    for lobe in (*lobe_set("elliptical", preload=0.3), *lobe_set("offset_halves"), *tilting(True)):
        film = np.hypot(*arc(lobe)) - JOURNAL
        assert film.min() == pytest.approx(CLEARANCE * (1.0 - lobe.preload), abs=2e-4)
    assert math.sin(tilting(False)[0].closest) == pytest.approx(-1.0)
    assert draw(tmp_path / "pads.png").read_bytes().startswith(b"\x89PNG")
