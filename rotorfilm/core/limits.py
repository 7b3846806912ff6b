"""The largest inputs that scene files and the command line take, each with its reason.

Beyond them lies a slip of the pen, or more memory and time than a machine has. The classes of models
have no such limits: what Python code asks of them, it may have. Quantities given as text (MAGNITUDE), numbers
(NUMBER), simulations (TURNS, STEPS) and `sweep` (SWEEP_POINTS, WORKERS) have them from Python too.
"""

from __future__ import annotations

from .errors import InputError

MAGNITUDE = 1e30
"""Of a quantity in SI, and of one over it. Nothing that is built comes near, neutron stars included, and
products of ten such numbers are still finite in double precision (1e308)."""

NUMBER = 1e150
"""Of a number given to a public class or function: its square is finite. What follows from the quantities of
a scene, as an inertia from a diameter, is below."""

SCENE_BYTES = 2**20
"""Of a scene file. A shaft of 500 elements, written one by one, takes a tenth; a device never ends."""

RECORD_BYTES = 2**26
"""Of a record, a table or a rotor in a file: a million rows of three numbers with all of their digits."""

LINE_DOTS = 200
"""In a line of a scene file. The time to read a dotted key grows as the square of its parts; keys of scenes
have five, and lists of numbers a dot for each."""

TEXT = 200
"""Characters of a title or a name: a line or two of a print-out."""

SHAFT_ELEMENTS = 500
"""Of a shaft. Its 4000 states make dense matrices of 128 MB, with a minute for the eigenvalues."""

SEEDS = 2**31 - 1
"""Largest seed of random numbers."""

SPEEDS = 10_000
"""At which a shaft is looked at. Each is an eigenvalue problem, of a millisecond at the least."""

FILM_CELLS = 2**18
"""Of a film in two dimensions: one force takes 300 MB and half a minute. The references have a twentieth."""

CONTACT_CELLS = 256
"""Along each side of a point contact: rest alone takes 150 MB and ten seconds. The references have 96."""

MAP_NODES = 2**20
"""Of a map of a bearing with openings. Each is a film solved, in a millisecond at the least."""

FUNCTIONS = 100
"""Along each side of the order of a splitting film; from ten on its error is below that of the rupture."""

LAW_STATES = 31
"""Of the reduced law of a contact, which is fitted to 32 frequencies."""

WORN_NODES = 10_000
"""Of the profile of a worn bush: a state each, and a hundred times as many as its tests need."""

TRANSITS = 100_000
"""Transit times that a contact is followed, each of ten steps or more: some minutes by the reduced law."""

SWING_RATE = 10_000
"""Radians of a load per transit time: the film feels less than a millionth of what is that fast."""

STEPS = 10_000_000
"""Exchanges or samples of a run, which keep some twenty signals each: 1.6 GB."""

TURNS = 10_000_000
"""Of a rotor in a simulation: each takes ten steps or more, so that it lasts for days."""

SWEEP_POINTS = 100_000
"""Of a sweep. Each is a scene read and solved, ten milliseconds at the least: a quarter of an hour."""

CHART_STATES = 100_000
"""Random states behind a chart, whose percentiles a thousand settle: each is solved by every film."""

WORKERS = 1024
"""Processes of a sweep: more than the cores of any one machine."""


def require_at_most(name: str, value: float, most: float) -> None:
    """Raise InputError where `value` is above the limit `most`."""
    if value > most:
        raise InputError(f"{name} must be at most {most:g}, got {value:g}")
