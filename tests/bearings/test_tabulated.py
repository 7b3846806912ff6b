"""Coefficient tables over speed."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, Reaction, TabulatedBearing, ValidityWarning
from rotorfilm.analysis import coefficient_table, coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, ShortFilm

FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
LOAD = [0.0, -525.0]
SPEEDS = np.linspace(50.0, 400.0, 15)


@pytest.fixture(scope="module")
def table():
    return coefficient_table(FILM, LOAD, SPEEDS)


def test_it_is_the_film_at_its_own_speeds(table):
    assert isinstance(table, Reaction)
    at = equilibrium(FILM, LOAD, SPEEDS[3])
    film = coefficients(FILM, at.position, at.speed)
    q, v = np.array([1e-6, -2e-6]), np.array([1e-3, 2e-3])
    assert_allclose(table.force(q, v, SPEEDS[3]), -film.stiffness @ q - film.damping @ v, rtol=1e-12)


def test_between_speeds_it_is_close(table):
    speed = 0.5 * (SPEEDS[5] + SPEEDS[6])
    at = equilibrium(FILM, LOAD, speed)
    wanted = coefficients(FILM, at.position, speed)
    found = coefficients(table, [0.0, 0.0], speed)
    for name in ("stiffness", "damping"):
        exact = getattr(wanted, name)
        assert_allclose(getattr(found, name), exact, atol=5e-3 * np.abs(exact).max())


def test_derivatives_by_speed_too(table):
    q, v, speed, h = np.array([1e-6, -2e-6]), np.array([1e-3, 2e-3]), 123.0, 0.1
    jacobian = table.jacobian(q, v, speed)
    steps = {k: table.force(q, v, speed + k * h) for k in (-2, -1, 1, 2)}
    slope = (steps[-2] - 8 * steps[-1] + 8 * steps[1] - steps[2]) / (12 * h)
    assert_allclose(jacobian[:, 4], slope, rtol=1e-6)
    assert_allclose(jacobian[:, :4] @ [*q, *v], table.force(q, v, speed), rtol=1e-12)


def test_batches(table):
    q, v = np.random.default_rng(0).standard_normal((2, 2, 3))
    speeds = np.array([60.0, 70.0, 80.0])
    force, jacobian = table.force(q, v, speeds), table.jacobian(q, v, speeds)
    assert (force.shape, jacobian.shape) == ((2, 3), (2, 5, 3))
    for k, speed in enumerate(speeds):
        assert_allclose(force[:, k], table.force(q[:, k], v[:, k], speed))
        assert_allclose(jacobian[:, :, k], table.jacobian(q[:, k], v[:, k], speed))
    assert table.force(q, v, 60.0).shape == (2, 3)
    assert table.jacobian(q, v, 60.0).shape == (2, 5, 3)


@pytest.mark.parametrize("kind", [str, Path])
def test_a_file_is_named_by_text_or_path(table, tmp_path, kind):
    path = kind(tmp_path / "table.csv")
    table.to_csv(path)
    assert_allclose(TabulatedBearing.from_csv(path).speeds, SPEEDS)


def test_csv_and_back(table, tmp_path):
    path = table.to_csv(tmp_path / "film.csv")
    assert (
        path.read_text()
        .splitlines()[0]
        .startswith("speed [rad/s],kxx [N/m],kxy [N/m],kyx [N/m],kyy [N/m],cxx")
    )
    again = TabulatedBearing.from_csv(path)
    assert_allclose(again.stiffness, table.stiffness, rtol=1e-8)
    assert_allclose(again.damping, table.damping, rtol=1e-8)
    (tmp_path / "other.csv").write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match="must have a column 'speed', got"):
        TabulatedBearing.from_csv(tmp_path / "other.csv")
    (tmp_path / "words.csv").write_text(path.read_text().replace("50,", "fifty,", 1))
    with pytest.raises(InputError, match=r"must hold numbers below '(kxx|speed)'"):
        TabulatedBearing.from_csv(tmp_path / "words.csv")


def test_foreign_tables_are_read_in_their_units_and_order(tmp_path):
    path = tmp_path / "foreign.csv"
    path.write_text("Kyy (kN/mm),n,hor. [N/um],Cxx [N s/mm],note\n2,600,1,3,a\n4,1200,2,5,b\n")
    found = TabulatedBearing.from_csv(path, columns={"Kxx": "hor. [N/um]", "speed": "n [rpm]"})
    assert_allclose(found.speeds, np.array([600.0, 1200.0]) * np.pi / 30.0)
    assert_allclose(found.stiffness[0], [[1e6, 0.0], [0.0, 2e6]])
    assert_allclose(found.damping[1], [[5e3, 0.0], [0.0, 0.0]])
    again = found.to_csv(tmp_path / "own.csv", speed_unit="rpm")
    assert again.read_text().splitlines()[1].startswith("600,1000000,")
    assert_allclose(TabulatedBearing.from_csv(again).speeds, found.speeds, rtol=1e-8)
    for columns, message in (
        ({"Kxx": "hor.", "speed": "rpm"}, "must have a column 'rpm'"),
        ({"K": "hor."}, "columns must be of speed, kxx.*got 'k'"),
        ({"Kxx": "hor. [N/um]"}, "must have a column 'speed'"),
        ({"Kxx": "hor. [N]", "speed": "n [rpm]"}, "must hold numbers below 'kxx': .*measured in N/m"),
    ):
        with pytest.raises(InputError, match=message):
            TabulatedBearing.from_csv(path, columns=columns)


def test_columns_that_are_not_read_or_stand_twice_are_told(tmp_path):
    path = tmp_path / "foreign.csv"
    path.write_text("speed [rpm],Kxx [N/m],K_xy [N/m],Kyy [N/m]\n600,1,5,2\n")
    with pytest.warns(
        ValidityWarning, match="kxy, kyx, .* are taken as 0, and the columns 'K_xy .* not read"
    ):
        TabulatedBearing.from_csv(path)
    with warnings.catch_warnings(action="error"):
        named = {"kxy": "K_xy"}
        assert TabulatedBearing.from_csv(path, columns=named).stiffness[0][0][1] == 5.0
    path.write_text("speed [rpm],Kxx [N/m],Kxx [N/mm],Kyy [N/m]\n600,1,5,2\n")
    with pytest.raises(InputError, match="must have one column 'kxx'"):
        TabulatedBearing.from_csv(path)


def test_a_unit_that_is_not_known_is_not_passed_over(tmp_path):
    """A force per angle has no other unit than N/rad."""
    freedoms = ("z", "tilt_x")
    table = TabulatedBearing(
        speeds=[1.0], stiffness=[[[1.0, 2.0], [3.0, 4.0]]], damping=np.zeros((1, 2, 2)), freedoms=freedoms
    )
    path = table.to_csv(tmp_path / "own.csv")
    assert_allclose(TabulatedBearing.from_csv(path).stiffness, table.stiffness)
    path.write_text(path.read_text().replace("[N/rad]", "[kN/rad]"))
    with pytest.raises(InputError, match="must hold numbers below 'k_z_tilt_x'"):
        TabulatedBearing.from_csv(path)


@pytest.mark.parametrize("speed", [49.9, 400.1, [100.0, 401.0], -100.0])
def test_it_refuses_speeds_outside_its_range(table, speed):
    q = np.zeros((2, *np.shape(speed)))
    for call in (table.force, table.jacobian):
        with pytest.raises(InputError, match="speed must be within the table, 50 to 400 rad/s"):
            call(q, q, speed)


def test_bad_tables_are_named():
    one = np.zeros((1, 2, 2))
    with pytest.raises(InputError, match=r"stiffness must have shape \(2, 2, 2\), got \(1, 2, 2\)"):
        TabulatedBearing(speeds=[1.0, 2.0], stiffness=one, damping=one)
    with pytest.raises(InputError, match="speeds must be a list of rising numbers"):
        TabulatedBearing(speeds=[2.0, 1.0], stiffness=one, damping=one)
    single = TabulatedBearing(speeds=[5.0], stiffness=one + np.eye(2), damping=one)
    assert_allclose(single.force([1.0, 2.0], [0.0, 0.0], 5.0), [-1.0, -2.0])
    assert not single.jacobian([1.0, 2.0], [0.0, 0.0], 5.0)[:, 2:].any()
