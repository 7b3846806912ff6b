"""The FMI variables of a model: one list, from which the description, the slave and the tables follow."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from ...errors import FmuError
from ...model import Dynamic, Model, Stepped
from ...signals import Scalar, Variable, to_fmi_name

ELEMENT = re.compile(r"[A-Za-z_]\w*\[\d+\]", re.ASCII)
"""An element of an array, as FMI spells it: python-control's default labels."""

QUOTABLE = re.compile(r"[\w!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]+", re.ASCII)
"""What may stand between the quotes of an FMI name."""


def fmi_variables(model: Model | Stepped, component: str, start: Mapping[str, float]) -> tuple[Variable, ...]:
    """Return the inputs, outputs and states of `model` as FMI variables, in this order.

    Parameters
    ----------
    model : Model or Stepped
        A Stepped model shows no states.
    component : str
        Identifier in front of the dot of every name; empty for flat names.
    start : mapping of str to float
        Start values of inputs by signal name, in their units; 0 where none is given.

    Raises
    ------
    FmuError
        If two variables would have the same name.
    """
    initial = model.initial_state if isinstance(model, Dynamic) else ()
    states = model.states if isinstance(model, Model) else ()
    variables = (
        *(labelled(component, "input", s, float(start.get(s.name, 0.0))) for s in model.inputs),
        *(labelled(component, "output", s) for s in model.outputs),
        *(labelled(component, "local", s, float(value)) for s, value in zip(states, initial, strict=True)),
    )
    require_unique(variables)
    return variables


def labelled(component: str, causality: str, signal: Scalar, start: float | None = None) -> Variable:
    """Return the variable of a signal of `component`; the name of a state begins with `state_`."""
    prefix = "state_" if causality == "local" else ""
    return Variable(
        name=structured_name(component, prefix + signal.name),
        causality=causality,
        unit=signal.unit,
        nominal=signal.nominal,
        description=signal.description,
        minimum=signal.minimum,
        maximum=signal.maximum,
        start=start,
    )


def structured_name(component: str, label: str) -> str:
    """Return `component.label`, the label quoted where FMI wants it; without a component the label alone.

    Raises
    ------
    FmuError
        If the label has characters that no FMI name may have.
    """
    if label.isidentifier() and label.isascii():
        return to_fmi_name(component, label) if component else label
    before = f"{component}." if component else ""
    if ELEMENT.fullmatch(label):
        return f"{before}{label}"
    if not QUOTABLE.fullmatch(label):
        raise FmuError(
            f"signal names must be of ASCII letters, digits and !#$%&()*+,-./:;<>=?@[]^{{}}|~, got {label!r}"
        )
    return f"{before}'{label}'"


def require_unique(variables: Sequence[Variable]) -> None:
    """Raise FmuError where two variables have the same name."""
    names = [variable.name for variable in variables]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FmuError(f"model must have signals of different names in an FMU, got {twice} twice")


def references(variables: Sequence[Variable], causality: str) -> list[int]:
    """Return the value references of a causality; of "local" those of the states."""
    return [
        k for k, v in enumerate(variables) if v.causality == causality and v.state is None and not v.switch
    ]


def derivative_references(variables: Sequence[Variable]) -> list[int]:
    """Return the value references of the derivatives of the states."""
    return [k for k, v in enumerate(variables) if v.state is not None]


def switch_references(variables: Sequence[Variable]) -> list[int]:
    """Return the value references of the event indicators."""
    return [k for k, v in enumerate(variables) if v.switch]
