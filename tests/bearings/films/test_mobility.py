"""A mobility of the oil reaches the films of all bearings: dense matrices, closed forms, scalings."""

import dataclasses
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import nnls

import rotorfilm as rf
from rotorfilm import Groove, InputError
from rotorfilm.bearings import PadGridFilm, Recess, RecessedPad
from rotorfilm.bearings.films.mobility import Mobility, mobility_of, sheared_gap
from rotorfilm.bearings.journal import ExtrapolatedFilm, ReynoldsFilm
from rotorfilm.bearings.pads.pad_build import pad_grid
from rotorfilm.bearings.pads.pressure_dam import pad_places

E, W = np.array([0.3, -0.4]), np.array([0.5, 0.3])
POSITION, VELOCITY, SPEED = np.array([2e-5, -3e-5]), np.array([1e-3, 2e-3]), 200.0
SIZE = {"radius": 0.05, "length": 0.06, "viscosity": 0.02}
GROOVES = (Groove(center=0.4, width=0.3), Groove(center=3.5, width=0.3))
TURN = 2.0 * math.pi
DAM = RecessedPad(start=0.2, extent=2.8, preload=0.2, recess=Recess(depth=5e-5, end=1.9, share=0.5))


def thick(X):
    """Return the factors of a toy: thick films are less mobile, and are sheared more."""
    return 1.0 / (1.0 + X**2), 1.0 / (1.0 + X), 1.0, 1.0 + X**2


def ng_pan(X):
    """Return the factors of the fit of Ng & Pan (1965) to turbulent films, at the local Reynolds number."""
    k = 0.0136 * X**0.9, 0.0043 * X**0.96
    return *(12.0 / (12.0 + more) for more in k), 1.0, 1.0 + 0.0012 * X**0.94


THICK = mobility_of(thick)
TURBULENT = mobility_of(ng_pan, largest=2e4, scale=30.0)
MOVING = Mobility(**{**TURBULENT._parts(), "density": 2000.0})


def even(factors):
    """Return a mobility that is the same everywhere."""
    return mobility_of(lambda X: factors, largest=3.0, cells=8)


def bearings(mobility=None):
    """Return all bearings with films on grids, by name."""
    grid, ring = PadGridFilm(cells=(32, 4), mobility=mobility), ReynoldsFilm(cells=(48, 8), mobility=mobility)
    pads = {**SIZE, "pad_clearance": 1e-4}
    lobes, pivots = rf.lobe_set("three_lobe", preload=0.3), rf.even_pivots(4, between_pads=True)
    return {
        "plain": rf.JournalBearing(**SIZE, clearance=1e-4, film=ring),
        "richer": rf.JournalBearing(**SIZE, clearance=1e-4, film=ExtrapolatedFilm(film=ring)),
        "grooved": rf.JournalBearing(**SIZE, clearance=1e-4, film=ring, grooves=GROOVES),
        "lobed": rf.LobedBearing(**pads, lobes=lobes, film=grid),
        "dam": rf.PressureDamBearing(**pads, pads=(DAM,), cells=(32, 8), mobility=mobility),
        "tilting": rf.TiltingPadBearing(**pads, pivots=pivots, extent=1.2, preload=0.5, film=grid),
    }


NAMES = list(bearings())


