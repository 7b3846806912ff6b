"""What the commands of charts share: files that they write, and how they say it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...results import write_csv
from .. import printing as console
from ..command import Option

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ...comparisons.journal.timing import FilmCost

DPI = 110

Slenderness = Annotated[float, Option("--ld", help="Bearing length / diameter, 0.1 to 4.")]
Folder = Annotated[Path, Option("--out", help="Folder for PNG and CSV; made if absent.")]
OUT = Path("rotorfilm-charts")

Rows = Iterable[Sequence[str]]
Columns = Mapping[str, Iterable[object]]


def write_chart(
    out: Path, name: str, columns: Columns, axes: Sequence[Axes], *, data: object = None
) -> list[tuple[str, str]]:
    """Write chart and table, and data as JSON if there are any; return the rows that name them."""
    from ...charts import save

    out.mkdir(parents=True, exist_ok=True)
    files = {
        "chart": save(axes[0], out / f"{name}.png", dpi=DPI),
        "table": write_csv(out / f"{name}.csv", columns),
    }
    if data is not None:
        files["data"] = console.write_json(out / f"{name}.json", data)
    return [(kind, str(path)) for kind, path in files.items()]


def print_chart(headings: Sequence[str], rows: Rows, files: Rows) -> None:
    """Print a table, without headings if there are none, and files and remarks below it."""
    if headings:
        console.print_columns(headings, rows)
    else:
        console.print_rows("", rows)
    console.print_rows("", files)


def number(entry: object) -> str:
    """Return an entry of a table as text."""
    return f"{entry:.4g}" if isinstance(entry, float) else "" if entry is None else str(entry)


def costs(cost: FilmCost) -> tuple[str, str]:
    """Return the costs of a force in a batch and alone as text."""
    return f"{1e6 * cost.force_time:.3g} us", f"{1e6 * cost.call_time:.3g} us"


def milliseconds(cost: float | None) -> str:
    """Return a time [s] as text."""
    return "" if cost is None else f"{1e3 * cost:.3g} ms"
