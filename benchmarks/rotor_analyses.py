"""Every analysis of a flexible rotor: counters of its work, CPU time, and ROSS beside it if there.

    python benchmarks/rotor_analyses.py [ELEMENTS]

The rotor of Friswell et al. (2010), section 5.9, in 24 elements without inner shapes, as ROSS has them, on
springs of 1 MN/m and 50 N s/m, or on the films of example 5.9.6; made anew for each analysis. `apart`: the
largest part by which the answers of both differ. ROSS has six degrees of freedom a node; its critical speeds
are asked for to 1e-8, since its own tolerance of 5e-3 leaves 1e-5. A dash: no such analysis. Transmissibility
is taken from its response of all coordinates; runs in time on films are in `rotor_transient.py`.
"""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import rotor_size
from rotor_size import FILMS, SPRINGS, THRESHOLD, timed

from rotorfilm.analysis import (
    base_response,
    campbell,
    critical_speeds,
    rotor_equilibrium,
    rotor_modes,
    rotor_threshold,
    rotor_transmissibility,
    simulate,
    stability_changes,
    unbalance_response,
)
from rotorfilm.rotors import ClassicalBeam, ShaftRotor

SPEED, TOP = 300.0, 700.0
CHART, RESPONSE, SEARCH = (
    np.linspace(50.0, 400.0, 50),
    np.linspace(50.0, 400.0, 200),
    np.linspace(20.0, TOP, 15),
)


class Row(NamedTuple):
    """An analysis: its own call and what of the result is compared; the same of ROSS, or None."""

    name: str
    own: Callable[[ShaftRotor], Any]
    seen: Callable[[Any], Any]
    peer: Callable[[Any], Any] | None = None
    peer_seen: Callable[[Any], Any] | None = None


