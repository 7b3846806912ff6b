"""Reports: what a scene was asked and answers, as one HTML page that needs no other file and no network."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .chart_page import write_page as write_page
    from .page import (
        Markup as Markup,
        Report as Report,
        ReportSection as ReportSection,
        Verdict as Verdict,
    )
    from .scene_report import report_scene as report_scene
else:
    show(__name__)
