"""Openings of finite length, feed holes and a circumferential groove: closed forms, another grid, orders."""

import dataclasses
import math
import pickle
from itertools import pairwise

import numpy as np
import pytest
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve

from rotorfilm import (
    Cooling,
    FeedHole,
    FullFilm,
    Groove,
    HeatedFilm,
    InputError,
    JournalBearing,
    MapFilm,
    Oil,
    Pad,
    ReynoldsFilm,
    ShortFilm,
    equilibrium,
)
from rotorfilm.bearings import FilmGeometry, Pocket, gap_shear

R, L, c, mu, omega = 0.05, 0.06, 1e-4, 0.02, 300.0
REST = [0.0, 0.0]
SIZES = {"radius": R, "length": L, "clearance": c, "viscosity": mu}
HOLE, SHORT = FeedHole(center=1.2, diameter=8e-3), Groove(center=-2.0, width=0.3, length=0.04)


def bearing(cells=(96, 8), **given):
    return JournalBearing(**{**SIZES, **given}, film=ReynoldsFilm(cells=cells))


def test_openings_become_pockets_of_their_share():
    found = bearing(grooves=(HOLE, SHORT, Groove(center=0.1, width=0.1, length=L))).geometry
    side = 4e-3 * math.sqrt(math.pi)
    hole, short = found.pockets
    assert (hole.width, hole.share) == (pytest.approx(side / R), pytest.approx(side / L))
    assert (short.width, short.share) == (0.3, pytest.approx(2.0 / 3.0))
    assert found.grooves == (Groove(center=0.1, width=0.1),)
    # What the circumferential groove takes of the length is no film.
    both = bearing(grooves=(SHORT,), circumferential_groove=0.01)
    assert both.geometry.pockets[0].share == pytest.approx(0.6)
    assert (both.film_length, both.slenderness) == (pytest.approx(0.05), pytest.approx(0.5))


def test_a_default_film_is_chosen_anew_for_other_openings():
    plain = JournalBearing(**SIZES)
    wide = (Groove(center=0.0, width=2.0),)
    for other in ({"grooves": (HOLE,), "supply_pressure": 1e5}, {"grooves": wide}):
        fed = dataclasses.replace(plain, **other)
        assert fed == JournalBearing(**SIZES, **other)
        assert fed.film == ReynoldsFilm()
        warm = pickle.loads(pickle.dumps(dataclasses.replace(fed, viscosity=0.01)))
        assert dataclasses.replace(warm, viscosity=mu, grooves=(), supply_pressure=0.0) == plain
    for film in (ReynoldsFilm(), ReynoldsFilm(cells=(48, 4))):
        given = dataclasses.replace(fed, film=film)
        assert dataclasses.replace(given, grooves=()).film is film
    with pytest.raises(InputError, match="film must represent"):
        dataclasses.replace(plain, film=ShortFilm(), grooves=wide)


def test_a_bearing_may_be_derived_with_checks_of_its_own():
    @dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
    class Checked(JournalBearing):
        def __post_init__(self):
            super().__post_init__()

    made = Checked(**SIZES)
    assert dataclasses.replace(made, viscosity=0.02).film == made.film
    assert "default_film" not in {one.name for one in dataclasses.fields(made)}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"grooves": (Groove(center=0.0, length=0.07),)},
            "grooves must be at most as long as the bearing, 0.06 m, got",
        ),
        (
            {"grooves": (FeedHole(center=0.0, diameter=0.07),)},
            r"diameter of a feed hole must be below 0\.0677\d+ m, .* got",
        ),
        (
            {"grooves": (FeedHole(center=0.0, diameter=0.1),), "length": 0.2},
            r"diameter of a feed hole must be below 0\.1 m, so that the square",
        ),
        ({"grooves": (HOLE, Groove(center=1.25, width=0.1))}, "must not overlap"),
        (
            {"grooves": (Groove(center=0.0, width=0.2, length=0.02), Groove(center=0.15, width=0.1))},
            "must not touch another",
        ),
        ({"grooves": (SHORT,), "pads": (Pad(start=0.0, extent=3.0),)}, "must not overlap"),
        ({"circumferential_groove": 0.06}, r"circumferential_groove must be from 0 to below .* got 0.06"),
        ({"circumferential_groove": -0.01}, "circumferential_groove must be finite and not negative"),
        (
            {"circumferential_groove": 0.01, "grooves": (HOLE,)},
            "must exceed the width of the circumferential_groove",
        ),
        ({"supply_pressure": 1e5}, "supply_pressure must be 0 without grooves"),
        ({"grooves": (Pad(start=0.0, extent=1.0),)}, "grooves must be a tuple of Groove or FeedHole"),
    ],
)
def test_bad_openings_are_refused(given, message):
    with pytest.raises(InputError, match=message):
        bearing(**given)


