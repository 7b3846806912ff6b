"""The example gallery: its scripts, the files that they read, and the pictures that they draw."""

import re
import shutil
from pathlib import Path

READ = {".toml", ".csv"}
"""Suffixes of the files that examples read; pictures that lie beside them belong to an earlier run."""


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


def write_examples(examples: Path, folder: Path) -> Path:
    """Write what the gallery executes: the examples under titles, and the files that they read."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "GALLERY_HEADER.rst").write_text(
        "Examples\n========\n\nEach was executed when this page was built.\n"
    )
    for path in examples.iterdir():
        if path.suffix == ".py":
            (folder / path.name).write_text(titled(path.read_text(encoding="utf-8")), encoding="utf-8")
        elif path.suffix in READ:
            shutil.copy(path, folder)
    return folder


class Pictures:
    """Scraper of the pictures that an example writes into its folder."""

    def __init__(self) -> None:
        self.seen = set()

    def __repr__(self) -> str:
        """Return a text that does not change from build to build."""
        return "Pictures()"

    def __call__(self, block, block_vars, gallery_conf):
        """Return the reStructuredText of the pictures that are new."""
        from sphinx_gallery.scrapers import figure_rst

        found = []
        for path in sorted(Path(block_vars["src_file"]).parent.glob("*.png")):
            if path in self.seen:
                continue
            self.seen.add(path)
            target = next(block_vars["image_path_iterator"])
            shutil.copy(path, target)
            found.append(target)
        return figure_rst(found, gallery_conf["src_dir"])
