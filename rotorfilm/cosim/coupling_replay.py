"""Schemes on a motion known beforehand: the force laws that they would have there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import UndefinedDerivativeError
from ..model import Array, Reaction
from ..results import Trajectory
from ..rotors.force_law import ForceLaw
from .bench import Bench, Needs, Sample, StationMotion, Tangents
from .schemes.scheme import MEMORY, Scheme, started


@dataclass(frozen=True, kw_only=True)
class Starting:
    """A scheme that begins with short steps, as parabolas do, so that all schemes find their points in it.

    Parameters
    ----------
    scheme : Scheme
    """

    scheme: Scheme

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""
        return self.scheme.order

    @property
    def label(self) -> str:
        """Its name in print."""
        return self.scheme.label

    @property
    def needs(self) -> Needs:
        """What it asks of its partners."""
        return self.scheme.needs

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, at the start by a part of it; see `Scheme`."""
        return self.scheme.step(bench, history, t, started(history, 2, dt))


class _Replay:
    """A `Bench` on which a scheme is given a motion known beforehand, to see its force law."""

    def __init__(self, following: Sample) -> None:
        self._following = following
        self.law: ForceLaw | None = None

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Keep the law; the motion is the known one."""
        self.law = law
        return self._following.motion

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Return the known forces."""
        return self._following

    def sensitivity(self, t: float, dt: float) -> Array:
        """Not asked for by the schemes here."""
        raise NotImplementedError

    def save(self) -> None:
        """Do nothing: no scheme here goes back."""

    def restore(self, state: None) -> None:
        """Do nothing."""

    def release(self, state: None) -> None:
        """Do nothing."""


def samples_of(reaction: Reaction, run: Trajectory, speed: float) -> list[Sample]:
    """Return the communication points of a motion at constant speed [rad/s], with the films' derivatives."""
    time, q, v = run.time, run.position, run.velocity
    forces = reaction.force(q, v, np.full(time.size, speed))
    try:
        slopes = reaction.jacobian(q, v, np.full(time.size, speed))
    except UndefinedDerivativeError:  # a damper at rest, where the schemes too go without
        moving = reaction.jacobian(q[:, 1:], v[:, 1:], np.full(time.size - 1, speed))
        slopes = np.concatenate([np.zeros((2, 5, 1)), moving], axis=2)
    return [
        Sample(
            float(time[n]),
            StationMotion(q[:, n], v[:, n], speed, {}),
            forces[:, n],
            Tangents(-slopes[:, :2, n], -slopes[:, 2:4, n], slopes[:, 4, n]),
            {},
        )
        for n in range(time.size)
    ]


def laws_on(samples: Sequence[Sample], scheme: Scheme) -> list[ForceLaw]:
    """Return the force laws of a scheme on a known motion."""
    laws = []
    for n in range(len(samples) - 1):
        bench, now = _Replay(samples[n + 1]), samples[n]
        length = samples[n + 1].time - now.time
        scheme.step(bench, samples[max(0, n + 1 - MEMORY) : n + 1], now.time, length)
        assert bench.law is not None  # every scheme drives the rotor
        laws.append(bench.law)
    return laws
