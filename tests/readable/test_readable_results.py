"""Every result is read with its units: in print, in notebooks, as data frame, data set and picture."""

import dataclasses
import doctest
import importlib
import json
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import glossary
import numpy as np
import pytest
from scipy.integrate import BDF

import rotorfilm
from rotorfilm import Coefficients, Equilibrium, Trajectory, WhirlThreshold, bearings
from rotorfilm.analysis import Bifurcation, Campbell, RotorModes, coefficient_table, run_orbits, run_spectra
from rotorfilm.bearings.bush import f4k20_bush
from rotorfilm.charts.result_charts import PICTURES
from rotorfilm.core import DISPLAY_UNITS, AbsentError, Readable, parse_quantity
from rotorfilm.core.readable import Drawable, explained, quantity, texts

pytest.importorskip("pandas")
pytest.importorskip("xarray")
pytest.importorskip("plotly")

NO_RESULTS = {
    "what a chart is drawn from": {"HeatModel", "StudyStyle"},
    "what a caller gives": {
        "OperatingPoint",
        "DamperGroups",
        "Span",
        "Axis",
        "StateRange",
        "PadResolution",
    },
    "a part of the machinery": {
        *(
            "WorkUnit",
            "Unit",
            "Family",
            "PadTable",
            "Gap",
            "MarchMotion",
            "Residual",
            "ModalFilms",
            "WholeShaft",
            "CompiledRotor",
            "PortRotor",
            "DrivenRotor",
            "OilCells",
            "ScaledFilm",
            "Corrected",
            "StudyModel",
        ),
        *("FilmField", "StudyCase", "Study", "BushRun"),
        *("RossRotor", "DemoResult", "PublishedStage"),
        *(
            "JournalStation",
            "SolvedTurn",
            "OrbitPlace",
            "FollowedFilm",
            "ShaftSpeed",
            "ShaftModel",
            "DrivenBall",
        ),
        *("BallEquilibriumCase", "RestJudge"),
        *("HeatCase", "RunningBearing", "WarmRest", "HeatSteps", "FieldLevel"),
        *("FilmRest", "FilmCandidate", "PadCandidate", "TiltingCandidate"),
        *(
            "StaticContactFilms",
            "DamperFilm",
            "FilmRung",
            "Panel",
        ),
    },
}
"""Classes with attributes that nobody is answered with, by the reason."""

READERS = ("scenes.reading", "core.answers.Ladder", "core.answers.CandidateRung")
"""Where classes hold what they were made from: readers of files, and rungs."""

BEARING = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}

NUMBERS = iter(range(1, 100000))


def results():
    for path in glossary.modules():
        text = path.read_text(encoding="utf-8")
        if "core.readable import" in text or "(HeatedState)" in text:
            importlib.import_module(glossary.dotted(path))
    waiting, found = [Readable], {}
    while waiting:
        for kind in waiting.pop().__subclasses__():
            waiting.append(kind)
            if dataclasses.is_dataclass(kind) and kind.__module__.startswith("rotorfilm."):
                found[kind.__name__] = kind
    return dict(sorted(found.items()))


RESULTS = results()
SIZES = {"2": 2, "3": 3, "n_bearings": 2, "2 H + 1": 5, "...": 3}


def sample(kind):
    """Return a result with made-up numbers, each another one, from what its docstring says of the fields."""
    names = [one.name for one in dataclasses.fields(kind)]
    given = [name for name, of in kind.__annotations__.items() if str(of).startswith("InitVar")]
    beside = {name: getattr(kind, name, None) or object() for name in given}
    return kind(**{name: value_of(name, explained(kind, name)) for name in names}, **beside)


