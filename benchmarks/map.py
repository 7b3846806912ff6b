"""The impedance map against the law that it tabulates, in one run: error, batched and scalar cost, ratios.

First the packaged map against its rivals at L/D 0.5, errors of both sides and costs interleaved: short film,
splitting orders, and the two-dimensional film at 1 % and at the map's own error, each on the cheapest grid
that gets there, or comes closest. Then tables made from the short film, whose force is known exactly, so that
the error is that of the table alone. Baseline of the batch: the short film itself (closed form, NumPy).
Baseline of the scalar calls: the fastest that Python can do, the short film's closed form for the steady
journal written out with `math`. Maps of bearings with openings are made on first use: what that takes.

    python benchmarks/map.py
"""

from __future__ import annotations

from math import pi, prod, sqrt
from time import perf_counter, process_time

import numpy as np

from rotorfilm import Groove
from rotorfilm.bearings import FilmGeometry, FilmLaw, aligned_openings, tabulate_film
from rotorfilm.bearings.films.map_fit import cores
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    ExtrapolatedFilm,
    GroovedMapFilm,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SplittingFilm,
    fitted_bearing,
)
from rotorfilm.bearings.journal.groove_map import GrooveMap, Resolution
from rotorfilm.studies import (
    LARGE,
    States,
    comparison_bearing,
    film_costs,
    random_states,
    reference_force,
    relative_error,
    shortest_time,
)

COUNT = 20000
RANGES = ((0.0, 0.95), (0.95, 0.99), (0.99, 0.999))
RADIUS, LENGTH, CLEARANCE, VISCOSITY = 0.05, 0.04, 1e-4, 0.1
STATES = 64
OPENED = 200
REFERENCE_CELLS = (1536, 32)
GRIDS = ((32, 8), (48, 8), (64, 8), (96, 8), (128, 8), (192, 8), (384, 8), (384, 16), (768, 16), (768, 32))
STATE = (1e-5, -2e-5, 1e-3, 2e-3, 100.0)


def steady_force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
    """Return Ocvirk's steady force in plain Python; the velocity is not used."""
    eps2 = (x * x + y * y) / CLEARANCE**2
    k = VISCOSITY * speed * LENGTH**3 * RADIUS / CLEARANCE**3
    across, along = k * pi / (4.0 * (1.0 - eps2) ** 1.5), k * sqrt(eps2) / (1.0 - eps2) ** 2
    return -along * x + across * y, -along * y - across * x


def random_sources(lowest: float, highest: float) -> tuple[np.ndarray, np.ndarray]:
    """Return eccentricities and sources, shape (2, COUNT)."""
    rng = np.random.default_rng(1)
    chi, phi = rng.uniform(lowest, highest, COUNT), rng.uniform(-np.pi, np.pi, COUNT)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, COUNT))


def print_accuracy() -> None:
    """Print the 99 % error and the cost of tables of growing size."""
    print("error of the table against the law it tabulates (99 %, vector), L/D 0.4")
    print(f"{'cells X, T':>12s}{'bytes':>9s}" + "".join(f"{f'to {high}':>11s}" for _, high in RANGES))
    for cells in ((12, 24), (16, 32), (24, 48), (32, 64), (48, 96)):
        table = tabulate_film(
            ShortFilm(), slenderness_range=(0.4, 0.4), cells=(*cells, 0), largest_eccentricity_ratio=0.999
        )
        errors = []
        for lowest, highest in RANGES:
            e, w = random_sources(lowest, highest)
            exact = ShortFilm().force(e, w, 0.4)
            gap = np.linalg.norm(MapFilm(table).force(e, w, 0.4) - exact, axis=0)
            errors.append(np.quantile(gap / np.linalg.norm(exact, axis=0), 0.99))
        size = len(table.to_bytes())
        print(f"{cells[0]:6d}, {cells[1]:4d}{size:9d}" + "".join(f"{error:11.1e}" for error in errors))


