"""Questions about dampers: a peak after a lost blade or over a run-up, jumps, what films leave out."""

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import scene_battery
from families import FAMILIES
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import (
    FilmContactError,
    FiniteMapSqueeze,
    FiniteSqueeze,
    FullFilm,
    InputError,
    PorousCage,
    PorousDamper,
    RadialFeed,
    ShortSqueeze,
    ValidityWarning,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.bearings import MapSqueeze
from rotorfilm.bearings.damper.candidates import (
    damper_films,
    damper_numbers,
    damper_remarks,
    largest_pressure,
)
from rotorfilm.bearings.damper.questions import _endless, damper_ladder
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.cli.answer_printing import print_question
from rotorfilm.core import AbsentError, prepared_tangent
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import Lubricant, QuestionTable, parse_scene, read_scene, run_damper

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

SCENE = """
schema = 1
[damper]
diameter = "100 mm"
length = "20 mm"
clearance = "0.12 mm"
viscosity = "5 mPa s"
stiffness = "1 MN/m"
[operation]
speed = "3000 rpm"
[rigid_rotor]
mass = "20 kg"
[excitation]
kind = "blade_loss"
unbalance = "800 g mm"
revolutions = 5
[question]
quantity = "peak_displacement"
tolerance = "1 %"
"""
FULL = 'extent = {kind = "full"}\n'
JUMPS = """
schema = 1
[damper]
diameter = "100 mm"
length = "25 mm"
clearance = "0.1 mm"
viscosity = "4.096e-4 Pa s"
stiffness = "2.56e5 N/m"
[operation]
speed = "400 rad/s"
[rigid_rotor]
mass = "10 kg"
"""
SUBSET = [
    ("damper blade loss", 6),
    pytest.param("damper blade loss", 8, marks=pytest.mark.long),
    pytest.param("damper blade loss", 26, marks=pytest.mark.long),
    ("damper jumps", 6),
    ("built damper", 6),
    pytest.param("built damper", 38, marks=pytest.mark.long),
]
"""Families and seeds of the battery's scenes that run here; benchmarks/scene_battery.py runs hundreds."""


def scene(more="", text=SCENE):
    return parse_scene(text.replace("[operation]", f"{more}[operation]"), "case.toml")


def asked(found, quantity, tolerance):
    return replace(found, question=QuestionTable(quantity=quantity, tolerance=tolerance))


def with_loss(found, unbalance):
    return replace(found, excitation=replace(found.excitation, unbalance=unbalance))


@pytest.mark.parametrize(("family", "seed"), SUBSET)
def test_estimate_is_within_a_factor_of_two_and_the_tolerance_is_met(family, seed):
    drawn = FAMILIES[family][1](np.random.default_rng(seed))
    first, *_ = scene_battery.judge(seed, drawn)
    assert not first.doubtful
    assert first.right, first
    if first.verdict == "chosen":
        assert first.met, first


def textbook(found, steps):
    """Return the largest distance / clearance by the short solid film in polar axes, by scipy."""
    d, rotor = found.damper, damper_models(found).rotor
    scale = d.viscosity * d.radius * d.length**3 / d.clearance**2

    def rates(t, y):
        q, v = y[:2] / d.clearance, y[2:] / d.clearance
        eps = math.hypot(*q)
        out = q / eps if eps else np.array([1.0, 0.0])
        turned = np.array([-out[1], out[0]])
        radial = -math.pi * (1.0 + 2.0 * eps**2) / (1.0 - eps**2) ** 2.5 * (v @ out)
        tangential = -math.pi / (1.0 - eps**2) ** 1.5 * (v @ turned)
        turn = rotor.unbalance * 314.1592653589793**2
        pull = turn * np.array([math.cos(314.1592653589793 * t), math.sin(314.1592653589793 * t)])
        force = scale * (radial * out + tangential * turned) - d.stiffness * y[:2] + pull
        return np.concatenate([y[2:], force / rotor.mass])

    end = damper_models(found).duration
    times = np.linspace(0.0, end, steps)
    run = solve_ivp(rates, (0.0, end), np.zeros(4), "DOP853", times, rtol=1e-9, atol=1e-15)
    return float(np.hypot(*run.y[:2]).max()) / d.clearance


@pytest.mark.closed_form
def test_steps_converge_on_the_textbook_film_with_their_order():
    found = scene(FULL + 'film = {name = "short"}\n')
    exact = textbook(found, 20001)
    rungs = {rung.steps: rung for rung in ladder_of(found).rungs}
    errors = [rungs[n].answer(None).value / found.damper.clearance / exact - 1.0 for n in (48, 96, 192)]
    assert abs(errors[-1]) < 3e-4
    for coarse, fine in pairwise(errors):
        assert math.log2(coarse / fine) == pytest.approx(2.0, abs=0.15)


@pytest.mark.closed_form
@pytest.mark.parametrize(("extent", "part"), [(FULL, 1.0), ("", 0.5)], ids=["full", "cavitated"])
def test_linear_motion_is_that_of_small_motion(extent, part):
    # half of the circumference damps half as much, since at the center the film is equally thick all round
    found = with_loss(scene(extent + 'film = {name = "short"}\n'), 1e-8)
    d = found.damper
    C = part * math.pi * d.viscosity * d.radius * d.length**3 / d.clearance**3
    m, K, w = 20.0, d.stiffness, found.speed
    roots = np.roots([m, C, K])
    t = np.linspace(0.0, 5.0 * 2.0 * math.pi / w, 40001)
    whole = 1e-8 * w**2 / (K - m * w**2 + 1j * C * w)
    # z(0) = z'(0) = 0
    a = np.linalg.solve([[1.0, 1.0], roots], [-whole, -1j * w * whole])
    z = whole * np.exp(1j * w * t) + a @ np.exp(roots[:, None] * t)
    linear = ladder_of(found).rungs[0]
    assert linear.name == "linear, small motion"
    assert linear.answer(None).value == pytest.approx(np.abs(z).max(), rel=5e-4)


def test_a_lost_blade_is_answered_as_it_runs():
    found = scene(FULL)
    answer = asked(found, "peak_displacement", 3e-3).ask()
    assert answer.met
    assert answer.model.startswith("nonlinear")
    finite = found.with_tables(damper=replace(found.damper, film=FiniteSqueeze()))
    with pytest.raises(InputError, match="blade_loss"):
        asked(replace(found, excitation=None), "peak_displacement", 0.1).ask()
    models = damper_models(finite)
    damper, springs = models.support.reactions
    film = replace(damper, film=FiniteMapSqueeze())
    run = simulate_peak(models, with_springs(film, springs.stiffness))
    assert answer.value == pytest.approx(run, rel=1.5 * answer.error_estimate + 1e-4)


def simulate_peak(models, support):
    from rotorfilm.analysis import simulate

    run = simulate(models.rotor, support, duration=models.duration, samples=4001, rtol=1e-8)
    return float(np.hypot(*run.position).max())


def test_run_up_is_answered_as_it_runs():
    text = SCENE.replace('kind = "blade_loss"', 'kind = "run_up"').replace(
        "revolutions = 5", 'end_speed = "4000 rpm"\nduration = "0.1 s"\nback = true'
    )
    found = scene(FULL + 'film = {name = "map"}\n', text)
    found = with_loss(found, 3e-4)
    top = next(rung for rung in ladder_of(found).rungs if rung.steps == 192)
    run = run_damper(found)
    expected = run.peak_eccentricity_ratio * found.damper.clearance
    assert top.answer(None).value == pytest.approx(expected, rel=1e-3)


def test_contact_is_no_number_but_a_statement():
    cage = 'cage = {thickness = "3 mm", permeability = "5 um2"}\n'
    hit = with_loss(scene(FULL + cage), 4e-3)
    with pytest.raises(FilmContactError, match=r"stay inside the clearance, got to the wall at 0\.0\d+ s"):
        hit.ask()
    # a film that ends before the wall says so
    thin = scene(FULL, SCENE.replace("5 mPa s", "0.2 mPa s"))
    solid = asked(with_loss(thin, 1e-2), "peak_displacement", 0.5).ask()
    assert not solid.met
    assert solid.message.startswith("no model can be trusted; the closest may be nonlinear, 768 steps")
    assert (
        "it may touch the wall" in solid.rungs[-1].reason or "leave the clearance" in solid.rungs[-1].reason
    )


def test_tighter_tolerance_never_selects_a_less_accurate_rung_and_none_is_met_by_magic():
    found = scene(FULL)
    names = [rung.name for rung in ladder_of(found).rungs]
    answers = [asked(found, "peak_displacement", tolerance).ask() for tolerance in (0.3, 0.02, 2e-3, 1e-9)]
    estimates = [answer.error_estimate for answer in answers]
    assert all(tight <= loose * (1.0 + 1e-9) for loose, tight in pairwise(estimates))
    places = [names.index(answer.model) for answer in answers]
    assert places == sorted(places)
    assert [answer.met for answer in answers] == [True, True, True, False]
    assert answers[-1].model == "nonlinear, 768 steps, finite film"


def test_defect_along_the_motion_tells_the_richer_film_with_its_sign():
    rungs = {rung.name: rung for rung in ladder_of(scene(FULL)).rungs}
    short, finite = (rungs[f"nonlinear, 192 steps, {film} film"] for film in ("short", "finite"))
    found = short.answer(None)
    change, doubt, _ = short._by_defect(found.solution[0], found.value, short.rich)
    assert not doubt
    # less damping, so that the rotor goes farther
    assert change > 5e-3
    assert change == pytest.approx(finite.answer(None).value / found.value - 1.0, rel=0.05)


def test_named_film_is_the_only_one_that_answers():
    answer = scene(FULL + 'film = {name = "short"}\n').ask()
    assert all(report.name.endswith(("ShortSqueeze", "small motion")) for report in answer.rungs)


def test_cavitated_film_with_feed_has_a_value_and_no_estimate():
    feed = 'feed = {kind = "radial", inflow = 0.001}\n'
    short = scene(feed, SCENE.replace("revolutions = 5", "revolutions = 0.3"))
    answer = short.ask()
    assert not answer.met
    assert answer.value > 0.0
    assert all(report.doubtful and "with feed" in report.reason for report in answer.rungs)


@pytest.mark.parametrize(
    ("changes", "fed"),
    [
        ({}, False),
        ({"feed": RadialFeed(inflow=0.01)}, True),
        ({"cage": PorousCage(thickness=2e-3, permeability=1e-13, vented=True)}, False),
        ({"cage": PorousCage(thickness=2e-3, permeability=1e-13, vented=True, supply_pressure=1e5)}, True),
    ],
)
def test_what_counts_as_fed(changes, fed):
    damper = PorousDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=1e-3, **changes)
    assert damper.is_fed is fed


