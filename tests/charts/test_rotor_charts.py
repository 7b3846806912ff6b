"""Charts of rotors draw the numbers that they are given."""

from dataclasses import replace

import control
import numpy as np
import pytest

from rotorfilm import InputError, LinearBearing
from rotorfilm.analysis import Campbell, CriticalSpeed, rotor_modes
from rotorfilm.charts import (
    CurveMark,
    LevelMark,
    plot_campbell,
    plot_critical_speed_map,
    plot_log_decrement,
    plot_mode_shape,
    plot_unbalance_response,
    save,
)
from rotorfilm.rotors import ElasticMaterial, ShaftElement, ShaftRotor, Station

SPEEDS = np.array([100.0, 200.0, 300.0]) * np.pi / 30.0
CHART = Campbell(
    speeds=SPEEDS,
    eigenvalues=np.array([[-1 + 10j, -1 + 12j, 1 + 14j], [-2 + 40j, -2 + 39j, complex(np.nan, np.nan)]]),
    direction=np.array([[1.0, 1.0, 1.0], [-1.0, -1.0, np.nan]]),
)


def lines(axes):
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def test_campbell_diagram_in_rpm_and_hertz(tmp_path):
    critical = CriticalSpeed(speed=10.0, log_decrement=0.1, direction=1.0)
    picture = plot_campbell(CHART, critical=[critical])
    drawn = picture.panels[0].curves
    assert set(drawn) == {"grows", "forward", "backward", "1x speed", "critical speed"}
    np.testing.assert_allclose(drawn["forward"].x, [100.0, 200.0, 300.0])
    np.testing.assert_allclose(drawn["forward"].y * 2 * np.pi, [10.0, 12.0, 14.0])
    np.testing.assert_allclose(drawn["forward"].values, [0.2 * np.pi, np.pi / 6, -np.pi / 7])
    np.testing.assert_allclose(drawn["grows"].x, [300.0])
    np.testing.assert_allclose(drawn["1x speed"].y, [100 / 60, 200 / 60, 300 / 60])
    np.testing.assert_allclose(drawn["critical speed"].x, [10.0 * 30 / np.pi])
    assert save(picture, tmp_path / "campbell.png").stat().st_size > 10_000


def test_a_campbell_diagram_leaves_out_modes_far_above_the_speed():
    assert plot_campbell(CHART).panels[0].y_limits == (0.0, None)
    chart = replace(CHART, eigenvalues=CHART.eigenvalues * [[1.0], [100.0]])
    assert plot_campbell(chart).panels[0].y_limits == pytest.approx((0.0, 10.0))


def test_a_campbell_diagram_draws_no_roundoff_as_growth():
    values = np.array([[-1e-9 + 10j, 1e-9 + 12j, 1e-7 + 14j]])
    chart = replace(CHART, eigenvalues=values, direction=np.ones((1, 3)), roundoff=np.full((1, 3), 1e-8))
    np.testing.assert_allclose(plot_campbell(chart).panels[0].curves["grows"].x, [300.0])
    chart = replace(chart, roundoff=np.full((1, 3), 1e-6))
    assert "grows" not in plot_campbell(chart).panels[0].curves


def test_log_decrement_is_that_of_the_modes():
    (panel,) = plot_log_decrement(CHART).panels
    first, second = panel.curves.values()
    np.testing.assert_allclose(first.y, [0.2 * np.pi, np.pi / 6, -np.pi / 7])
    assert np.isnan(second.y[2])
    # Of the mode that becomes unstable: the other stays above 0.3.
    np.testing.assert_allclose(panel.y_limits, [-1.2 * np.pi / 7, 1.2 * np.pi / 6])
    assert [one.at for one in panel.marks if isinstance(one, LevelMark)] == [0.0, 0.1]


def test_an_overdamped_mode_is_named_and_not_drawn():
    chart = replace(CHART, eigenvalues=CHART.eigenvalues - np.array([[0.0], [80.0]]))
    (panel,) = plot_log_decrement(chart).panels
    assert list(panel.curves) == ["mode 1, from 1.59 Hz"]
    assert panel.title.endswith("above 0.63 at all speeds: mode 2")
    (panel,) = plot_log_decrement(replace(chart, eigenvalues=chart.eigenvalues - 80.0)).panels
    assert panel.y_limits == (-1.0, 3.0)


