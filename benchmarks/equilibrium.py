"""Cost of a static equilibrium with its eight coefficients, in one run; one validated force = 1.

"Compiled" is a film of the C library; "Python" is the same bearing stripped to force and jacobian; "together"
has all loads searched in one call.

    python benchmarks/equilibrium.py
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from rotorfilm.analysis import coefficients, equilibria, equilibrium
from rotorfilm.analysis.coefficients import coefficients_at
from rotorfilm.bearings.journal import JournalBearing, MapFilm, ShortFilm
from rotorfilm.studies import shortest_time

DIMENSIONS = {"radius": 0.05, "length": 0.05, "clearance": 1e-4, "viscosity": 0.1}
LOADS = np.geomspace(100.0, 1e5, 12)
SPEED = 157.0


@dataclass(frozen=True)
class Plain:
    """A bearing that shows force and jacobian only."""

    bearing: JournalBearing
    clearance: float = DIMENSIONS["clearance"]

    def force(self, position, velocity, speed):
        """Return the force of the bearing."""
        return self.bearing.force(position, velocity, speed)

    def jacobian(self, position, velocity, speed):
        """Return the Jacobian of the bearing."""
        return self.bearing.jacobian(position, velocity, speed)


def solve(reaction) -> list:
    """Return the equilibria for all loads, each with its coefficients computed."""
    points = [equilibrium(reaction, [0.0, -load], SPEED) for load in LOADS]
    for point in points:
        coefficients(reaction, point.position, SPEED)
    return points


def solve_together(reaction) -> list:
    """Return the same from one call."""
    loads = np.stack([np.zeros(len(LOADS)), -LOADS])
    points = equilibria(reaction, loads, np.full(len(LOADS), SPEED))
    coefficients_at(reaction, points)
    return list(points)


def main() -> None:
    """Print the table."""
    sys.stdout.write("| bearing | equilibrium and coefficients [us] | forces | Newton steps | residual |\n")
    sys.stdout.write("|---|---|---|---|---|\n")
    for name, film in (("map", MapFilm()), ("short film", ShortFilm())):
        bearing = JournalBearing(**DIMENSIONS, film=film)
        one = shortest_time(lambda b=bearing: b.force([1e-5, -2e-5], [0.0, 0.0], SPEED), loops=200)
        plain = Plain(bearing)
        ways = ("compiled", bearing, solve), ("Python", plain, solve), ("together", bearing, solve_together)
        for kind, reaction, way in ways:
            points = way(reaction)
            each = shortest_time(lambda r=reaction, w=way: w(r)) / len(LOADS)
            steps = np.mean([point.iterations for point in points])
            worst = max(point.residual for point in points)
            row = f"| {name}, {kind} | {1e6 * each:.0f} | {each / one:.1f} | {steps:.1f} | {worst:.0e} |"
            sys.stdout.write(row + "\n")


if __name__ == "__main__":
    main()