def test_fed_full_film_has_the_film_of_finite_length_above_it():
    feed = RadialFeed(inflow=0.002)
    text = JUMPS.replace("[rigid_rotor]", "[rigid_rotor]\nunbalance = 2e-4")
    found = scene(FULL, text)
    fed = asked(found.with_tables(damper=replace(found.damper, feed=feed)), "unbalance_amplitude", 1e-2)
    answer = fed.ask()
    assert answer.met
    assert [report.name for report in answer.rungs] == ["short film", "finite film"]


@pytest.mark.parametrize("film", [MapSqueeze(), ShortSqueeze()])
def test_tangent_of_a_sprung_damper_is_its_force_and_jacobian(film):
    damper = PorousDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=1e-3, film=film)
    support = with_springs(damper, 3e5)
    state = np.array([3e-5, -2e-5]), np.array([1e-3, 4e-3])
    x, y, slopes = prepared_tangent(support)(*state[0], *state[1], 100.0)
    assert_allclose((x, y), support.force(*state, 100.0), rtol=1e-12)
    assert_allclose(np.reshape(slopes, (2, 5)), support.jacobian(*state, 100.0), rtol=1e-9, atol=1e-9)


def test_jump_that_is_not_there_is_said_so():
    full = asked(scene(FULL, JUMPS), "jump_up", 0.1)
    with pytest.raises(AbsentError, match="no jump up of the rotor in the damper: one orbit at every unb"):
        full.ask()
    # the solid film would jump, the one with the layer does not
    cage = 'cage = {thickness = "2.5 mm", permeability = "40 um2", thin = true}\nfilm = {name = "short"}\n'
    with pytest.raises(AbsentError, match="no jump down"):
        asked(scene(cage, JUMPS), "jump_down", 0.1).ask()


