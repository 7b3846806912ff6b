"""The dimensionless point contact of a ball on a plane or in a groove, lubricated and elastic."""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    FileWarning,
    InputError,
    ValidityWarning,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.readable import Readable
from ...core.signals import Signal, signals_of
from ..formulas import Ellipse, HamrockDowson, require_ellipticity
from .contact_grid import ContactGrid, ContactScheme, StaggeredScheme, UpwindScheme
from .contact_law import FORCE_TEXT, SLOW
from .contact_steps import (
    AdaptiveSteps,
    BallMotion,
    ContactMotion,
    ContactRun,
    ContactState,
    FixedSteps,
    GivenMotion,
    Level,
    Stepper,
    level_of,
    load_run,
    run_contact,
    save_run,
    state_of,
)
from .film_equations import (
    HIGGINSON_PRESSURE,
    BarusViscosity,
    ContactEquations,
    DowsonHigginsonDensity,
    Piezoviscosity,
    RoelandsViscosity,
    roelands_viscosity,
)
from .film_newton import Contact
from .stationary import SmallMotion, follow, stationary, stationary_at

ALTERNATING = 0.025
"""Alternating share of the pressure above which it is not to be trusted."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PointContact:
    """Elastohydrodynamic contact of a ball rolling on a plane, in units of the Hertzian contact.

    Lengths in the plane are in Hertzian radii a, film thickness and approach in a^2/(2 R). Pressures are in
    the Hertzian maximum p_H, and loads in the Hertzian load 2 pi p_H a^2/3. Time is in 2 a/(u1 + u2), where
    u1 and u2 are the surface speeds in the frame of the contact. `RollingBall` converts from SI. Equations,
    accuracy and errata of the source: `docs/contact.md`.

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
        Density of the lubricant; incompressible by default.
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
        require_kind("grid", self.grid, ContactGrid, "a ContactGrid")
        require_kind("scheme", self.scheme, ContactScheme, "a ContactScheme")
        require_kind("piezoviscosity", self.piezoviscosity, Piezoviscosity, "a Piezoviscosity")
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
            Start from `stationary`, `state` or an earlier run. An incomplete run continues to its end if all
            other arguments are the same; the result is bit for bit that of an uninterrupted run. If it was
            read from a file, earlier snapshots are missing, since the file does not hold them.
        duration : float [1]
            Duration of the run as a whole.
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
            File in which the run is saved three times a minute, and at its end, also if it fails; `load`
            reads it.

        Raises
        ------
        InputError
            If an interrupted run began with other arguments, or had another load so far.
        ConvergenceError
            If a step fails; its `partial` is the run up to there.

        Warns
        -----
        FileWarning
            If the run cannot be saved while it proceeds.
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
        """Simulate the contact under a given approach delta(t); all else is as in `simulate`."""
        return self._run(start, GivenMotion(approach=approach), duration, control, snapshots, keep)

    def save(self, run: ContactRun, path: str | Path) -> None:
        """Write a run as NetCDF, with the data to continue it but without its snapshots."""
        save_run(run, path, repr(self))

    def load(self, path: str | Path) -> ContactRun:
        """Return a run of this contact from a file; InputError if it is damaged or of another contact."""
        return load_run(path, repr(self), self.equations)

    def _run(
        self,
        start: ContactState | ContactRun,
        motion: ContactMotion,
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
            known = isinstance(state, ContactState)
            got = f"one of shape {state.pressure.shape}" if known else repr(state)
            raise InputError(f"start must be a ContactState on {self.grid!r}, got {got}")
        return state

    def _checked(self, state: ContactState) -> ContactState:
        warn_of_alternating(state.checkerboard, self.V, self.Q0, stacklevel=4)
        return state


def warn_of_alternating(share: float, V: float, Q0: float, *, stacklevel: int) -> None:
    """Warn where the pressure of a contact alternates from cell to cell by more than a share."""
    if share > ALTERNATING:
        warnings.warn(
            f"pressure must not alternate from cell to cell by more than {ALTERNATING:.1%}, got "
            f"{share:.1%} at V = {V:.4g}, Q0 = {Q0:.4g}: use UpwindScheme() or more cells",
            ValidityWarning,
            stacklevel=stacklevel,
        )


@arguments
def perturbed(contact: PointContact, state: ContactState, share: float) -> ContactState:
    """Return a state at rest with pressure and approach enlarged by a factor (Panovko 2011, section 4.1)."""
    factor = 1.0 + require_number("share", share)
    return replace(contact.state(factor * state.pressure, factor * state.delta), t=0.0)


@dataclass(frozen=True)
class _Constant:
    value: float

    def __call__(self, t: float) -> float:
        return self.value


# A ball rolling on a lubricated plane, in SI.


class PublishedFilms(NamedTuple):
    """Film thicknesses of a ball by published formulas [m].

    Attributes
    ----------
    nijenbanning_venner_moes : float [m]
        Central film (1994).
    hamrock_dowson, hamrock_dowson_minimum : float [m]
        Central and smallest film (1977).
    """

    nijenbanning_venner_moes: float
    hamrock_dowson: float
    hamrock_dowson_minimum: float


@quantities
@dataclass(frozen=True, kw_only=True)
class RollingBall:
    """A ball that rolls without slip on a lubricated plane.

    The velocity scale: Reynolds' equation carries the film with the mean of the two surface speeds in the
    frame of the contact. In pure rolling at `speed` both surfaces move at `speed`, u1 + u2 = 2 speed, so

        V = 48 mu0 speed R^2/(p_H a^3),    t0 = a/speed,    W = pi m speed^2/(3 P R).

    The source (Panovko 2011) writes |v| for u1 + u2; taken for the rolling speed, its V would
    be half of this.

    Parameters
    ----------
    radius : float [m]
        Radius of the ball.
    mass : float [kg]
        Mass that moves with the ball against the contact.
    modulus, poisson_ratio : float [Pa, 1]
        Elastic modulus and Poisson's ratio of the ball.
    viscosity : float [Pa s]
        Viscosity at ambient pressure.
    pressure_coefficient : float [1/Pa]
        Pressure coefficient of the viscosity, d ln mu/dp at ambient pressure.
    speed : float [m/s]
        Speed of the ball's center along the plane, > 0.
    load : float [N]
        Static, its weight included.
    plane_modulus : float [Pa]
        Elastic modulus of the plane; infinite (rigid), as published, by default.
    plane_poisson_ratio : float [1]
        Poisson's ratio of the plane.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    radius: float
    mass: float
    modulus: float
    poisson_ratio: float
    viscosity: float
    pressure_coefficient: float
    speed: float
    load: float
    plane_modulus: float = math.inf
    plane_poisson_ratio: float = 0.3

    def __post_init__(self) -> None:
        require_each(
            self, require_positive, "radius", "modulus", "viscosity", "pressure_coefficient", "speed", "load"
        )
        require_non_negative("mass", self.mass)
        if self.plane_modulus != math.inf:
            require_positive("plane_modulus", self.plane_modulus)
        for name in ("poisson_ratio", "plane_poisson_ratio"):
            if not -1.0 < require_number(name, getattr(self, name)) <= 0.5:
                raise InputError(f"{name} must be above -1 and at most 0.5, got {getattr(self, name)!r}")

    @property
    def combined_modulus(self) -> float:
        """Combined modulus E' [Pa]: 2/E' is the sum of (1 - nu^2)/E of the ball and of the plane."""
        ball = (1.0 - self.poisson_ratio**2) / self.modulus
        return 2.0 / (ball + (1.0 - self.plane_poisson_ratio**2) / self.plane_modulus)

    @property
    def contact_radius(self) -> float:
        """Radius a of the dry contact by Hertz [m]."""
        return float((1.5 * self.load * self.radius / self.combined_modulus) ** (1.0 / 3.0))

    @property
    def contact_pressure(self) -> float:
        """Largest pressure p_H of the dry contact [Pa]."""
        return 1.5 * self.load / (math.pi * self.contact_radius**2)

    @property
    def film_scale(self) -> float:
        """Unit of film thickness and approach, a^2/(2 R) [m]."""
        return self.contact_radius**2 / (2.0 * self.radius)

    @property
    def time_scale(self) -> float:
        """Unit of time, a/speed [s]."""
        return self.contact_radius / self.speed

    @property
    def V(self) -> float:
        """Speed parameter V of the contact, as in `PointContact` [1]."""
        scale = self.contact_pressure * self.contact_radius**3
        return 48.0 * self.viscosity * self.speed * self.radius**2 / scale

    @property
    def Q0(self) -> float:
        """Pressure-viscosity coefficient times p_H [1]."""
        return self.pressure_coefficient * self.contact_pressure

    @property
    def W(self) -> float:
        """Inertia parameter W of the ball, as in `PointContact` [1]."""
        return math.pi * self.mass * self.speed**2 / (3.0 * self.load * self.radius)

    @property
    def moes(self) -> Moes:
        """The load parameter M and the material parameter L of Moes [1]."""
        return moes_parameters(self.V, self.Q0)

    @property
    def hamrock_dowson(self) -> HamrockDowson:
        """The parameters of Hamrock and Dowson, and their film thicknesses divided by R [1]."""
        return HamrockDowson(
            self.viscosity * self.speed / (self.combined_modulus * self.radius),
            self.pressure_coefficient * self.combined_modulus,
            self.load / (self.combined_modulus * self.radius**2),
        )

    @property
    def published_films(self) -> PublishedFilms:
        """Film thicknesses by published formulas [m]."""
        speed = 2.0 * self.hamrock_dowson.U
        return PublishedFilms(
            self.moes.central_film * math.sqrt(speed) * self.radius,
            self.hamrock_dowson.central_film * self.radius,
            self.hamrock_dowson.minimum_film * self.radius,
        )

    def contact(
        self,
        grid: ContactGrid | None = None,
        scheme: ContactScheme | None = None,
        *,
        roelands: bool = False,
        compressible: bool = False,
    ) -> PointContact:
        """Return the dimensionless contact.

        Parameters
        ----------
        grid, scheme : optional
            Grid and scheme as in `PointContact`.
        roelands : bool
            Whether the viscosity follows Roelands' law, with the same slope at ambient pressure, rather than
            Barus' exponential.
        compressible : bool
            Whether the density follows Dowson and Higginson.
        """
        return PointContact(
            V=self.V,
            Q0=self.Q0,
            grid=ContactGrid() if grid is None else grid,
            scheme=UpwindScheme() if scheme is None else scheme,
            piezoviscosity=self._roelands() if roelands else BarusViscosity(),
            density=DowsonHigginsonDensity(pressure_ratio=self.contact_pressure / HIGGINSON_PRESSURE)
            if compressible
            else None,
        )

    def _roelands(self) -> RoelandsViscosity:
        return roelands_viscosity(
            viscosity=self.viscosity,
            pressure_coefficient=self.pressure_coefficient,
            pressure=self.contact_pressure,
        )


# Published film-thickness formulas of circular elastohydrodynamic contacts, and their parameters.


UNLOADED_FILM = 1.8
"""Largest central film / (R sqrt(2 U)) of an elastic contact of constant viscosity, as its load vanishes."""


class Moes(NamedTuple):
    """The two parameters of Moes [1]: of load, M = W/(2 U)^(3/4), and of the lubricant, L = G (2 U)^(1/4)."""

    M: float
    L: float

    @property
    def asymptotes(self) -> Asymptotes:
        """Central film thickness / (R sqrt(2 U)) of a circular contact in each of four limits."""
        return Asymptotes(
            145.0 * 1.796 ** (-15.0 / 7.0) * self.M**-2.0,
            3.18 * 1.63 ** (-14.0 / 25.0) * self.M ** (-2.0 / 15.0),
            1.29 * 1.691 ** (-2.0 / 3.0) * self.L ** (2.0 / 3.0),
            1.48 * 1.63 ** (-7.0 / 20.0) * self.M ** (-1.0 / 12.0) * self.L**0.75,
        )

    @property
    def central_film(self) -> float:
        """Central film thickness / (R sqrt(2 U)), Nijenbanning, Venner and Moes (1994), circular contact.

        The formula joins four limits; it was fitted to compressible films with Roelands' viscosity.
        """
        ri, ei, rp, ep = self.asymptotes
        s = 1.5 * (1.0 + math.exp(-1.2 * ei / ep))
        isoviscous = ri**1.5 + (ei**-4.0 + UNLOADED_FILM**-4.0) ** (-3.0 / 8.0)
        piezoviscous = (rp**-8.0 + ep**-8.0) ** (-s / 8.0)
        return float((isoviscous ** (2.0 * s / 3.0) + piezoviscous) ** (1.0 / s))


class Asymptotes(NamedTuple):
    """Film thicknesses of a contact in four limits: rigid or elastic, of constant viscosity or not [1]."""

    rigid_isoviscous: float
    elastic_isoviscous: float
    rigid_piezoviscous: float
    elastic_piezoviscous: float


def moes_parameters(V: float, Q0: float) -> Moes:
    """Return the parameters of Moes of a dimensionless contact."""
    M = (128.0 * math.pi**3 / (3.0 * (V / 4.0) ** 3)) ** 0.25
    return Moes(M, math.pi * Q0 / (1.5 * M) ** (1.0 / 3.0))


def hamrock_dowson(moes: Moes, U: float) -> HamrockDowson:
    """Return the parameters of Hamrock and Dowson of a contact, which need a speed U beside those of Moes."""
    return HamrockDowson(U, moes.L * (2.0 * U) ** -0.25, moes.M * (2.0 * U) ** 0.75)


# The dynamic stiffness of a point contact over frequency, relative to that of the dry contact.


@dataclass(frozen=True, kw_only=True)
class ContactStiffness(Readable):
    """Stiffness and damping of small harmonic motions about a contact at rest, over the dry stiffness.

    Attributes
    ----------
    frequency : ndarray, shape (n,) [1]
        Angular frequencies, in the inverse of the unit of time.
    stiffness : ndarray, shape (n,) [1]
        Re Z/k_H, Z = -d(force)/d(approach), k_H the same of the dry contact.
    damping : ndarray, shape (n,) [1]
        Im Z/(frequency k_H), in the unit of time.
    central_film : float [1]
        Film thickness at the center at rest.
    """

    frequency: Array
    stiffness: Array
    damping: Array
    central_film: float


@arguments
def dynamic_stiffness(contact: PointContact, frequency: ArrayLike) -> ContactStiffness:
    """Return stiffness and damping of a contact under the unit load over the frequency.

    One dense linear solution each: 0.05 s on 40 x 40 cells, a second on 64 x 64.

    Parameters
    ----------
    contact : PointContact
    frequency : array_like, shape (n,) [1]
        Angular frequencies, in the inverse of the contact's unit of time; 0 is the limit of slow motion.

    Raises
    ------
    InputError
        If a frequency is negative or not finite.
    ConvergenceError
        If the contact at rest is not found.

    Examples
    --------
    >>> grid = ContactGrid(cells=(24, 24), half_width=1.5)
    >>> contact = PointContact(V=0.1, Q0=5.0, ellipticity=4.0, grid=grid)
    >>> dynamic_stiffness(contact, [0.0, 2.0]).damping.round(3).tolist()
    [0.043, 0.014]
    """
    require_kind("contact", contact, PointContact, "a PointContact")
    rate = np.atleast_1d(require_finite("frequency", frequency))
    if rate.ndim != 1 or rate.min() < 0.0:
        raise InputError(f"frequency must be a list of numbers, none negative, got {frequency!r}")
    state = contact.stationary()
    small = SmallMotion(contact.equations, state.levels[0].pressure, state.delta)
    omega = np.maximum(rate, SLOW)
    answer = np.array([small.stiffness(1j * w) for w in omega]) / contact.equations.ellipse.slope
    return ContactStiffness(
        frequency=rate,
        stiffness=answer.real.copy(),
        damping=answer.imag / omega,
        central_film=state.central_film,
    )


# The full point contact under a given approach, as a model that brings its own time integration.


Levels = tuple[Level, ...]

HALVINGS = 4
"""Times that a step is halved before it is given up."""


@quantities
@dataclass(frozen=True, kw_only=True)
class MovingContact:
    """A lubricated point contact with a prescribed motion of the ball: a Stepped model with the whole film.

    The input z is the approach that is reached at the end of a step; on the way there it is linear in time.
    The outputs belong to the end of the last step. Steps are second-order differences (BDF2), no longer than
    `largest`, and are halved where the equations cannot be solved. `ContactLaw` is its reduced law, with
    which it is linearized.

    Parameters
    ----------
    contact : PointContact
    film_scale, time_scale, force_scale : float [m, s, N]
        Units of approach and film, time and force; 1 for a dimensionless contact. `moving_contact` takes
        them from a ball.
    largest : float [1]
        Longest inner step, in the unit of time.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    contact: PointContact
    film_scale: float = 1.0
    time_scale: float = 1.0
    force_scale: float = 1.0
    largest: float = 0.1

    def __post_init__(self) -> None:
        require_kind("contact", self.contact, PointContact, "a PointContact")
        require_each(self, require_positive, "film_scale", "time_scale", "force_scale", "largest")

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The approach."""
        text = "approach of the ball's center beyond first touch at the end of a step, negative in contact"
        return signals_of(("z", "m", 2.0 * self.film_scale, text))

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The force and the film thickness."""
        return signals_of(
            ("force_z", "N", self.force_scale, FORCE_TEXT),
            ("central_film", "m", self.film_scale, "film at the center"),
            ("minimum_film", "m", self.film_scale, "smallest film"),
        )

    def start(self, u: ArrayLike) -> Levels:
        """Return the steady state of the contact at the approach u = (z,) [m].

        Raises
        ------
        ConvergenceError
            If it is not found.
        """
        target = float(np.asarray(u, dtype=float)[0]) / self.film_scale
        equations = self.contact.equations
        found = stationary_at(equations, target)
        return (level_of(equations, found.pressure, found.delta),)

    def step(self, state: Levels, t: float, u: ArrayLike, dt: float) -> tuple[Levels, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s] in which the approach goes to u = (z,).

        Raises
        ------
        ConvergenceError
            If the equations cannot be solved even on steps halved several times; the old state stays valid.
        """
        if dt == 0.0:
            return state, self.answer(state), {"steps": 0}
        begin, duration = state[0], dt / self.time_scale
        target = float(np.asarray(u, dtype=float)[0]) / self.film_scale
        rate = (target - begin.delta) / duration
        motion = GivenMotion(approach=lambda time: begin.delta + rate * (time - begin.t))
        pieces = math.ceil(duration / self.largest)
        for halving in range(HALVINGS + 1):
            control = FixedSteps(step=duration / (pieces * 2**halving))
            stepper = Stepper(self.contact.equations, motion, control)
            try:
                *_, levels = stepper.advance(state, (begin.t + duration,))
            except ConvergenceError:
                if halving == HALVINGS:
                    raise
            else:
                break
        return levels, self.answer(levels), stepper.work

    def answer(self, state: Levels) -> Array:
        """Return (force_z, central_film, minimum_film) [N, m, m] of a state."""
        equations, newest = self.contact.equations, state[0]
        load = equations.carried_load(newest.pressure)
        central = equations.central_film(newest.pressure, newest.delta)
        film = equations.film(newest.pressure, newest.delta)
        return np.array(
            [load * self.force_scale, central * self.film_scale, float(film.min()) * self.film_scale]
        )

    def pack(self, state: Levels) -> bytes:
        """Return a state as bytes, from which it is restored exactly."""
        buffer = io.BytesIO()
        rows: dict[str, Any] = {name: [getattr(level, name) for level in state] for name in Level._fields}
        np.savez(buffer, **rows)
        return buffer.getvalue()

    def unpack(self, content: bytes) -> Levels:
        """Return the state in bytes; raise InputError if it belongs to another grid."""
        cells = self.contact.grid.shape[0] * self.contact.grid.shape[1]
        with np.load(io.BytesIO(content), allow_pickle=False) as file:
            rows = {name: file[name] for name in Level._fields}
        if rows["pressure"].shape[1:] != (cells,):
            raise InputError(f"content must be of {cells} cells, got shape {rows['pressure'].shape}")
        return tuple(
            Level(float(t), float(delta), float(velocity), pressure, stored)
            for t, delta, velocity, pressure, stored in zip(*rows.values(), strict=True)
        )


@arguments
def moving_contact(ball: RollingBall, contact: PointContact) -> MovingContact:
    """Return the full contact of a ball, from `ball.contact(...)`, in SI."""
    return MovingContact(
        contact=contact, film_scale=ball.film_scale, time_scale=ball.time_scale, force_scale=ball.load
    )
