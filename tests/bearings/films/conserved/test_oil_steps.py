"""Steps in time of a film that conserves its oil: any lengths, slugs, films that stand."""

from ctypes import byref
from typing import NamedTuple

import numpy as np
import pytest

from rotorfilm.bearings import FilmGeometry, Pocket
from rotorfilm.bearings.films.mass_conserving import (
    FILM,
    ConservedCells,
    ConservedFilm,
    ConservedState,
    OilSolution,
    address,
    in_c,
    report_search,
    step_storage,
)
from rotorfilm.core.time_steps import bdf2
from rotorfilm.native import loops

TOP = FilmGeometry(pockets=(Pocket(center=np.pi / 2.0, width=np.radians(20.0), share=0.8),), supply=0.05)


class History(NamedTuple):
    """What a film knows of its past: theta H now and one step ago, the length of that step, the film."""

    content: np.ndarray
    before: np.ndarray
    length: float
    theta: np.ndarray
    full: np.ndarray


def after_step(memory, state, dt):
    return History(state.content, memory.content, dt, *state.solution[1:3])


def in_compiled_code(search, film, gap, rate, near, *further):
    """Return the film that a function of `oil_steps.h` finds, near theta and full cells of another one."""
    theta, full = (np.array(row) for row in near)
    pressure, old = np.empty((2, *theta.shape))
    made = in_c("rf_oil_found", pressure, theta, full, old)
    report_search(loops()[search](byref(film.shape), byref(gap.struct), rate, *further, byref(made)))
    equations = film.equations(gap, rate, (made.rate, old / film.cells.area))
    return ConservedState(gap, rate, equations, OilSolution(pressure, theta, full, 0, 0), made.rate, made.lag)


def oil_step(film, memory, gap, rate, dt):
    past = in_c("rf_oil_past", memory.content, memory.before, memory.length)
    return in_compiled_code("rf_oil_step", film, gap, rate, memory[3:], byref(past), dt)


def steady_oil(film, gap, rate):
    none = np.zeros(film.cells.opening.shape)
    return in_compiled_code("rf_oil_rest", film, gap, rate, (none, none.astype(np.uint8)))


def sharpened_oil(film, gap, rate, theta):
    """Return what leaves the cells beyond transport at upstream theta."""
    carried, theta = np.empty(film.cells.opening.shape), np.ascontiguousarray(theta)
    loops()["rf_sharpen_oil"](byref(film.shape), byref(gap.struct), rate, address(theta), address(carried))
    return carried


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.0])
def test_differences_are_exact_on_parabolas(ratio):
    newest, last, older = bdf2(ratio)
    before = -1.0 / ratio
    for power, slope in ((0, 0.0), (1, 1.0), (2, 2.0)):
        assert newest + last * 0.0**power + older * before**power == pytest.approx(slope, abs=1e-14)


def ring(lines, supply):
    """Return the film on equal cells, without any opening."""
    spacing = np.full(lines, 2.0 * np.pi / lines)
    opening = np.full((lines, 4), FILM, dtype=np.int32)
    cells = ConservedCells(spacing * np.arange(lines), spacing, np.full(4, 0.25), opening)
    return ConservedFilm(cells, 0.5, supply([]))


def carried_slug(lines, limited, supply, turns=150.0 / 360.0):
    """Return a slug of oil that a cavity has carried by a part of a turn, as it was, and as it should be."""
    film = ring(lines, supply)
    angle, gap = film.cells.angle, film.gap(np.zeros(2))
    theta = np.tile(0.3 + 0.5 * np.exp(-(((angle - 1.5) / np.radians(15.0)) ** 2))[:, None], (1, 4))
    memory = History(theta, theta, 0.0, theta, np.zeros(theta.shape, dtype=np.uint8))
    steps = 2 * lines
    for _ in range(steps):
        dt = turns * 2.0 * np.pi / 0.5 / steps
        state = (
            oil_step(film, memory, gap, 0.5, dt)
            if limited
            else film.solve(
                gap, 0.5, storage=step_storage(dt, memory.content, memory.before if memory.length else None)
            )
        )
        memory = after_step(memory, state, dt)
    shifted = (angle - 1.5 - 2.0 * np.pi * turns + np.pi) % (2.0 * np.pi) - np.pi
    exact = 0.3 + 0.5 * np.exp(-((shifted / np.radians(15.0)) ** 2))
    return memory.theta, theta, exact


