"""What the C library is told of contacts under their reduced law."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import block_diag

from ...model import Array
from ...native.spec import NativeParameter, NativeSpec

if TYPE_CHECKING:
    from .contact_law import ContactLaw

MOST_CONTACTS = 64
"""Contacts that the kernel takes (`native/kernel_contact.c`)."""


def contact_spec(law: ContactLaw, motion: Array, push: Array, gap: float) -> NativeSpec:
    """Return the kernel `contact` for contacts of one law.

    Parameters
    ----------
    law : ContactLaw
    motion : ndarray, shape (n_contacts, n_inputs)
        Approach of each contact per input.
    push : ndarray, shape (n_outputs, n_contacts)
        Output per force of each contact.
    gap : float [m]
        Approach of every contact where all inputs vanish.
    """
    film, time, force = law.film_scale, law.time_scale, law.force_scale
    scaled = {
        "A": law.A / time,
        "B": law.B / (time * film),
        "C": law.C * force,
        "D": law.D * force / film,
    }
    numbers = [law.offset * film, law.span * film, law.exponent, force, law.operating * film, *law.load_range]
    tables = {name: block_diag(*[matrix] * len(motion)) for name, matrix in scaled.items()}
    return NativeSpec(
        kernel="contact",
        parameters=(
            NativeParameter(
                name="gap",
                unit="m",
                value=float(gap),
                tunable=True,
                nominal=2.0 * film,
                description="approach of the contact where the displacement vanishes",
            ),
        ),
        tables={**tables, "motion": motion, "push": push, "law": np.array(numbers)},
    )
