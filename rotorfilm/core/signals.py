"""Signals are data: one source for python-control labels, FMI variables, chart axes and documentation."""

from __future__ import annotations

import keyword
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from .errors import InputError, require_positive
from .units import UNITS


class Freedom(NamedTuple):
    """A motion of a cross section of the shaft: the names of its signals, and where it goes.

    Attributes
    ----------
    rate, force : str
        Names of its rate and of the force, or moment, on the shaft; that of the place is the freedom's own.
    turns : bool
        Whether the place is an angle [rad] and the force a moment [N m].
    way : str
        Direction, as "along x" or "about +x".
    """

    rate: str
    force: str
    turns: bool
    way: str


FREEDOMS: Mapping[str, Freedom] = {
    **{axis: Freedom(f"v{axis}", f"force_{axis}", False, f"along {axis}") for axis in "xyz"},
    **{
        f"tilt_{axis}": Freedom(f"tilt_rate_{axis}", f"moment_{axis}", True, f"about +{axis}")
        for axis in "xy"
    },
    "twist": Freedom("twist_rate", "torque", True, "about +z, besides the rotation"),
}
"""Motions of a cross section of a shaft by name, in the order in which a reaction has them."""

PLANAR = ("x", "y")
"""Freedoms of a journal that moves in its plane; those of a reaction that does not say its own."""


def place_names(freedoms: Sequence[str]) -> list[str]:
    """Return the names of places and rates, the inputs of a reaction but the speed."""
    return [*freedoms, *(FREEDOMS[name].rate for name in freedoms)]


def force_names(freedoms: Sequence[str]) -> list[str]:
    """Return the names of the forces and moments of some freedoms, the first outputs of a reaction."""
    return [FREEDOMS[name].force for name in freedoms]


def checked_freedoms(freedoms: Sequence[str], name: str = "freedoms") -> tuple[str, ...]:
    """Return freedoms as a tuple; InputError unless they are some of `FREEDOMS`, in that order."""
    known = list(FREEDOMS)
    given = (freedoms,) if isinstance(freedoms, str) else tuple(freedoms)
    if not given or list(given) != [one for one in known if one in given]:
        raise InputError(f"{name} must be some of {known}, in this order, got {freedoms!r}")
    return given


MOTION_NAMES = tuple(place_names(PLANAR))
"""Signals of the journal's motion, which a rotor gives."""

JOURNAL_INPUTS = (*MOTION_NAMES, "speed")
"""Signals that the inputs of a planar Reaction begin with."""

FORCE_OUTPUTS = tuple(force_names(PLANAR))
"""Signals that the outputs of a planar Reaction begin with; a rotor takes them as inputs."""


MASS_OUTPUTS = ("mass_xx", "mass_xy", "mass_yy")
"""Signals that follow the force of a Reaction with an added mass."""


@dataclass(frozen=True, kw_only=True)
class Scalar:
    """What Signal, NativeParameter and Variable say of one number.

    Parameters
    ----------
    name : str
    unit : str or None
        SI unit, None where it is not known.
    nominal : float or None
        Typical magnitude [unit], None where it is not known.
    description : str
        What it is and its sign.
    minimum, maximum : float
        Both allowed [unit]; infinite where there is no bound. An FMU tells them; of parameters it enforces
        them.
    """

    name: str
    unit: str | None
    nominal: float | None
    description: str
    minimum: float = -math.inf
    maximum: float = math.inf


@dataclass(frozen=True, kw_only=True)
class Signal(Scalar):
    """One scalar quantity that enters or leaves a model.

    Parameters
    ----------
    name : str
        Underscore identifier, unique within its model (`force_x`).
    unit : str
        SI unit, a key of `rotorfilm.core.units.UNITS` (`"N"`, `"m/s"`, `"1"`).
    nominal : float
        Positive typical magnitude [unit]; scales difference steps, tolerances and FMI nominal values.
    description : str
        Description as for a `Scalar`.
    minimum, maximum : float
        Minimum and maximum as for a `Scalar`.

    Raises
    ------
    InputError
        If the name is no identifier, the unit is unknown or the nominal value is not positive.
    """

    unit: str
    nominal: float

    def __post_init__(self) -> None:
        if not self.name.isidentifier() or keyword.iskeyword(self.name):
            raise InputError(f"name must be an identifier without dots, got {self.name!r}")
        if self.unit not in UNITS:
            raise InputError(f"unit must be one of {sorted(UNITS)}, got {self.unit!r}")
        require_positive("nominal", self.nominal)


