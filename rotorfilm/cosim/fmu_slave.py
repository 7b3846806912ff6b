"""FMUs of FMI 2.0 or 3.0 as partners in a co-simulation, run by fmpy.

A film, and a rotor that takes force laws as inputs (or held forces only), is one for Co-Simulation. A rotor
for Model Exchange is integrated by the master.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from ..core.errors import FilmContactError, FmuError, InputError
from ..core.model import Array, Linearization
from ..core.signals import from_fmi_name
from ..fmu import instance as fmus
from ..native.structs import constant, structure
from ..rotors.force_law import BASE_TIME, ForceLaw, law_inputs
from .slaves import Call, CompiledPartner, Integrated, Slave, Wiring

CONTACT = (FilmContactError.__name__, "inside the clearance")
"""What the log of a film FMU contains when its journal touched the wall, in Python and in C."""


class FmuSlave(Slave):
    """An instantiated FMU for Co-Simulation; `open_fmu` makes one and frees it.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Folder where the FMU was extracted.
    exchange : bool
        Whether to instantiate it for Model Exchange.
    """

    def __init__(self, description: Any, folder: str, exchange: bool = False) -> None:
        self._name = description.modelName
        self._failed = False
        self._references = {
            causality: references_of(description, causality) for causality in ("input", "output")
        }
        self.inputs, self.outputs = (tuple(named) for named in self._references.values())
        told = fmus.variables_of(description, "output")
        self.units = {local_name(one.name): one.unit for one in told if one.unit}
        self.differentiates, self.restores = (
            fmus.provides(folder, fmus.DERIVATIVES),
            fmus.provides(folder, fmus.STATES),
        )
        slopes = [unknown.variable for unknown in description.derivatives or ()]
        self._slopes = [slope.valueReference for slope in slopes]
        self._states = [slope.derivative.valueReference for slope in slopes]
        self._wiring: Wiring | None = None
        self._law: fmus.Port | None = None
        self._instance = fmus.instantiated(description, folder, exchange)
        # Values are exchanged in each step: their references are told once.
        self._ports: dict[tuple[str, ...], fmus.Port] = {}
        self._slopes_of: dict[tuple[tuple[int, ...], tuple[int, ...]], Callable[[], Array]] = {}
        self._output = self._instance.port(list(self._references["output"].values()))

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        self._calling(
            "initialization", self._instance.initialize, self._inputs(values), list(values.values())
        )

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by their local names."""
        port = self._ports.get(names := tuple(values)) or self._port(names)
        self._calling("setting inputs", port.set, list(values.values()))

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s]."""
        self._calling("the step from t = {:.9g} s", self._instance.step, t, dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""
        found = self._calling("reading outputs", self._output.get)
        return dict(zip(self._references["output"], found, strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs), shape (n_outputs, n_inputs), now; native FMUs know it."""
        unknowns = [self._references["output"][name] for name in outputs]
        return self._derivatives(unknowns, [self._references["input"][name] for name in inputs])

    def save(self) -> Any:
        """Return the FMU state."""
        return self._calling("saving its state", self._instance.save)

    def restore(self, state: Any) -> None:
        """Return to an FMU state."""
        self._calling("restoring its state", self._instance.restore, state)

    def release(self, state: Any) -> None:
        """Free an FMU state."""
        self._calling("freeing a state", self._instance.release, state)

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it has the inputs of force laws."""
        if wiring is not self._wiring:
            wanted = (BASE_TIME, *(name for station in wiring.stations for name in law_inputs(station)))
            self._wiring, self._law = wiring, self._port(wanted) if set(wanted) <= set(self.inputs) else None
        return self._law is not None

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law; without its inputs, under a held force."""
        if self.takes_laws(wiring):
            assert self._law is not None  # it has just been found
            values = [law.start, *(v for k in range(len(wiring.stations)) for v in law.station(k))]
            self._calling("setting inputs", self._law.set, values)
            self.step(t, dt)
        else:
            super().drive(t, dt, law, wiring)

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives at present, if the FMU tells them of its states."""
        if not (self.differentiates and self._states):
            return None
        inputs, outputs = (list(self._references[which].values()) for which in ("input", "output"))
        whole, n = self._derivatives([*self._slopes, *outputs], [*self._states, *inputs]), len(self._states)
        return Linearization(whole[:n, :n], whole[:n, n:], whole[n:, :n], whole[n:, n:])

    def _derivatives(self, unknowns: Sequence[int], knowns: Sequence[int]) -> Array:
        """Return d(unknowns)/d(knowns) at present."""
        wanted = tuple(unknowns), tuple(knowns)
        if wanted not in self._slopes_of:
            self._slopes_of[wanted] = self._instance.slopes(*wanted)
        return self._calling("reading derivatives", self._slopes_of[wanted])

    def compiled(self, film: bool) -> CompiledPartner | None:
        """Return the functions of the library of the FMU; None of a subclass, which may differ."""
        if type(self) not in (FmuSlave, ExchangeRotor):
            return None
        version, component, functions = self._instance.entry()
        inputs, outputs = self._references["input"], self._references["output"]
        kind, states = constant(f"RF_IS_FMI{version}"), len(self._states)
        struct = structure("rf_partner")(kind=kind, component=component, states=states, **functions)
        return CompiledPartner(struct, inputs, outputs, inputs, self._slopes, self._states)

    def fail(self, call: Call, status: int, t: float) -> None:
        """Raise the FmuError, or FilmContactError, of a call from C that failed in the step from t [s]."""
        doing = {
            Call.PUT: "setting inputs",
            Call.TAKE: "reading outputs",
            Call.STRIDE: f"the step from t = {t:.9g} s",
            Call.SLOPE: "reading derivatives",
            Call.SAVE: "saving its state",
            Call.RESTORE: "restoring its state",
        }
        self._calling(doing[call], self._instance.fail, call.name.lower(), status)

    def close(self) -> None:
        """Terminate, free the instance and unload its library, whatever happened before."""
        # FMI forbids freeing after fmi2Fatal, but PythonFMU calls every exception fatal and its
        # instances can be freed; not freeing them would leak one for each run into the wall.
        with suppress(FMICallException):
            self._instance.close(terminate=not self._failed)

    def _inputs(self, values: Iterable[str]) -> list[int]:
        return [self._references["input"][name] for name in values]

    def _port(self, names: tuple[str, ...]) -> fmus.Port:
        return self._ports.setdefault(names, self._instance.port(self._inputs(names)))

    def _calling(self, doing: str, call: Callable[..., Any], *arguments: Any) -> Any:
        """Call the FMU; an error status is an FmuError, or FilmContactError, that quotes the log.

        What it was `doing` may show the arguments in braces.
        """
        try:
            return call(*arguments)
        except FMICallException as error:
            self._failed = True
            did = doing.format(*arguments)
            text = " ".join([f"FMU {self._name!r} failed in {did}: {error}", *self._instance.log])
            touched = any(phrase in text for phrase in CONTACT)
            raise (FilmContactError if touched else FmuError)(text) from error


class ExchangeRotor(Integrated, FmuSlave):
    """An instantiated rotor FMU for Model Exchange, integrated by the exponential; see `FmuSlave`.

    The FMU tells its directional derivatives.
    """

    def __init__(self, description: Any, folder: str) -> None:
        super().__init__(description, folder, exchange=True)
        self._kink = np.inf
        slopes = (unknown.variable for unknown in description.derivatives or ())
        self.nominals = np.array([fmus.nominal_of(slope.derivative) for slope in slopes])
        self.state, self.base = np.zeros(len(self._states)), np.zeros(len(self.inputs))
        self._input = self._instance.port(list(self._references["input"].values()))

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        if not self.differentiates:
            raise InputError(f"rotor must provide directional derivatives, got {self._name!r} without")
        self._calling("initialization", self._initialize, values)

    def _initialize(self, values: Mapping[str, float]) -> None:
        event = self._instance.initialize(self._inputs(values), list(values.values()))
        self.state = self._instance.states(len(self._states))
        self.base = np.array(self._input.get())
        self._scheduled(event)

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law."""
        self._calling("the step from t = {:.9g} s", super().drive, t, dt, law, wiring)

    def takes_laws(self, wiring: Wiring) -> bool:
        """Return True."""
        return True

    def resume(self, t: float, x: Array) -> None:
        """Go to a time [s] and a state."""
        super().resume(t, x)
        self._instance.move(t, self.state)

    def save(self) -> Any:
        """Return time and state."""
        return self._t, self.state.copy()

    def restore(self, state: Any) -> None:
        """Return to time and state."""
        self.resume(*state)

    def release(self, state: Any) -> None:
        """Do nothing."""

    def rates(self, t: float, x: Array, u: Array) -> Array:
        """Return dx/dt."""
        self._move(t, x, u)
        return self._instance.derivatives(len(x))

    def outcome(self, t: float, x: Array, u: Array) -> Array:
        """Return the outputs."""
        self._move(t, x, u)
        return np.array(self._output.get())

    def matrices(self, t: float, x: Array, u: Array) -> Linearization:
        """Return the exact derivatives."""
        self._move(t, x, u)
        found = self.linear(t)
        assert found is not None  # checked by `start`
        return found

    def next_kink(self, t: float) -> float:
        """Return the next time event [s]."""
        return self._kink

    def pass_kink(self, t: float, x: Array) -> None:
        """Pass through event mode at a time event."""
        self._move(t, x, self.base)
        self._scheduled(self._instance.event())

    def _scheduled(self, event: float | None) -> None:
        self._kink = np.inf if event is None else event

    def _move(self, t: float, x: Array, u: Array) -> None:
        self._instance.move(t, x)
        self._input.set(u.tolist())


def references_of(description: Any, causality: str) -> dict[str, int]:
    """Return the value references of the real inputs or outputs, by local name."""
    references: dict[str, int] = {}
    for variable in fmus.variables_of(description, causality):
        name = local_name(variable.name)
        if name in references:
            raise InputError(f"{causality} names must differ without their component, got {name!r} twice")
        references[name] = variable.valueReference
    return references


def local_name(name: str) -> str:
    """Return the signal of `component.signal`; other spellings stay as they are."""
    try:
        return from_fmi_name(name)[1]
    except InputError:
        return name
