"""Run every benchmark of this folder and keep what it prints: all measured tables in one command.

    python benchmarks/run_all.py [NAME ...]

The outputs go to benchmarks/results/NAME.txt, and each is printed with the lines of the run before that it
replaces, marked by -. A benchmark that fails keeps its old output, and the run ends with 1.
"""

import difflib
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent


def main(names: list[str]) -> int:
    """Run the benchmarks of these names, all without one; return how many failed."""
    every = sorted(path.stem for path in HERE.glob("*.py") if path != Path(__file__))
    failed = 0
    for name in names or every:
        print(f"=== {name}", flush=True)
        begun = time.monotonic()
        ran = subprocess.run([sys.executable, str(HERE / f"{name}.py")], capture_output=True, text=True)
        print(f"{time.monotonic() - begun:.0f} s", flush=True)
        failed += ran.returncode != 0
        if ran.returncode:
            print(ran.stderr, flush=True)
            continue
        kept = HERE / "results" / f"{name}.txt"
        print(
            before_and_after(kept.read_text(encoding="utf-8") if kept.is_file() else "", ran.stdout),
            flush=True,
        )
        kept.write_text(ran.stdout, encoding="utf-8")
    return failed


def before_and_after(before: str, after: str) -> str:
    """Return the lines of a run, those of the run before that they replace above them and marked by -."""
    lines = difflib.ndiff(before.splitlines(), after.splitlines())
    return "\n".join(line for line in lines if not line.startswith("?"))


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
