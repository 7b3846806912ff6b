"""Pieces of a table on several threads: order, pilot, errors."""

import re
from functools import partial
from threading import Barrier

import numpy as np
import pytest

from rotorfilm.bearings.films.map_fit import made_pieces, spread_order
from rotorfilm.core.progress import silent


@pytest.mark.parametrize("count", [1, 7, 200])
def test_first_pieces_lie_all_over_the_range(count):
    order = spread_order(count)
    assert sorted(order) == list(range(count))
    for first in range(1, count + 1, 9):
        gaps = np.diff([-1, *sorted(order[:first]), count])
        assert gaps.max() <= 3.0 * (count / first) + 1.0


@pytest.mark.parametrize("workers", [1, 4])
def test_answers_come_in_the_order_of_the_pieces(workers):
    told = []
    pieces = [partial(np.full, 2, float(k)) for k in range(60)]
    found = made_pieces(pieces, lambda *said: told.append(said), "numbers", workers=workers)
    np.testing.assert_array_equal(found, np.arange(60.0)[:, None] * [1.0, 1.0])
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions)
    assert fractions[0] < 0.2
    assert fractions[-1] == 1.0
    assert len({text for _, text in told}) == 1


@pytest.mark.parametrize("count", [40, 300])
@pytest.mark.parametrize("grows", [0.0, 3.0, -0.9])
def test_the_time_told_after_the_pilot_is_right_within_a_factor(count, grows):
    now = 0.0

    def piece(k):
        nonlocal now
        # Two kinds one after the other, the second one dearer, and each changes along the sequence.
        now += (1.0 + grows * k / count) * (1.0 if k < 0.8 * count else 3.0)
        return np.zeros(1)

    told = []
    made_pieces(
        [partial(piece, k) for k in range(count)],
        lambda _, text: told.append(text),
        "map",
        workers=1,
        clock=lambda: now,
    )
    seconds = float(re.fullmatch(r"map, about (\S+) s", told[0]).group(1))
    assert 1.0 / 1.5 < seconds / now < 1.5


def test_pieces_run_side_by_side():
    # Each waits for the other: one after the other they would break the barrier.
    barrier = Barrier(2, timeout=20.0)
    found = made_pieces([lambda: np.array([barrier.wait()])] * 2, silent, "pair", workers=2)
    assert sorted(np.ravel(found)) == [0, 1]


def test_after_an_error_no_piece_is_begun():
    begun = []

    def piece(k):
        begun.append(k)
        if len(begun) == 3:
            raise ValueError("the third one")
        return np.zeros(1)

    with pytest.raises(ValueError, match="the third one"):
        made_pieces([partial(piece, k) for k in range(500)], silent, "numbers", workers=1)
    assert len(begun) < 100
