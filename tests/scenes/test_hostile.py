"""Any value at any key of a scene: it is read, or an error of one line names a key that is there."""

import copy
import math
import re
import tomllib
import warnings
from importlib import resources
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import SceneError
from rotorfilm.scenes import read_scene

DATA = Path(str(resources.files("rotorfilm.scenes"))) / "data"
SHIPPED = sorted([*(Path(__file__).parents[2] / "examples").glob("**/*.toml"), *DATA.glob("*.toml")])
SCENES = {path.name: tomllib.loads(path.read_text(encoding="utf-8")) for path in SHIPPED}

LONGEST = 700
"""Characters of a message: the rule may list what is known, the value is cut."""

EXTREMES = [
    *(math.nan, math.inf, -math.inf, 1e300, 1e-300, 1e30, -1e30, 1e-30, 1e12, -1.0, -1, 0, 1, 10**9),
    *(2**70, 10**400, 16**6000, True, "", "x", "-1 m", "1e400 m", "nan", "\x1b[2J[/bold]", "x" * 50_000),
    *(
        [],
        [1],
        [1e6, 1e6],
        [10**6, 10**6],
        [2**40] * 3,
        [[1, 2], [3, 4]],
        {},
        {"a": 1},
        [{}],
        ["x" * 9999] * 9,
    ),
]
NAMES = st.text("ab_\N{LATIN SMALL LETTER E WITH ACUTE}", min_size=1, max_size=5)
VALUES = st.recursive(
    st.integers() | st.floats() | st.booleans() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3),
    max_leaves=6,
)


def places(data, path=()):
    """Return the path to every value of nested tables and lists."""
    entries = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in entries:
        yield (*path, key)
        yield from places(value, (*path, key))


PLACES = [(name, place) for name, data in SCENES.items() for place in places(data)]
KEYS = {tuple(part for part in place if isinstance(part, str)): (name, place) for name, place in PLACES}
"""One place for each key, in the scene that has it last."""


def replaced(data, place, value):
    """Return a copy of nested tables with another value at a place."""
    data = copy.deepcopy(data)
    inner = data
    for part in place[:-1]:
        inner = inner[part]
    inner[place[-1]] = value
    return data


def is_there(data, dotted):
    """Return whether tables have a key, or where it would have to be."""
    inner = data
    for part in re.findall(r"\w+", dotted)[:-1]:
        inner = inner[int(part)] if isinstance(inner, list) else inner[part]
    last = re.findall(r"\w+", dotted)[-1]
    return int(last) < len(inner) if isinstance(inner, list) else last in inner


def bad_refusal(data):
    """Return the error that refuses a scene if it is no short line about a key in it or missing from it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read_scene(data, "case.toml")
    except SceneError as error:
        message = str(error)
        found = re.match(r"case\.toml: ([\w.\[\]]+)", message)
        short = len(message) < LONGEST and message.isprintable()
        named = found and (
            is_there(data, found[1]) or re.search("is required|no such table|must have", message)
        )
        return "" if short and named else message
    return ""


@pytest.mark.parametrize("key", KEYS, ids=".".join)
def test_extreme_values_at_every_key_are_read_or_named(key):
    name, place = KEYS[key]
    for value in EXTREMES:
        assert not bad_refusal(replaced(SCENES[name], place, value))


@settings(max_examples=60, deadline=None)
@given(where=st.sampled_from(PLACES), value=VALUES)
def test_any_value_at_any_key_is_read_or_named(where, value):
    name, place = where
    assert not bad_refusal(replaced(SCENES[name], place, value))
