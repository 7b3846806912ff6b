"""The documentation site: `python -m sphinx docs docs/_build`, with every example executed."""

import re
import sys
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import glossary
import interface_tasks
from example_gallery import Pictures, write_examples

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"

project = "rotorfilm"
version = release = metadata.version("rotorfilm")
copyright = "the rotorfilm developers"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
html_theme = "furo"
html_title = "rotorfilm"
html_static_path = ["_css"]
html_css_files = ["tables.css"]
html_extra_path = ["../rotorfilm/scenes/data/scene.schema.json"]
exclude_patterns = ["_build", "_examples"]
myst_heading_anchors = 3
autosummary_generate = True
numpydoc_show_class_members = False
# The pages are read on the forge too, where links go to folders and scripts.
suppress_warnings = ["myst.xref_missing", "myst.header", "config.cache"]

sphinx_gallery_conf = {
    "examples_dirs": str(write_examples(EXAMPLES, HERE / "_examples")),
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py",
    "image_scrapers": (Pictures(),),
    "abort_on_example_error": True,
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,
}
interface_tasks.write(HERE / "interface.rst")
glossary.write(HERE)

PAGES = {"fmus/README.md": "fmus.md", "CONTRIBUTING.md": "contributing.md"}
"""Pages of the site that are files of the tree."""


def included(match: re.Match[str]) -> str:
    """Return the text of a file of the tree, or one of its parts, its links as they are in this folder."""
    text = (HERE.parent / match[1]).read_text(encoding="utf-8")
    if match[2] is not None:
        text = text.split("<!-- part -->\n")[int(match[2])]
    return re.sub(r"\]\((?:\.\./)?docs/", "](", text)


def adapt(app, docname, source) -> None:
    """Put files of the tree where a page asks for them, and let links lead to their pages."""
    text = re.sub(r"<!-- include (\S+)(?: part (\d))? -->", included, source[0])
    text = re.sub(r"\]\((?:\.\./)?examples/(\w+)\.py\)", r"](gallery/\1.rst)", text)
    for path, page in PAGES.items():
        text = re.sub(rf"\]\((?:\.\./)?{re.escape(path)}", f"]({page}", text)
    source[0] = text


def setup(app) -> None:
    """Let bars in docstrings be magnitudes, not substitutions."""

    def escape(app, what, name, obj, options, lines) -> None:
        lines[:] = [line.replace("|", r"\|") for line in lines]

    app.connect("autodoc-process-docstring", escape, priority=1000)
    app.connect("source-read", adapt)