@pytest.mark.long
def test_no_jump_is_made_up_beyond_the_reach_of_a_map():
    drawn = FAMILIES["damper jumps"][1]
    random = np.random.default_rng(103)
    found = [read_scene(drawn(random).data, "drawn") for _ in range(2)][1]
    assert found.damper.film is not None
    with pytest.raises(AbsentError, match=r"no orbit ends so, up to 0\.985 of the clearance"):
        found.ask()


@pytest.mark.long
@pytest.mark.literature
def test_jumps_of_the_solid_film_are_those_of_the_notes():
    found = scene('film = {name = "short"}\n', JUMPS)
    up, down = (asked(found, quantity, 0.5).ask() for quantity in ("jump_up", "jump_down"))
    assert up.value == pytest.approx(0.3931e-3, abs=5e-8)
    assert down.value == pytest.approx(0.3617e-3, abs=5e-8)


def test_smallest_stable_orbit_answers_where_there_are_several():
    text = JUMPS.replace("[rigid_rotor]", "[rigid_rotor]\nunbalance = 3.75e-4")
    found = asked(scene('film = {name = "short"}\n', text), "unbalance_amplitude", 0.5)
    answer = found.ask()
    models = damper_models(found)
    orbits = synchronous_orbits(models.rotor, models.support).at(3.75e-4)
    assert [orbit.stable for orbit in orbits] == [True, False, True]
    assert answer.value == pytest.approx(orbits[0].eccentricity_ratio * 1e-4)
    assert any(remark.startswith("3 orbits at this unbalance") for remark in answer.remarks)


