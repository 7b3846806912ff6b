"""Many variants of a scene: a grid or samples of its keys, into one dataset."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .sweep_run import sweep as sweep
    from .tolerance_study import (
        ToleranceStudy as ToleranceStudy,
        scatter_study as scatter_study,
        tolerance_study as tolerance_study,
    )
else:
    show(__name__)
