import numpy as np

from rotorfilm.charts import plot_coupling_limits, plot_study, save
from rotorfilm.studies import coupling_cost, coupling_limits


def test_limits_are_drawn_and_tabulated(tmp_path):
    limits = coupling_limits(
        eccentricity_ratios=(0.3, 0.7), simulated_at=(), mass_ratios=(0.1,), simulated_ratios=()
    )
    left, right = plot_coupling_limits(limits)
    drawn = {line.get_label(): line.get_ydata() for line in left.lines}
    held = [rung["critical_macro_angle [deg]"] for rung in limits.rungs if rung.family == "Gauss-Seidel 0"]
    assert list(drawn["Gauss-Seidel 0"]) == held[:2]
    assert "SI-exp3" in right.get_legend().get_title().get_text()
    assert len(limits.columns()["scheme"]) == 3 * 9
    assert save(left, tmp_path / "limits.png").stat().st_size > 10_000


def test_cost_is_drawn_and_tabulated(tmp_path):
    cost = coupling_cost(macro_angles=(np.radians(5.0),))
    left, right = plot_study(cost)
    assert [line.get_label() for line in left.lines][:2] == ["Gauss-Seidel 0", "Gauss-Seidel 1"]
    table = cost.columns()
    best = table["orbit_error [1]"][table["scheme"].index("SI-exp3")]
    assert best < 2e-4
    refused = dict(zip(table["scheme"], table["refused"], strict=True))
    assert refused["Jacobi 2"]
    assert not refused["SI-exp3"]
    assert right.get_xlabel().startswith("macro_angle")
    assert save(left, tmp_path / "cost.png").stat().st_size > 10_000
