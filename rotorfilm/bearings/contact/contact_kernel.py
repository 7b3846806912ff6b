"""What the C library is told of contacts under their reduced law."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag

from ...model import Array
from ...native.spec import NativeParameter, NativeSpec

MOST_CONTACTS = 64
"""Contacts that the kernel takes (`native/kernels/kernel_contact.c`)."""


class LawNumbers(NamedTuple):
    """A reduced law as the kernel takes it, in SI.

    Attributes
    ----------
    matrices : dict of str to ndarray
        A, B, C and D of the law.
    static : tuple of float
        Offset, span, exponent, force, operating approach and the range of loads.
    film : float [m]
        Unit of film thickness.
    """

    matrices: dict[str, Array]
    static: tuple[float, ...]
    film: float


def contact_spec(law: LawNumbers, motion: Array, push: Array, gap: float) -> NativeSpec:
    """Return the kernel `contact` for contacts of one law.

    Parameters
    ----------
    law : LawNumbers
    motion : ndarray, shape (n_contacts, n_inputs)
        Approach of each contact per input.
    push : ndarray, shape (n_outputs, n_contacts)
        Output per force of each contact.
    gap : float [m]
        Approach of every contact where all inputs vanish.
    """
    tables = {name: block_diag(*[matrix] * len(motion)) for name, matrix in law.matrices.items()}
    return NativeSpec(
        kernel="contact",
        parameters=(
            NativeParameter(
                name="gap",
                unit="m",
                value=float(gap),
                tunable=True,
                nominal=2.0 * law.film,
                description="approach of the contact where the displacement vanishes",
            ),
        ),
        tables={**tables, "motion": motion, "push": push, "law": np.array(law.static)},
    )
