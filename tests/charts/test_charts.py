"""Charts draw the numbers that they are given, on the axes that they are given."""

import numpy as np
import pytest

from rotorfilm import Trajectory
from rotorfilm.charts import (
    new_axes,
    plot_contact_pressure,
    plot_coupling_error,
    plot_critical_speed,
    plot_locus,
    plot_orbits,
    save,
)


def orbit():
    t = np.linspace(0.0, 1.0, 5)
    return Trajectory(time=t, signals={"x": 1e-5 * t, "y": -2e-5 * t}, work={})


def test_orbits_are_scaled_by_the_clearance():
    (axes,) = plot_orbits({"monolithic": orbit()}, clearance=1e-4, center=(1e-5, 2e-5)).draw()
    line, cross = axes.get_lines()
    np.testing.assert_allclose(line.get_xdata()[-1], 0.1)
    np.testing.assert_allclose([cross.get_xdata()[0], cross.get_ydata()[0]], [0.1, 0.2])
    assert axes.get_xlabel() == "x / clearance"
    # The legend hides nothing.
    axes.figure.canvas.draw()
    assert not axes.get_legend().get_window_extent().overlaps(axes.get_window_extent())


def test_locus_puts_the_attitude_angle_from_the_load_line_in_the_sense_of_rotation():
    (axes,) = plot_locus({"film": (np.array([0.5]), np.array([0.5 * np.pi]))}).draw()
    line = axes.get_lines()[1]
    np.testing.assert_allclose([line.get_xdata()[0], line.get_ydata()[0]], [0.5, 0.0], atol=1e-15)


def test_films_of_the_locus_have_the_line_of_their_family():
    curves = {name: (np.array([0.1, 0.5]), np.array([1.4, 1.0])) for name in ("grid", "chart")}
    (axes,) = plot_locus(curves, families={"grid": "2-D", "chart": "map"}).draw()
    _, grid, chart = axes.get_lines()
    assert grid.get_linewidth() > chart.get_linewidth()
    assert (grid.get_linestyle(), chart.get_linestyle()) == ("-", "--")


def test_films_of_a_family_differ_in_the_locus_and_the_legend_leaves_it_free():
    curves = {name: (np.array([0.1, 0.5]), np.array([1.4, 1.0])) for name in ("coarse", "fine", "finest")}
    (axes,) = plot_locus(curves, families=dict.fromkeys(curves, "2-D")).draw()
    assert len({line.get_linestyle() for line in axes.get_lines()[1:]}) == 3
    axes.figure.draw_without_rendering()
    assert axes.get_legend().get_window_extent().x0 >= axes.get_window_extent().x1


def test_coupling_error_marks_the_limit_and_the_refused_runs():
    angles, errors = np.radians([1.0, 2.0, 12.0]), np.array([1e-3, 2e-3, 0.1])
    (axes,) = plot_coupling_error(
        angles, errors, np.array([False, False, True]), limit=np.radians(10.0)
    ).draw()
    runs, refused, slope, limit = axes.get_lines()
    np.testing.assert_allclose(runs.get_xdata(), [1.0, 2.0])
    np.testing.assert_allclose(refused.get_ydata(), [0.1])
    np.testing.assert_allclose(slope.get_ydata(), [1e-3, 2e-3, 12e-3])
    assert limit.get_xdata()[0] == pytest.approx(10.0)


def test_charts_draw_on_given_axes_and_save(tmp_path):
    axes = new_axes("mine")
    assert plot_orbits({"a": orbit()}, clearance=1e-4).draw(axes) == [axes]
    path = save(axes, tmp_path / "chart.png")
    assert path.read_bytes().startswith(b"\x89PNG")


def test_bush_charts_draw_what_they_are_given():
    angle = np.array([0.1, 0.2])
    (axes,) = plot_critical_speed({"N = 1": (angle, np.array([1.0, 2.0]))}).draw()
    np.testing.assert_allclose(axes.get_lines()[0].get_xydata(), [[0.1, 1.0], [0.2, 2.0]])
    (axes,) = plot_contact_pressure(
        {"a": (angle, np.array([3e8, 0.0]))}, assumed={"a": (angle, np.array([6e8, 0.0]))}, modulus=3e8
    ).draw()
    drawn, dashed = axes.get_lines()
    np.testing.assert_allclose(drawn.get_ydata(), [1.0, 0.0])
    np.testing.assert_allclose(dashed.get_ydata(), [2.0, 0.0])
    assert (dashed.get_linestyle(), dashed.get_color()) == ("--", drawn.get_color())