OIL = Lubricant(density=900.0, heat_capacity=2000.0, conductivity=0.15, thinning=0.04)
BARE = PorousDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=0.005, extent=FullFilm())


@pytest.mark.closed_form
def test_inertia_is_that_of_an_oscillating_flow_between_walls():
    # mean velocity 1: pressure gradient i Re/(1 - tanh(k)/k), k^2 = i Re/4, in viscosity/h^2; 12 as Re -> 0
    for reynolds in (0.1, 0.5):
        k = np.sqrt(0.25j * reynolds)
        exact = 1j * reynolds / (1.0 - np.tanh(k) / k)
        assert exact.imag / exact.real == pytest.approx(reynolds / 10.0, rel=1e-3)
    n = damper_numbers(BARE, OIL, 20.0, 300.0, 0.01)
    assert n["inertia"] == pytest.approx(300.0 * 1e-8 * 900.0 / 0.005 / 10.0)
    # the film that moves along has the mass pi density radius length^3/(10 clearance)
    mass = math.pi * 900.0 * 0.05 * 0.02**3 / (10.0 * 1e-4)
    assert n["added_mass"] == pytest.approx(mass / 20.0, rel=1e-3)


@pytest.mark.closed_form
def test_largest_pressure_is_that_of_the_short_film():
    eps, w = 0.6, 300.0
    # where eps sin/(1 + eps cos)^3 is largest
    cos = (1.0 - math.sqrt(1.0 + 24.0 * eps**2)) / (4.0 * eps)
    largest = eps * math.sqrt(1.0 - cos**2) / (1.0 + eps * cos) ** 3
    assert largest_pressure(BARE, w, eps) == pytest.approx(
        1.5 * 0.005 * (0.02 / 1e-4) ** 2 * w * largest, rel=1e-4
    )


