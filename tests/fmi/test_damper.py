"""Native FMUs of squeeze-film dampers: forces and derivatives of Python, springs, walls, coupling."""

import re
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import (
    ContactError,
    FiniteMapSqueeze,
    FmuError,
    FullFilm,
    InputError,
    JournalBearing,
    PorousCage,
    PorousDamper,
    RadialFeed,
    RigidRotor,
    cosimulate,
    export_fmu,
    simulate,
    with_springs,
)
from rotorfilm.bearings import AxialFeed, EndSeal, HalfSommerfeld, MapSqueeze, ShortSqueeze
from rotorfilm.fmu import check_fmu
from rotorfilm.fmu.python.codec import class_modules, decode, encode

from .journals import crosswise, version_and_kind

CAGE = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
DAMPER = PorousDamper(
    radius=0.05, length=0.025, clearance=1e-4, viscosity=1.2e-3, cage=CAGE, film=MapSqueeze()
)
SUPPORT = with_springs(DAMPER, 2.56e5)
ROTOR = RigidRotor(
    mass=10.0, speed=400.0, unbalance=4e-4, gravity=(0.0, 0.0), position=(3e-5, 0.0), velocity=(0.0, 0.012)
)
FINITE = replace(DAMPER, length=0.05, film=FiniteMapSqueeze(cells=(8, 12)))
MODELS = {
    "cavitated": DAMPER,
    "full": replace(DAMPER, extent=FullFilm()),
    "solid": replace(DAMPER, cage=None),
    "vented": replace(DAMPER, cage=replace(CAGE, vented=True, anisotropy=3.0)),
    "finite": FINITE,
    "full finite": replace(FINITE, extent=FullFilm()),
    "sprung": SUPPORT,
}
SHORT = replace(DAMPER, film=ShortSqueeze())
VENTED = replace(CAGE, vented=True, supply_pressure=2e4)
SHORT_MODELS = {
    "full": replace(SHORT, extent=FullFilm()),
    "cavitated": SHORT,
    "radial": replace(SHORT, feed=RadialFeed(inflow=2e-4, cosine=True)),
    "vented": replace(SHORT, cage=VENTED),
    "axial": replace(SHORT, cage=None, feed=AxialFeed(start_pressure=3e4, end_pressure=1e4)),
    "full fed": replace(SHORT, extent=FullFilm(), cage=VENTED),
}
FEEDS = ("inflow", "supply_pressure", "start_pressure", "end_pressure")
VERSIONS = ["2.0", "3.0"]
MOTION = ("x", "y", "vx", "vy")
FORCES = ("force_x", "force_y")
models = pytest.mark.parametrize("model", MODELS.values(), ids=MODELS.keys())
versions = pytest.mark.parametrize("version", VERSIONS)


@pytest.fixture(scope="module", autouse=True)
def kept(tmp_path_factory):
    """Return the folder of the maps of this module."""
    folder = tmp_path_factory.mktemp("maps")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(folder))
        yield folder


def motions(count, largest=0.97):
    rng = np.random.default_rng(4)
    chi, angle = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.stack([np.cos(angle), np.sin(angle)])
    return np.concatenate([position, 0.05 * rng.normal(size=(2, count))]).T


@models
@version_and_kind
def test_forces_and_derivatives_are_those_of_python(model, version, exchange, opened):
    instance, reference = opened(model, version, exchange)
    inputs, outputs = [reference[name] for name in MOTION], [reference[name] for name in FORCES]
    assert "speed" not in reference
    states = motions(20)
    instance.initialize(inputs, states[0].tolist())
    for number, state in enumerate(states):
        if not exchange:
            instance.step(1e-3 * number, 1e-3)
        instance.set(inputs, state.tolist())
        force = model.force(state[:2], state[2:])
        found = np.array(instance.get(outputs))
        np.testing.assert_allclose(found, force, rtol=0, atol=1e-12 * np.linalg.norm(force))
        columns = [instance.directional(outputs, [one], [1.0]) for one in inputs]
        expected = model.jacobian(state[:2], state[2:])[:, :4]
        for block in (slice(0, 2), slice(2, 4)):
            scale = np.abs(expected[:, block]).max()
            np.testing.assert_allclose(
                np.array(columns).T[:, block], expected[:, block], rtol=0, atol=1e-12 * scale
            )


@pytest.mark.parametrize(("name", "version"), crosswise(MODELS))
def test_a_damper_with_a_map_is_native_by_default_and_passes_all_checks(name, version, tmp_path):
    path = export_fmu(MODELS[name], tmp_path / "d.fmu", version, start={"x": 3e-5, "vy": 0.02})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    names = {
        variable.name.partition(".")[2] for variable in fmpy.read_model_description(str(path)).modelVariables
    }
    dimensions = {"radius", "length", "clearance", "viscosity", "stiffness"}
    assert names - {""} == {*MOTION, *FORCES, *dimensions}