def dense_film(theta, face, axial, slenderness, e, w, rate=0.0, depth=None, held=None):
    """Return the force of a film with P >= 0 by non-negative least squares on dense matrices.

    On lines at the angles theta, faces behind them and nodes from the middle to the end, the last one at
    pressure 0; `held` lines are at pressure 0. The depth is that of a recess at an angle and a
    place along the length.
    """
    lines, nodes = len(theta), len(axial) - 1
    depth, held = depth or (lambda angle, z: 0.0), np.zeros(lines, dtype=bool) if held is None else held
    edges = np.concatenate([[0.0], 0.5 * (axial[1:] + axial[:-1])])
    index = np.arange(lines * nodes).reshape(lines, nodes)
    A, b = np.zeros((lines * nodes,) * 2), np.zeros(lines * nodes)
    normal = np.zeros((2, lines, nodes))

    def gap(angle):
        return 1.0 - e @ [math.cos(angle), math.sin(angle)]

    for i in range(lines):
        after, last = (i + 1) % lines, i - 1
        step, behind, before = (theta[after] - theta[i]) % TURN, face[i], face[last]
        halves = ((theta[i] - before) % TURN, before), ((behind - theta[i]) % TURN, behind)
        arc = [math.sin(behind) - math.sin(before), math.cos(before) - math.cos(behind)]
        for j in range(nodes):
            p, q = index[i, j], index[after, j]
            for low, high in ((edges[j], axial[j]), (axial[j], edges[j + 1])):
                D = depth(behind, 0.5 * (low + high))
                H = gap(behind) + D
                c = thick(H)[0] * H**3 * (high - low) / step
                A[p, p] += c
                A[q, q] += c
                A[[p, q], [q, p]] -= c
                b[p] -= rate * D * (high - low)
                b[q] += rate * D * (high - low)
            width = edges[j + 1] - edges[j]
            normal[:, i, j] = np.array(arc) * width
            along = 0.0
            for side, middle in halves:
                H = gap(theta[i]) + depth(middle, 0.5 * (axial[j] + axial[j + 1]))
                along += thick(H)[1] * H**3 * side / slenderness**2 / (axial[j + 1] - axial[j])
            A[p, p] += along
            if j + 1 < nodes:
                A[index[i, j + 1], index[i, j + 1]] += along
                A[[p, p + 1], [p + 1, p]] -= along
    b += np.tensordot(w, normal, 1).ravel()
    free = index[~held].ravel()
    root = cholesky(A[np.ix_(free, free)], lower=True)
    P = nnls(root.T, solve_triangular(root, b[free], lower=True))[0]
    return -12.0 * normal.reshape(2, -1)[:, free] @ P


def test_a_mobility_reaches_films_with_openings_and_pads():
    """The same cells, without a shared line of code: another search, another matrix."""
    ring = rf.JournalBearing(
        **SIZE, clearance=1e-4, grooves=GROOVES, film=ReynoldsFilm(cells=(24, 4), mobility=THICK)
    )
    grooved = ring.bound_film.kernel.film
    pad = pad_grid(1.7, 0.6, (24, 4), THICK)
    for film in (grooved, pad):
        theta, face, _, _ = film.field(E, W)
        grid = film.grids[0]
        wanted = dense_film(theta, face, grid.nodes, 0.6, E, W, held=grid.held > 0)
        assert_allclose(film.pair(E[:, None], W[:, None])[0][:, 0], wanted, rtol=1e-9)


def test_a_mobility_reaches_a_recess_by_its_depth():
    """The dam: a step of the depth, and of the mobility with it, on edges that are nodes."""
    bearing = rf.PressureDamBearing(
        **SIZE, pad_clearance=1e-4, pads=(DAM,), cells=(16, 8), extrapolated=False, mobility=THICK
    )
    lines, axial = pad_places(DAM, bearing.cells)
    # The gap between the ends of the pad: no film, at ambient pressure.
    theta = np.append(lines, lines[-1] + 0.5 * (TURN - DAM.extent))
    face = np.append(0.5 * (theta[1:] + theta[:-1]), 0.5 * (theta[-1] + lines[0] + TURN))
    held = np.arange(len(theta)) >= len(lines) - 1
    held[0] = True
    e = POSITION / 1e-4 - np.array(DAM.center)
    w = VELOCITY / 1e-4 + 0.5 * SPEED * np.array([e[1], -e[0]])

    def depth(angle, z):
        return 0.5 if DAM.start < angle < 1.9 and z < 0.5 else 0.0

    wanted = dense_film(theta, face, axial, 0.6, e, w, 0.5 * SPEED, depth, held)
    force = bearing.force(POSITION, VELOCITY, SPEED)
    assert_allclose(force, bearing.force_scale * wanted, rtol=1e-9)
    shallow = dense_film(theta, face, axial, 0.6, e, w, 0.5 * SPEED, None, held)
    assert np.abs(force - bearing.force_scale * shallow).max() > 0.1 * np.abs(force).max()


