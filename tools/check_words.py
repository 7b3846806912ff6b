"""Check the words of pages, docstrings and messages: numbers, sentences, riddles, cells, length of pages.

Example: python tools/check_words.py --show docs/journal.md
"""

import argparse
import ast
import inspect
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CLEAN = ["CONTRIBUTING.md", "README.md", "docs", "fmus", "rotorfilm"]
MADE = {"glossary.md", "modules.md", "_build", "gallery"}
"""Files and folders without a finding, which `.ci/run` keeps so; then what the site makes."""
MOST_WORDS, LONGEST_PAGE = 40, 3000
RIDDLES = {
    "but (?:by|for|that of|those of)": "'except'",
    "that of that": "the noun itself",
    "what is left out": "'the neglected effects'",
    "films? that remembers?": "'mass-conserving film'",
    r"(?:is|are|be|was|were) (?:\S+ )?off by": "'has an error of'",
    "errs?": "'has an error of'",
    "(?:bearings|bearing made) of pads": "'lobed and tilting-pad bearings'",
}
PRIVATE = {"no number": "'undefined'", "rungs?": "'model'", "remarks?": "'note'", "judge[ds]?": "'check'"}
"""Phrases at fault, as regular expressions, and what to write instead: everywhere, and on pages."""
BARE_NUMBER = re.compile(r"(?<![\w.)%\]])\.\d[\d.e-]*")
PAIR = re.compile(r"\d[\d.e-]*(?: ?%)? ?/ ?[+-]?\.?\d")
ABBREVIATION = re.compile(r"\b(al|e\.g|i\.e|Figs?|Eqs?|No|vs|cf|pp?|Vol|[A-Z])\.")
SENTENCE = re.compile(r"(?<=[.!?])[\"')*]*\s+(?=[\"'(*]*[A-Z\d])")
WORD = re.compile(r"\S*(?:[A-Za-z]{2}|\b\d)\S*")
LIST_ITEM = re.compile(r"\s*(?:(?:[-*]|\d+\.) |\w[\w, ]*(?: \[[^]]*\])? : )")
MESSENGER = re.compile(r"Error$|Warning$|^_?(warn|fail|refuse)")
Piece = tuple[int, str, bool]
"""The line of a paragraph, heading, cell or message, its text, and whether it is a cell."""


def plain(text: str) -> str:
    """Return a text without the targets of links; code and addresses count as one word."""
    text = re.sub(r"``.*?``|`[^`]*`", "Code", text, flags=re.DOTALL)
    text = re.sub(r"https?://\S+|\b10\.\d{4,}/\S+|<!--.*?-->", "address", text)
    return " ".join(re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text).split())


def paragraphs(lines: list[str], first: int = 1, plain: Callable[[str], str] = plain) -> Iterator[Piece]:
    """Yield the paragraphs, list items, headings and cells of a text, without code and formulas."""
    gathered: list[str] = []
    start, indent, fenced, blank, code = first, 0, False, True, False
    for number, line in enumerate([*lines, ""], first):
        depth, fence = len(line) - len(line.lstrip()), line.lstrip().startswith(("```", ">>>", "..."))
        code = bool(line.strip()) and depth >= 4 and (code or blank)
        ends = fence or fenced or code or not line.strip() or line.startswith(("|", "---"))
        item = LIST_ITEM.match(line)
        if gathered and (ends or item or line.startswith("#") or depth != indent):
            yield start, plain("\n".join(gathered)), False
            gathered = []
        fenced ^= line.lstrip().startswith("```")
        blank = not line.strip()
        if line.startswith("|") and not fenced:
            cells = plain(line.replace(r"\|", "")).strip("| ").split("|")
            yield from ((number, cell, True) for cell in cells)
        elif not ends:
            start, indent = (start, indent) if gathered else (number, len(item[0]) if item else depth)
            gathered.append(line)


