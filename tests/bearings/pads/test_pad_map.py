"""The map of a pad against its two-dimensional film, its symmetries, its edges, and bearings made of pads."""

import dataclasses
from functools import cache

import numpy as np
import pytest

from rotorfilm import Groove, InputError
from rotorfilm.bearings import FilmGeometry, PadResolution, aligned_openings
from rotorfilm.bearings.films import map_fit as table_pieces
from rotorfilm.bearings.journal.groove_map import GrooveMap, Resolution
from rotorfilm.bearings.pads.pad_build import (
    FINE,
    LEAST_FILMS,
    ORDER,
    PadMap,
    along_nodes,
    between_nodes,
    node_angles,
    node_places,
    pad_errors,
    pad_grid,
    pad_states,
    seen_film,
)
from rotorfilm.bearings.pads.pad_table import least_film, wall
from rotorfilm.native import Status

DEGREE = np.pi / 180.0
COARSE = PadResolution(cells=(16, 4), nodes=(6, 6, 12), xi_range=(-0.3, 0.9))


@cache
def table(*shape):
    """Return a map, made once."""
    return PadMap(*shape).built()


shapes = pytest.mark.parametrize(
    ("extent", "slenderness"),
    [(100, 0.5), *(pytest.param(*shape, marks=pytest.mark.long) for shape in ((60, 0.25), (150, 1.0)))],
)


@cache
def checked(extent, slenderness):
    """Return random states of the whole range of a map, and its film on finer grids there."""
    of = table(extent * DEGREE, slenderness, FINE)
    states = random_states(of, 200)
    films = [seen_film(of.extent, slenderness, (192, 16), phi) for phi in states.phi.tolist()]
    parts = [film.reference(states.e[:, [k]], states.w[:, [k]]) for k, film in enumerate(films)]
    return of, states, np.concatenate(parts, axis=1)


def random_states(of, count, seed=1):
    """Return states at random in the coordinates of a map."""
    rng = np.random.default_rng(seed)
    states = pad_states(of.extent, of.u_range, of.y_end, count)
    xi = -np.expm1(-rng.uniform(*of.u_range, count))
    eta = np.tanh(rng.uniform(-of.y_end, of.y_end, count)) * wall(xi, of.extent)
    phi = rng.uniform(-0.5, 0.5, count) * (np.pi + of.extent)
    return states._replace(e=np.stack([xi, eta]), w=np.stack([np.cos(phi), np.sin(phi)]), phi=phi)


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


@pytest.mark.long
@pytest.mark.convergence
@shapes
def test_map_is_the_film(extent, slenderness):
    """Force within 1e-3 in 90 % of all states and 5e-3 in 99 %; K and C by their largest entries."""
    of, states, exact = checked(extent, slenderness)
    force, slopes = pad_errors(of, states, exact)
    assert (np.quantile(force, [0.5, 0.9, 0.99]) < [1e-4, 1e-3, 5e-3]).all()
    assert (np.quantile(slopes, [0.5, 0.95]) < [3e-3, 2e-2]).all()


@shapes
def test_bounds_hold_for_other_states(extent, slenderness):
    of, states, exact = checked(extent, slenderness)
    films = least_film(states.e, of.extent)
    for errors, slopes in zip(pad_errors(of, states, exact), (False, True), strict=True):
        bounds = np.array([of.bound(film, slopes=slopes) for film in films])
        assert np.mean(errors <= bounds) > 0.985
        assert (errors <= 3.0 * bounds).all()
    assert np.isinf(of.bound(-1e-9, slopes=False))
    np.testing.assert_array_equal(of.bounds[:, 0], LEAST_FILMS)


@pytest.mark.long
@pytest.mark.literature
@pytest.mark.parametrize(
    ("extent", "nodes", "median", "most"),
    [(100, (6, 6, 24), 9e-4, 1.7e-2), (100, (10, 9, 32), 1e-4, 3e-3), (100, (12, 9, 64), 3e-5, 4e-4)],
)
def test_errors_are_those_of_the_prototype(extent, nodes, median, most):
    """Errors of force, median and 90 %, as another film on other grids with a spline of its own had them.

    That one solved 8 x 9, 12 x 13 and 16 x 13 nodes over u and Y: slopes are worth nodes.
    """
    resolution = PadResolution(nodes=nodes, xi_range=(-0.5, 0.95))
    of = table(extent * DEGREE, 0.5, resolution)
    states = random_states(of, 150)
    films = [seen_film(of.extent, 0.5, (96, 8), phi) for phi in states.phi.tolist()]
    parts = [film.reference(states.e[:, [k]], states.w[:, [k]]) for k, film in enumerate(films)]
    force, _ = pad_errors(of, states, np.concatenate(parts, axis=1))
    assert np.median(force) < 2.0 * median
    assert 0.3 * most < np.quantile(force, 0.9) < 2.0 * most


