"""Build wheels for Linux, Windows and macOS on this machine: zig compiles the C library for each.

    python -m pip install build wheel '.[platforms]'
    python tools/build_wheels.py --out dist                                every platform
    python tools/build_wheels.py --out dist x86_64-linux aarch64-darwin    some of them

Each wheel is checked: it must hold every library that CMake makes, for the right platform.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from rotorfilm.fmu.native.platforms import TARGETS, Target

ROOT = Path(__file__).parent.parent
TAGS = {
    "x86_64-linux": "manylinux_2_17_x86_64.manylinux2014_x86_64",
    "aarch64-linux": "manylinux_2_17_aarch64.manylinux2014_aarch64",
    "x86_64-windows": "win_amd64",
    "x86_64-darwin": "macosx_11_0_x86_64",
    "aarch64-darwin": "macosx_11_0_arm64",
}
"""Platform tags of wheels, by the platform's folder in an FMU."""
HEADERS = {
    "x86_64-linux": rb"\x7fELF.{14}\x3e\x00",
    "aarch64-linux": rb"\x7fELF.{14}\xb7\x00",
    "x86_64-windows": rb"MZ.{,1000}PE\x00\x00\x64\x86",
    "x86_64-darwin": rb"\xcf\xfa\xed\xfe\x07\x00\x00\x01",
    "aarch64-darwin": rb"\xcf\xfa\xed\xfe\x0c\x00\x00\x01",
}
"""How a library of a platform begins: its format and its processor, as a regular expression."""


def main(arguments: list[str]) -> None:
    """Build and check the wheels that the command line asks for."""
    targets = {target.folder: target for target in TARGETS}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    names = ", ".join(targets)
    parser.add_argument("platforms", nargs="*", metavar="PLATFORM", help=f"of {names}; default all")
    parser.add_argument("--out", type=Path, default=Path("dist"), help="folder of the wheels; default dist")
    asked = parser.parse_args(arguments)
    for folder in asked.platforms or targets:
        if folder not in targets:
            parser.error(f"PLATFORM must be one of {names}, got {folder!r}")
        wheel = build(targets[folder], asked.out.resolve())
        print(f"{wheel.name}: {check(wheel, targets[folder])} libraries, {wheel.stat().st_size / 1e6:.1f} MB")


def build(target: Target, out: Path) -> Path:
    """Build the wheel of one platform into the folder `out`; return its path."""
    machine, system = target.folder.split("-")
    with tempfile.TemporaryDirectory() as name:
        command = [sys.executable, "-m", "build", "--wheel", "--outdir", name, str(ROOT)]
        environment = {
            "CC": f"{sys.executable} -m ziglang cc -target {target.triple}",
            "CMAKE_ARGS": f"-DCMAKE_SYSTEM_NAME={system.title()} -DCMAKE_SYSTEM_PROCESSOR={machine}",
            "SKBUILD_BUILD_DIR": str(Path(name) / "build"),
        }
        subprocess.run(command, env={**os.environ, **environment}, check=True, stdout=subprocess.DEVNULL)
        (built,) = Path(name).glob("*.whl")
        tags = [sys.executable, "-m", "wheel", "tags", "--platform-tag", TAGS[target.folder], str(built)]
        named = subprocess.run(tags, check=True, capture_output=True, text=True).stdout.strip()
        out.mkdir(parents=True, exist_ok=True)
        return Path(shutil.move(Path(name) / named, out / named))


def check(wheel: Path, target: Target) -> int:
    """Return how many libraries a wheel holds.

    Raises
    ------
    ValueError
        If one is missing or is of another platform.
    """
    listed = (ROOT / "rotorfilm/native/kernels/kernel_list.h").read_text(encoding="utf-8")
    subsets = re.findall(r"^#define RF_(ROTORFILM\w*)", listed, re.MULTILINE)
    expected = {f"rotorfilm/native/{subset.lower()}.{target.suffix}" for subset in subsets}
    header = re.compile(HEADERS[target.folder], re.DOTALL)
    with zipfile.ZipFile(wheel) as archive:
        found = {name for name in archive.namelist() if name.endswith((".so", ".dll", ".dylib"))}
        other = {name for name in found if not header.match(archive.read(name))}
    if found != expected or other:
        raise ValueError(
            f"{wheel.name} must hold {sorted(expected)} of {target.folder}, "
            f"got {sorted(found)}, of another platform: {sorted(other)}"
        )
    return len(found)


if __name__ == "__main__":
    main(sys.argv[1:])
