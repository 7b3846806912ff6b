"""What a master asks of its partners, and models in this process as such partners."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Mapping, Sequence
from ctypes import byref
from dataclasses import dataclass
from enum import IntEnum
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from ..core import signals
from ..core.errors import ConvergenceError, InputError
from ..core.inputs import require_choice
from ..core.model import Array, Dynamic, Linearization, Model, Stepped, breakpoints
from ..core.port import in_time
from ..fmu.reference import advance
from ..native.library import master
from ..native.spec import HasKernel
from ..native.structs import constant, structure
from ..rotors.force_law import ForceLaw
from ..rotors.structure import station_name, station_names

# How rotor and films are connected: by the names of their signals.


Names = tuple[Sequence[str], Sequence[str]]
"""Of the inputs and of the outputs of a partner."""


Places = tuple[list[int], list[int], list[int]]
"""Where forces, positions and velocities of journals are among a rotor's inputs and outputs."""


class Wiring(NamedTuple):
    """Which signals of a rotor belong to its journals, by name; x and y of each station in turn.

    Attributes
    ----------
    stations : tuple of str
        The empty name is that of a rotor with one journal.
    force, position, velocity : tuple of str, length 2 n_stations
    """

    stations: tuple[str, ...]
    force: tuple[str, ...]
    position: tuple[str, ...]
    velocity: tuple[str, ...]

    def places(self, inputs: Sequence[str], outputs: Sequence[str]) -> Places:
        """Return where the signals of the journals are among those of the rotor."""
        return (
            [inputs.index(name) for name in self.force],
            [outputs.index(name) for name in self.position],
            [outputs.index(name) for name in self.velocity],
        )


def wired(rotor: Names, films: Mapping[str, Names]) -> Wiring:
    """Return the signals of the journals, having checked that rotor and films have all that connects them.

    Parameters
    ----------
    rotor : (sequence of str, sequence of str)
        Names of its inputs and outputs.
    films : mapping of str to the same
        Films by station.

    Raises
    ------
    InputError
        If there is no film, or a signal is missing.
    """
    if not films:
        raise InputError("films must be one at least, got none")
    motions, forces = zip(*(station_names(station) for station in films), strict=True)
    taken, told = rotor
    for (station, (inputs, outputs)), motion, force in zip(films.items(), motions, forces, strict=True):
        require_planar(inputs, outputs)
        signals.indices("rotor must have the inputs", taken, force)
        signals.indices("film must have the outputs", outputs, signals.FORCE_OUTPUTS)
        require_no_mass(outputs, taken)
        signals.indices("rotor must have the outputs", told, list(sources(told, station, inputs).values()))
        signals.indices("rotor must have the outputs", told, motion)
    return Wiring(
        tuple(films),
        tuple(name for own in forces for name in own),
        tuple(name for own in motions for name in own[:2]),
        tuple(name for own in motions for name in own[2:]),
    )


def require_planar(inputs: Sequence[str], outputs: Sequence[str]) -> None:
    """Raise InputError where a film has a further freedom than x, y, by the names of its signals."""
    further = [name for name in signals.FREEDOMS if name not in signals.PLANAR]
    known = [name for name in (*inputs, *outputs) if name in (*further, *signals.force_names(further))]
    if known:
        raise InputError(
            f"film must react to x and y alone in a co-simulation, got the signals {known}: simulate and "
            "mount(rotor, ...) take other freedoms"
        )


def require_no_mass(film: Sequence[str], rotor: Sequence[str]) -> None:
    """Raise InputError where a film adds mass that the rotor does not take; names of outputs and inputs."""
    if signals.MASS_OUTPUTS[0] in film and signals.MASS_OUTPUTS[0] not in rotor:
        raise InputError(
            "film must not add mass to a rotor without inputs for it, got the outputs "
            f"{list(signals.MASS_OUTPUTS)}. An exchange of accelerations multiplies its error by -mass/rotor "
            "mass, and diverges if the oil is heavier than the rotor: use mount(rotor, ...), which makes "
            "one FMU of rotor and film"
        )


def sources(outputs: Sequence[str], station: str, inputs: Iterable[str]) -> dict[str, str]:
    """Return, for each input of a film, the output of the rotor that feeds it."""
    own = {name: station_name(station, name) for name in inputs}
    return {name: at if name in signals.MOTION_NAMES or at in outputs else name for name, at in own.items()}


# What a master asks of its partners, and models in this process as such partners.