@pytest.mark.parametrize("name", NAMES)
def test_factors_that_are_the_same_everywhere_scale_force_and_shear(name):
    """Pressure falls as oil flows more easily, shear grows with its factor, and what flows stays."""
    plain, eased = bearings()[name], bearings(even((0.25, 0.25, 1.0, 3.0)))[name]
    if name == "tilting":
        plain, eased = plain.at_rest(), eased.at_rest()
    velocity = np.zeros(2) if name == "tilting" else VELOCITY
    force = plain.force(POSITION, velocity, SPEED)
    assert_allclose(eased.force(POSITION, velocity, SPEED), 4.0 * force, rtol=1e-8)
    slopes = [each.jacobian(POSITION, velocity, SPEED) for each in (plain, eased)]
    assert_allclose(slopes[1], 4.0 * slopes[0], rtol=1e-7, atol=1e-7 * np.abs(slopes[0]).max())
    for full in (False, True):
        one, other = (each.losses(POSITION, np.zeros(2), SPEED, full_gap=full) for each in (plain, eased))
        # Without the pressure part the torque is the shear: (torque on journal + bush)/2 of a bore.
        shear = one.power_loss, other.power_loss
        pressed = [each.friction_torque - each.bush_torque for each in (one, other)]
        assert pressed[1] == pytest.approx(4.0 * pressed[0], rel=1e-7, abs=1e-9 * shear[0])
        assert other.side_flow == pytest.approx(one.side_flow, rel=1e-8)
        if name in ("plain", "grooved", "richer"):
            sheared = [each.friction_torque + each.bush_torque for each in (one, other)]
            assert sheared[1] == pytest.approx(3.0 * sheared[0], rel=1e-8)
    alone = even((1.0, 1.0, 1.0, 3.0))
    thicker = bearings(alone)[name]
    thicker = thicker.at_rest() if name == "tilting" else thicker
    laminar, sheared = (each.losses(POSITION, np.zeros(2), SPEED) for each in (plain, thicker))
    none = bearings(even((1.0, 1.0, 1.0, 1e-9)))[name]
    none = none.at_rest() if name == "tilting" else none
    pressure = none.losses(POSITION, np.zeros(2), SPEED).power_loss
    assert sheared.power_loss - pressure == pytest.approx(3.0 * (laminar.power_loss - pressure), rel=1e-7)


@pytest.mark.closed_form
@pytest.mark.parametrize("name", ["plain", "lobed", "dam"])
def test_short_bearings_carry_as_the_mobility_of_each_place_lets_them(name):
    """p = w.n/(m H^3) (1 - z^2)/2 (L/D)^2 where w.n > 0: F = -4 (L/D)^2 integral of w.n n/(m H^3)."""
    short = {"radius": 0.05, "length": 0.002, "viscosity": 0.02}
    grid, ring = PadGridFilm(cells=(192, 8), mobility=THICK), ReynoldsFilm(cells=(192, 8), mobility=THICK)
    pads = {**short, "pad_clearance": 1e-4}
    arcs, centers = [(0.0, TURN)], [np.zeros(2)]
    if name == "plain":
        bearing = rf.JournalBearing(**short, clearance=1e-4, film=ring)
    elif name == "lobed":
        bearing = rf.LobedBearing(**pads, lobes=rf.lobe_set("three_lobe", preload=0.3), film=grid)
        arcs = [(lobe.start, lobe.start + lobe.extent) for lobe in bearing.lobes]
        centers = [np.array(lobe.center) for lobe in bearing.lobes]
    else:
        flat = RecessedPad(start=0.2, extent=2.8, preload=0.2)
        bearing = rf.PressureDamBearing(**pads, pads=(flat,), cells=(192, 8), mobility=THICK)
        arcs, centers = [(flat.start, flat.end)], [np.array(flat.center)]
    found = np.zeros(2)
    for (start, end), center in zip(arcs, centers, strict=True):
        e = POSITION / 1e-4 - center
        w = VELOCITY / 1e-4 + 0.5 * SPEED * np.array([e[1], -e[0]])
        theta = np.linspace(start, end, 20001)
        n = np.stack([np.cos(theta), np.sin(theta)])
        H, driven = 1.0 - e @ n, np.maximum(w @ n, 0.0)
        found -= 4.0 * 0.02**2 * np.trapezoid(driven * n / (thick(H)[1] * H**3), theta)
    found *= bearing.force_scale
    assert_allclose(bearing.force(POSITION, VELOCITY, SPEED), found, atol=0.04 * np.hypot(*found))


@pytest.mark.parametrize("name", NAMES)
def test_force_is_of_degree_one_in_velocity_and_speed(name):
    """F = C (speed/2) z x E of a bore at rest: with the velocity and the speed, F = F_v v + F_speed speed."""
    bearing = bearings(THICK)[name]
    by = bearing.jacobian(POSITION, VELOCITY, SPEED)
    found = by[:, 2:4] @ VELOCITY + by[:, 4] * SPEED
    assert_allclose(found, bearing.force(POSITION, VELOCITY, SPEED), rtol=1e-8)
    if name != "richer":
        assert_allclose(by[:, 2:4], by[:, 2:4].T, atol=1e-10 * np.abs(by[:, 2:4]).max())


MOBILITIES = [THICK, MOVING, dataclasses.replace(MOVING, local=False)]


