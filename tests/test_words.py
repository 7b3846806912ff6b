"""The check of words finds each fault that it knows, and nothing in plain sentences."""

import check_words
import pytest

PLAIN = "The journal rests at an eccentricity ratio of 0.5. The error is within 0.4 % (`a/b/c`, `.5`)."


def rules(tmp_path, text, name="page.md"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return [rule for _, rule, _ in check_words.findings(path)]


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        (f"{PLAIN}\nIt is within .4 % at L/D 1.", "leading zero"),
        ("- " + "word\n  " * 41 + "end.", "long sentence"),
        ("All of them but by name.", "riddle"),
        ("The rungs of it.", "riddle"),
        ("| a | b |\n|---|---|\n| 1 [N/m] | 2.1 / 3.1 % |", "slashes"),
        ("One word. " * 1501, "long page"),
    ],
)
def test_a_page_with_one_fault_has_one_finding(text, rule, tmp_path):
    assert rules(tmp_path, text) == [rule]


@pytest.mark.parametrize(
    "text",
    [
        PLAIN,
        f"{PLAIN}\n\n    code = .5 + x[.3]\n\nAnd so on.",
        "```python\nx = .5\n```\n[A page](a/.5/c.md), after A. Author et al. (1990).",
        "| value | unit |\n|---|---|\n| 1.5 | N s/m |",
        "\n\n".join(["word " * 39 + "end."] * 3),
    ],
)
def test_plain_words_have_no_finding(text, tmp_path):
    assert rules(tmp_path, text) == []


def test_docstrings_and_messages_are_read(tmp_path):
    code = '"""A film.\n\nIts errors are .5 %.\n"""\nraise InputError(f"all of {x} but by {y}, at most .2")\n'
    assert sorted(rules(tmp_path, code, "film.py")) == ["leading zero", "leading zero", "riddle"]


def test_what_is_clean_stays_clean():
    found = {path.name: list(check_words.findings(path)) for path in check_words.files(check_words.CLEAN)}
    assert not any(found.values()), found
