"""The film on grids in C against a dense solution in NumPy, and as an FMU."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from scipy.optimize import nnls

from rotorfilm import FeedHole, FullFilm, Groove, JournalBearing, ReynoldsFilm, export_fmu
from rotorfilm.bearings import (
    Complementarity,
    ExtrapolatedFilm,
    FilmGeometry,
    FixedOnset,
    FreeOnset,
    HalfSommerfeld,
    MaximumGapOnset,
    Pocket,
)
from rotorfilm.bearings.films.finite_volumes import RingKernel

GROOVES = (Groove(center=0.3, width=0.35), Groove(center=3.4, width=0.0))
POCKETS = (Pocket(center=0.3, width=0.35, share=0.7), Pocket(center=2.4, width=0.0, share=0.3))
GEOMETRIES = {
    "plain": FilmGeometry(),
    "grooves": FilmGeometry(grooves=GROOVES),
    "supply": FilmGeometry(grooves=GROOVES, supply=20.0),
    "pockets": FilmGeometry(pockets=POCKETS, supply=20.0),
    "circumferential": FilmGeometry(circumferential=True, supply=20.0),
    "all": FilmGeometry(grooves=GROOVES, pockets=POCKETS[1:], circumferential=True, supply=20.0),
}
SLENDERNESS = 0.7


def angles(spans, grid, place, e):
    """Return the angles of places by the Moebius map itself."""
    a = complex(*e) / (1.0 + (1.0 - e @ e) ** 0.35)
    circle = lambda s: (np.exp(1j * s) + a) / (1.0 + np.conj(a) * np.exp(1j * s))  # noqa: E731
    start, end = spans.start, spans.start + spans.extent
    if spans.turning:
        start, end = np.angle([-complex(*e)]), np.angle([-complex(*e)]) + 2.0 * np.pi
    if spans.pinned:
        back = [(np.exp(1j * t) - a) / (1.0 - np.conj(a) * np.exp(1j * t)) for t in (start, end)]
        start = np.angle(back[0])
        end = start + ((np.angle(back[1]) - start) % (2.0 * np.pi) if len(start) > 1 else 2.0 * np.pi)
    s = start[grid.span] + (end - start)[grid.span] * place
    return np.angle(circle(s)) % (2.0 * np.pi)


def dense(film, e, w):
    """Return angles, A, right-hand side and the nodes held, of the finest grid, without a sparse trick."""
    spans, grids = film.grids(SLENDERNESS)
    grid = grids[0]
    theta, face = (angles(spans, grid, place, e) for place in (grid.line, grid.face))
    n, m = len(theta), len(grid.width)
    gap = lambda t: 1.0 - e[0] * np.cos(t) - e[1] * np.sin(t)  # noqa: E731
    A, b = np.zeros((n * m, n * m)), np.zeros(n * m)
    for i in range(n):
        after, before = (i + 1) % n, (i - 1) % n
        around = gap(face[i]) ** 3 / ((theta[after] - theta[i]) % (2.0 * np.pi))
        along = gap(theta[i]) ** 3 * ((face[i] - face[before]) % (2.0 * np.pi)) / SLENDERNESS**2
        normal = np.array([np.sin(face[i]) - np.sin(face[before]), np.cos(face[before]) - np.cos(face[i])])
        for j in range(m):
            here, beside, beyond = i * m + j, after * m + j, i * m + j + 1
            b[here] = normal @ w * grid.width[j]
            A[np.ix_([here, beside], [here, beside])] += around * grid.width[j] * np.array([[1, -1], [-1, 1]])
            A[here, here] += along * grid.conductance[j]
            if j + 1 < m:
                A[here, beyond] = A[beyond, here] = -along * grid.conductance[j]
                A[beyond, beyond] += along * grid.conductance[j]
    held = (np.arange(m) < grid.held[:, None]).ravel()
    return theta, A, b, held, np.repeat(grid.value, m) * held


def pressures(film, e, w):
    """Return angles and pressure (N, M) by least squares with bounds, or by a dense solution."""
    theta, A, b, held, pressure = dense(film, e, w)
    free = ~held
    right = (b - A @ pressure)[free]
    if film.cavitation.searched:
        lower = np.linalg.cholesky(A[np.ix_(free, free)])
        pressure[free] = nnls(lower.T, np.linalg.solve(lower, right), maxiter=10**5)[0]
    else:
        pressure[free] = np.linalg.solve(A[np.ix_(free, free)], right)
    pressure = np.maximum(pressure, 0.0) if film.cavitation.clipped else pressure
    return theta, pressure.reshape(len(theta), -1)


@pytest.mark.parametrize("name", GEOMETRIES)
@pytest.mark.parametrize(
    "cavitation", [Complementarity(), HalfSommerfeld(), FullFilm()], ids=lambda kind: type(kind).__name__
)
def test_pressure_is_that_of_a_dense_solution(cavitation, name):
    compare_with_dense(ReynoldsFilm(cells=(24, 4), cavitation=cavitation, geometry=GEOMETRIES[name]))


@pytest.mark.parametrize("start", [MaximumGapOnset(), FixedOnset(line=0.4)])
def test_pressure_of_a_film_that_starts_at_a_line(start):
    compare_with_dense(ReynoldsFilm(cells=(24, 4), film_start=start))


def compare_with_dense(film):
    for e, w in (((0.3, -0.6), (40.0, 9.0)), ((-0.88, 0.1), (-3.0, 30.0)), ((0.0, 0.0), (0.0, -5.0))):
        theta, pressure = pressures(film, np.array(e), np.array(w))
        solved = film.solve(np.array(e), np.array(w), SLENDERNESS)
        assert np.exp(1j * solved.angle) == pytest.approx(np.exp(1j * theta), abs=1e-12)
        assert solved.pressure[:, :-1] == pytest.approx(pressure, abs=1e-9 * np.abs(pressure).max())
        assert np.array_equal(solved.pressure[:, :-1] > 0.0, pressure > 0.0) or not film.cavitation.searched


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("supply", [0.0, 2e5])
@pytest.mark.parametrize(
    "film",
    [ReynoldsFilm(cells=(48, 4)), ExtrapolatedFilm(film=ReynoldsFilm(cells=(32, 8)))],
    ids=["grid", "two grids"],
)
def test_the_fmu_has_the_forces_of_the_bearing(tmp_path, version, supply, film):
    sizes = {"radius": 0.05, "length": 0.05, "clearance": 1e-4, "viscosity": 0.02}
    openings = {"grooves": GROOVES, "supply_pressure": supply} if supply else {}
    path = tmp_path / "film.fmu"
    export_fmu(JournalBearing(**sizes, **openings, film=film), path, version, component="b")
    changed = {"viscosity": 0.05, "clearance": 1.2e-4}
    thick = JournalBearing(**{**sizes, **changed}, **openings, film=film)
    state = {"x": 3e-5, "y": -4e-5, "vx": 1e-3, "vy": 0.0, "speed": 200.0}
    start = {f"b.{name}": value for name, value in {**state, **changed}.items()}
    result = simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3, start_values=start)
    force = thick.force((3e-5, -4e-5), (1e-3, 0.0), 200.0)
    told = [result[f"b.force_{axis}"][-1] for axis in "xy"]
    assert told == pytest.approx(force.tolist(), rel=1e-13)


SHORT = (Groove(center=0.3, width=0.35, length=0.04), FeedHole(center=2.0, diameter=6e-3))


@pytest.mark.parametrize(
    ("start", "openings"),
    [
        (FreeOnset(), {"grooves": SHORT, "circumferential_groove": 0.002, "supply_pressure": 2e5}),
        (MaximumGapOnset(), {}),
        (FixedOnset(line=0.4), {}),
    ],
)
def test_the_fmu_has_the_openings_and_the_start_of_the_film(tmp_path, start, openings):
    film = ReynoldsFilm(cells=(48, 8), film_start=start)
    b = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, film=film, **openings)
    path = tmp_path / "film.fmu"
    export_fmu(b, path, "3.0", component="b")
    start_values = {"b.x": 3e-5, "b.y": -4e-5, "b.vx": 1e-3, "b.vy": 0.0, "b.speed": 200.0}
    result = simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3, start_values=start_values)
    told = [result[f"b.force_{axis}"][-1] for axis in "xy"]
    assert told == pytest.approx(b.force((3e-5, -4e-5), (1e-3, 0.0), 200.0).tolist(), rel=1e-12)


def test_work_of_a_potential():
    # 7.25 systems on 100, 50 and 25 lines, 154 lines factorized for a source alone: half of them are empty,
    # and the next systems of a grid keep what the moved edge does not reach. So does the next source.
    nodes = 48
    geometry = FilmGeometry(grooves=GROOVES)
    film = ReynoldsFilm(cells=(96, 8), geometry=geometry)
    spans, grids = film.grids(SLENDERNESS)
    turn = 2.0 * np.pi * np.arange(nodes) / nodes
    kernel = RingKernel(SLENDERNESS, spans, grids, Complementarity())
    e, w = np.array([0.3, 0.4]), np.stack([np.cos(turn), np.sin(turn)])
    found = kernel.potential(e, w, slopes=False)
    assert 6 * nodes <= found.solutions <= 7.3 * nodes
    assert found.lines <= 110 * nodes
    assert found.slope.size == 0
    alone = [kernel.potential(e, one[:, None], slopes=False) for one in w.T]
    assert sum(one.solutions for one in alone) == found.solutions
    assert 140 * nodes <= sum(one.lines for one in alone) <= 155 * nodes
    np.testing.assert_array_equal(np.hstack([one.value for one in alone]), found.value)


def test_tangents_are_the_forces_and_derivatives_of_the_film():
    film = ReynoldsFilm(cells=(48, 4), geometry=FilmGeometry(grooves=GROOVES))
    rng = np.random.default_rng(3)
    e, w = rng.uniform(-0.6, 0.6, (2, 5)), rng.normal(size=(2, 5))
    force, slopes = RingKernel(SLENDERNESS, *film.grids(SLENDERNESS), film.cavitation).tangents(e, w)
    np.testing.assert_array_equal(force, film.extrapolated(e, w, SLENDERNESS)[0])
    np.testing.assert_array_equal(slopes, film.jacobian(e, w, SLENDERNESS))
