"""Native FMUs of films that are a table over the eccentricity ratio: a fixed arc, and full squeeze films."""

from dataclasses import replace

import fmpy
import numpy as np
import pytest

from rotorfilm import (
    FullFilm,
    JournalBearing,
    PorousCage,
    RigidRotor,
    SqueezeFilmDamper,
    export_fmu,
    mount,
    simulate,
    with_springs,
)
from rotorfilm.bearings import FiniteSqueeze, PublishedSqueeze
from rotorfilm.bearings.journal import FixedArc, RotatingArc, SplittingFilm
from rotorfilm.fmu import check_fmu
from rotorfilm.native import NativeSpec

from .journals import crosswise, version_and_kind

JOURNAL = JournalBearing(
    radius=0.05, length=0.03, clearance=1e-4, viscosity=0.02, film=SplittingFilm(order=(2, None))
)
JOURNALS = {
    "published": replace(JOURNAL, film=SplittingFilm(order=(1, 1))),
    "two": JOURNAL,
    "long arc": replace(
        JOURNAL,
        film=SplittingFilm(order=(6, 3), constant=True, rupture=FixedArc(start=0.3, extent=4.0)),
    ),
}
CAGE = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1, vented=True, supply_pressure=2e4)
DAMPER = SqueezeFilmDamper(
    radius=0.05, length=0.05, clearance=1e-4, viscosity=1.2e-3, extent=FullFilm(), film=FiniteSqueeze()
)
LINEAR = replace(DAMPER, cage=CAGE, film=PublishedSqueeze())
DAMPERS = {
    "finite": (replace(DAMPER, cage=CAGE), 1e-9),
    "published": (LINEAR, 1e-11),
    "published, sprung": (with_springs(LINEAR, 1e5), 1e-11),
}
JOURNAL_INPUTS = ("x", "y", "vx", "vy", "speed")
FORCES = ("force_x", "force_y")
versions = pytest.mark.parametrize("version", ["2.0", "3.0"])


def states(count, largest, seed=5):
    """Return x, y, vx, vy, speed (count, 5) inside the clearance, of both senses of rotation."""
    rng = np.random.default_rng(seed)
    chi, angle = rng.uniform(0.01, largest, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.stack([np.cos(angle), np.sin(angle)])
    return np.concatenate(
        [position, 0.02 * rng.normal(size=(2, count)), 300.0 * rng.normal(size=(1, count))]
    ).T


def compare(opened, model, version, exchange, names, largest, tolerance):
    """Compare forces and derivatives with those of the model, each by the largest of its kind."""
    instance, reference = opened(model, version, exchange)
    inputs, outputs = [reference[name] for name in names], [reference[name] for name in FORCES]
    drawn = states(12, largest)
    instance.initialize(inputs, drawn[0, : len(names)].tolist())
    for number, state in enumerate(drawn):
        if not exchange:
            instance.step(1e-3 * number, 1e-3)
        instance.set(inputs, state[: len(names)].tolist())
        force = model.force(state[:2], state[2:4], state[4])
        found = np.array(instance.get(outputs))
        np.testing.assert_allclose(found, force, rtol=0, atol=tolerance * np.linalg.norm(force))
        columns = np.array([instance.directional(outputs, [one], [1.0]) for one in inputs]).T
        expected = model.jacobian(state[:2], state[2:4], state[4])[:, : len(names)]
        for block in (slice(0, 2), slice(2, 4), slice(4, 5)):
            scale = np.abs(expected[:, block]).max(initial=0.0)
            np.testing.assert_allclose(
                columns[:, block], expected[:, block], rtol=0, atol=100.0 * tolerance * scale
            )


@pytest.mark.parametrize("model", JOURNALS.values(), ids=JOURNALS)
@version_and_kind
def test_a_splitting_film_on_a_fixed_arc_has_the_forces_of_python(model, version, exchange, opened):
    compare(opened, model, version, exchange, JOURNAL_INPUTS, 0.998, 1e-11)


@pytest.mark.parametrize(("model", "tolerance"), DAMPERS.values(), ids=DAMPERS)
@versions
def test_a_full_squeeze_film_has_the_forces_of_python(model, tolerance, version, opened):
    compare(opened, model, version, version == "3.0", JOURNAL_INPUTS[:4], 0.98, tolerance)


@pytest.mark.parametrize("speed", [200.0, -200.0])
def test_the_derivative_at_the_center_is_that_of_python(speed, opened):
    instance, reference = opened(JOURNAL, "3.0", exchange=True)
    inputs, outputs = [reference[name] for name in JOURNAL_INPUTS], [reference[name] for name in FORCES]
    instance.initialize(inputs, [0.0, 0.0, 0.0, 0.0, speed])
    columns = np.array([instance.directional(outputs, [one], [1.0]) for one in inputs]).T
    expected = JOURNAL.jacobian([0.0, 0.0], [0.0, 0.0], speed)
    for block in (slice(0, 2), slice(2, 4)):
        scale = np.abs(expected[:, block]).max()
        np.testing.assert_allclose(columns[:, block], expected[:, block], rtol=0, atol=1e-9 * scale)


@pytest.mark.parametrize(("name", "version"), crosswise(["journal", "damper"]))
def test_it_passes_all_checks(name, version, tmp_path):
    model = {"journal": JOURNAL, "damper": LINEAR}[name]
    path = export_fmu(model, tmp_path / "film.fmu", version, start={"x": 3e-5, "vy": 0.02})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []


def free(spec: NativeSpec) -> set[str]:
    return {one.name for one in spec.parameters if one.tunable}


@pytest.mark.parametrize(
    ("model", "tunable"),
    [
        (JOURNAL, {"clearance", "viscosity"}),
        (replace(LINEAR, cage=None), {"radius", "length", "clearance", "viscosity", "stiffness"}),
        (LINEAR, {"radius", "stiffness"}),
    ],
    ids=["journal", "published", "fed"],
)
def test_what_the_table_holds_for_is_fixed(model, tunable):
    assert free(model.native()) == tunable


def test_an_arc_that_turns_with_the_source_has_no_kernel():
    assert replace(JOURNAL, film=SplittingFilm(rupture=RotatingArc())).native() is None


@pytest.mark.parametrize("model", [JOURNAL, LINEAR], ids=["journal", "damper"])
@versions
def test_a_rotor_on_such_a_film_is_one_system(model, version, tmp_path):
    """The FMU of rotor and bearing, which needs no Python, follows the motion that `simulate` computes."""
    rotor = RigidRotor(mass=10.0, speed=300.0, unbalance=1e-4)
    system = mount(rotor, {"": with_springs(model, 1e6) if model is LINEAR else model})
    path = export_fmu(
        system, tmp_path / "system.fmu", version, backend="native", component="system", stop_time=1e-4
    )
    names = ["system.x", "system.y"]
    ran = fmpy.simulate_fmu(
        str(path), fmi_type="CoSimulation", stop_time=0.01, output_interval=1e-3, output=names
    )
    motion = simulate(rotor, system.bearings[0], duration=0.01, samples=11)
    apart = np.stack([ran[name] for name in names]) - motion.position
    assert np.abs(apart).max() < 1e-4 * np.abs(motion.position).max()