@pytest.mark.convergence
def test_potential_converges_with_the_cells():
    """Order of the potential extrapolated from two grids, on all of the pad and on an end of it."""
    extent, e = 100.0 * DEGREE, np.array([0.5, 0.2])
    for phi in (1.4, 0.5 * (np.pi + extent) - 0.1):
        levels = [
            seen_film(extent, 0.5, cells, phi).levels(e, np.array([phi]))[0, 0]
            for cells in ((32, 4), (64, 8), (128, 16), (512, 64))
        ]
        gaps = np.abs(np.array(levels[:3]) - levels[3])
        assert np.log2(gaps[0] / gaps[2]) / 2.0 == pytest.approx(ORDER, abs=1.2)


@pytest.mark.closed_form
@pytest.mark.parametrize("nodes", [6, 9])
def test_values_between_nodes_are_exact_to_degree_seven(nodes):
    polynomial = np.polynomial.Polynomial([0.3, -1.0, 0.7, 0.2, -0.5, 0.1, 0.4, -0.2])
    at = np.linspace(-1.0, 1.2, nodes)
    found = between_nodes(polynomial(at), polynomial.deriv()(at), at[1] - at[0])
    np.testing.assert_allclose(found, polynomial(np.linspace(-1.0, 1.2, 2 * nodes - 1)), rtol=1e-12)


@pytest.mark.parametrize("phi", [0.4, 0.5 * (np.pi + 1.5) - 0.1])
def test_slopes_of_the_potential_are_those_over_the_nodes(phi):
    """By e of the film, on all of the pad and on its end, and from there by u and Y."""
    extent, step, at = 1.5, 1e-5, np.array([phi])
    film = seen_film(extent, 0.5, (96, 8), phi)

    def level(u, y):
        e = node_places(extent, -np.expm1(-np.array([u])), np.tanh(np.array([y])))
        return film.levels(e[:, 0, 0], at)

    for u, y in ((0.8, 0.5), (-0.3, -0.7)):
        e, share = -np.expm1(-np.array([u])), np.tanh(np.array([y]))
        found = along_nodes(level(u, y)[1:, None, None, 0], extent, e, share).ravel()
        exact = [
            (level(u + step, y) - level(u - step, y))[0, 0] / (2.0 * step),
            (level(u, y + step) - level(u, y - step))[0, 0] / (2.0 * step),
        ]
        np.testing.assert_allclose(found, exact, rtol=5e-5)


@shapes
def test_film_at_the_edge_of_a_pad_is_that_on_its_end(extent, slenderness):
    """The film on the end of a pad, and the map, against that on all of the pad with many cells."""
    of, extent = table(extent * DEGREE, slenderness, FINE), extent * DEGREE
    whole = pad_grid(extent, slenderness, (1024, 8))
    e = np.array([[0.4], [0.3]])
    for side in (1.0, -1.0):
        phi = side * (0.5 * (np.pi + extent) - 0.15)
        w = np.array([[np.cos(phi)], [np.sin(phi)]])
        end = seen_film(extent, slenderness, (96, 8), phi)
        assert abs(end.turn) > 0.0
        exact = whole.tangents(e, w)[0]
        size = np.hypot(*exact)
        assert np.hypot(*(end.reference(e, w)[:2] - exact)) < 1e-3 * size
        assert np.hypot(*(of.kernel().force(e, w).values - exact)) < 5e-3 * size


def test_mirror():
    of = table(100 * DEGREE, 0.5, FINE)
    states, across = random_states(of, 50), np.array([[1.0], [-1.0]])
    kernel = of.kernel()
    force = kernel.force(states.e, states.w).values
    size = np.hypot(*force)
    image = across * kernel.force(across * states.e, across * states.w).values
    np.testing.assert_array_less(np.hypot(*(image - force)), 1e-11 * size + 1e-300)


def test_nodes_are_met():
    """The map is the extrapolated potential at its nodes, mirrored ones too."""
    of = table(100 * DEGREE, 0.5, COARSE)
    e = node_places(of.extent, *COARSE.places)
    for i, j, k in ((0, 0, 0), (5, 5, 11), (3, 2, 7), (2, 4, 1)):
        phi = node_angles(of.extent, 12)[k]
        w = np.array([np.cos(phi), np.sin(phi)])
        level = seen_film(of.extent, 0.5, COARSE.cells, phi).levels(e[:, i, j], np.array([phi]))[0, 0]
        force = of.kernel().force(e[:, [i], [j]], w[:, None])
        assert force.status == Status.OK
        assert -0.5 * force.values[:, 0] @ w == pytest.approx(np.exp(level), rel=1e-9)


def test_beyond_the_unit_circle_and_at_contact():
    of, film = table(60 * DEGREE, 0.25, FINE), pad_grid(60 * DEGREE, 0.25, (192, 16))
    e, w = np.array([[-0.46], [1.07]]), np.array([[0.535], [0.23]])
    found, exact = of.kernel().force(e, w), film.force(e, w)
    assert found.status == exact.status == Status.OK
    np.testing.assert_allclose(found.values, exact.values, atol=1e-3 * np.abs(exact.values).max())
    for xi in (-0.9, 0.3, 0.87, 0.96):
        for side in (1.0, -1.0):
            edge = float(wall(xi, of.extent))
            inside, outside = (np.array([[xi], [side * edge * part]]) for part in (1.0 - 1e-12, 1.0 + 1e-12))
            assert least_film(outside, of.extent)[0] < 0.0 < least_film(inside, of.extent)[0]
            assert of.kernel().force(inside, w).status == Status.OUTSIDE
            assert of.kernel().force(outside, w).status == Status.AT_WALL


