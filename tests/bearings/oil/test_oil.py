"""Oils: ASTM D341, fits, and what the kernels read."""

import numpy as np
import pytest

from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings.oil import Exponential, Oil, Vogel, Walther
from rotorfilm.bearings.oil.oil import RANGE, viscosity_table
from rotorfilm.native.structs import structure

CELSIUS = 273.15


@pytest.mark.literature
@pytest.mark.parametrize(
    ("points", "at", "printed", "digits"),
    [
        # ASTM D341 by the calculators of olezol.com: cSt at degC.
        (((40, 404), (100, 28)), 60, 132.126, 2e-5),
        (((40, 68), (80, 14.85)), 100, 8.8, 2e-3),
    ],
)
def test_walther_is_astm_d341(points, at, printed, digits):
    first, second = ((T + CELSIUS, 1e-6 * nu) for T, nu in points)
    law = Walther.through(first, second, density=870.0)
    assert 1e6 * law.kinematic(at + CELSIUS) == pytest.approx(printed, rel=digits)


@pytest.mark.closed_form
@pytest.mark.parametrize("grade", [22, 46, 320])
def test_a_grade_is_its_kinematic_viscosity_at_40_degrees(grade):
    oil = Oil.iso_vg(grade)
    warm = 40.0 + CELSIUS
    assert oil.viscosity(warm) / oil.density(warm) == pytest.approx(1e-6 * grade, rel=1e-12)
    assert "100 degC" in oil.assumed[0]


def test_an_oil_takes_the_names_and_units_of_a_data_sheet():
    assert Oil.iso_vg("ISO VG 46") == Oil.iso_vg("VG 46") == Oil.iso_vg(46.0) == Oil.iso_vg(46)
    points = (40.0 + CELSIUS, 46.0 * 1e-6), (100.0 + CELSIUS, 6.8 * 1e-6)
    sheet = ("40 degC", "46 cSt"), ("100 degC", "6.8 mm2/s")
    assert Oil.two_points(*sheet, reference_density="870 kg/m3") == Oil.two_points(*points)
    plain = Oil.thinning_at(30.0 * 1e-3, 40.0 + CELSIUS, 0.03)
    assert Oil.thinning_at("30 mPa s", "40 degC", "0.03 1/K") == plain


@pytest.mark.parametrize(
    "law",
    [
        Oil.iso_vg(46).law,
        Vogel.fitted(Oil.iso_vg(46).law),
        Exponential(value=0.04, temperature=313.0, decay=0.03),
    ],
)
def test_thinning_is_the_derivative(law):
    T = np.linspace(290.0, 390.0, 11)
    h = 1e-3
    slope = -(np.log(law.viscosity(T + h)) - np.log(law.viscosity(T - h))) / (2.0 * h)
    assert law.thinning(T) == pytest.approx(slope, rel=1e-7)


def test_a_vogel_fit_is_within_a_thousandth():
    law = Oil.iso_vg(46).law
    T = np.linspace(313.15, 373.15, 61)
    assert np.abs(Vogel.fitted(law).viscosity(T) / law.viscosity(T) - 1.0).max() < 1e-3


@pytest.mark.closed_form
def test_laws_state_the_temperatures_between_which_they_hold():
    walther = Oil.iso_vg(46).law
    coldest, hottest = walther.temperature_range
    assert 1e6 * walther.kinematic([coldest, hottest]) == pytest.approx([2e7, 2.0], rel=1e-9)
    assert Exponential(value=0.04, temperature=313.0, decay=0.03).temperature_range == (263.0, 363.0)
    assert Oil.constant(0.02).law.temperature_range == (-np.inf, np.inf)
    vogel = Vogel.fitted(walther)
    T = np.linspace(*vogel.temperature_range, 50)
    assert np.abs(vogel.viscosity(T) / walther.viscosity(T) - 1.0).max() < 0.04


@pytest.mark.parametrize(
    ("oil", "celsius"),
    [
        (Oil.iso_vg(46), 190.0),
        (Oil.iso_vg(46), -70.0),
        (Oil.thinning_at("30 mPa s", "40 degC", "0.03 1/K"), 95.0),
        (Oil(law=Vogel.fitted(Oil.iso_vg(46).law)), 10.0),
    ],
)
def test_a_viscosity_beyond_its_law_is_warned_of(oil, celsius):
    with pytest.warns(ValidityWarning, match=rf"is valid from .* degC, and is used at {celsius:g} degC"):
        oil.viscosity(CELSIUS + celsius)
    with pytest.warns(ValidityWarning, match="is valid from"):
        oil.thinning([320.0, CELSIUS + celsius])


