"""Feed holes of dampers in small motion: finite volumes with wells in a grid, many holes, what is refused."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.sparse import diags, eye, kron
from scipy.sparse.linalg import spsolve

import rotorfilm as rf
from rotorfilm import InputError
from rotorfilm.bearings.damper.squeeze_inertia import film_impedance

R, C, MU, RHO, G = 0.05, 1e-4, 5e-3, 850.0, 2e-11
AROUND, ALONG = 144, 11
CELL = 2.0 * np.pi * R / AROUND
RADIUS = np.exp(-np.pi / 2.0) * CELL
"""Of the well that a node of a square grid is: Peaceman (1978), .198 = .208 of the cell."""
LEAKS = {"open": None, "leaking": 2e-9, "tight": 0.0}


def film(seals, length=ALONG * CELL, density=RHO):
    seal = None if LEAKS[seals] is None else rf.EndSeal(leakage=LEAKS[seals])
    return rf.SqueezeFilmDamper(
        radius=R,
        length=length,
        clearance=C,
        viscosity=MU,
        density=density,
        seals=seal,
        extent=rf.FullFilm(),
        film=rf.FiniteSqueeze(),
    )


def holes(*nodes):
    return tuple(rf.FeedHole(center=2.0 * np.pi / AROUND * k, diameter=2.0 * RADIUS) for k in nodes)


def by_volumes(leakage, nodes, frequency):
    """Return the impedance (2, 2) by square cells, holes at nodes in the middle."""
    Z = film_impedance(C, MU, RHO, frequency)
    k = C / Z
    end = -2.0 * k if leakage is None else -1.0 / (0.5 / k + 1.0 / (leakage * CELL or 1e-300))
    ring = diags([1.0, -2.0, 1.0, 1.0, 1.0], [-1, 0, 1, AROUND - 1, 1 - AROUND], shape=(AROUND, AROUND))
    middle = np.full(ALONG, -2.0 * k)
    middle[[0, -1]] = -k + end
    axis = diags([middle, np.full(ALONG - 1, k), np.full(ALONG - 1, k)], [0, 1, -1])
    sink = np.zeros((ALONG, AROUND))
    sink[ALONG // 2, list(nodes)] = G
    A = kron(eye(ALONG), k * ring) + kron(axis, eye(AROUND)) - diags(sink.ravel())
    theta = 2.0 * np.pi / AROUND * np.arange(AROUND)
    m = np.tile(np.stack([np.cos(theta), np.sin(theta)], axis=1), (ALONG, 1)) * CELL**2
    return -m.T @ spsolve(A.tocsc(), m.astype(complex))


@pytest.mark.parametrize(
    ("seals", "nodes"), [("open", (0, 40)), ("leaking", (0,)), ("leaking", (17, 65, 113)), ("tight", (0, 40))]
)
def test_impedance_is_that_of_finite_volumes(seals, nodes):
    w = 2000.0
    right, bare = (by_volumes(LEAKS[seals], places, w) for places in (nodes, ()))
    found = rf.bearings.hole_small_motion(film(seals), holes(*nodes), conductance=G, frequency=w)
    own = film(seals).small_motion(w)
    impedance = found.damping + 1j * w * found.added_mass
    taken = (own.damping + 1j * w * own.added_mass) * np.eye(2) - impedance
    assert abs(taken).max() > 0.01 * abs(right).max()
    assert_allclose(taken, bare - right, atol=0.015 * abs(bare - right).max())


@pytest.mark.closed_form
def test_many_holes_are_a_line_that_leaks():
    # Evenly spread: P'' - P = -Z R^2/h but for a kink of N G P/(2 pi h/Z) in the middle, and each hole's own
    # narrowing of the flow, log(2 sin(rim N/2)) of N holes in the circle.
    n, w, damper = 60, 0.0, film("open", length=0.05, density=0.0)
    spread = tuple(rf.FeedHole(center=2.0 * np.pi * k / n, diameter=4e-4) for k in range(n))
    found = rf.bearings.hole_small_motion(damper, spread, conductance=G, frequency=w)
    Z, s = 12.0 * MU / C**2, 0.5
    own = -Z / C / (2.0 * np.pi) * np.log(2.0 * np.sin(0.5 * n * 2e-4 / R))
    line = n / (2.0 * np.pi) * Z / C / (1.0 / G + own)
    # P = -1 + a cosh + b sinh (0 to s), P(s) = 0, 2 P'(0) = line P(0), in Z R^2/h
    b = 0.5 * line * (1.0 / np.cosh(s) - 1.0) / (1.0 + 0.5 * line * np.tanh(s))
    a = (1.0 - b * np.sinh(s)) / np.cosh(s)
    mean = (a * np.sinh(s) + b * (np.cosh(s) - 1.0)) / s - 1.0
    right = -np.pi * R * 0.05 * Z * R**2 / C * mean
    assert_allclose(found.damping, right * np.eye(2), rtol=2e-3, atol=1e-9 * right)
    assert right < 0.9 * damper.small_motion(0.0).damping


def test_one_hole_between_tight_seals_moves_no_oil():
    damper = film("tight")
    found = rf.bearings.hole_small_motion(damper, holes(7), conductance=G, frequency=100.0)
    own = damper.small_motion(100.0)
    assert_allclose(found.damping, own.damping * np.eye(2), atol=1e-9 * own.damping)
    assert_allclose(found.added_mass, own.added_mass * np.eye(2), atol=1e-9 * own.added_mass)


@pytest.mark.parametrize(
    ("changes", "rule"),
    [
        ({"holes": ()}, "holes must be at least one, got none"),
        ({"holes": (rf.FeedHole(center=0.0, diameter=0.1),)}, "diameter of holes must be below the length"),
        ({"holes": holes(3, 3)}, "holes must not overlap"),
        ({"conductance": 0.0}, "conductance must be finite and positive"),
        ({"frequency": -1.0}, "frequency must be finite and not negative"),
        (
            {"damper": rf.SqueezeFilmDamper(radius=R, length=0.2 * R, clearance=C, viscosity=MU)},
            "small_motion needs",
        ),
    ],
)
def test_what_it_refuses(changes, rule):
    given = {"damper": film("open"), "holes": holes(3), "conductance": G, "frequency": 10.0} | changes
    damper, places = given.pop("damper"), given.pop("holes")
    with pytest.raises(InputError, match=rule):
        rf.bearings.hole_small_motion(damper, places, **given)