@pytest.mark.long
def test_two_pads_without_preload_are_the_map_with_two_openings():
    extent = 160.0 * DEGREE
    geometry = FilmGeometry(grooves=tuple(Groove(center=at, width=20.0 * DEGREE) for at in (0.0, np.pi)))
    openings = aligned_openings(geometry)
    bore = GrooveMap(openings, 0.5, Resolution((96, 8), (12, 48, 48), 0.95)).built()
    grooved = bore.kernel(openings.axis)
    rng, kernel = np.random.default_rng(2), table(extent, 0.5, FINE).kernel()
    chi, at, phi = rng.uniform((0.0, -np.pi, -np.pi), (0.8, np.pi, np.pi), (100, 3)).T
    e, w = chi * np.stack([np.cos(at), np.sin(at)]), np.stack([np.cos(phi), np.sin(phi)])
    force, slopes = np.zeros((2, 100)), np.zeros((2, 4, 100))
    for middle in (0.5 * np.pi, 1.5 * np.pi):
        back = turned(middle)
        f, by = kernel.force(back.T @ e, back.T @ w), kernel.jacobian(back.T @ e, back.T @ w)
        assert f.status <= Status.OUTSIDE
        force += back @ f.values
        slopes += np.einsum("ij,jakn,bk->iabn", back, by.values.reshape(2, 2, 2, -1), back).reshape(2, 4, -1)
    exact, by = grooved.force(e, w).values, grooved.jacobian(e, w).values
    errors = np.hypot(*(force - exact)) / np.hypot(*exact)
    assert np.median(errors) < 5e-4
    assert np.quantile(errors, 0.9) < 3e-3
    gaps = np.abs(slopes - by).max(axis=(0, 1)) / np.abs(by).max(axis=(0, 1))
    assert np.median(gaps) < 5e-3


def test_centered_journal_in_equal_pads_has_no_force_and_isotropic_coefficients():
    kernel, preload, turn = (
        table(100 * DEGREE, 0.5, FINE).kernel(),
        0.5,
        np.array([[0.0, -1.0], [1.0, 0.0]]),
    )
    force, stiffness, damping = np.zeros(2), np.zeros((2, 2)), np.zeros((2, 2))
    for middle in np.array([90.0, 210.0, 330.0]) * DEGREE:
        e = np.array([[preload], [0.0]])
        w = -0.5 * turn @ e
        back = turned(middle)
        force += back @ kernel.force(e, w).values[:, 0]
        by = kernel.jacobian(e, w).values[:, :, 0]
        stiffness -= back @ (by[:, :2] - 0.5 * by[:, 2:] @ turn) @ back.T
        damping -= back @ by[:, 2:] @ back.T
    assert np.abs(force).max() < 1e-13 * np.abs(damping).max()
    for matrix in (stiffness, damping):
        rest = matrix - matrix[0, 0] * np.eye(2) - matrix[1, 0] * turn
        assert np.abs(rest).max() < 1e-13 * np.abs(matrix).max()
    assert abs(damping[0, 1]) < 1e-13 * damping[0, 0]
    assert stiffness[1, 0] < 0.0 < stiffness[0, 0]


def test_number_of_threads_changes_no_bit(monkeypatch):
    contents = set()
    for threads in (1, 3):
        monkeypatch.setattr(table_pieces, "cores", lambda threads=threads: threads)
        contents.add(PadMap(1.1, 0.5, COARSE).built().to_bytes())
    assert len(contents) == 1


def test_making_a_map_says_how_long_it_takes():
    said = []
    PadMap(1.1, 0.5, COARSE).built(lambda fraction, text: said.append((fraction, text)))
    fractions = [fraction for fraction, _ in said]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert fractions[0] < 0.3
    assert {text for _, text in said} == {said[0][1]}
    assert said[0][1].startswith("map of the pad, about ")
    assert PadMap(1.1, 0.5, FINE).work > PadMap(1.1, 0.5, COARSE).work > 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cells": (15, 4)}, "cells must be two multiples of 4"),
        ({"nodes": (5, 6, 12)}, r"nodes must be at least \(6, 6, 12\), the last one even, got \(5, 6, 12\)"),
        ({"nodes": (6, 6, 13)}, "the last one even"),
        ({"xi_range": (0.5, 1.0)}, r"xi_range must rise to below 1, got \(0.5, 1.0\)"),
        ({"xi_range": (0.5, 0.5)}, "xi_range must rise"),
        ({"reach": 1.0}, r"reach must be in \(0, 1\), got 1.0"),
    ],
)
def test_resolution_that_breaks_a_rule_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(COARSE, **change).checked()
