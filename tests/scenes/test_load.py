"""Reading scene files: what they mean in SI, and what is said about each way to get one wrong."""

import math

import pytest

from rotorfilm import FeedHole, FullFilm, Groove, Pad, SceneError
from rotorfilm.bearings import FixedOnset, FreeOnset, HalfSommerfeld, MaximumGapOnset
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    FixedArc,
    GroovedMapFilm,
    MapFilm,
    ReynoldsArc,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
)
from rotorfilm.scenes import Scene, bundled_scene, parse_scene
from rotorfilm.scenes.shared_tables import BladeLossTable, SineLoadTable, StepLoadTable, UnbalanceTable

GOOD = """
schema = 1
[journal]
radius = 0.05
length = "30 mm"
clearance = "0.1 mm"
viscosity = "0.1 Pa s"
[operation]
speed = "1500 rpm"
load = "525 N"
"""
ROTOR = '[rigid_rotor]\nmass = "50 kg"\nunbalance = "2000 g mm"\nunbalance_angle = "90 deg"\n'


def parse(document):
    return parse_scene(document, "case.toml")


def test_quantities_arrive_in_si():
    scene = parse(GOOD + ROTOR)
    assert (scene.journal.radius, scene.journal.length) == (0.05, pytest.approx(0.03))
    assert scene.operation.speed == pytest.approx(50.0 * math.pi)
    assert scene.rigid_rotor.unbalance == pytest.approx(2e-3)
    assert scene.rigid_rotor.unbalance_angle == pytest.approx(math.pi / 2.0)


def test_diameter_is_twice_the_radius():
    assert parse(GOOD.replace("radius = 0.05", 'diameter = "100 mm"')) == parse(GOOD)


def test_magnitude_of_load_acts_downward():
    assert parse(GOOD).static_load == (0.0, -525.0)


def test_load_vector_is_taken_as_it_is():
    assert parse(GOOD.replace('"525 N"', '["0.1 kN", -500]')).static_load == (100.0, -500.0)


def test_weight_of_the_rotor_is_the_load_where_none_is_given():
    scene = parse(GOOD.replace('load = "525 N"', "") + ROTOR)
    assert scene.static_load == (0.0, pytest.approx(-50.0 * 9.80665))


def test_rotor_carries_the_whole_static_load_once():
    rotor = parse(GOOD + ROTOR).rotor
    assert rotor.static_force == (0.0, -525.0)
    assert rotor.gravity == (0.0, 0.0)


@pytest.mark.parametrize(
    ("film", "expected"),
    [
        ('{ name = "map" }', MapFilm()),
        ('{ name = "short" }', ShortFilm()),
        ('{ name = "reynolds" }', ReynoldsFilm()),
        (
            '{ name = "reynolds", cells = [48, 4], cavitation = { kind = "half_sommerfeld" } }',
            ReynoldsFilm(cells=(48, 4), cavitation=HalfSommerfeld()),
        ),
        ('{ name = "reynolds", cavitation = { kind = "full" } }', ReynoldsFilm(cavitation=FullFilm())),
        (
            '{ name = "splitting", order = [2, "inf"] }',
            SplittingFilm(order=(2, None), constant=False, rupture=FixedArc(start=0.0, extent=math.pi)),
        ),
        (
            '{ name = "splitting", order = [4, 2], constant = true, rupture = { kind = "rotating" } }',
            SplittingFilm(order=(4, 2), constant=True, rupture=RotatingArc()),
        ),
        (
            '{ name = "splitting", order = [3, 1], rupture = { kind = "fixed", extent = "120 deg" } }',
            SplittingFilm(order=(3, 1), constant=False, rupture=FixedArc(extent=math.radians(120.0))),
        ),
        (
            '{ name = "splitting", order = [4, 8], constant = true, rupture = { kind = "complementarity" } }',
            SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc()),
        ),
        (
            '{ name = "splitting", order = [4, "inf"], constant = true, rupture = { kind = "reynolds" } }',
            SplittingFilm(order=(4, None), constant=True, rupture=ReynoldsArc()),
        ),
        (
            '{ name = "splitting", order = [4, 1], constant = true, '
            'rupture = { kind = "reynolds", start = "90 deg" } }',
            SplittingFilm(order=(4, 1), constant=True, rupture=ReynoldsArc(start=math.radians(90.0))),
        ),
    ],
)
def test_film_is_chosen_by_name(film, expected):
    scene = parse(GOOD.replace("[operation]", f"film = {film}\n[operation]"))
    assert scene.bearing.film == expected


