"""Dampers with a supply in scenes: the film that conserves its oil, and what it says of the plain ones."""

import dataclasses

import numpy as np
import pytest
from scipy.optimize import brentq

from rotorfilm import InputError, JFODamper, SceneError, simulate
from rotorfilm.bearings import damper_turn
from rotorfilm.bearings.damper.questions import LEVELS, follow, of_turn
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import read_scene, run_damper

SUPPLY = {
    "supply_pressure": "0.5 bar",
    "circumferential_groove": "2 mm",
    "cavitation_pressure": "-0.2 bar",
    "submerged": True,
}
DAMPER = {
    "diameter": "100 mm",
    "length": "27 mm",
    "clearance": "0.1 mm",
    "viscosity": "8 mPa s",
    "stiffness": "1 MN/m",
    "supply": SUPPLY,
}


def scene(quantity="transmissibility", unbalance="1000 g mm", tolerance="1 %", **tables):
    data = {
        "schema": 1,
        "damper": DAMPER,
        "operation": {"speed": "3000 rpm"},
        "rigid_rotor": {"mass": "20 kg", "unbalance": unbalance},
        "question": {"quantity": quantity, "tolerance": tolerance},
        **tables,
    }
    return read_scene(data, "drawn")


def finest(of):
    """Return orbit radius [m] and transmissibility on a fine grid, by bisection."""
    table, speed = of.damper, of.speed
    fine = dataclasses.replace(table.conserved(table.supply), cells=(144, 32))
    m, c = of.rigid_rotor.mass, table.clearance

    def pull(eps):
        x = eps * c
        force = fine.force([x, 0.0], [0.0, speed * x], speed)
        return np.hypot(m * speed**2 * x + force[0], force[1]), np.hypot(*force)

    wanted = of.rigid_rotor.unbalance * speed**2
    eps = brentq(lambda at: pull(at)[0] - wanted, 0.05, 0.9, xtol=1e-7)
    return eps * c, pull(eps)[1] / wanted


@pytest.fixture(scope="module")
def asked():
    return scene()


@pytest.mark.convergence
def test_conserved_oil_answers_and_judges_the_plain_films(asked):
    answer = asked.solve()
    _, truth = finest(asked)
    assert answer.model == "conserved oil"
    assert answer.met
    assert answer.value == pytest.approx(truth, rel=3e-3)
    plain = [rung for rung in answer.rungs if rung.name.startswith(("short", "finite"))]
    assert len(plain) == 1
    # A film that ruptures whatever its supply damps half as much here, and its estimate says so.
    true_error = abs(plain[0].value / truth - 1.0)
    assert true_error > 0.5
    assert 0.5 * true_error < plain[0].error_estimate < 2.0 * true_error


def test_a_named_plain_film_is_answered_with_its_error():
    named = {**DAMPER, "film": {"name": "short"}}
    answer = scene(damper=named, quantity="unbalance_amplitude").ask()
    truth, _ = finest(scene())
    assert not answer.met
    true_error = abs(answer.value / truth - 1.0)
    assert 0.5 * true_error < answer.error_estimate < 2.0 * true_error


@pytest.mark.closed_form
def test_two_lands_are_one_in_oil_twice_as_viscous(asked):
    plain = asked.damper.build()
    assert plain.length == pytest.approx(0.0125)
    assert plain.viscosity == pytest.approx(16e-3)
    whole = asked.damper.support()
    assert isinstance(whole, JFODamper)
    # Where the film is full and short both damp alike, short films beyond by their known error.
    full = dataclasses.replace(
        whole, supply=dataclasses.replace(whole.supply, supply_pressure=5e6), stiffness=0.0
    )
    eps, speed = 0.2, 100.0
    orbit = full.orbit(eps, speed)
    half = plain.force([eps * 1e-4, 0.0], [0.0, eps * 1e-4 * speed], 0.0)[1]
    assert orbit.tangential_force == pytest.approx(2.0 * half, rel=0.06)