def value_of(name, said):
    number = 0.001 * next(NUMBERS) + 0.1
    if name in ("work", "units"):
        return {"steps": 3} if name == "work" else {"x": "m", "y": "m"}
    if said.kind.startswith("dict of str to ndarray") or "ndarray" in said.kind:
        shape = tuple(SIZES.get(dim, 4) for dim in said.shape) or (4,)
        array = number + 0.001 * np.arange(np.prod(shape)).reshape(shape)
        array = array > number + 0.002 if "of bool" in said.kind else array
        array = array * (1.0 - 0.5j) if "complex" in said.kind or name == "eigenvalues" else array
        keys = ("x", "y", "force_x", "force_y") if name == "signals" else ("left_x", "right_force_y")
        return {key: array + k for k, key in enumerate(keys)} if said.kind.startswith("dict") else array
    if said.kind.startswith("dict of str to (float, float)"):
        return {"left_x": (number, number + 1.0), "right_x": (number, number + 2.0)}
    if other := re.search(r"(?:tuple of|dict of str to) (\w+)", said.kind):
        one = sample(RESULTS[other[1]]) if other[1] in RESULTS else plain(other[1], number)
        many = SIZES.get(*said.shape, 4) if said.shape else 2
        return (one,) * many if said.kind.startswith("tuple") else {"left": one}
    word = said.kind.split()[0].strip(",") if said.kind else ""
    return sample(RESULTS[word]) if word in RESULTS else plain(word, number)


def plain(word, number):
    kinds = {"float": number, "int": int(1000 * number), "bool": True, "object": number}
    makers = {"Bifurcation": lambda: Bifurcation.FOLD, "MeltingBush": f4k20_bush}
    if word in makers:
        return makers[word]()
    return kinds.get(word, f"{word} <&> text")


SAMPLES = {name: sample(kind) for name, kind in RESULTS.items()}
"""One of each result."""


def numbers_of(result):
    """Return the single numbers that a result holds, with their units as its docstring has them."""
    for one in dataclasses.fields(result):
        value, said = getattr(result, one.name), explained(type(result), one.name)
        if isinstance(value, float) and not isinstance(value, bool) and said.unit:
            yield one.name, value, said.unit


def read(text, unit):
    """Return the number of a text in SI, by the reader of scene files where it knows the unit."""
    first = text.partition(" = ")[0]
    spelled = unit.replace("^", "")
    known = next((name for name in (spelled, spelled.replace(" ", ".")) if name in DISPLAY_UNITS), None)
    number, _, shown = first.partition(" ")
    if known is None or unit == "1":
        assert shown == ("" if unit == "1" else unit.replace(".", " "))
        return float(number)
    if shown in ("nm", "us", "mm/s", "um/s"):
        return float(number) * {"nm": 1e-9, "us": 1e-6, "mm/s": 1e-3, "um/s": 1e-6}[shown]
    return parse_quantity(first, known.replace(" ", "."))


def test_all_that_answers_is_readable():
    missing = set()
    for where, node in glossary.classes():
        text = glossary.ast.get_docstring(node) or ""
        made = any("dataclass" in glossary.ast.unparse(one) for one in node.decorator_list)
        read = ".questions." in where or where.removeprefix("rotorfilm.").startswith(READERS)
        inside = read and not node.name.startswith("Whole")
        if made and "\nAttributes\n" in text and not inside and node.name[0] != "_":
            missing |= {node.name} - set(RESULTS)
    assert missing - set().union(*NO_RESULTS.values()) == set()
    assert len(RESULTS) > 50


@pytest.mark.parametrize("name", RESULTS)
def test_every_number_is_shown_with_its_unit(name):
    result = SAMPLES[name]
    rows = dict(result.to_rows())
    for field, value, unit in numbers_of(result):
        text = rows[field.replace("_", " ")]
        assert read(text, unit) == pytest.approx(value, rel=1e-5), (field, text, unit)
        assert " ".join(text.split()) in repr(result)
        assert text in str(result)


@pytest.mark.parametrize("name", RESULTS)
def test_every_field_has_a_row(name):
    result = SAMPLES[name]
    labels = {label.strip() for label, _ in result.to_rows()}
    for one in dataclasses.fields(result):
        words = one.name.replace("_", " ")
        expected = {words, f"{words} 1", f"{words} left", f"{words} left x", *result_keys(result, one.name)}
        assert expected & labels or words in ("remarks", "units", "response"), (one.name, labels)


def result_keys(result, name):
    return ["x"] if name == "signals" and isinstance(result, Trajectory) else []


