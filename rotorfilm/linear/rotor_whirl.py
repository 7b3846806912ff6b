"""One whirl of a flexible rotor, and the speed at which something happens to it, by inverse iteration."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from ..errors import ConvergenceError
from ..model import Array, Reaction
from ..results import Coefficients
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure
from .coefficients import coefficients
from .equilibrium import equilibrium
from .large.inverse_iteration import CONVERGED, PATIENCE, ROUNDED, dynamics, whirl_near
from .large.second_order import coefficients_near, journal_rows, rest_near, second_order
from .rotor_rest import RotorEquilibrium, rotor_equilibrium
from .speed_events import SpeedEvent

STEP = 1e-3
"""Relative change of speed over which K and C of films are differentiated."""

_STEPS = 25


class RotorFilms(Protocol):
    """Bearings of a rotor, some of them films."""

    @property
    def reaction(self) -> dict[str, Reaction]:
        """All bearings by station."""

    @property
    def turning(self) -> dict[str, Reaction]:
        """Those whose K and C change with the speed."""


class Start(NamedTuple):
    """Where a whirl is looked for: speed [rad/s], eigenvalue [1/s], shape of the rotor."""

    speed: float
    value: complex
    shape: np.ndarray


class Whirl(NamedTuple):
    """A whirl in L(s) = s^2 M + s C + K, all at one speed; K and C are K(s) and its slope of films with it.

    Attributes
    ----------
    at : RotorEquilibrium
    value : complex [1/s]
        s.
    right, left : ndarray of complex, shape (N,)
        L right = 0, left* L = 0.
    """

    at: RotorEquilibrium
    value: complex
    right: np.ndarray
    left: np.ndarray


def on_films(at: RotorEquilibrium, found: dict[str, Coefficients]) -> RotorEquilibrium:
    """Return an equilibrium with other K and C of its bearings."""
    return replace(at, coefficients=found)


def value_rate(structure: Structure, whirl: Whirl, films: RotorFilms) -> complex:
    """Return ds/d speed of a whirl [1]: gyroscopic effect, rotating damping, and the films at K(s)."""
    s, right, left = whirl.value, whirl.right, whirl.left.conj()
    changed = s * (structure.gyroscopic @ right) + structure.circulation @ right
    for name, (stiffness, damping) in coefficient_rates(films, whirl.at, s, STEP).items():
        rows = journal_rows(structure, name)
        changed = changed + rows.T @ ((stiffness + s * damping) @ (rows @ right))
    _, slope = dynamics(second_order(structure, rest_near(whirl.at, s)), s)
    return complex(-(left @ changed) / (left @ slope @ right))


def coefficient_rates(
    films: RotorFilms, at: RotorEquilibrium, s: complex, step: float
) -> dict[str, tuple[Array, Array]]:
    """Return d K/d speed and d C/d speed of each film under its load, from speeds a relative step apart.

    Of a film with K(s) they are those of its matrices near the exponent s.
    """
    rates = {}
    for name, film in films.turning.items():
        low, high = (
            coefficients_near(coefficients(film, equilibrium(film, at.loads[name], speed).position, speed), s)
            for speed in (at.speed * (1.0 - step), at.speed * (1.0 + step))
        )
        width = 2.0 * step * at.speed
        rates[name] = ((high.stiffness - low.stiffness) / width, (high.damping - low.damping) / width)
    return rates


def whirl_of(event: SpeedEvent, rotor: FlexibleRotor, films: RotorFilms, start: Start) -> tuple[Whirl, int]:
    """Return the whirl to which something happens, near another one, and how many speeds that took.

    Raises
    ------
    ConvergenceError
        If Newton's method in the speed does not end.
    """
    reactions = films.reaction
    speed, value, load = start
    for count in range(1, _STEPS + 1):
        at = rotor_equilibrium(rotor, reactions, speed)
        whirl = Whirl(at, *whirl_near(rotor.structure, at, event.frequency(value, speed), value, load))
        lead = event.lead(whirl.value, speed)
        if abs(lead) < CONVERGED * speed:
            return whirl, count
        value, load = whirl.value, whirl.right
        step = -lead / event.rate(value_rate(rotor.structure, whirl, films))
        if count > PATIENCE and abs(step) < ROUNDED * speed:
            return whirl, count
        speed += float(np.clip(step, -0.1 * speed, 0.1 * speed))
    raise ConvergenceError(f"speed near {speed:.6g} rad/s must be found by Newton's method, and was not")
