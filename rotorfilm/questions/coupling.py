"""How far a co-simulation of rotor and film is from both as one system: rungs are schemes and macro steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis import equilibrium
from ..bearings.journal import ReynoldsFilm, fitted_bearing
from ..core.answers import ISOTHERMAL, BaseRung, ErrorEstimate, Ladder, RungResult, Work, WorkUnit
from ..core.errors import CouplingError, InputError, RotorfilmError
from ..core.units import CELSIUS
from ..cosim import Scheme
from ..cosim.coupling_error import SCHEMES, CouplingCase
from ..scenes.oil_film_tables import has_map, require_law

if TYPE_CHECKING:
    from ..scenes.scene import Scene

ANGLES = (16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125)
"""Macro steps of the rungs [deg]."""

FORCES, SLOPES = WorkUnit("film forces"), WorkUnit("film derivatives")
STATES = WorkUnit("1000 film states at once")

CELLS = (48, 4)
"""Of the film of a bearing without a map, where the scene leaves the film open."""

MOST = 4000
"""Most macro steps of a run; rungs that would take more are left out."""

HOPELESS = 10.0
"""Predicted error, in tolerances, beyond which a run is not made unless nothing better is left."""

SURPLUS = 2.0
"""Least error, in tolerances, beyond which a run is not made."""


@dataclass(frozen=True, kw_only=True)
class CouplingRung(BaseRung):
    """A coupled run by one scheme at one macro step.

    Attributes
    ----------
    case : CouplingCase
        Rotor and films that are coupled.
    scheme : Scheme
    macro_angle : float [rad]
    tolerance : float [1]
    worst : float [1]
        Predicted error beyond which the run is not made.
    """

    case: CouplingCase
    scheme: Scheme
    macro_angle: float
    tolerance: float
    worst: float

    @property
    def name(self) -> str:
        """Scheme, macro step and, where it is not that of the scene, the film."""
        film = f", {self.case.film}" if self.case.film else ""
        return f"{self.scheme.label}, {math.degrees(self.macro_angle):.4g} deg{film}"

    @property
    def calls(self) -> float:
        """Expected calls of film forces and derivatives over a run."""
        return float(sum(self.expected({}).values()))

    @property
    def prior(self) -> float:
        """Half the predicted error."""
        return 0.5 * self.case.predicted(self.scheme, self.macro_angle)

    def answer(self, before: RungResult | None) -> RungResult:
        """Return the estimated error of the coupled run [clearances].

        Raises
        ------
        RotorfilmError
            If the run is unstable, at the wall, or predicted to be far off.
        """
        unstable = self.case.instability(self.scheme, self.macro_angle)
        if unstable:
            raise CouplingError(unstable, None)
        about = 2.0 * self.prior
        if about > self.worst:
            raise RotorfilmError(f"not run: predicted error {about:.1g}, from the motion of the pilot")
        # Where even the best prediction is hopeless the closest run is wanted all the same: none is left out.
        least = self.case.least(self.scheme, self.macro_angle)
        if least > SURPLUS * self.tolerance and self.worst <= HOPELESS * self.tolerance:
            raise RotorfilmError(f"not run: error at least {least:.1g}, by its order from a longer step")
        run = self.case.run(self.scheme, self.macro_angle)
        found, work = self.case.drift(run), run.outcome.trajectory.work
        if not found.doubt:
            self.case.errors[self.scheme, self.macro_angle] = found.error
        done = {FORCES: work["film_evaluations"]}
        if self.scheme.needs.derivatives:
            done[SLOPES] = work["film_jacobians"]
        return RungResult(found.error, done, found)

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        """Return the error, which is the answer itself."""
        about = found.solution
        method = "defect of the force law"
        return ErrorEstimate(about.error, method, {STATES: math.ceil(about.states / 1000)}, doubt=about.doubt)

    def expected(self, done: Work) -> Work:
        """Return the calls of the film, one at each communication point."""
        count = self.case.exchanges(self.macro_angle) + 1
        return {FORCES: count, **({SLOPES: count} if self.scheme.needs.derivatives else {})}


def coupling_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of schemes and macro steps, by the calls of the film that they take.

    Raises
    ------
    InputError
        If the scene has no rotor, no unbalance, an excitation, does not turn, or turns too often.
    CouplingError, ContactError, ConvergenceError
        If no macro step follows the motion; see `CouplingCase.pilot`.
    """
    case = _case(scene, quantity)
    angles = [math.radians(angle) for angle in ANGLES]
    angles = [angle for angle in angles if case.exchanges(angle) <= MOST]
    if not angles:
        raise InputError(
            f"cosimulation.revolutions must be at most {MOST * math.radians(ANGLES[0]) / math.tau:.4g} for "
            f"{quantity}, got {case.revolutions:.6g}"
        )
    least = case.predicted(case.pilot[0].outcome.scheme, angles[-1])  # which goes at shorter steps too
    tolerance = scene.required("question", quantity).tolerance
    worst = max(HOPELESS * tolerance, least)
    rungs = [
        CouplingRung(case=case, scheme=scheme, macro_angle=angle, tolerance=tolerance, worst=worst)
        for angle in angles
        for scheme in SCHEMES
    ]
    rungs.sort(key=lambda rung: rung.calls)
    return Ladder(
        rungs=tuple(rungs),
        unit="1",
        units=_units(case),
        remarks=(*_kept(case), *scene.film_remarks) if scene.has_film else (),
        within=ISOTHERMAL,
        distance=lambda error, other: abs(error - other),  # of two schemes, each with its own
    )


