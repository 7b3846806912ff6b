"""SI-exp3 and the other schemes through real native FMUs in fmpy."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, JournalBearing, PartialResultError
from rotorfilm.analysis import simulate
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.cosim import GaussSeidel, InProcessSlave, Newton, SIExp3, SIMemory, cosimulate, couple
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import JeffcottRotor, LawRotor, RigidRotor, RigidShaft, SpeedProfile, SteadyRotor

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.CouplingWarning")

SPEED, CLEARANCE = 157.0, 1e-4
BEARING = JournalBearing(radius=0.05, length=0.05, clearance=CLEARANCE, viscosity=0.05, film=MapFilm())


def rotor_at(eccentricity, unbalance):
    load = -BEARING.force((eccentricity * CLEARANCE, 0.0), (0.0, 0.0), SPEED)
    mass = float(np.hypot(*load)) / (CLEARANCE * SPEED**2)
    return RigidRotor(
        mass=mass,
        speed=SPEED,
        unbalance=unbalance * CLEARANCE * mass,
        gravity=(0.0, 0.0),
        static_force=tuple(load),
        position=(eccentricity * CLEARANCE, 0.0),
    )


def exported(folder, rotor, film, version="2.0"):
    return [
        export_fmu(model, folder / f"{name}.fmu", version, component=name)
        for name, model in {"rotor": rotor, "film": film}.items()
    ]


def error_of(run, rotor, film):
    own = run.trajectory
    exact = simulate(rotor, film, duration=own.time[-1], times=own.time, rtol=1e-10)
    largest = np.hypot(*exact.position).max() / CLEARANCE
    return np.hypot(*(own.position - exact.position)).max() / CLEARANCE, largest


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("wrap", [lambda r: r, lambda r: LawRotor(rotor=r)], ids=["exchange", "laws"])
def test_si_exp3_is_stable_at_5_degrees_to_eccentricity_ratio_95(version, wrap, tmp_path):
    rotor = rotor_at(0.9, 0.3)
    paths = exported(tmp_path, wrap(rotor), BEARING, version)
    step = np.radians(5.0) / SPEED
    run = cosimulate(*paths, macro_step=step, duration=144 * step, scheme=SIExp3())
    error, largest = error_of(run, rotor, BEARING)
    assert 0.94 < largest < 0.96
    assert error <= 2e-4
    work = run.trajectory.work
    assert work == {
        "steps": 144, "film_evaluations": 145, "film_jacobians": 145, "rotor_steps": 144, "rollbacks": 0
    }  # fmt: skip
    assert run.watch.explicit_ratio > 4.0


def light_rotor():
    """Return a rotor whose journal has .5 % of the mass, from static equilibrium at eccentricity ratio .7."""
    rest = np.array([0.7 * CLEARANCE, 0.0])
    load = -BEARING.force(rest, (0.0, 0.0), SPEED)
    size = float(np.hypot(*load))
    mass, stiffness = size / (CLEARANCE * SPEED**2), 4.0 * size / CLEARANCE
    disk = rest + 0.995 * load / stiffness
    return JeffcottRotor(
        mass=0.995 * mass,
        journal_mass=0.005 * mass,
        stiffness=stiffness,
        speed=SPEED,
        unbalance=0.2 * CLEARANCE * mass,
        gravity=tuple(load / mass),
        initial=(disk[0], rest[0], disk[1], rest[1], 0.0, 0.0, 0.0, 0.0),
    )


def test_a_light_journal_station_at_1_degree(tmp_path):
    rotor = light_rotor()
    paths = exported(tmp_path, SteadyRotor(rotor=rotor), BEARING)
    step = np.radians(1.0) / SPEED
    run = cosimulate(*paths, macro_step=step, duration=360 * step, scheme=SIExp3())
    error, largest = error_of(run, rotor, BEARING)
    assert largest > 0.7
    assert error < 1e-5
    assert run.watch.explicit_ratio > 40.0
    with pytest.raises(PartialResultError, match=r"macro_step must be|macro step of"):
        cosimulate(*paths, macro_step=step, duration=360 * step)


def test_newton_goes_back_with_fmu_states(tmp_path):
    rotor = rotor_at(0.7, 0.3)
    paths = exported(tmp_path, rotor, BEARING)
    step = np.radians(5.0) / SPEED
    run = cosimulate(*paths, macro_step=step, duration=72 * step, scheme=Newton())
    assert run.trajectory.work["rollbacks"] > 72
    direct = couple(
        InProcessSlave(rotor), InProcessSlave(BEARING), macro_step=step, duration=72 * step, scheme=Newton()
    )
    assert_allclose(run.trajectory.position, direct.trajectory.position, atol=1e-6 * CLEARANCE)
    assert error_of(run, rotor, BEARING)[0] < 5e-3


@pytest.mark.parametrize("scheme", [GaussSeidel(degree=2), SIExp3()], ids=lambda s: s.label)
def test_an_exchange_rotor_passes_its_kinks(scheme, tmp_path):
    rotor = replace(
        rotor_at(0.6, 0.2), speed=SpeedProfile(times=(0.0, 0.0071, 0.02), speeds=(140.0, 157.0, 120.0))
    )
    paths = exported(tmp_path, rotor, BEARING)
    arguments = {"macro_step": 1e-4, "duration": 0.03, "scheme": scheme}
    run = cosimulate(*paths, **arguments)
    direct = cosimulate(rotor, BEARING, **arguments)
    for name in ("x", "y", "speed"):
        scale = np.abs(direct.trajectory[name]).max()
        assert_allclose(run.trajectory[name], direct.trajectory[name], atol=1e-8 * scale)
    assert error_of(run, rotor, BEARING)[0] < 1e-4


def test_two_film_fmus_on_one_rotor_fmu(tmp_path):
    shaft = RigidShaft(
        mass=60.0,
        diametral_inertia=4.0,
        polar_inertia=0.6,
        speed=SPEED,
        unbalances=((0.1, 1.5e-3, 0.0),),
        stations=(("left", -0.4), ("right", 0.3)),
    )
    films = {"left": BEARING, "right": replace(BEARING, length=0.03)}
    rotor = export_fmu(SteadyRotor(rotor=shaft), tmp_path / "rotor.fmu")
    paths = {name: export_fmu(film, tmp_path / f"{name}.fmu") for name, film in films.items()}
    arguments = {"macro_step": np.radians(3.0) / SPEED, "duration": 2 * np.pi / SPEED}
    for scheme, limit in ((SIExp3(), 1e-7), (SIMemory(), 1e-7), (Newton(), 1e-6)):
        run = cosimulate(rotor, paths, scheme=scheme, **arguments).trajectory
        direct = cosimulate(shaft, films, scheme=scheme, **arguments).trajectory
        assert run.work["film_evaluations"] == direct.work["film_evaluations"]
        for name in ("left_x", "right_y", "left_force_x", "right_force_y"):
            assert_allclose(run[name], direct[name], atol=limit * np.abs(direct[name]).max())


def test_a_rotor_in_python_cannot_take_laws_unless_asked(tmp_path):
    rotor = rotor_at(0.5, 0.1)
    arguments = {"macro_step": np.radians(5.0) / SPEED, "duration": 20 * np.radians(5.0) / SPEED}
    film = export_fmu(BEARING, tmp_path / "film.fmu")
    plain = export_fmu(rotor, tmp_path / "plain.fmu", backend="python")
    with pytest.raises(InputError, match="rotor must take force laws for this scheme"):
        cosimulate(plain, film, **arguments, scheme=SIExp3())
    asked = export_fmu(LawRotor(rotor=rotor), tmp_path / "asked.fmu", backend="python")
    run = cosimulate(asked, film, **arguments, scheme=SIExp3())
    assert error_of(run, rotor, BEARING)[0] < 2e-4
