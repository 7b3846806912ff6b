"""Signals: validation, and the bijection between component and name and FMI's structured names."""

import dataclasses

import pytest
from hypothesis import given, strategies as st

from rotorfilm import InputError
from rotorfilm.core import Signal, from_fmi_name, names, to_fmi_name

IDENTIFIERS = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,20}", fullmatch=True)
FORCE = Signal(name="force_x", unit="N", nominal=100.0, description="force on the journal along x")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": "film.force"}, "name must be an identifier without dots, got 'film.force'"),
        ({"name": "class"}, "name must be an identifier without dots, got 'class'"),
        ({"name": ""}, "name must be an identifier"),
        ({"unit": "lbf"}, "unit must be one of .*, got 'lbf'"),
        ({"unit": "rpm"}, "unit must be one of .*, got 'rpm'"),
        ({"nominal": 0.0}, "nominal must be finite and positive, got 0.0"),
        ({"nominal": -1.0}, "nominal must be finite and positive, got -1.0"),
        ({"nominal": float("nan")}, "nominal must be finite and positive, got nan"),
        ({"nominal": "1"}, "nominal must be finite and positive, got '1'"),
    ],
)
def test_bad_signal_is_named(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(FORCE, **change)


def test_names_keep_their_order():
    other = dataclasses.replace(FORCE, name="force_y")
    assert names((other, FORCE)) == ["force_y", "force_x"]


@given(component=IDENTIFIERS, name=IDENTIFIERS)
def test_fmi_name_comes_back(component, name):
    assert from_fmi_name(to_fmi_name(component, name)) == (component, name)


@given(text=st.text(alphabet="ab_.1", max_size=8))
def test_a_text_is_an_fmi_name_or_refused(text):
    try:
        parts = from_fmi_name(text)
    except InputError:
        return
    assert to_fmi_name(*parts) == text


@given(first=st.tuples(IDENTIFIERS, IDENTIFIERS), second=st.tuples(IDENTIFIERS, IDENTIFIERS))
def test_different_signals_have_different_fmi_names(first, second):
    assert (to_fmi_name(*first) == to_fmi_name(*second)) == (first == second)


@pytest.mark.parametrize(
    ("component", "name", "message"),
    [
        ("a.b", "x", "component must be an identifier without dots, got 'a.b'"),
        ("film", "force x", "name must be an identifier without dots, got 'force x'"),
        ("", "x", "component must be an identifier"),
    ],
)
def test_ambiguous_fmi_name_is_refused(component, name, message):
    with pytest.raises(InputError, match=message):
        to_fmi_name(component, name)


@pytest.mark.parametrize("text", ["film", "film.", ".x", "film.force.x", "1.x"])
def test_text_that_is_no_fmi_name_is_refused(text):
    with pytest.raises(InputError, match=r"fmi_name must have the form component\.name"):
        from_fmi_name(text)
