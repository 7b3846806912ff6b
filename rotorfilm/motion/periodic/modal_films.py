"""A rotor in modes on compiled films: its answers to harmonics, at any frequency, and the films' forces.

The modes are divided by i k nu - lambda:  R_k = sense (i k nu - Lambda)^-1 push.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ...errors import FilmContactError
from ...model import Array
from ...native import Status
from ..compiled.film_calls import raise_foreign
from ..compiled.journal_films import JournalFilms
from ..compiled.modal import Complex, ModalRotor
from .balance import Receptance
from .harmonics import constant, with_wave


@dataclass(frozen=True, eq=False)
class ModalFilms:
    """A rotor in modes as the equations of an orbit see it.

    Attributes
    ----------
    modal : ModalRotor
        The rotor and its films.
    """

    modal: ModalRotor

    @cached_property
    def journals(self) -> JournalFilms:
        """The films, at motions from the centers of the bearings."""
        return JournalFilms.of_rotor(self.modal, absolute=True)

    @property
    def clearances(self) -> Array:
        """Of the bearings, shape (n_bearings,) [m]; infinite where there is none."""
        return np.array([bearing.clearance for bearing in self.modal.parts.bearings])

    @property
    def speed(self) -> float:
        """Angular speed of the shaft [rad/s]."""
        return self.modal.parts.speed

    def receptance(self, harmonics: int, frequency: float) -> Receptance:
        """Return what the journals answer on the springs of the modes, at any frequency."""
        return self._known(range(harmonics + 1), frequency, False)

    def external(self, harmonics: int, periods: int, frequency: float) -> Array:
        """Return the series of the answer to weight, and to the unbalance if `periods` is not 0."""
        rest = self.modal.journal_rest.reshape(-1, 4)[:, :2].ravel()
        if not periods:
            return constant(rest, harmonics)
        # (cos p, sin p) is the real part of (1, -i) exp(i p); a shaft that turns backward mirrors it.
        pair = self.speed**2 * np.array([1.0, -1.0j * np.sign(self.speed)])
        answer = self._known(range(periods, periods + 1), frequency, True)
        return with_wave(rest, answer.values[0] @ pair, harmonics, periods)

    def forces(self, position: Array, velocity: Array) -> Array:
        """Return the forces of films and springs."""
        return self.tangents(position, velocity)[0]

    def tangents(self, position: Array, velocity: Array) -> tuple[Array, Array, Array]:
        """Return the forces of films and springs and their slopes."""
        return film_forces(self.modal, position, velocity, self.journals)

    def loaded(self, part: float) -> ModalFilms:
        """Return the same under a part of the unbalance."""
        push = self.modal.push.copy()
        push[:, -2:] *= part
        return ModalFilms(self.modal._replace(push=push))

    @cached_property
    def _known(self) -> Callable[[range, float, bool], Receptance]:
        """The answers, kept: all steps towards one orbit ask for the same."""
        return lru_cache(maxsize=4)(self._answers)

    def _answers(self, harmonics: range, frequency: float, driven: bool) -> Receptance:
        """Return the answers to real forces cos, i.e. with both of each pair of modes, and their rates.

        The forces are those at the journals, or `driven` the unbalance's pair.

        The state is the real part of the modes kept, twice each: the answer to exp(i w t) has half of it from
        each of the pair.
        """
        values, order = self.modal.values, np.array(harmonics)
        push = self.modal.push[:, -2:] if driven else self.modal.push[:, :-2]
        rows = self.modal.sense.reshape(-1, 4, len(values))[:, :2].reshape(-1, len(values))
        pole = 1.0 / (1j * frequency * order[:, None] - values)
        mirrored = 1.0 / (1j * frequency * order[:, None] - values.conj())

        def summed(by: Complex, by_mirrored: Complex) -> Complex:
            mirror = (rows.conj() * by_mirrored[:, None]) @ push.conj()
            return 0.5 * ((rows * by[:, None]) @ push + mirror)

        return Receptance(summed(pole, mirrored), -1j * order[:, None, None] * summed(pole**2, mirrored**2))


def film_forces(
    modal: ModalRotor, position: Array, velocity: Array, films: JournalFilms | None = None
) -> tuple[Array, Array, Array]:
    """Return the forces of films and springs (2 n, samples), their slopes by position and velocity.

    Raises
    ------
    FilmContactError
        If a journal leaves its bearing, or a force is not finite.
    """
    samples = position.shape[1]
    motion = np.concatenate([row.reshape(-1, 2, samples) for row in (position, velocity)], axis=1)
    journals = films or JournalFilms.of_rotor(modal, absolute=True)
    speed = float(modal.parts.profile.speeds[0])
    status, force, slope = journals.forces(motion.reshape(-1, samples), speed)
    raise_foreign(modal.calls)
    if status >= Status.AT_WALL:
        raise FilmContactError("a journal leaves its bearing along the orbit")
    return force, slope[:, :2], slope[:, 2:]
