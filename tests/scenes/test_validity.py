"""Dimensionless numbers of what films leave out."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import ConvergenceError, EquilibriumError, FilmContactError
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, ShortFilm, table as journal_remarks
from rotorfilm.bearings.journal.table import film_loss, film_remarks, journal_numbers
from rotorfilm.bearings.oil.oil import TAYLOR
from rotorfilm.core.answers import physics_within
from rotorfilm.scenes import Lubricant, bundled_scene

BEARING = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
OIL = Lubricant(density=900.0, heat_capacity=2000.0, conductivity=0.15, thinning=0.04)


def critical_taylor_number(wavenumber, nodes=24):
    """Return T of (D^2 - a^2)^2 u = (1 - x) v, (D^2 - a^2) v = -T a^2 u between walls at 0 and 1.

    The equations of a narrow gap whose outer wall rests: the mean flow falls linearly.
    """
    k = np.arange(nodes + 1)
    x = np.cos(np.pi * k / nodes)
    c = np.where((k == 0) | (k == nodes), 2.0, 1.0) * (-1.0) ** k
    gap = x[:, None] - x[None, :] + np.eye(nodes + 1)
    D = np.outer(c, 1.0 / c) / gap
    D -= np.diag(D.sum(axis=1))
    D *= 2.0  # from [-1, 1] to [0, 1]
    at = 0.5 * (x + 1.0)
    L = D @ D - wavenumber**2 * np.eye(nodes + 1)
    # clamped u: u = u' = 0 at both walls, imposed in the four outer rows of the fourth-order operator
    fourth = L @ L
    fourth[[0, -1]] = np.eye(nodes + 1)[[0, -1]]
    fourth[[1, -2]] = D[[0, -1]]
    source = np.diag(1.0 - at)
    source[[0, 1, -2, -1]] = 0.0
    second = L.copy()
    second[[0, -1]] = np.eye(nodes + 1)[[0, -1]]
    back = np.eye(nodes + 1)
    back[[0, -1]] = 0.0
    # v = -T a^2 second^-1 back u, u = fourth^-1 source v
    product = -(wavenumber**2) * np.linalg.solve(fourth, source @ np.linalg.solve(second, back))
    values = np.linalg.eigvals(product)
    real = values[np.abs(values.imag) < 1e-9 * np.abs(values)].real
    return 1.0 / real.max()


@pytest.mark.closed_form
def test_taylor_limit_is_that_of_the_narrow_gap():
    # T = 2 (speed R c/nu)^2 c/R where the inner wall turns alone
    lowest = min(critical_taylor_number(a) for a in np.linspace(2.9, 3.4, 11))
    assert lowest == pytest.approx(3390.0, rel=2e-3)
    assert math.sqrt(0.5 * lowest) == pytest.approx(TAYLOR, rel=2e-3)


def test_numbers_by_hand():
    n = journal_numbers(BEARING, OIL, 100.0, (0.0, -5000.0))
    assert n["taylor"] == pytest.approx(100.0 * 0.05 * 1e-4 * 900.0 / 0.02 * math.sqrt(1e-4 / 0.05))
    assert n["inertia"] == pytest.approx(100.0 * 1e-8 * 900.0 / 0.02)
    assert n["peclet"] == pytest.approx(100.0 * 1e-8 * 1.8e6 / 0.15)
    assert n["warming"] == pytest.approx(n["power"] / (1.8e6 * n["side_flow"]))
    assert n["pressure"] == pytest.approx(5000.0 / (0.1 * 0.05) / 1e5)


def test_turbulence_is_said_and_counts_against_a_tolerance():
    large = JournalBearing(radius=0.25, length=0.4, clearance=0.5e-3, viscosity=0.0159)
    numbers = journal_numbers(large, OIL, 314.159, (0.0, -3e5))
    reynolds = 314.159 * 0.25 * 0.5e-3 * 900.0 / 0.0159
    assert numbers["reynolds"] == pytest.approx(reynolds)
    assert numbers["turbulence"] == pytest.approx(0.0136 * reynolds**0.9 / 12.0)
    remarks = film_remarks(large, OIL, 314.159, (0.0, -3e5))
    said = [
        one for one in remarks if one.startswith("turbulence: Taylor vortices above 41.2, the film has 99.4")
    ]
    assert len(said) == 1
    assert physics_within("isothermal films", said, 0.1) == (
        f"isothermal films; but turbulence (up to {numbers['turbulence']:.0%}) is left out"
    )
    assert journal_numbers(BEARING, OIL, 100.0, (0.0, -5000.0))["turbulence"] == 0.0


def test_warming_is_that_between_cold_walls_where_heat_is_conducted_away():
    slow = journal_numbers(BEARING, OIL, 1.0, (0.0, -5000.0))
    assert slow["peclet"] < 1.0
    assert slow["warming"] == pytest.approx(0.02 * 0.05**2 / (8.0 * 0.15))


def test_remarks_name_what_is_left_out():
    assert [remark.partition(":")[0] for remark in bundled_scene().film_remarks] == ["heat"]


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [300.0, -300.0])
def test_loss_and_flow_of_a_short_film(speed):
    # L/D -> 0: side flow eps |speed| R c L, shear in closed form, and the moment of film force and load
    bearing = JournalBearing(radius=0.05, length=0.008, clearance=1e-4, viscosity=0.02)
    at = equilibrium(replace(bearing, film=ShortFilm()), (0.0, -150.0), speed)
    eps, x = at.eccentricity_ratio, at.position[0]
    shear = ShortFilm().losses(at.position / 1e-4, at.position[::-1] * [speed, -speed], 0.08).shear
    power, flow, _ = film_loss(bearing, speed, (0.0, -150.0))
    assert flow == pytest.approx(eps * 300.0 * 0.05 * 1e-4 * 0.008, rel=0.02)
    drag = 0.02 * 300.0 * 0.05**3 * 0.008 / 1e-4 * float(shear)
    assert power == pytest.approx(300.0 * (drag + 0.5 * abs(x) * 150.0), rel=0.02)


def test_loss_is_that_of_the_film_itself():
    at = equilibrium(BEARING, (0.0, -5000.0), 100.0)
    found = film_loss(BEARING, 100.0, (0.0, -5000.0))
    assert found == (at.losses.power_loss, at.losses.side_flow, at.eccentricity_ratio)


def test_an_unloaded_film_has_no_flow_and_one_beyond_any_load_no_number():
    assert film_loss(BEARING, 100.0, (0.0, 0.0))[1] == film_loss(BEARING, 100.0, (0.0, -1e-9))[1] == 0.0
    n = journal_numbers(BEARING, OIL, 100.0, (0.0, 0.0))
    assert n["warming"] == pytest.approx(0.02 * (100.0 * 0.05) ** 2 / (8.0 * 0.15))
    assert math.isnan(journal_numbers(BEARING, OIL, 100.0, (0.0, -1e14))["warming"])


@pytest.mark.parametrize("failure", [ConvergenceError("no"), FilmContactError("no"), EquilibriumError("no")])
def test_a_coarse_film_without_an_answer_leaves_the_heat_unknown(monkeypatch, failure):
    def fail(*_):
        raise failure

    monkeypatch.setattr(journal_remarks, "equilibrium", fail)
    remarks = film_remarks(BEARING, OIL, 100.0, (0.0, -5000.0))
    assert [remark[:15] for remark in remarks if remark.startswith("heat")] == ["heat: not known"]


@pytest.mark.parametrize("speed", [20.0, 3000.0])
def test_warming_passes_from_conduction_to_the_oil_that_leaves(speed):
    conducted = 0.02 * (speed * 0.05) ** 2 / (8.0 * 0.15)
    stiff = math.hypot(*coefficients(BEARING, [0.0, 0.0], speed).stiffness[0])
    numbers = [
        journal_numbers(BEARING, OIL, speed, (0.0, -stiff * 1e-4 * ratio))
        for ratio in (5e-4, 1.1e-3, 0.01, 0.03, 0.06, 0.099, 0.101, 0.12)
    ]
    warming = [n["warming"] for n in numbers]
    assert warming[0] == pytest.approx(conducted)
    assert numbers[1]["side_flow"] > 0.0
    most = max(warming[-1], conducted)
    assert abs(warming[1] - warming[0]) < 0.02 * most
    assert abs(warming[-2] - warming[-3]) < 0.05 * most
    assert max(warming) < 1.3 * most
