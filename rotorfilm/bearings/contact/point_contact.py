"""The dimensionless point contact of a ball on a plane or in a groove, lubricated and elastic."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from ...errors import (
    FileWarning,
    InputError,
    ValidityWarning,
    require_kind,
    require_number,
    require_positive,
    warn_user,
)
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ..ellipse import Ellipse, require_ellipticity
from .film.contact_grid import ContactGrid
from .film.contact_newton import Contact
from .film.contact_scheme import ContactScheme, StaggeredScheme, UpwindScheme
from .film.film_equations import ContactEquations
from .film.pressure_fluid import BarusViscosity, DowsonHigginsonDensity, Piezoviscosity
from .film.stationary import follow, stationary
from .motion.contact_run import run_contact
from .motion.contact_state import ContactRun, ContactState, level_of, state_of
from .motion.contact_steps import AdaptiveSteps, FixedSteps
from .motion.levels import BallMotion, GivenMotion
from .motion.run_files import load_run, save_run

ALTERNATING = 0.025
"""Alternating share of the pressure above which it is not to be trusted."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PointContact:
    """Elastohydrodynamic contact of a ball rolling on a plane, in units of the Hertzian contact.

    Lengths in the plane are in Hertzian radii a, pressures in the Hertzian maximum p_H, film thickness and
    approach in a^2/(2 R), time in 2 a/(u1 + u2), u1 and u2 being the surface speeds in the frame of the
    contact; loads in the Hertzian load 2 pi p_H a^2/3. `RollingBall` converts from SI. Equations, accuracy
    and errata of the source: `docs/contact.md`.

    A ball in a groove touches on an ellipse whose longer half-axis lies across the rolling. All units are
    then made of the half-axis along it and of the radius R of curvature along it, and the Hertzian load is
    2 pi ellipticity/3; lengths across, of the grid too, are in the longer half-axis.

    Parameters
    ----------
    V : float [1]
        Speed parameter 24 mu0 (u1 + u2) R^2/(p_H a^3).
    Q0 : float [1]
        Pressure-viscosity coefficient times p_H.
    grid : ContactGrid
        Cells on the rectangle that is solved.
    scheme : ContactScheme
        `UpwindScheme()`, or `StaggeredScheme()` as published.
    piezoviscosity : Piezoviscosity
        `BarusViscosity()` or `RoelandsViscosity(...)`.
    density : DowsonHigginsonDensity, optional
        Of the lubricant; incompressible by default.
    ellipticity : float [1]
        Longer over shorter half-axis of the dry contact; 1, a circle, by default.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    V: float
    Q0: float
    grid: ContactGrid = field(default_factory=ContactGrid)
    scheme: ContactScheme = field(default_factory=UpwindScheme)
    piezoviscosity: Piezoviscosity = field(default_factory=BarusViscosity)
    density: DowsonHigginsonDensity | None = None
    ellipticity: float = 1.0

    def __post_init__(self) -> None:
        require_ellipticity(self.ellipticity)
        require_positive("V", self.V)
        require_positive("Q0", self.Q0)
        kinds = {"grid": ContactGrid, "scheme": ContactScheme, "piezoviscosity": Piezoviscosity}
        for name, kind in kinds.items():
            if not isinstance(getattr(self, name), kind):
                raise InputError(f"{name} must be a {kind.__name__}, got {getattr(self, name)!r}")
        if self.grid.focus is not None and not isinstance(self.scheme, StaggeredScheme):
            raise InputError(f"scheme must be StaggeredScheme() on graded cells, got {self.scheme!r}")
        require_kind(
            "density", self.density, DowsonHigginsonDensity | None, "a DowsonHigginsonDensity or None"
        )

    @cached_property
    def equations(self) -> ContactEquations:
        """The discrete equations."""
        return ContactEquations(
            V=float(self.V),
            Q0=float(self.Q0),
            grid=self.grid,
            scheme=self.scheme,
            viscosity=self.piezoviscosity,
            density=self.density,
            ellipse=Ellipse(float(self.ellipticity)),
        )

    def stationary(self, load: float = 1.0, near: ContactState | None = None) -> ContactState:
        """Return the stationary contact under a load.

        Parameters
        ----------
        load : float [1]
            f, in Hertzian loads.
        near : ContactState, optional
            A stationary contact under a similar load, to start from.

        Warns
        -----
        ValidityWarning
            If the pressure alternates from cell to cell.

        Raises
        ------
        ConvergenceError
            If Newton's method fails, also by continuation in V and Q0.
        """
        require_positive("load", load)
        if near is None:
            found = stationary(self.equations, load)
        else:
            level = self._start(near).levels[0]
            found = follow(self.equations, Contact(level.pressure, level.delta, level.stored, 0, 0), load)
        level = level_of(self.equations, found.pressure, found.delta)
        return self._checked(state_of(self.equations, (level,)))

    def state(self, pressure: np.ndarray, delta: float, velocity: float = 0.0) -> ContactState:
        """Return the state at t = 0 of given pressures (nx, m), approach and velocity: a start of a run."""
        values = np.asarray(pressure, dtype=float)
        if values.shape != self.grid.shape or not np.all(values >= 0.0):
            raise InputError(
                f"pressure must have shape {self.grid.shape} and no negative entry, got shape {values.shape}"
                f" and a smallest entry of {values.min() if values.size else None!r}"
            )
        level = level_of(
            self.equations,
            values.ravel(),
            require_number("delta", delta),
            require_number("velocity", velocity),
        )
        made = state_of(self.equations, (level,))
        if not made.minimum_film > 0.0:
            raise InputError(
                f"delta must leave a film everywhere, got {delta!r} with {made.minimum_film:.3g}"
            )
        return made

    def simulate(
        self,
        start: ContactState | ContactRun,
        *,
        duration: float,
        W: float,
        load: float | Callable[[float], float] = 1.0,
        control: AdaptiveSteps | FixedSteps | None = None,
        snapshots: Sequence[float] = (),
        keep: str | Path | None = None,
    ) -> ContactRun:
        """Return the motion of a ball on the contact, W delta'' = integral of p - (2 pi ellipticity/3) f(t).

        Parameters
        ----------
        start : ContactState or ContactRun
            From `stationary`, `state` or an earlier run. A run that is not complete, with the other arguments
            of the first time, goes on to its end, to the last bit as if it had not been interrupted;
            snapshots from before are missing where it was read from a file, which does not hold them.
        duration : float [1]
            Of the run as a whole.
        W : float [1]
            Inertia of the ball, pi ellipticity m (u1 + u2)^2/(12 P0 R); 0 for a massless one.
        load : float or callable
            f or f(t). A callable may list the times of its jumps in an attribute `breakpoints`; at one of
            them it is to return the value before the jump.
        control : AdaptiveSteps or FixedSteps, optional
            `AdaptiveSteps()` by default.
        snapshots : sequence of float [1]
            Times at which to keep the whole state.
        keep : path, optional
            File in which the run is saved as it goes, three times a minute, and at its end, however that
            comes; `load` reads it.

        Raises
        ------
        InputError
            If a run to go on with was begun with other arguments, or under another load until now.
        ConvergenceError
            If a step fails; its `partial` is the run up to there.

        Warns
        -----
        FileWarning
            If the run cannot be saved on its way.
        """
        force = load if callable(load) else _Constant(require_number("load", load))
        motion = BallMotion(W=W, load=force, unit=self.equations.ellipse.load)
        return self._run(start, motion, duration, control, snapshots, keep)

    def drive(
        self,
        start: ContactState | ContactRun,
        *,
        duration: float,
        approach: Callable[[float], float],
        control: AdaptiveSteps | FixedSteps | None = None,
        snapshots: Sequence[float] = (),
        keep: str | Path | None = None,
    ) -> ContactRun:
        """Return the contact under a given approach delta(t); otherwise like `simulate`."""
        return self._run(start, GivenMotion(approach=approach), duration, control, snapshots, keep)

    def save(self, run: ContactRun, path: str | Path) -> None:
        """Write a run and what it takes to go on with it, as NetCDF; snapshots are left out."""
        save_run(run, path, repr(self))

    def load(self, path: str | Path) -> ContactRun:
        """Return a run of this contact from a file; raise InputError if it is of another one, or damaged."""
        return load_run(path, repr(self), self.equations)

    def _run(
        self,
        start: ContactState | ContactRun,
        motion: BallMotion | GivenMotion,
        duration: float,
        control: AdaptiveSteps | FixedSteps | None,
        snapshots: Sequence[float],
        keep: str | Path | None,
    ) -> ContactRun:
        require_positive("duration", duration)
        self._start(start.final if isinstance(start, ContactRun) else start)
        if isinstance(start, ContactRun) and start.complete:
            raise InputError("start must be a state, or a run that is not complete, got a complete run")
        steps = AdaptiveSteps() if control is None else control
        saved = None if keep is None else partial(self._kept, Path(keep))
        run = run_contact(self.equations, motion, steps, start, duration, snapshots, saved)
        self._checked(run.final)
        return run

    def _kept(self, path: Path, run: ContactRun) -> None:
        try:
            self.save(run, path)
        except OSError as error:  # what has been computed is worth more
            warn_user(f"the run could not be saved: {error}", FileWarning)

    def _start(self, state: ContactState) -> ContactState:
        if not isinstance(state, ContactState) or state.pressure.shape != self.grid.shape:
            raise InputError(f"start must be a ContactState on {self.grid!r}, got {_described(state)}")
        return state

    def _checked(self, state: ContactState) -> ContactState:
        if state.checkerboard > ALTERNATING:
            warnings.warn(
                f"pressure must not alternate from cell to cell by more than {ALTERNATING:.1%}, got "
                f"{state.checkerboard:.1%} at V = {self.V:.4g}, Q0 = {self.Q0:.4g}: use UpwindScheme() "
                "or more cells",
                ValidityWarning,
                stacklevel=3,
            )
        return state


@arguments
def perturbed(contact: PointContact, state: ContactState, share: float) -> ContactState:
    """Return a state with pressure and approach enlarged by a share, at rest (Panovko 2011, section 4.1)."""
    factor = 1.0 + require_number("share", share)
    return replace(contact.state(factor * state.pressure, factor * state.delta), t=0.0)


@dataclass(frozen=True)
class _Constant:
    value: float

    def __call__(self, t: float) -> float:
        return self.value


def _described(state: object) -> str:
    return f"one of shape {state.pressure.shape}" if isinstance(state, ContactState) else repr(state)