@pytest.mark.parametrize(
    "given", [{"grooves": (SHORT,)}, {"grooves": (HOLE,)}, {"circumferential_groove": 0.01}]
)
def test_films_that_cannot_say_which_can(given):
    for film in (MapFilm(), ShortFilm()):
        with pytest.raises(InputError, match="ReynoldsFilm"):
            JournalBearing(**SIZES, film=film, **given)
    warm = {**SIZES, "viscosity": None, "oil": Oil.iso_vg(46), "cooling": Cooling(supply_temperature=320.0)}
    with pytest.raises(InputError, match="whole length for HeatedFilm"):
        HeatedFilm(bearing=JournalBearing(**warm, film=ReynoldsFilm(), **given))


@pytest.mark.parametrize(
    ("given", "film"),
    [
        ({"grooves": (SHORT,)}, ReynoldsFilm()),
        ({"circumferential_groove": 0.01}, ReynoldsFilm()),
        ({"grooves": (Groove(center=0.0, width=0.2),), "supply_pressure": 1e5}, ReynoldsFilm()),
        ({"pads": (Pad(start=0.0, extent=2.0),)}, ReynoldsFilm()),
        ({"grooves": (Groove(center=0.0, width=0.2),), "length": 0.004}, ReynoldsFilm()),
        ({"grooves": (Groove(center=0.0, width=0.2),)}, MapFilm()),
        ({"length": 0.004}, MapFilm()),
    ],
)
def test_without_a_name_the_film_is_the_map_where_there_is_one(given, film):
    assert JournalBearing(**{**SIZES, **given}).film == film


@pytest.mark.parametrize(
    "made", [lambda: FeedHole(center=0.0, diameter=0.0), lambda: Groove(center=0.0, length=0.0)]
)
def test_openings_without_size_are_refused(made):
    with pytest.raises(InputError, match="must be finite and positive, got 0"):
        made()


@pytest.mark.parametrize("share", [0.0, 1.0, math.nan])
def test_bad_shares_are_refused(share):
    with pytest.raises(InputError, match="share must be above 0 and below 1"):
        Pocket(center=0.0, width=0.1, share=share)
    with pytest.raises(InputError, match="grooves must be open at both ends"):
        FilmGeometry(grooves=(SHORT,))


@pytest.mark.closed_form
@pytest.mark.parametrize("eps", [0.0, 0.5, 0.8])
def test_leakage_of_a_circumferential_groove(eps):
    # p falls linearly over each land l, whatever the gap: Q = pi R c^3 p/(3 mu l) (1 + 1.5 eps^2) of both.
    pressure, width = 2e5, 0.01
    b = bearing((192, 8), circumferential_groove=width, supply_pressure=pressure)
    found = b.losses([0.0, -eps * c], REST, 0.0)
    land = 0.5 * (L - width)
    exact = math.pi * R * c**3 * pressure / (3.0 * mu * land) * (1.0 + 1.5 * eps**2)
    assert found.side_flow == pytest.approx(exact, rel=1e-12 if eps == 0.0 else 2e-3)
    assert found.inflow == pytest.approx([found.side_flow], rel=1e-9)
    assert found.power_loss == pytest.approx(pressure * found.side_flow, rel=1e-9)
    # Nothing pushes the journal: the pressure is the same all round.
    assert np.hypot(*b.force([0.0, -eps * c], REST, 0.0)) < 1e-6 * pressure * R * L


@pytest.mark.closed_form
def test_two_lands_are_two_bearings():
    # At ambient pressure in the groove.
    whole = bearing((192, 16), circumferential_groove=0.02)
    land = dataclasses.replace(whole, length=0.02, circumferential_groove=None)
    state = [3e-5, -6e-5], [1e-3, 2e-3], omega
    assert whole.force(*state) == pytest.approx(2.0 * land.force(*state), rel=3e-3)
    assert whole.jacobian(*state)[:, :4] == pytest.approx(
        2.0 * land.jacobian(*state)[:, :4], abs=4e-3 * np.abs(whole.jacobian(*state)[:, :2]).max()
    )


