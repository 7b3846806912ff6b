"""Export of a model as an FMU: checks, the choice of the backend, the archive."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import FmuError, InputError, RotorfilmError, require_finite, require_positive
from ..core.files import write_atomically
from ..core.inputs import arguments, quantity, require_choice
from ..core.model import Array, Dynamic, Linearization, Model, Stepped
from ..core.port import freedoms_of, from_rest, in_time, inertial
from ..core.signals import PLANAR, Signal, indices, names
from ..native.spec import HasKernel, NativeSpec, sized_spec
from .archive import copyright_line, to_zip
from .native.native_backend import Export, native_contents
from .python.python_backend import python_contents
from .reference import answered, begun, from_state_space

if TYPE_CHECKING:
    import control


@arguments
def export_fmu(
    model: Model | Stepped | control.StateSpace,
    path: str | Path,
    version: str = "2.0",
    backend: str | None = None,
    *,
    platforms: str = "host",
    component: str | None = None,
    start: Mapping[str, float | str] | None = None,
    stop_time: float = 0.1,
    step_size: float = 1e-4,
    author: str = "",
    flat_names: bool = False,
    fixed_size: bool = False,
    arrays: bool = False,
) -> Path:
    """Write `model` as an FMU.

    A model with a kernel in the C library becomes a native FMU: Model Exchange and Co-Simulation in one, with
    exact directional derivatives, its own sources, tunable parameters and a reference trajectory, and without
    need of Python. Any other model becomes an FMI 2.0 Co-Simulation FMU that carries its Python source. The
    outputs of a Stepped model belong to the end of the last step; with a kernel its FMU is native too, for
    Co-Simulation only and without derivatives.

    Equal models give byte-identical files. Each signal is a structured variable `component.signal`, each
    state a local `component.state_signal`, settable before the simulation starts. A bearing and a rotor have
    a terminal for each journal, with position, velocity, speed and force. The FMU contains the time of the
    export only if the environment variable SOURCE_DATE_EPOCH gives it, in seconds since 1970.

    Parameters
    ----------
    model : Model, Stepped or control.StateSpace
        A continuous python-control system is a model whose signals are its labels. For the python backend it
        must be a dataclass (of this package or from a module of the user) whose fields are numbers, bools,
        strings, None, tuples, lists, numpy arrays, functions from the top of such a module, or such
        dataclasses.
    path : str or Path
        File to write, ending in `.fmu`; its folder is made if need be.
    version : str
        FMI version, "2.0" or "3.0"; the python backend supports "2.0" only.
    backend : str, optional
        What runs the model inside the FMU: "native", the C library, or "python", PythonFMU. By default
        "native" for a model with a kernel, else "python".
    platforms : str
        "host", the platform of this machine, or "all": Linux on x86_64 and aarch64, Windows on x86_64,
        macOS on both, compiled by zig (`pip install 'rotorfilm[platforms]'`). For the native backend.
    component : str, optional
        Identifier in front of the dot of each variable's name, and name of the FMU; by default that of
        a bearing by `as_reaction`, or of the model's class in snake case.
    start : mapping of str to float, optional
        Start values of inputs by signal name, in SI units; 0 where none is given. Pads without a `start` of
        their own begin in the tilts in which they rest under a journal at this position and speed.
    stop_time, step_size : float [s]
        Default experiment that the FMU suggests.
    author : str
        Who made the model, for the description; empty to name nobody.
    flat_names : bool
        Whether variables are named `signal` and `state_signal`, without the component.
    fixed_size : bool
        Whether radius and length of a plain journal bearing are fixed. The FMU then carries the map of their
        ratio only, which makes it a third smaller.
    arrays : bool
        Whether inputs and outputs that are components of a vector (x and y) are arrays of two numbers:
        `position`, `velocity`, `force`, `tilt`, `tilt_rate`, `moment`. For FMI 3.0 by the native backend.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    InputError
        If another argument breaks its rule; the message names it.
    FmuError
        If the model cannot be exported, has no kernel for the native backend, zig is needed and not
        installed, or the installed pythonfmu is not the verified version.
    """
    target = Path(path)
    for argument, value in (("stop_time", stop_time), ("step_size", step_size)):
        require_positive(argument, value)
    subject = pads_at_rest(in_time(exported_subject(model)), start or {})
    spec = subject.native() if isinstance(subject, HasKernel) else None
    native = is_native(subject, spec, backend)
    spec = sized(spec) if fixed_size else spec
    require_supported(target, version, native, platforms)
    if arrays and not (native and version == "3.0"):
        raise InputError(
            f"arrays must be False unless FMI is 3.0 and the backend native, got version {version!r} and the "
            f"{'native' if native else 'python'} backend"
        )
    name = component_of(model) if component is None else component
    require_component(name)
    prefix = "" if flat_names else name
    title = title_of(subject)
    subject = as_exported(subject) if native and isinstance(subject, Model) else subject
    inputs = np.array(list(start_values(subject, start or {}).values()))
    require_output(subject, inputs)
    described = {
        "identifier": name,
        "title": title,
        "copyright": copyright_line(),
        "stop_time": float(stop_time),
        "step_size": float(step_size),
        "author": author,
        "structured": bool(prefix),
    }
    if native and spec is not None:
        export = Export(subject, spec, name, title, inputs, stop_time, version, platforms, prefix, arrays)
        contents = native_contents(export, described)
    else:
        contents = python_contents(subject, prefix, inputs, described)
    target.parent.mkdir(parents=True, exist_ok=True)
    return write_atomically(target, to_zip(contents))


# What an export asks for: rules of its arguments, and the model that goes into the FMU.


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
    if inertial(subject) is not None and freedoms_of(subject) != PLANAR:
        raise FmuError(
            "model must not add mass to motions other than x and y, because an FMU has no outputs for it, "
            f"got {model!r}: "
            "mount(rotor, ...) makes one FMU of rotor and film"
        )
    return subject


def is_native(model: Model | Stepped, spec: NativeSpec | None, backend: str | None) -> bool:
    """Return whether the C library runs the model; raise where the backend asked for cannot."""
    if backend is None:
        return spec is not None
    require_choice("backend", backend, BACKENDS)
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
        raise InputError(f"version must be one of {', '.join(VERSIONS)}, got {version!r}{meant}")
    if version == "3.0" and not native:
        raise FmuError("version must be '2.0' for the python backend: PythonFMU has no FMI 3.0, got '3.0'")
    require_choice("platforms", platforms, PLATFORMS)
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


def component_of(model: Any) -> str:
    """Return the name of the FMU of a model: what it calls its `component`, or its class in snake case."""
    if hasattr(model, "component"):
        return str(model.component)
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", type(model).__name__).lower()


def require_component(component: str) -> None:
    """Raise InputError where a name is no C identifier."""
    if not (component.isidentifier() and component.isascii()):
        raise InputError(f"component must be an ASCII identifier without dots, got {component!r}")


def require_output(model: Model | Stepped, inputs: Array) -> None:
    """Raise unless the model has an output at its start values."""
    try:
        output = require_finite("output", answered(model, 0.0, begun(model, inputs), inputs))
    except Exception as error:
        raise InputError(
            f"start must be values at which the model has an output, got {inputs.tolist()}: {error}"
        ) from error
    if output.shape != (len(model.outputs),):
        raise FmuError(f"output must have shape ({len(model.outputs)},), got {output.shape}")


def start_values(model: Model | Stepped, start: Mapping[str, float | str]) -> dict[str, float]:
    """Return the start value of each input; raise InputError for one that there is not."""
    found = dict.fromkeys((signal.name for signal in model.inputs), 0.0)
    signals = {signal.name: signal for signal in model.inputs}
    for name, value in start.items():
        if name not in found:
            raise InputError(
                f"start must have keys from the inputs {list(found)}, got {name!r}{_state_hint(model, name)}"
            )
        argument = f"start[{name!r}]"
        found[name] = float(require_finite(argument, quantity(argument, value, signals[name].unit)))
    return found


def pads_at_rest(model: Model | Stepped, start: Mapping[str, float | str]) -> Any:
    """Return tilting pads in the tilts of a journal at rest at the start values; any other model as it is.

    Pads with a start of their own keep it, and so do pads without speed, which have no such tilts.
    """
    if not hasattr(model, "from_rest") or getattr(model, "start", None):
        return model
    x, y, speed = (start_values(model, start)[name] for name in ("x", "y", "speed"))
    if speed == 0.0 or x == y == 0.0:
        return model
    try:
        return from_rest(model, np.array([x, y]), speed, None)
    except RotorfilmError as error:
        raise InputError(
            f"start must be values at which the pads rest, unless the bearing has its own start; got "
            f"{[x, y, speed]}: {error}"
        ) from error


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


# A model without the inputs that have no effect on it.


@dataclass(frozen=True)
class NarrowModel:
    """A model without states, seen through some of its inputs; the others stay 0.

    Parameters
    ----------
    model : Model
    kept : tuple of str
        Names of inputs.

    Raises
    ------
    InputError
        If the model lacks one of them.
    """

    model: Model
    kept: tuple[str, ...]

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs kept."""
        return tuple(self.model.inputs[k] for k in self._places)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the model."""
        return self.model.outputs

    @property
    def states(self) -> tuple[Signal, ...]:
        """Those of the model: none."""
        return self.model.states

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the output of the model, shape (n_outputs,)."""
        return self.model.output(t, x, self._widened(u))

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the derivatives of the model by the inputs kept."""
        A, B, C, D = self.model.linearization(t, x, self._widened(u))
        return Linearization(A, B[:, self._places], C, D[:, self._places])

    @cached_property
    def _places(self) -> list[int]:
        return indices("model must have the inputs", names(self.model.inputs), self.kept)

    @cached_property
    def _width(self) -> int:
        return len(self.model.inputs)

    def _widened(self, u: ArrayLike) -> Array:
        wide = np.zeros(self._width)
        wide[self._places] = u
        return wide


def as_exported(model: Model) -> Model:
    """Return a model as its native FMU shows it: without inputs that its kernel does not take."""
    spec = model.native() if isinstance(model, HasKernel) else None
    return model if spec is None or spec.inputs is None else NarrowModel(model, spec.inputs)