def test_film_is_the_map_where_none_is_named():
    assert parse(GOOD).bearing.film == MapFilm()


OPENINGS = """film = { name = "reynolds" }
supply_pressure = "2 bar"
grooves = [{ center = "90 deg", width = "20 deg" }, { center = "270 deg" }]
[operation]"""


def test_grooves_and_their_supply_arrive_in_si():
    bearing = parse(GOOD.replace("[operation]", OPENINGS)).bearing
    assert bearing.supply_pressure == pytest.approx(2e5)
    assert bearing.grooves == (
        Groove(center=math.radians(90.0), width=math.radians(20.0)),
        Groove(center=math.radians(270.0)),
    )


def test_grooves_at_ambient_pressure_take_the_map():
    opened = OPENINGS.replace("reynolds", "grooved_map")
    bearing = parse(GOOD.replace("[operation]", opened.replace('supply_pressure = "2 bar"', ""))).bearing
    assert isinstance(bearing.film, GroovedMapFilm)
    assert len(bearing.fitted_film.geometry.grooves) == 2
    with pytest.raises(SceneError, match="supply"):
        parse(GOOD.replace("[operation]", opened))
    default = "\n".join(OPENINGS.splitlines()[2:])
    assert isinstance(parse(GOOD.replace("[operation]", default)).bearing.fitted_film, GroovedMapFilm)


SHORT_OPENINGS = """supply_pressure = "2 bar"
grooves = [{ center = "90 deg", width = "20 deg", length = "20 mm" }]
feed_holes = [{ center = "270 deg", diameter = "5 mm" }]
circumferential_groove = "2 mm"
[operation]"""


def test_openings_of_finite_length_arrive_in_si_and_take_two_dimensions():
    bearing = parse(GOOD.replace("[operation]", SHORT_OPENINGS)).bearing
    assert bearing.grooves == (
        Groove(center=math.radians(90.0), width=math.radians(20.0), length=0.02),
        FeedHole(center=math.radians(270.0), diameter=0.005),
    )
    assert bearing.circumferential_groove == pytest.approx(0.002)
    assert bearing.film == ReynoldsFilm()


def test_a_named_map_refuses_openings_of_finite_length():
    lines = SHORT_OPENINGS.replace("[operation]", 'film = { name = "map" }\n[operation]')
    with pytest.raises(SceneError, match="take ReynoldsFilm"):
        parse(GOOD.replace("[operation]", lines))


@pytest.mark.parametrize(
    ("start", "made"),
    [
        ('{ kind = "free" }', FreeOnset()),
        ('{ kind = "widest_gap" }', MaximumGapOnset()),
        ('{ kind = "line", line = "90 deg" }', FixedOnset(line=math.radians(90.0))),
    ],
)
def test_start_of_the_film_has_its_keys(start, made):
    film = f'film = {{ name = "reynolds", film_start = {start} }}'
    assert parse(GOOD.replace("[operation]", f"{film}\n[operation]")).bearing.film.film_start == made


