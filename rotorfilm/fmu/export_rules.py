"""What an export asks for: rules of its arguments, and the model that goes into the FMU."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np

from ..errors import FmuError, InputError, require_finite
from ..inputs.si_arguments import quantity
from ..model import Array, Dynamic, Model, Stepped
from ..native.journal_spec import sized_spec
from ..native.spec import NativeSpec
from .linear_system import from_state_space

VERSIONS = ("2.0", "3.0")
BACKENDS = ("native", "python")
PLATFORMS = ("host", "all")


def exported_subject(model: Any) -> Model | Stepped:
    """Return the model; a python-control system as one."""
    from control import StateSpace

    subject = from_state_space(model) if isinstance(model, StateSpace) else model
    if isinstance(subject, Stepped):
        return subject
    if not isinstance(subject, Model):
        raise FmuError(
            "model must have inputs, outputs, states, output and linearization (a Model) or be a "
            f"control.StateSpace, got {model!r} of type {type(model).__qualname__}"
        )
    if subject.states and not isinstance(subject, Dynamic):
        raise FmuError(f"model must have initial_state and derivative, as it has states, got {model!r}")
    return subject


def is_native(model: Model | Stepped, spec: NativeSpec | None, backend: str | None) -> bool:
    """Return whether the C library runs the model; raise where the backend asked for cannot."""
    if backend is None:
        return spec is not None
    if backend not in BACKENDS:
        raise InputError(f"backend must be one of {list(BACKENDS)} or None, got {backend!r}")
    if backend == "native" and spec is None:
        raise FmuError(
            f"model must have a kernel in the C library for backend='native', got {model!r}; "
            "use backend='python'"
        )
    return backend == "native"


def require_supported(path: Path, version: str, native: bool, platforms: str) -> None:
    """Raise InputError or FmuError where a file, version or platform is not to be had."""
    if path.suffix != ".fmu":
        raise InputError(f"path must end in .fmu, got {str(path)!r}")
    if version not in VERSIONS:
        meant = next((f": as text, version={one!r}" for one in VERSIONS if str(version) in (one, one[0])), "")
        raise InputError(f"version must be one of {list(VERSIONS)}, got {version!r}{meant}")
    if version == "3.0" and not native:
        raise FmuError("version must be '2.0' for the python backend: PythonFMU has no FMI 3.0, got '3.0'")
    if platforms not in PLATFORMS:
        raise InputError(f"platforms must be one of {list(PLATFORMS)}, got {platforms!r}")
    if platforms == "all" and not native:
        raise FmuError("platforms must be 'host' for the python backend, which brings its own, got 'all'")


def sized(spec: NativeSpec | None) -> NativeSpec:
    """Return a kernel with the map of its own radius and length alone; FmuError where it has no other."""
    found = None if spec is None else sized_spec(spec)
    if found is None:
        raise FmuError(
            "model must have a kernel with a map over length / diameter for fixed_size, "
            f"got {'no kernel' if spec is None else repr(spec.kernel)}"
        )
    return found


def title_of(model: Model | Stepped) -> str:
    """Return one line on the model, the first of its docstring."""
    return (type(model).__doc__ or type(model).__name__).strip().splitlines()[0]


@runtime_checkable
class NamedModel(Protocol):
    """What a model may add: the name of its FMU, where the caller gives none."""

    @property
    def component(self) -> str:
        """An ASCII identifier."""


def component_of(model: Any) -> str:
    """Return the name of the FMU of a model."""
    if isinstance(model, NamedModel):
        return model.component
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", type(model).__name__).lower()


def require_component(component: str) -> None:
    """Raise InputError where a name is no C identifier."""
    if not (component.isidentifier() and component.isascii()):
        raise InputError(f"component must be an ASCII identifier without dots, got {component!r}")


def require_output(model: Model | Stepped, inputs: Array) -> None:
    """Raise unless the model has an output at its start values."""
    try:
        output = require_finite("output", _first_output(model, inputs))
    except Exception as error:
        raise InputError(
            f"start must be values at which the model has an output, got {inputs.tolist()}: {error}"
        ) from error
    if output.shape != (len(model.outputs),):
        raise FmuError(f"output must have shape ({len(model.outputs)},), got {output.shape}")


def _first_output(model: Model | Stepped, inputs: Array) -> Array:
    if isinstance(model, Stepped):
        return model.answer(model.start(inputs))
    state = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
    return model.output(0.0, state, inputs)


def start_values(model: Model | Stepped, start: Mapping[str, float | str]) -> dict[str, float]:
    """Return the start value of each input; raise InputError for one that there is not."""
    found = dict.fromkeys((signal.name for signal in model.inputs), 0.0)
    signals = {signal.name: signal for signal in model.inputs}
    for name, value in start.items():
        if name not in found:
            raise InputError(
                f"start must have keys from the inputs {list(found)}, got {name!r}{_state_hint(model, name)}"
            )
        said = f"start[{name!r}]"
        found[name] = float(require_finite(said, quantity(said, value, signals[name].unit)))
    return found


def _state_hint(model: Model | Stepped, name: str) -> str:
    """Return how a state is given its start, where a name is that of one."""
    if isinstance(model, Stepped) or name not in {signal.name for signal in model.states}:
        return ""
    argument = f"start_{name}"
    given = f"{argument} of {type(model).__name__}" if hasattr(model, argument) else "the model"
    return (
        f", a state: {given} says where it starts, and who runs the FMU may set its variable "
        f"state_{name} before the simulation starts"
    )
