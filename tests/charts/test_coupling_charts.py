import numpy as np
import pytest

from rotorfilm.charts import plot_coupling_limits, plot_study
from rotorfilm.studies import coupling_cost, coupling_limits


@pytest.mark.long
def test_limits_are_drawn_and_tabulated(tmp_path):
    limits = coupling_limits(
        eccentricity_ratios=(0.3, 0.7), simulated_at=(), mass_ratios=(0.1,), simulated_ratios=()
    )
    picture = plot_coupling_limits(limits)
    drawn = {name: one.y for name, one in picture.panels[0].curves.items()}
    held = [rung["critical_macro_angle [deg]"] for rung in limits.rungs if rung.family == "Gauss-Seidel 0"]
    assert list(drawn["Gauss-Seidel 0"]) == held[:2]
    assert "SI-exp3" in picture.title
    assert picture.to_plotly().to_json()
    assert len(limits.columns()["scheme"]) == 3 * 9
    assert picture.save(tmp_path / "limits.png").stat().st_size > 10_000


def test_cost_is_drawn_and_tabulated(tmp_path):
    cost = coupling_cost(macro_angles=(np.radians(5.0),))
    picture = plot_study(cost)
    left, right = picture.panels
    assert list(left.curves)[:2] == ["Gauss-Seidel 0", "Gauss-Seidel 1"]
    table = cost.columns()
    best = table["orbit_error [1]"][table["scheme"].index("SI-exp3")]
    assert best < 2e-4
    refused = dict(zip(table["scheme"], table["refused"], strict=True))
    assert refused["Jacobi 2"]
    assert not refused["SI-exp3"]
    assert right.x.startswith("macro_angle")
    assert picture.save(tmp_path / "cost.png").stat().st_size > 10_000
