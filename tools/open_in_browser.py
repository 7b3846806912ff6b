"""Open pages in headless Chromium: figures that are drawn, script errors, requests to the network.

    python tools/open_in_browser.py [--screenshots FOLDER] PAGE.html ...

Exits with 1 where something is wrong. The tests of pages use `opened` too.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from html import unescape
from pathlib import Path
from typing import Any

BROWSER = next((one for one in ("chromium", "chromium-browser", "google-chrome") if shutil.which(one)), None)

PROBE = """<script>
const told = [];
window.addEventListener("error", event => told.push(String(event.message)));
document.addEventListener("securitypolicyviolation", event => told.push("asked for " + event.blockedURI));
const complain = console.error; console.error = (...all) => { told.push(all.join(" ")); complain(...all); };
window.addEventListener("load", () => setTimeout(() => {
    const figures = [...document.querySelectorAll(".js-plotly-plot")];
    const entry = document.querySelector(".legendtoggle");
    for (const kind of entry ? ["mousedown", "mouseup"] : [])
        entry.dispatchEvent(new MouseEvent(kind, { bubbles: true }));
    setTimeout(() => {
        const names = performance.getEntriesByType("resource").map(one => one.name);
        document.documentElement.dataset.found = JSON.stringify({
            images: [...document.images].map(image => image.naturalWidth),
            tables: document.querySelectorAll("table").length,
            figures: figures.length,
            drawn: figures.filter(one => one.querySelector("svg.main-svg, canvas")).length,
            hidden: figures.flatMap(one => one.data).filter(one => one.visible === "legendonly").length,
            asked: names.filter(one => one.startsWith("http")),
            told,
        });
    }, 1000);
}, 1000));
</script>"""
"""Counts what is drawn, clicks the first entry of a legend, and keeps complaints and requests."""


def opened(page: Path, screenshot: Path | None = None) -> dict[str, Any]:
    """Return what a browser made of a page: images by width, tables, figures, complaints, requests."""
    assert BROWSER is not None
    options = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--allow-file-access-from-files",
    ]
    options += ["--disable-background-networking", "--virtual-time-budget=20000", "--window-size=1000,6000"]
    probed = page.with_name(f"probed_{page.name}")
    probed.write_text(
        page.read_text(encoding="utf-8").replace("</title>", f"</title>{PROBE}", 1), encoding="utf-8"
    )
    try:
        with tempfile.TemporaryDirectory() as profile:
            command = [BROWSER, *options, f"--user-data-dir={profile}"]
            if screenshot is not None:
                picture = [*command, f"--screenshot={screenshot}", probed.as_uri()]
                subprocess.run(picture, capture_output=True, check=True, timeout=120)
            ran = subprocess.run(
                [*command, "--dump-dom", probed.as_uri()],
                capture_output=True,
                text=True,
                check=True,
                timeout=120,
            )
    finally:
        probed.unlink()
    found: dict[str, Any] = json.loads(unescape(re.search(r'data-found="([^"]*)"', ran.stdout)[1]))
    return found


def wrong_with(found: dict[str, Any]) -> list[str]:
    """Return what is wrong with a page, one line each."""
    lines = [f"script error: {one}" for one in found["told"]]
    lines += [f"network request: {one}" for one in found["asked"]]
    lines += ["an image is not drawn"] * found["images"].count(0)
    return lines + ["a figure is not drawn"] * (found["figures"] - found["drawn"])


def main() -> None:
    """Open the pages of the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("pages", nargs="+", type=Path)
    parser.add_argument("--screenshots", type=Path, metavar="FOLDER")
    given = parser.parse_args()
    failed = False
    for page in given.pages:
        picture = given.screenshots and given.screenshots / f"{page.stem}.png"
        found = opened(page, picture)
        wrong = wrong_with(found)
        failed |= bool(wrong)
        print(page.name, "; ".join(wrong) or f"{found['figures']} figures, {len(found['images'])} images")
    sys.exit(failed)


if __name__ == "__main__":
    main()
