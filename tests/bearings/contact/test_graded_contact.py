"""Graded cells and the midpoint rule of the source: a reproduction of its scheme of a lubricated contact."""

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.bearings.contact import ContactGrid, FixedSteps, PointContact, StaggeredScheme

SIDES = {"inlet": -3.0, "outlet": 1.5, "half_width": 2.0}
LATTICE = 1.6155
"""What the midpoint rule lacks of the integral of 1/r at corners of square cells, per size of a cell."""

pytestmark = pytest.mark.filterwarnings("ignore:pressure must not alternate")


def contact(cells, *, midpoint=False, focus=None, **sides):
    grid = ContactGrid(cells=(cells, cells), focus=focus, **{**SIDES, **sides})
    return PointContact(V=0.1, Q0=5.0, grid=grid, scheme=StaggeredScheme(midpoint=midpoint))


def test_cells_grow_away_from_the_center_and_fill_the_rectangle():
    grid = ContactGrid(cells=(40, 20), focus=0.5, **SIDES)
    (x, y), (dx, dy) = grid.lines, grid.widths
    assert (x[0], x[-1], y[0], y[-1]) == pytest.approx((-3.0, 1.5, 0.0, 2.0))
    assert 0.0 in x
    assert dx.sum() == pytest.approx(4.5)
    assert np.all(np.diff(dy) > 0.0)
    assert dx[0] / dx.min() == pytest.approx(np.hypot(0.5, 2.9) / 0.5, rel=0.05)
    assert grid.spacing == (dx.min(), dy.min())


@pytest.mark.parametrize("midpoint", [False, True])
def test_hardly_graded_cells_are_equal_cells(midpoint):
    """The dense matrices and the direct solution are those of the convolution and the iteration."""
    sides = {"inlet": -2.5, "outlet": 1.5}
    equal, graded = (
        contact(24, midpoint=midpoint, focus=focus, **sides).stationary() for focus in (None, 1e4)
    )
    assert graded.central_film == pytest.approx(equal.central_film, rel=1e-5)
    assert graded.delta == pytest.approx(equal.delta, rel=1e-6)
    assert graded.pressure == pytest.approx(equal.pressure, abs=1e-5)


@pytest.mark.closed_form
@pytest.mark.parametrize("focus", [None, 0.5])
def test_the_midpoint_rule_lacks_its_lattice_constant(focus):
    """At the center of a Hertzian pressure, whose deflection is 2, by cells that are nearly square there."""
    sides = {"inlet": -2.0, "outlet": 2.0, "half_width": 2.0}
    exact, rule = (contact(48, midpoint=m, focus=focus, **sides).equations for m in (False, True))
    x, y = exact.grid.x[:, None], exact.grid.y
    hertz = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0)).ravel()
    assert exact.sampling.center @ hertz == pytest.approx(2.0, rel=5e-3)
    lacking = (exact.sampling.center - rule.sampling.center) @ hertz
    size = exact.grid.spacing[0]
    assert lacking == pytest.approx(LATTICE * 4.0 / np.pi**2 * size, rel=0.03)


@pytest.mark.literature
def test_rest_of_the_source_by_its_own_scheme():
    """H0 = 0.1761 and delta = -1.793 (Panovko 2011); its rectangle and its grading are not given.

    Their sum is that of the midpoint rule. Exact integrals miss it on any of these cells.
    """
    own, exact = (contact(40, midpoint=midpoint, focus=0.5).stationary() for midpoint in (True, False))
    assert own.central_film - own.delta == pytest.approx(0.1761 + 1.793, rel=5e-4)
    assert own.delta == pytest.approx(-1.793, rel=2e-3)
    assert own.central_film == pytest.approx(0.1761, rel=0.02)
    assert exact.central_film - exact.delta > 1.985


def test_a_contact_on_graded_cells_moves_as_on_equal_ones():
    sides = {"inlet": -2.5, "outlet": 1.5}
    paths, steps = [], FixedSteps(step=0.1)
    for focus in (None, 1e4):
        one = contact(16, focus=focus, **sides)
        run = one.simulate(one.stationary(), duration=0.6, W=1.0, load=1.1, control=steps)
        paths.append(run.final.delta)
    assert paths[1] == pytest.approx(paths[0], rel=1e-5)


def test_graded_cells_are_for_the_staggered_scheme():
    with pytest.raises(InputError, match=r"scheme must be StaggeredScheme\(\) on graded cells"):
        PointContact(V=0.1, Q0=5.0, grid=ContactGrid(focus=0.5))
    with pytest.raises(InputError, match="focus must be"):
        ContactGrid(focus=-1.0)
