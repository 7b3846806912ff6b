"""Steps of a rotor in modes under forces that are polynomials of time (`native/loops/collocation.h`)."""

from __future__ import annotations

from ctypes import byref
from functools import lru_cache
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial.polynomial import polyfromroots
from scipy.special import roots_jacobi

from ..core.model import Array
from ..native.library import loops
from ..native.structs import structure
from .compiled_rotor import Complex, ModalRotor, unbalance_rates

STAGES, MORE_STAGES, ACCURATE = 4, 8, 1e-11
"""Collocation nodes of a step: order 7; and order 15 for local errors below the last number."""


def stages_of(rtol: float) -> int:
    """Return the collocation nodes with which a local error costs least."""
    return MORE_STAGES if rtol < ACCURATE else STAGES


class Collocation(NamedTuple):
    """Nodes of a step and polynomials on them, coefficients by rising power.

    Attributes
    ----------
    nodes : ndarray, shape (s,)
        Nodes of Radau's right rule.
    lagrange : ndarray, shape (s, s)
    remainder : ndarray, shape (s + 1,)
        The polynomial that vanishes at the nodes and is 1 at the start.
    """

    nodes: Array
    lagrange: Array
    remainder: Array

    def struct(self) -> Any:
        """Return it as the C library reads it, while this object lives."""
        return structure("rf_scheme")(len(self.nodes), *(numbers.ctypes.data for numbers in self))


@lru_cache(maxsize=8)
def radau_scheme(stages: int) -> Collocation:
    """Return the scheme of so many nodes."""
    # The inner nodes are the zeros of Jacobi's polynomial of weight 1 - x on [0, 1].
    inner = 0.5 * (1.0 + roots_jacobi(stages - 1, 1.0, 0.0)[0])
    nodes = np.append(inner, 1.0)
    # Products over positive nodes have no cancellation, which an inverse of their powers has.
    others = [np.delete(nodes, k) for k in range(stages)]
    lagrange = [polyfromroots(rest) / np.prod(node - rest) for node, rest in zip(nodes, others, strict=True)]
    remainder = polyfromroots(nodes)
    return Collocation(nodes, np.array(lagrange), remainder / remainder[0])


class ModalArrays(NamedTuple):
    """The modes of a rotor as the C library reads them.

    Attributes
    ----------
    values, push, sense : ndarray of complex
        Values, push and sense as for a `ModalRotor`. Where films have states, `sense` goes on with these, and
        `push` has their rates behind the forces. Where a bearing adds a mass,
        `sense` goes on with ax, ay of each journal, and on a motor with the acceleration of the unbalance.
        There `push` ends with zeros, for the angular acceleration.
    direct : ndarray, shape (n_rows, n_channels), or None
        These accelerations per force at the same moment; None without.
    rates : ndarray of complex, shape (n_accelerations, n_modes), or None
        These accelerations per rate of the modal coordinates; None without.
    """

    values: Complex
    push: Complex
    sense: Complex
    direct: Array | None = None
    rates: Complex | None = None

    @classmethod
    def of(cls, modal: ModalRotor) -> ModalArrays:
        """Return those of a rotor."""
        sense, push, direct = modal.sense, modal.push, None
        every = [sense.reshape(-1, 2, 2, len(modal.values))[:, 1].reshape(-1, len(modal.values))]
        if modal.parts.motor:
            every.append(unbalance_rates(modal))
            push = np.column_stack([push, np.zeros(len(push))])
        if inner := [*chain(*modal.parts.film_states)]:
            push = np.insert(push, [len(sense) // 2], modal.inverse[:, inner], axis=1)
            sense = np.vstack([sense, modal.shapes[inner]])
        rates = np.vstack(every[not modal.is_heavy :]) if modal.is_heavy or modal.parts.motor else None
        if rates is not None:
            direct = np.vstack([np.zeros((len(sense), push.shape[1])), (rates @ push).real])
            sense = np.vstack([sense, rates * modal.values])
            rates = np.ascontiguousarray(rates, dtype=complex)
        rows = modal.values, push, sense
        values, push, sense = (np.ascontiguousarray(row, dtype=complex) for row in rows)
        return cls(values, push, sense, direct, rates)

    def struct(self) -> Any:
        """Return them as the C library reads them, while this object lives."""
        places = (None if numbers is None else numbers.ctypes.data for numbers in self)
        return structure("rf_modes")(*self.push.shape, len(self.sense), *places)


class StepTable(NamedTuple):
    """What one length of a step needs, of s nodes.

    Attributes
    ----------
    move : ndarray, shape (s rows, 2 n_modes)
        Motion of the journals at the nodes per real and imaginary part of the modal coordinates.
    gain : ndarray, shape (s, s, rows, channels)
        The same at a node per force at each node.
    defect : ndarray, shape (s, rows, channels)
        The same per gap of the force at the start.
    keep : ndarray of complex, shape (n_modes,)
        Modal coordinates at the end per themselves.
    forced : ndarray, shape (2 n_modes, s channels)
        Their real and imaginary parts per force at each node.
    turn : ndarray of complex, shape (s, n_modes), or None
        Modal coordinates at the nodes per themselves; None where the modes are those of the speed.
    weights : ndarray of complex, shape (s, s + 1, n_modes), or None
        The same per drive at each node, and per gap of it at the start.
    """

    move: Array
    gain: Array
    defect: Array
    keep: Complex
    forced: Array
    turn: Complex | None
    weights: Complex | None

    @classmethod
    def unfilled(cls, rotor: ModalArrays, stages: int, *, spins: bool = False) -> StepTable:
        """Return a table that is to be filled."""
        modes, channels = rotor.push.shape
        rows = len(rotor.sense)
        return cls(
            np.empty((stages * rows, 2 * modes)),
            np.empty((stages, stages, rows, channels)),
            np.empty((stages, rows, channels)),
            np.empty(modes, dtype=complex),
            np.empty((2 * modes, stages * channels)),
            np.empty((stages, modes), dtype=complex) if spins else None,
            np.empty((stages, stages + 1, modes), dtype=complex) if spins else None,
        )

    @classmethod
    def of_step(cls, rotor: ModalArrays, scheme: Collocation, step: float) -> StepTable:
        """Return the table of a length of step [s]."""
        table = cls.unfilled(rotor, len(scheme.nodes))
        arguments = byref(rotor.struct()), byref(scheme.struct()), step, byref(table.struct())
        if loops()["rf_set_step_table"](*arguments):
            raise MemoryError("no memory for the tables of a step")
        return table

    def struct(self) -> Any:
        """Return it as the C library reads it, while this object lives."""
        return structure("rf_step_table")(*(None if part is None else part.ctypes.data for part in self))
