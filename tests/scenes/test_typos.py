"""A typo in any key of a scene is reported with the file, the dotted key and the nearest valid one."""

import re
import tomllib
from importlib import resources
from pathlib import Path

import pytest

from rotorfilm import SceneError
from rotorfilm.scenes import Scene, parse_scene, read_scene
from rotorfilm.scenes.reading import Quantity, Table, TableList, Variant, keyed, nearest

DATA = Path(str(resources.files("rotorfilm.scenes"))) / "data"
SHIPPED = sorted([*(Path(__file__).parents[2] / "examples").glob("**/*.toml"), *DATA.glob("*.toml")])


def typos(key):
    """Return a letter left out, one doubled, two exchanged."""
    middle = len(key) // 2
    swapped = key[: middle - 1] + key[middle] + key[middle - 1] + key[middle + 1 :]
    wrong = [key[:middle] + key[middle + 1 :], key[:middle] + key[middle] + key[middle:], swapped]
    return [typo for typo in wrong if typo != key]  # two equal letters cannot be exchanged


def keys(data, path=()):
    """Return the path to every key of nested tables and lists."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield (*path, key)
            yield from keys(value, (*path, key))
    elif isinstance(data, list):
        for number, value in enumerate(data):
            yield from keys(value, (*path, number))


def renamed(data, path, name):
    """Return a copy of nested tables in which the key at the end of a path has another name."""
    head, *rest = path
    if isinstance(data, list):
        return [renamed(value, rest, name) if k == head else value for k, value in enumerate(data)]
    if not rest:
        return {name if key == head else key: value for key, value in data.items()}
    return {key: renamed(value, rest, name) if key == head else value for key, value in data.items()}


def dotted(path):
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def table_types(table):
    """Return a table of the schema and all tables below it."""
    yield table
    for reader in keyed(table).readers.values():
        if isinstance(reader, Table | TableList):
            yield from table_types(reader.table)
        elif isinstance(reader, Variant):
            for variant in reader.variants.values():
                yield from table_types(variant)


def known_keys(table):
    readers = keyed(table).readers
    return [*readers, *(r.twice for r in readers.values() if isinstance(r, Quantity) and r.twice)]


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_typo_in_any_key_of_a_shipped_scene_is_reported(path):
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    places = list(keys(data))
    assert len(places) > 5
    for place in places:
        for typo in typos(place[-1]):
            broken = renamed(data, place, typo)
            wrong = re.escape(f"{path.name}: {dotted((*place[:-1], typo))} is no known key")
            hint = re.escape(f"did you mean {place[-1]!r}?")
            with pytest.raises(SceneError, match=f"{wrong}.*{hint}"):
                read_scene(broken, path.name)


TABLES = {keyed(table).makes.__name__: table for table in table_types(Scene)}


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_typo_in_any_key_of_any_table_has_that_key_as_the_nearest(table):
    for key in known_keys(table):
        for typo in typos(key):
            if typo not in known_keys(table):
                assert nearest(typo, known_keys(table)) == f"; did you mean {key!r}?", typo


def test_capital_letters_are_a_typo_too():
    assert nearest("Clearance", ["radius", "clearance"]) == "; did you mean 'clearance'?"
    assert nearest("zzz", ["radius", "clearance"]) == ""


@pytest.mark.parametrize(
    ("document", "line"),
    [
        ("schema = 1\n[journal\nradius = 1\n", r"line 2, column 9"),
        ("schema = 1\n[journal]\nradius = \n", r"line 3, column 10"),
        ("schema = 1\nradius = 1\nradius = 2\n", r"line 3, column 11"),
        ("schema = 1\n[journal]\n[journal]\n", r"line 3, column 9"),
        ('schema = 1\n[journal]\nfilm = """short\n', r"line 3, the last"),
        ("schema = 1\ntitle = 'a\nb'\n", r"line 2, column 11"),
        ("schema = 1\n[journal]\nlength = 60 mm\n", r'in quotes, as "60 mm"'),
    ],
)
def test_syntax_error_is_reported_with_its_line(document, line):
    with pytest.raises(SceneError, match=rf"case\.toml: not valid TOML: .*{line}"):
        parse_scene(document, "case.toml")