class Call(IntEnum):
    """rf_call of partner.h."""

    PUT = 0
    TAKE = 1
    STRIDE = 2
    SLOPE = 3
    MOVE = 4
    RATE = 5
    SAVE = 6
    RESTORE = 7


class Slave:
    """A partner in a co-simulation: it holds its inputs and steps on its own.

    Signals go by their local names, without the component, in SI units. Held forces need no more than the
    first four methods; other schemes ask for derivatives, a way back, or a rotor that takes force laws.

    Attributes
    ----------
    inputs, outputs : tuple of str
    units : mapping of str to str
        SI units by the names of the outputs, where they are known.
    differentiates : bool
        Whether it knows its `jacobian`.
    restores : bool
        Whether it can go back.
    """

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    units: Mapping[str, str] = MappingProxyType({})
    differentiates: bool = False
    restores: bool = False

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs; inputs not named keep their start values."""

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs."""

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s] under the inputs set."""

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""
        raise NotImplementedError(f"{type(self).__name__} must define get")

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs) at present, shape (n_outputs, n_inputs)."""
        raise NotImplementedError(f"{type(self).__name__} must define jacobian")

    def save(self) -> Any:
        """Return the state at present."""
        raise NotImplementedError(f"{type(self).__name__} must define save")

    def restore(self, state: Any) -> None:
        """Return to a state."""

    def release(self, state: Any) -> None:
        """Forget a state."""

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it is a rotor that takes any force law; otherwise held forces only."""
        return False

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law, here a held force."""
        if not law.held:
            raise InputError(f"rotor must have the inputs of a force law, got {list(self.inputs)}")
        self.set(dict(zip(wiring.force, law.force.tolist(), strict=True)))
        self.step(t, dt)

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives of the rotor at present, if it knows them."""
        return None

    def compiled(self, film: bool) -> CompiledPartner | None:
        """Return how the loop in C calls it, as a film or as the rotor; None if it does not."""
        return None

    def fail(self, call: Call, status: int, t: float) -> None:
        """Raise what a call from C that failed in the step from t [s] means."""


class Integrated(Slave):
    """A rotor that the master integrates.

    Attributes
    ----------
    state : ndarray, shape (n_states,)
        The state at present.
    nominals : ndarray, shape (n_states,)
        Typical magnitudes of the states.
    base : ndarray, shape (n_inputs,)
        The inputs beside the forces of films.
    rates, outcome, matrices : callable
        (t, x, u) -> dx/dt, the outputs, and the exact derivatives.
    """

    state: Array
    nominals: Array
    base: Array
    rates: Callable[[float, Array, Array], Array]
    outcome: Callable[[float, Array, Array], Array]
    matrices: Callable[[float, Array, Array], Linearization]
    _t = 0.0
    _integrator: LawIntegrator | None = None

    def next_kink(self, t: float) -> float:
        """Return the first time after t [s] at which the rates have a kink; infinite without one."""
        return np.inf

    def pass_kink(self, t: float, x: Array) -> None:
        """Go beyond a kink at the time t [s]."""

    def resume(self, t: float, x: Array) -> None:
        """Go to a time [s] and a state."""
        self._t, self.state = t, x.copy()

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance from t to t + dt [s] under a force law."""
        if self._integrator is None:
            self._integrator = LawIntegrator(self, wiring)
        self.resume(t + dt, self._integrator.advance(t, self.state, dt, law))


