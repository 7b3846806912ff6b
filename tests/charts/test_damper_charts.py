"""Damper charts draw stable and unstable orbits apart, and contact."""

import numpy as np
import pytest

from rotorfilm.analysis import BistableMap, OrbitBranch, SynchronousOrbits
from rotorfilm.charts import (
    new_axes,
    plot_bistable,
    plot_eccentricity,
    plot_phase,
    plot_transmissibility,
    plot_transmitted,
)

UNIT = 2e-3


def branch(unbalances, growth):
    u = UNIT * np.array(unbalances)
    return OrbitBranch(
        unbalance=u,
        eccentricity_ratio=np.linspace(0.2, 0.4, u.size),
        phase=np.full(u.size, -0.5 * np.pi),
        transmissibility=np.full(u.size, 1.5),
        growth_rate=np.full(u.size, growth),
    )


FOUND = SynchronousOrbits(
    branches=(branch([0.1, 0.3, 0.4], -1.0), branch([0.3, 0.4], 2.0)),
    folds=(),
    contact_unbalance=0.2 * UNIT,
    speed=1.0,
)


@pytest.mark.parametrize(
    ("plot", "value"), [(plot_transmissibility, 1.5), (plot_eccentricity, 0.4), (plot_phase, 90.0)]
)
def test_unstable_orbits_are_dotted(plot, value):
    (axes,) = plot({"porous": FOUND}, unit=UNIT).draw()
    lines = {line.get_linestyle(): line for line in axes.get_lines() if len(line.get_xdata()) in (2, 3)}
    lines = {dash: line for dash, line in lines.items() if line.get_color() == "C0"}
    assert set(lines) == {"-", ":"}
    np.testing.assert_allclose(lines["-"].get_xdata(), [0.1, 0.3, 0.4])
    assert lines[":"].get_ydata()[-1] == pytest.approx(value)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["porous"]


def test_contact_is_a_cross_at_the_wall():
    cross = plot_eccentricity({"porous": FOUND}, unit=UNIT).draw()[0].get_lines()[-1]
    assert (cross.get_marker(), cross.get_xdata()[0], cross.get_ydata()[0]) == ("x", pytest.approx(0.2), 1.0)


def test_bistable_region_and_transient_draw_their_numbers():
    found = BistableMap(
        squeeze_number=np.array([0.1, 0.2]),
        spring_ratio=np.array([0.4]),
        jump_up=np.array([[0.5], [np.nan]]),
        jump_down=np.array([[0.4], [np.nan]]),
    )
    up, down = plot_bistable(found).draw()[0].get_lines()
    assert (up.get_ydata()[0], down.get_ydata()[0]) == (0.5, 0.4)
    axes = new_axes("mine")
    assert plot_transmitted({"a": (np.arange(3.0), np.ones(3))}).draw(axes) == [axes]
