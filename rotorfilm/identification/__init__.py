"""Identification: what a machine's measurements say of its bearing."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .bearing_fit import (
        BearingFit as BearingFit,
        FittedParameter as FittedParameter,
        fit_bearing as fit_bearing,
    )
    from .measurements import Measurements as Measurements
else:
    show(__name__)