def test_heat_is_the_power_of_the_film():
    n = damper_numbers(BARE, OIL, 20.0, 300.0, 0.5)
    force = math.pi * 0.005 * 0.05 * 0.02**3 / 1e-12 * 300.0 * 0.5e-4 / 0.75**1.5
    flow = 2.0 * 0.05 * 0.02 * 0.5e-4 * 300.0
    assert n["peclet"] == pytest.approx(300.0 * 1e-8 * 1.8e6 / 0.15)
    assert n["warming"] == pytest.approx(force * 300.0 * 0.5e-4 / (1.8e6 * flow), rel=1e-6)
    slow = damper_numbers(BARE, OIL, 20.0, 2.0, 0.5)
    volume = 2.0 * math.pi * 0.05 * 0.02 * 1e-4
    power = force * (2.0 / 300.0) ** 2 * 300.0 * 0.5e-4
    conducted = power / volume * 1e-8 / (8.0 * 0.15)
    assert slow["warming"] == pytest.approx(min(conducted, n["warming"] * 2.0 / 300.0))


def test_remarks_name_what_is_left_out():
    def topics(damper, mass, speed, eps):
        return {line.partition(":")[0] for line in damper_remarks(damper, OIL, mass, speed, eps)}

    pi = replace(BARE, extent=PorousDamper(radius=1.0, length=1.0, clearance=0.1, viscosity=1.0).extent)
    assert topics(pi, 20.0, 300.0, 0.3) == set()
    assert topics(pi, 20.0, 300.0, 0.02) == {"cavitation"}  # nearly no pressure: it may not rupture
    assert topics(BARE, 20.0, 300.0, 0.8) >= {"cavitation"}  # tension
    assert topics(replace(pi, viscosity=1e-4), 20.0, 300.0, 0.3) >= {"inertia of the film"}
    assert topics(replace(pi, viscosity=0.5), 20.0, 3000.0, 0.9) >= {"heat", "compressibility", "cavitation"}


@pytest.mark.long
def test_shipped_scene_meets_its_tolerance_without_a_warning():
    from rotorfilm.scenes import Scene

    answer = Scene.load(ROOT / "examples" / "damper_question.toml").ask()
    assert answer.met
    assert not answer.remarks


@pytest.mark.long
def test_a_short_film_warns_where_it_runs_not_where_a_ladder_answers(recwarn):
    text = JUMPS.replace('length = "25 mm"', 'length = "40 mm"')
    slender = parse_scene(f"{text}unbalance = 1e-4\n", "case.toml")
    assert asked(slender, "unbalance_amplitude", 0.5).ask().rungs[0].name == "short film"
    assert not [one for one in recwarn if "length / diameter" in str(one.message)]
    with pytest.warns(ValidityWarning, match="length / diameter must not exceed"):
        slender.damper.support()


MAPPED = 'film = {name = "finite_map"}\n'


def turned_by(unbalance, quantity, viscosity=1.0):
    found = scene(MAPPED, JUMPS.replace("[rigid_rotor]", f"[rigid_rotor]\nunbalance = {float(unbalance)!r}"))
    thicker = replace(found.damper, viscosity=viscosity * found.damper.viscosity)
    return asked(found.with_tables(damper=thicker), quantity, 1e-3)


