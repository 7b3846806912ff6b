"""Steps of a rotor in modes under forces that are polynomials of time (`native/loops/collocation.h`)."""

from __future__ import annotations

from ctypes import byref
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import roots_jacobi

from ...model import Array
from ...native.layouts.structs import ModesStruct, SchemeStruct, StepTableStruct
from ...native.library import loops
from .modal import Complex, ModalRotor

STAGES = 4
"""Collocation nodes of a step: order 7."""


class Collocation(NamedTuple):
    """Nodes of a step and polynomials on them, coefficients by rising power.

    Attributes
    ----------
    nodes : ndarray, shape (s,)
        Of Radau's right rule.
    lagrange : ndarray, shape (s, s)
    remainder : ndarray, shape (s + 1,)
        The polynomial that vanishes at the nodes and is 1 at the start.
    """

    nodes: Array
    lagrange: Array
    remainder: Array

    def struct(self) -> SchemeStruct:
        """Return it as the C library reads it, while this object lives."""
        return SchemeStruct(len(self.nodes), *(numbers.ctypes.data for numbers in self))


@lru_cache(maxsize=8)
def radau_scheme(stages: int) -> Collocation:
    """Return the scheme of so many nodes."""
    # The inner nodes are the zeros of Jacobi's polynomial of weight 1 - x on [0, 1].
    inner = 0.5 * (1.0 + roots_jacobi(stages - 1, 1.0, 0.0)[0])
    nodes = np.append(inner, 1.0)
    lagrange = np.linalg.inv(np.vander(nodes, increasing=True)).T
    remainder = np.polynomial.polynomial.polyfromroots(nodes)
    return Collocation(nodes, np.ascontiguousarray(lagrange), remainder / remainder[0])


class ModalArrays(NamedTuple):
    """The modes of a rotor as the C library reads them.

    Attributes
    ----------
    values, push, sense : ndarray of complex
        As of a `ModalRotor`.
    """

    values: Complex
    push: Complex
    sense: Complex

    @classmethod
    def of(cls, modal: ModalRotor) -> ModalArrays:
        """Return those of a rotor."""
        rows = modal.values, modal.push, modal.sense
        return cls(*(np.ascontiguousarray(row, dtype=complex) for row in rows))

    def struct(self) -> ModesStruct:
        """Return them as the C library reads them, while this object lives."""
        places = (numbers.ctypes.data for numbers in self)
        return ModesStruct(*self.push.shape, len(self.sense), *places)


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

    def struct(self) -> StepTableStruct:
        """Return it as the C library reads it, while this object lives."""
        return StepTableStruct(*(None if part is None else part.ctypes.data for part in self))