def test_map_of_grooves_takes_its_keys():
    keys = "cells = [64, 8], nodes = [8, 48, 32], largest_eccentricity_ratio = 0.9"
    film = f'film = {{ name = "grooved_map", {keys} }}'
    found = parse(GOOD.replace("[operation]", f"{film}\n[operation]")).bearing.film
    assert found == GroovedMapFilm(cells=(64, 8), nodes=(8, 48, 32), largest_eccentricity_ratio=0.9)


def test_pads_arrive_in_si():
    pads = 'pads = [{ start = "15 deg", extent = 2.5 }, { start = "195 deg", extent = "150 deg" }]'
    bearing = parse(
        GOOD.replace("[operation]", f'film = {{ name = "reynolds" }}\n{pads}\n[operation]')
    ).bearing
    assert bearing.pads == (
        Pad(start=math.radians(15.0), extent=2.5),
        Pad(start=math.radians(195.0), extent=math.radians(150.0)),
    )


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (
            'film = { name = "short" }\ngrooves = [{ center = 1.0 }]',
            r"film must represent .*, got ShortFilm, which cannot represent .*; ReynoldsFilm can",
        ),
        (
            'film = { name = "short" }\npads = [{ start = 0, extent = 3 }]',
            r"film must .* ShortFilm, which cannot represent",
        ),
        ("grooves = 1", "grooves must be a list of tables, got 1"),
        ("grooves = [1]", r"grooves\[0\] must be a table, got 1"),
        ("grooves = [{ width = 1 }]", r"grooves\[0\].center is required and missing"),
        (
            'grooves = [{ center = 0 }, { center = "1 mm" }]',
            r"grooves\[1\].center: quantity must be measured in rad",
        ),
        (
            "grooves = [{ center = 0, widht = 1 }]",
            r"grooves\[0\].widht is no known key; .*; did you mean 'width'\?",
        ),
        ("grooves = [{ center = 0, width = -1 }]", r"grooves\[0\].width must be .*, got -1.0"),
        ("pads = [{ start = 0, extent = 7 }]", r"pads\[0\].extent must be in \(0, 2 pi\], got 7.0"),
        (
            "grooves = [{ center = 0, lenght = 1 }]",
            r"grooves\[0\].lenght is no known key; .*; did you mean 'length'\?",
        ),
        (
            'grooves = [{ center = 0, length = "90 deg" }]',
            r"grooves\[0\].length: quantity must be measured in m",
        ),
        (
            'grooves = [{ center = 0, length = "1 m" }]',
            "grooves must be at most as long as the bearing",
        ),
        ("grooves = [{ center = 0, length = nan }]", r"grooves\[0\].length"),
        ("feed_holes = [{ center = 0 }]", r"feed_holes\[0\].diameter is required and missing"),
        (
            "feed_holes = [{ center = 0, diameter = 0 }]",
            r"feed_holes\[0\].diameter must be .* positive, got 0",
        ),
        (
            "feed_hole = [{ center = 0, diameter = 0 }]",
            "feed_hole is no known key; .*; did you mean 'feed_holes'",
        ),
        ('circumferential_groove = "1 m"', "circumferential_groove must be from 0 to below the length"),
        ('circumferential_groove = "-1 mm"', "circumferential_groove must be"),
        (
            'film = { name = "reynolds", film_start = { kind = "widest" } }',
            r"film.film_start.kind must be one of free, line, widest_gap",
        ),
        (
            'film = { name = "reynolds", film_start = { kind = "free" } }\ncircumferential_groove = "1 m"',
            "circumferential_groove must be from 0",
        ),
        ('supply_pressure = "1 MPa"', r"supply_pressure must be 0 without grooves, got 1000000.0"),
        ('supply_pressure = "1 mm"', "supply_pressure: quantity must be measured in Pa"),
        (
            'film = { name = "reynolds" }\ngrooves = [{ center = 0, width = 2 }, { center = 1, width = 2 }]',
            "grooves and gaps between pads must not overlap",
        ),
        ('film = { name = "reynolds", cells = 96 }', r"film.cells must be \[around, along\], got 96"),
        (
            'film = { name = "reynolds", cells = [90, 8] }',
            r"film.cells must be two multiples of 4, at least \(16, 4\), got \(90, 8\)",
        ),
        (
            'film = { name = "grooved_map", nodes = [8, 48] }',
            r"film.nodes must be \[over, turning, moving\], got \[8, 48\]",
        ),
        (
            'film = { name = "grooved_map", nodes = [8, 48, 31] }',
            r"film.nodes must be at least \(6, 12, 12\), the last two even, got \(8, 48, 31\)",
        ),
        (
            'film = { name = "reynolds", cavitation = { kind = "none" } }',
            r"film.cavitation.kind must be one of complementarity, full, half.*, got 'none'",
        ),
    ],
)
def test_wrong_film_or_opening_is_named_by_its_key(lines, message):
    with pytest.raises(SceneError, match=rf"case.toml: journal\.{message}"):
        parse(GOOD.replace("[operation]", f"{lines}\n[operation]"))