@pytest.mark.convergence
def test_a_slug_of_oil_crosses_the_cavity(supply):
    errors, kept = [], []
    for lines in (72, 144):
        moved, first, exact = carried_slug(lines, True, supply)
        assert moved.sum() == pytest.approx(first.sum(), rel=1e-12)
        assert 0.3 - 1e-6 < moved.min() <= moved.max() < 0.8
        errors.append(np.abs(moved[:, 0] - exact).mean())
        kept.append((moved.max() - 0.3) / 0.5)
    blurred, _, exact = carried_slug(144, False, supply)
    assert np.log2(errors[0] / errors[1]) > 1.5
    assert errors[1] < 0.3 * np.abs(blurred[:, 0] - exact).mean()
    assert kept[1] > 0.85


@pytest.mark.parametrize("rate", [0.5, -0.5, 0.0])
def test_a_steady_film_stands(film_of, rate):
    film = film_of(TOP, (36, 4))
    gap = film.gap(np.array([0.35, -0.45]))
    state = steady_oil(film, gap, rate)
    memory = History(state.content, state.content, 0.0, *state.solution[1:3])
    for dt in (0.1, 0.15, 1.0, 0.01):
        after = oil_step(film, memory, gap, rate, dt)
        np.testing.assert_allclose(after.solution.theta, state.solution.theta, atol=1e-11)
        np.testing.assert_allclose(film.force(after), film.force(state), rtol=1e-9)
        memory = after_step(memory, after, dt)
    assert film.flows(state).defect < 1e-12


@pytest.mark.closed_form
def test_the_other_sense_of_rotation_is_the_mirror_image(supply):
    theta = np.random.default_rng(3).uniform(0.2, 1.0, (36, 4))
    film = ring(36, supply)
    # The mirror image of a line is the last but that line; the gap is that of a centered journal.
    gap = film.gap(np.zeros(2))
    there, turned = sharpened_oil(film, gap, 0.5, theta), sharpened_oil(film, gap, -0.5, theta[::-1])[::-1]
    np.testing.assert_allclose(turned, there, atol=1e-13)
    assert np.abs(there).max() > 1e-2 * film.cells.area.max()
    np.testing.assert_allclose(there.sum(), 0.0, atol=1e-14)


@pytest.mark.closed_form
def test_the_last_cell_before_a_film_has_no_slope(supply):
    # Its theta tells how far the film reaches into it, and what leaves is that of upstream transport.
    film = ring(36, supply)
    gap = film.gap(np.zeros(2))
    arriving = np.linspace(0.4, 0.5, 11)
    leaves = []
    for fill in (0.0, 0.3, 0.7, 1.0 - 1e-9, 1.0):
        theta = np.ones((36, 4))
        theta[10:21] = arriving[:, None]
        theta[21] = 0.51 + 0.49 * fill
        leaves.append(sharpened_oil(film, gap, 0.5, theta)[:, 0])
    faces = np.cumsum(leaves, axis=1)  # through the face after a cell, beyond what its theta carries
    scale = 0.5 * 0.01 * film.cells.width[0]
    np.testing.assert_allclose(faces[:, 21], 0.0, atol=1e-12 * scale)
    np.testing.assert_allclose(faces[:, 19], 0.5 * scale, rtol=1e-9)  # half of its rise per cell
    shares = np.array([1.0, 0.7, 0.3, 0.0, 0.0])
    np.testing.assert_allclose(faces[:, 20], 0.5 * scale * shares, atol=1e-8 * scale)


def test_a_cell_never_gives_more_oil_than_it_has(supply):
    # Of a cell that had 1 and has .1, differences of second order would leave less than nothing.
    film = ring(36, supply)
    gap = film.gap(np.zeros(2))
    now, before = np.full((36, 4), 0.1), np.full((36, 4), 0.9)
    memory = History(now, before, 0.1, now, np.zeros(now.shape, dtype=np.uint8))
    state = oil_step(film, memory, gap, 0.5, 0.1)
    np.testing.assert_allclose(state.content, 0.1, rtol=1e-12)
