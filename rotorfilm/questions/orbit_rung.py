"""Rungs of the orbit of a rigid rotor: linear about its rest, or nonlinear at so many samples of a turn."""

from __future__ import annotations

from dataclasses import dataclass

from ..ladders import C, CandidateRung
from ..rotors import RigidRotor


@dataclass(frozen=True, kw_only=True)
class SampledOrbitRung(CandidateRung[C]):
    """The orbit on one film; a rung adds `answer`, `estimate` and `expected`.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    rotor : RigidRotor
    samples : int
        Over a turn; 0 for the linear orbit.
    """

    quantity: str
    rotor: RigidRotor
    samples: int

    @property
    def name(self) -> str:
        """Linear, or the number of samples, and the film."""
        how = f"nonlinear, {self.samples} samples" if self.samples else "linear"
        return f"{how}, {self.film.name}"

    @property
    def prior(self) -> float:
        """Order of magnitude of the film's error."""
        return 0.3 * self.film.prior

    @property
    def refines(self) -> tuple[object, ...]:
        """The film, where there are samples."""
        return (self.film,) if self.samples else ()
