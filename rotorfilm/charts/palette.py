"""Colors of the charts: one for each family of films, the same in every chart."""

from __future__ import annotations

from ..comparisons.journal.journal_rungs import FilmFamily

FAMILY_COLORS = {
    FilmFamily.SHORT: "#8c564b",
    FilmFamily.PUBLISHED: "#e377c2",
    FilmFamily.FIXED: "#d62728",
    FilmFamily.ROTATING: "#ff7f0e",
    FilmFamily.REYNOLDS: "#a08000",
    FilmFamily.FREE: "#2ca02c",
    FilmFamily.GRID: "#17a0b8",
    FilmFamily.EXTRAPOLATED: "#1f4fb4",
    FilmFamily.MAP: "#000000",
}
"""Colors by the family of a rung."""

FAMILY_WIDTHS = {
    FilmFamily.SHORT: 7.0,
    FilmFamily.PUBLISHED: 3.8,
    FilmFamily.FIXED: 2.4,
    FilmFamily.ROTATING: 1.3,
    FilmFamily.REYNOLDS: 3.4,
    FilmFamily.FREE: 2.8,
    FilmFamily.GRID: 5.2,
    FilmFamily.EXTRAPOLATED: 4.2,
    FilmFamily.MAP: 1.1,
}
"""Widths of lines [points]: of curves that coincide the wider lies below and shows beside the other."""

DASHES: dict[FilmFamily | None, tuple[float, tuple[float, float]]] = {FilmFamily.MAP: (0.0, (4.0, 3.0))}
"""Dashes of lines by family, in widths; of all others the first is solid."""

WITHIN = ("-", "--", ":", "-.")
"""Lines that tell the films of a family apart."""

FRONT = "#7030a0"
"""Color of a Pareto front."""

BAD, DOUBTFUL, GOOD = "#f4b6b0", "#fbe3a8", "#cfe8cf"
"""Backgrounds of verdicts."""
