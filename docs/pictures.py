"""Pictures of the example gallery."""

import shutil
from pathlib import Path


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
