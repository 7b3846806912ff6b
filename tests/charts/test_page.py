"""The HTML page of all charts: complete, in need of nothing else, drawn by a real browser."""

import csv
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from open_in_browser import BROWSER, opened, wrong_with

from rotorfilm import InputError
from rotorfilm.charts.ladder_charts import STYLES
from rotorfilm.cli import chart_commands
from rotorfilm.reports import write_page
from rotorfilm.reports.chart_page import EXPLAINED


@pytest.fixture
def folder(tmp_path):
    """Return a folder with two charts, one with a table that needs escaping."""
    for name in ("chart_one", "chart_two_more"):
        figure = Figure(figsize=(3, 2))
        figure.add_subplot().plot(np.arange(5.0))
        figure.savefig(tmp_path / f"{name}.png", dpi=50)
    with (tmp_path / "chart_one.csv").open("w", newline="") as file:
        csv.writer(file).writerows([["a<b", "c"], *([str(k), "&"] for k in range(500))])
    return tmp_path


def test_page_has_every_chart_and_table_and_needs_no_other_file(folder):
    text = write_page(folder).read_text()
    assert text.count('src="data:image/png;base64,') == 2
    assert "<th>a&lt;b</th>" in text
    assert "<td>&amp;</td>" in text
    assert "the first 400 of 500 rows" in text
    assert ">two more</h2>" in text
    sources = re.findall(r'(?:src|href)="([^"]*)"', text)
    assert all(source.startswith(("data:", "#")) for source in sources)


def test_every_chart_of_the_commands_is_explained(folder):
    source = Path(chart_commands.__file__).read_text()
    written = {
        f"chart_{name}" for name in re.findall(r'write_(?:chart|picture)\(\s*out, "([a-z_]+)"', source)
    }
    written |= {f"chart_{name}" for name in STYLES}
    assert len(written) > 12
    assert written - set(EXPLAINED) == {"chart_heat_limits"}
    for name in ("chart_journal", "chart_heat_limits", "chart_limits_damper"):
        shutil.copy(folder / "chart_one.png", folder / f"{name}.png")
    text = write_page(folder).read_text()
    assert f"<p>{EXPLAINED['chart_journal']}</p>" in text
    assert text.count("above the dashed line it has failed") == 2
    assert text.count("that may answer this question") == 2


def test_a_folder_without_charts_is_named(tmp_path):
    with pytest.raises(InputError, match="out must be a folder with charts"):
        write_page(tmp_path)


@pytest.mark.skipif(BROWSER is None, reason="no headless browser")
def test_a_browser_draws_every_picture_and_complains_of_nothing(folder):
    found = opened(write_page(folder))
    assert (found["images"], found["tables"], wrong_with(found)) == ([150, 150], 1, [])
