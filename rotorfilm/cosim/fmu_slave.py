"""FMUs of FMI 2.0 or 3.0 as partners in a co-simulation, run by fmpy.

A film, and a rotor that takes force laws as inputs (or held forces only), is one for Co-Simulation. A rotor
for Model Exchange is integrated by the master.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from ..errors import FilmContactError, FmuError, InputError
from ..fmu.check.calls import EventInfo
from ..fmu.check.described import DERIVATIVES, STATES, nominal_of, provides, variables_of
from ..fmu.check.instance import instantiated
from ..model import Array, Linearization
from ..rotors.force_law import BASE_TIME, ForceLaw, law_inputs
from ..signals import from_fmi_name
from .schemes.exponential import LawIntegrator
from .wiring import Wiring

CONTACT = (FilmContactError.__name__, "inside the clearance")
"""What the log of a film FMU contains when its journal touched the wall, in Python and in C."""


class FmuSlave:
    """An instantiated FMU for Co-Simulation; `open_fmu` makes one and frees it.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Where the FMU was extracted.
    exchange : bool
        Whether to instantiate it for Model Exchange.
    """

    def __init__(self, description: Any, folder: str, exchange: bool = False) -> None:
        self._name = description.modelName
        self._failed = False
        self._references = {
            causality: _references(description, causality) for causality in ("input", "output")
        }
        told = variables_of(description, "output")
        self.units = {local_name(one.name): one.unit for one in told if one.unit}
        self.differentiates, self.restores = provides(folder, DERIVATIVES), provides(folder, STATES)
        slopes = [unknown.variable for unknown in description.derivatives or ()]
        self._slopes = [slope.valueReference for slope in slopes]
        self._states = [slope.derivative.valueReference for slope in slopes]
        self._nominals = np.array([nominal_of(slope.derivative) for slope in slopes])
        self._wiring: Wiring | None = None
        self._lawful = False
        self._instance = instantiated(description, folder, exchange)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Local names of the real inputs."""
        return tuple(self._references["input"])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Local names of the real outputs."""
        return tuple(self._references["output"])

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        with self._reported("initialization"):
            self._instance.initialize(self._inputs(values), list(values.values()))

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by their local names."""
        with self._reported("setting inputs"):
            self._instance.set(self._inputs(values), list(values.values()))

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s]."""
        with self._reported(f"the step from t = {t:.9g} s"):
            self._instance.step(t, dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""
        references = self._references["output"]
        with self._reported("reading outputs"):
            return dict(zip(references, self._instance.get(list(references.values())), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs), shape (n_outputs, n_inputs), now; native FMUs know it."""
        unknowns = [self._references["output"][name] for name in outputs]
        return self._derivatives(unknowns, [self._references["input"][name] for name in inputs])

    def save(self) -> Any:
        """Return the FMU state."""
        with self._reported("saving its state"):
            return self._instance.save()

    def restore(self, state: Any) -> None:
        """Return to an FMU state."""
        with self._reported("restoring its state"):
            self._instance.restore(state)

    def release(self, state: Any) -> None:
        """Free an FMU state."""
        with self._reported("freeing a state"):
            self._instance.release(state)

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it has the inputs of force laws."""
        if wiring is not self._wiring:
            wanted = [BASE_TIME, *(name for station in wiring.stations for name in law_inputs(station))]
            self._wiring, self._lawful = wiring, set(wanted) <= set(self.inputs)
        return self._lawful

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law; without its inputs, under a held force."""
        if self.takes_laws(wiring):
            values = {BASE_TIME: law.start}
            for number, station in enumerate(wiring.stations):
                values |= dict(zip(law_inputs(station), law.station(number), strict=True))
        elif law.held:
            values = dict(zip(wiring.force, law.force.tolist(), strict=True))
        else:
            raise InputError(f"rotor must have the inputs of a force law, got {list(self.inputs)}")
        self.set(values)
        self.step(t, dt)

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives at present, if the FMU tells them of its states."""
        if not (self.differentiates and self._states):
            return None
        inputs, outputs = (list(self._references[which].values()) for which in ("input", "output"))
        whole, n = self._derivatives([*self._slopes, *outputs], [*self._states, *inputs]), len(self._states)
        return Linearization(whole[:n, :n], whole[:n, n:], whole[n:, :n], whole[n:, n:])

    def _derivatives(self, unknowns: Sequence[int], knowns: Sequence[int]) -> Array:
        """Return d(unknowns)/d(knowns) at present."""
        with self._reported("reading derivatives"):
            columns = [self._instance.directional(unknowns, [known], [1.0]) for known in knowns]
        return np.array(columns).reshape(len(knowns), len(unknowns)).T

    def close(self) -> None:
        """Terminate, free the instance and unload its library, whatever happened before."""
        # FMI forbids freeing after fmi2Fatal, but PythonFMU calls every exception fatal and its
        # instances can be freed; not freeing them would leak one for each run into the wall.
        with suppress(FMICallException):
            self._instance.close(terminate=not self._failed)

    def _inputs(self, values: Mapping[str, float]) -> list[int]:
        return [self._references["input"][name] for name in values]

    @contextmanager
    def _reported(self, doing: str) -> Iterator[None]:
        """Turn an error status into an FmuError, or FilmContactError, that quotes the log."""
        try:
            yield
        except FMICallException as error:
            self._failed = True
            text = " ".join([f"FMU {self._name!r} failed in {doing}: {error}", *self._instance.log])
            touched = any(phrase in text for phrase in CONTACT)
            raise (FilmContactError if touched else FmuError)(text) from error


class ExchangeRotor(FmuSlave):
    """An instantiated rotor FMU for Model Exchange, integrated by the exponential; see `FmuSlave`.

    The FMU tells its directional derivatives. It is a `System`, whose calls go to the FMU.
    """

    def __init__(self, description: Any, folder: str) -> None:
        super().__init__(description, folder, exchange=True)
        self._t, self._kink = 0.0, np.inf
        self._x = np.zeros(len(self._states))
        self._base = np.zeros(len(self.inputs))
        self._integrator: LawIntegrator | None = None

    @property
    def nominals(self) -> Array:
        """Nominal values of the states."""
        return self._nominals

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        if not self.differentiates:
            raise InputError(f"rotor must provide directional derivatives, got {self._name!r} without")
        with self._reported("initialization"):
            event = self._instance.initialize(self._inputs(values), list(values.values()))
            self._x = self._instance.states(len(self._states))
            self._base = np.array(self._instance.get(list(self._references["input"].values())))
        self._scheduled(event)

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law."""
        if self._integrator is None:
            self._integrator = LawIntegrator(self, wiring, self._base)
        with self._reported(f"the step from t = {t:.9g} s"):
            self._x = self._integrator.advance(t, self._x, dt, law)
            self._t = t + dt
            self._instance.move(self._t, self._x)

    def takes_laws(self, wiring: Wiring) -> bool:
        """Return True."""
        return True

    def save(self) -> Any:
        """Return time and state."""
        return self._t, self._x.copy()

    def restore(self, state: Any) -> None:
        """Return to time and state."""
        self._t, self._x = state
        self._instance.move(self._t, self._x)

    def release(self, state: Any) -> None:
        """Do nothing."""

    def rates(self, t: float, x: Array, u: Array) -> Array:
        """Return dx/dt."""
        self._move(t, x, u)
        return self._instance.derivatives(len(x))

    def outcome(self, t: float, x: Array, u: Array) -> Array:
        """Return the outputs."""
        self._move(t, x, u)
        return np.array(self._instance.get(list(self._references["output"].values())))

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
        self._move(t, x, self._base)
        self._scheduled(self._instance.event())

    def _scheduled(self, event: EventInfo) -> None:
        self._kink = np.inf if event.next_time is None else event.next_time

    def _move(self, t: float, x: Array, u: Array) -> None:
        self._instance.move(t, x)
        self._instance.set(list(self._references["input"].values()), u.tolist())


def _references(description: Any, causality: str) -> dict[str, int]:
    """Return the value references of the real inputs or outputs, by local name."""
    references: dict[str, int] = {}
    for variable in variables_of(description, causality):
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