@pytest.mark.parametrize("name", SHORT_MODELS)
@versions
def test_a_short_damper_has_the_very_numbers_of_python(name, version, opened):
    model, exchange = SHORT_MODELS[name], name in ("full", "axial")
    instance, reference = opened(model, version, exchange)
    inputs, outputs = [reference[name] for name in MOTION], [reference[name] for name in FORCES]
    states = motions(5)
    instance.initialize(inputs, states[0].tolist())
    for state in states:
        instance.set(inputs, state.tolist())
        np.testing.assert_array_equal(instance.get(outputs), model.force(state[:2], state[2:]))
        columns = [instance.directional(outputs, [one], [1.0]) for one in inputs]
        np.testing.assert_array_equal(np.array(columns).T, model.jacobian(state[:2], state[2:])[:, :4])


@pytest.mark.parametrize(("name", "version"), [("vented", "2.0"), ("axial", "3.0")])
def test_a_short_damper_passes_all_checks(name, version, tmp_path):
    path = export_fmu(SHORT_MODELS[name], tmp_path / "d.fmu", version, start={"x": 3e-5, "vy": 0.02})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


@pytest.mark.parametrize(
    ("name", "change", "changed"),
    [
        ("radial", {"inflow": -1e-4}, lambda m: replace(m, feed=RadialFeed(inflow=-1e-4, cosine=True))),
        (
            "vented",
            {"supply_pressure": 5e4, "viscosity": 2e-3},
            lambda m: replace(m, cage=replace(VENTED, supply_pressure=5e4), viscosity=2e-3),
        ),
        (
            "axial",
            {"end_pressure": 4e4, "clearance": 1.2e-4, "length": 0.02},
            lambda m: replace(
                m,
                feed=AxialFeed(start_pressure=3e4, end_pressure=4e4),
                clearance=1.2e-4,
                length=0.02,
            ),
        ),
    ],
)
def test_what_feeds_a_damper_is_tunable(name, change, changed, opened):
    model, state = SHORT_MODELS[name], motions(1, 0.8)[0]
    instance, reference = opened(model, "2.0", False)
    instance.initialize([reference[one] for one in MOTION], state.tolist())
    instance.step(0.0, 1e-3)
    instance.set([reference[one] for one in change], list(change.values()))
    np.testing.assert_array_equal(
        instance.get([reference[one] for one in FORCES]), changed(model).force(state[:2], state[2:])
    )
    other = next(one for one in FEEDS if one not in change and not getattr(model.feed, one, 0.0))
    with pytest.raises(FMICallException):
        instance.set([reference[other]], [1.0])


@pytest.mark.parametrize("extent", [FullFilm(), HalfSommerfeld()], ids=["full", "cavitated"])
def test_a_short_film_between_seals_has_the_force_and_mass_of_python(extent, opened):
    model = replace(SHORT, cage=None, extent=extent, seals=EndSeal(leakage=2e-8), density=800.0)
    instance, reference = opened(model, "3.0", False)
    state = motions(1, 0.8)[0]
    instance.initialize([reference[one] for one in MOTION], state.tolist())
    found = instance.get([reference[one] for one in FORCES])
    np.testing.assert_allclose(found, model.force(state[:2], state[2:]), rtol=1e-12)
    mass = model.mass(state[:2], state[2:])
    told = instance.get([reference[f"mass_{pair}"] for pair in ("xx", "xy", "yy")])
    np.testing.assert_allclose(told, [mass[0, 0], mass[0, 1], mass[1, 1]], rtol=1e-12)


@versions
def test_springs_and_viscosity_are_tunable(version, opened):
    instance, reference = opened(DAMPER, version, False)
    state = motions(1)[0]
    instance.initialize([reference[name] for name in MOTION], state.tolist())
    instance.step(0.0, 1e-3)
    instance.set([reference["stiffness"], reference["viscosity"]], [3e6, 2e-3])
    expected = with_springs(replace(DAMPER, viscosity=2e-3), 3e6).force(state[:2], state[2:])
    found = instance.get([reference[name] for name in FORCES])
    np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("model", "free"),
    [
        (DAMPER, {"radius"}),
        (replace(DAMPER, cage=None), {"radius", "length", "clearance"}),
        (FINITE, set()),
        (replace(FINITE, cage=None), {"clearance"}),
    ],
    ids=["porous", "solid", "finite", "solid, finite"],
)
def test_only_what_the_map_holds_for_is_free(model, free, opened):
    # The map is for A H/C^3 and H/L of a cage, and for L/D of a film of finite length.
    values = {"radius": 0.06, "length": 0.024, "clearance": 0.9e-4}
    state = motions(1, 0.8)[0]
    for name, value in values.items():
        instance, reference = opened(model, "2.0", False)
        instance.initialize([reference[key] for key in MOTION], state.tolist())
        if name not in free:
            with pytest.raises(FMICallException, match=r"status 3 \(error\)"):
                instance.set([reference[name]], [value])
            continue
        instance.set([reference[name]], [value])
        expected = replace(model, **{name: value}).force(state[:2], state[2:])
        found = instance.get([reference[key] for key in FORCES])
        np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize(
    ("values", "rule"),
    [
        ({"stiffness": -1.0}, "film.stiffness must be within"),
        ({"clearance": 0.06}, "clearance must be below"),
    ],
)
def test_bad_parameters_are_named(values, rule, opened):
    instance, reference = opened(replace(DAMPER, cage=None), "2.0", False)
    with pytest.raises(FMICallException):
        instance.initialize([reference[name] for name in values], list(values.values()))
    assert any(rule in line for line in instance.log), instance.log


