"""The largest pressure in a film: answers beside fine grids, and films that know none."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import Groove, InputError, JournalBearing, ReynoldsFilm, equilibrium, film_state
from rotorfilm.bearings import ExtrapolatedFilm
from rotorfilm.scenes import read_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

JOURNAL = {"radius": 0.05, "length": 0.05, "clearance": 8e-5, "viscosity": 0.02}
DAM = {
    "radius": 0.05,
    "length": 0.05,
    "viscosity": 0.02,
    "pad_clearance": 8e-5,
    "depth": 1.4e-4,
    "end": 2.5,
    "share": 0.75,
}
GROOVES = {"grooves": [{"center": 0.0, "width": 0.35}, {"center": np.pi, "width": 0.35}]}


def scene(tables, tolerance=0.03, load=(0.0, -5000.0), speed=314.0):
    data = {
        "schema": 1,
        **tables,
        "operation": {"speed": speed, "load": list(load)},
        "question": {"quantity": "maximum_pressure", "tolerance": tolerance},
    }
    return read_scene(data, "pressure")


@pytest.mark.convergence
@pytest.mark.parametrize("length", [0.05, 0.01])
def test_pressure_of_a_journal_is_within_its_tolerance(length):
    asked = scene({"journal": {**JOURNAL, "length": length}})
    answer = asked.ask()
    bearing = replace(asked.bearing, film=ReynoldsFilm(cells=(768, 32)))
    at = equilibrium(bearing, asked.static_load, asked.speed)
    truth = film_state(bearing, at.position, [0.0, 0.0], asked.speed).maximum_pressure
    assert answer.met
    assert answer.unit == "Pa"
    assert abs(answer.value / truth - 1.0) < min(0.03, 2.0 * answer.error_estimate)


@pytest.mark.convergence
def test_pressure_of_a_journal_is_within_a_tight_tolerance():
    """The grid that judges coarser ones has an error of its own, which is more than that tolerance."""
    sizes = {"radius": 0.1307, "length": 0.1847, "clearance": 1.223e-4, "viscosity": 0.01242}
    asked = scene({"journal": sizes}, 1e-4, (0.0, -90.8e3), 61.0)
    answer = asked.ask()
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(768, 32)))
    at = equilibrium(replace(asked.bearing, film=film), asked.static_load, asked.speed)
    grid = replace(asked.bearing, film=film.film)
    truth = film_state(grid, at.position, [0.0, 0.0], asked.speed).maximum_pressure
    assert answer.met
    assert abs(answer.value / truth - 1.0) < 1e-4


@pytest.mark.convergence
def test_largest_pressure_between_the_lines_of_a_grid_depends_little_on_where_they_lie():
    """The lines of a grid do not turn with the journal: at a node the pressure changes by 4e-4."""
    bearing = JournalBearing(**JOURNAL, film=ReynoldsFilm(cells=(96, 8)))
    angles = np.linspace(0.0, 2.0 * np.pi / 96, 5)
    places = 6.4e-5 * np.array([np.cos(angles), np.sin(angles)]).T
    found = [film_state(bearing, place, [0.0, 0.0], 314.0).maximum_pressure for place in places]
    assert np.ptp(found) < 1e-4 * max(found)


@pytest.mark.parametrize("width", [0.35, 0.08])
def test_pressure_at_the_edge_of_a_groove_is_that_of_its_supply(width):
    groove = Groove(center=0.0, width=width)
    film = ReynoldsFilm(cells=(96, 8))
    bearing = JournalBearing(**JOURNAL, film=film, grooves=(groove,), supply_pressure=4e5)
    state = film_state(bearing, [1e-6, 0.0], [0.0, 0.0], 10.0)
    assert state.maximum_pressure == pytest.approx(4e5, rel=1e-9)


@pytest.mark.convergence
def test_pressure_of_a_dam_is_within_its_tolerance():
    asked = scene({"pressure_dam": DAM})
    answer = asked.ask()
    bearing = replace(asked.bearing, cells=(128, 32))
    at = equilibrium(bearing, asked.static_load, asked.speed)
    pads = [bearing.pressure(k, at.position, [0.0, 0.0], asked.speed).pressure for k in range(2)]
    assert answer.met
    assert abs(answer.value / max(map(np.max, pads)) - 1.0) < 0.03


def test_a_journal_that_conserves_its_oil_has_the_pressure_of_that_film():
    asked = scene({"journal": {**JOURNAL, **GROOVES, "film": {"name": "jfo"}}})
    at = equilibrium(asked.bearing, asked.static_load, asked.speed)
    pressure = asked.bearing.solve(at.position, asked.speed).pressure
    assert asked.ask().value == pytest.approx(float(np.max(pressure)))


def test_films_without_a_pressure_say_so():
    with pytest.raises(InputError, match=r"film must have a pressure for maximum_pressure, .*got MapFilm"):
        scene({"journal": {**JOURNAL, "film": {"name": "map"}}}).ask()


@pytest.mark.parametrize("quantity", ["maximum_pressure", "maximum_temperature"])
def test_what_is_highest_in_a_grooved_film_counts_heat_and_conserved_oil(quantity):
    """The film that conserves its oil has one temperature in the estimate of a rung by Reynolds rupture."""
    table = {key: value for key, value in JOURNAL.items() if key != "viscosity"}
    oil = {"grade": "ISO VG 46", "supply_temperature": 318.15}
    asked = scene({"journal": {**table, **GROOVES}, "lubricant": oil}, 0.9)
    answer = replace(asked, question=replace(asked.question, quantity=quantity)).ask()
    chosen = next(rung for rung in answer.rungs if rung.verdict == "chosen")
    assert answer.met
    assert "heat: " in chosen.method
    assert "conservation of oil, " in chosen.method
