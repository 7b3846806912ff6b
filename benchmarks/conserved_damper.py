"""Dampers that conserve their oil: the table and picture of docs/damper_supply.md, and errors of grids.

    python benchmarks/conserved_damper.py [PICTURE.png]

With a picture, it draws this alone.
"""

import sys
import warnings

import numpy as np

from rotorfilm import DamperSupply, FiniteSqueeze, FullFilm, JFODamper, PorousDamper, RotorfilmError
from rotorfilm.bearings import damper_turn
from rotorfilm.bearings.damper import ExtrapolatedDamper
from rotorfilm.bearings.damper.questions import damper_ladder
from rotorfilm.scenes import read_scene

R, c, mu, OMEGA = 0.05, 1e-4, 0.01, 300.0
UNIT = 12.0 * mu * (R / c) ** 2 * OMEGA
SIZES = {"radius": R, "length": 0.05, "clearance": c, "viscosity": mu}
GROOVED = DamperSupply(supply_pressure=0.0067 * UNIT, circumferential_groove=0.0)
IN_OIL = DamperSupply(
    supply_pressure=0.0067 * UNIT,
    circumferential_groove=0.0,
    cavitation_pressure=-0.0033 * UNIT,
    submerged=True,
)
BATH = DamperSupply(cavitation_pressure=-0.0033 * UNIT, submerged=True)
CASES = {
    "groove, cavity at ambient, .4": (GROOVED, 0.4),
    "groove, .4": (IN_OIL, 0.4),
    "ends in oil, .4": (BATH, 0.4),
    "ends in oil, .8": (BATH, 0.8),
}


def table() -> None:
    """Print the forces of all three films."""
    for name, (supply, eps) in CASES.items():
        damper = JFODamper(**SIZES, supply=supply, cells=(144, 12))
        unit, motion = damper.scaled.force * OMEGA, ([eps * c, 0.0], [0.0, eps * c * OMEGA])
        orbit = damper.orbit(eps, OMEGA)
        conserved = np.array([orbit.radial_force, orbit.tangential_force]) / unit
        reynolds = damper.reynolds_force(*motion) / unit
        lands = (0.025, 2.0) if supply.grooved else (0.05, 1.0)
        full = PorousDamper(**{**SIZES, "length": lands[0]}, extent=FullFilm(), film=FiniteSqueeze())
        whole = lands[1] * full.force(*motion, 0.0)[1] / unit
        print(f"{name:30}: conserved {conserved.round(4)}, Reynolds {reynolds.round(4)}, full {whole:.4f}")


def orbit(path: str | None = None) -> None:
    """Draw the cavity of an eccentric orbit over a turn, and print what its mass is worth."""
    damper, angle = JFODamper(**SIZES, supply=IN_OIL), 2.0 * np.pi * np.arange(1, 193) / 192
    q = c * np.array([0.25 + 0.55 * np.cos(angle), 0.55 * np.sin(angle)])
    v = 0.55 * c * OMEGA * np.array([-np.sin(angle), np.cos(angle)])
    turn = damper_turn(damper, q, OMEGA)
    reynolds = np.array([damper.reynolds_force(at, rate) for at, rate in zip(q.T, v.T, strict=True)]).T
    apart = np.hypot(*(turn.force - reynolds)).max() / np.hypot(*reynolds).max()
    work = -np.sum(reynolds * v) * turn.time[0]
    print(f"eccentric orbit: {apart:.3f} of the peak, work {turn.work / work - 1.0:+.4f}, {turn.turns} turns")
    if path is not None:
        turn.plot().figure.savefig(path, dpi=90)


def grids(count: int = 60) -> None:
    """Print errors of the force on 36 x 8 and 72 x 16 cells, and extrapolated, over random dampers."""
    random, errors = np.random.default_rng(5), []
    for _ in range(count):
        land, eps = 10.0 ** random.uniform(-1.3, 0.2), random.uniform(0.05, 0.93)
        largest = min(land**2, 0.3) * eps
        fed, ambient = largest * 10.0 ** random.uniform(-1.5, 0.5, 2) * UNIT
        oil = {"cavitation_pressure": -ambient, "submerged": True}
        groove = {"supply_pressure": fed, "circumferential_groove": 0.0}
        supply = DamperSupply(**[groove, groove | oil, oil][random.integers(3)])
        dampers = [
            JFODamper(**{**SIZES, "length": 2.0 * land * R}, supply=supply, cells=cells)
            for cells in ((36, 8), (72, 16), (144, 32))
        ]
        one, other = (ExtrapolatedDamper(damper=damper) for damper in dampers[1:])
        forces = [
            one.force([eps * c, 0.0], [0.0, eps * c * OMEGA], 0.0) for one in (*dampers[:2], one, other)
        ]
        errors.append([np.hypot(*(force - forces[-1])) / np.hypot(*forces[-1]) for force in forces[:-1]])
    for name, share in (("median", 0.5), ("90 %", 0.9), ("99 %", 0.99), ("largest", 1.0)):
        print(f"{name:8}: 36 x 8, 72 x 16, both extrapolated: {np.quantile(errors, share, axis=0).round(5)}")


def estimates(count: int = 30) -> None:
    """Print how often the estimate of a short film in a fed damper is within a factor 2 of its error."""
    random, good, seen = np.random.default_rng(11), 0, 0
    for _ in range(count):
        radius, speed = 10.0 ** random.uniform(-1.7, -1.0), 10.0 ** random.uniform(2.0, 2.9)
        clearance, mass = radius * 10.0 ** random.uniform(-3.0, -2.6), 10.0 ** random.uniform(0.7, 1.7)
        supply = {"supply_pressure": 10.0 ** random.uniform(4.0, 5.5), "circumferential_groove": 0.0}
        damper = {
            "radius": radius,
            "length": 2.0 * radius * random.uniform(0.2, 0.8),
            "clearance": clearance,
            "viscosity": 10.0 ** random.uniform(-2.5, -1.3),
            "stiffness": mass * (speed / random.uniform(0.5, 3.0)) ** 2,
            "supply": supply
            | {"cavitation_pressure": -(10.0 ** random.uniform(3.0, 5.0)), "submerged": True},
        }
        rotor = {"mass": mass, "unbalance": random.uniform(0.05, 0.6) * mass * clearance}
        quantity = str(random.choice(["transmissibility", "unbalance_amplitude"]))
        scene = read_scene(
            {
                "schema": 1,
                "damper": damper,
                "operation": {"speed": speed},
                "rigid_rotor": rotor,
                "question": {"quantity": quantity, "tolerance": 1e-4},
            },
            "drawn",
        )
        ladder = damper_ladder(scene, quantity)
        try:
            first, top = (rung.answer(None) for rung in (ladder.rungs[0], ladder.rungs[-1]))
        except RotorfilmError as error:
            print(f"no answer: {error}"[:110])
            continue
        judged, error = ladder.rungs[0].estimate(first, None, 1e-4), abs(first.value / top.value - 1.0)
        seen, within = seen + 1, 0.5 < (judged.error / error) < 2.0
        good += within
        print(f"{quantity:20} off by {error:.2e}, estimate {judged.error:.2e} {judged.doubt[:40]}")
    print(f"{good} of {seen} estimates within a factor 2")


if __name__ == "__main__":
    if sys.argv[1:]:
        orbit(sys.argv[1])
        sys.exit()
    table()
    orbit()
    grids()
    warnings.simplefilter("ignore")
    estimates()