@pytest.mark.parametrize("name", RESULTS)
def test_notebooks_get_a_well_formed_table(name):
    table = ElementTree.fromstring(SAMPLES[name]._repr_html_())
    first = table if table.tag == "table" else table[0]
    cells = [["".join(cell.itertext()) for cell in row] for row in first.iter("tr")]
    assert [text for _, text in cells] == [text for _, text in SAMPLES[name]._rows()]


@pytest.mark.parametrize("name", RESULTS)
def test_data_sets_hold_the_numbers_and_units(name):
    result, data = SAMPLES[name], SAMPLES[name].to_xarray()
    for one in dataclasses.fields(result):
        value, said = getattr(result, one.name), explained(type(result), one.name)
        if isinstance(value, float | np.ndarray):
            np.testing.assert_array_equal(data[one.name].values, value)
            assert data[one.name].attrs.get("units", "") == result._own_units().get(one.name, said.unit)


@pytest.mark.parametrize("name", [name for name, kind in RESULTS.items() if "to_table" not in vars(kind)])
def test_data_frames_hold_the_same_numbers_as_data_sets(name):
    data, frame = SAMPLES[name].to_xarray(), SAMPLES[name].to_dataframe()
    columns = {str(key): frame[key].to_numpy() for key in frame}
    if frame.index.name:
        columns[frame.index.name] = frame.index.to_numpy()
    assert set(columns) <= set(frame.attrs["units"])
    for key, array in data.variables.items():
        if str(key) in ("axis", "force_axis"):
            continue
        parts = {
            column: values
            for column, values in columns.items()
            if re.fullmatch(rf"{key}(_[xy\d_]+)?(_real|_imag)?", column)
        }
        for column in [column for column in parts if column.endswith("_real")]:
            imaginary = parts.pop(column.removesuffix("real") + "imag")
            parts[column] = parts[column] + 1j * imaginary
        noted = frame.attrs.get(key, frame.attrs.get(f"{key}_real"))
        if np.iscomplexobj(array.values) and not parts:
            noted = noted + 1j * np.array(frame.attrs[f"{key}_imag"])
        kept = np.concatenate(list(parts.values())) if parts else np.ravel(noted)
        assert sorted(map(str, kept.tolist())) == sorted(map(str, np.ravel(array.values).tolist())), key
        said = {unit for name, unit in frame.attrs["units"].items() if name.startswith(str(key))}
        assert array.attrs.get("units", "") in said


DRAWN = [(name, kind) for name in sorted(set(PICTURES) & set(RESULTS)) for kind in PICTURES[name]]


@pytest.mark.parametrize(("name", "kind"), DRAWN)
def test_pictures_show_data_on_the_axes_given(name, kind):
    result = REAL.get(name, SAMPLES[name])
    if (name, kind) in (("RotorAnswer", "response"), ("HeatedState", "circumference")):
        pytest.skip("needs a response or a film, which a sample has not")
    drawn = result.plot(kind)
    first = drawn[0] if isinstance(drawn, tuple) else drawn
    assert first.has_data()
    again = result.plot(kind, axes=drawn)
    assert (again[0] if isinstance(again, tuple) else again) is first
    assert len(result.plot(kind, backend="plotly").data)


def test_what_has_a_picture_is_listed_once():
    drawn = {name for name, kind in RESULTS.items() if issubclass(kind, Drawable)}
    assert drawn - {"HeatedJFOState"} == set(PICTURES) & set(RESULTS)
    assert set(PICTURES) - drawn == {"ShaftRotor", "TabulatedBearing"}
    assert not hasattr(SAMPLES["Equilibrium"], "plot")
    with pytest.raises(
        rotorfilm.InputError, match="picture of a Campbell must be one of campbell, log_decrement"
    ):
        SAMPLES["Campbell"].plot("waterfall")
    with pytest.raises(rotorfilm.InputError, match="backend must be one of matplotlib, plotly"):
        SAMPLES["Campbell"].plot(backend="bokeh")


def whirling_run():
    """Return a run-up from 10 to 60 turns a second, an ellipse at 1x and a circle at half the speed."""
    time = np.linspace(0.0, 4.0, 8001)
    speed = 2.0 * np.pi * (10.0 + 12.5 * time)
    angle = 2.0 * np.pi * (10.0 * time + 6.25 * time**2)
    z = 5e-6 * np.exp(1j * angle) + 2e-6 * np.exp(-1j * angle) + 1e-6 * np.exp(0.5j * angle)
    signals = {"disk_x": z.real, "disk_y": z.imag, "speed": speed}
    return Trajectory(time=time, signals=signals, work={}, units={"disk_x": "m"})


