"""What a cracked shaft does turn after turn on linear bearings: harmonics of the speed, and its stability."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ..core.errors import InputError, brief, require_count, require_kind
from ..core.inputs import arguments
from ..core.model import Array, Dynamic
from ..core.port import is_constant
from ..core.readable import Readable
from ..core.signals import names
from ..rotors import CrackedRotor, MountedRotor
from .threads import one_blas_thread

STEPS = 128
"""Steps per turn, of fourth order."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CrackedResponse(Readable):
    """The periodic motion of a cracked rotor.

    Attributes
    ----------
    speed : float [rad/s]
    series : dict of str to ndarray of complex, shape (harmonics + 1,)
        Fourier series of each output: the real part of sum series[k] exp(i k angle), with the angle turned
        since t = 0. For an unstable rotor it is the periodic motion that a disturbance leaves.
    multipliers : ndarray of complex, shape (n_states,)
        Floquet multipliers, the growth of a disturbance over one turn, the largest first.
    """

    speed: float
    series: dict[str, Array]
    multipliers: Array

    @property
    def stable(self) -> bool:
        """Whether small disturbances of the motion decay."""
        return bool(abs(self.multipliers[0]) < 1.0)

    @property
    def growth_rate(self) -> float:
        """Growth rate of the disturbance that grows fastest [1/s]; negative if all disturbances decay."""
        return float(np.log(abs(self.multipliers[0])) * abs(self.speed) / (2.0 * np.pi))


@one_blas_thread
@arguments
def cracked_response(mounted: MountedRotor, *, harmonics: int = 5, steps: int = STEPS) -> CrackedResponse:
    """Return the periodic response of a cracked rotor on linear bearings to weight and unbalance.

    The equations are linear with a period of one turn. Each step uses two matrix exponentials, a
    commutator-free method of fourth order (Blanes & Moan 2006, Appl. Numer. Math. 56, 1519-1537). It is exact
    for the modes of a shaft without a crack, however fast they are.

    Parameters
    ----------
    mounted : MountedRotor
        A `CrackedRotor` at constant speed with a `LinearBearing` in every station.
    harmonics : int
        Below half of the steps.
    steps : int
        Steps per turn.

    Raises
    ------
    InputError
        If the rotor is another one, or has other bearings.
    """
    rotor = _cracked(mounted)
    require_count("harmonics", harmonics)
    require_count("steps", steps, 2 * harmonics + 1)
    speed = rotor.profile.speeds[0]
    period = 2.0 * np.pi / abs(speed)
    times = np.linspace(0.0, period, steps + 1)
    moves = [_step(mounted, start, end) for start, end in pairwise(times)]
    whole = np.eye(len(moves[0]))
    for move in moves:
        whole = move @ whole
    turn, shift = whole[:-1, :-1], whole[:-1, -1]
    states = [np.append(np.linalg.solve(np.eye(len(turn)) - turn, shift), 1.0)]
    for move in moves[:-1]:
        states.append(move @ states[-1])
    multipliers: Any = np.linalg.eigvals(turn)
    return CrackedResponse(
        speed=speed,
        series=_series(mounted, times[:-1], np.array(states)[:, :-1], harmonics, speed),
        multipliers=multipliers[np.argsort(-np.abs(multipliers))],
    )


def _cracked(mounted: MountedRotor) -> CrackedRotor:
    require_kind("mounted", mounted, MountedRotor, "a rotor in all its bearings, as mount makes it")
    rotor = mounted.bare
    if not isinstance(rotor, CrackedRotor):
        raise InputError(f"mounted must be a CrackedRotor in its bearings, got {rotor!r}")
    if mounted.inputs:
        raise InputError(
            f"mounted must have a bearing in every station, got none for {names(mounted.inputs)}"
        )
    for station, bearing in mounted.all_bearings.items():
        if not is_constant(bearing):
            raise InputError(f"bearing of station {station!r} must be a LinearBearing, got {brief(bearing)}")
    if len(set(rotor.profile.speeds)) != 1 or rotor.profile.speeds[0] == 0.0:
        raise InputError(f"speed must be constant and not zero, got {rotor.rotor.speed!r}")
    return rotor


def _step(model: Dynamic, start: float, end: float) -> Array:
    """Return what a step makes of (x, 1)."""
    from scipy.linalg import expm  # imported here: the rest is light

    middle, reach = 0.5 * (start + end), (end - start) / np.sqrt(12.0)
    first, second = (_affine(model, t) for t in (middle - reach, middle + reach))
    size, more, less = end - start, 0.25 + np.sqrt(3.0) / 6.0, 0.25 - np.sqrt(3.0) / 6.0
    late, early = (expm(size * (a * first + b * second)) for a, b in ((less, more), (more, less)))
    return np.asarray(late @ early)


def _affine(model: Dynamic, t: float) -> Array:
    """Return the equations of (x, 1) at a time [s]."""
    n = len(model.initial_state)
    whole = np.zeros((n + 1, n + 1))
    whole[:-1, :-1] = model.linearization(t, np.zeros(n), np.zeros(0)).A
    whole[:-1, -1] = model.derivative(t, np.zeros(n), np.zeros(0))
    return whole


def _series(model: Dynamic, times: Array, states: Array, harmonics: int, speed: float) -> dict[str, Array]:
    outputs = np.array([model.output(t, x, np.zeros(0)) for t, x in zip(times, states, strict=True)])
    found = np.fft.fft(outputs, axis=0)[: harmonics + 1] / len(times)
    found[1:] *= 2.0
    found = found if speed > 0.0 else found.conj()
    return dict(zip(names(model.outputs), found.T, strict=True))
