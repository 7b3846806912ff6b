import math

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm import EquilibriumError, InputError, ValidityWarning, whirl_threshold
from rotorfilm.analysis import coefficient_table, coefficients, equilibria, equilibrium
from rotorfilm.bearings import PadGridFilm
from rotorfilm.bearings.journal import JournalBearing, MapFilm
from rotorfilm.native import loops

SPEEDS = np.concatenate([np.geomspace(20.0, 800.0, 9), [-150.0, 150.0]])


class Counted:
    """Counts the calls of a function of the C library."""

    def __init__(self, function):
        self.function, self.calls, self.targets = function, 0, 0

    def __call__(self, targets, n, points):
        self.calls, self.targets = self.calls + 1, self.targets + n
        return self.function(targets, n, points)


@pytest.fixture
def searches(monkeypatch):
    counted = Counted(loops()["rf_static_places"])
    monkeypatch.setitem(loops(), "rf_static_places", counted)
    return counted


@pytest.mark.filterwarnings("ignore:load .* makes a mean pressure")
@pytest.mark.closed_form
def test_every_point_is_the_closed_form_of_a_short_bearing(bearing, ocvirk):
    ratios = np.array([1e-4, 0.1, 0.5, 0.9, 0.99])
    loads = np.array([[0.0, -ocvirk.load(eps, 100.0)] for eps in ratios]).T
    found = equilibria(bearing, loads, np.full(5, 100.0))
    np.testing.assert_allclose([at.eccentricity_ratio for at in found], ratios, rtol=1e-11)
    np.testing.assert_allclose(
        [at.attitude_angle for at in found], [ocvirk.attitude_angle(eps) for eps in ratios], rtol=1e-10
    )
    assert max(at.residual for at in found) <= 1e-12


@pytest.mark.filterwarnings("ignore:pads .* are unloaded")
@pytest.mark.parametrize("kind", ["map", "lobed", "pads"])
def test_many_points_are_those_found_one_by_one(kind):
    size = {"radius": 0.05, "length": 0.05, "viscosity": 0.02}
    films = {
        "map": lambda: JournalBearing(**size, clearance=1e-4, film=MapFilm()),
        "lobed": lambda: rf.LobedBearing(
            **size,
            pad_clearance=1e-4,
            lobes=tuple(rf.Lobe(start=k * math.pi + 0.2, extent=2.7, preload=0.5) for k in (0, 1)),
            film=PadGridFilm(cells=(48, 8)),
        ),
        "pads": lambda: rf.TiltingPadBearing(
            **size, assembled_clearance=1e-4, pivots=rf.even_pivots(4), extent=1.2
        ),
    }
    film = films[kind]()
    loads = np.array([[100.0, -1500.0]]).T * np.linspace(0.3, 2.0, len(SPEEDS))
    for at, load, speed in zip(equilibria(film, loads, SPEEDS), loads.T, SPEEDS, strict=True):
        alone = equilibrium(film, load, speed)
        np.testing.assert_array_equal(at.position, alone.position)
        assert (at.attitude_angle, at.minimum_film, at.speed) == (
            alone.attitude_angle,
            alone.minimum_film,
            speed,
        )
        force = film.force(at.position, [0.0, 0.0], speed) if kind != "pads" else -load
        np.testing.assert_allclose(force, -load, atol=1e-9 * np.hypot(*load))


def test_a_table_over_speed_is_one_search(bearing, searches):
    table = coefficient_table(bearing, [0.0, -525.0], SPEEDS[:9])
    assert (searches.calls, searches.targets) == (1, 9)
    for k, speed in enumerate(SPEEDS[:9]):
        alone = coefficients(bearing, equilibrium(bearing, [0.0, -525.0], speed).position, speed)
        np.testing.assert_allclose(table.stiffness[k], alone.stiffness, rtol=1e-12)
        np.testing.assert_allclose(table.damping[k], alone.damping, rtol=1e-12)


def test_a_threshold_searches_speeds_in_batches(bearing, searches):
    found = whirl_threshold(bearing, [0.0, -525.0], 53.5)
    assert found.exists
    assert searches.targets < 60
    assert searches.calls < 20


def test_a_point_without_equilibrium_is_refused_as_alone(bearing):
    loads = np.array([[0.0, -525.0], [0.0, -1e14], [0.0, -2e14]]).T
    with pytest.raises(EquilibriumError) as alone:
        equilibrium(bearing, loads[:, 1], 100.0)
    with pytest.raises(EquilibriumError) as among:
        equilibria(bearing, loads, np.full(3, 100.0))
    assert str(among.value) == str(alone.value)


def test_each_speed_has_its_warnings():
    bearing = JournalBearing(radius=0.1, length=0.1, clearance=2e-4, viscosity=0.005)
    with pytest.warns(ValidityWarning, match="3000") as told:
        equilibria(bearing, [0.0, -5000.0], [100.0, 3000.0])
    assert len(told) == 1


@pytest.mark.parametrize(
    ("load", "speeds", "match"),
    [
        ([0.0, -1.0], 100.0, "speeds must be a list"),
        ([[0.0, 0.0, 1.0], [1.0, 1.0, 1.0]], [1.0, 2.0], "one for each of 2 speeds"),
        ([0.0, 0.0], [1.0, 2.0], "load must not be zero"),
        (-5.0, [1.0, 2.0], r"load must be the components \(x, y\)"),
        ([[[0.0]], [[-1.0]]], [1.0], r"load must have shape \(2,\)"),
        ([0.0, -1.0], [1.0, math.nan], "speeds must be finite"),
    ],
)
def test_wrong_arguments_are_named(bearing, load, speeds, match):
    with pytest.raises(InputError, match=match):
        equilibria(bearing, load, speeds)


class Faulty(JournalBearing):
    """A film in Python that fails in its own way."""

    def prepare_tangent(self):
        def tangent(x, y, vx, vy, speed):
            raise FAULT[0]

        return tangent


FAULT = [None]


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ZeroDivisionError("my own"), InputError("my rule")])
def test_the_search_ends_with_the_error_of_a_film_in_python(error):
    FAULT[0] = error
    film = Faulty(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    with pytest.raises(type(error)) as raised:
        equilibrium(film, [0.0, -100.0], 100.0)
    assert raised.value is error