@dataclass(frozen=True, kw_only=True)
class Variable(Scalar):
    """One variable of an FMU; its value reference is its place in the list.

    Parameters
    ----------
    name : str
        Structured name, `component.signal`; states are `component.state_signal`.
    unit : str or None
        Unit as for a `Scalar`.
    nominal : float or None
        Nominal as for a `Scalar`.
    description : str
        Description as for a `Scalar`.
    minimum, maximum : float
        Minimum and maximum as for a `Scalar`.
    causality : str
        "input", "output", "local" (a state, its derivative, an event indicator), "parameter" or
        "independent" (the time), as FMI spells them.
    start : float or None
        Start value [unit]; of a state, the initial state. None for what is calculated.
    tunable : bool
        Whether a parameter may be set between steps.
    state : int or None
        For the derivative of a state, the index of the state in the list.
    switch : bool
        Whether it is the value of a switching function, an event indicator.
    array : str
        Name of the array of which it is an element, as its neighbors in the list are; empty for a scalar.
    """

    unit: str | None = None
    nominal: float | None = None
    description: str = ""
    causality: str
    start: float | None = None
    tunable: bool = False
    state: int | None = None
    switch: bool = False
    array: str = ""

    @property
    def variability(self) -> str:
        """As FMI spells it: "continuous", or "tunable" and "fixed" for parameters."""
        if self.causality != "parameter":
            return "continuous"
        return "tunable" if self.tunable else "fixed"


def elements_of(variables: Sequence[Variable], reference: int) -> Sequence[Variable]:
    """Return the elements of the array that begins at a value reference; one of a scalar."""
    end, array = reference + 1, variables[reference].array
    if not array or (reference and variables[reference - 1].array == array):
        return variables[reference:end]
    while end < len(variables) and variables[end].array == array:
        end += 1
    return variables[reference:end]


def names(signals: tuple[Signal, ...]) -> list[str]:
    """Return the names of `signals`, in order: the labels that python-control wants."""
    return [signal.name for signal in signals]


def units(signals: Iterable[Signal]) -> dict[str, str]:
    """Return the units of `signals`, by name."""
    return {signal.name: signal.unit for signal in signals}


def indices(owner: str, available: Sequence[str], needed: Sequence[str]) -> list[int]:
    """Return where each of the signals `needed` is among those available.

    Parameters
    ----------
    owner : str
        Who must have the signals, for the message: `"rotor must have the outputs"`.
    available, needed : sequence of str
        Names of signals.

    Raises
    ------
    InputError
        If a signal is missing.
    """
    missing = [name for name in needed if name not in available]
    if missing:
        raise InputError(f"{owner} {list(needed)}, got {list(available)} without {missing}")
    return [available.index(name) for name in needed]


def to_fmi_name(component: str, name: str) -> str:
    """Return the structured FMI name `component.name`.

    Raises
    ------
    InputError
        If either part is not an identifier, which would make the mapping ambiguous.
    """
    for label, part in (("component", component), ("name", name)):
        if not part.isidentifier():
            raise InputError(f"{label} must be an identifier without dots, got {part!r}")
    return f"{component}.{name}"


def from_fmi_name(fmi_name: str) -> tuple[str, str]:
    """Return (component, name) of a structured FMI name: the inverse of `to_fmi_name`."""
    component, dot, name = fmi_name.partition(".")
    if not (dot and component.isidentifier() and name.isidentifier()):
        raise InputError(f"fmi_name must have the form component.name, got {fmi_name!r}")
    return component, name


def journal_inputs(
    clearance: float, nominal_speed: float, freedoms: Sequence[str] = PLANAR, arm: float = 1.0
) -> tuple[Signal, ...]:
    """Return the signals of places, rates and speed that the inputs of a Reaction begin with.

    Parameters
    ----------
    clearance : float
        Radial clearance [m], the nominal value of positions.
    nominal_speed : float
        Typical angular speed [rad/s]; with the clearance it makes the nominal velocity.
    freedoms : sequence of str
    arm : float [m]
        The clearance over it is the nominal value of tilts.
    """
    places, rates = [], []
    for name in freedoms:
        own = FREEDOMS[name]
        size = clearance / arm if own.turns else clearance
        unit, what = ("rad", "angle of the shaft") if own.turns else ("m", "journal position")
        places.append((name, unit, size, f"{what} {own.way}"))
        what = "angular rate of the shaft" if own.turns else "journal velocity"
        rates.append((own.rate, f"{unit}/s", size * nominal_speed, f"{what} {own.way}"))
    return signals_of(*places, *rates, ("speed", "rad/s", nominal_speed, "angular speed about +z"))


def force_outputs(
    nominal_force: float, freedoms: Sequence[str] = PLANAR, arm: float = 1.0
) -> tuple[Signal, ...]:
    """Return the signals of forces and moments that the outputs of a Reaction begin with.

    Parameters
    ----------
    nominal_force : float [N]
    freedoms : sequence of str
    arm : float [m]
        The nominal force times it is the nominal moment.
    """
    rows = []
    for own in map(FREEDOMS.__getitem__, freedoms):
        unit, size, what = (
            ("N.m", nominal_force * arm, "moment on the shaft")
            if own.turns
            else ("N", nominal_force, "force on the journal")
        )
        rows.append((own.force, unit, size, f"{what} {own.way}"))
    return signals_of(*rows)


@lru_cache(maxsize=1024)
def signals_of(*rows: tuple[str, str, float, str]) -> tuple[Signal, ...]:
    """Return signals from rows of name, unit, nominal value and description; models ask at every step."""
    return tuple(Signal(name=name, unit=unit, nominal=n, description=text) for name, unit, n, text in rows)
