"""Write down what the product answers, or compare it with that: a scaffold while the form changes.

    python tools/freeze_answers.py write --out tests/frozen
    python tools/freeze_answers.py compare --out tests/frozen --only "tilting" "damper"

It answers eight random scenes of each family of the battery, all scene files of the examples, all example
scripts (what they print) and all charts (their CSV files without columns of time). `compare` takes what was
written and lists every difference: values must agree to 1e-9; where another model answers, or another
estimate, within both estimates. What is new is listed too.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "benchmarks"))

SEED, EACH = 20291, 8
TOLERANCE, ZERO = 1e-9, 1e-12
CHARTS = (
    "journal --states 40",
    "stability",
    "bearings",
    "pads --states 20",
    "rolling",
    "limits",
    "bush",
    "heat",
    "damper",
)
"""Charts whose numbers are not times, with as few states as they take."""

WITHIN, NEW = "  within both", "after"
"""What ends a line about another model, whose answer is right: a map that is there already is cheaper."""

TIMES = re.compile(r"\[(s|ms|us|ns)\]|cost|time|speed-?up|second", re.IGNORECASE)
"""Headings of columns that hold times of this machine."""


def numbers(value: Any) -> Any:
    """Return a value as JSON holds it."""
    if value is None or isinstance(value, str | bool | int):
        return value
    array = np.asarray(value)
    if np.iscomplexobj(array):
        return [numbers(array.real), numbers(array.imag)]
    return array.astype(float).tolist()


def answered(data: dict[str, Any], name: str) -> dict[str, Any]:
    """Return what a scene answers, or the error that it ends in."""
    from rotorfilm import RotorfilmError
    from rotorfilm.scenes import read_scene

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            answer = read_scene(data, name).solve()
        except RotorfilmError as error:
            return {"error": type(error).__name__}
    if not hasattr(answer, "rungs"):
        items = {key: numbers(value) for key, value in _plain(answer)}
        return {"values": items}
    return {
        "quantity": answer.quantity,
        "value": numbers(answer.value),
        "estimate": float(answer.error_estimate),
        "model": answer.model,
        "met": bool(answer.met),
        "rungs": [
            {
                "name": rung.name,
                "verdict": rung.verdict,
                "value": numbers(rung.value),
                "estimate": rung.error_estimate,
            }
            for rung in answer.rungs
        ],
    }


def _plain(answer: Any) -> Iterator[tuple[str, Any]]:
    for name, value in vars(answer).items():
        if isinstance(value, float | int | str | bool | np.ndarray | tuple | None):
            try:
                numbers(value)
            except (TypeError, ValueError):
                continue
            yield name, value


def battery_scenes(family: str) -> list[tuple[str, dict[str, Any]]]:
    """Return the scenes of one family of the battery."""
    from families import FAMILIES

    random = np.random.default_rng([SEED, sorted(FAMILIES).index(family)])
    return [(f"{family} {k}", FAMILIES[family][1](random).data) for k in range(EACH)]


def family_answers(family: str) -> dict[str, Any]:
    """Return the answers of one family."""
    return {name: {"scene": data, **answered(data, name)} for name, data in battery_scenes(family)}


def example_scenes(_: str = "") -> dict[str, Any]:
    """Return the answers of the scene files of the examples."""
    import tomllib

    found = {}
    for path in sorted((ROOT / "examples").glob("*.toml")):
        os.chdir(path.parent)
        found[path.name] = answered(tomllib.loads(path.read_text(encoding="utf-8")), path.name)
    return found


def example_outputs(_: str = "") -> dict[str, Any]:
    """Return the numbers that the example scripts print."""
    found = {}
    for path in sorted((ROOT / "examples").glob("*.py")):
        with tempfile.TemporaryDirectory() as folder:
            for beside in (ROOT / "examples").iterdir():
                (Path(folder) / beside.name).symlink_to(beside)
            done = subprocess.run(
                [sys.executable, "-W", "ignore", path.name],
                cwd=folder,
                capture_output=True,
                text=True,
                env={**os.environ, "MPLBACKEND": "Agg"},
                check=False,
            )
        found[path.name] = {"output": done.stdout.splitlines(), "code": done.returncode}
    return found


def chart(name: str) -> dict[str, Any]:
    """Return the tables of one chart without columns of time."""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-W", "ignore", "-m", "rotorfilm", "chart", *name.split(), "--out", folder]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        tables = {}
        for path in sorted(Path(folder).rglob("*.csv")):
            rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
            tables[path.name] = [{k: v for k, v in row.items() if k and not TIMES.search(k)} for row in rows]
    return {"tables": tables, "code": done.returncode}


def jobs() -> dict[str, tuple[Callable[[str], Any], str]]:
    """Return what is written: by name of its file, the call and its argument."""
    from families import FAMILIES

    found: dict[str, tuple[Callable[[str], Any], str]] = {
        f"scenes {family.replace(',', '')}": (family_answers, family) for family in FAMILIES
    }
    found |= {"examples scenes": (example_scenes, ""), "examples output": (example_outputs, "")}
    return found | {f"chart {name.split()[0]}": (chart, name) for name in CHARTS}


def differences(before: Any, after: Any, where: str) -> Iterator[str]:
    """Yield how two answers differ."""
    if all(isinstance(one, dict) and "rungs" in one for one in (before, after)):
        yield from _changed_answer(before, after, where)
    elif isinstance(before, dict) and isinstance(after, dict):
        for key in sorted(before.keys() | after.keys(), key=str):
            if key in before and key in after:
                yield from differences(before[key], after[key], f"{where}/{key}")
            else:
                yield f"{where}/{key}: only {'before' if key in before else NEW}"
    elif isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        for k, (old, new) in enumerate(zip(before, after, strict=True)):
            yield from differences(old, new, f"{where}/{k}")
    elif not same(before, after):
        yield f"{where}: {before!r} became {after!r}"


def _changed_answer(before: Any, after: Any, where: str) -> Iterator[str]:
    """Yield how an answer with an estimate differs: in model, value beyond round-off, or estimate."""
    old, new = np.asarray(before["value"], float), np.asarray(after["value"], float)
    gap, size = float(np.max(np.abs(old - new), initial=0.0)), float(np.max(np.abs(old), initial=0.0))
    both = before["estimate"] + after["estimate"]
    kept = all(before[name] == after[name] for name in ("quantity", "model", "met"))
    alike = math.isclose(before["estimate"], after["estimate"], rel_tol=1e-6, abs_tol=ZERO)
    if kept and alike and gap <= TOLERANCE * size + ZERO:
        return
    within = gap <= max(both * size, ZERO)
    yield (
        f"{where}: {before['model']} ({before['met']}) became {after['model']} ({after['met']}), "
        f"{gap / max(size, 1e-300):.1e} apart, estimates {before['estimate']:.1e} and {after['estimate']:.1e}"
        f"{WITHIN if within else '  TOO FAR'}"
    )


def same(before: Any, after: Any) -> bool:
    """Return whether two entries agree: numbers to 1e-9, texts but for the digits beyond that."""
    if isinstance(before, str) and isinstance(after, str):
        pattern = r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?"
        if re.sub(pattern, "#", before) != re.sub(pattern, "#", after):
            return False
        pairs = zip(re.findall(pattern, before), re.findall(pattern, after), strict=True)
        return all(math.isclose(float(a), float(b), rel_tol=1e-6, abs_tol=1e-12) for a, b in pairs)
    if isinstance(before, int | float) and isinstance(after, int | float):
        return (
            before == after
            or math.isclose(before, after, rel_tol=TOLERANCE, abs_tol=1e-15)
            or (math.isnan(before) and math.isnan(after))
        )
    return bool(before == after)


def _job(name: str) -> tuple[str, Any]:
    call, argument = jobs()[name]
    return name, call(argument)


def main() -> None:
    """Write or compare, with two processes."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("action", choices=("write", "compare"))
    parser.add_argument("--out", type=Path, default=ROOT / "tests" / "frozen")
    parser.add_argument("--only", nargs="+", default=[], help="names that contain one of these words")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    names = [n for n in jobs() if not options.only or any(word in n for word in options.only)]
    paths = {name: options.out / f"{name.replace(' ', '_')}.json" for name in names}
    if options.action == "compare":
        names = [name for name in names if paths[name].is_file()]
    wrong = 0
    with ProcessPoolExecutor(options.workers) as pool:
        for name, found in pool.map(_job, names):
            path = paths[name]
            if options.action == "write":
                path.write_text(json.dumps(found, indent=0) + "\n", encoding="utf-8")
                print("wrote", path.name, flush=True)
                continue
            before = json.loads(path.read_text(encoding="utf-8"))
            lines = list(differences(before, json.loads(json.dumps(found)), name))
            wrong += sum(not line.endswith((WITHIN, NEW)) for line in lines)
            print(f"{name}: {len(lines)} differences", *lines[:20], sep="\n    ", flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
