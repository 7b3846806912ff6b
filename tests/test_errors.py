"""Errors: each rule lets the right values pass, and names the argument, the rule and the value otherwise."""

import numpy as np
import pytest

from rotorfilm import ContactError, FilmContactError, InputError, RotorfilmError, ValidityWarning, equilibrium
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.core import errors
from rotorfilm.core.errors import (
    require_finite,
    require_inside,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
)

BAD_NUMBERS = [float("nan"), float("inf"), -float("inf"), "1", None, True, [1.0]]


@pytest.mark.parametrize("value", [1e-300, 3, np.float64(2.0), np.int64(5)])
def test_positive_numbers_pass(value):
    require_positive("clearance", value)


@pytest.mark.parametrize("value", [0.0, -5e-5, *BAD_NUMBERS])
def test_not_positive_is_named(value):
    with pytest.raises(InputError) as caught:
        require_positive("clearance", value)
    assert str(caught.value) == f"clearance must be finite and positive, got {value!r}"


def test_zero_is_not_negative():
    require_non_negative("unbalance", 0.0)


@pytest.mark.parametrize("value", [-1e-300, *BAD_NUMBERS])
def test_negative_is_named(value):
    with pytest.raises(InputError) as caught:
        require_non_negative("unbalance", value)
    assert str(caught.value) == f"unbalance must be finite and not negative, got {value!r}"


def test_finite_values_become_an_array_of_floats():
    array = require_finite("load", [1, 2])
    assert array.dtype == float
    np.testing.assert_array_equal(array, [1.0, 2.0])


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ([1.0, float("nan")], r"load must be finite, got \[1.0, nan\]"),
        ("heavy", "load must be numeric, got 'heavy'"),
        ([[1.0], [1.0, 2.0]], "load must be numeric"),
        (None, "load must be finite, got None"),
    ],
)
def test_not_finite_is_named(value, message):
    with pytest.raises(InputError, match=message):
        require_finite("load", value)


@pytest.mark.parametrize("value", [3, -2.5, np.float64(2.0), np.int64(0)])
def test_a_single_number_becomes_a_float(value):
    found = require_number("speed", value)
    assert found == value
    assert type(found) is float


@pytest.mark.parametrize("value", BAD_NUMBERS)
def test_not_a_single_number_is_named(value):
    with pytest.raises(InputError) as caught:
        require_number("speed", value)
    assert str(caught.value) == f"speed must be a single finite number, got {value!r}"


def test_a_journal_inside_the_clearance_passes():
    require_inside(np.array([[0.6, 0.0], [0.7, -0.99]]), 1.0)


@pytest.mark.parametrize("position", [[0.6, 0.8], [[0.0, 1.2], [0.0, 0.0]], [np.nan, 0.0]])
def test_a_journal_at_the_wall_is_named(position):
    with pytest.raises(FilmContactError, match=r"inside the clearance 1.0 m, got .* m at t = 2 s"):
        require_inside(np.array(position), 1.0, " at t = 2 s")


@pytest.mark.parametrize("shape", [(2,), (2, 3), (2, 0), (2, 4, 5)])
def test_vectors_keep_their_batch_axes(shape):
    assert require_vector("position", np.ones(shape)).shape == shape


@pytest.mark.parametrize("shape", [(), (3,), (1, 2), (0,)])
def test_other_shapes_are_named(shape):
    with pytest.raises(InputError) as caught:
        require_vector("position", np.ones(shape))
    assert str(caught.value) == f"position must have shape (2, ...), got shape {shape}"


def test_every_error_is_caught_by_the_base():
    kinds = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, Exception)]
    own = [kind for kind in kinds if not issubclass(kind, Warning)]
    assert len(own) >= 10
    assert all(issubclass(kind, RotorfilmError) for kind in own)


def test_contact_during_a_run_keeps_the_partial_result():
    with pytest.raises(FilmContactError) as caught:
        raise ContactError("journal touches the wall at t = 0.1 s", partial=[1, 2])
    assert caught.value.partial == [1, 2]


def test_warning_of_a_dataclass_points_at_the_line_that_makes_it():
    with pytest.warns(ValidityWarning) as caught:
        JournalBearing(radius=0.05, length=0.08, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (np.float64(-0.5), "-0.5"),
        (np.int64(-3), "-3"),
        ([np.float64("nan"), np.True_, np.str_("a")], "[nan, True, 'a']"),
        ("np.float", "'np.float'"),
    ],
)
def test_messages_show_scalars_of_numpy_as_plain_numbers(value, shown):
    with pytest.raises(InputError) as caught:
        require_positive("clearance", value)
    assert str(caught.value) == f"clearance must be finite and positive, got {shown}"
    with pytest.warns(ValidityWarning) as warned:
        errors.warn_user(f"got {value!r}")
    assert str(warned[0].message) == f"got {shown}"


def test_truth_values_are_no_numbers():
    bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    for load in ([0, True], [False, -1e3], np.array([True, True])):
        with pytest.raises(InputError, match="load must be numbers, and not True or False"):
            equilibrium(bearing, load, 300.0)
