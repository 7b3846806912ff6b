"""Inertia of squeeze films against exact Navier-Stokes equations; of ruptured ones against a cut-off.

In a short film the axial velocity is z F(y, t), so that each place of the circumference is one equation,

    F_t + v F_y + F^2 = G + nu F_yy,   F + v_y = 0,   F = 0 at both walls,   integral of F dy = -h_t,

with density z G = -dp/dz, here on Chebyshev nodes through a turn of the orbit. The package has none of it.

    python benchmarks/squeeze_inertia.py
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from rotorfilm import (
    EndSeal,
    FiniteSqueeze,
    FullFilm,
    RigidRotor,
    ShortSqueeze,
    SqueezeFilmDamper,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.bearings import HalfSommerfeld, layer_modes
from rotorfilm.bearings.damper.squeeze_films import short_squeeze_film
from rotorfilm.bearings.damper.squeeze_laws import FilmInertia


def chebyshev(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return nodes from 0 to 1, the matrix of derivatives and that of integrals from 0."""
    x = 0.5 * (1.0 - np.cos(np.pi * np.arange(count) / (count - 1)))
    weight = np.where(np.arange(count) % 2, -1.0, 1.0)
    weight[[0, -1]] *= 0.5
    gap = x[:, None] - x + np.eye(count)
    D = weight / weight[:, None] / gap
    D -= np.diag(D.sum(axis=1))
    from_zero = D.copy()
    from_zero[0] = np.eye(count)[0]
    integral = np.linalg.inv(from_zero)
    integral[:, 0] = 0.0
    return x, D, integral


def exact_gradient(
    eps: float, reynolds: float, nodes: int = 33, steps: int = 1200, turns: int = 3
) -> np.ndarray:
    """Return G over the last turn of h = 1 + eps cos(t), per speed squared, shape (steps,)."""
    x, D, integral = chebyshev(nodes)
    dt = 2.0 * np.pi / steps
    mean = integral[-1]
    F = old = np.zeros(nodes)
    before = np.zeros(nodes)
    found = []
    for step in range(1, turns * steps + 1):
        t = step * dt
        h, h_t = 1.0 + eps * np.cos(t), -eps * np.sin(t)
        carried = _carried(F, t - dt, eps, x, D, integral)
        ahead = 2.0 * carried - before if step > 1 else carried
        A = np.zeros((nodes + 1, nodes + 1))
        A[:nodes, :nodes] = 1.5 / dt * np.eye(nodes) - D @ D / (reynolds * h * h)
        A[:nodes, nodes] = -1.0
        b = np.append((2.0 * F - 0.5 * old) / dt - ahead, -h_t / h)
        for wall in (0, nodes - 1):
            A[wall], b[wall] = np.eye(nodes + 1)[wall], 0.0
        A[nodes, :nodes] = mean
        solved = np.linalg.solve(A, b)
        F, old, before = solved[:nodes], F, carried
        found.append(solved[nodes])
    return np.array(found[-steps:])


def _carried(
    F: np.ndarray, t: float, eps: float, x: np.ndarray, D: np.ndarray, integral: np.ndarray
) -> np.ndarray:
    stretch = -eps * np.sin(t) / (1.0 + eps * np.cos(t))
    return -(x * stretch + integral @ F) * (D @ F) + F * F


def exact_orbit(eps: float, reynolds: float, **grid: int) -> np.ndarray:
    """Return the exact radial and tangential force on an orbit, in density radius length^3 speed^2."""
    G = exact_gradient(eps, reynolds, **grid)
    t = 2.0 * np.pi * np.arange(1, G.size + 1) / G.size
    return 2.0 * np.pi / G.size / 12.0 * np.array([G @ np.cos(t), -(G @ np.sin(t))])


