"""The cases of the open benchmark by the models of rotorfilm."""

from __future__ import annotations

import csv
import json
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import diags, identity, kron
from scipy.sparse.linalg import splu

from rotorfilm import JournalBearing, Lobe, LobedBearing, TiltingPadBearing, coefficients, equilibrium
from rotorfilm.bearings import PadGridFilm
from rotorfilm.bearings.journal import HeatedFilm, MapFilm, ReynoldsFilm, ShortFilm, SplittingFilm
from rotorfilm.bearings.oil import Cooling, Oil
from rotorfilm.questions.quantities import QUANTITIES
from rotorfilm.scenes.film_heat import field_rest, uniform_rest

HERE = Path(__file__).parent
CASES: dict[str, dict[str, Any]] = json.loads((HERE / "cases.json").read_text(encoding="utf-8"))

ENTRIES = ("xx", "xy", "yx", "yy")
STIFFNESS, DAMPING = (tuple(f"{letter}{entry}" for entry in ENTRIES) for letter in "kc")
PLACE = ("x", "y")
ISOTHERMAL = (*PLACE, *STIFFNESS, *DAMPING, "power_loss")
HEATED = (*PLACE, "power_loss", "maximum_temperature")

Values = dict[str, float]
Model = Callable[[dict[str, Any]], Values]


def plain(case: dict[str, Any], film: Any) -> JournalBearing:
    """Return the journal bearing of a case over a film."""
    size = {name: case[name] for name in ("radius", "length", "clearance")}
    if "viscosity" in case:
        return JournalBearing(**size, viscosity=case["viscosity"], film=film)
    cooling = Cooling(supply_temperature=case["supply_temperature"])
    return JournalBearing(**size, oil=Oil.iso_vg(case["iso_vg"]), cooling=cooling, film=film)


def padded(case: dict[str, Any], film: PadGridFilm | None) -> LobedBearing | TiltingPadBearing:
    """Return the bearing of a case of fixed or tilting pads; without a film by its table."""
    size = {name: case[name] for name in ("radius", "length", "pad_clearance", "viscosity")}
    extent = math.radians(case["pad_extent_deg"])
    given = size if film is None else {**size, "film": film}
    if case["kind"] == "tilting pads":
        pivots = tuple(np.radians(case["pivots_deg"]).tolist())
        own = {"preload": case["preload"], "pivot_offset": case["offset"]}
        return TiltingPadBearing(**given, pivots=pivots, extent=extent, **own)
    own = {"preload": case["preload"], "offset": case["offset"], "extent": extent}
    starts = [math.radians(pivot) - case["offset"] * extent for pivot in case["pivots_deg"]]
    return LobedBearing(**given, lobes=tuple(Lobe(start=start, **own) for start in starts))


def isothermal(bearing: Any, case: dict[str, Any]) -> Values:
    """Return place, K, C and power loss at the equilibrium."""
    at = equilibrium(bearing, case["load"], case["speed"])
    film = coefficients(bearing, at.position, case["speed"])
    numbers = [*at.position, *np.ravel(film.stiffness), *np.ravel(film.damping)]
    losses = [] if at.losses is None else [at.losses.power_loss]
    return dict(zip(ISOTHERMAL, map(float, [*numbers, *losses]), strict=False))


def heated(rest: Any) -> Values:
    """Return place, power loss and temperature of an equilibrium with heat; fresh oil has no temperature."""
    values = [QUANTITIES[name].value(rest) for name in HEATED[2:]]
    return dict(zip(HEATED, map(float, [*rest.rest.position, *values]), strict=True))


def field(case: dict[str, Any], cells: tuple[int, int]) -> Values:
    """Return the values of the film whose temperature is a field (T2)."""
    return heated(
        field_rest(HeatedFilm(bearing=plain(case, MapFilm()), cells=cells), case["load"], case["speed"])
    )


def uniform(case: dict[str, Any]) -> Values:
    """Return the values of the film with one temperature (T1)."""
    return heated(uniform_rest(plain(case, MapFilm()), case["load"], case["speed"]))