RUN = whirling_run()
REAL = {
    "Trajectory": RUN,
    "CoSimulation": dataclasses.replace(SAMPLES["CoSimulation"], trajectory=RUN),
    "RunSpectra": run_spectra(RUN),
    "RunOrbits": run_orbits(RUN, [200.0, 300.0]),
    "SynchronousOrbits": SAMPLES["SynchronousOrbits"],
}
"""Results whose pictures need more than made-up numbers."""


def equilibrium():
    return Equilibrium(
        position=np.array([2.5e-5, -9.25e-6]),
        speed=100.0 * np.pi,
        load=np.array([0.0, -525.0]),
        eccentricity_ratio=0.275,
        attitude_angle=np.pi / 3.0,
        minimum_film=7.25e-5,
        residual=1e-15,
        iterations=4,
    )


def test_an_equilibrium_reads_as_the_command_line_prints_it():
    assert (
        str(equilibrium())
        == """\
Equilibrium
position            (25, -9.25) um
speed               314.159 rad/s = 3000 rpm
load                (0, -525) N
eccentricity ratio  0.275
attitude angle      60 deg
minimum film        72.5 um
residual            1e-15
iterations          4"""
    )
    assert repr(equilibrium()).startswith(
        "Equilibrium(position: (25, -9.25) um, speed: 314.159 rad/s = 3000 rpm,"
    )


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (2.5e-3, "m/s", "2.5 mm/s"),
        (-4e-6, "m/s", "-4 um/s"),
        (3e-9, "m", "3 nm"),
        (1.5, "m", "1.5 m"),
        (0.0, "m", "0 m"),
        (0.0, "Pa", "0 Pa"),
        (2.5e7, "Pa", "25 MPa"),
        (4e-5, "s", "40 us"),
        (2.0, "N.m", "2 N m"),
        (3.0, "1/s", "3 1/s"),
        (float("nan"), "N", "nan N"),
        (np.array([1e-3, 2.0]), "m", "(0.001, 2) m"),
        (1.0 - 2.0j, "1/s", "1-2i 1/s"),
    ],
)
def test_a_quantity_has_a_unit_of_its_size(value, unit, text):
    assert quantity(value, unit) == text


def test_properties_have_the_units_of_their_docstrings():
    data = SAMPLES["Campbell"].to_xarray()
    np.testing.assert_array_equal(data.frequency.values, SAMPLES["Campbell"].eigenvalues.imag)
    assert (data.frequency.attrs["units"], data.log_decrement.attrs["units"]) == ("rad/s", "1")


def test_a_matrix_has_its_entries_by_name():
    film = Coefficients(
        stiffness=np.array([[1.25e7, 2.0], [-3.0, 4.0]]), damping=np.eye(2), position=np.zeros(2), speed=0.0
    )
    frame, data = film.to_dataframe(), film.to_xarray()
    assert frame["stiffness_xy"][0] == data.stiffness.sel(force_axis="x", axis="y") == 2.0
    assert frame.attrs["units"]["damping_yx"] == data.damping.attrs["units"] == "N s/m"
    assert "xx       1.25e+07   xy              2 N/m" in str(film)


def test_what_a_result_in_a_result_repeats_is_left_out():
    at = equilibrium()
    whole = SAMPLES["Answer"]
    film = dataclasses.replace(whole.coefficients, position=at.position, speed=at.speed)
    rows = dataclasses.replace(whole, equilibrium=at, coefficients=film).to_rows()
    assert rows.count(("  position", "(25, -9.25) um")) == 1


def test_equal_bearings_are_both_shown():
    one = Coefficients(stiffness=np.eye(2), damping=2.0 * np.eye(2), position=np.zeros(2), speed=1.0)
    loads = {"left": np.zeros(2), "right": np.zeros(2)}
    rest = rotorfilm.analysis.RotorEquilibrium(
        speed=1.0,
        coefficients={"left": one, "right": one},
        loads=loads,
        displacement=np.zeros(8),
        residual=0.0,
    )
    rows = rest.to_rows()
    first, second = (rows.index((f"coefficients {name}", "")) for name in loads)
    count = second - first
    assert rows[first + 1 : second] == rows[second + 1 : second + count]
    assert count == 1 + len(one.to_rows())
    assert ", : " not in repr(rest)


