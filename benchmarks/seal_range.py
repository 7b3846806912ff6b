"""How far the short seal holds: against the perturbed bulk flow of finite length, solved in full.

python benchmarks/seal_range.py
"""

import warnings

import numpy as np
from scipy.integrate import solve_ivp

import rotorfilm as rf

SPEED = 300.0


class BulkFlow:
    """Hirs's equations about the steady flow in complex form: displacement 1 exp(i whirl t), all along +x."""

    def __init__(self, seal, speed, *, short=False):
        self.seal, self.surface, self.short = seal, seal.radius * speed, short
        self.V = seal.flow(speed).axial_velocity

    def friction(self, u):
        """Return f W of stator and rotor, and W^2 of both."""
        law, s = self.seal.friction, self.seal
        squares = np.array([self.V**2 + u**2, self.V**2 + (u - self.surface) ** 2])
        reynolds = 2.0 * np.sqrt(squares) * s.clearance * s.density / s.viscosity
        return law.coefficient * reynolds**law.exponent * np.sqrt(squares), squares

    def slowed(self, u):
        """Return du/dz of the steady flow round the shaft."""
        drag, _ = self.friction(u)
        return -0.5 * (drag[0] * u + drag[1] * (u - self.surface)) / (self.V * self.seal.clearance)

    def rates(self, y, whirl):
        """Return d/dz of u0 and of (w, u, p) moved by the gap, and by the flow at the inlet."""
        s, V, m = self.seal, self.V, self.seal.friction.exponent
        u0, c, R = y[0].real, s.clearance, s.radius
        drag, squares = self.friction(0.5 * self.surface if self.short else u0)
        about = np.array([u0, u0 - self.surface])
        near = about if not self.short else 0.5 * self.surface * np.array([1.0, -1.0])
        mean, grown = 0.5 * drag.sum(), 0.5 * (1.0 + m) * drag / squares
        change = 1j * (whirl - u0 / R)
        out = [self.slowed(u0)]
        for (w, u, p), h in ((y[1:4], -1.0), (y[4:7], 0.0)):
            u = 0.0 * u if self.short else u
            by_w = (1j / R) * u - change * h / c
            axial = V * (grown.sum() * V * w + grown @ near * u + m * mean * h / c) + mean * w
            axial += c * (change * w + V * by_w) - mean * V * h / c
            held = 0.5 * drag @ about
            across = grown @ about * V * w + mean * u + grown @ about**2 * u + m * held * h / c
            across += c * (change * u + w * out[0]) + h * V * out[0]
            by_u = ((1j / R) * c / s.density * p - across) / (c * V)
            out += [by_w, by_u, -s.density / c * axial]
        return np.array([*out, y[3], y[6]])

    def impedance(self, whirl):
        """Return -(force_x + i force_y) per displacement."""
        s = self.seal
        entry = -s.density * (1.0 + s.inlet_loss) * self.V
        start = np.array([self.surface * s.inlet_swirl, 0, 0, 0, 1, 0, entry, 0, 0], dtype=complex)
        scale = np.array([1.0, 1e3, 1e3, 1e9, 1.0, 1.0, 1e3, 1e6, 1.0])
        run = solve_ivp(
            lambda z, y: self.rates(y, whirl),
            (0.0, s.length),
            start,
            method="DOP853",
            rtol=1e-10,
            atol=1e-12 * scale,
        )
        end = run.y[:, -1]
        return np.pi * s.radius * (end[7] - end[3] / end[6] * end[8])


def fitted(flow, speed):
    """Return K, k, C, c, M of the impedance between no whirl and synchronous whirl."""
    whirl = np.linspace(0.0, speed, 4)
    found = np.array([flow.impedance(w) for w in whirl])
    real, imaginary = np.polyfit(whirl, found.real, 2), np.polyfit(whirl, found.imag, 1)
    return np.array([real[2], -imaginary[1], imaginary[0], real[1], -real[0]])


def main():
    """Print the errors of K, k, C, c, M, and that of k in C speed/2."""
    warnings.simplefilter("ignore", rf.ValidityWarning)
    print("Water, radius 50 mm, clearance .2 mm, 1 MPa, inlet loss .2, 300 rad/s: error [%]")
    print("L/D   swirl      K      k      C      c      M   k in C speed/2")
    for slenderness in (0.05, 0.1, 0.2, 0.25, 0.5):
        for swirl in (0.5, 0.3, 0.0):
            size = {"radius": 0.05, "length": 0.1 * slenderness, "clearance": 2e-4, "pressure_drop": 1e6}
            water = {"viscosity": 1e-3, "density": 1000.0, "inlet_loss": 0.2, "inlet_swirl": swirl}
            seal = rf.AnnularSeal(**size, **water)
            reference, found = fitted(BulkFlow(seal, SPEED), SPEED), np.array(seal.matrices(SPEED))
            share = 100.0 * (found[1] - reference[1]) / (0.5 * SPEED * reference[2])
            row = " ".join(f"{error:6.1f}" for error in 100.0 * (found / reference - 1.0))
            print(f"{slenderness:<5} {swirl:5} {row} {share:8.1f}")


if __name__ == "__main__":
    main()
