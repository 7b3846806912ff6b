"""The map of a turbulent film over the Reynolds number: its grid, differences, identities, bad input."""

import zipfile
from collections import Counter
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings import MobileMapFilm, Turbulence, mobility_of
from rotorfilm.bearings.journal import ExtrapolatedFilm, MapFilm, MobileMapTable, ReynoldsFilm
from rotorfilm.fmu import check_fmu, extracted, instantiated

SIZE = {"radius": 0.25, "length": 0.4, "clearance": 5e-4, "viscosity": 0.0163}
PLACE, VELOCITY, SPEED = np.array([1.1e-4, -1.5e-4]), np.array([0.01, 0.02]), 250.0


def ng_pan(X):
    """Return the factors of the fit of Ng & Pan (1965), at the local Reynolds number."""
    k = 0.0136 * X**0.9, 0.0043 * X**0.96
    return *(12.0 / (12.0 + more) for more in k), 1.0, 1.0 + 0.0012 * X**0.94


TURBULENT = replace(mobility_of(ng_pan, largest=2e4, scale=30.0), density=855.0)
FILM = MobileMapFilm(
    mobility=TURBULENT,
    cells=(64, 8),
    nodes=(10, 24, 12),
    largest_eccentricity_ratio=0.8,
    largest_reynolds_number=4000.0,
)


