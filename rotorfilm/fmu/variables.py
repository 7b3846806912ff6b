"""The FMI variables of a model: one list, from which the description, the slave and the tables follow."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from ..errors import FmuError
from ..model import Dynamic, Model
from ..signals import Signal, to_fmi_name


class Variable(NamedTuple):
    """One FMI variable; its value reference is its index in the list.

    Attributes
    ----------
    name : str
        Structured name, `component.signal`; states are `component.state_signal`.
    causality : str
        "input", "output" or "local" (a state), as FMI spells them.
    signal : Signal
        Unit, nominal value and description.
    start : float or None
        Start value in the unit of the signal; None for outputs, which are calculated.
    """

    name: str
    causality: str
    signal: Signal
    start: float | None


def fmi_variables(model: Model, component: str, start: Mapping[str, float]) -> tuple[Variable, ...]:
    """Return the inputs, outputs and states of `model` as FMI variables, in this order.

    Parameters
    ----------
    model : Model
    component : str
        Identifier in front of the dot of every name.
    start : mapping of str to float
        Start values of inputs by signal name, in their units; 0 where none is given.

    Raises
    ------
    FmuError
        If two variables would have the same name.
    """
    initial = model.initial_state if isinstance(model, Dynamic) else ()
    variables = (
        *(_variable(component, "", "input", s, float(start.get(s.name, 0.0))) for s in model.inputs),
        *(_variable(component, "", "output", s, None) for s in model.outputs),
        *(
            _variable(component, "state_", "local", s, float(value))
            for s, value in zip(model.states, initial, strict=True)
        ),
    )
    _require_unique([variable.name for variable in variables])
    return variables


def _variable(component: str, prefix: str, causality: str, signal: Signal, start: float | None) -> Variable:
    name = to_fmi_name(component, prefix + signal.name)
    return Variable(name=name, causality=causality, signal=signal, start=start)


def _require_unique(names: list[str]) -> None:
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FmuError(f"model must have signals of different names in an FMU, got {twice} twice")
