"""What a point contact answers: its state at one time, and a run over time."""

from __future__ import annotations

from dataclasses import dataclass

from ....model import Array
from ....readable.result import Drawable, Readable
from ..film.checkerboard import checkerboard
from ..film.film_equations import ContactEquations
from .contact_steps import Memory
from .levels import Level


@dataclass(frozen=True, kw_only=True)
class ContactState(Readable):
    """A point contact at one time, in units of the Hertzian contact; a run starts from one.

    Attributes
    ----------
    t : float [1]
        Time.
    delta, velocity : float [1]
        Rigid approach, negative in contact, and its rate.
    central_film, minimum_film : float [1]
        Film thickness H at the center, and the smallest.
    carried_load : float [1]
        Integral of the pressure over that of the dry contact, 2 pi ellipticity/3.
    pressure, thickness : ndarray, shape (nx, m) [1]
        p and H over `grid.x` and `grid.y`, y > 0.
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell (`films.checkerboard`).
    levels : tuple of Level
        This and earlier times, newest first: what second-order steps need to go on.
    """

    t: float
    delta: float
    velocity: float
    central_film: float
    minimum_film: float
    carried_load: float
    pressure: Array
    thickness: Array
    checkerboard: float
    levels: tuple[Level, ...]


@dataclass(frozen=True, kw_only=True)
class ContactRun(Drawable):
    """A contact over time; all series have the shape (steps + 1,) and begin with the start.

    Attributes
    ----------
    time : ndarray [1]
        Times of the results.
    delta, velocity, central_film, minimum_film, carried_load : ndarray [1]
        As in `ContactState`.
    driven : ndarray [1]
        Load f, or approach of a driven contact, at those times.
    snapshots : tuple of ContactState
        States at the times asked for; of a run that was read from a file, those after it was cut off.
    final : ContactState
        Where the run ended; another run may start from it.
    complete : bool
        Whether it reached its end.
    work : dict of str to int
        Steps, rejected steps, Newton and GMRES iterations.
    asked : str
        Motion, control and end that were asked for: a run that is not complete goes on with these only.
    memory : Memory
        What the integration knows beside `final.levels`.
    """

    time: Array
    delta: Array
    velocity: Array
    central_film: Array
    minimum_film: Array
    carried_load: Array
    driven: Array
    snapshots: tuple[ContactState, ...]
    final: ContactState
    complete: bool
    work: dict[str, int]
    asked: str
    memory: Memory


def state_of(equations: ContactEquations, levels: tuple[Level, ...]) -> ContactState:
    """Return the state that the newest of some levels is."""
    newest, shape = levels[0], equations.grid.shape
    film = equations.film(newest.pressure, newest.delta)
    load = equations.carried_load(newest.pressure)
    return ContactState(
        t=newest.t,
        delta=newest.delta,
        velocity=newest.velocity,
        central_film=equations.central_film(newest.pressure, newest.delta),
        minimum_film=float(film.min()),
        carried_load=load,
        pressure=newest.pressure.reshape(shape),
        thickness=(equations.sampling.stored @ film).reshape(shape),
        checkerboard=checkerboard(newest.pressure.reshape(shape), equations.grid, load),
        levels=levels,
    )


def level_of(equations: ContactEquations, pressure: Array, delta: float, velocity: float = 0.0) -> Level:
    """Return the level at t = 0 of given pressures (n,), approach and velocity."""
    stored = equations.stored(pressure, equations.film(pressure, delta))
    return Level(0.0, float(delta), float(velocity), pressure, stored)
