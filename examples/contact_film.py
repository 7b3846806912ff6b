"""Film and pressure of a ball rolling on a lubricated plane: contact.png (docs/contact.md shows it)."""

import matplotlib.pyplot as plt
import numpy as np

from rotorfilm import ContactGrid, PointContact, reduce_contact

# The case of Panovko (2011), on a rectangle large enough to hardly matter.
grid = ContactGrid(cells=(96, 96), inlet=-4.5, outlet=1.5, half_width=3.0)
contact = PointContact(V=0.1, Q0=5.0, grid=grid)
state = contact.stationary()
law = reduce_contact(PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(40, 40))))

figure, (above, middle, right) = plt.subplots(1, 3, figsize=(12, 3.4), layout="constrained")
y = np.concatenate([-grid.y[::-1], grid.y])
thickness, pressure = (
    np.concatenate([half[:, ::-1], half], axis=1).T for half in (state.thickness, state.pressure)
)
film = middle.contourf(grid.x, y, thickness, np.linspace(0.08, 0.4, 17), cmap="viridis", extend="both")
middle.contour(grid.x, y, pressure, [1e-3], colors="white", linewidths=1)
middle.set(xlim=(-2, 1.5), ylim=(-1.5, 1.5), xlabel="x / a", ylabel="y / a", title="film thickness H")
figure.colorbar(film, ax=middle)

line = state.pressure[:, 0], state.thickness[:, 0]
above.plot(grid.x, line[0], color="#c0392b", label="pressure p / p_H")
above.plot(grid.x, np.sqrt(np.maximum(1.0 - grid.x**2, 0.0)), "k:", lw=1, label="dry contact (Hertz)")
above.plot(grid.x, line[1], color="#2c3e50", label="film thickness H")
above.set(xlim=(-2.5, 1.5), ylim=(0, 1.6), xlabel="x / a, rolling direction", title="along the middle, y = 0")
above.legend(fontsize=8, loc="upper center")

omega = np.geomspace(0.05, 6.0, 200)
answer = [(law.C @ np.linalg.solve(1j * w * np.eye(law.order) - law.A, law.B) + law.D)[0, 0] for w in omega]
damping = -np.imag(answer) / omega
right.semilogx(omega, damping / law.damping, color="#2c3e50")
right.set(xlabel="angular frequency x transit time / 2", title="damping / that of slow motion", ylim=(0, 1.1))
figure.savefig("contact.png", dpi=110)

print(f"approach {state.delta:.5f}, smallest film {state.minimum_film:.4f}")
print(f"reduced law: load within {law.static_error:.2%}, damping within {law.damping_error:.2%}")
print("film thickness in the middle, H0:", state.central_film)