def main() -> None:
    """Print the table."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 24
    warm = shaft(count)
    # Imports.
    rotor_modes(warm, SPRINGS, SPEED), unbalance_response(warm, SPRINGS, [SPEED])
    simulate(replace(warm, speed=SPEED), SPRINGS, duration=0.01)
    beside(count)
    print(f"{count} elements{'':16}{'CPU [ms]':>10}{'ROSS [ms]':>11}{'ratio':>8}{'apart':>10}  work")
    for row in rows(count):
        taken, found = timed(partial(row.own, shaft(count)))
        line, value = f"{row.name:26}{1e3 * taken:10.1f}", row.seen(found)
        ross_rotor = beside(count) if row.peer else None  # it remembers what it was asked
        if row.peer is None or ross_rotor is None or row.peer_seen is None:
            line += f"{'-':>11}{'-':>8}{'-':>10}"
        else:
            peer, other = timed(partial(row.peer, ross_rotor))
            line += f"{1e3 * peer:11.1f}{peer / taken:8.1f}{apart(value, row.peer_seen(other)):10.1e}"
        work = {name: number for name, number in getattr(found, "work", {}).items() if number}
        print(line + "  " + ", ".join(f"{number} {name}" for name, number in work.items()), flush=True)


def shaft(count: int) -> ShaftRotor:
    """Return the rotor in so many elements, of the beam that ROSS has."""
    return replace(rotor_size.shaft(count), beam=ClassicalBeam())


def rows(count: int) -> list[Row]:
    """Return the analyses."""
    rests: dict[str, Any] = {}
    return [
        rest_row(rests),
        *eigenvalue_rows(),
        *response_rows(count // 3, rests),
        time_row(count // 3),
        Row("threshold on films", lambda r: rotor_threshold(r, FILMS, THRESHOLD), lambda found: found),
        Row("stability changes", lambda r: stability_changes(r, FILMS, THRESHOLD), lambda found: found),
    ]


def rest_row(rests: dict[str, Any]) -> Row:
    """Return the equilibrium, which is kept among some rests."""

    def rested(rotor: ShaftRotor) -> Any:
        rests["at"] = rotor_equilibrium(rotor, SPRINGS, SPEED)
        return rests["at"]

    return Row(
        "equilibrium",
        rested,
        lambda at: np.abs([at.loads[name][1] for name in ("left", "right")]),
        lambda ross: ross.run_static(),
        lambda found: np.array([float(v) for v in found.bearing_forces.values()]),
    )


def eigenvalue_rows() -> list[Row]:
    """Return modes and critical speeds."""
    return [
        Row(
            "modes at a speed",
            lambda r: rotor_modes(r, SPRINGS, SPEED, 1000.0),
            lambda modes: modes.frequency[:5],
            lambda ross: ross.run_modal(speed=SPEED, num_modes=24),
            lambda modal: modal.wd,
        ),
        Row(
            "Campbell, 50 speeds",
            lambda r: campbell(r, SPRINGS, CHART, 1000.0),
            lambda chart: chart.frequency[:4, -1],
            lambda ross: ross.run_campbell(CHART, frequencies=8),
            lambda chart: chart.wd[-1],
        ),
        Row(
            "critical speeds, damped",
            lambda r: critical_speeds(r, SPRINGS, SEARCH),
            lambda found: np.array([one.speed for one in found]),
            lambda ross: ross.run_critical_speed(num_modes=16, rtol=1e-8),
            lambda found: found._wd,
        ),
        Row("critical speeds on films", lambda r: critical_speeds(r, FILMS, SEARCH), lambda found: found),
    ]


def response_rows(loaded: int, rests: dict[str, Any]) -> list[Row]:
    """Return the responses to an unbalance at a node, to forces, and of the rest kept to the ground."""
    return [
        Row(
            "unbalance, 200 speeds",
            lambda r: unbalance_response(r, SPRINGS, RESPONSE),
            lambda found: np.abs(found.complex[found.output_labels.index("left_x"), 0]),
            lambda ross: ross.run_unbalance_response([loaded], [1e-3], [0.0], RESPONSE),
            lambda found: np.abs(found.forced_resp[0]),
        ),
        Row(
            "transmissibility, 200",
            lambda r: rotor_transmissibility(r, SPRINGS, RESPONSE),
            lambda found: np.abs(found.complex[0, 0]),
            lambda ross: ross.run_freq_response(RESPONSE),
            lambda found: np.abs((1e6 + 50j * RESPONSE) * found.freq_resp[0, 0]),
        ),
        Row(
            "shaken ground, 200",
            lambda r: base_response(r, rests["at"], RESPONSE),
            lambda found: found,
        ),
    ]


def time_row(loaded: int) -> Row:
    """Return 1 s of motion in time from the center of the springs under an unbalance, by steps of 0.1 ms."""
    times = 1e-4 * np.arange(10001)

    def pushed(ross: Any) -> Any:
        force = np.zeros((len(times), ross.ndof))
        force[:, 6 * loaded] = 1e-3 * SPEED**2 * np.cos(SPEED * times)
        force[:, 6 * loaded + 1] = 1e-3 * SPEED**2 * np.sin(SPEED * times)
        return ross.run_time_response(SPEED, force, times)

    return Row(
        "1 s by 0.1 ms, linear",
        lambda r: simulate(replace(r, speed=SPEED, gravity=(0.0, 0.0)), SPRINGS, duration=1.0, times=times),
        lambda run: np.array([run["left_x"].std(), run["right_y"].std()]),
        pushed,
        lambda found: found.yout[:, [0, -5]].std(axis=0),
    )


def apart(own: Any, other: Any) -> float:
    """Return the largest relative difference of values from the nearest, or from those at the same place."""
    own, other = np.atleast_1d(own), np.atleast_1d(other)
    if own.shape == other.shape:
        return float(np.abs(own / other - 1.0).max())
    return max(float(np.abs(other / one - 1.0).min()) for one in own)


def beside(count: int) -> Any:
    """Return the rotor of ROSS, None without it."""
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            import ross
    except ImportError:
        return None
    steel = ross.Material(name="steel", rho=7810.0, E=211e9, G_s=81.2e9)
    pieces = [ross.ShaftElement(L=1.5 / count, idl=0.0, odl=0.05, material=steel) for _ in range(count)]
    disks = [
        ross.DiskElement.from_geometry(n=node, material=steel, width=0.07, i_d=0.05, o_d=outer)
        for node, outer in ((count // 3, 0.28), (2 * count // 3, 0.35))
    ]
    springs = [ross.BearingElement(n=node, kxx=1e6, cxx=50.0) for node in (0, count)]
    rotor = ross.Rotor(pieces, disks, springs)
    rotor.run_modal(speed=10.0)
    return rotor


if __name__ == "__main__":
    main()
