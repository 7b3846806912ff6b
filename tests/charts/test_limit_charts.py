"""The atlas of limits: a figure for each physics, readable, and the summary of where each method holds."""

import numpy as np
import pytest
from matplotlib.colors import to_rgba

from rotorfilm.charts import plot_limit_summary, plot_limits
from rotorfilm.charts.study_charts import DEPENDS, FAILS, HOLDS
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


def test_each_physics_has_a_figure_whose_legends_lie_within_it(atlas):
    drawn = plot_limits(atlas)
    assert {name: [one.get_title() for one in axes] for name, axes in drawn.items()} == {
        "journal": ["grid"],
        "rotor": ["step", "longest step"],
    }
    assert drawn["journal"][0].figure is not drawn["rotor"][0].figure
    for axes in (one for each in drawn.values() for one in each):
        axes.figure.canvas.draw()
        legend, whole = axes.get_legend().get_window_extent(), axes.figure.bbox
        assert legend.x0 >= whole.x0
        assert legend.x1 <= whole.x1
        assert not legend.overlaps(axes.get_window_extent())


def test_the_summary_tells_where_all_some_and_no_variants_hold(atlas):
    grid, step = plot_limit_summary(atlas)  # that which is a limit itself has no strip
    spans = {
        axes: [
            (p.get_facecolor(), round(p.get_x(), 6), round(p.get_x() + p.get_width(), 6))
            for p in axes.patches
        ]
        for axes in (grid, step)
    }
    colors = [to_rgba(color) for color in (HOLDS, DEPENDS, FAILS)]
    assert spans[grid] == [(colors[0], 0.1, 1.0), (colors[1], 1.0, 10.0), (colors[2], 10.0, 10.0)]
    assert spans[step][0] == (colors[0], 0.1, 10.0)
    assert grid.get_ylabel() == "journal: grid"