@pytest.fixture(scope="module")
def bearing(tmp_path_factory):
    """Return a large turbulent bearing with its map."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.mktemp("maps")))
        yield rf.JournalBearing(**SIZE, film=FILM).portable()


def grid():
    """Return the bearing on a finer grid."""
    film = ExtrapolatedFilm(film=ReynoldsFilm(cells=(192, 16), mobility=TURBULENT))
    return rf.JournalBearing(**SIZE, film=film)


def test_map_is_its_film_at_all_speeds(bearing):
    fine = grid()
    for speed in (SPEED, -SPEED, 40.0, 450.0):
        wanted = fine.force(PLACE, VELOCITY, speed)
        assert_allclose(bearing.force(PLACE, VELOCITY, speed), wanted, atol=3e-3 * np.hypot(*wanted))
        by, exact = (each.jacobian(PLACE, VELOCITY, speed) for each in (bearing, fine))
        for columns in ((0, 1), (2, 3), (4,)):
            size = np.abs(exact[:, columns]).max()
            assert_allclose(by[:, columns], exact[:, columns], atol=0.05 * size)


def test_derivatives_are_those_of_differences_and_damping_is_symmetric(bearing):
    by = bearing.jacobian(PLACE, VELOCITY, SPEED)
    state, steps = np.array([*PLACE, *VELOCITY, SPEED]), [1e-8, 1e-8, 1e-6, 1e-6, 1e-2]
    for k, step in enumerate(steps):
        more, less = (state + sign * step * np.eye(5)[k] for sign in (1.0, -1.0))
        differences = [bearing.force(each[:2], each[2:4], each[4]) for each in (more, less)]
        assert_allclose((differences[0] - differences[1]) / (2.0 * step), by[:, k], rtol=1e-6, atol=1e-3)
    assert_allclose(by[:, 2:4], by[:, 2:4].T, rtol=1e-12)


def test_force_at_rest_is_damping_times_half_the_speed(bearing):
    """F = C (speed/2) z x E, exactly, at any Reynolds number."""
    damping = -bearing.jacobian(PLACE, np.zeros(2), SPEED)[:, 2:4]
    found = damping @ (0.5 * SPEED * np.array([-PLACE[1], PLACE[0]]))
    assert_allclose(bearing.force(PLACE, np.zeros(2), SPEED), found, rtol=1e-12)


@pytest.mark.parametrize("band", [False, True], ids=["no band", "band"])
def test_one_reynolds_number_is_the_laminar_film_of_another_length(band):
    effect = Turbulence(closure="reichardt", band=band, density=855.0, local=False)
    scaled = rf.JournalBearing(**SIZE, film=rf.MapFilm(), turbulence=effect)
    fine = replace(scaled, film=ExtrapolatedFilm(film=ReynoldsFilm(cells=(192, 16))))
    for speed in (-SPEED, 40.0, 450.0):
        wanted = fine.force(PLACE, VELOCITY, speed)
        assert_allclose(scaled.force(PLACE, VELOCITY, speed), wanted, atol=2e-3 * np.hypot(*wanted))
        by, exact = (each.jacobian(PLACE, VELOCITY, speed) for each in (scaled, fine))
        assert_allclose(by[:, :4], exact[:, :4], atol=0.01 * np.abs(exact).max())
        assert_allclose(by[:, 4], exact[:, 4], atol=0.02 * np.hypot(*exact[:, 4]))


def test_a_warming_film_has_one_map_and_asks_for_its_heat_once_a_temperature(monkeypatch):
    asked = Counter()

    def count(kind, name):
        inner = getattr(kind, name)

        def counted(self, *given, **further):
            asked[name] += 1
            return inner(self, *given, **further)

        monkeypatch.setattr(kind, name, counted)

    count(MobileMapFilm, "built_table")
    count(rf.JournalBearing, "losses")
    warm = {"oil": rf.Oil.iso_vg(32), "cooling": rf.Cooling(supply_temperature=318.15), "viscosity": None}
    large = rf.JournalBearing(**SIZE | warm, turbulence=Turbulence(local=False), film=MapFilm())
    at = rf.equilibrium(large, (0.0, -3e5), 314.0)
    assert asked["built_table"] <= 1
    assert asked["losses"] <= 12
    film = large.at_temperature(at.temperature)
    assert_allclose(film.force(at.position, (0.0, 0.0), 314.0), [0.0, 3e5], atol=0.01)
    assert large.balanced_temperature(at.position, (0.0, 0.0), 314.0) == pytest.approx(
        at.temperature, abs=1e-8
    )


def test_losses_are_those_of_the_grid_and_above_laminar_ones(bearing):
    found = bearing.losses(PLACE, np.zeros(2), SPEED)
    wanted = grid().losses(PLACE, np.zeros(2), SPEED)
    assert found.power_loss == pytest.approx(wanted.power_loss, rel=5e-3)
    laminar = rf.JournalBearing(**SIZE, film=ReynoldsFilm()).losses(PLACE, np.zeros(2), SPEED)
    assert found.power_loss > 1.5 * laminar.power_loss


def test_the_table_knows_its_errors_and_its_mobility(bearing):
    table = bearing.film.table
    assert table.bound(0.4, slopes=False) < 5e-3
    assert MobileMapTable.from_bytes(table.to_bytes()) == table
    other = replace(TURBULENT, scale=31.0)
    with pytest.raises(InputError, match="mobility must be the one that the table was made with"):
        replace(bearing.film, mobility=other)


def test_states_beyond_the_map_warn(bearing):
    with pytest.warns(ValidityWarning, match="beyond the map"):
        bearing.force([0.0, -4.5e-4], [0.0, 0.0], SPEED)
    with pytest.warns(ValidityWarning, match="beyond the map"):
        bearing.force(PLACE, VELOCITY, 2000.0)


def test_impossible_films_are_refused():
    with pytest.raises(InputError, match="must have a density"):
        MobileMapFilm(mobility=mobility_of(ng_pan))
    with pytest.raises(InputError, match="nodes must be three numbers"):
        MobileMapFilm(mobility=TURBULENT, nodes=(4, 12, 6))
    with pytest.raises(InputError, match="represent the bearing's geometry"):
        rf.JournalBearing(**SIZE, film=FILM, grooves=(rf.Groove(center=0.0, width=0.3),))
    one_number = rf.JournalBearing(
        **SIZE | {"length": 0.05}, turbulence=Turbulence(local=False), film=MapFilm()
    )
    with pytest.raises(InputError, match=r"length/diameter must give laminar films of 0\.1 to 4"):
        one_number.force(PLACE, np.zeros(2), SPEED)
    with pytest.raises(InputError, match="must belong to a bearing"):
        FILM.force(np.array([0.1, 0.2]), np.array([1.0, 0.0]), 0.8)


INPUTS = ("x", "y", "vx", "vy", "speed")


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_native_fmus_have_the_forces_of_python_to_the_last_bit(bearing, version, tmp_path):
    """Among them at a clearance and a viscosity of their own, which change the Reynolds number."""
    path = rf.export_fmu(bearing, tmp_path / "turbulent.fmu", version, component="b", start={"speed": 100.0})
    assert bearing.native().kernel == "turbulent_journal"
    names = zipfile.ZipFile(path).namelist()
    assert not any(name.endswith(".py") for name in names)
    random = np.random.default_rng(3)
    with extracted(path) as (description, folder):
        places = {v.name.removeprefix("b."): v.valueReference for v in description.modelVariables}
        instance = instantiated(description, folder, False)
        instance.initialize([places[name] for name in INPUTS], [0.0, -1e-4, 0.0, 0.0, SPEED])
        for step, sizes in enumerate(({}, {"clearance": 6e-4, "viscosity": 0.03})):
            instance.set([places[name] for name in sizes], list(sizes.values()))
            own = replace(bearing, **sizes)
            for k in range(6):
                x, y = random.uniform(-2e-4, 2e-4, 2)
                u = [x, y, *random.normal(scale=0.01, size=2), random.uniform(-400.0, 400.0)]
                instance.set([places[name] for name in INPUTS], u)
                instance.step(0.01 * (6 * step + k), 0.01)
                found = instance.get([places["force_x"], places["force_y"]])
                assert list(found) == own.output(0.0, (), np.array(u)).tolist()
        instance.close()


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_native_fmus_pass_all_checks_and_know_their_length(bearing, version, tmp_path, capsys):
    start = {"speed": SPEED, "y": -1e-4}
    path = rf.export_fmu(bearing, tmp_path / "turbulent.fmu", version, component="b", start=start)
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    with pytest.raises(fmpy.fmi1.FMICallException, match="ExitInitializationMode"):
        fmpy.simulate_fmu(str(path), start_values={"b.length": 0.5}, stop_time=0.01)
    assert "length/diameter must be that of the map of the film, 0.8, got 1" in capsys.readouterr().out


def test_a_rotor_on_the_map_is_one_kernel_and_runs_as_in_python(bearing, tmp_path):
    rotor = rf.RigidRotor(mass=3e4, speed=SPEED, gravity=(0.0, -9.80665), position=(1e-4, -2e-4))
    system = rf.mount(rotor, {"": bearing})
    assert system.native().kernel == "rotor_system"
    path = rf.export_fmu(system, tmp_path / "system.fmu", "2.0", stop_time=0.02, step_size=0.002)
    told = fmpy.simulate_fmu(str(path), stop_time=0.02, step_size=0.002, output_interval=0.002)
    run = rf.simulate(rotor, bearing, duration=0.02, samples=11, rtol=1e-10)
    name = next(name for name in told.dtype.names if name == "x" or name.endswith(".x"))
    assert_allclose(told[name], run["x"], rtol=1e-5)
