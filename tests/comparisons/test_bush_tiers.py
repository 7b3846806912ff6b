"""The tiers of the bush side by side: which errors fall, which do not, and the closed form of the shaft."""

import json

import pytest

from rotorfilm.bearings import approximate_flux, exact_flux
from rotorfilm.charts import plot_study
from rotorfilm.cli import main as cli
from rotorfilm.studies import bush_tiers


@pytest.fixture(scope="module")
def tiers():
    return bush_tiers(nodes=(9,), steps=(20,))


@pytest.mark.long
def test_profiles_converge_and_the_published_stage_does_not():
    tiers = bush_tiers(nodes=(17, 33), steps=(20, 200))
    errors = {tier.name: tier["angle error [1]"] for tier in tiers.rungs}
    assert errors["two moments"] < 1e-5
    assert errors["BushWear"] < 0.02
    assert errors["BushReaction, 33 nodes"] < 0.5 * errors["BushReaction, 17 nodes"] < 0.04
    # Not the step is what is wrong: the losses widen the contact.
    assert errors["as published, 200 steps"] == pytest.approx(errors["as published, 20 steps"], rel=0.05)
    assert errors["as published, 200 steps"] > 1.0


@pytest.mark.literature
def test_the_closed_form_of_the_shaft_is_high_everywhere(tiers):
    """The source says 3 % of its kernel."""
    cooling, stubbiness, error = tiers.notes["shaft"].values()
    assert set(stubbiness) == {0.1, 0.25, 0.5, 1.0}
    assert (min(cooling), max(cooling)) == (0.02, 0.3)
    assert 0.006 < min(error) < max(error) < 0.03
    closed, exact = (flux(cooling[7], stubbiness[7]) for flux in (approximate_flux, exact_flux))
    assert error[7] == pytest.approx(closed / exact - 1.0, rel=1e-12)


def test_the_chart_has_every_tier_and_every_line(tiers):
    cost, angle, shaft = plot_study(tiers).draw()
    marks = sum(len(line.get_xdata()) for line in cost.lines)
    assert marks == len(tiers.rungs)
    assert len(angle.lines) == len({tier.family for tier in tiers.rungs}) + 1
    assert len(shaft.lines) == 4
    assert len(tiers.columns()["tier"]) == len(tiers.rungs)


@pytest.mark.long
def test_the_command_writes_chart_and_tables(tiers, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr("rotorfilm.studies.bush_tiers", lambda report: tiers)
    for more in ([], ["--json"]):
        with pytest.raises(SystemExit) as exit_:
            cli.main(["chart", "bush", "--out", str(tmp_path), *more])
        assert not exit_.value.code
        out = capsys.readouterr().out
    assert json.loads(out)["rungs"][0]["name"] == "two moments"
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "chart_bush.csv",
        "chart_bush.png",
        "chart_bush_shaft.csv",
    ]
    assert len((tmp_path / "chart_bush_shaft.csv").read_text().splitlines()) == 61
