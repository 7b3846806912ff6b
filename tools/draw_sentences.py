"""Print random sentences of the pages and random docstrings of public objects, to read them as a newcomer.

Example: python tools/draw_sentences.py --seed 1
"""

import argparse
import inspect
import random
from importlib import import_module
from pathlib import Path

import check_words

from rotorfilm.core import published

ROOT = Path(__file__).resolve().parents[1]
FEWEST_WORDS = 4


def joined(text: str) -> str:
    """Return a text in one line."""
    return " ".join(text.split())


def sentences(path: Path) -> list[str]:
    """Return the sentences of a page with its name and their lines."""
    found = []
    for line, text, cell in check_words.paragraphs(path.read_text("utf-8").splitlines(), plain=joined):
        for sentence in () if cell else check_words.SENTENCE.split(text):
            if len(sentence.split()) >= FEWEST_WORDS:
                found.append(f"{path.relative_to(ROOT)}:{line}: {sentence}")
    return found


def docstrings() -> list[str]:
    """Return the docstrings of the public classes and functions and of their public methods."""
    found = {}
    for name, package in published().items():
        owner = getattr(import_module(package), name)
        members = vars(owner).items() if inspect.isclass(owner) else ()
        called = [(name, owner), *((f"{name}.{key}", one) for key, one in members if key[0] != "_")]
        for title, one in called:
            text = inspect.getdoc(one) if callable(one) or isinstance(one, property) else None
            if text and not text.startswith(f"{name}("):
                found[title] = f"{title}\n    " + text.replace("\n", "\n    ")
    return sorted(found.values())


def main() -> None:
    """Print the draw of a seed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seed", type=int, default=1, help="seed of the draw")
    parser.add_argument("--sentences", type=int, default=60, help="number of sentences")
    parser.add_argument("--docstrings", type=int, default=40, help="number of docstrings")
    options = parser.parse_args()
    draw = random.Random(options.seed)
    pages = check_words.files(["README.md", "fmus/README.md", "docs"])
    read = [one for path in pages if path.suffix == ".md" for one in sentences(path)]
    for kind, count in ((read, options.sentences), (docstrings(), options.docstrings)):
        for number, one in enumerate(draw.sample(kind, count), 1):
            print(f"{number}. {one}\n")


if __name__ == "__main__":
    main()