def test_bundled_scene_is_the_bearing_of_the_book():
    scene = bundled_scene()
    assert scene.journal.radius == pytest.approx(0.05)
    assert scene.static_load == (0.0, -525.0)
    assert scene.rotor.mass * 9.80665 == pytest.approx(525.0, rel=1e-5)


def test_file_is_read(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(GOOD, encoding="utf-8")
    assert Scene.load(path) == parse(GOOD)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("schema = 1", "", r"case.toml: schema must be 1 \(write `schema = 1`\), got nothing"),
        ("schema = 1", "schema = 2", r"case.toml: schema must be 1 .*, got 2"),
        ("schema = 1", "schema = true", r"case.toml: schema must be 1 .*, got True"),
        ("schema = 1", "schema = = 1", r"case.toml: not valid TOML: .*\(at line 2, column 10\)"),
        (
            "clearance",
            "clearence",
            r"case.toml: journal.clearence is no known key; known here: radius, diameter, length, clearance, "
            r"viscosity, supply_pressure, circumferential_groove, supply_flow, cavitation_pressure, "
            r"submerged, film, pads, grooves, feed_holes, turbulence, tilt; did you mean 'clearance'\?",
        ),
        ("[journal]", "[jurnal]", r"case.toml: jurnal is no known key; .*; did you mean 'journal'\?"),
        ('clearance = "0.1 mm"', "", "case.toml: journal.clearance is required and missing"),
        ("[journal]", "[[journal]]", r"case.toml: journal must be a table, got \[{"),
        (
            '"0.1 mm"',
            '"-0.1 mm"',
            "case.toml: journal.clearance must be finite and positive, got -0.0001",
        ),
        ('"0.1 mm"', "nan", "case.toml: journal.clearance: quantity must be finite, got nan"),
        (
            '"0.1 mm"',
            '"0.1 kg"',
            "case.toml: journal.clearance: quantity must be measured in m or a multiple of it, got '0.1 kg'",
        ),
        (
            '"0.1 mm"',
            "true",
            "case.toml: journal.clearance must be a number or a string such as '1 m', got True",
        ),
        ("radius = 0.05", "radius = 1\ndiameter = 2", "journal.radius and .*journal.diameter must not both"),
        ('"1500 rpm"', "nan", "case.toml: operation.speed: quantity must be finite, got nan"),
        ('"525 N"', "[0, inf]", r"case.toml: operation.load\[1\]: quantity must be finite, got inf"),
        ('"525 N"', "-525.0", "case.toml: operation.load must be a positive magnitude or .*, got -525.0"),
        ('"525 N"', "[1, 2, 3]", r"case.toml: operation.load must be one magnitude or .*, got \[1, 2, 3\]"),
        ('"525 N"', '[0, "5 m"]', r"case.toml: operation.load\[1\]: quantity must be measured in N"),
        ('load = "525 N"', "", r"case.toml: operation.load is required where there is no \[rigid_rotor\]"),
        ("[operation]", "film = 3\n[operation]", "case.toml: journal.film must be a table, got 3"),
        (
            "[operation]",
            "film = { order = [1, 1] }\n[operation]",
            r"case.toml: journal.film.name is required: one of grooved_map, jfo, map, reynolds",
        ),
        (
            "[operation]",
            'film = { name = "spliting" }\n[operation]',
            r"case.toml: journal.film.name must be one of .*, got 'spliting'; did you mean 'splitting'\?",
        ),
        (
            "[operation]",
            'film = { name = "splitting", order = [2, 0] }\n[operation]',
            r"case.toml: journal.film.order\[1\] must be a whole number from 1 to 100, got 0",
        ),
        (
            "[operation]",
            'film = { name = "splitting", order = [2, 1], constant = 1 }\n[operation]',
            "case.toml: journal.film.constant must be true or false, got 1",
        ),
        (
            "[operation]",
            'film = { name = "splitting", order = [2, 1], rupture = { kind = "fixed", extent = -1 } }\n'
            "[operation]",
            r"case.toml: journal.film.rupture.extent must be from 0.001 to 2 pi, got -1.0",
        ),
        (
            "[operation]",
            'film = { name = "splitting", order = [4, 1], constant = true, '
            'rupture = { kind = "reynolds", start = nan } }\n[operation]',
            r"case.toml: journal.film.rupture.start: quantity must be finite, got nan",
        ),
        (
            "[operation]",
            'film = { name = "splitting", order = [4, 1], constant = true, '
            'rupture = { kind = "complementarity", start = 0 } }\n[operation]',
            r"case.toml: journal.film.rupture.start is no known key",
        ),
        (
            "schema = 1",
            "schema = 1\ntitle = 5",
            "case.toml: title must be a string of at most 200 characters, got 5",
        ),
        (
            "[operation]",
            "[rigid_rotor]\nmass = -1\n[operation]",
            "case.toml: rigid_rotor.mass must be finite and positive, got -1.0",
        ),
        (
            "[operation]",
            "[cosimulation]\nmacro_angle = 0\n[operation]",
            "case.toml: cosimulation.macro_angle must be finite and positive, got 0.0",
        ),
    ],
)
def test_wrong_scene_is_named(old, new, message):
    with pytest.raises(SceneError, match=message):
        parse(GOOD.replace(old, new))