def test_an_oil_that_is_none_is_refused():
    for T in (100.0, 1001.0, [320.0, 2000.0]):
        for ask in ("viscosity", "thinning", "density", "volumetric_heat"):
            with pytest.raises(InputError, match=r"temperature must be from 150 to 1000 K, .*, got"):
                getattr(Oil.iso_vg(46), ask)(T)
    with pytest.raises(InputError, match=r"temperature_range must rise from above the origin 200\.0 K"):
        Vogel(factor=1e-5, activation=900.0, origin=200.0, temperature_range=(190.0, 400.0))


def test_a_vogel_fit_of_an_oil_that_thins_evenly_is_refused():
    with pytest.raises(InputError, match="ever more slowly"):
        Vogel.fitted(Exponential(value=0.04, temperature=313.0, decay=0.03))


def test_the_table_of_a_kernel_is_the_law():
    oil = Oil.iso_vg(46)
    table = viscosity_table(oil)
    assert (table.coldest, table.hottest) == RANGE
    cells = len(table.coefficients) - 5
    basis = _quintic_basis(np.linspace(0.0, 1.0, 5))
    for k in (0, 3, cells // 2, cells - 1):
        T = RANGE[0] + (k + np.linspace(0.0, 1.0, 5)) * (RANGE[1] - RANGE[0]) / cells
        spline = basis @ table.coefficients[k : k + 6]
        assert spline == pytest.approx(np.log(oil.law.viscosity(T)), abs=3e-9 if 0 < k < cells - 1 else 1e-6)
    assert structure("rf_oil")._fields_[0][0] == "cells"


def _quintic_basis(u):
    """Return the six uniform quintic B-splines at u, by the truncated powers (de Boor)."""
    x = u[:, None] + np.arange(5, -1, -1)
    powers = [np.maximum(x - k, 0.0) ** 5 for k in range(7)]
    binomial = (1, -6, 15, -20, 15, -6, 1)
    return sum(c * p for c, p in zip(binomial, powers, strict=True)) / 120.0


@pytest.mark.parametrize(
    ("make", "match"),
    [
        (lambda: Oil.iso_vg(47), "grade must be one of"),
        (lambda: Oil.iso_vg("ISO VG 47"), "grade must be one of .*, got 'ISO VG 47'"),
        (lambda: Oil.iso_vg([46]), r"grade must be one of .*, got \[46\]"),
        (lambda: Oil.iso_vg(True), "grade must be one of .*, got True"),
        (lambda: Oil.two_points("46 cSt", "7 cSt"), "^first must be a temperature and .*, got '46 cSt'"),
        (lambda: Oil.two_points((313.0, 1e-5), 7e-6), "^second must be a temperature and .*, got 7e-06"),
        (lambda: Oil.two_points((40.0, 1e-5), (100.0, 7e-6)), r"^first\[0\] must .*'40 degC'"),
        (lambda: Oil.two_points((313.0, None), (373.0, 7e-6)), r"^first\[1\] must be a single finite"),
        (lambda: Oil.thinning_at("3 Pa", 313.0, 0.03), "^viscosity: quantity must be measured in Pa.s"),
        (lambda: Oil.constant(None), "^viscosity must be finite and positive, got None"),
        (lambda: Oil.two_points((313.0, 1e-5), (373.0, 2e-5)), "must fall with temperature"),
        (lambda: Oil.constant(-1.0), "viscosity must be finite and positive"),
        (lambda: Oil.iso_vg(46).viscosity(-3.0), "temperature must be finite and positive"),
        (lambda: Oil(law="thick"), "law must be"),
    ],
)
def test_what_is_no_oil_is_refused(make, match):
    with pytest.raises(InputError, match=match):
        make()


@pytest.mark.closed_form
def test_heat_capacity_of_a_mineral_oil():
    # (1683 + 3.39 T)/sqrt(s), T in degC and s the density of 15 degC over that of water.
    assert Oil.iso_vg(46).heat_capacity(40.0 + CELSIUS) == pytest.approx(1818.6 / np.sqrt(870.0 / 999.0))
    assert Oil.iso_vg(46, fixed_heat_capacity=2000.0).heat_capacity(300.0) == 2000.0
