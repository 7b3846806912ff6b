"""A rigid rotor on an isotropic film as seen in axes that turn with its orbit."""

from __future__ import annotations

import numpy as np

from ..model import Array, Linearization


def rotating_linearization(
    mass: float, speed: float, film: Array, added: tuple[Array, Array] | None = None
) -> Linearization:
    """Return the motion near a synchronous circular orbit, in radial and tangential axes.

    With q = R(speed t) r the film and the unbalance see a state at rest, and

        m (r'' + 2 w J r' - w^2 r) = F(r, r' + w J r) + unbalance force,    J = z^ x .,

    so the linearization does not depend on time and its eigenvalues are the Floquet exponents of the orbit.

    Parameters
    ----------
    mass : float [kg]
    speed : float [rad/s]
    film : ndarray, shape (2, 5, ...)
        Jacobian of the force at (e, 0), (0, speed e): radial and tangential axes.
    added : tuple of two ndarrays, optional
        Mass that the film adds, shape (2, 2, ...) [kg], and its slopes by position and velocity times the
        acceleration -speed^2 (e, 0), shape (2, 4, ...).

    Returns
    -------
    Linearization
        States: small r (radial, tangential) and r'. Inputs: force on the rotor along both. Outputs: the
        states, and the change of the force on the housing along both, -dF. Trailing batch axes of `film`
        become leading ones of A and C.
    """
    slopes = np.moveaxis(film, (0, 1), (-2, -1))
    J = np.array([[0.0, -1.0], [1.0, 0.0]])
    heavy = np.zeros((*slopes.shape[:-2], 2, 2))
    if added is not None:
        heavy = np.moveaxis(added[0], (0, 1), (-2, -1))
        slopes = slopes[..., :4] - np.moveaxis(added[1], (0, 1), (-2, -1))
    by_velocity = slopes[..., 2:4]
    by_position = slopes[..., :2] + speed * by_velocity @ J
    share = np.linalg.inv(mass * np.eye(2) + heavy)
    A = np.zeros((*slopes.shape[:-2], 4, 4))
    A[..., :2, 2:] = np.eye(2)
    A[..., 2:, :2] = share @ by_position + speed**2 * np.eye(2)
    A[..., 2:, 2:] = share @ by_velocity - 2.0 * speed * J
    B = np.zeros((*(A.shape[:-2] if added is not None else ()), 4, 2))
    B[..., 2:, :] = share if added is not None else np.eye(2) / mass
    C = np.zeros((*slopes.shape[:-2], 6, 4))
    C[..., :4, :] = np.eye(4)
    # The film gives the housing -dF + M da, and m da = dF - M da + the force on the rotor.
    C[..., 4:, :2] = -mass * share @ by_position
    C[..., 4:, 2:] = -mass * share @ by_velocity
    D = np.zeros((*B.shape[:-2], 6, 2))
    D[..., 4:, :] = heavy @ share if added is not None else 0.0
    return Linearization(A, B, C, D)