def film_orbit(eps: float, reynolds: float, *, ruptured: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return the forces of the package's film on that orbit, with inertia and without."""
    viscous = short_squeeze_film(layer_modes(None), cavitated=ruptured)
    inertia = FilmInertia(zone=1.0) if ruptured else FilmInertia(closed=1.0)
    e, w = np.array([eps, 0.0]), np.array([0.0, eps])
    bare = viscous.force(e, w) / reynolds
    return bare + inertia.mass(e, w) @ e + inertia.force(e, w), bare


def cut_off(eps: float, reynolds: float, nodes: int = 20000) -> np.ndarray:
    """Return the force where the pressures of viscosity and inertia together are cut off at zero."""
    theta = 2.0 * np.pi * (np.arange(nodes) + 0.5) / nodes
    h, h_t, h_tt = 1.0 + eps * np.cos(theta), eps * np.sin(theta), -eps * np.cos(theta)
    G = -12.0 / reynolds * h_t / h**3 - 1.2 * h_tt / h + 102.0 / 35.0 * (h_t / h) ** 2
    G = np.maximum(G, 0.0)
    return 2.0 * np.pi / nodes / 12.0 * np.array([G @ np.cos(theta), G @ np.sin(theta)])


def off(found: np.ndarray, right: np.ndarray) -> float:
    """Return the relative difference of two forces."""
    return float(np.linalg.norm(found - right) / np.linalg.norm(right))


def random_case(rng: np.random.Generator) -> tuple[SqueezeFilmDamper, RigidRotor, float]:
    """Return damper, rotor and stiffness of springs [N/m]; the ranges were fixed before the first run."""
    radius, clearance_ratio = rng.uniform(0.01, 0.08), rng.uniform(1e-3, 4e-3)
    kind = rng.choice(["short", "ruptured", "finite", "sealed"])
    slimness = rng.uniform(0.1, 0.25) if kind in ("short", "ruptured") else rng.uniform(0.1, 1.0)
    reynolds, speed, density = (
        rng.uniform(0.1, 5.0 if kind == "ruptured" else 10.0),
        rng.uniform(200.0, 2000.0),
        850.0,
    )
    clearance, length = clearance_ratio * radius, 2.0 * radius * slimness
    viscosity = density * speed * clearance**2 / reynolds
    leak = 10.0 ** rng.uniform(-2.0, 1.0) * clearance**3 / (12.0 * viscosity * radius)
    damper = SqueezeFilmDamper(
        radius=radius,
        length=length,
        clearance=clearance,
        viscosity=viscosity,
        density=density,
        extent=HalfSommerfeld() if kind == "ruptured" else FullFilm(),
        film=FiniteSqueeze() if kind in ("finite", "sealed") else ShortSqueeze(),
        seals=EndSeal(leakage=leak) if kind == "sealed" else None,
    )
    added = float(damper.mass([0.0, 0.0], [1.0, 0.0])[0, 0])
    mass = added * 10.0 ** rng.uniform(-1.0, 1.5)
    stiffness = mass * (speed * rng.uniform(0.3, 1.5)) ** 2
    unbalance = rng.uniform(0.05, 0.4) * mass * clearance
    return damper, RigidRotor(mass=mass, speed=speed, unbalance=unbalance, gravity=(0.0, 0.0)), stiffness


def battery(count: int = 30, seed: int = 7) -> None:
    """Print how far explicit orbits of random rotors are from motions that the script integrates itself."""
    rng, errors, none = np.random.default_rng(seed), [], 0
    for _ in range(count):
        damper, rotor, stiffness = random_case(rng)
        found = synchronous_orbits(rotor, with_springs(damper, stiffness)).at(rotor.unbalance)
        stable = [orbit for orbit in found if orbit.stable]
        if not stable:
            none += 1
            continue
        orbit, speed = stable[0], rotor.profile.speeds[0]
        e = orbit.eccentricity_ratio * damper.clearance * np.exp(1j * orbit.phase)
        start = [e.real, e.imag, -speed * e.imag, speed * e.real]

        def rate(t: float, z: np.ndarray, damper=damper, rotor=rotor, stiffness=stiffness) -> np.ndarray:
            force = damper.force(z[:2], z[2:]) - stiffness * z[:2] + rotor.unbalance_force(t)
            whole = rotor.mass * np.eye(2) + damper.mass(z[:2], z[2:])
            return np.concatenate([z[2:], np.linalg.solve(whole, force)])

        end = 4.0 * np.pi / speed
        run = solve_ivp(rate, (0.0, end), start, method="LSODA", rtol=1e-8, atol=1e-10 * damper.clearance)
        errors.append(float(np.abs(np.hypot(*run.y[:2]) / abs(e) - 1.0).max()))
    print(
        f"{len(errors)} orbits of {count} rotors: radius off by {max(errors):.1e} at most over two turns",
        end="",
    )
    print(f"; {none} without a stable orbit within the film")


def main() -> None:
    """Print both tables, and the battery."""
    battery()
    print("full film: first order / without inertia, error of the force on an orbit")
    for eps in (0.1, 0.5, 0.8):
        cells = []
        for reynolds in (1.0, 5.0, 10.0, 20.0):
            right = exact_orbit(eps, reynolds)
            cells.append(" / ".join(f"{off(one, right):7.2%}" for one in film_orbit(eps, reynolds)))
        print(f"eps {eps}: Re 1, 5, 10, 20: " + "   ".join(cells))
    print("ruptured film: zone rule / without inertia, against the cut-off of both pressures together")
    for eps in (0.2, 0.5):
        cells = []
        for reynolds in (0.5, 2.0, 5.0, 10.0):
            right = cut_off(eps, reynolds)
            both = film_orbit(eps, reynolds, ruptured=True)
            cells.append(" / ".join(f"{off(one, right):7.2%}" for one in both))
        print(f"eps {eps}: Re .5, 2, 5, 10: " + "   ".join(cells))


if __name__ == "__main__":
    main()