def test_a_campbell_diagram_is_a_table_of_speeds_and_modes():
    values = np.array([[-1 + 10j, -1 + 12j, 1 + 14j], [-2 + 40j, -2 + 39j, complex(np.nan, np.nan)]])
    direction = np.array([[1.0, 1.0, 1.0], [-1.0, -1.0, np.nan]])
    chart = Campbell(speeds=np.array([8.0, 12.0, 16.0]), eigenvalues=values, direction=direction)
    frame = chart.to_dataframe()
    assert list(frame["mode"]) == [1, 2, 1, 2, 1]
    np.testing.assert_allclose(frame["frequency"] * 2.0 * np.pi, [10.0, 40.0, 12.0, 39.0, 14.0])
    np.testing.assert_allclose(frame["frequency_rpm"], 60.0 * frame["frequency"])
    np.testing.assert_allclose(frame["damping_ratio"][0], 1.0 / np.sqrt(101.0))
    assert list(frame["whirl"]) == ["forward", "backward", "forward", "backward", "forward"]
    assert {frame[name].dtype.kind for name in frame} <= set("fiOU")
    assert frame.attrs["units"]["frequency"] == "Hz"
    assert "2.228 F*" in str(chart)


@pytest.mark.closed_form
def test_critical_speeds_are_interpolated_between_the_speeds():
    """A frequency of 10 + w^2/50 is that of the rotation at w = 25 -+ sqrt(125)."""
    speeds = np.linspace(5.0, 40.0, 36)
    values = (-0.5 + 1j * (10.0 + speeds**2 / 50.0))[None]
    chart = Campbell(speeds=speeds, eigenvalues=values, direction=np.ones((1, 36)))
    low, high = chart.crossings
    assert [low.speed, high.speed] == pytest.approx([25.0 - np.sqrt(125.0), 25.0 + np.sqrt(125.0)], rel=1e-4)
    assert low.log_decrement == pytest.approx(np.pi / low.speed, rel=1e-3)
    turned = dataclasses.replace(chart, speeds=-speeds)
    assert sorted(-one.speed for one in turned.crossings) == pytest.approx([low.speed, high.speed])


def test_modes_print_as_a_table_of_kinds():
    modes = RotorModes(
        speed=100.0,
        eigenvalues=np.array([-1.0 + 10.0j, -0.5 + 30.0j]),
        shapes=np.zeros((2, 2), complex),
        direction=np.array([-0.8, 0.0]),
        energy=np.array([[1.0, 0.1], [0.0, 0.0], [0.0, 0.9]]),
    )
    heading, first, second = str(modes).splitlines()[-3:]
    assert heading.split("  ")[0] == "mode"
    assert first.split() == ["1", "1.5915", "95.493", "0.62832", "0.099504", "backward", "lateral"]
    assert second.split()[-2:] == ["mixed", "torsional"]


def test_a_table_is_the_same_in_csv_and_json(tmp_path):
    modes = RotorModes(
        speed=100.0,
        eigenvalues=np.array([-1.0 + 10.0j]),
        shapes=np.zeros((2, 1), complex),
        direction=np.array([np.nan]),
    )
    heading, row = modes.to_csv(tmp_path / "modes.csv").read_text().splitlines()
    assert heading.startswith("mode,frequency [Hz],frequency_rpm [rpm],log_decrement [1]")
    assert float(row.split(",")[3]) == pytest.approx(0.2 * np.pi)
    data = json.loads(modes.to_json())
    assert data["columns"]["log_decrement"] == [pytest.approx(0.2 * np.pi)]
    assert data["notes"]["speed"] == 100.0
    assert data["units"]["frequency_rpm"] == "rpm"