def test_a_run_conserves_its_oil():
    lost = {"kind": "blade_loss", "unbalance": "1000 g mm", "revolutions": 1}
    run = run_damper(scene(excitation=lost, rigid_rotor={"mass": "20 kg"}))
    signals = run.trajectory.signals
    # From rest in a full film, what the supply gives in excess of the outflow is what the film holds more.
    stored = signals["oil_volume"] - signals["oil_volume"][0]
    net = signals["inflow"] + signals["drawn_in"] - signals["side_flow"]
    dt = np.diff(run.trajectory.time)
    carried = np.concatenate([[0.0], np.cumsum(0.5 * (net[1:] + net[:-1]) * dt)])
    assert np.abs(stored).max() > 1e-9
    np.testing.assert_allclose(stored, carried, atol=0.02 * np.abs(stored).max())
    assert run.contact_time is None
    assert 0.1 < run.peak_eccentricity_ratio < 0.7


LOST = {"kind": "blade_loss", "unbalance": "1000 g mm", "revolutions": 2}
HOLES = {
    "supply_pressure": "5 bar",
    "feed_holes": [{"center": f"{at} deg", "diameter": "4 mm"} for at in (0, 120, 240)],
}


@pytest.mark.convergence
@pytest.mark.filterwarnings("ignore:left out. inertia of the film")
def test_peak_after_a_lost_blade_is_within_its_estimate():
    damper = {**DAMPER, "supply": HOLES}
    peak = scene(
        quantity="peak_displacement",
        damper=damper,
        excitation=LOST,
        rigid_rotor={"mass": "20 kg"},
        tolerance="12 %",
    )
    answer = peak.ask()
    assert answer.met
    assert answer.model == "conserved oil 32 x 8, 48 steps"
    models = damper_models(peak)
    fine = dataclasses.replace(models.support, cells=(72, 16))
    dt = 2.0 * np.pi / peak.speed / 128
    run = simulate(models.rotor, fine, duration=models.duration, samples=513, max_step=dt)
    truth = np.hypot(*run.position).max()
    assert abs(answer.value / truth - 1.0) < answer.error_estimate < 0.08


@pytest.mark.closed_form
def test_orbit_past_holes_balances_the_film_that_is_stepped_along_it():
    """m q'' = F + u omega^2 (cos, sin) in its first harmonic, F by `damper_turn` on the orbit itself."""
    asked = scene("unbalance_amplitude", unbalance="300 g mm", damper={**DAMPER, "supply": HOLES})
    rung, speed, models = ladder_of(asked).rungs[0], asked.speed, damper_models(asked)
    cells, steps = LEVELS[0]
    damper = dataclasses.replace(models.support, cells=cells)
    run = follow(damper, models.rotor, steps, 12 * 2.0 * np.pi / speed)
    q = run.position[:, -48:]
    film = dataclasses.replace(damper, stiffness=0.0)
    force = damper_turn(film, q, speed).force - 1e6 * q
    wave = np.exp(-2j * np.pi * np.arange(1, 49) / 48)
    place, pull = (both[0] + 1j * both[1] for both in (q, force))
    balance = 20.0 * speed**2 * np.mean(place * wave) + np.mean(pull * wave)
    assert abs(balance + 3e-4 * speed**2) < 0.02 * 3e-4 * speed**2
    assert rung.answer(None).value == pytest.approx(np.abs(place - place.mean()).max(), rel=2e-3)
    both = sum(abs(np.mean(pull * one)) for one in (wave, wave.conj()))
    transmitted = of_turn(run, steps, models.rotor, "transmissibility", 1)
    assert transmitted == pytest.approx(both / (3e-4 * speed**2), rel=0.02)


def test_what_knows_no_supply_says_so():
    named = {**DAMPER, "film": {"name": "short"}}
    peak = scene("peak_displacement", excitation=LOST, rigid_rotor={"mass": "20 kg"}, damper=named)
    with pytest.raises(InputError, match=r"damper.film must not be given with supply for peak_displacement"):
        peak.solve()
    with pytest.raises(InputError, match=r"damper.supply must be left out for cosimulation_error"):
        scene(quantity="cosimulation_error").solve()
    with pytest.raises(InputError, match=r"supply.feed_holes must be left out for a question about jumps"):
        scene("jump_up", damper={**DAMPER, "supply": HOLES}).solve()
    for wrong, said in (
        ({"supply": {}}, "supply_pressure above cavitation_pressure"),
        ({"extent": {"kind": "full"}}, "extent must be left out beside supply"),
        ({"supply": {**SUPPLY, "circumferential_groove": "27 mm"}}, "circumferential_groove must be below"),
    ):
        with pytest.raises(SceneError, match=said):
            scene(damper={**DAMPER, **wrong})
