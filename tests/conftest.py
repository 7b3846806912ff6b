"""A user's own model, in a module of its own."""

import importlib
import os
import sys

# Two workers share the cores; threads of BLAS beside them double the time. Read when numpy loads.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import pytest

from rotorfilm.bearings.journal import map_film as own_tables
from rotorfilm.cli import main as cli

PROPORTIONAL = '''
"""A user's model."""

from __future__ import annotations

import numpy as np
from dataclasses import dataclass

from rotorfilm.core.model import Linearization, static_linearization
from rotorfilm.core import Signal

GAIN = 2.0


@dataclass(frozen=True)
class Proportional:
    """Output = GAIN * input."""

    offset: object = 0.0
    inputs = (Signal(name="a", unit="m", nominal=1e-3, description="input"),)
    outputs = (Signal(name="b", unit="N", nominal=2.0, description="output"),)
    states = ()

    def output(self, t, x, u):
        return np.array([GAIN * u[0]])

    def linearization(self, t, x, u) -> Linearization:
        return static_linearization(np.array([[GAIN]]))
'''


@pytest.fixture
def run(capsys):
    """Return a function that runs the command line: exit code, standard output, standard error."""

    def call(*arguments):
        with pytest.raises(SystemExit) as exit_:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return exit_.value.code or 0, out, err

    return call


@pytest.fixture(scope="module")
def coarse_own_table():
    """Return a function that makes the map of a bearing which the packaged table leaves out, of few nodes.

    Until the end of the module it is that of every bearing of this length/diameter.
    """

    def make(slenderness, cells):
        own_tables.bearing_table.cache_clear()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(own_tables, "TABLE_CELLS", cells)
            return own_tables.bearing_table(slenderness)

    yield make
    own_tables.bearing_table.cache_clear()


@pytest.fixture
def own_source():
    """Return the source of a module with the model Proportional."""
    return PROPORTIONAL


@pytest.fixture
def write_module(tmp_path, monkeypatch):
    """Return a function that writes a module and imports it."""
    monkeypatch.syspath_prepend(str(tmp_path))
    # A module written twice within a second would be read from the bytecode of the first.
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    written = []

    def write(name, text=PROPORTIONAL):
        (tmp_path / f"{name}.py").write_text(text)
        written.append(name)
        sys.modules.pop(name, None)
        importlib.invalidate_caches()
        return importlib.import_module(name)

    yield write
    for name in written:
        sys.modules.pop(name, None)
