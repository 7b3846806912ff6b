"""The force of a bearing as a compiled function behind an address, for loops that must not enter Python.

Every such function is that of the C library (native/films/journal_kernel.h),

    int f(const void *bearing, const double state[5], double force[2], double jacobian[2][5]),

with state = (x, y, vx, vy, speed). Journal bearings on a film of that library bring it along, `LinearBearing`
has one in native/loops/springs.h, and any other reaction is called back in Python: slower, with the same
result.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Sequence
from ctypes import CFUNCTYPE, POINTER, c_double, c_int, c_void_p
from typing import Any, NamedTuple

import numpy as np

from ...bearings.films.kernel_film import BoundKernel
from ...bearings.journal import JournalBearing
from ...bearings.linear import LinearBearing
from ...errors import FilmContactError, RotorfilmError, UndefinedDerivativeError
from ...model import Reaction
from ...native import Status
from ...native.library import functions, loops

_CALLBACK = CFUNCTYPE(c_int, c_void_p, POINTER(c_double), POINTER(c_double), POINTER(c_double))


class FilmCall(NamedTuple):
    """Where the compiled force of a bearing is.

    Attributes
    ----------
    address : int
        Of the function.
    data : int
        Its first argument.
    owner : object
        What must live as long as both.
    beyond : str
        How the force goes on beyond the map of its film; empty where it has none.
    raised : list of BaseException
        What a force in Python raised besides errors of this package, until `raise_foreign`.
    """

    address: int
    data: int
    owner: Any
    beyond: str = ""
    raised: Sequence[BaseException] = ()


def raise_foreign(calls: Iterable[FilmCall]) -> None:
    """Raise what a force in Python raised that the loop around it could not: an error of its own, Ctrl-C."""
    for call in calls:
        if call.raised:
            raise call.raised[0]


def film_call(reaction: Reaction) -> FilmCall:
    """Return the compiled force of a reaction without states."""
    if type(reaction) is JournalBearing:
        bound = reaction.bound_film
        if isinstance(bound, BoundKernel):
            struct = bound.kernel.struct
            address = ctypes.cast(functions()["rf_journal_at"], c_void_p).value or 0
            return FilmCall(address=address, data=ctypes.addressof(struct), owner=bound, beyond=bound.beyond)
    if type(reaction) is LinearBearing:
        values = np.concatenate([np.ravel(reaction.stiffness), np.ravel(reaction.damping)])
        address = ctypes.cast(loops()["rf_springs_at"], c_void_p).value or 0
        return FilmCall(address=address, data=values.ctypes.data, owner=values)
    return _called_back(reaction)


def _called_back(reaction: Reaction) -> FilmCall:
    raised: list[BaseException] = []

    def answer(_: Any, state: Any, force: Any, jacobian: Any) -> int:
        position, velocity = np.array(state[:2]), np.array(state[2:4])
        try:
            for i, value in enumerate(np.asarray(reaction.force(position, velocity, state[4])).tolist()):
                force[i] = value
            slopes = np.asarray(reaction.jacobian(position, velocity, state[4]))[:, :5]
            for i, value in enumerate(slopes.ravel().tolist()):
                jacobian[i] = value
        except FilmContactError:
            return Status.AT_WALL
        except UndefinedDerivativeError:
            return Status.UNDEFINED
        except RotorfilmError:
            return Status.NOT_FINITE
        except BaseException as error:
            raised[:] = [error]
            return Status.NOT_FINITE
        return Status.OK

    function = _CALLBACK(answer)
    return FilmCall(
        address=ctypes.cast(function, c_void_p).value or 0, data=0, owner=(function, reaction), raised=raised
    )