def uniform_film(e, w, slenderness, pocket, supply, lines=144, nodes=20):
    """Return force and side flow of a film with a pocket by another grid and a search over sets of nodes."""
    step, high = 2.0 * np.pi / lines, 1.0 / nodes
    angle = step * np.arange(lines)
    z = high * np.arange(nodes)
    width = np.full(nodes, high)
    width[0] = 0.5 * high
    gap = lambda t: (1.0 - e[0] * np.cos(t) - e[1] * np.sin(t)) ** 3  # noqa: E731
    A = lil_matrix((lines * nodes, lines * nodes))
    b = np.zeros((lines, nodes))
    for i in range(lines):
        around, along = gap(angle[i] + 0.5 * step) / step, gap(angle[i]) * step / (slenderness**2 * high)
        sweep = np.array([2.0 * np.sin(0.5 * step) * f(angle[i]) for f in (np.cos, np.sin)])
        b[i] = (sweep @ w) * width
        for j in range(nodes):
            here, beside = i * nodes + j, (i + 1) % lines * nodes + j
            for p, q in ((here, beside), (beside, here)):
                A[p, p] += around * width[j]
                A[p, q] -= around * width[j]
            A[here, here] += along
            if j + 1 < nodes:
                A[here + 1, here + 1] += along
                A[here, here + 1] -= along
                A[here + 1, here] -= along
    A, b = A.tocsr(), b.ravel()
    away = np.abs((angle - pocket.center + np.pi) % (2.0 * np.pi) - np.pi)
    held = ((away <= 0.5 * pocket.width + 1e-9)[:, None] & (z <= pocket.share + 1e-9)).ravel()
    pressure, full = np.where(held, supply, 0.0), ~held & (b > 0.0)
    for _ in range(100):
        pressure = np.where(held, supply, 0.0)
        pressure[full] = spsolve(A[full][:, full], (b - A @ pressure)[full])
        before, full = full, ~held & np.where(full, pressure > 0.0, b - A @ pressure > 1e-12)
        if np.array_equal(before, full):
            break
    P = pressure.reshape(lines, nodes)
    sweep = 2.0 * np.sin(0.5 * step) * np.stack([np.cos(angle), np.sin(angle)])
    force = -12.0 * sweep @ (P @ width)
    ends = 2.0 * gap(angle) * step / (slenderness**2 * high) * P[:, -1] / 2.0
    made = np.where(P[:, -1] > 0.0, 0.5 * sweep.T @ w * high, 0.0)
    return force, float(np.sum(ends + made))


@pytest.mark.parametrize("supply", [0.0, 0.02])
def test_film_with_a_pocket_is_that_of_another_grid(supply):
    pocket = Pocket(center=0.5 * np.pi, width=np.radians(20.0), share=0.8)
    e = np.array([0.3, -0.5])
    w = -0.5 * np.array([-e[1], e[0]])
    force, side_flow = uniform_film(e, w, 0.5, pocket, supply)
    film = ReynoldsFilm(cells=(192, 16), geometry=FilmGeometry(pockets=(pocket,), supply=supply))
    assert film.force(e, w, 0.5) == pytest.approx(force, rel=5e-3)
    assert film.losses(e, w, 0.5).side_flow == pytest.approx(side_flow, rel=0.01)


@pytest.mark.convergence
@pytest.mark.parametrize("supply", [0.0, 0.1])
def test_orders_with_a_pocket(supply):
    # Grids of two, four and eight times the cells, in the pocket and beside it: its end lies at 3/4 of them.
    pocket = Pocket(center=0.4, width=np.pi / 6.0, share=math.sin(0.9) / math.sin(1.2))
    geometry = FilmGeometry(pockets=(pocket,), supply=supply)
    e, w = np.array([0.5, 0.2]), 0.5 * np.array([0.2, -0.5])
    films = [
        ReynoldsFilm(cells=(96 * k, 16 * k), geometry=geometry, cavitation=FullFilm()) for k in (1, 2, 4)
    ]
    forces = [film.force(e, w, 0.7) for film in films]
    steps = [np.hypot(*(fine - coarse)) for coarse, fine in pairwise(forces)]
    order = ReynoldsFilm.order_with_supply if supply else ReynoldsFilm.order
    assert math.log2(steps[0] / steps[1]) == pytest.approx(order, abs=0.25)
    flows = [film.losses(e, w, 0.7).inflow[0] for film in films]
    assert math.log2((flows[1] - flows[0]) / (flows[2] - flows[1])) == pytest.approx(1.0, abs=0.25)


