"""A bearing of tilting pads in SI units: a Reaction whose states are the tilts of its pads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, require_finite
from ....inputs.si_arguments import quantities
from ....model import Array, Linearization
from ....native.journal_spec import journal_spec
from ....native.pads.tilting_kernel import TiltingPoint
from ....native.spec import NativeSpec
from ....results import BearingLosses
from ....signals import Signal, force_outputs, journal_inputs
from ...oil.heat_balance import FilmHeat, fed_temperature
from ...oil.heated_bearing import HeatedBearing
from ...reaction import NOMINAL_SPEED, Called, broadcast_state, input_vector, without_overflow
from ..pad_film import PadMapFilm
from .held_pads import held_force, held_jacobian
from .pad_contact import report_pads
from .pads_at_rest import TiltingPadsAtRest
from .tilting_pads import TiltingPads


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPadBearing(Called, TiltingPads):
    """A journal bearing of equal tilting pads: a Dynamic Reaction, whose states are the tilts.

    x and y are Cartesian from the bearing center, angles are from +x towards +y, rotation is about +z, the
    force acts on the journal. Pads without inertia tilt so that the film has no moment about their pivots;
    they are N states, not stiff. With inertia there are 2 N and the equations are stiff. A pad on a spring
    has the deflection of its pivot as a further state. A pad that loses its film stays as it is until the
    journal returns. Friction of film and pivots on the tilt, of the order clearance / radius, is left out.

    `equilibrium` finds position and pads at rest, `coefficients` what the journal feels, at a frequency that
    the result names, `at_rest().matrices` stiffness and damping of journal and pads together. `force` and
    `jacobian` are those of pads held at their start.

    Its parameters are those of `TiltingPads` and of every `PadBearing`.

    Examples
    --------
    >>> import math
    >>> from rotorfilm import even_pivots
    >>> bearing = TiltingPadBearing(
    ...     radius=0.05, length=0.05, viscosity=0.02, pivots=even_pivots(5), extent=math.pi / 3, preload=0.3,
    ...     assembled_clearance=7e-5)
    >>> [state.name for state in bearing.states]
    ['tilt_1', 'tilt_2', 'tilt_3', 'tilt_4', 'tilt_5']
    """

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.bore_clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, and load_1 .. load_N: the loads of the pivots."""
        force = self.nominal_force
        loads = (
            Signal(name=f"load_{k}", unit="N", nominal=force, description=f"load of the pivot of pad {k}")
            for k in range(1, len(self.pivots) + 1)
        )
        return (*force_outputs(force), *loads)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals tilt_1 .. tilt_N; of pivots on springs pivot_1 .. pivot_N; with inertia their rates."""
        c, pads = self.clearance, range(1, len(self.pivots) + 1)
        rows = [("tilt", "m", c, "tilt of pad {} as a length at the film, positive about +z")]
        if self.pivot_stiffness is not None:
            rows.append(("pivot", "m", c, "place of the pivot of pad {}, negative outward"))
        if self.pad_inertia is not None:
            fast = c * NOMINAL_SPEED
            rows += [(f"{name}_rate", "m/s", fast, f"rate of the {text}") for name, _, _, text in rows]
        return tuple(
            Signal(name=f"{name}_{k}", unit=unit, nominal=nominal, description=text.format(k))
            for name, unit, nominal, text in rows
            for k in pads
        )

    @cached_property
    def initial_state(self) -> Array:
        """State at t = 0, shape (n_states,): `start`, and rates 0."""
        if not self.start:
            return self.at_rest().state(np.zeros(2), 1.0)
        return self.moving(np.array(self.start))

    def at_rest(self) -> TiltingPadsAtRest:
        """Return the force on a journal at rest, each pad in its stable tilt."""
        return TiltingPadsAtRest(self)

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the state with the journal and all pads at rest, shape (n_states,)."""
        return self.at_rest().state(position, speed)

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow under a journal at rest; see `TiltingPadsAtRest.losses`."""
        return self.at_rest().losses(position, velocity, speed, full_gap=full_gap)

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances under a journal at rest [K].

        Parameters and errors are those of `film_heat`.
        """
        if self.pivot_stiffness is None:
            return super().balanced_temperature(position, velocity, speed)

        # Springs give way to the load of the pads, and with it to the viscosity.
        def heat(temperature: float) -> FilmHeat:
            return self.at_temperature(temperature).film_heat(position, velocity, speed)

        return fed_temperature(heat, *self.cooled)

    def in_time(self, start_temperature: float | None = None) -> HeatedBearing:
        """Raise InputError: the heat of tilting pads is known at rest only."""
        raise InputError(
            "temperature must be stated for tilting pads in time, got None: bearing.at_temperature(T) has one"
        )

    def film_at_unit_viscosity(self) -> None:
        """Return no film for the loops in C over warm films, which know one film only."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Raise InputError: the heat of pads has no slopes."""
        raise InputError("bearing must have slopes of its heat, as a JournalBearing, got tilting pads")

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal with the pads held at their start, shape (2, ...) [N].

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the journal touches a pad; the message names it.
        """
        return self._held(held_force, position, velocity, speed)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed) with the pads held at their start, shape (2, 5, ...)."""
        return self._held(held_jacobian, position, velocity, speed)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return forces and pivot loads, shape (2 + N,) [N], at the state x and u = (x, y, vx, vy, speed)."""
        return self.evaluated(x, u).outputs

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, shape (n_states,)."""
        return self.evaluated(x, u).rates

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at the state x and u = (x, y, vx, vy, speed)."""
        found = self.evaluated(x, u, slopes=True).slopes
        assert found is not None
        return found

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        Nor has a subclass. Its parameters are the dimensions, with the clearance of the pads, and the
        viscosity; radius and length are fixed.
        """
        if type(self) is not TiltingPadBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        numbers = (
            *(self.extent, self.pivot_offset, self.preload, self.pivot_stiffness or 0.0),
            *(self.reduced_inertia, self.pad_mass or 0.0, self.slenderness),
        )
        tables = self.film.table(self.extent, self.slenderness).kernel().tables
        lengths = {name: float(getattr(self, name)) for name in ("radius", "length", "clearance")}
        return journal_spec(
            "tilting_journal" if self.pad_inertia is None else "heavy_tilting_journal",
            {"pivots": np.array(self.pivots), "pads": np.array(numbers), **tables},
            {**lengths, "viscosity": self.film_viscosity},
            fixed=True,
        )

    def portable(self) -> TiltingPadBearing:
        """Return this bearing with a film that carries the map it needs; see `model.Portable`."""
        if not isinstance(self.film, PadMapFilm):
            return self
        table = self.film.table(self.extent, self.slenderness)
        return replace(self, film=replace(self.film, tables=(table,)))

    @property
    def _tilts(self) -> Array:
        return self.initial_state[: len(self.pivots)]

    def _held(
        self,
        answer: Callable[..., Array],
        position: ArrayLike,
        velocity: ArrayLike,
        speed: ArrayLike,
    ) -> Array:
        """Return what `held_force` or `held_jacobian` answers at states of any batch shape."""

        def law(q: Array, v: Array, omega: Array) -> Array:
            found = answer(self, np.stack([*q, *v, omega]).reshape(5, -1), self._tilts)
            return found.reshape(*found.shape[:-1], *omega.shape)

        return without_overflow(law, *broadcast_state(position, velocity, speed))

    def evaluated(self, x: ArrayLike, u: ArrayLike, *, slopes: bool = False) -> TiltingPoint:
        """Return rates and outputs, and if asked for their derivatives, at the state x and the input u."""
        state, values = require_finite("x", x), input_vector(u)
        if state.shape != (self.kernel.states,):
            raise InputError(f"x must have shape ({self.kernel.states},), got shape {state.shape}")
        point = self.kernel.at(values, state, slopes=slopes)
        report_pads(self, point.status, point.pad, values[:2])
        return point
