"""The atlas of limits: a figure for each physics, readable, and the summary of where each method holds."""

import numpy as np
import pytest

from rotorfilm.charts import BarsMark, NoteMark, plot_limit_summary, plot_limits
from rotorfilm.studies import Panel, StudyResult
from rotorfilm.studies.limits_atlas import panel_points

X = np.array([0.1, 1.0, 10.0])


def panel(physics, title, curves, **changes):
    reading = {"x_label": "size", "y_label": "error", "logarithmic": True, **changes}
    named = [(name, X, np.array(y)) for name, y in curves.items()]
    return Panel(physics=physics, title=title, curves=lambda: iter(named), **reading)


@pytest.fixture
def atlas():
    coarse = "coarse, with a name that is too long for half a line"
    panels = (
        panel("journal", "grid", {coarse: [0.01, 0.1, 1.0], "fine": [1e-3, 1e-2, 0.1]}),
        panel("rotor", "step", {"any": [1e-3, 2e-3, 3e-3]}),
        panel("rotor", "longest step", {"any": [5.0, 6.0, 7.0]}, level=None),
    )
    points = tuple(point for one in panels for point in panel_points(one))
    notes = {one.title: one for one in panels}
    return StudyResult(study="limits", reference="", notes=notes, rungs=points)


def test_each_physics_has_a_picture_whose_legends_lie_within_it(atlas):
    drawn = plot_limits(atlas)
    assert {name: [one.title for one in picture.panels] for name, picture in drawn.items()} == {
        "journal": ["grid"],
        "rotor": ["step", "longest step"],
    }
    assert "failed: 0.1" in {getattr(one, "label", "") for one in drawn["rotor"].panels[0].marks}
    for picture in drawn.values():
        assert picture.to_plotly().to_json()
        for axes in picture.draw():
            axes.figure.canvas.draw()
            legend, whole = axes.get_legend().get_window_extent(), axes.figure.bbox
            assert legend.x0 >= whole.x0
            assert legend.x1 <= whole.x1
            assert not legend.overlaps(axes.get_window_extent())


def test_the_summary_tells_where_all_some_and_no_variants_hold(atlas):
    """Of the range from 0.1 to 10, the coarse grid holds to 1 and the fine one to 10."""
    picture = plot_limit_summary(atlas)  # that which is a limit itself has no bar
    bars = {one.label: one for one in picture.panels[0].marks if isinstance(one, BarsMark)}
    assert list(bars["some"].places) == ["rotor: step", "journal: grid"]
    np.testing.assert_allclose(bars["all variants"].tops, [1.0, 0.5])
    np.testing.assert_allclose(bars["some"].tops, [1.0, 1.0])
    notes = [one.text for one in picture.panels[0].marks if isinstance(one, NoteMark)]
    assert notes == [
        "size: all to 10; examined from 0.1 to 10",
        "size: all to 1, some to 10; examined from 0.1 to 10",
    ]
    assert picture.draw()
    assert picture.to_plotly().to_json()
