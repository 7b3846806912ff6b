"""The static equilibrium of a journal on a film whose temperature is a field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from numpy.typing import ArrayLike

from ..errors import ConvergenceError, require_number
from ..inputs.kinds import arguments
from ..model import Reaction
from ..readable.result import Readable
from ..results import Equilibrium
from .equilibrium import checked_load, equilibrium

MOST_ROUNDS = 60


@runtime_checkable
class FieldFilm(Protocol):
    """A film that warms with its temperature a field, as `HeatedFilm`."""

    def cold(self) -> Reaction:
        """Return the film of fresh oil."""

    def warmed(self, position: ArrayLike, speed: float, before: Any = None, *, closing: bool = False) -> Any:
        """Return a state: `film`, of the viscosity of the state before, and what it warms to.

        The `closing` one accounts for the heat to the last digit.
        """

    def is_settled(self, before: Any, state: Any) -> bool:
        """Return whether the last round has changed hardly anything."""


@dataclass(frozen=True, kw_only=True)
class HeatedEquilibrium(Readable):
    """The place of a journal at which a film that warms balances the load.

    Attributes
    ----------
    rest : Equilibrium
        Of the film at its frozen temperature.
    state : HeatedState
        Temperature, pressure, power and flow there; `coefficients(state.film, ...)` are those at frozen
        temperature.
    rounds : int
        Solutions of film and heat in turn.
    """

    rest: Equilibrium
    state: Any
    rounds: int


@arguments
def heated_equilibrium(film: FieldFilm, load: ArrayLike, speed: float) -> HeatedEquilibrium:
    """Return the position at which a film with a temperature field balances a static load.

    The journal finds its place with the temperature frozen, then the oil its temperature with the journal
    held, in turn until both rest.

    Parameters
    ----------
    film : FieldFilm
        Such as `HeatedFilm`.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included.
    speed : float [rad/s]
        Angular speed about +z, of either sign, not 0.

    Raises
    ------
    InputError, EquilibriumError
        As `equilibrium`.
    ConvergenceError
        If the rounds do not come to rest.
    """
    load, speed = checked_load(load), require_number("speed", speed)
    rest = equilibrium(film.cold(), load, speed)
    state: Any = None
    for rounds in range(1, MOST_ROUNDS + 1):
        before, state = state, film.warmed(rest.position, speed, state)
        rest = equilibrium(state.film, load, speed)
        if before is not None and film.is_settled(before, state):
            state = film.warmed(rest.position, speed, state, closing=True)
            rest = equilibrium(state.film, load, speed)
            return HeatedEquilibrium(rest=rest, state=state, rounds=rounds + 1)
    raise ConvergenceError(
        f"film and temperature must come to rest within {MOST_ROUNDS} rounds, and did not under load "
        f"{load.tolist()} N at {speed:g} rad/s",
        state,
    )
