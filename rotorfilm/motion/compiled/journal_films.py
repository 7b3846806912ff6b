"""The films at the journals of a rotor, with the springs that it rests on (`native/loops/march.h`)."""

from __future__ import annotations

from ctypes import byref
from typing import NamedTuple

import numpy as np

from ...model import Array
from ...native.layouts.structs import JournalsStruct
from ...native.library import loops
from .modal import ModalRotor

CONTACT_GAP = 1e-9
"""Film thickness, in clearances, at which a journal counts as touching: below any surface roughness."""


class JournalFilms(NamedTuple):
    """The bearings of a rotor as the C library reads them.

    Attributes
    ----------
    films, of : ndarray of addresses, shape (n,)
        Of the functions, and of what they take first.
    rest : ndarray, shape (4 n,)
        x, y, vx, vy of each journal about which motion is counted.
    spring, damper : ndarray, shape (2 n,) [N/m], [N s/m]
        What the rotor rests on and the films give back.
    lengths : ndarray, shape (n,) [m]
        Clearances, or what stands for them.
    walls : ndarray, shape (n,) [m]
        Eccentricities at which a journal counts as touching; infinite without a wall.
    """

    films: np.ndarray
    of: np.ndarray
    rest: Array
    spring: Array
    damper: Array
    lengths: Array
    walls: Array

    @classmethod
    def of_rotor(cls, modal: ModalRotor, *, absolute: bool = False) -> JournalFilms:
        """Return those of a rotor, which has to live as long; motion is from its rest, or `absolute`."""
        addresses = np.array([(call.address, call.data) for call in modal.calls], dtype=np.uintp).T
        rest = np.zeros(4 * len(modal.calls)) if absolute else modal.journal_rest
        walls = (1.0 - CONTACT_GAP) * np.array([bearing.clearance for bearing in modal.parts.bearings])
        rows = rest, modal.spring, modal.damper, modal.parts.lengths, walls
        return cls(*map(np.ascontiguousarray, (*addresses, *rows)))

    def struct(self) -> JournalsStruct:
        """Return them as the C library reads them, while this object lives."""
        return JournalsStruct(len(self.lengths), *(numbers.ctypes.data for numbers in self))

    def forces(self, motion: Array, speed: float) -> tuple[int, Array, Array]:
        """Return a status, forces of films and springs (2 n, samples), and slopes (2 n, 4, samples).

        Parameters
        ----------
        motion : ndarray, shape (4 n, samples) [m, m/s]
            x, y, vx, vy of each journal.
        speed : float [rad/s]
        """
        rows, samples = motion.shape
        given = np.ascontiguousarray(motion, dtype=float)
        force, slope = np.empty((rows // 2, samples)), np.empty((rows // 2, 4, samples))
        places = force.ctypes.data, slope.ctypes.data
        status = loops()["rf_journal_forces"](
            byref(self.struct()), samples, given.ctypes.data, speed, *places
        )
        return status, force, slope