@pytest.mark.parametrize("quantity", ["unbalance_amplitude", "transmissibility"])
@pytest.mark.parametrize("part", [0.5, 0.9, 0.99])
def test_bound_of_a_force_is_carried_on_to_the_quantity(quantity, part):
    jump = asked(scene(MAPPED, JUMPS), "jump_up", 1e-2).ask()
    # the force is proportional to the viscosity
    low, middle, high = (turned_by(part * jump.value, quantity, 1.0 + k * 3e-4).ask() for k in (-1, 0, 1))
    changes = [abs(answer.value / middle.value - 1.0) for answer in (low, high)]
    assert middle.rungs[-1].bound
    assert max(changes) <= middle.error_estimate
    # an error across the force makes more of it than one along it
    assert middle.error_estimate < 10.0 * max(changes)


@pytest.mark.parametrize("quantity", ["unbalance_amplitude", "transmissibility"])
def test_bound_of_a_force_is_no_bound_of_an_orbit_just_below_a_jump(quantity):
    jump = asked(scene(MAPPED, JUMPS), "jump_up", 1e-2).ask()
    answer = turned_by(0.9999 * jump.value, quantity).ask()
    assert not answer.met
    assert "so near to a jump" in answer.message
    assert answer.error_estimate > 1.5e-3  # a film of 3e-4 less force takes it there


def test_bound_of_a_jump_is_that_of_the_force_there():
    jump = asked(scene(MAPPED, JUMPS), "jump_up", 1e-3).ask()
    thicker = scene(MAPPED, JUMPS.replace("4.096e-4", "4.0972288e-4"))  # 3e-4 more
    moved = asked(thicker, "jump_up", 1e-3).ask()
    assert moved.value != jump.value
    assert abs(moved.value / jump.value - 1.0) <= jump.error_estimate < 3e-4


def test_jumps_of_a_fed_film_of_finite_length_are_left_out_unless_it_is_named():
    fed = scene(FULL, JUMPS)
    fed = fed.with_tables(damper=replace(fed.damper, feed=RadialFeed(inflow=0.002)))
    assert [rung.name for rung in ladder_of(asked(fed, "jump_up", 0.1)).rungs] == ["short film"]
    named = fed.with_tables(damper=replace(fed.damper, film=FiniteSqueeze()))
    assert len(ladder_of(asked(named, "jump_up", 0.1)).rungs) == 1
    (film,) = damper_films(named.damper)
    # whatever it is called
    assert not _endless(replace(film, name="finite film"), "jump_up", is_named=True)


def test_what_a_damper_lacks_is_named():
    found = asked(scene(FULL, JUMPS), "jump_up", 0.1)
    with pytest.raises(InputError, match=r"damper is required for jump_up, got no such table"):
        damper_ladder(read_scene(FAMILIES["orbit"][1](np.random.default_rng(1)).data, "drawn"), "jump_up")
    with pytest.raises(InputError, match=r"rigid_rotor is required for jump_up"):
        damper_ladder(replace(found, rigid_rotor=None), "jump_up")


def test_an_excitation_that_does_not_fit_is_shown():
    step = SCENE.replace('kind = "blade_loss"', 'kind = "unbalance"').replace("revolutions = 5\n", "")
    with pytest.raises(InputError, match=r'"run_up" is required for peak_displacement, got UnbalanceTable\('):
        scene(FULL, step).ask()
    with pytest.raises(InputError, match=r"peak_displacement, got none"):
        replace(scene(FULL), excitation=None).ask()
    twice = SCENE.replace('mass = "20 kg"', 'mass = "20 kg"\nunbalance = 3e-4')
    with pytest.raises(
        InputError, match=r"where \[excitation\] has the unbalance, got 0\.0003 beside 0\.0008"
    ):
        scene(FULL, twice).ask()


def test_an_answer_that_is_at_most_about_right_says_so(capsys):
    found = asked(scene(MAPPED, JUMPS), "jump_up", 1e-2)
    print_question("jump", found.ask(), explain=True)
    shown = capsys.readouterr().out
    assert "at most about 0.00017" in shown
    assert "<~ 0.00017" in shown
