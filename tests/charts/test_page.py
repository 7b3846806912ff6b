"""The HTML page of all charts: complete, in need of nothing else, drawn by a real browser."""

import csv
import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from rotorfilm import InputError
from rotorfilm.charts import write_page
from rotorfilm.charts.ladder_charts import STYLES
from rotorfilm.charts.page import EXPLAINED
from rotorfilm.cli import chart_commands

BROWSER = next(
    (name for name in ("chromium", "chromium-browser", "google-chrome") if shutil.which(name)), None
)

PROBE = """<script>
const told = [];
window.addEventListener("error", event => told.push(String(event.message)));
const complain = console.error; console.error = (...all) => { told.push(all.join(" ")); complain(...all); };
window.addEventListener("load", () => {
    const drawn = [...document.images].map(image => image.naturalWidth);
    const tables = document.querySelectorAll("table").length;
    document.documentElement.dataset.found = JSON.stringify({ drawn, told, tables });
});
</script>"""


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
    path = write_page(folder)
    probed = folder / "probed.html"
    probed.write_text(path.read_text().replace("</title>", f"</title>{PROBE}"))
    quiet = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-background-networking",
    ]
    command = [BROWSER, *quiet, f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=5000"]
    ran = subprocess.run(
        [*command, "--dump-dom", probed.as_uri()], capture_output=True, text=True, check=True, timeout=120
    )
    found = json.loads(re.search(r'data-found="([^"]*)"', ran.stdout).group(1).replace("&quot;", '"'))
    assert found == {"drawn": [150, 150], "told": [], "tables": 1}
