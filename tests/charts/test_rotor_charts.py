"""Charts of rotors draw the numbers that they are given."""

import control
import numpy as np

from rotorfilm.charts import (
    plot_campbell,
    plot_critical_speed_map,
    plot_log_decrement,
    plot_unbalance_response,
    save,
)
from rotorfilm.linear import Campbell, CriticalSpeed

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
    axes = plot_campbell(CHART, critical=[critical])
    drawn = lines(axes)
    assert set(drawn) == {"grows", "forward", "backward", "1x speed", "critical speed"}
    np.testing.assert_allclose(drawn["forward"].get_xdata(), [100.0, 200.0, 300.0])
    np.testing.assert_allclose(drawn["forward"].get_ydata() * 2 * np.pi, [10.0, 12.0, 14.0])
    assert np.isfinite(drawn["grows"].get_ydata()).tolist() == [False, False, True]
    np.testing.assert_allclose(drawn["1x speed"].get_ydata(), [100 / 60, 200 / 60, 300 / 60])
    np.testing.assert_allclose(drawn["critical speed"].get_xdata(), [10.0 * 30 / np.pi])
    assert save(axes, tmp_path / "campbell.png").stat().st_size > 10_000


def test_log_decrement_is_that_of_the_modes():
    first, second, _ = plot_log_decrement(CHART).get_lines()
    np.testing.assert_allclose(first.get_ydata(), [0.2 * np.pi, np.pi / 6, -np.pi / 7])
    assert np.isnan(second.get_ydata()[2])


def test_map_of_critical_speeds():
    stiffness, speeds = np.array([1e5, 1e6]), np.array([[10.0, 20.0], [30.0, 40.0]])
    axes = plot_critical_speed_map(stiffness, speeds, bearing=np.array([[5.0, 50.0], [1e5, 2e5]]))
    drawn = lines(axes)
    np.testing.assert_allclose(drawn["critical speed 2"].get_ydata(), np.array([30.0, 40.0]) * 30 / np.pi)
    np.testing.assert_allclose(drawn["bearing"].get_xdata(), [1e5, 2e5])


def test_unbalance_response_as_amplitude_and_phase():
    data = np.array([[[1e-6, -2e-6j]], [[5e-6, 5e-6]]])
    response = control.FrequencyResponseData(data, [10.0, 20.0], inputs=["unbalance"], outputs=["x", "y"])
    above, below = plot_unbalance_response(response, ["x"])
    np.testing.assert_allclose(above.get_lines()[0].get_ydata(), [1.0, 2.0])
    np.testing.assert_allclose(below.get_lines()[0].get_ydata(), [0.0, -90.0])
