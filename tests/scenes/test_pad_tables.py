"""Tables of bearings made of pads: what they build and refuse, what scenes of them answer and export."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import SceneError
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.pads import (
    Lobe,
    LobedBearing,
    PadGridFilm,
    PressureDamBearing,
    TiltingPadBearing,
    even_pivots,
    lobe_set,
    pressure_dam_pads,
    table as lobed_table,
    table as tilting_table,
)
from rotorfilm.bearings.pads.questions import COARSE_MAP
from rotorfilm.bearings.pads.table import pad_numbers
from rotorfilm.fmu import describe_fmu
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.export_scene import export_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

DIMENSIONS = 'diameter = "100 mm"\nlength = "50 mm"\n'
OIL = "viscosity = 0.02\n"
GRID = 'film = { name = "reynolds", cells = [48, 4] }\n'
RUN = '[operation]\nspeed = "3000 rpm"\nload = "3 kN"\n[rigid_rotor]\nmass = "300 kg"\n'
LOBES = f'schema = 1\n[lobed_journal]\n{DIMENSIONS}assembled_clearance = "70 um"\n'
DAM = f'schema = 1\n[pressure_dam]\n{DIMENSIONS}assembled_clearance = "70 um"\n'
TILTING = f'schema = 1\n[tilting_pad]\n{DIMENSIONS}assembled_clearance = "70 um"\nextent = "60 deg"\n'
ELLIPTICAL = LOBES + OIL + 'preset = "elliptical"\n'
STEP = DAM + OIL + 'depth = "140 um"\nend = "145 deg"\nshare = "75 %"\n'
FIVE = TILTING + OIL + 'pad_count = 5\nloading = "on_pad"\npreload = 0.3\n'


def scene_of(table, run=RUN):
    return parse_scene(table + run, "case.toml")


def test_a_preset_is_its_set_of_lobes():
    made = scene_of(ELLIPTICAL + 'preload = "40 %"\noffset = 0.6\nturned = "10 deg"\n').bearing
    lobes = lobe_set("elliptical", preload=0.4, offset=0.6, turned=math.radians(10.0))
    assert made == LobedBearing(
        radius=0.05, length=0.05, assembled_clearance=7e-5, viscosity=0.02, lobes=lobes
    )


def test_lobes_one_by_one():
    lobes = 'lobes = [{ start = "10 deg", extent = "2 rad", preload = 0.2 }, { start = 3.5, extent = 2 }]\n'
    pads = LOBES.replace("assembled_clearance", "pad_clearance")
    made = scene_of(pads + OIL + lobes + GRID).bearing
    first = Lobe(start=math.radians(10.0), extent=2.0, preload=0.2)
    assert made.lobes == (first, Lobe(start=3.5, extent=2.0))
    assert made.clearance == 7e-5
    assert made.film == PadGridFilm(cells=(48, 4))


def test_a_dam_is_that_of_its_design_or_of_its_pads():
    made = scene_of(STEP + 'track_depth = 5e-5\ntrack_share = 0.3\ngroove = "15 deg"\n').bearing
    pads = pressure_dam_pads(
        "140 um", "145 deg", 0.75, track_depth=5e-5, track_share=0.3, groove=math.radians(15.0)
    )
    known = {"radius": 0.05, "length": 0.05, "assembled_clearance": 7e-5, "viscosity": 0.02}
    assert made == PressureDamBearing(**known, pads=pads)
    one = "pads = [{ start = 0, extent = 3, recess = { depth = 1e-4, end = 2, share = 0.5 } }]\n"
    made = scene_of(DAM + OIL + one + "cells = [32, 8]\n").bearing
    assert made.cells == (32, 8)
    assert made.pads[0].recess.end == 2.0


def test_tilting_pads_by_their_number_or_their_pivots():
    between = scene_of(FIVE.replace("on_pad", "between_pads")).bearing
    known = {"radius": 0.05, "length": 0.05, "assembled_clearance": 7e-5, "viscosity": 0.02}
    pivots = even_pivots(5, between_pads=True)
    made = TiltingPadBearing(**known, pivots=pivots, extent=math.radians(60.0), preload=0.3)
    assert between == made
    pair = scene_of(TILTING + OIL + 'pivots = ["-45 deg", "225 deg"]\npivot_stiffness = 1e8\n').bearing
    assert pair.pivots == (math.radians(-45.0), math.radians(225.0))
    assert pair.pivot_stiffness == 1e8


@pytest.mark.parametrize("table", [LOBES + 'preset = "three_lobe"\n', DAM + STEP.partition(OIL)[2], FIVE])
def test_without_a_viscosity_the_films_are_on_the_oil_in_balance(table):
    lubricant = '[lubricant]\ngrade = 46\nsupply_temperature = "40 degC"\n'
    scene = scene_of(table.replace(OIL, "") + GRID * ("lobed" in table), RUN + lubricant)
    fresh = 46e-6 * scene.lubricant.properties.density
    assert scene.bearing.film_viscosity == pytest.approx(fresh, rel=1e-3)
    assert scene.bearing.is_warming
    assert not any("warms" in remark for remark in scene.film_remarks)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (LOBES + OIL, "lobed_journal: preset or lobes is required, and not both, got neither"),
        (ELLIPTICAL + "lobes = [{ start = 0, extent = 1 }]\n", "got both"),
        (
            LOBES + OIL + "preload = 0.5\nlobes = [{ start = 0, extent = 1 }]\n",
            "lobed_journal.preload must stand",
        ),
        (LOBES + OIL + 'preset = "eliptical"\n', "lobed_journal.preset must be one of .* mean 'elliptical'"),
        (ELLIPTICAL + "preload = 1.5\n", r"lobed_journal.preload must be in \[0, 1\), got 1.5"),
        (ELLIPTICAL + 'pad_clearance = "1 mm"\n', "pad_clearance or assembled_clearance must be given"),
        (LOBES + 'preset = "elliptical"\n', "lobed_journal.viscosity is required where"),
        (ELLIPTICAL + 'film = { name = "short" }\n', "lobed_journal.film.name must be one of"),
        (ELLIPTICAL + "offsett = 1\n", "lobed_journal.offsett is no known key.*'offset'"),
        (DAM + OIL + 'depth = "0.1 mm"\nend = "145 deg"\n', "pressure_dam: share of the dam is required"),
        (STEP + "pads = [{ start = 0, extent = 1 }]\n", "pressure_dam.depth must not be given beside pads"),
        (STEP + "cells = [30, 8]\n", "pressure_dam.cells must be two multiples of 4"),
        (TILTING + OIL, "pad_count or pivots is required, and not both, got neither"),
        (TILTING + OIL + "pad_count = 5\n", "tilting_pad.loading must be given with pad_count"),
        (
            FIVE.replace("on_pad", "on pad"),
            "tilting_pad.loading must be one of on_pad, between_pads, .*'on_pad'",
        ),
        (FIVE.replace("60 deg", "80 deg"), "pivots must be angles that differ by at least the extent"),
        (TILTING + OIL + "pivots = []\n", "tilting_pad.pivots must be a list of 1 to 64 angles"),
        (FIVE + STEP.partition("\n")[2], "pressure_dam and tilting_pad must not stand in one scene"),
    ],
)
def test_what_breaks_a_rule_is_named_with_its_key(table, message):
    with pytest.raises(SceneError, match=message):
        scene_of(table)


def test_a_bearing_needs_an_operation():
    with pytest.raises(SceneError, match="operation is required"):
        parse_scene(STEP, "case.toml")


@pytest.mark.parametrize(
    "table", [ELLIPTICAL + GRID, STEP + "cells = [32, 8]\n", FIVE + GRID.replace("48", "16")]
)
def test_a_scene_that_asks_nothing_is_described(table):
    scene = scene_of(table)
    answer = scene.solve()
    at = equilibrium(scene.bearing, (0.0, -3000.0), scene.speed)
    known = coefficients(scene.bearing, at.position, scene.speed)
    np.testing.assert_array_equal(answer.equilibrium.position, at.position)
    np.testing.assert_array_equal(answer.coefficients.stiffness, known.stiffness)
    assert "2-D" in answer.model
    assert (answer.whirl_threshold.speed is None) == ("tilting" in table)
    assert any(row[0] == "viscosity" for row in answer.bearing.to_rows())


def test_warming_is_that_of_a_pad_that_keeps_its_heat():
    scene = scene_of(ELLIPTICAL)
    bearing, oil = scene.bearing, scene.lubricant.properties
    numbers, kept = (
        pad_numbers(bearing, one, 300.0, (0.0, -3e3)) for one in (oil, replace(oil, conductivity=1e-3))
    )
    # Couette flow U/2 through the gap c carries the shear power viscosity U^2/c over the arc R extent.
    U, c, R, extent = 300.0 * 0.05, 7e-5, 0.05, math.radians(160.0)
    carried = 0.02 * U**2 / c * R * extent / (oil.density * oil.heat_capacity * 0.5 * U * c)
    conducted = 0.02 * U**2 / (8.0 * oil.conductivity)
    assert numbers["warming"] == pytest.approx(conducted)
    assert kept["warming"] == pytest.approx(carried)
    assert conducted < carried
    assert numbers["tilt"] == pytest.approx(2e3 * 7e-5 / 0.05)
    fast = scene_of(ELLIPTICAL, RUN.replace("3000", "9000"))
    assert fast.film_remarks[0].startswith("heat: along one pad the oil warms by about")


@pytest.mark.parametrize(
    ("table", "states"), [(ELLIPTICAL, 0), (STEP, 0), (FIVE, 5)], ids=["lobes", "dam", "tilting"]
)
def test_bearing_and_rotor_become_fmus_that_start_at_rest(tmp_path, monkeypatch, table, states):
    for home in (lobed_table, tilting_table):
        monkeypatch.setattr(home, "usual_film", lambda *_: COARSE_MAP)
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))
    scene = scene_of(table)
    made = export_scene(scene, tmp_path)
    found = describe_fmu(made["film"])
    at = equilibrium(scene.bearing, scene.static_load, scene.speed)
    starts = {row["name"]: row["start"] for row in found["variables"]}
    assert float(starts["film.y"]) == pytest.approx(at.position[1], rel=1e-12)
    tilts = [float(start) for name, start in starts.items() if re.fullmatch(r"film\.state_tilt_\d", name)]
    assert len(tilts) == states
    if states:
        np.testing.assert_allclose(tilts, at.pads.tilts, rtol=1e-9)


@pytest.mark.parametrize("table", [ELLIPTICAL, FIVE])
def test_pads_without_a_map_are_answered_on_grids(table):
    """A bearing of L/D .04, which no map of a pad has."""
    question = '[question]\nquantity = "eccentricity_ratio"\ntolerance = 0.2\n'
    short = table.replace('length = "50 mm"', 'length = "4 mm"')
    scene = scene_of(short, RUN.replace("3 kN", "10 N") + question)
    assert isinstance(scene.bearing.film, PadGridFilm)
    answer = scene.ask()
    assert answer.met
    assert answer.model.startswith("2-D")
    with pytest.raises(SceneError, match=r"length/diameter must be 0\.05 to 20\.0 for a map of a pad"):
        scene_of(short + 'film = { name = "map" }\n')


def test_the_clearance_of_a_bearing_is_told_as_it_was_given():
    """A pocket all over its length is deeper where the pad is closest."""
    pocket = "recess = { depth = 1e-4, start = 1, end = 2, share = 1 }"
    scene = scene_of(DAM + OIL + f"pads = [{{ start = 0, extent = 3, preload = 0.2, {pocket} }}]\n")
    assert scene.bearing.minimum_film((0.0, 0.0)) > 7.1e-5
    data, _ = scene.film_table.repeated_inputs(scene.bearing)
    assert data.assembled_clearance == pytest.approx(7e-5, rel=1e-14)
    assert data.pad_clearance == pytest.approx(7e-5 / 0.8, rel=1e-14)