@versions
@pytest.mark.parametrize(
    ("interface", "status"), [("CoSimulation", "3 (error)"), ("ModelExchange", "2 (discard)")]
)
def test_a_damper_at_the_wall_ends_fmpy(interface, status, version, tmp_path, capsys):
    path = export_fmu(SUPPORT, tmp_path / "film.fmu", version, component="film")
    rows = np.array([(0.0, 0.0), (0.01, 2e-4)], dtype=[("time", float), ("film.x", float)])
    with pytest.raises(FMICallException, match=r"failed with status " + re.escape(status)):
        fmpy.simulate_fmu(
            str(path), fmi_type=interface, input=rows, stop_time=0.01, step_size=1e-3, output_interval=1e-3
        )
    assert "must stay inside the clearance 0.0001 m, got an eccentricity of" in capsys.readouterr().out


@versions
def test_at_rest_there_is_no_force_but_the_springs_and_no_derivative_off_the_center(version, opened):
    instance, reference = opened(SUPPORT, version, False)
    inputs, outputs = [reference[name] for name in MOTION], [reference[name] for name in FORCES]
    instance.initialize(inputs, [3e-5, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(instance.get(outputs), [-2.56e5 * 3e-5, 0.0], rtol=1e-14)
    with pytest.raises(FMICallException):
        instance.directional(outputs, inputs[:1], [1.0])


@pytest.mark.convergence
@versions
def test_coupled_fmus_follow_the_monolithic_solution(version, tmp_path):
    film = export_fmu(SUPPORT, tmp_path / "damper.fmu", version, component="film")
    rotor = export_fmu(ROTOR, tmp_path / "rotor.fmu", version, component="rotor")
    duration = 0.02
    reference = simulate(ROTOR, SUPPORT, duration=duration, samples=21)
    errors = []
    for step in (4e-5, 2e-5, 1e-5):
        coupled = cosimulate(str(rotor), str(film), macro_step=step, duration=duration)
        every = round(1e-3 / step)
        apart = coupled.trajectory.position[:, ::every] - reference.position
        errors.append(np.abs(apart).max() / DAMPER.clearance)
    assert errors[-1] < 2.5e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(1.0, abs=0.1)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(1.0, abs=0.1)


def test_coupled_fmus_report_the_wall(tmp_path):
    film = export_fmu(SUPPORT, tmp_path / "damper.fmu", component="film")
    heavy = replace(ROTOR, unbalance=5e-3)
    rotor = export_fmu(heavy, tmp_path / "rotor.fmu", component="rotor")
    with pytest.raises(ContactError, match="journal reached the wall") as caught:
        cosimulate(str(rotor), str(film), macro_step=1e-5, duration=0.1)
    assert np.hypot(*caught.value.partial.trajectory.position[:, -1]) < DAMPER.clearance


def test_a_class_of_ones_own_runs_in_python(tmp_path):
    class Twin(PorousDamper):
        """Two dampers."""

    dimensions = {"radius": 0.05, "length": 0.025, "clearance": 1e-4, "viscosity": 1.2e-3}
    journal = JournalBearing(**dimensions)
    twin = Twin(**dimensions, film=MapSqueeze())
    assert twin.native() is None
    assert with_springs(twin, 1.0).native() is None
    with pytest.raises(FmuError, match="must have a kernel in the C library"):
        export_fmu(twin, tmp_path / "d.fmu", backend="native")
    assert journal.native() is not None
    assert with_springs(journal, 1.0).native() is None
    with pytest.raises(InputError, match="feed must be None"):
        replace(DAMPER, extent=FullFilm(), feed=RadialFeed(inflow=0.1))


def test_springs_add_up():
    both = with_springs(SUPPORT, 1e5).native()
    assert {p.name: p.value for p in both.parameters}["stiffness"] == pytest.approx(3.56e5)


@pytest.mark.parametrize("model", [SUPPORT, with_springs(FINITE, 1e5)], ids=["short", "finite"])
def test_data_of_a_python_fmu_hold_the_table(model, tmp_path, monkeypatch, kept):
    # Made anew, so that it keeps no film of a table that was made before: two tables differ by round-off.
    model = replace(model, reactions=(replace(model.reactions[0]), model.reactions[1]))
    data = encode(model)
    # Nothing to find, nothing to make.
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "absent"))
    again = decode(data, {name: name for name in class_modules(model)})
    assert again.reactions[0].film.table is not None
    state = motions(1)[0]
    np.testing.assert_array_equal(again.force(state[:2], state[2:]), model.force(state[:2], state[2:]))
    with pytest.raises(InputError, match="table must be that of the damper"):
        replace(again.reactions[0], cage=replace(CAGE, permeability=5e-13))
    assert not (tmp_path / "absent").exists()