def _case(scene: Scene, quantity: str) -> CouplingCase:
    """Return rotor and film of a scene, at rest."""
    table = scene.required("rigid_rotor", quantity)
    if table.unbalance == 0.0:
        raise InputError(f"rigid_rotor.unbalance must be positive for {quantity}, got 0.0: nothing moves")
    if scene.excitation is not None:
        raise InputError(f"excitation must be left out for {quantity}, got {type(scene.excitation).__name__}")
    if scene.speed == 0.0:
        raise InputError(f"operation.speed must not be zero for {quantity}, got 0.0")
    turns = scene.cosimulation.revolutions
    if not scene.has_film:
        if scene.damper.supply is not None:
            raise InputError(f"damper.supply must be left out for {quantity}, got {scene.damper.supply!r}")
        centered = table.build(scene.speed, (0.0, 0.0))
        return CouplingCase(rotor=centered, reaction=scene.damper.plain(), revolutions=turns)
    require_law(scene.film_table, quantity)
    load, name = scene.static_load, ""
    film: Any = scene.bearing
    if scene.journal is not None and not (scene.film_is_given or has_map(film)):
        # A map of its own takes some seconds, and the coupling hardly depends on the film.
        film, name = fitted_bearing(film, ReynoldsFilm(cells=CELLS)), f"2-D {CELLS[0]} x {CELLS[1]}"
    at = equilibrium(film, load, scene.speed)
    if at.temperature is not None:
        film = film.at_temperature(at.temperature)
    x, y = at.position.tolist()
    rotor = replace(table.build(scene.speed, load), position=(x, y))
    return CouplingCase(rotor=rotor, reaction=film, revolutions=turns, film=name)


def _kept(case: CouplingCase) -> tuple[str, ...]:
    """Return that a film of an oil keeps the temperature of the rest."""
    temperature = getattr(case.reaction, "temperature", None)
    if temperature is None:
        return ()
    return (
        f"heat: the film keeps the temperature of its rest, {temperature - CELSIUS:.4g} degC; the coupling "
        "of the temperature, which is slow, is not checked",
    )


def _units(case: CouplingCase) -> dict[WorkUnit, Callable[[], object]]:
    """Return calls that do one unit of work each."""
    film, speed = case.reaction, case.rotor.profile.speeds[0]
    q = np.array([0.3, 0.4]) * film.clearance
    v = 0.1 * speed * np.array([-0.4, 0.3]) * film.clearance
    many = np.repeat(q[:, None], 1000, axis=1), np.repeat(v[:, None], 1000, axis=1), np.full(1000, speed)
    return {
        FORCES: lambda: film.force(q, v, speed),
        SLOPES: lambda: film.jacobian(q, v, speed),
        STATES: lambda: film.jacobian(*many),
    }
