"""Operating points of the contact: the law of similarity, points on disk, points between points."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import ContactGrid, InputError, Linearization, PointContact, reduce_contact
from rotorfilm.bearings import BarusViscosity, DowsonHigginsonDensity, RoelandsViscosity, interpolate_contact
from rotorfilm.bearings.contact import contact_law as contact_points
from rotorfilm.bearings.contact.contact_law import (
    FREQUENCIES,
    kept_points,
    operating_point,
    transfer,
    under_load,
)

GRID = ContactGrid(cells=(20, 20))


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture(scope="module")
def lattice(tmp_path_factory):
    """Return a folder with nine points."""
    folder = tmp_path_factory.mktemp("lattice")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(folder))
        for V in (0.07, 0.1, 0.14):
            for Q0 in (4.0, 5.0, 6.0):
                operating_point(contact(V, Q0).equations)
    return folder


def contact(V=0.1, Q0=5.0, **change):
    return PointContact(V=V, Q0=Q0, grid=GRID, **change)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "change",
    [{}, {"piezoviscosity": RoelandsViscosity(exponent=0.6, pressure_ratio=2.0)},
     {"density": DowsonHigginsonDensity(pressure_ratio=0.8)}],
    ids=["barus", "roelands", "compressible"],
)  # fmt: skip
def test_a_contact_under_a_load_is_one_under_the_unit_load_in_other_units(change):
    # The rectangle too is scaled: lengths in a go with the cube root of the load, films with its square.
    load = 1.7
    growth = load ** (1.0 / 3.0)
    here = contact(**change)
    wide = replace(
        here,
        grid=ContactGrid(
            cells=GRID.cells,
            inlet=growth * GRID.inlet,
            outlet=growth * GRID.outlet,
            half_width=growth * GRID.half_width,
        ),
    )
    there = under_load(here.equations, load)
    scaled = PointContact(
        V=there.V, Q0=there.Q0, grid=GRID, piezoviscosity=there.viscosity, density=there.density
    )
    assert wide.stationary(load).delta == pytest.approx(growth**2 * scaled.stationary().delta, rel=1e-6)


def test_a_point_is_computed_once(monkeypatch, folder):
    first = operating_point(contact().equations)
    monkeypatch.setattr(contact_points, "_computed", lambda equations: pytest.fail("computed again"))
    again = operating_point(contact().equations)
    assert all(np.array_equal(a, b) for a, b in zip(first, again, strict=True))
    assert len(list(folder.glob("contact-*.npz"))) == 1
    assert reduce_contact(contact()).operating == first.delta[3]


def test_a_damaged_point_is_computed_again(folder, monkeypatch):
    first = operating_point(contact().equations)
    (path,) = folder.glob("contact-*.npz")
    whole = path.read_bytes()
    # Cut off, emptied, as zip that needs what is not there, and with another V: one byte of each changed.
    flipped = [whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :] for k in (8, 150, len(whole) - 5)]
    for damaged in (whole[:100], b"PK", b"", *flipped):
        path.write_bytes(damaged)
        with pytest.warns(RuntimeWarning, match=rf"left out: '{path}' must"):
            assert kept_points(contact().equations) == []
    monkeypatch.setattr(contact_points, "_computed", lambda equations: first)
    with pytest.warns(RuntimeWarning, match=rf"operating point is made again: '{path}' must"):
        operating_point(contact().equations)
    assert path.read_bytes() == whole
    path.rename(contact_points._path(contact(V=0.2).equations))
    with pytest.warns(RuntimeWarning, match="must be what its name says"):
        operating_point(contact(V=0.2).equations)


def test_points_of_another_grid_or_lubricant_are_kept_apart():
    operating_point(contact().equations)
    assert len(kept_points(contact(V=0.2).equations)) == 1
    assert kept_points(replace(contact(), grid=ContactGrid(cells=(24, 24))).equations) == []
    assert (
        kept_points(contact(piezoviscosity=RoelandsViscosity(exponent=0.6, pressure_ratio=2.0)).equations)
        == []
    )
    assert kept_points(contact(density=DowsonHigginsonDensity(pressure_ratio=0.8)).equations) == []
    assert isinstance(contact().piezoviscosity, BarusViscosity)


@pytest.mark.long
def test_a_law_between_points_is_as_good_as_it_says(lattice, monkeypatch):
    direct = reduce_contact(contact(0.085, 4.4))  # kept elsewhere
    monkeypatch.setenv("ROTORFILM_CACHE", str(lattice))
    between = interpolate_contact(contact(0.085, 4.4))
    assert between.static_error < 0.01
    assert between.damping_error < 0.1
    z = direct.approach(np.array([0.3, 1.0, 2.5]))
    miss = np.max(np.abs(between.static_force(z) / direct.static_force(z) - 1.0))
    assert 0.0 < miss <= between.static_error
    dampings = [
        -transfer(Linearization(one.A, one.B, one.C, one.D), 1j * FREQUENCIES).imag / FREQUENCIES
        for one in (direct, between)
    ]
    assert np.max(np.abs(dampings[1] - dampings[0])) <= between.damping_error * np.max(dampings[0])
    # Another load is another place among the same points: the law in the units of the unit load.
    heavy = interpolate_contact(contact(0.1 * 1.1 ** (4.0 / 3.0), 5.0 / 1.1 ** (1.0 / 3.0)), load=1.1)
    unit = reduce_contact(contact())
    assert float(heavy.approach(1.1)) == pytest.approx(1.1 ** (2.0 / 3.0) * unit.operating, rel=1e-3)
    assert heavy.stiffness == pytest.approx(1.1 ** (1.0 / 3.0) * unit.stiffness, rel=2e-3)


def test_outside_of_the_points_there_is_no_interpolation(lattice, monkeypatch):
    with pytest.raises(
        InputError, match=r"must lie among at least 4 operating points on disk, got 0\.1 and 5"
    ):
        interpolate_contact(contact())
    monkeypatch.setenv("ROTORFILM_CACHE", str(lattice))
    with pytest.raises(InputError, match=r"got 0\.3 and 5 with 9 of this grid"):
        interpolate_contact(contact(0.3))
    with pytest.raises(InputError, match="load must be finite and positive"):
        interpolate_contact(contact(), load=-1.0)
    assert math.isfinite(interpolate_contact(contact(), order=2).damping_error)
