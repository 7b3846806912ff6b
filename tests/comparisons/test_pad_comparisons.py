"""Bearings of pads side by side: their coefficients, their thresholds, and the films of their pads."""

import csv
import math

import numpy as np
import pytest

from rotorfilm import (
    InputError,
    JournalBearing,
    Pad,
    ReynoldsFilm,
    coefficients,
    equilibrium,
    whirl_threshold,
)
from rotorfilm.bearings import PadGridFilm
from rotorfilm.core import write_csv
from rotorfilm.studies import (
    WHIRL_OUTCOMES,
    StudyModel,
    bearing_coefficients,
    bearing_thresholds,
    bearing_types,
    pad_accuracy,
    pad_rungs,
)
from rotorfilm.studies.bearing_types import CLEARANCE, RADIUS, VISCOSITY
from rotorfilm.studies.pad_accuracy import compared_bearings, lobe_states, way_to_contact

GRIDS = [rung for rung in pad_rungs() if rung.family == "grid"]


@pytest.fixture(scope="module")
def plain():
    """Return two grooves as the product's plain bearing on its own grid, which shares no pad."""
    pads = tuple(Pad(start=math.radians(start), extent=math.radians(160.0)) for start in (10.0, 190.0))
    return JournalBearing(
        radius=RADIUS,
        length=2.0 * RADIUS * 0.5,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        pads=pads,
        film=ReynoldsFilm(cells=(384, 16)),
    )


def test_types_share_journal_bore_and_oil():
    kinds = list(bearing_types(0.7).values())
    for name, value in (("radius", RADIUS), ("viscosity", VISCOSITY), ("length", 0.07)):
        assert [getattr(bearing, name) for bearing in kinds] == pytest.approx([value] * len(kinds), rel=1e-14)
    # A centered journal has the assembled clearance where a pad is closest: at the pivot of one that tilts.
    films = [float(bearing.minimum_film(np.zeros(2))) for bearing in kinds]
    assert films == pytest.approx([CLEARANCE] * len(kinds), rel=1e-12)


def test_coefficients_over_the_sommerfeld_number(plain):
    S = 0.5
    found = bearing_coefficients(0.5, sommerfeld=[S])
    turns = 300.0 / (2.0 * math.pi)
    load = VISCOSITY * turns * 0.05 * 0.1 * (RADIUS / CLEARANCE) ** 2 / S
    at = equilibrium(plain, (0.0, -load), 300.0)
    film = coefficients(plain, at.position, 300.0)
    grooves, *_, tilting = found.rungs
    K, C = film.stiffness * CLEARANCE / load, film.damping * CLEARANCE * 300.0 / load
    # The plain film is not extrapolated, and its derivatives jitter by some per cent.
    for symbol, exact, unit in (("K", K, "c/W"), ("C", C, "c speed/W")):
        own = [[grooves[f"{symbol}{a}{b} {unit} [1]"] for b in "xy"] for a in "xy"]
        assert np.array(own) == pytest.approx(exact, abs=0.03 * np.abs(exact).max())
    assert grooves["least film/c [1]"] == pytest.approx(at.minimum_film / CLEARANCE, rel=5e-3)
    assert max(abs(tilting[f"K{ij} c/W [1]"]) for ij in ("xy", "yx")) < 1e-9
    assert found.columns()["bearing [-]"] == list(bearing_types(0.5))


def test_thresholds_over_the_load(plain):
    types = {"plain": plain} | dict(list(bearing_types(0.5).items())[::6])
    found = bearing_thresholds(0.5, loads=[1500.0], types=types)
    one, other, tilting = (rung["threshold [rad/s]"] for rung in found.rungs)
    exact = whirl_threshold(plain, (0.0, -1500.0), 250.0).speed
    assert one == pytest.approx(exact, rel=1e-9)
    assert other == pytest.approx(exact, rel=0.02)
    assert tilting is None
    assert found.columns()["whirl [-]"] == ["onset", "onset", "never"]


def test_rotors_that_whirl_from_the_start_or_are_not_carried():
    grooves = {"two grooves": bearing_types(0.5)["two grooves"]}
    found = bearing_thresholds(0.5, loads=[100.0, 1e9], speed_range=(500.0, 600.0), types=grooves)
    table = found.columns()
    assert table["whirl [-]"] == ["always", "not carried"]
    assert table["threshold [rad/s]"] == [None, None]
    assert set(table["whirl [-]"]) < set(WHIRL_OUTCOMES)


def test_states_are_within_the_pads():
    for bearing in compared_bearings(0.5).values():
        position = lobe_states(bearing, 200, 1).position
        assert bearing.minimum_film(position).min() > 0.0
    elliptical = next(iter(compared_bearings(0.5).values()))
    # Each pad is a circle of radius 1 about a center that lies .5 beyond that of the bearing.
    down, side = way_to_contact(elliptical, np.array([[0.0, 1.0], [-1.0, 0.0]])) / elliptical.clearance
    assert (down, side) == pytest.approx((0.5, math.sqrt(0.75)), rel=1e-12)


def test_errors_of_grids_fall_with_their_cells(tmp_path):
    found = pad_accuracy(0.5, states=8, seed=3, rungs=GRIDS[:3], cells=(192, 16), rounds=1)
    errors = [rung["90 % error [1]"] for rung in found.rungs]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 4.0 * errors[2] > 0.0
    assert all(rung["force of a pad in a batch [s]"] > 0.0 for rung in found.rungs)
    path = write_csv(tmp_path / "pads.csv", found.columns())
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["film [-]"] for row in rows] == [rung.name for rung in GRIDS[:3]]
    assert "192 x 16" in rows[0]["reference [-]"]


def test_reference_has_no_error_of_itself():
    same = StudyModel(name="same", family="grid", law=PadGridFilm(cells=(64, 8)))
    found = pad_accuracy(0.5, states=3, rungs=[same], cells=(64, 8), rounds=1)
    assert found.rungs[0]["99 % error [1]"] == 0.0
    assert found.conditions["reference error, 99 % [1]"] > 0.0


def test_bad_input_names_argument_rule_and_value():
    with pytest.raises(InputError, match="slenderness must be finite and positive, got 0"):
        bearing_types(0.0)
    with pytest.raises(InputError, match="sommerfeld must be positive numbers"):
        bearing_coefficients(0.5, sommerfeld=[0.1, -1.0])
    with pytest.raises(InputError, match="loads must be positive numbers"):
        bearing_thresholds(0.5, loads=[])
    with pytest.raises(InputError, match="rungs must hold one at least"):
        pad_accuracy(0.5, rungs=[])
