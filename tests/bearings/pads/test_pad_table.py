"""Maps of pads as bytes and on disk."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import InputError, RotorfilmError
from rotorfilm.bearings import PadMapFilm, PadResolution
from rotorfilm.bearings.pads.pad_build import PadMap
from rotorfilm.bearings.pads.pad_film import pad_map
from rotorfilm.bearings.pads.pad_table import PadMapTable

COARSE = PadResolution(cells=(16, 4), nodes=(6, 6, 12), xi_range=(-0.3, 0.9))
STATE = np.array([[0.3], [0.2]]), np.array([[0.4], [-0.7]])


@pytest.fixture(scope="module")
def made():
    return PadMap(1.1, 0.5, COARSE).built()


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    return tmp_path


def test_bytes_are_the_table(made, tmp_path):
    again = PadMapTable.from_bytes(made.to_bytes())
    assert again == made
    assert hash(again) == hash(made)
    np.testing.assert_array_equal(again.bounds, made.bounds)
    np.testing.assert_array_equal(again.kernel().force(*STATE).values, made.kernel().force(*STATE).values)
    made.save(tmp_path / "pad.bin")
    assert PadMapTable.load(tmp_path / "pad.bin") == made
    assert dataclasses.replace(made, extent=1.2) != made


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda content: b"RFGROOVE" + content[8:], "PadMapTable: the content does not begin with the mark"),
        (lambda content: content[:-8], "PadMapTable: the checksum does not fit"),
        (lambda content: content[:-1] + bytes([content[-1] ^ 1]), "PadMapTable: the checksum does not fit"),
        (lambda content: content[:8] + b"\x63" + content[9:], "PadMapTable: version must be 1, got 99"),
    ],
)
def test_damaged_bytes_are_refused(made, damage, message):
    with pytest.raises(RotorfilmError, match=message):
        PadMapTable.from_bytes(damage(made.to_bytes()))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"coefficients": np.zeros((6, 5, 6))}, r"got shape \(6, 5, 6\)"),
        ({"coefficients": np.full((6, 6, 6), np.nan)}, "coefficients must be finite"),
        ({"bounds": np.zeros((3, 4))}, r"bounds must have shape \(bands, 5\)"),
        ({"bounds": np.full((4, 5), -1.0)}, "not be negative"),
        ({"losses": np.zeros((3, 17, 12))}, r"losses must be finite, of shape \(3, 17, 72\)"),
        ({"extent": np.pi}, "extent below pi"),
        ({"slenderness": 0.0}, "must be positive"),
        ({"y_end": np.inf}, "must be positive"),
        ({"u_range": (1.0, 1.0)}, "must be positive"),
    ],
)
def test_table_that_breaks_a_rule_is_refused(made, changes, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(made, **changes)


def test_map_is_made_once_for_a_shape_and_again_after_damage(folder, caplog):
    said = []
    table = pad_map(np.pi / 3.0, 1.0 / 3.0, COARSE).kept(lambda fraction, text: said.append(fraction))
    assert said[-1] == 1.0
    assert caplog.records == []
    assert (
        pad_map(float(f"{np.pi / 3.0:.9g}"), 0.333333333, COARSE).kept(lambda *_: said.append(0.0)) == table
    )
    assert said[-1] == 1.0
    (path,) = folder.iterdir()
    assert path.name.startswith("pad-")
    path.write_bytes(path.read_bytes()[:-9] + b"damaged!!")
    with pytest.warns(RuntimeWarning, match="the map of the film is made again"):
        assert pad_map(np.pi / 3.0, 1.0 / 3.0, COARSE).kept(lambda *_: None) == table
    assert pad_map(np.pi / 3.0, 1.0 / 3.0, COARSE).kept() == table
    assert caplog.records == []


def test_first_use_is_logged_and_its_time_is_told_beforehand(folder, caplog):
    film = PadMapFilm(resolution=COARSE)
    assert film.making_time(1.1, 0.5) > 0.0
    kernel = film.kernel(1.1, 0.5)
    (record,) = caplog.records
    assert "making the map of the pad, about " in record.getMessage()
    assert record.getMessage().endswith(f"1.1 rad, length/diameter 0.5; it will be kept in {folder}")
    assert film.making_time(1.1, 0.5) == 0.0
    assert film.kernel(1.1, 0.5) is kernel


@pytest.mark.long
def test_name_in_the_cache_tells_what_decides_the_content(folder):
    shapes = [
        (1.1, 0.5, COARSE),
        (1.100001, 0.5, COARSE),
        (1.1, 0.500001, COARSE),
        (1.1, 0.5, dataclasses.replace(COARSE, cells=(16, 8))),
        (1.1, 0.5, dataclasses.replace(COARSE, nodes=(6, 6, 14))),
        (1.1, 0.5, dataclasses.replace(COARSE, xi_range=(-0.3, 0.91))),
        (1.1, 0.5, dataclasses.replace(COARSE, reach=0.94)),
    ]
    for shape in shapes:
        pad_map(*shape).kept(lambda *_: None)
    assert len(list(folder.iterdir())) == len(shapes)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3.2, 0.5), "extent must be 0.1 to 3.1 for a map of a pad, got 3.2"),
        ((0.05, 0.5), "extent must be"),
        ((1.0, 0.0), "length/diameter must be 0.05 to 20.0 for a map of a pad, got 0.0"),
        ((np.nan, 0.5), "extent must be a single finite number"),
    ],
)
def test_pad_without_a_map_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        pad_map(*arguments, COARSE).kept()