def test_inputs_print_as_data_sheets():
    steel = rotorfilm.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    rotor = rotorfilm.ShaftRotor(
        elements=rotorfilm.ShaftElement(length=1.2, outer_diameter=0.05, material=steel).split(2),
        stations=(rotorfilm.Station(node=0, name="left"), rotorfilm.Station(node=2, name="right")),
        disks=(rotorfilm.Disk(node=1, mass=10.0, polar_inertia=0.2, diametral_inertia=0.1),),
        speed=100.0,
    )
    text = str(rotor)
    assert f"mass   {10.0 + 7810.0 * 1.2 * np.pi * 0.025**2:.6g} kg" in text
    assert text.count("600                   50") == 2
    assert "0  left" in text
    assert "axial" not in text
    film = rotorfilm.JournalBearing(**BEARING)
    assert str(film).splitlines()[1] == "radius     50 mm"
    assert "<th>node</th>" in rotor._repr_html_()
    pads = rotorfilm.TiltingPadBearing(
        radius=0.04,
        length=0.04,
        assembled_clearance=7e-5,
        extent=1.0,
        viscosity=0.02,
        pivots=rotorfilm.even_pivots(5),
    )
    assert str(pads).splitlines()[-2].strip() == "film"
    assert str(pads).splitlines()[-1].split()[0] == "resolution"


@pytest.mark.closed_form
def test_a_table_of_coefficients_has_the_equilibria_and_the_losses():
    film = rotorfilm.JournalBearing(**BEARING)
    table = coefficient_table(film, (0.0, -525.0), [100.0, 200.0])
    frame, at = table.to_dataframe(), rotorfilm.equilibrium(film, (0.0, -525.0), 200.0)
    assert frame.loc[200.0, "eccentricity_ratio"] == at.eccentricity_ratio
    assert frame.loc[200.0, "power_loss"] == at.losses.power_loss
    assert frame.loc[200.0, "kxy"] == rotorfilm.coefficients(film, at.position, 200.0).stiffness[0, 1]
    assert {kind.kind for kind in frame.dtypes} == {"f"}
    assert frame.attrs["units"]["cyx"] == "N s/m"


def test_what_does_not_exist_is_not_a_number_and_says_why():
    names = ("speed", "whirl_ratio", "critical_mass", "speed_parameter", "equilibrium")
    none = WhirlThreshold(**dict.fromkeys(names), reason="stable")
    assert dict(none.to_rows())["reason"] == "stable"
    assert np.isnan(none.to_xarray().speed)
    assert none.to_dataframe().attrs["reason"] == "stable"


def test_a_run_is_a_table_over_time():
    time = np.linspace(0.0, 0.1, 7)
    run = Trajectory(time=time, signals={"x": 1e-5 * time}, work={"steps": 2}, units={"x": "m"})
    frame, data = run.to_dataframe(), run.to_xarray()
    assert frame.index.name == "time"
    np.testing.assert_array_equal(frame["x"], run["x"])
    np.testing.assert_array_equal(data.x.sel(time=0.1, method="nearest"), run["x"][-1])
    assert data.time.attrs["units"] == "s"
    assert frame.attrs["units"] == {"time": "s", "x": "m"}
    assert frame.attrs["work_steps"] == 2


def test_an_orbit_is_drawn_in_micrometers():
    time = np.linspace(0.0, 0.1, 7)
    signals = {"left_x": 1e-5 * time, "left_y": -time, "left_force_x": time}
    run = Trajectory(time=time, signals=signals, work={})
    orbit, over_time = run.plot()
    np.testing.assert_allclose(orbit.get_lines()[0].get_ydata(), -1e6 * time)
    assert [line.get_label() for line in over_time.get_lines()] == ["left x", "left y"]


def test_the_pressure_of_a_film_is_drawn_from_end_to_end():
    state = dataclasses.replace(
        SAMPLES["FilmState"],
        angle=np.array([3.0, 1.0]),
        axial=np.array([0.0, 0.01]),
        pressure=np.array([[5e6, 1e6], [7e6, 2e6]]),
    )
    mesh = state.plot().collections[0]
    np.testing.assert_allclose(mesh.get_array(), [[2.0, 1.0], [7.0, 5.0], [2.0, 1.0]])


