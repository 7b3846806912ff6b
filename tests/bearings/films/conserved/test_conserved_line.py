"""Films along a line: a slider with a pocket, the long bearing, plates that open and shut."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from rotorfilm import Groove
from rotorfilm.bearings import FilmGeometry
from rotorfilm.bearings.films.mass_conserving import (
    ConservedCells,
    ConservedFilm,
    Gap,
    conserved_cells,
    step_storage,
)


def open_line(places):
    """Return the cells of a film between two ends that are held, one along it."""
    opening = np.full((len(places), 1), -1, dtype=np.int32)
    opening[0], opening[-1] = 0, 1
    return ConservedCells(places, np.diff(places, append=places[-1] + 1.0), np.ones(1), opening)


def along_line(here, at_faces):
    """Return the gap of a film with one cell along it."""
    return Gap(here[:, None], at_faces[:, None], np.column_stack([here, here]))


class Slider:
    """Fowell et al. (2007), as in E. Hansen's study: lengths in 10 mm, gaps in um, U = 1 m/s."""

    unit = 12.0 * 0.01 * (0.01 / 1e-6) ** 2  # Pa s

    def __init__(self, cells, supply):
        self.x = np.linspace(0.0, 1.0, cells + 1)
        grid = open_line(self.x)
        film = ConservedFilm(grid, np.inf, supply([1e5 / self.unit] * 2))
        self.state = film.solve(along_line(self.gap(self.x), self.gap(grid.face)), 0.5 / 0.01)
        empty = self.state.solution.full[:, 0] == 0
        carried = self.state.solution.theta[:, 0] * self.gap(grid.face)
        self.flow = 0.5 * np.median(carried[empty]) * 1e-6

    @staticmethod
    def gap(x):
        pocket = (x > 0.2) & (x < 0.5)
        return 1.05 - 0.05 * x + pocket

    def pressure(self, x):
        return np.interp(x, self.x, self.state.solution.pressure[:, 0]) * self.unit


@pytest.mark.literature
def test_slider_with_pocket(supply):
    slider = Slider(800, supply)
    assert slider.flow == pytest.approx(5.229635e-7, rel=1e-7)
    published = [0.18180334e6, 2.7425326e6, 9.8088188e6, 5.947506e6]
    np.testing.assert_allclose(slider.pressure([0.1, 0.4, 0.5, 0.75]), published, rtol=3e-8)
    full = slider.state.solution.full[:, 0] != 0
    assert slider.x[~full].min() == 0.2
    assert slider.x[~full].max() == pytest.approx(0.36112627, abs=1.3e-3)


def long_bearing(eps, supply):
    """Return rupture, reformation [rad], and H_r of the film of a line groove at the widest gap."""

    def gap(xi):
        return 1.0 + eps * np.cos(xi)

    def rise(start, end, thickness):
        return quad(lambda xi: (gap(xi) - thickness) / gap(xi) ** 3, start, end, epsabs=1e-13)[0]

    def at_rupture(thickness):
        rupture = 2.0 * np.pi - np.arccos((thickness - 1.0) / eps)
        return rise(0.0, rupture, thickness) + 2.0 * supply

    thickness = brentq(at_rupture, 1.0 - 0.99 * eps, 1.0 - 0.3 * eps, xtol=1e-14)
    rupture = 2.0 * np.pi - np.arccos((thickness - 1.0) / eps)
    reform = brentq(lambda xi: rise(xi, 2.0 * np.pi, thickness) - 2.0 * supply, rupture, 2.0 * np.pi)
    return rupture, reform, thickness


@pytest.mark.closed_form
def test_long_bearing(film_of):
    eps, pressure = 0.5, 0.02
    rupture, reform, thickness = long_bearing(eps, pressure)
    np.testing.assert_allclose(np.degrees([rupture, reform]), [220.2981, 351.2385], atol=1e-3)
    assert thickness == pytest.approx(0.618655, abs=1e-6)
    for lines, tolerance in ((180, 2e-3), (720, 2e-4)):
        film = film_of(FilmGeometry(grooves=(Groove(center=0.0),), supply=pressure), (lines, 4), np.inf)
        gap = film.gap(np.array([-eps, 0.0]))
        state = film.solve(gap, 0.5)
        F = film.force(state)
        assert np.hypot(*F) / 2.0 == pytest.approx(3.394360, rel=tolerance)
        attitude = np.pi - np.arctan2(-F[1], -F[0])
        assert np.degrees(attitude) == pytest.approx(60.6265, rel=tolerance)
        empty = film.cells.angle[state.solution.full[:, 0] == 0]
        np.testing.assert_allclose([empty.min(), empty.max()], [rupture, reform], atol=12.0 / lines)
        carried = state.solution.theta * gap.face
        empty_cells = np.flatnonzero(state.solution.full[:, 0] == 0)[:-1]  # the last is full in part
        np.testing.assert_allclose(carried[empty_cells], thickness, rtol=tolerance)


