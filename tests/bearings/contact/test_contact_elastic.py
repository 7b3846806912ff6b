"""The elastic kernel of a point contact against closed forms, and the scheme against its declared order."""

import numpy as np
import pytest
from scipy import integrate

from rotorfilm import InputError
from rotorfilm.bearings.contact import (
    BarusViscosity,
    ContactGrid,
    DowsonHigginsonDensity,
    RoelandsViscosity,
    StaggeredScheme,
    UpwindScheme,
)
from rotorfilm.bearings.contact.contact_grid import cell_deflection
from rotorfilm.bearings.contact.film_equations import ContactEquations, TimeDerivative
from rotorfilm.bearings.contact.stationary import dry_contact, stationary

SCHEMES = (StaggeredScheme(), UpwindScheme())
SMALL = ContactGrid(cells=(12, 8))


def equations(cells, scheme, V=0.1, Q0=5.0, viscosity=None, density=None):
    grid = ContactGrid(cells=(cells, cells))
    law = BarusViscosity() if viscosity is None else viscosity
    return ContactEquations(V=V, Q0=Q0, grid=grid, scheme=scheme, viscosity=law, density=density)


@pytest.mark.closed_form
def test_cell_deflection_is_the_integral_of_the_kernel():
    x, y, width = 0.7, -0.4, (0.3, 0.2)
    exact, _ = integrate.dblquad(
        lambda v, u: 4.0 / np.pi**2 / np.hypot(x - u, y - v), -0.15, 0.15, -0.1, 0.1, epsabs=1e-12
    )
    assert cell_deflection(np.array(x), np.array(y), width) == pytest.approx(exact, rel=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("scheme", SCHEMES)
def test_deflection_by_transform_is_the_sum_over_cells_and_mirror_images(scheme):
    sampling = scheme.sampling(SMALL)
    bend, pressure = sampling.deflection, np.random.default_rng(0).random(SMALL.shape)
    a, b = np.indices(bend.samples)
    x, y = (bend.first + a) * SMALL.spacing[0], (b + 0.5 * (not bend.corners)) * SMALL.spacing[1]
    total = np.zeros(bend.samples)
    for i, j in np.ndindex(SMALL.shape):
        for side in (1.0, -1.0):
            u, v = (i + 0.5) * SMALL.spacing[0], side * SMALL.y[j]
            total += pressure[i, j] * bend.kernel(x - u, y - v, SMALL.spacing)
    assert bend(pressure.ravel()).reshape(bend.samples) == pytest.approx(total, rel=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("scheme", SCHEMES)
def test_hertzian_pressure_carries_its_load_and_flattens_the_ball(scheme):
    contact = equations(128, scheme)
    pressure, delta = dry_contact(contact, 1.0)
    assert contact.load(pressure) == pytest.approx(2.0 * np.pi / 3.0, rel=2e-3)
    assert delta == -2.0
    assert contact.central_film(pressure, delta) == pytest.approx(0.0, abs=2e-3)
    film = contact.film(pressure, delta)
    assert np.abs(film[contact.sampling.gap < 0.8]).max() < 4e-3  # touching, but for its discretization
    assert np.all(film > -4e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("load", [0.5, 3.0])
def test_dry_contact_scales_with_the_load(load):
    contact = equations(128, UpwindScheme())
    pressure, delta = dry_contact(contact, load)
    assert contact.load(pressure) == pytest.approx(load * 2.0 * np.pi / 3.0, rel=3e-3)
    assert contact.central_film(pressure, delta) == pytest.approx(0.0, abs=3e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("law", [BarusViscosity(), RoelandsViscosity(exponent=0.6, pressure_ratio=4.0)])
def test_potential_is_the_integral_of_the_mobility(law):
    for pressure in (0.0, 0.3, 1.2):
        exact, _ = integrate.quad(
            lambda p: law.mobility(np.array(p), 7.0), pressure, 60.0, epsabs=0, limit=400
        )
        assert law.potential(np.array(pressure), 7.0) == pytest.approx(-exact, rel=1e-8)
    assert law.mobility(np.zeros(1), 7.0)[0] == 1.0
    slope = (law.mobility(np.array(1e-6), 7.0) - 1.0) / 1e-6
    assert slope == pytest.approx(-7.0, rel=1e-4)


@pytest.mark.closed_form
def test_roelands_with_exponent_one_is_barus():
    p = np.linspace(0.0, 1.5, 7)
    law = RoelandsViscosity(exponent=1.0, pressure_ratio=3.0)
    assert law.mobility(p, 5.0) == pytest.approx(BarusViscosity().mobility(p, 5.0), rel=1e-12)
    assert law.potential(p, 5.0) == pytest.approx(BarusViscosity().potential(p, 5.0), rel=1e-10)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("density", [None, DowsonHigginsonDensity(pressure_ratio=1.7)])
def test_derivatives_are_those_of_the_residual(scheme, density):
    law = RoelandsViscosity(exponent=0.6, pressure_ratio=4.0)
    contact = equations(12, scheme, viscosity=law, density=density)
    rng = np.random.default_rng(1)
    pressure, change = 0.2 + rng.random(contact.grid.shape[0] * 6), rng.normal(size=12 * 6)
    time = TimeDerivative(1.7, rng.random(12 * 6))

    def residual(step):
        p = pressure + step * change
        return contact.residual(p, contact.film(p, -1.0 + 0.3 * step), time)

    film = contact.film(pressure, -1.0)
    by_pressure, by_film = contact.derivatives(pressure, film, time.rate)
    exact = by_pressure @ change + by_film @ (contact.sampling.deflection(change) + 0.3)
    differences = (8.0 * (residual(1e-3) - residual(-1e-3)) - residual(2e-3) + residual(-2e-3)) / 12e-3
    assert exact == pytest.approx(differences, rel=1e-7, abs=1e-7 * np.abs(exact).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("scheme", SCHEMES)
def test_nothing_is_lost_between_cells(scheme):
    contact = equations(16, scheme)
    pressure = np.random.default_rng(2).random(16 * 8)
    pressure.reshape(16, 8)[[0, -1]] = 0.0  # no pressure at inlet and outlet: surfaces carry all there
    pressure.reshape(16, 8)[:, -1] = 0.0
    film = contact.film(pressure, 0.1)
    pushed = contact.residual(pressure, film, TimeDerivative())
    carried = contact._carried(film).reshape(17, 8)
    dx, dy = contact.grid.spacing
    outflow = contact.V * (carried[-1] - carried[0]).sum() * dy
    assert -pushed.sum() * dx * dy == pytest.approx(outflow, rel=1e-12)


@pytest.mark.convergence
@pytest.mark.parametrize("scheme", SCHEMES)
def test_space_converges_at_the_declared_order(scheme):
    delta = [stationary(equations(cells, scheme), 1.0).delta for cells in (32, 64, 128)]
    order = np.log2((delta[1] - delta[0]) / (delta[2] - delta[1]))
    assert scheme.order - 0.2 < order < scheme.order + 0.5


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cells": (40, 41)}, "cells must be two integers"),
        ({"cells": (4, 8)}, "cells must be two integers"),
        ({"inlet": -0.9}, "inlet must be before the dry contact, below -1, got -0.9"),
        ({"outlet": 0.5}, "outlet must be past the dry contact, above 1, got 0.5"),
        ({"half_width": 0.9}, "half_width must cover the dry contact, above 1, got 0.9"),
    ],
)
def test_grid_names_the_broken_rule(change, message):
    with pytest.raises(InputError, match=message):
        ContactGrid(**change)


def test_fluids_name_the_broken_rule():
    with pytest.raises(InputError, match=r"exponent must be at most 1, got 1\.5"):
        RoelandsViscosity(exponent=1.5, pressure_ratio=3.0)
    with pytest.raises(InputError, match=r"pressure_ratio must be finite and positive, got -1\.0"):
        DowsonHigginsonDensity(pressure_ratio=-1.0)


@pytest.mark.closed_form
def test_roelands_viscosity_goes_on_smoothly_below_zero_pressure():
    law = RoelandsViscosity(exponent=0.6, pressure_ratio=4.0)
    p, step = np.linspace(-1.5, 1.5, 31) + 0.01, 1e-5
    slope = (law.potential(p + step, 5.0) - law.potential(p - step, 5.0)) / (2.0 * step)
    assert slope == pytest.approx(law.mobility(p, 5.0), rel=1e-6)
    assert law.mobility(np.array([-0.5]), 5.0) == pytest.approx(np.exp(2.5))
