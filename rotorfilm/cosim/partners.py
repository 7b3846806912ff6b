"""A rotor and its films on the bench of a scheme, every call counted."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..core.errors import FmuError, InputError, UndefinedDerivativeError
from ..core.model import Array, Linearization
from ..core.signals import FORCE_OUTPUTS, JOURNAL_INPUTS
from ..rotors.force_law import ForceLaw, held_law
from ..rotors.structure import station_name
from .schemes import Needs, PartnerInterface, Sample, StationMotion, Tangents, no_tangents
from .slaves import Places, Slave, sources, wired

PROBE = 1e3
"""Force of a trial step [N]; a linear rotor tells the same with any."""


class Partners(PartnerInterface):
    """A rotor and films that were not started yet.

    Parameters
    ----------
    rotor : Slave
    films : mapping of str to Slave
        Films by station; the empty name is that of a rotor with one journal.
    needs : Needs

    Raises
    ------
    InputError
        If the signals do not fit or a partner lacks what the scheme needs.
    """

    def __init__(self, rotor: Slave, films: Mapping[str, Slave], needs: Needs) -> None:
        self.rotor, self.films, self._needs = rotor, dict(films), needs
        outlets = {station: (film.inputs, film.outputs) for station, film in self.films.items()}
        self.wiring = wired((rotor.inputs, rotor.outputs), outlets)
        self.places = self.wiring.places(rotor.inputs, rotor.outputs)
        """Where the signals of the journals are among those of the rotor."""
        self.work: Counter[str] = Counter(dict.fromkeys(WORK, 0))
        self._all = [rotor, *films.values()]
        self._require(needs)
        # Asked once: names and places are slow.
        self.feeds = {station: self._fed(station, film) for station, film in self.films.items()}
        self._told = {
            station: [station_name(station, n) for n in film.outputs] for station, film in self.films.items()
        }
        self._known = [
            [k for k, n in enumerate(JOURNAL_INPUTS) if n in film.inputs] for film in films.values()
        ]
        self.laws: list[ForceLaw] | None = None
        """The force laws of all steps of the rotor, if a list is put here."""
        self._probed: tuple[float, Array] | None = None

    def start(self) -> Sample:
        """Start the rotor, then the films at the rotor's initial state."""
        self.rotor.start({})
        motion = self._motion(0.0)
        for station, film in self.films.items():
            film.start(self._values(station, motion))
        return self._sample(0.0, motion, self._needs.derivatives)

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Advance the rotor; see `PartnerInterface`."""
        self.work["rotor_steps"] += 1
        if self.laws is not None:
            self.laws.append(law)
        self.rotor.drive(t, dt, law, self.wiring)
        return self._motion(t + dt)

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Step the films; see `PartnerInterface`."""
        for station, film in self.films.items():
            film.set(self._values(station, motion))
            film.step(t, dt)
        return self._sample(t + dt, motion, derive)

    def sensitivity(self, t: float, dt: float) -> Array:
        """Return d(motion)/d(force) from trial steps, kept while the step stays; see `PartnerInterface`."""
        if self._probed is None or abs(dt - self._probed[0]) > 1e-9 * dt:
            forces = np.vstack([np.zeros(self.size), np.eye(self.size)])
            ends = [self._trial(t, dt, force) for force in forces]
            self._probed = dt, np.array([end - ends[0] for end in ends[1:]]).T
        return self._probed[1]

    def save(self) -> list[Any]:
        """Return the state of all partners."""
        return [partner.save() for partner in self._all]

    def restore(self, state: list[Any]) -> None:
        """Return to a state of all partners."""
        self.work["rollbacks"] += 1
        for partner, own in zip(self._all, state, strict=True):
            partner.restore(own)
        self.release(state)

    def release(self, state: list[Any]) -> None:
        """Forget a state."""
        for partner, own in zip(self._all, state, strict=True):
            partner.release(own)

    @property
    def size(self) -> int:
        """Number of force components."""
        return len(self.wiring.force)

    @property
    def signals(self) -> tuple[list[str], list[str]]:
        """Names of all outputs: those of the rotor, and those of the films with their stations."""
        return list(self.rotor.outputs), [name for told in self._told.values() for name in told]

    @property
    def units(self) -> dict[str, str]:
        """Units of the outputs, of partners that tell them."""
        known = dict(self.rotor.units)
        for station, film in self.films.items():
            known |= {station_name(station, name): unit for name, unit in film.units.items()}
        return known

    @property
    def differentiates(self) -> bool:
        """Whether all films tell their derivatives."""
        return all(film.differentiates for film in self.films.values())

    def tangents(self) -> Tangents:
        """Return the derivatives of all films at present.

        Raises
        ------
        UndefinedDerivativeError
            If a film has none there.
        """
        slopes = [*map(self._slopes, self._known, self.films.values())]
        self.work["film_jacobians"] += 1
        if len(slopes) == 1:
            return Tangents(-slopes[0][:, :2], -slopes[0][:, 2:4], slopes[0][:, 4].copy())
        found = no_tangents(self.size)
        for number, whole in enumerate(slopes):
            own = slice(2 * number, 2 * number + 2)
            found.stiffness[own, own], found.damping[own, own] = -whole[:, :2], -whole[:, 2:4]
            found.by_speed[own] = whole[:, 4]
        return found

    def _slopes(self, known: Sequence[int], film: Slave) -> Array:
        """Return the derivatives of the force of a film by JOURNAL_INPUTS, shape (2, 5)."""
        found = film.jacobian(FORCE_OUTPUTS, [JOURNAL_INPUTS[k] for k in known])
        if len(known) == len(JOURNAL_INPUTS):
            return found
        whole = np.zeros((2, len(JOURNAL_INPUTS)))
        whole[:, known] = found
        return whole

    def linear_rotor(self, t: float) -> Linearization | None:
        """Return the exact derivatives of the rotor, those of its journals only; None if it has none."""
        found = self.rotor.linear(t)
        if found is None:
            return None
        forces, *places = self.places
        motion = [k for each in places for k in each]
        return Linearization(found.A, found.B[:, forces], found.C[motion], found.D[motion][:, forces])

    def _sample(self, t: float, motion: StationMotion, derive: bool) -> Sample:
        self.work["film_evaluations"] += 1
        outputs: dict[str, float] = {}
        forces: list[float] = []
        for film, told in zip(self.films.values(), self._told.values(), strict=True):
            own = require_finite_outputs("film", t, film.get())
            values = [*map(own.__getitem__, film.outputs)]
            outputs |= zip(told, values, strict=True)
            forces += [own[name] for name in FORCE_OUTPUTS]
        tangents = self._tangents_or_none() if derive else None
        return Sample(t, motion, np.array(forces), tangents, outputs)

    def _tangents_or_none(self) -> Tangents:
        """Return the derivatives, or zeros where a film at rest has none: its force then counts as held."""
        try:
            return self.tangents()
        except UndefinedDerivativeError:
            return no_tangents(self.size)

    def _motion(self, t: float) -> StationMotion:
        outputs = require_finite_outputs("rotor", t, self.rotor.get())
        return StationMotion(
            np.array([outputs[name] for name in self.wiring.position]),
            np.array([outputs[name] for name in self.wiring.velocity]),
            outputs.get("speed", 0.0),
            outputs,
        )

    def _values(self, station: str, motion: StationMotion) -> dict[str, float]:
        """Return the inputs of a film: its journal's motion and the speed as given, others as they are."""
        first, feeds = self.feeds[station]
        x, y = motion.position[first : first + 2].tolist()
        vx, vy = motion.velocity[first : first + 2].tolist()
        journal = (x, y, vx, vy, motion.speed)
        return {
            name: motion.outputs[source] if place is None else journal[place] for name, place, source in feeds
        }

    def _fed(self, station: str, film: Slave) -> tuple[int, list[tuple[str, int | None, str]]]:
        """Return the first place of a station, and each input of its film: its place or its source."""
        found = sources(self.rotor.outputs, station, film.inputs)
        places = {name: JOURNAL_INPUTS.index(name) if name in JOURNAL_INPUTS else None for name in found}
        first = 2 * self.wiring.stations.index(station)
        return first, [(name, places[name], source) for name, source in found.items()]

    def _trial(self, t: float, dt: float, force: Array) -> Array:
        """Return the motion after a step under a held force [kN], per N, and go back."""
        state = self.save()
        motion = self.drive(t, dt, held_law(t, PROBE * force))
        self.restore(state)
        return np.concatenate([motion.position, motion.velocity]) / PROBE

    def _require(self, needs: Needs) -> None:
        if needs.derivatives and not self.differentiates:
            raise InputError("film must tell its directional derivatives for this scheme, got one without")
        if needs.laws and not self.rotor.takes_laws(self.wiring):
            raise InputError(
                "rotor must take force laws for this scheme, as a model, an FMU for Model Exchange or one "
                f"with inputs such as stiffness_xx, got the inputs {list(self.rotor.inputs)}"
            )
        if needs.rollback and not all(partner.restores for partner in self._all):
            raise InputError("rotor and film must get and set their state for this scheme, got one without")


