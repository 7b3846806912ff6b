"""Whirl thresholds by the rungs of the ladder, and which of them are wrong."""

from __future__ import annotations

from dataclasses import dataclass

from ...readable.result import Readable
from .journal_accuracy import TENSION
from .journal_rungs import RungName

TOLERANCE = 0.05
"""Relative deviation from which a threshold counts as wrong."""

ASYMMETRY = 0.01
"""|C_xy - C_yx| / max |C| from which damping counts as unsymmetric; exact for films with a potential: 0."""

HIGHEST = 5.0
"""Speed parameter up to which a threshold is judged: further up it rises so steeply that a shift of the
eccentricity ratio by 0.001 changes it by several per cent."""


@dataclass(frozen=True, kw_only=True)
class RungStability(RungName, Readable):
    """Whirl threshold by one rung, over the eccentricity ratios of a `JournalStability`.

    Attributes
    ----------
    speed_parameter : tuple of n floats or None [1]
        speed * sqrt(clearance * mass / load) at the onset of whirl; None where there is none.
    deviation : tuple of n floats or None [1]
        Of the speed parameter from the reference, relative; None where one of the two has none.
    reasons : tuple of n str
        Why there is no threshold; empty where there is one.
    rank_one : tuple of n bool
        Whether det C = 0, so that stability does not depend on the mass.
    asymmetry : tuple of n floats [1]
        |C_xy - C_yx| / max |C|.
    static_tension : tuple of n floats [1]
        Largest tension of the film at rest / its largest pressure.
    tension_share : float [1]
        Share of random states of large motion in which the film carries more tension than `TENSION`.
    """

    speed_parameter: tuple[float | None, ...]
    deviation: tuple[float | None, ...]
    reasons: tuple[str, ...]
    rank_one: tuple[bool, ...]
    asymmetry: tuple[float, ...]
    static_tension: tuple[float, ...]
    tension_share: float

    @property
    def in_tension(self) -> bool:
        """Whether the film carries tension at rest or in large motion."""
        return self.tension_share > 0.0 or max(self.static_tension) > TENSION

    @property
    def unsymmetric(self) -> bool:
        """Whether the damping matrix is unsymmetric by more than `ASYMMETRY` somewhere."""
        return max(self.asymmetry) > ASYMMETRY

    @property
    def has_threshold(self) -> bool:
        """Whether it predicts whirl anywhere."""
        return any(value is not None for value in self.speed_parameter)


@dataclass(frozen=True, kw_only=True)
class JournalStability(Readable):
    """Whirl threshold over the eccentricity ratio, by every rung.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    eccentricity_ratio : tuple of n floats [1]
    speed_parameter : tuple of n floats or None [1]
        Of the reference.
    reference : str
        What it is.
    reference_error : float [1]
        Estimate of its largest relative error, where it is judged.
    tolerance, asymmetry_tolerance, tension_tolerance : float [1]
        From which a threshold, a damping matrix and a film are marked.
    highest : float [1]
        Speed parameter of the reference up to which thresholds are judged.
    rungs : tuple of RungStability
    """

    slenderness: float
    eccentricity_ratio: tuple[float, ...]
    speed_parameter: tuple[float | None, ...]
    reference: str
    reference_error: float
    tolerance: float = TOLERANCE
    asymmetry_tolerance: float = ASYMMETRY
    tension_tolerance: float = TENSION
    highest: float = HIGHEST
    rungs: tuple[RungStability, ...]

    @property
    def judged(self) -> tuple[bool, ...]:
        """Where the reference has a threshold not above `highest`."""
        return tuple(value is not None and value <= self.highest for value in self.speed_parameter)

    def wrong(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where a judged threshold is off by more than the tolerance."""
        pairs = zip(self.judged, rung.deviation, strict=True)
        return tuple(judged and gap is not None and abs(gap) > self.tolerance for judged, gap in pairs)

    def missing(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where the reference has a judged threshold and the rung has none."""
        pairs = zip(self.judged, rung.speed_parameter, strict=True)
        return tuple(judged and value is None for judged, value in pairs)

    def invented(self, rung: RungStability) -> tuple[bool, ...]:
        """Return where the rung has a threshold not above `highest` and the reference has none at all."""
        pairs = zip(self.speed_parameter, rung.speed_parameter, strict=True)
        return tuple(exact is None and value is not None and value <= self.highest for exact, value in pairs)

    def largest_deviation(self, rung: RungStability) -> float | None:
        """Return the largest |deviation| of a judged threshold [1]; None where the rung has none."""
        pairs = zip(self.judged, rung.deviation, strict=True)
        return max((abs(gap) for judged, gap in pairs if judged and gap is not None), default=None)

    def columns(self) -> dict[str, list[object]]:
        """Return one row for each rung and eccentricity ratio, headings with units."""
        rows = [row for rung in self.rungs for row in self._rows(rung)]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}

    def _rows(self, rung: RungStability) -> list[dict[str, object]]:
        wrong, missing, invented = self.wrong(rung), self.missing(rung), self.invented(rung)
        return [
            {
                "family [-]": rung.family,
                "label [-]": rung.label,
                "eccentricity ratio [1]": ratio,
                "speed sqrt(c m/W) [1]": rung.speed_parameter[k],
                "reference [1]": self.speed_parameter[k],
                "deviation [1]": rung.deviation[k],
                f"deviation above {self.tolerance:g} [-]": int(wrong[k]),
                "none where the reference has one [-]": int(missing[k]),
                "one where the reference has none [-]": int(invented[k]),
                "damping of rank one [-]": int(rung.rank_one[k]),
                "|Cxy - Cyx|/max|C| [1]": rung.asymmetry[k],
                "tension/largest pressure at rest [1]": rung.static_tension[k],
                "states of large motion in tension [1]": rung.tension_share,
                "why none [-]": rung.reasons[k],
                "length/diameter [1]": self.slenderness,
                "error of the reference [1]": self.reference_error,
            }
            for k, ratio in enumerate(self.eccentricity_ratio)
        ]
