"""A kernel is one file and one row: the library, the FMU, its page and its icon follow from them."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rotorfilm import InputError
from rotorfilm.native import resource as kernel_table
from rotorfilm.native.library import FOLDER, LOOPS, MASTER, SUFFIXES

PACKAGE = Path(kernel_table.__file__).parents[1]
COMPILER = next((name for name in ("gcc", "clang", "cc") if shutil.which(name)), None)
PICTURES = PACKAGE / "fmu" / "native" / "data"
TABLE = kernel_table.kernel_table()

ROW = "RF_KERNEL(toy, RF_ROTORFILM_STATES, linear)\n"
FILE = r"""
/* Documentation of the FMU

   Model: A spring that
   pushes back:

   Equations:
   force = - stiffness
             * x

   Validity: Hooke: small x. */
#include "kernel.h"

static int take_tables(void *kernel, const rf_tables *tables, rf_sizes *sizes, rf_message *why)
{
    (void)kernel, (void)tables, (void)why;
    *sizes = (rf_sizes){1, 1, 1, 0, 0};
    return RF_OK;
}

static int set_parameters(void *kernel, const double *p, rf_message *why)
{
    (void)why;
    *(double *)kernel = *p;
    return RF_OK;
}

static int output(const void *kernel, const rf_point *at, double *y, rf_message *why)
{
    (void)why;
    *y = -*(const double *)kernel * *at->u;
    return RF_OK;
}

static int jacobian(const void *kernel, const rf_point *at, rf_jacobian *answer, rf_message *why)
{
    (void)at, (void)why;
    *answer->D = -*(const double *)kernel;
    return RF_OK;
}

const rf_kernel_type rf_toy_type = {
    .bytes = sizeof(double),
    .take = take_tables,
    .set_parameters = set_parameters,
    .output = output,
    .jacobian = jacobian,
};
"""

USE = """
import sys
from zipfile import ZipFile
import numpy as np
from fmpy import simulate_fmu
from rotorfilm.fmu import export_fmu
from rotorfilm import Linearization
from rotorfilm.native import NativeParameter, NativeSpec
from rotorfilm.native.resource import kernel_row, kernel_table
from rotorfilm.core import Signal

class Toy:
    inputs = (Signal(name="x", unit="m", nominal=1.0, description=""),)
    outputs = (Signal(name="force", unit="N", nominal=1.0, description=""),)
    states = ()
    def output(self, t, x, u):
        return -3.0 * np.asarray(u)
    def linearization(self, t, x, u):
        return Linearization(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((1, 0)), np.array([[-3.0]]))
    def native(self):
        stiffness = NativeParameter(name="stiffness", unit="N/m", value=3.0, tunable=True)
        return NativeSpec(kernel="toy", parameters=(stiffness,))

assert "toy" in kernel_table() and kernel_row("toy")[0] == ("rotorfilm_states",)
path = export_fmu(Toy(), sys.argv[1], start={"x": 2.0}, component="toy")
rows = simulate_fmu(str(path), fmi_type="CoSimulation", stop_time=0.1, start_values={"toy.stiffness": 5.0})
assert rows["toy.force"][-1] == -10.0, rows
page = ZipFile(path).read("documentation/index.html").decode()
assert "<p>A spring that pushes back:</p>" in page and "<p>Hooke: small x.</p>" in page
assert "<pre>force = - stiffness\\n          * x</pre>" in page
picture = ZipFile(path).read("model.png")
export_fmu(Toy(), sys.argv[1], "3.0", component="toy")
assert ZipFile(path).read("documentation/icon.png") == picture
"""


@pytest.fixture
def tree(tmp_path):
    """Return a copy of the package with one more file and one more row, without libraries."""
    ignored = shutil.ignore_patterns("*.so", "*.dylib", "*.dll", "__pycache__")
    package = shutil.copytree(PACKAGE, tmp_path / "rotorfilm", ignore=ignored)
    kernels = package / "native" / "kernels"
    rows = (kernels / "kernel_list.h").read_text()
    rows = rows.replace("#ifdef RF_KERNEL\n", f"#ifdef RF_KERNEL\n{ROW}")
    (kernels / "kernel_list.h").write_text(rows)
    (kernels / "kernel_toy.c").write_text(FILE)
    return tmp_path


def build(native, library):
    """Compile a library of a tree as CMakeLists.txt does, without its optimization."""
    options = ["-std=c99", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fPIC", "-shared"]
    options += ["-fvisibility=hidden", f"-DRF_SUBSET=RF_{library.upper()}"]
    target = native / f"{library}{SUFFIXES.get(sys.platform, '.so')}"
    command = [COMPILER, *options, *map(str, sorted(native.rglob("*.c"))), "-o", str(target), "-lm"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


@pytest.mark.long
@pytest.mark.closed_form
@pytest.mark.skipif(not COMPILER or sys.platform == "win32", reason="no C compiler")
def test_a_new_kernel_is_one_file_and_one_row(tree):
    build(tree / "rotorfilm" / "native", "rotorfilm_states")
    command = [sys.executable, "-c", USE, str(tree / "toy.fmu")]
    ran = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_every_row_has_its_file_and_every_file_its_row():
    files = {path.stem.removeprefix("kernel_") for path in FOLDER.rglob("kernel_*.c")}
    assert set(TABLE) == files
    assert {name for row in TABLE.values() for name in row[0]} | {LOOPS, MASTER} == set(
        kernel_table.libraries()
    )


def test_every_picture_is_of_a_row():
    assert {path.stem for path in PICTURES.glob("*.png")} == {row[1] for row in TABLE.values()}


@pytest.mark.parametrize("kernel", TABLE)
def test_every_kernel_documents_itself(kernel):
    texts = kernel_table.kernel_texts(kernel)
    assert list(texts) == ["Model", "Equations", "Validity"]
    assert all(texts.values())
    assert "=" in texts["Equations"]


def test_what_is_not_there_is_named(monkeypatch):
    with pytest.raises(InputError, match=r"kernel must be one of \['ball_bearing'.*got 'toy'"):
        kernel_table.kernel_row("toy")
    part = "/* Documentation of the FMU\n\n   Model: a. */"
    monkeypatch.setattr(kernel_table, "_source", lambda name: part)
    with pytest.raises(InputError, match=r"kernel_toy\.c must document .*got \['Model'\]"):
        kernel_table.kernel_texts("toy")