class Plates:
    """h = .375 + .125 cos 4 pi t over |x| < .5, p(.5) = .025; 2 d(theta h)/dt = (h^3 p')': p is twice P."""

    p0 = 0.025

    def __init__(self, cells, steps, supply):
        x = np.linspace(-0.5, 0.5, cells + 1)
        grid = open_line(x)
        self.film = ConservedFilm(grid, np.inf, supply([0.5 * self.p0] * 2))
        self.x, self.area = x, grid.area[:, 0]
        self.times = np.linspace(0.25, 0.75, steps + 1)
        self.loads, self.edges = [], []
        self._run()

    @staticmethod
    def gap(t):
        return 0.375 + 0.125 * np.cos(4.0 * np.pi * t)

    @staticmethod
    def rate(t):
        return -0.5 * np.pi * np.sin(4.0 * np.pi * t)

    def _run(self):
        wide, dt = np.ones(self.x.size), self.times[1] - self.times[0]
        now, before, guess = np.full((self.x.size, 1), self.gap(0.25)), None, None
        for t in self.times[1:]:
            h = self.gap(t) * wide
            storage = step_storage(dt, now, before)
            state = self.film.solve(along_line(h, h), 0.0, storage=storage, guess=guess)
            now, before, guess = state.content, now, state.solution.full
            P = state.solution.pressure[:, 0]
            inner = np.abs(self.x) < 0.5
            ends = 0.5 * (self.x[1] - self.x[0]) * self.p0
            self.loads.append(np.sum((2.0 * P * self.area)[inner]) / 2.0 + ends)
            empty = np.abs(self.x[state.solution.full[:, 0] == 0])
            self.edges.append(empty.max(initial=0.0))

    def opening(self, t):
        """Return S while the cavity opens."""
        return 0.5 - np.sqrt(self.gap(t) ** 3 * self.p0 / self.rate(t))

    def load(self, t, S):
        """Return the load on half the plate with a cavity to S, its film of p(S) = 0, p(.5) = p0."""
        a, h3 = 2.0 * self.rate(t), self.gap(t) ** 3
        width = 0.5 - S
        slope = (h3 * self.p0 - 0.5 * a * width**2) / width
        return (a * width**3 / 6.0 + 0.5 * slope * width**2) / h3

    def shutting(self, start, S):
        """Return S over time from where it is largest: the film outside fills what is empty inside."""

        def left(place):
            return brentq(lambda t: self.opening(t) - place, 0.25 + 8e-5, start, xtol=1e-13)

        def speed(t, S):
            width = 0.5 - S[0]
            slope = self.gap(t) ** 3 * self.p0 / width - self.rate(t) * width
            return [-slope / (2.0 * (self.gap(t) - self.gap(left(S[0]))))]

        return solve_ivp(speed, (start + 2e-3, 0.7), [S - 1e-7], rtol=1e-8, dense_output=True).sol


@pytest.mark.closed_form
def test_plates_that_open_and_shut(supply):
    plates = Plates(800, 500, supply)
    times = plates.times[1:]
    growing = (times > 0.26) & (times < 0.31)
    np.testing.assert_allclose(np.array(plates.edges)[growing], plates.opening(times[growing]), atol=6e-3)
    turn = 0.314826
    assert plates.opening(turn) == pytest.approx(0.476992, abs=1e-6)
    for t, published in ((0.4, 2.67179e-4), (0.6, 1.65517e-3), (0.7, 4.37073e-2)):
        assert np.interp(t, times, plates.loads) == pytest.approx(published, rel=0.015)
    shut = plates.shutting(turn, 0.476992)
    for t in (0.45, 0.55, 0.65):
        S = float(shut(t)[0])
        assert np.interp(t, times, plates.edges) == pytest.approx(S, abs=6e-3)
        assert np.interp(t, times, plates.loads) == pytest.approx(plates.load(t, S), rel=0.03)
    assert max(plates.edges[k] for k in np.flatnonzero(times > 0.738)) == 0.0


@pytest.mark.closed_form
def test_circumferential_groove_feeds_two_lands(film_of):
    # A centered film is full: what enters at mid-length leaves at the ends under a pressure linear between.
    film = film_of(FilmGeometry(supply=0.02, circumferential=True), slenderness=0.5)
    state = film.solve(film.gap(np.zeros(2)), 0.5)
    axial = film.cells.axial
    np.testing.assert_allclose(state.solution.pressure, np.tile(0.02 * (1.0 - axial), (72, 1)), rtol=1e-12)
    flows = film.flows(state)
    assert flows.inflow[-1] == pytest.approx(2.0 * np.pi * 0.02 / 0.5**2, rel=1e-12)
    assert flows.out == pytest.approx(flows.inflow[-1], rel=1e-12)


def test_edges_are_lines_and_ends_are_faces():
    cells = conserved_cells(FilmGeometry(grooves=(Groove(center=1.0, width=0.3),)), 100, 10)
    held = cells.angle[cells.opening[:, 0] == 0]
    np.testing.assert_allclose([held[0], held[-1]], [0.85, 1.15])
    assert cells.extent.sum() == pytest.approx(2.0 * np.pi)
    assert cells.width.sum() == pytest.approx(1.0)
