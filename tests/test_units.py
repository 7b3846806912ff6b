"""Units: the table of SI exponents, and the quantities that scenes and the CLI accept."""

import math

import pytest
from hypothesis import given, strategies as st

from rotorfilm import InputError
from rotorfilm.core import DISPLAY_UNITS, UNITS, parse_quantity

FMI_BASE_UNITS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"}


@pytest.mark.parametrize("name", DISPLAY_UNITS)
def test_exponents_are_those_that_fmi_knows(name):
    assert set(DISPLAY_UNITS[name].exponents) <= FMI_BASE_UNITS
    assert 0 not in DISPLAY_UNITS[name].exponents.values()


@pytest.mark.parametrize("name", UNITS)
def test_signal_units_are_coherent(name):
    assert UNITS[name].factor == 1.0


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("product", "factors"),
    [
        ("N", ["kg", "m/s2"]),
        ("N/m", ["kg", "m/s2", "1/m"]),
        ("N.s/m", ["N/m", "s"]),
        ("Pa", ["N", "1/m", "1/m"]),
        ("Pa.s", ["Pa", "s"]),
        ("m/s", ["m", "1/s"]),
        ("rad/s2", ["rad/s", "1/s"]),
        ("kg.m", ["kg", "m"]),
    ],
)
def test_exponents_add_up_as_the_definitions_say(product, factors):
    total: dict[str, int] = {}
    for factor in factors:
        inverse = factor.startswith("1/")
        for base, power in UNITS[factor.removeprefix("1/") if inverse else factor].exponents.items():
            total[base] = total.get(base, 0) + (-power if inverse else power)
    assert {base: power for base, power in total.items() if power} == UNITS[product].exponents


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("0.1 mm", "m", 1e-4),
        ("50um", "m", 5e-5),
        ("1500 rpm", "rad/s", 50.0 * math.pi),
        ("-90 deg", "rad", -0.5 * math.pi),
        ("0.1 Pa s", "Pa.s", 0.1),
        ("12 mPa s", "Pa.s", 0.012),
        ("12 mPa.s", "Pa.s", 0.012),
        ("5 MN", "N", 5e6),
        ("2147 g mm", "kg.m", 2.147e-3),
        # ISO 80000: 1 in = 25.4 mm, 1 lb = 0.453 592 37 kg, g_n = 9.806 65 m/s2
        ("4 in", "m", 0.1016),
        ("1 lbf", "N", 4.4482216152605),
        ("1 psi", "Pa", 4.4482216152605 / 0.00064516),
        ("100 cP", "Pa.s", 0.1),
        ("1.5e2 kN", "N", 1.5e5),
        ("50 \N{MICRO SIGN}m", "m", 5e-5),
        ("0.4 \N{GREEK SMALL LETTER MU}m2", "m2", 4e-13),
        (".5", "m", 0.5),
        ("+3. s", "s", 3.0),
        (7, "kg", 7.0),
        (2.5, "N", 2.5),
    ],
)
def test_quantity_in_si(text, unit, expected):
    assert parse_quantity(text, unit) == pytest.approx(expected, rel=1e-15)


SIZES = st.floats(1e-20, 1e20) | st.floats(-1e20, -1e-20) | st.just(0.0)


@given(number=SIZES, name=st.sampled_from(sorted(DISPLAY_UNITS)))
def test_every_number_with_every_unit_is_read(number, name):
    unit = next(key for key in UNITS if UNITS[key].exponents == DISPLAY_UNITS[name].exponents)
    of = DISPLAY_UNITS[name]
    assert parse_quantity(f"{number!r} {name}", unit, absolute=True) == number * of.factor + of.zero


@pytest.mark.closed_form
def test_a_temperature_has_a_zero_and_a_difference_has_none():
    assert parse_quantity("45 degC", "K", absolute=True) == 318.15
    assert parse_quantity("45 \N{DEGREE SIGN}C", "K", absolute=True) == 318.15
    with pytest.raises(InputError, match=r"must be a difference in K.*got '45 degC'"):
        parse_quantity("45 degC", "K")


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("0.1 kg", "m", "must be measured in m or a multiple of it, got '0.1 kg'"),
        ("10 furlong", "m", "unit must be one of in, m, mm, um, got 'furlong' in '10 furlong'"),
        ("long", "m", "must be a number with a unit such as '1 m', got 'long'"),
        ("", "m", "must be a number with a unit"),
        ("nan m", "m", "must be finite, got 'nan m'"),
        (math.nan, "m", "must be finite, got nan"),
        (-math.inf, "m", "must be finite, got -inf"),
        ("1e999 m", "m", "must be finite, got '1e999 m'"),
        (10**400, "m", "must be 0 or of a size from 1e-30 to 1e\\+30 in SI, got 1000"),
        ("-2e30 m", "m", "must be 0 or of a size from 1e-30 to 1e\\+30 in SI, got '-2e30 m'"),
        (1e-31, "m", "must be 0 or of a size from 1e-30 to 1e\\+30 in SI, got 1e-31"),
        ("-inf", "m", "must be finite, got '-inf'"),
        ("1 in", "kg", "must be measured in kg"),
        ("in", "m", "must be a number with a unit"),
        ("1 rpm", "1", "must be measured in 1"),
        (True, "m", "must be a number or a number with a unit, got True"),
    ],
)
def test_bad_quantity_is_named(text, unit, message):
    with pytest.raises(InputError, match=message):
        parse_quantity(text, unit)
