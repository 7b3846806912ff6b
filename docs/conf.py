"""The documentation site: `python -m sphinx docs docs/_build`, with every example executed."""

import re
import shutil
import sys
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import glossary
import interface_tasks
from pictures import Pictures

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


def titled(source: str) -> str:
    """Return an example whose docstring begins with a title, as the gallery wants it."""
    docstring = re.match(r'"""(.*?)"""', source, re.S)
    assert docstring is not None
    first, _, rest = docstring.group(1).partition("\n")
    title, colon, more = first.rstrip(".").partition(":")
    text = f"{more.strip()}.\n" if colon else ""
    heading = f"{title}\n{'=' * len(title)}\n\n{text}{rest}"
    # The gallery executes a script in its folder, without the name of its file.
    body = source[docstring.end() :].replace("Path(__file__)", 'Path("example.py").resolve()')
    return f'"""\n{heading}\n"""{body}'


def write_examples(folder: Path) -> Path:
    """Write what the gallery executes: the examples under titles, and their scene files."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "GALLERY_HEADER.rst").write_text(
        "Examples\n========\n\nEach was executed when this page was built.\n"
    )
    for path in EXAMPLES.iterdir():
        if path.suffix == ".py":
            (folder / path.name).write_text(titled(path.read_text(encoding="utf-8")), encoding="utf-8")
        elif path.suffix == ".toml":
            shutil.copy(path, folder)
    return folder


sphinx_gallery_conf = {
    "examples_dirs": str(write_examples(HERE / "_examples")),
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