def print_batch(mapped: JournalBearing, short: JournalBearing) -> None:
    """Print the cost of a force and of a Jacobian in a batch."""
    e, w = random_sources(0.0, 0.95)
    arguments = (CLEARANCE * e, CLEARANCE * 100.0 * w, np.full(COUNT, 100.0))
    rows = [
        ("map, force", lambda: mapped.force(*arguments)),
        ("map, force and Jacobian", lambda: mapped.jacobian(*arguments)),
        ("short film, force", lambda: short.force(*arguments)),
        ("short film, Jacobian", lambda: short.jacobian(*arguments)),
    ]
    times = {name: shortest_time(call) / COUNT for name, call in rows}
    print(f"\nbatch of {COUNT} validated states in SI units, per state; map force = 1")
    for name, seconds in times.items():
        print(f"{name:32s}{1e9 * seconds:9.0f} ns{seconds / times['map, force']:9.2f}")


def print_scalar(mapped: JournalBearing, short: JournalBearing) -> None:
    """Print the cost of one force, state by state."""
    position, velocity, speed = list(STATE[:2]), list(STATE[2:4]), STATE[4]
    arrays = np.array(position), np.array(velocity), np.array(speed)
    prepared = mapped.prepare()
    rows = [
        ("plain Python, steady short film", lambda: steady_force(*STATE)),
        ("map, prepare()", lambda: prepared(*STATE)),
        ("map, prepared_force", lambda: mapped.prepared_force(*arrays)),
        ("map, force", lambda: mapped.force(position, velocity, speed)),
        ("map, jacobian", lambda: mapped.jacobian(position, velocity, speed)),
        ("short film, force", lambda: short.force(position, velocity, speed)),
        ("short film, jacobian", lambda: short.jacobian(position, velocity, speed)),
    ]
    times = {name: shortest_time(call, loops=1000) for name, call in rows}
    print("\none state per call; plain Python = 1")
    for name, seconds in times.items():
        print(f"{name:32s}{1e6 * seconds:9.2f} us{seconds / times[rows[0][0]]:9.1f}")


def high_error(film: FilmLaw, bearing: JournalBearing, states: States, reference: np.ndarray) -> float:
    """Return the 99 % error of a film."""
    return float(np.quantile(relative_error(fitted_bearing(bearing, film).force(*states), reference), 0.99))


def grid_films() -> list[FilmLaw]:
    """Return the two-dimensional film on all grids, plain and extrapolated, cheapest first."""
    plain = [ReynoldsFilm(cells=cells) for cells in GRIDS]
    return [film for fine in plain for film in (fine, ExtrapolatedFilm(film=fine))]


def cheapest(
    wanted: float, bearing: JournalBearing, states: States, reference: np.ndarray
) -> tuple[FilmLaw, float]:
    """Return the first two-dimensional film within an error, or the closest there is, and its error."""
    best: tuple[FilmLaw, float] | None = None
    for film in grid_films():
        error = high_error(film, bearing, states, reference)
        if best is None or error < best[1]:
            best = film, error
        if error <= wanted:
            return film, error
    assert best is not None
    return best


def print_rivals() -> None:
    """Print the packaged map beside the short film, splitting orders and the two-dimensional film."""
    bearing = comparison_bearing(0.5)
    states = random_states(LARGE, count=STATES, clearance=bearing.clearance)
    reference, own = reference_force(bearing, states, cells=REFERENCE_CELLS)
    mapped = high_error(MapFilm(), bearing, states, reference)
    coarse, closest = (cheapest(wanted, bearing, states, reference)[0] for wanted in (0.01, mapped))
    films: dict[str, FilmLaw] = {
        "map": MapFilm(),
        "short film": ShortFilm(),
        "(2, all), rotating arc": SplittingFilm(order=(2, None), rupture=RotatingArc()),
        "(6, all), rotating arc": SplittingFilm(order=(6, None), rupture=RotatingArc()),
        "(4+c, 8), free arc": SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc()),
        f"2-D at 1 %: {described(coarse)}": coarse,
        f"2-D, closest to the map: {described(closest)}": closest,
    }
    bearings = {name: fitted_bearing(bearing, film) for name, film in films.items()}
    costs = film_costs(bearings, states, rounds=5)
    print(f"L/D 0.5, {STATES} random states, {LARGE}")
    print(f"reference: {REFERENCE_CELLS} cells, extrapolated; its error (99 %) {np.quantile(own, 0.99):.1e}")
    print(f"{'film':46s}{'99 % error':>11s}{'batch':>12s}{'/ map':>10s}{'alone':>12s}{'/ map':>10s}")
    best = costs["map"]
    for name, film in films.items():
        error, (force, call, _) = high_error(film, bearing, states, reference), costs[name]
        batch, alone = force / best[0], call / best[1]
        print(f"{name:46s}{error:11.1e}{1e6 * force:9.2f} us{batch:10.3g}{1e6 * call:9.2f} us{alone:10.3g}")