def grid(cells: tuple[int, int]) -> Model:
    """Return the two-dimensional film of so many cells around and along the bearing or each pad."""

    def run(case: dict[str, Any]) -> Values:
        if case["kind"] == "heated journal":
            return field(case, cells)
        if case["kind"] == "plain journal":
            return isothermal(plain(case, ReynoldsFilm(cells=cells)), case)
        return isothermal(padded(case, PadGridFilm(cells=cells)), case)

    return run


def table(case: dict[str, Any]) -> Values:
    """Return the values by the map of a bore or the table of a pad."""
    return isothermal(plain(case, MapFilm()) if case["kind"] == "plain journal" else padded(case, None), case)


FINEST = {
    "short journal": None,
    "plain journal": ((192, 16), (384, 32), (768, 64)),
    "fixed pads": ((192, 16), (384, 32), (768, 64)),
    "tilting pads": ((48, 4), (96, 8), (192, 16)),
    "heated journal": ((80, 8), (160, 16), (320, 32)),
}
"""Three grids, each twice as fine, of the reference values by kind of case; None for a closed form."""


def models(kind: str) -> dict[str, Model]:
    """Return the models of rotorfilm for a kind of case, by name."""
    if kind == "short journal":
        return {"short film": lambda case: isothermal(plain(case, ShortFilm()), case)}
    if kind == "heated journal":
        return {"one temperature (T1)": uniform, "temperature field 40 x 4 (T2)": grid((40, 4)),
                "temperature field 80 x 8 (T2)": grid((80, 8))}  # fmt: skip
    cells = ((48, 4), (96, 8), (192, 16))
    found = {"map": table, **{f"grid {a} x {b}": grid((a, b)) for a, b in cells}}
    if kind == "plain journal":
        found["short film"] = lambda case: isothermal(plain(case, ShortFilm()), case)
        found["splitting film"] = lambda case: isothermal(plain(case, SplittingFilm()), case)
    return found


def reference(case: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """Return each quantity with its error, from three grids.

    The value is extrapolated from the two finer ones. The error is its larger distance from the finest grid
    and from what the two coarser grids give.
    """
    grids = FINEST[case["kind"]]
    if grids is None:
        exact = models(case["kind"])["short film"](case)
        return {name: (value, 1e-9 * abs(value)) for name, value in exact.items()}
    coarse, middle, fine = (grid(cells)(case) for cells in grids)
    found = {}
    for name, value in fine.items():
        best, before = (b + (b - a) / 3.0 for a, b in ((middle[name], value), (coarse[name], middle[name])))
        found[name] = (best, max(abs(best - before), abs(best - value)))
    return found


def seconds(call: Callable[[], object]) -> float:
    """Return the least time of the processor [s] of three or more calls in 0.2 s, after a first one."""
    call()
    taken: list[float] = []
    while len(taken) < 3 or sum(taken) < 0.2:
        begin = time.process_time()
        call()
        taken.append(time.process_time() - begin)
    return min(taken)


def unit_job() -> None:
    """Factorize Laplace's operator on 256 x 256 cells by SuperLU and solve once: the unit of cost."""
    count = 256
    line = diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(count, count))
    one = identity(count)
    splu((kron(line, one) + kron(one, line)).tocsc()).solve(np.ones(count * count))


def rows(code: str, version: str, kinds: tuple[str, ...] = ()) -> list[dict[str, Any]]:
    """Return the rows of results of rotorfilm: each case, model and quantity."""
    unit, found = seconds(unit_job), []
    for name, case in CASES.items():
        for model, run in models(case["kind"]).items() if not kinds or case["kind"] in kinds else ():
            cost = seconds(lambda run=run, case=case: run(case)) / unit
            told = {"code": code, "version": version, "model": model, "case": name, "cost": f"{cost:.3g}"}
            found += [{**told, "quantity": q, "value": f"{v:.10g}"} for q, v in run(case).items()]
    return found


def write_rows(path: Path, found: list[dict[str, Any]]) -> None:
    """Write rows of a table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table_of = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        table_of.writeheader()
        table_of.writerows(found)