def test_the_page_on_results_is_executed():
    page = Path(__file__).parents[2] / "docs" / "results.md"
    text = page.read_text(encoding="utf-8").partition("```python")[2].partition("```")[0]
    example = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    assert doctest.DocTestRunner(optionflags=doctest.ELLIPSIS, verbose=False).run(example).failed == 0
    assert len(example.examples) == 4


def test_signals_of_a_run_have_the_units_of_the_models():
    film = rotorfilm.JournalBearing(**BEARING)
    rotor = rotorfilm.RigidRotor(mass=50.0, speed=100.0)
    run = rotorfilm.simulate(rotor, film, duration=1e-3)
    slow = rotorfilm.simulate(rotor, film, duration=1e-3, method=BDF)
    coupled = rotorfilm.cosimulate(rotor, film, macro_step=1e-4, duration=1e-3).trajectory
    units = {"x": "m", "y": "m", "vx": "m/s", "vy": "m/s", "speed": "rad/s", "force_x": "N", "force_y": "N"}
    assert run.units == slow.units == coupled.units == units


def test_the_ladder_is_the_table_of_an_answer():
    frame = SAMPLES["QuestionAnswer"].to_dataframe()
    assert len(frame) == 2
    assert list(frame["rungs_verdict"]) == ["str <&> text"] * 2
    assert frame["rungs_cost"][0] == SAMPLES["QuestionAnswer"].rungs[0].cost


@pytest.mark.parametrize(("package", "method"), [("pandas", "to_dataframe"), ("xarray", "to_xarray")])
def test_a_missing_package_is_named(monkeypatch, package, method):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(AbsentError, match=f"{package} must be installed for this, .* pip install"):
        getattr(equilibrium(), method)()


def test_a_bearing_with_openings_tells_its_film():
    openings = {"grooves": (rotorfilm.Groove(center=1.5, width=0.3),)}
    grooved = rotorfilm.JournalBearing(**BEARING, **openings)
    assert "film=GroovedMapFilm(cells=(192, 12)," in repr(grooved)
    made = eval(repr(grooved), {name: getattr(bearings, name) for name in bearings.__all__})
    assert made.fitted_film == grooved.fitted_film
    plain = rotorfilm.JournalBearing(**BEARING)
    assert "film=MapFilm()" in repr(plain)


def test_losses_without_openings_are_one_row():
    pytest.importorskip("pandas")
    bearing = rotorfilm.JournalBearing(**BEARING)
    losses = bearing.losses([3e-5, 0.0], [0.0, 0.0], 100.0)
    frame = losses.to_dataframe()
    assert frame.shape[0] == 1
    assert frame["power_loss"][0] == losses.power_loss


def test_round_off_beside_a_large_entry_is_shown_as_zero():
    """Small numbers of their own stay."""
    shown = texts("stiffness", np.array([[4e8, -1.5e-8], [1e-3, 4e8]]), "N/m")
    assert [line.split() for line in shown] == [
        ["xx", "4e+08", "xy", "0", "N/m"],
        ["yx", "0.001", "yy", "4e+08", "N/m"],
    ]
    assert texts("stiffness", np.array([[1e-9, 0.0], [2e-9, -3e-9]]), "N/m")[1].split()[1:4:2] == [
        "2e-09",
        "-3e-09",
    ]


def test_moments_on_bearings_of_a_rotor_are_in_newton_meters():
    steel = rotorfilm.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    elements = rotorfilm.ShaftElement(length=1.0, outer_diameter=0.05, material=steel).split(2)
    ends = tuple(
        rotorfilm.Station(node=2 * k, name=name, feels_tilt=True) for k, name in enumerate(("left", "right"))
    )
    spring = rotorfilm.LinearBearing(
        stiffness=np.diag([1e7, 1e7, 1e3, 1e3]), freedoms=("x", "y", "tilt_x", "tilt_y")
    )
    rotor = rotorfilm.ShaftRotor(elements=elements, stations=ends, speed=100.0)
    at = rotorfilm.rotor_equilibrium(rotor, {"left": spring, "right": spring}, 100.0)
    rows = dict(at.to_rows())
    assert rows["loads left y"].endswith(" N")
    assert rows["loads left tilt x"].endswith(" N m")
    assert read(rows["loads left tilt x"], "N.m") == pytest.approx(at.loads["left"][2], rel=1e-5)