def described(film: FilmLaw) -> str:
    """Return the grid of a two-dimensional film in words."""
    if isinstance(film, ExtrapolatedFilm):
        return "{} x {} extrapolated".format(*film.film.cells)
    assert isinstance(film, ReynoldsFilm)
    return "{} x {}".format(*film.cells)


def print_openings() -> None:
    """Print what maps of a bearing with two grooves take, beside forces at their nodes one by one."""
    grooves = tuple(Groove(center=pi * k, width=pi / 9.0) for k in range(2))
    openings = aligned_openings(FilmGeometry(grooves=grooves))
    geometry = FilmGeometry(grooves=openings.grooves)
    e, w = random_sources(0.0, 0.9)
    e, w = e[:, :OPENED], w[:, :OPENED]
    exact, _ = ReynoldsFilm(cells=(384, 24), geometry=geometry).extrapolated(e, w, 0.5)
    print(f"maps of two grooves of 20 deg, L/D 0.5, on {cores()} cores; error (median, 99 %) to eps 0.9")
    print("beside them the same number of extrapolated forces of the film on that grid, one by one")
    print(f"{'cells':>10s}{'nodes':>14s}{'CPU':>9s}{'wall':>9s}{'told':>9s}{'forces':>9s}   error")
    for resolution in (Resolution((192, 12), (12, 72, 48), 0.97), Resolution((96, 8), (8, 48, 32), 0.97)):
        told: list[str] = []
        begin, cpu = perf_counter(), process_time()
        table = GrooveMap(openings, 0.5, resolution).built(lambda _, text, told=told: told.append(text))
        wall, cpu = perf_counter() - begin, process_time() - cpu
        found = GroovedMapFilm(table=table).fitted(geometry).force(e, w, 0.5)
        error = np.linalg.norm(found - exact, axis=0) / np.linalg.norm(exact, axis=0)
        grid, begin = ReynoldsFilm(cells=resolution.cells, geometry=geometry), process_time()
        grid.extrapolated(e, w, 0.5)
        nodes = prod(resolution.nodes) // 4 + table.log_center.size
        forces = (process_time() - begin) / OPENED * nodes
        cells = "{} x {}".format(*resolution.cells)
        shape = "{} x {} x {}".format(*resolution.nodes)
        print(
            f"{cells:>10s}{shape:>14s}{cpu:7.2f} s{wall:7.2f} s{told[0].rpartition('about ')[2]:>9s}"
            f"{forces:7.2f} s   {np.median(error):.1e}, {np.quantile(error, 0.99):.1e}"
        )


def main() -> None:
    """Print the tables."""
    print_rivals()
    print()
    print_openings()
    print()
    print_accuracy()
    table = tabulate_film(
        ShortFilm(), slenderness_range=(0.1, 1.0), cells=(16, 48, 8), largest_eccentricity_ratio=0.999
    )
    dimensions = {"radius": RADIUS, "length": LENGTH, "clearance": CLEARANCE, "viscosity": VISCOSITY}
    mapped = JournalBearing(**dimensions, film=MapFilm(table))
    short = JournalBearing(**dimensions, film=ShortFilm())
    print_batch(mapped, short)
    print_scalar(mapped, short)


if __name__ == "__main__":
    main()
