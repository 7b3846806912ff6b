"""The force of a bearing as a compiled function behind an address, for loops that must not enter Python.

Every such function is that of the C library (native/films/journal_kernel.h),

int f(const void *bearing, const double state[5], double force[2], double jacobian[2][5]),

with state = (x, y, vx, vy, speed).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import CFUNCTYPE, POINTER, addressof, c_double, c_int, c_void_p, cast
from functools import cache
from typing import Any, NamedTuple

from ..core.model import Array
from .library import functions, loops
from .structs import structure

_CALLBACK = CFUNCTYPE(c_int, c_void_p, POINTER(c_double), POINTER(c_double), POINTER(c_double))

MASSLESS = (0, 0)
"""Where the added mass of a force without one is."""


class FilmCall(NamedTuple):
    """Where the compiled force of a bearing is.

    Attributes
    ----------
    address : int
        Address of the function.
    data : int
        Its first argument.
    owner : object
        What must live as long as both.
    beyond : str
        How the force goes on beyond the map of its film; empty where it has none.
    raised : list of BaseException
        What a force in Python raised besides errors of this package, until `raise_foreign`.
    mass : tuple of two int
        Address of the rf_mass_response (native/films/film.h) of an added mass, and of its first argument;
        zeros where there is none.
    states : int
        States of its own, which it takes behind the speed, and whose rates it answers behind the force.
    """

    address: int
    data: int
    owner: Any
    beyond: str = ""
    raised: Sequence[BaseException] = ()
    mass: tuple[int, int] = MASSLESS
    states: int = 0

    @classmethod
    def of_numbers(cls, function: str, numbers: Array) -> FilmCall:
        """Return a force of the C library by its name, which reads these numbers."""
        return cls(address_of(function), numbers.ctypes.data, numbers)

    @classmethod
    def of_python(
        cls, answer: Callable[[Any, Any, Any, Any], int], raised: Sequence[BaseException]
    ) -> FilmCall:
        """Return a force in Python, which must not raise, and where its errors go."""
        function = _CALLBACK(answer)
        return cls(cast(function, c_void_p).value or 0, 0, function, raised=raised)

    def beside(self, stiffness: float, *, still: bool) -> FilmCall:
        """Return this force beside equal springs [N/m], of a journal that does not spin where it is still."""
        both = structure("rf_sprung")(self.address, self.data, stiffness, still)
        return self._replace(
            address=address_of("rf_sprung_at"), data=addressof(both), owner=(both, self.owner)
        )

    def plus(self, other: FilmCall) -> FilmCall:
        """Return the sum of two forces on one journal, without their added masses."""
        both, beyond = structure("rf_both")(*self[:2], *other[:2]), self.beyond or other.beyond
        return FilmCall(address_of("rf_both_at"), addressof(both), (both, self, other), beyond)


@cache
def address_of(name: str) -> int:
    """Return the address of a function of the C library."""
    return cast({**functions(), **loops()}[name], c_void_p).value or 0
