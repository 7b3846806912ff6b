"""The force of a bearing as a compiled function behind an address, for loops that must not enter Python.

Every such function is that of the C library (native/films/journal_kernel.h),

    int f(const void *bearing, const double state[5], double force[2], double jacobian[2][5]),

with state = (x, y, vx, vy, speed). Journal bearings and dampers on a film of that library bring it along,
`LinearBearing` and the springs of `Sprung` have one in native/loops/springs.h, `RubRing` and the sum of
`ParallelReaction` in native/loops/rub.h, and any other reaction is called back in Python: slower, with the
same result.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Sequence
from ctypes import CFUNCTYPE, POINTER, c_double, c_int, c_void_p
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ...bearings.damper import PorousDamper, SqueezeFilmDamper
from ...bearings.films.kernel_film import BoundKernel
from ...bearings.linear import LinearBearing
from ...bearings.parallel import ParallelReaction
from ...bearings.reaction import FilmReaction
from ...bearings.rub import RubRing
from ...bearings.sprung import Sprung
from ...errors import FilmContactError, InputError, RotorfilmError, UndefinedDerivativeError, warn_user
from ...model import Reaction
from ...native import Status
from ...native.damper_kernels import OilDamperKernel
from ...native.layouts.run_structs import BothStruct
from ...native.layouts.structs import SprungStruct
from ...native.library import functions, loops
from ...reactions.added_mass import inertial, require_massless

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

    def beside(self, stiffness: float, *, still: bool) -> FilmCall:
        """Return this force beside equal springs [N/m], of a journal that does not spin where it is still."""
        both = SprungStruct(self.address, self.data, stiffness, still)
        return self._replace(
            address=_address("rf_sprung_at"), data=ctypes.addressof(both), owner=(both, self.owner)
        )


def raise_foreign(calls: Iterable[FilmCall]) -> None:
    """Raise what a force in Python raised that the loop around it could not: an error of its own, Ctrl-C."""
    for call in calls:
        if call.raised:
            raise call.raised[0]


def warn_beyond(calls: Iterable[FilmCall]) -> None:
    """Warn that a journal went beyond the map of its film."""
    how = " or ".join(dict.fromkeys(call.beyond for call in calls if call.beyond))
    warn_user(f"a journal went beyond the map of its film; its force is {how}")


def film_call(reaction: Reaction) -> FilmCall:
    """Return the compiled force of a reaction without states, one that calls back where it has none."""
    require_massless("reaction", reaction)
    return kernel_call(reaction) or _called_back(reaction)


class MassCall(NamedTuple):
    """Where the compiled mass that a bearing adds is; zeros where it adds none.

    Attributes
    ----------
    address : int
        Of the function, an rf_mass_response of native/films/film.h.
    data : int
        Its first argument.
    """

    address: int = 0
    data: int = 0


def heavy_call(reaction: Reaction) -> tuple[FilmCall, MassCall]:
    """Return the compiled force of a reaction without states, and the mass that it adds.

    Raises
    ------
    InputError
        If it adds a mass that is not compiled.
    """
    if inertial(reaction) is None:
        return film_call(reaction), MassCall()
    film, inner = kernel_call(reaction), reaction.reaction if isinstance(reaction, Sprung) else reaction
    bound = inner.film_in_c if isinstance(inner, SqueezeFilmDamper) else None
    if film is None or not isinstance(bound, BoundKernel) or not isinstance(bound.kernel, OilDamperKernel):
        raise InputError(
            f"reaction must have its added mass in C here, as a damper on a map, got {reaction!r}"
        )
    return film, MassCall(bound.kernel.mass_address, ctypes.addressof(bound.kernel.struct))


def kernel_call(reaction: Reaction) -> FilmCall | None:
    """Return the force of a reaction in the C library; None if it has none, as one of a user's own class."""
    if isinstance(reaction, FilmReaction):
        return _bound(reaction.film_in_c)
    if type(reaction) is SqueezeFilmDamper or type(reaction) is PorousDamper:
        film = _bound(reaction.film_in_c)
        return None if film is None else film.beside(0.0, still=True)
    if type(reaction) is Sprung:
        inner = kernel_call(reaction.reaction)
        return None if inner is None else inner.beside(reaction.stiffness, still=False)
    if type(reaction) is ParallelReaction:
        return _summed([kernel_call(one) for one in reaction.reactions])
    if type(reaction) is LinearBearing:
        values = np.concatenate([np.ravel(reaction.stiffness), np.ravel(reaction.damping)])
        return FilmCall(address=_address("rf_springs_at"), data=values.ctypes.data, owner=values)
    if type(reaction) is RubRing:
        values = reaction.numbers
        return FilmCall(address=_address("rf_rub_at"), data=values.ctypes.data, owner=values)
    return None


def _summed(calls: Sequence[FilmCall | None]) -> FilmCall | None:
    """Return the sum of forces on one journal; None where one of them has no kernel."""
    total: FilmCall | None = calls[0]
    for call in calls[1:]:
        if total is None or call is None:
            return None
        both = BothStruct(total.address, total.data, call.address, call.data)
        total = FilmCall(
            address=_address("rf_both_at"),
            data=ctypes.addressof(both),
            owner=(both, total, call),
            beyond=total.beyond or call.beyond,
        )
    return total


def _bound(film: object) -> FilmCall | None:
    if not isinstance(film, BoundKernel):
        return None
    data = ctypes.addressof(film.kernel.struct)
    return FilmCall(address=_address(film.kernel.function), data=data, owner=film, beyond=film.beyond)


@cache
def _address(name: str) -> int:
    return ctypes.cast({**functions(), **loops()}[name], c_void_p).value or 0


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