@pytest.mark.parametrize("mobility", MOBILITIES, ids=["thick", "turbulent", "one number"])
@pytest.mark.parametrize("name", NAMES)
def test_derivatives_are_those_of_differences(name, mobility):
    """By place, velocity and speed, that of the Reynolds number among them."""
    bearing = bearings(mobility)[name]
    by = bearing.jacobian(POSITION, VELOCITY, SPEED)
    state, steps = np.array([*POSITION, *VELOCITY, SPEED]), [1e-9, 1e-9, 1e-7, 1e-7, 2e-2]
    for k, step in enumerate(steps):
        more, less = (state + sign * step * np.eye(5)[k] for sign in (1.0, -1.0))
        differences = [bearing.force(each[:2], each[2:4], each[4]) for each in (more, less)]
        slope = (differences[0] - differences[1]) / (2.0 * step)
        # Lines that follow the journal move the error of the grid with them, which the derivatives leave out.
        least = 1e-6 if k > 1 or name == "dam" else 0.05
        assert_allclose(slope, by[:, k], atol=least * np.abs(by[:, k]).max(), err_msg=f"column {k}")


def reduced(slenderness, reynolds, e, w, **options):
    """Return force and derivatives of the fit of Ng & Pan at one Reynolds number, in the film's units."""
    ring = ReynoldsFilm(mobility=TURBULENT.at(reynolds), **options)
    film = ExtrapolatedFilm(film=ring) if ring.cells[0] > 96 else ring
    return film.force(np.array(e), np.array(w), slenderness), film.jacobian(
        np.array(e), np.array(w), slenderness
    )


def test_turbulent_films_are_those_of_the_note():
    """Another code on 144 x 10 cells: force and derivatives at Re 2000 and 8000, L/D 0.8 and 0.5."""
    force, slopes = reduced(0.8, 2000.0, (0.3, -0.4), (0.2, 0.5), cells=(192, 16))
    assert_allclose(force, (-1.6635, -1.5371), rtol=1e-3)
    assert_allclose(slopes[:, :2], [(-4.579, -1.436), (-1.114, -2.490)], atol=0.01)
    assert_allclose(slopes[:, 2:], [(-7.737, -0.232), (-0.232, -2.981)], atol=0.01)
    film = ExtrapolatedFilm(film=ReynoldsFilm(mobility=MOVING, cells=(192, 16), reynolds_scale=1.0))
    kernel = film._kernel(0.8)
    rate = np.array([2000.0 / (2.0 * MOVING.density)])
    by_rate = kernel.rate_slopes(np.array([[0.3], [-0.4]]), np.array([[0.2], [0.5]]), rate)
    assert_allclose(rate * by_rate[:, 0], (-0.550, -0.597), atol=2e-3)
    force, _ = reduced(0.5, 8000.0, (-0.25, 0.45), (-0.3, 0.1), cells=(192, 16))
    assert_allclose(force, (3.5955, -2.8661), rtol=1e-3)


@pytest.mark.closed_form
def test_damping_of_the_centered_turbulent_film_is_its_closed_form():
    """C = pi k_x (1 - tanh(l)/l), l = (L/D) sqrt(k_z/k_x): 10.3358 at Re 2000."""
    _, slopes = reduced(0.8, 2000.0, (0.0, 0.0), (1.0, 0.0), cells=(192, 16), cavitation=rf.FullFilm())
    around, along = (12.0 / factor for factor in ng_pan(2000.0)[:2])
    reach = 0.8 * math.sqrt(along / around)
    damping = math.pi * around * (1.0 - math.tanh(reach) / reach)
    assert damping == pytest.approx(10.3358, abs=1e-4)
    assert_allclose(-slopes[:, 2:], damping * np.eye(2), rtol=1e-3, atol=1e-8)


@pytest.mark.closed_form
def test_an_infinite_full_film_is_an_integral_over_the_angle():
    """(G H^3 p')' = -w.n: p' = (flow - w x n)/(G H^3), with no pressure left after a turn; Re 3000."""
    e, w = np.array([0.5, 0.0]), np.array([0.0, 1.0])
    theta = np.linspace(0.0, TURN, 40001)
    n = np.stack([np.cos(theta), np.sin(theta)])
    H = 1.0 - e @ n
    way = 1.0 / (ng_pan(3000.0 * H)[0] * H**3)
    run = -(w[0] * n[1] - w[1] * n[0])
    flow = -np.trapezoid(run * way, theta) / np.trapezoid(way, theta)
    slope = (run + flow) * way
    # Integrated by parts, -12 integral of p n = 12 integral of p' (sin, -cos).
    wanted = 12.0 * np.trapezoid(slope * np.stack([n[1], -n[0]]), theta)
    found, _ = reduced(40.0, 3000.0, e, w, cells=(192, 16), cavitation=rf.FullFilm())
    assert_allclose(found[1], wanted[1], rtol=0.05)
    assert_allclose(wanted, (0.0, -102.13), atol=0.01)


