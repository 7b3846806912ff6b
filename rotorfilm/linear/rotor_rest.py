"""The static equilibrium of a flexible rotor in several bearings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ..bearings.linear import LinearBearing
from ..errors import EquilibriumError, FilmContactError, require_number
from ..inputs.kinds import arguments
from ..model import Array, Reaction
from ..reactions.added_mass import inertial
from ..readable.result import Readable
from ..results import Coefficients
from ..rotors import FlexibleRotor, require_flexible
from ..rotors.structure import Structure
from .large.condensed import models, usual_frequency
from .large.rest_equations import RestEquations
from .large.tilting import (
    coefficients_at,
    require_bearings,
)
from .large.work import counted, tally

KELVIN = 1e-7
"""Change of temperatures [K] below which they are settled."""

WARMINGS = 60
"""Most rounds of rest at given temperatures and temperatures at given rest."""


@dataclass(frozen=True, kw_only=True)
class RotorEquilibrium(Readable):
    """A rotor at rest in its bearings.

    Attributes
    ----------
    speed : float [rad/s]
    coefficients : dict of str to Coefficients
        Stiffness, damping and journal position of each bearing, by station; of one with an added mass that
        too, as `InertialCoefficients`.
    loads : dict of str to ndarray, shape (2,) [N]
        Static load on each bearing, by station; shape (4,) with the moments about x, y [N m] of one that
        resists tilts.
    displacement : ndarray, shape (N,)
        Coordinates of the rotor.
    residual : float [1]
        Largest imbalance of forces / weight; [N] without weight.
    temperatures : dict of str to float [K]
        Of the films whose temperature follows from the balance of their heat, by station.
    work : dict of str to int
        Steps of Newton's method (newton_steps).
    """

    speed: float
    coefficients: dict[str, Coefficients]
    loads: dict[str, Array]
    displacement: Array
    residual: float
    temperatures: dict[str, float] = field(default_factory=dict)
    work: dict[str, int] = field(default_factory=dict, compare=False)


@arguments
def rotor_equilibrium(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float
) -> RotorEquilibrium:
    """Return where a rotor rests in its bearings under its weight.

    In two bearings the loads follow from statics; in more of them from the stiffness of the shaft as well.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        By the name of the station; a station without one is free. Without weight they need not hold the
        rotor. `TiltingBalls` go into stations that feel tilts.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Raises
    ------
    InputError
        If there is no such station.
    EquilibriumError
        If a film cannot carry its load, the bearings do not hold the rotor, or the search does not converge.
    UndefinedDerivativeError
        If a film has no derivative at the equilibrium.

    Warns
    -----
    ValidityWarning
        Where motion at the frequency of the rotation is too fast for the added mass of a film.

    Notes
    -----
    With the displacement q of the rotor and p of the journals in their bearings,
    (K + w H) q = weight + T' F(p) and T q = s p. At s = 0 the bearings are rigid, which gives the
    first loads; s then goes to 1, each step by Newton's method with the exact Jacobian.
    """
    require_flexible(rotor)
    speed = require_number("speed", speed)
    model = next(models(rotor, usual_frequency(rotor, 0.0)))
    with counted("newton_steps") as work:
        at = rest(model.structure, bearings, speed)
    return replace(
        at, displacement=model.lifted(at.displacement), work={"newton_steps": work["newton_steps"]}
    )


def rest(
    structure: Structure,
    bearings: Mapping[str, Reaction],
    speed: float,
    near: RotorEquilibrium | None = None,
) -> RotorEquilibrium:
    """Return where a rotor of these matrices rests, from that at another speed on, as `rotor_equilibrium`."""
    if near is not None and _is_the_same_at_any_speed(structure, bearings):
        return _at_speed(near, speed)
    tally("equilibria")
    require_bearings(bearings)
    for bearing in bearings.values():
        if heavy := inertial(bearing):
            heavy.require_range(abs(speed))
    system = RestEquations(structure, bearings, speed)
    found = None if near is None else _from_near(system, near)
    if found is not None:
        return found
    q, loads = system.on_rigid_bearings()
    alone = system.each_alone(system.split(loads))
    p = np.concatenate([np.zeros(0), *(position for position, _ in alone)])
    temperatures = [temperature for _, temperature in alone]
    for _ in range(WARMINGS):
        system.warm(temperatures)
        q, p = system.rest(q, p)
        last, temperatures = temperatures, system.balanced(p)
        if _is_settled(last, temperatures):
            return _result(system, q, p, temperatures)
    raise EquilibriumError(
        f"rotor must come to rest at the temperatures of its films, and did not in {WARMINGS} rounds: "
        f"they changed from {last} to {temperatures} K"
    )


def _is_the_same_at_any_speed(structure: Structure, bearings: Mapping[str, Reaction]) -> bool:
    """Return whether all bearings are springs and dampers, and no damping that turns presses on them."""
    turning = structure.hysteresis is not None or abs(structure.circulation).max() > 0.0
    return not turning and all(type(bearing) is LinearBearing for bearing in bearings.values())


def _at_speed(at: RotorEquilibrium, speed: float) -> RotorEquilibrium:
    found = {name: replace(one, speed=speed) for name, one in at.coefficients.items()}
    return replace(at, speed=speed, coefficients=found)


def _is_settled(last: list[float | None], now: list[float | None]) -> bool:
    pairs = zip(last, now, strict=True)
    return all(a is None or b is None or abs(a - b) <= KELVIN for a, b in pairs)


def _from_near(system: RestEquations, near: RotorEquilibrium) -> RotorEquilibrium | None:
    """Return the rest by Newton's method from that at another speed; None where that leads nowhere."""
    if near.temperatures or len(near.displacement) != len(system.weight):
        return None
    places = [np.zeros(0), *(near.coefficients[name].position for name in system.names)]
    try:
        q, p = system.solve(near.displacement, np.concatenate(places), 1.0)
    except (EquilibriumError, FilmContactError):
        return None
    return _result(system, q, p, [None] * len(system.names))


def _result(system: RestEquations, q: Array, p: Array, temperatures: list[float | None]) -> RotorEquilibrium:
    forces = system.forces(p)
    places = dict(zip(system.names, system.split(p), strict=True))
    films = dict(zip(system.names, system.bearings, strict=True))
    return RotorEquilibrium(
        speed=system.speed,
        coefficients={name: coefficients_at(films[name], at, system.speed) for name, at in places.items()},
        loads=dict(zip(system.names, system.split(-forces), strict=True)),
        displacement=q,
        residual=float(np.abs(system.residual(q, p, 1.0)[0]).max()) / system.size,
        temperatures={n: T for n, T in zip(system.names, temperatures, strict=True) if T is not None},
    )