def test_missing_file_is_named(tmp_path):
    with pytest.raises(SceneError, match=r"absent.toml: scene file cannot be read: No such file"):
        Scene.load(tmp_path / "absent.toml")


def test_binary_file_is_named(tmp_path):
    (tmp_path / "image.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneError, match=r"image.toml: scene file cannot be read: it is not UTF-8 text"):
        Scene.load(tmp_path / "image.toml")


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ('kind = "unbalance"\nunbalance = "2000 g mm"', UnbalanceTable(unbalance=2e-3)),
        (
            'kind = "blade_loss"\nunbalance = 1\nstart = "5 ms"\nrevolutions = 4',
            BladeLossTable(unbalance=1.0, start=0.005, revolutions=4.0),
        ),
        ('kind = "step"\nload = "0.1 kN"\nend = 2', StepLoadTable(load=(0.0, -100.0), end=2.0)),
        (
            'kind = "sine"\nload = [1, 2]\nfrequency = "50 Hz"',
            SineLoadTable(load=(1.0, 2.0), frequency=100.0 * math.pi),
        ),
    ],
)
def test_excitation_is_chosen_by_kind(lines, expected):
    found = parse(f"{GOOD}[excitation]\n{lines}\n").excitation
    assert type(found) is type(expected)
    for name in vars(expected):
        assert getattr(found, name) == pytest.approx(getattr(expected, name))