def test_pads_at_rest_feel_the_speed_by_their_reynolds_number_too():
    pads = bearings(MOVING)["tilting"].at_rest()
    place, still = np.array([0.5e-5, -1e-5]), np.zeros(2)
    more, less = (pads.force(place, still, SPEED + step) for step in (0.05, -0.05))
    assert_allclose(pads.jacobian(place, still, SPEED)[:, 4], (more - less) / 0.1, rtol=1e-5)


def test_a_sped_film_carries_more_than_its_laminar_one_and_at_rest_the_same():
    for name in NAMES:
        plain, moving = (bearings(mobility)[name] for mobility in (None, MOVING))
        slow, fast = (
            [each.force(POSITION, VELOCITY, speed) for each in (plain, moving)] for speed in (1e-3, 400.0)
        )
        assert_allclose(slow[0], slow[1], rtol=5e-3)
        assert np.hypot(*fast[1]) > 1.01 * np.hypot(*fast[0])


def test_the_shear_of_a_full_gap_is_an_integral():
    e, growth = np.array([[0.6], [-0.5]]), np.array([900.0])
    sigma, slopes, by_growth = sheared_gap(TURBULENT, growth, e, -1.0, 2.0)
    theta = np.linspace(-1.0, 2.0, 100001)
    H = 1.0 - e[:, 0] @ [np.cos(theta), np.sin(theta)]
    assert sigma[0] == pytest.approx(np.trapezoid(ng_pan(900.0 * H)[3] / H, theta), rel=1e-6)
    step = 1e-6
    for k in range(2):
        moved = [
            sheared_gap(TURBULENT, growth, e + s * step * np.eye(2)[:, k : k + 1], -1.0, 2.0)[0]
            for s in (1, -1)
        ]
        assert slopes[k, 0] == pytest.approx((moved[0] - moved[1])[0] / (2.0 * step), rel=1e-7)
    moved = [sheared_gap(TURBULENT, growth * math.exp(s * step), e, -1.0, 2.0)[0] for s in (1, -1)]
    assert by_growth[0] == pytest.approx((moved[0] - moved[1])[0] / (2.0 * step), rel=1e-6)


def test_factors_are_the_law_and_powers_beyond_the_last_node():
    X = np.array([0.0, 0.01, 0.3, 2.0, 9.9])
    factors, slopes = THICK.factors(X)
    assert_allclose(factors, [[thick(each)[k] for each in X] for k in range(4)], rtol=1e-12)
    assert_allclose(slopes[3], 2.0 * X, atol=1e-8)
    beyond = THICK.factors(np.array([100.0, 200.0, 400.0]))[0][3]
    assert beyond[2] / beyond[1] == pytest.approx(beyond[1] / beyond[0], rel=1e-3)
    assert hash(mobility_of(thick)) == hash(THICK)
    assert Mobility.from_bytes(THICK.to_bytes()) == THICK


def test_impossible_mobilities_are_refused():
    with pytest.raises(InputError, match="four finite positive factors"):
        mobility_of(lambda X: (0.0, 1.0, 1.0, 1.0))
    with pytest.raises(InputError, match="four finite positive factors"):
        mobility_of(lambda X: (math.nan, 1.0, 1.0, 1.0))
    with pytest.raises(InputError, match="mobility must be a Mobility"):
        PadGridFilm(mobility=thick)
    with pytest.raises(InputError, match="must belong to a bearing"):
        ReynoldsFilm(mobility=MOVING).force(E, W, 0.6)


def test_models_that_leave_a_mobility_out_refuse_it():
    oil = {"oil": rf.Oil.iso_vg(46), "cooling": rf.Cooling(supply_temperature=318.15)}
    size = {"radius": 0.05, "length": 0.06, "clearance": 1e-4}
    eased = rf.JournalBearing(**size, **oil, grooves=GROOVES, film=ReynoldsFilm(mobility=THICK))
    for made in (rf.HeatedFilm, rf.JFOFilm):
        with pytest.raises(InputError, match="film of the bearing must have mobility=None"):
            made(bearing=eased)
        assert made(bearing=rf.JournalBearing(**size, **oil, grooves=GROOVES))
