"""Films on ellipses: damping over frequency, cells and rectangle, the formula of slow damping, bearings.

    python benchmarks/races.py [frequency] [cells] [formula] [bearing]

`frequency`: damping over the frequency for ellipticities from 1 to 8. `cells`: the same over cells and
rectangle. `formula`: slow damping of the films of races by the closed formula beside that of solved films, on
points drawn at random. `bearing`: c/k of a ball and a bearing, and the law of ellipticity 4 beside that of
the race itself. Some ten minutes on one core.
"""

from __future__ import annotations

import math
import sys

import numpy as np

from rotorfilm import BallBearing, ContactGrid, PointContact
from rotorfilm.bearings import (
    EllipticContact,
    RaceFilm,
    RoelandsViscosity,
    StaggeredScheme,
    UpwindScheme,
    dynamic_stiffness,
    film_damping,
    race_films,
)

TIMES = (0.0, 1.0, 2.0, 6.0)
OIL = {"viscosity": 0.02, "pressure_coefficient": 2e-8}


def contact(V, Q0, ellipticity, cells, scheme=None, **change):
    rectangle = {"half_width": 1.5, **change}
    viscosity = rectangle.pop("viscosity", None)
    fluid = {} if viscosity is None else {"piezoviscosity": viscosity}
    return PointContact(
        V=V,
        Q0=Q0,
        ellipticity=ellipticity,
        grid=ContactGrid(cells=(cells, cells), **rectangle),
        scheme=UpwindScheme() if scheme is None else scheme,
        **fluid,
    )


def row(c):
    found = dynamic_stiffness(c, TIMES)
    damping = " ".join(f"{value:8.4f}" for value in found.damping)
    return f"{found.central_film:8.4f} {found.stiffness[0]:8.4f}  {damping}"


HEAD = f"{'H0':>8s} {'Z(0)/k_H':>8s}   c/(k_H t0) at omega t0 = " + " / ".join(f"{w:g}" for w in TIMES)


def print_frequency():
    print("damping over frequency, 56 x 56 cells, |y| <= 1.5 kappa, Barus")
    print(f"{'V':>5s} {'Q0':>3s} {'kappa':>5s} {HEAD}")
    for V, Q0 in ((0.1, 5.0), (0.05, 10.0), (0.02, 15.0), (0.05, 30.0)):
        for ellipticity in (1.0, 2.0, 4.0, 8.0):
            print(f"{V:5g} {Q0:3g} {ellipticity:5g} {row(contact(V, Q0, ellipticity, 56))}", flush=True)


def print_cells():
    print("\nellipticity 4, V = 0.1, Q0 = 5, Barus, over cells, scheme and rectangle")
    print(f"{'cells':>5s} {HEAD}")
    for scheme in (UpwindScheme(), StaggeredScheme()):
        for cells in (32, 40, 64, 80):
            print(
                f"{cells:5d} {row(contact(0.1, 5.0, 4.0, cells, scheme))}  {type(scheme).__name__}",
                flush=True,
            )
    print(f"{80:5d} {row(contact(0.1, 5.0, 4.0, 80, inlet=-4.5, half_width=2.5))}  x > -4.5, |y| < 2.5 kappa")


def race(V, Q0):
    touch = EllipticContact(rolling_radius=3.2e-3, groove_radius=60e-3, combined_modulus=2.27e11)
    bare = RaceFilm(touch=touch, load=touch.load_at(Q0 / 2e-8), rolling_speed=1.0, **OIL)
    return RaceFilm(touch=touch, load=bare.load, rolling_speed=V / bare.V, **OIL)


def print_formula():
    print(
        "\nslow damping c0/(k_H t0): closed formula and solved films, Roelands, ellipticity 4, 60 x 60 cells;"
    )
    print("beside it the formula .045 (V/.1)^.56 (Q0/5)^.35")
    rng = np.random.default_rng(1)
    worst = [0.0, 0.0]
    for _ in range(14):
        V, Q0 = float(np.exp(rng.uniform(*np.log((0.006, 4.0))))), float(rng.uniform(7.0, 38.0))
        law = RoelandsViscosity(exponent=float(rng.uniform(0.55, 0.75)), pressure_ratio=Q0 / 3.92)
        exact = dynamic_stiffness(contact(V, Q0, 4.0, 60, viscosity=law), [0.0]).damping[0]
        film = race(V, Q0)
        formula = film.slow_damping / (film.stiffness * film.time_scale)
        other = 0.045 * (V / 0.1) ** 0.56 * (Q0 / 5.0) ** 0.35
        worst = [max(a, abs(b / exact - 1.0)) for a, b in zip(worst, (formula, other), strict=True)]
        print(
            f"V {V:7.4f}  Q0 {Q0:5.1f}  film {exact:.4f}  formula {formula / exact - 1.0:+.1%}"
            f"  other {other / exact - 1.0:+.1%}",
            flush=True,
        )
    print(f"largest: {worst[0]:.1%}, other {worst[1]:.1%}")


def print_bearing():
    print("\nc/k of a ball [us], deep groove 8 balls of 7.938 mm, pitch 33.5 mm, 20 mPa s, alpha 20/GPa")
    print(
        "formula at both races; laws of ellipticity 4 and of the races themselves, 48 x 48 cells, inner race"
    )
    bearing = BallBearing(balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6)
    for load, rpm in ((300.0, 10000.0), (300.0, 1500.0), (50.0, 10000.0)):
        films = race_films(bearing, load=load, speed=rpm * math.pi / 30.0, **OIL)
        soft = [1.0 / film.stiffness for film in films]
        ball = sum(film.slow_damping * c**2 for film, c in zip(films, soft, strict=True)) / sum(soft)
        inner = films[0]
        laws = [inner.law(), inner.law(ellipticity=inner.touch.ellipticity)]
        times = " ".join(f"{law.damping / law.stiffness * 1e6:6.3f}" for law in laws)
        print(f"{load:4g} N {rpm:6g} rpm: ball {ball * 1e6:.3f}, inner race {times}", flush=True)
    rest = bearing.rest((0.0, -500.0, 0.0, 0.0, 0.0), 1000.0)
    found = film_damping(bearing, rest, **OIL)
    print(f"bearing under 500 N, 1000 rad/s: c/k along the load {found.damping_time[1] * 1e6:.3f} us")


if __name__ == "__main__":
    parts = {
        "frequency": print_frequency,
        "cells": print_cells,
        "formula": print_formula,
        "bearing": print_bearing,
    }
    for name in sys.argv[1:] or parts:
        parts[name]()