def test_question_takes_a_tolerance_in_per_cent():
    question = parse(f'{GOOD}[question]\nquantity = "stiffness"\ntolerance = "2 %"\n').question
    assert (question.quantity, question.tolerance) == ("stiffness", pytest.approx(0.02))
    question = parse(f'{GOOD}[question]\nquantity = "stiffness"\ntolerance = "300 %"\n').question
    assert question.tolerance == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ('[excitation]\nkind = "stpe"', r"excitation.kind must be one of .*; did you mean 'step'\?"),
        ('[excitation]\nkidn = "step"', r"excitation.kidn is no known key; did you mean 'kind'\?"),
        ("[excitation]\nload = 1", r"excitation.kind is required: one of blade_loss"),
        (
            '[excitation]\nkind = "step"\nload = 1\nstart = 2\nend = 1',
            r"excitation.end must be after start, 2.0 s, got 1.0",
        ),
        (
            '[excitation]\nkind = "sine"\nload = 1\nfrequency = 0',
            "excitation.frequency must be finite and positive, got 0.0",
        ),
        (
            '[excitation]\nkind = "unbalance"\nunbalance = 1\nnode = -1',
            r"excitation.node must be a whole number from 0 to 500, got -1",
        ),
        (
            '[question]\nquantity = "stifness"\ntolerance = 1',
            r"question.quantity must be one of .*, got 'stifness'; did you mean 'stiffness'\?",
        ),
        (
            '[question]\nquantity = "stiffness"\ntolerance = 0',
            "question.tolerance must be finite and positive, got 0.0",
        ),
        (
            '[question]\nquantity = "stiffness"\ntolerance = 3',
            r"question.tolerance must be at most 1 unless it is in percent, got 3: '3 %'\?",
        ),
        ('[question]\nquantity = "stiffness"', "question.tolerance is required and missing"),
    ],
)
def test_wrong_excitation_or_question_is_named(lines, message):
    with pytest.raises(SceneError, match=f"case.toml: {message}"):
        parse(f"{GOOD}{lines}\n")


def test_scene_without_a_bearing_or_an_operation_is_refused():
    with pytest.raises(SceneError, match=r"case.toml: .*journal.* is required and missing"):
        parse("schema = 1\n[operation]\nspeed = 1\nload = 1\n")
    with pytest.raises(SceneError, match=r"case.toml: operation is required and missing"):
        parse(GOOD.partition("[operation]")[0])


def test_typo_in_the_version_is_named():
    with pytest.raises(SceneError, match=r"case.toml: shcema is no known key; did you mean 'schema'\?"):
        parse(GOOD.replace("schema", "shcema"))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('clearance = "0.1 mm"', 'clearance = "-0.1 mm"', r"got -0.0001 \[m; clearance = '-0.1 mm'\]"),
        ('clearance = "0.1 mm"', "clearance = -1e-4", r"got -0.0001 \[m\]"),
        ("radius = 0.05", 'diameter = "0 in"', r"got 0.0 \[m; diameter = '0 in'\]"),
    ],
)
def test_errors_have_the_unit_and_the_text_of_the_file(old, new, told):
    assert old in GOOD
    with pytest.raises(SceneError, match=told):
        parse(GOOD.replace(old, new))


@pytest.mark.parametrize(
    ("openings", "film"),
    [
        ('grooves = [{ center = "0 deg", width = "20 deg" }]\nsupply_pressure = "1 bar"', ReynoldsFilm()),
        ('pads = [{ start = "195 deg", extent = "150 deg" }]', ReynoldsFilm()),
        ('pads = [{ start = "0 deg", extent = "310 deg" }]', MapFilm()),
    ],
)
def test_a_film_that_is_not_named_is_one_that_the_openings_can_have(openings, film):
    assert parse(GOOD.replace("[operation]", f"{openings}\n[operation]")).bearing.film == film


def test_a_scene_is_hashable():
    assert hash(bundled_scene()) == hash(bundled_scene())