@pytest.mark.closed_form
def test_pressed_oil_leaves_at_the_ends():
    b = bearing(grooves=(HOLE, SHORT), supply_pressure=3e5)
    found = b.losses([0.2 * c, 0.3 * c], REST, 0.0)
    assert found.inflow.sum() == pytest.approx(found.side_flow, rel=1e-9)
    assert found.power_loss == pytest.approx(3e5 * found.inflow.sum(), rel=1e-12)
    assert np.all(found.inflow > 0.0)
    # The hole is in the geometry at 1.2, before the groove at 2 pi - 2.
    assert found.inflow[0] < found.inflow[1]


@pytest.mark.closed_form
def test_full_film_shears_the_gap_but_the_openings():
    pockets = (Pocket(center=0.4, width=0.3, share=0.7), Pocket(center=2.0, width=0.1, share=0.2))
    for circumferential in (False, True):
        geometry = FilmGeometry(pockets=pockets, circumferential=circumferential)
        e, w = np.array([0.3, 0.4]), np.array([0.2, -0.15])
        found = ReynoldsFilm(cavitation=FullFilm(), geometry=geometry).losses(e, w, 0.6)
        assert found.shear_film == pytest.approx(found.shear_gap, rel=1e-12)
    lost = gap_shear(np.zeros(2), FilmGeometry()) - gap_shear(np.zeros(2), geometry)
    assert lost == pytest.approx(0.3 * 0.7 + 0.1 * 0.2, rel=1e-12)


def test_bearing_with_pockets_turns_as_a_whole_and_is_mirrored():
    geometry = FilmGeometry(pockets=(Pocket(center=0.5, width=0.3, share=0.6),), supply=0.1)
    e, w = np.array([0.3, -0.4]), np.array([0.5, 0.2])
    force = ReynoldsFilm(geometry=geometry).force(e, w, 0.5)
    turned = FilmGeometry(pockets=(Pocket(center=1.6, width=0.3, share=0.6),), supply=0.1)
    Q = np.array([[math.cos(1.1), -math.sin(1.1)], [math.sin(1.1), math.cos(1.1)]])
    assert ReynoldsFilm(geometry=turned).force(Q @ e, Q @ w, 0.5) == pytest.approx(Q @ force, rel=1e-9)
    mirror = np.array([1.0, -1.0])
    below = FilmGeometry(pockets=(Pocket(center=-0.5, width=0.3, share=0.6),), supply=0.1)
    assert ReynoldsFilm(geometry=below).force(mirror * e, mirror * w, 0.5) == pytest.approx(
        mirror * force, rel=1e-9
    )


def test_nodes_lie_at_the_ends_of_pockets_on_all_grids():
    pockets = tuple(
        Pocket(center=k, width=0.2, share=share) for k, share in ((0.0, 0.8), (1.0, 0.15), (2.0, 0.8))
    )
    _, grids = ReynoldsFilm(geometry=FilmGeometry(pockets=pockets)).grids(0.5)
    for grid in grids:
        for share in (0.15, 0.8):
            assert np.abs(grid.nodes - share).min() < 1e-12
        assert set(grid.held) == {0, *(np.count_nonzero(grid.nodes <= s + 1e-9) for s in (0.15, 0.8))}
    assert len(grids[0].width) == 4 * len(grids[2].width)


def test_a_fed_bearing_finds_its_equilibrium():
    b = bearing(grooves=(Groove(center=0.5 * np.pi, width=0.35, length=0.048),), supply_pressure=2e5)
    at = equilibrium(b, (0.0, -2000.0), omega)
    assert b.force(at.position, REST, omega) == pytest.approx([0.0, 2000.0], abs=1e-3)
    assert at.losses.side_flow > 0.0