def words_of_code(source: str) -> Iterator[Piece]:
    """Yield the docstrings and the messages of a Python file."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            yield from paragraphs(inspect.cleandoc(str(node.value.value)).splitlines(), node.lineno)
        elif isinstance(node, ast.Call) and MESSENGER.search(called(node.func)):
            yield from ((item.lineno, plain(message(item)), False) for item in node.args)


def called(node: ast.expr) -> str:
    """Return the name of what is called, without that of its owner."""
    if isinstance(node, ast.IfExp):
        return called(node.orelse)
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""


def message(node: ast.expr) -> str:
    """Return the text of a message, a number in place of each value."""
    if isinstance(node, ast.JoinedStr):
        return "".join(map(message, node.values))
    if isinstance(node, ast.BinOp):
        return message(node.left) + message(node.right)
    return str(node.value) if isinstance(node, ast.Constant) else "1"


def pieces(path: Path) -> list[Piece]:
    """Return what people read of a file."""
    text = path.read_text("utf-8")
    return [*(words_of_code(text) if path.suffix == ".py" else paragraphs(text.splitlines()))]


def findings(path: Path) -> Iterator[tuple[int, str, str]]:
    """Yield the faults of a file: line, rule, words."""
    read, page = pieces(path), path.suffix == ".md"
    for line, text, cell in read:
        yield from ((line, "leading zero", found[0]) for found in BARE_NUMBER.finditer(text))
        for phrase, better in (RIDDLES | PRIVATE if page else RIDDLES).items():
            for found in re.finditer(rf"\b{phrase}\b", text, re.IGNORECASE):
                yield line, "riddle", f"{found[0]!r}: write {better}"
        for sentence in SENTENCE.split(ABBREVIATION.sub(r"\1", text)):
            if (count := len(WORD.findall(sentence))) > MOST_WORDS:
                yield line, "long sentence", f"{count} words: {sentence[:70]} ..."
        if cell and (text.count("/") > 1 or PAIR.search(text)):
            yield line, "slashes", text.strip()
    if page and (total := sum(len(text.split()) for _, text, _ in read)) > LONGEST_PAGE:
        yield 1, "long page", f"{total} words"


def files(names: list[str]) -> list[Path]:
    """Return the pages and Python files of some paths, without pages that the site makes."""
    paths = (ROOT / name for name in names)
    found = (one for path in paths for one in ([path] if path.is_file() else path.rglob("*.[mp][dy]")))
    return sorted(path for path in found if not MADE & {*path.parts})


def reading_ease(path: Path) -> float:
    """Return the reading ease of the sentences of a page after Flesch (1948)."""
    import textstat

    return textstat.flesch_reading_ease(" ".join(text for _, text, cell in pieces(path) if not cell))


def main() -> int:
    """Print the number of findings of each file, and return 1 if there are any."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("paths", nargs="*", default=["README.md", "docs", "rotorfilm"], help="files, folders")
    parser.add_argument("--show", action="store_true", help="print every finding with its line")
    parser.add_argument("--kept", action="store_true", help="check what the list CLEAN names")
    parser.add_argument("--flesch", action="store_true", help="list the reading ease of pages after Flesch")
    options = parser.parse_args()
    faults = 0
    for path in files(CLEAN if options.kept else options.paths):
        if options.flesch:
            print(f"{reading_ease(path):5.0f}  {path.relative_to(ROOT)}")
        elif found := sorted(findings(path)):
            rules = ", ".join(f"{count} {rule}" for rule, count in Counter(one[1] for one in found).items())
            print(f"{path.relative_to(ROOT)}: {len(found)} ({rules})")
            print("".join(f"  {':'.join(map(str, one))}\n" for one in found if options.show), end="")
            faults += len(found)
    print("100 is easy to read, 0 is hard" if options.flesch else f"{faults} findings")
    return min(faults, 1)


if __name__ == "__main__":
    sys.exit(main())