def test_map_of_critical_speeds():
    stiffness, speeds = np.array([1e5, 1e6]), np.array([[10.0, 20.0], [30.0, 40.0]])
    picture = plot_critical_speed_map(stiffness, speeds, bearing=np.array([[5.0, 50.0], [1e5, 2e5]]))
    drawn = picture.panels[0].curves
    np.testing.assert_allclose(drawn["critical speed 2"].y, np.array([30.0, 40.0]) * 30 / np.pi)
    np.testing.assert_allclose(drawn["bearing"].x, [1e5, 2e5])


def test_unbalance_response_as_amplitude_and_phase():
    data = np.array([[[1e-6, -2e-6j]], [[5e-6, 5e-6]]])
    response = control.FrequencyResponseData(data, [10.0, 20.0], inputs=["unbalance"], outputs=["x", "y"])
    above, below = plot_unbalance_response(response, ["x"]).draw()
    np.testing.assert_allclose(above.get_lines()[0].get_ydata(), [1.0, 2.0])
    np.testing.assert_allclose(below.get_lines()[0].get_ydata(), [0.0, -90.0])


def test_unbalance_response_has_a_color_for_each_place_and_marks_the_speeds_that_count():
    names = ["left_x", "left_y", "disk_x", "disk_y"]
    response = control.FrequencyResponseData(
        np.ones((4, 1, 3)), [10.0, 20.0, 40.0], inputs=["unbalance"], outputs=names
    )
    critical = [CriticalSpeed(speed=speed, log_decrement=0.1, direction=1.0) for speed in (5.0, 15.0, 25.0)]
    for panel in plot_unbalance_response(response, critical=critical, threshold=30.0).panels:
        curves = [mark for mark in panel.marks if isinstance(mark, CurveMark)]
        assert [(one.color, one.dash) for one in curves] == [
            ("C0", "-"),
            ("C0", "--"),
            ("C1", "-"),
            ("C1", "--"),
        ]
        lines = [mark for mark in panel.marks if isinstance(mark, LevelMark)]
        np.testing.assert_allclose([one.at for one in lines], np.array([15.0, 25.0, 30.0]) * 30 / np.pi)
        assert [one.label for one in lines] == ["critical speed", "", "threshold of stability"]


def test_unbalance_response_draws_all_displacements_unless_told():
    names = ["left_x", "left_y", "left_vx", "left_vy", "left_housing_force_x", "speed"]
    data = np.arange(1.0, 13.0).reshape(6, 1, 2)
    response = control.FrequencyResponseData(data, [10.0, 20.0], inputs=["unbalance"], outputs=names)
    above, _ = plot_unbalance_response(response, peak_to_peak=True).panels
    assert list(above.curves) == ["left, x", "left, y"]
    np.testing.assert_allclose(above.curves["left, x"].y, [2e6, 4e6])
    assert above.y == "amplitude, peak-to-peak [um]"


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [0.0, 400.0])
def test_mode_shapes_of_a_simply_supported_shaft_are_sines(speed):
    """Plane motion along x where x is softer; circles at speed on equal springs, drawn along x."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    rotor = ShaftRotor(
        elements=ShaftElement(length=1.2, outer_diameter=0.05, material=steel).split(6),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        speed=0.0,
    )
    hard = LinearBearing(stiffness=((1e12, 0.0), (0.0, 1.1e12 if speed == 0.0 else 1e12)))
    modes = rotor_modes(rotor, {"left": hard, "right": hard}, speed)
    for half_waves, number in ((1, 0), (2, 2)):
        drawn = lines(plot_mode_shape(rotor, modes, number).draw()[0])
        wanted = np.sin(half_waves * np.pi * rotor.positions / 1.2)
        sign = np.sign(drawn["x"].get_ydata()[1])
        np.testing.assert_allclose(
            sign * drawn["x"].get_ydata(), wanted / np.abs(wanted).max() * size(speed), atol=2e-3
        )
        np.testing.assert_allclose(drawn["bearing"].get_xdata(), [0.0, 1.2])
    with pytest.raises(InputError, match="number must be from 0 to"):
        plot_mode_shape(rotor, modes, -1)


def size(speed):
    """Largest deflection along x: of a circle, x and y are as large, and x^2 + y^2 of both phases is 1."""
    return 1.0 if speed == 0.0 else np.sqrt(0.5)