def require_finite_outputs(who: str, t: float, values: dict[str, float]) -> dict[str, float]:
    """Return outputs at a time [s]; raise FmuError unless all are finite."""
    if all(map(math.isfinite, values.values())):
        return values
    bad = {name: value for name, value in values.items() if not math.isfinite(value)}
    raise FmuError(f"outputs of the {who} must be finite, got {bad} at t = {t:.9g} s")


# What was exchanged at the communication points of a run, as arrays that grow.


FIRST_ROOM = 64

WORK = ("steps", "film_evaluations", "film_jacobians", "rotor_steps", "rollbacks")
"""What is counted, until each point."""


class Record:
    """The communication points of a run so far; further ones fit within the `room` without new arrays.

    Parameters
    ----------
    rotor, films : sequence of str
        Names of the outputs of the rotor and, with those of their stations, of all films.
    at : (list of int, list of int, list of int)
        The forces, positions and velocities among the inputs and outputs of the rotor.
    derived : bool
        Whether films tell their derivatives at each point.
    """

    def __init__(self, rotor: Sequence[str], films: Sequence[str], at: Places, derived: bool) -> None:
        self.rotor, self.films = list(rotor), list(films)
        force, self.position_at, self.velocity_at = at
        self.size, self.count = len(force), 0
        self.speed_at = self.rotor.index("speed") if "speed" in self.rotor else None
        columns = 2 * self.size**2 + self.size if derived else 0
        self.time, self.outputs = np.empty(FIRST_ROOM), np.empty((FIRST_ROOM, len(rotor) + len(films)))
        self.work = np.zeros((FIRST_ROOM, len(WORK)), dtype=np.int64)
        self.force, self.tangents = np.empty((FIRST_ROOM, self.size)), np.empty((FIRST_ROOM, columns))

    def require_room(self, count: int) -> None:
        """Make room for so many points more."""
        room = len(self.time)
        if self.count + count > room:
            more = max(room, self.count + count - room)
            for name in ("time", "outputs", "force", "tangents", "work"):
                old = getattr(self, name)
                setattr(self, name, np.concatenate([old, np.zeros((more, *old.shape[1:]), old.dtype)]))

    def keep(self, sample: Sample) -> None:
        """Add a point."""
        self.require_room(1)
        n, motion = self.count, sample.motion.outputs
        self.time[n], self.force[n] = sample.time, sample.force
        self.outputs[n] = [
            *map(motion.__getitem__, self.rotor),
            *map(sample.outputs.__getitem__, self.films),
        ]
        if self.tangents.shape[1]:
            self.tangents[n] = (
                np.nan
                if sample.tangents is None
                else np.concatenate([part.ravel() for part in sample.tangents])
            )
        self.count += 1

    def latest(self, count: int) -> list[Sample]:
        """Return the latest points."""
        return [self._sample(n) for n in range(max(0, self.count - count), self.count)]

    def motion(self, rows: slice) -> tuple[Array, Array, Array]:
        """Return position, velocity, shape (n, m), and speed, shape (n,), of some points."""
        outputs = self.outputs[rows]
        speed = np.zeros(len(outputs)) if self.speed_at is None else outputs[:, self.speed_at]
        return outputs[:, self.position_at], outputs[:, self.velocity_at], speed

    def derivatives(self, rows: slice) -> tuple[Array, Array, Array]:
        """Return stiffness, damping, shape (n, m, m), and by_speed, shape (n, m), of some points."""
        found, m = self.tangents[rows], self.size
        square = (len(found), m, m)
        return found[:, : m * m].reshape(square), found[:, m * m : -m].reshape(square), found[:, -m:]

    def work_at(self, point: int) -> dict[str, int]:
        """Return what was done until a point."""
        return dict(zip(WORK, self.work[point].tolist(), strict=True))

    def signals(self) -> dict[str, Array]:
        """Return all outputs by name."""
        series = self.outputs[: self.count].T.copy()
        return dict(zip([*self.rotor, *self.films], series, strict=True))

    def _sample(self, n: int) -> Sample:
        rows = slice(n, n + 1)
        position, velocity, speed = (part[0] for part in self.motion(rows))
        values = self.outputs[n].tolist()
        rotor = dict(zip(self.rotor, values, strict=False))
        films = dict(zip(self.films, values[len(self.rotor) :], strict=True))
        known = self.tangents.shape[1] > 0 and not np.isnan(self.tangents[n, 0])
        tangents = Tangents(*(part[0].copy() for part in self.derivatives(rows))) if known else None
        motion = StationMotion(position, velocity, float(speed), rotor)
        return Sample(float(self.time[n]), motion, self.force[n].copy(), tangents, films)
