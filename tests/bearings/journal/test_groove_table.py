"""Tables of grooved bearings: bytes, damage, and the cache on disk."""

import dataclasses
import os

import numpy as np
import pytest

from rotorfilm import Groove, InputError, RotorfilmError
from rotorfilm.bearings import FilmGeometry, aligned_openings
from rotorfilm.bearings.films.map_fit import periodic_quintic, periodic_quintic_coefficients
from rotorfilm.bearings.films.map_table import cache_folder, cached_table
from rotorfilm.bearings.journal import GrooveMapTable
from rotorfilm.bearings.journal.groove_map import CELLS, DIRECTIONS, GrooveMap, Resolution

GROOVES = (Groove(center=0.1, width=0.2), Groove(center=2.0, width=0.3))
FINE = Resolution((96, 8), (8, 24, 24), 0.9)


def some_table(seed=0):
    rng = np.random.default_rng(seed)
    return GrooveMapTable(
        slenderness=0.5,
        grooves=GROOVES,
        reach=2.0,
        crowding=0.6,
        log_center=rng.normal(size=DIRECTIONS),
        coefficients=rng.normal(size=(11, 8, 12)),
        shear=rng.normal(size=(2, 3, 11, 8, CELLS + 5)),
        flows=rng.normal(size=(2, 2, 2, 11, 8)),
        bounds=rng.uniform(size=(2, 5)),
    )


def openings(turn=0.0):
    grooves = tuple(dataclasses.replace(g, center=g.center + turn) for g in GROOVES)
    return aligned_openings(FilmGeometry(grooves=grooves))


def test_bytes_and_back(tmp_path):
    table = some_table()
    assert GrooveMapTable.from_bytes(table.to_bytes()) == table
    assert hash(GrooveMapTable.from_bytes(table.to_bytes())) == hash(table)
    assert some_table(1) != table
    table.save(tmp_path / "map.bin")
    assert GrooveMapTable.load(tmp_path / "map.bin") == table


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda b: b[:-8], "GrooveMapTable: the checksum does not fit"),
        (lambda b: b"x" + b[1:], "does not begin with the mark of a table"),
        (lambda b: b[:8] + b"\x09" + b[9:], "version must be 1, got 9"),
        (lambda b: b[:-3] + b"abc", "the checksum does not fit"),
        (lambda b: b[:16] + b"\xff" * 4 + b[20:], "the checksum does not fit"),
        (lambda b: b"", "does not begin"),
    ],
)
def test_damaged_bytes_are_refused(damage, message):
    with pytest.raises(RotorfilmError, match=message):
        GrooveMapTable.from_bytes(damage(some_table().to_bytes()))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"coefficients": np.zeros((11, 8))}, "coefficients must be finite, of shape"),
        ({"log_center": np.zeros(5)}, r"log_center must be finite, of shape \(192\), got shape \(5,\)"),
        ({"coefficients": np.full((11, 8, 12), np.nan)}, "must be finite"),
        ({"bounds": np.zeros(3)}, r"bounds must have shape \(bands, 5\)"),
        ({"bounds": np.full((2, 5), np.nan)}, "bounds must .* not be negative"),
        ({"shear": np.zeros((2, 3, 11, 8, 5))}, r"shear must be finite, of shape \(2, 3, 11, 8, 13\)"),
        ({"flows": np.full((2, 2, 2, 11, 8), np.inf)}, "flows must be finite"),
        ({"crowding": 0.0}, r"crowding in \(0, 1\], got 0\.5, 2\.0 and 0\.0"),
    ],
)
def test_impossible_tables_are_refused(changes, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(some_table(), **changes)


def test_table_is_built_once_and_again_after_damage(tmp_path):
    path, built = tmp_path / "new" / "map.bin", []

    def build():
        built.append(1)
        return some_table()

    assert (
        cached_table(GrooveMapTable, path, build) == cached_table(GrooveMapTable, path, build) == some_table()
    )
    assert len(built) == 1
    path.write_bytes(path.read_bytes()[:-9] + b"damaged!!")
    with pytest.warns(RuntimeWarning, match=r"made again: '.*map\.bin' .* is damaged"):
        assert cached_table(GrooveMapTable, path, build) == some_table()
    assert len(built) == 2
    assert cached_table(GrooveMapTable, path, build) == some_table()
    assert len(built) == 2
    assert [entry.name for entry in path.parent.iterdir()] == ["map.bin"]


def test_folder_that_cannot_be_written_costs_a_warning_only(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.warns(RuntimeWarning, match="ROTORFILM_CACHE names another folder"):
        assert cached_table(GrooveMapTable, tmp_path / "file" / "map.bin", some_table) == some_table()


def test_failed_writing_leaves_nothing_behind(tmp_path, monkeypatch):
    def refuse(*_):
        raise PermissionError("no")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.warns(RuntimeWarning, match="could not be kept"):
        cached_table(GrooveMapTable, tmp_path / "map.bin", some_table)
    assert list(tmp_path.iterdir()) == []


def test_interrupted_writing_leaves_nothing_behind(tmp_path, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        cached_table(GrooveMapTable, tmp_path / "map.bin", some_table)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name != "posix", reason="elsewhere there is no umask")
def test_file_has_the_mode_of_the_umask(tmp_path):
    before = os.umask(0o027)
    try:
        cached_table(GrooveMapTable, tmp_path / "map.bin", some_table)
    finally:
        os.umask(before)
    assert (tmp_path / "map.bin").stat().st_mode & 0o777 == 0o640


def test_table_under_the_name_of_another_is_built_anew(tmp_path):
    cached_table(GrooveMapTable, tmp_path / "other.bin", lambda: some_table(1))
    (tmp_path / "other.bin").rename(tmp_path / "map.bin")
    with pytest.warns(RuntimeWarning, match="must be what its name says"):
        assert cached_table(GrooveMapTable, tmp_path / "map.bin", some_table) == some_table()


def test_name_in_the_cache_tells_what_decides_the_content(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    here = GrooveMap(openings(), 0.5, FINE).path
    assert here.parent == tmp_path
    assert GrooveMap(openings(1.2345), 0.5, FINE).path == here
    wider = aligned_openings(FilmGeometry(grooves=(GROOVES[0], dataclasses.replace(GROOVES[1], width=0.31))))
    others = {
        GrooveMap(wider, 0.5, FINE).path,
        GrooveMap(openings(), 0.51, FINE).path,
        GrooveMap(openings(), 0.5, FINE._replace(cells=(128, 8))).path,
        GrooveMap(openings(), 0.5, FINE._replace(nodes=(8, 24, 36))).path,
        GrooveMap(openings(), 0.5, FINE._replace(largest_eccentricity_ratio=0.95)).path,
    }
    assert len(others | {here}) == 6


@pytest.mark.skipif(os.name != "posix", reason="the variable is that of the freedesktop specification")
def test_folder_follows_the_platform(tmp_path, monkeypatch):
    monkeypatch.delenv("ROTORFILM_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() == tmp_path / "rotorfilm"


@pytest.mark.convergence
def test_periodic_spline_is_of_sixth_order():
    def error(count):
        nodes = np.exp(np.sin(2.0 * np.pi * np.arange(count) / count))
        at = np.linspace(-1.0, 2.0, 501)
        found = periodic_quintic(periodic_quintic_coefficients(nodes), at)
        return np.abs(found - np.exp(np.sin(2.0 * np.pi * at))).max()

    assert np.log2(error(32) / error(64)) == pytest.approx(6.0, abs=0.5)