class _Held(Slave):
    """A model in this process that holds its inputs."""

    restores = True

    def __init__(self, model: Model | Stepped) -> None:
        self.inputs, self.outputs = tuple(signals.names(model.inputs)), tuple(signals.names(model.outputs))
        self.units = signals.units(model.outputs)
        self._u = np.zeros(len(self.inputs))

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by name; raise InputError for a name that is none."""
        for name, value in values.items():
            require_choice("input", name, self.inputs)
            self._u[self.inputs.index(name)] = value


class InProcessSlave(_Held, Integrated):
    """A model in this process, stepped as its own FMU would step it.

    Parameters
    ----------
    model : Model
        Model with or without states.
    """

    def __init__(self, model: Model) -> None:
        self._model = model = in_time(model)
        super().__init__(model)
        self.differentiates = hasattr(model, "linearization")
        # Asked once: checks against protocols are slow.
        self._moving = model if isinstance(model, Dynamic) else None
        self.state, self.base = np.zeros(0), self._u
        self._kinks: tuple[float, ...] = ()
        self.nominals = np.array([signal.nominal for signal in model.states])
        self.outcome = model.output
        if self.differentiates:
            self.matrices = model.linearization
        if self._moving is not None:
            self.rates, self.state = self._moving.derivative, self._moving.initial_state
            self._kinks = breakpoints(model)

    def start(self, values: Mapping[str, float]) -> None:
        """Set the inputs at t = 0."""
        self.set(values)

    def step(self, t: float, dt: float) -> None:
        """Advance the states from t to t + dt [s] under the inputs held."""
        if self._moving is not None:
            self.state = advance(self._moving, t, self.state, self._u.copy(), dt)
        self._t = t + dt

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time, state and inputs."""
        found = self._model.output(self._t, self.state, self._u)
        return dict(zip(self.outputs, found.tolist(), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs) at present, shape (n_outputs, n_inputs)."""
        rows, columns = [self.outputs.index(n) for n in outputs], [self.inputs.index(n) for n in inputs]
        return self._model.linearization(self._t, self.state, self._u).D[np.ix_(rows, columns)]

    def save(self) -> tuple[float, Array, Array]:
        """Return time, states and inputs."""
        return self._t, self.state.copy(), self._u.copy()

    def restore(self, state: tuple[float, Array, Array]) -> None:
        """Return to time, states and inputs."""
        self._t, self.state, self._u[:] = state[0], state[1].copy(), state[2]

    def takes_laws(self, wiring: Wiring) -> bool:
        """Whether it is a rotor, that is, has states."""
        return self._moving is not None

    def drive(self, t: float, dt: float, law: ForceLaw, wiring: Wiring) -> None:
        """Advance the states from t to t + dt [s] under a force law."""
        if self._moving is None:
            raise InputError(f"rotor must have states, got {self._model!r}")
        super().drive(t, dt, law, wiring)

    def linear(self, t: float) -> Linearization | None:
        """Return the exact derivatives at present."""
        return self.matrices(t, self.state, self._u)

    def compiled(self, film: bool) -> CompiledPartner | None:
        """Return the kernel of the model, for a film without states or a rotor with some."""
        if type(self) is not InProcessSlave or film is (self._moving is not None):
            return None
        return kernel_partner(self._model)

    def fail(self, call: Call, status: int, t: float) -> None:
        """Raise what the model raises where its kernel failed."""
        self.get()
        self.jacobian(self.outputs, self.inputs)

    def next_kink(self, t: float) -> float:
        """Return the next kink after t [s]."""
        return min((kink for kink in self._kinks if kink > t), default=np.inf)


class SteppedPartner(_Held):
    """A mass-conserving film, stepped as its FMU would step it, which tells its slopes besides.

    Parameters
    ----------
    film : Stepped
        Film that takes steps with their slope, as a `JFOFilm`.
    """

    differentiates = True

    def __init__(self, film: Any) -> None:
        super().__init__(film)
        self._film, self._state = film, None

    def start(self, values: Mapping[str, float]) -> None:
        """Find the steady film of the inputs at t = 0."""
        self.set(values)
        self._state = self._film.start(self._u.copy())

    def step(self, t: float, dt: float) -> None:
        """Advance the film from t to t + dt [s], to where the inputs are at the end."""
        self._state, _, _ = self._film.step(self._state, t, self._u.copy(), dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the end of the last step."""
        return dict(zip(self.outputs, self._film.answer(self._state).tolist(), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(force)/d(motion) of the film whose past is held, shape (n_outputs, n_inputs)."""
        rows, columns = (
            [signals.FORCE_OUTPUTS.index(n) for n in outputs],
            [signals.JOURNAL_INPUTS.index(n) for n in inputs],
        )
        return self._film.slopes(self._state)[np.ix_(rows, columns)]

    def save(self) -> tuple[Any, Array]:
        """Return the state and the inputs; states are never changed."""
        return self._state, self._u.copy()

    def restore(self, state: tuple[Any, Array]) -> None:
        """Return to a state and inputs."""
        self._state, self._u = state[0], state[1].copy()


# Partners as the compiled loop calls them: the functions of an FMU's library, or a kernel of ours.


@dataclass(eq=False)
class CompiledPartner:
    """A partner with its references by the names of its signals.

    Parameters
    ----------
    struct : rf_partner
        The partner as the loop in C has it.
    inputs, outputs : mapping of str to int
        References to set inputs and to get outputs by.
    knowns : mapping of str to int
        References of the inputs in derivatives.
    rates, states : list of int
        References of the derivatives of the states, and of the states, in derivatives.
    own : rf_own, optional
        Of a kernel, which is closed with it.
    tables : Any
        What the kernel reads.
    """

    struct: Any
    inputs: dict[str, int]
    outputs: dict[str, int]
    knowns: dict[str, int]
    rates: list[int]
    states: list[int]
    own: Any = None
    tables: Any = None

    def __del__(self) -> None:
        if self.own is not None:
            master()["rf_close_kernel"](ctypes.addressof(self.own))

    def sync(self, t: float, x: Array) -> None:
        """Take a time and a state, before the loop goes on; an FMU holds its own, or is told in each step."""
        if self.own is not None:
            self.own.t = t
            _numbers(self.own.x, len(x))[:] = x.tolist()

    def inputs_now(self) -> dict[str, float]:
        """Return the inputs of a kernel at present."""
        return dict(zip(self.inputs, _numbers(self.own.u, len(self.inputs)), strict=True))

    @property
    def goes_back(self) -> bool:
        """Whether its state can be saved, restored and freed in C."""
        struct = self.struct
        return self.own is not None or bool(struct.save and struct.restore and struct.forget)

    def beyond(self) -> dict[str, float] | None:
        """Return the first inputs since the last call at which a kernel was beyond its verified range."""
        if self.own is None or not self.own.outside:
            return None
        self.own.outside = 0
        return dict(zip(self.inputs, _numbers(self.own.beyond, len(self.inputs)), strict=True))


def kernel_partner(model: Model) -> CompiledPartner | None:
    """Return a model by its kernel; None if it has none, or one that steps by itself.

    Raises
    ------
    InputError
        If tables or parameters do not fit the kernel.
    """
    spec = model.native() if isinstance(model, HasKernel) and isinstance(model, Model) else None
    if spec is None:
        return None
    numbers = {name: np.ascontiguousarray(table, dtype=float) for name, table in spec.tables.items()}
    rows = [_table(name, table) for name, table in numbers.items()]
    tables = (structure("rf_table") * len(rows))(*rows)
    why, listed = structure("rf_message")(), structure("rf_tables")(ctypes.addressof(tables), len(rows))
    values = np.array([parameter.value for parameter in spec.parameters])
    given = spec.kernel.encode(), byref(listed), values.ctypes.data
    at = master()["rf_open_kernel"](*given, byref(why))
    if not at:
        raise InputError(why.text.decode(errors="replace"))
    own = structure("rf_own").from_address(at)
    sizes = own.sizes.inputs, own.sizes.outputs, own.sizes.states
    inputs = signals.names(model.inputs) if spec.inputs is None else spec.inputs
    outputs, first = signals.names(model.outputs), own.sizes.states
    found = CompiledPartner(
        structure("rf_partner")(kind=constant("RF_IS_KERNEL"), component=at, states=first),
        {name: k for k, name in enumerate(inputs)},
        {name: k for k, name in enumerate(outputs)},
        {name: first + k for k, name in enumerate(inputs)},
        [own.sizes.outputs + k for k in range(first)],
        list(range(first)),
        own,
        (numbers, tables),
    )
    return found if sizes == (len(inputs), len(outputs), len(model.states)) else None


def _numbers(address: int | None, count: int) -> Any:
    """Return so many numbers at an address."""
    return (ctypes.c_double * count).from_address(address or 0)


def _table(name: str, numbers: Array) -> Any:
    extent = (*numbers.shape, 0, 0, 0, 0)[:4]
    return structure("rf_table")(name.encode(), numbers.ndim, extent, numbers.ctypes.data)


# Integration of a rotor under a force law by the matrix exponential, exact where the rotor is linear.
#
# Over a step from (t, x), y = x(t + tau) - x obeys y' = M y + g(tau) + r with M = A + B dF/d(motion)
# C, the film's stiffness and damping included, g(tau) the rate of the frozen state x at t + tau, and
# a remainder r that is zero for a linear rotor. g is interpolated by a polynomial, and
#
# y(H) = int_0^H exp(M (H - tau)) g(tau) dtau
#
# follows from one exponential of an augmented matrix (Van Loan 1978). One more call of the rotor at
# the end tells whether polynomial and linearity hold; where they do not, the step is halved, and a
# rotor that is not linear is integrated by Radau's method.


DEGREE = 6
"""Degree of the polynomial of the rates in time."""

NODES = np.concatenate([[0.0], 0.5 - 0.5 * np.cos(np.pi * (2.0 * np.arange(DEGREE) + 1.0) / (2.0 * DEGREE))])
"""Where the rates are taken, in steps."""

TO_POWERS = np.linalg.inv(np.vander(NODES, increasing=True))
"""Coefficients of the polynomial from the rates at the nodes."""

TOLERANCE = 1e-9
"""Of the state at the end of a step, relative to it and to its nominal value."""

HALVINGS = 4
"""How often a step is halved before the rotor counts as not linear."""


class LawIntegrator:
    """Advances the state of a rotor under force laws.

    Parameters
    ----------
    system : Integrated
    wiring : Wiring
    """

    def __init__(self, system: Integrated, wiring: Wiring) -> None:
        self._system, self._inputs = system, system.base.copy()
        self._force, self._position, self._velocity = wiring.places(system.inputs, system.outputs)
        self._matrices: Linearization | None = None
        self._held = False

    def advance(self, t: float, x: Array, dt: float, law: ForceLaw) -> Array:
        """Return the state at t + dt.

        Raises
        ------
        ConvergenceError
            If the rotor cannot be integrated.
        """
        self._held = law.held
        while dt > 0.0:
            kink = self._system.next_kink(t)
            step = min(dt, kink - t)
            x = self._smooth(t, x, step, law, HALVINGS)
            if kink <= t + dt:
                self._system.pass_kink(kink, x)
                self._matrices = None
            t, dt = t + step, dt - step if step < dt else 0.0
        return x

    def _smooth(self, t: float, x: Array, dt: float, law: ForceLaw, halvings: int) -> Array:
        for fresh in (False, True):
            if fresh or self._matrices is None:
                self._matrices = self._system.matrices(t, x, self._inputs)
            end, error = self._trial(t, x, dt, law, self._matrices)
            if error <= 1.0:
                return end
        if halvings == 0:
            return self._stiff(t, x, dt, law)
        middle = self._smooth(t, x, 0.5 * dt, law, halvings - 1)
        return self._smooth(t + 0.5 * dt, middle, 0.5 * dt, law, halvings - 1)

    def _trial(
        self, t: float, x: Array, dt: float, law: ForceLaw, matrices: Linearization
    ) -> tuple[Array, float]:
        """Return the state after an exponential step, and its error in tolerances."""
        nominal = self._system.nominals
        M = self._loop(matrices, law)
        rates = np.array([self._rates(t + node * dt, x, law) for node in NODES])
        powers = (TO_POWERS @ rates).T
        y = nominal * _integral(dt * M * nominal / nominal[:, None], dt * powers / nominal[:, None])
        # Just before the end, where there may be a kink.
        found = self._rates(float(np.nextafter(t + dt, t)), x + y, law)
        defect = found - M @ y - powers.sum(axis=1)
        allowed = TOLERANCE * (nominal + np.abs(y)) + 1e-14 * np.abs(dt * found)
        return x + y, float(np.max(np.abs(dt * defect) / allowed, initial=0.0))

    def _stiff(self, t: float, x: Array, dt: float, law: ForceLaw) -> Array:
        """Integrate a rotor that is not linear."""
        found = solve_ivp(
            lambda time, state: self._rates(time, state, law),
            (t, t + dt),
            x,
            "Radau",
            jac=lambda time, state: self._loop(self._system.matrices(time, state, self._inputs), law),
            rtol=TOLERANCE,
            atol=TOLERANCE * self._system.nominals,
            first_step=0.5 * dt,
        )
        if not found.success:
            raise ConvergenceError(f"the rotor cannot be integrated from t = {t:.9g} s: {found.message}", x)
        return np.asarray(found.y[:, -1])

    def _rates(self, t: float, x: Array, law: ForceLaw) -> Array:
        u = self._inputs.copy()
        if self._held:
            u[self._force] = law.force
        else:
            motion = self._system.outcome(t, x, self._inputs)
            u[self._force] = law.at(t, motion[self._position], motion[self._velocity])
        return self._system.rates(t, x, u)

    def _loop(self, matrices: Linearization, law: ForceLaw) -> Array:
        if self._held:
            return matrices.A
        feedback = law.stiffness @ matrices.C[self._position] + law.damping @ matrices.C[self._velocity]
        return matrices.A - matrices.B[:, self._force] @ feedback


def _integral(M: Array, powers: Array) -> Array:
    """Return int_0^1 exp(M (1 - s)) sum_k powers[:, k] s^k ds."""
    n, count = powers.shape
    augmented = np.zeros((n + count, n + count))
    augmented[:n, :n], augmented[:n, n:] = M, powers
    augmented[n + 1 :, n:-1] += np.diag(np.arange(1.0, count))
    # Scaled by columns: the polynomial is of order 1, whatever the unit of its coefficients.
    return np.asarray(expm(augmented)[:n, n])
