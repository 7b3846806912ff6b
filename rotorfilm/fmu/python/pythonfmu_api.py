"""What PythonFMU's compiled part expects of a slave, and how to survive its reference counting.

PythonFMU 0.7.0 (PySlaveInstance.cpp) knows three outcomes: a method returns, fmi2OK; do_step returns False,
fmi2Discard with fmi2Terminated true; a method raises, fmi2Fatal with the exception's repr in the log.
There is no way to fmi2Error. An FMU carries the libraries it is exported with, so that the export is where
another version is refused (`archive.require_verified_version`).
"""

from __future__ import annotations

import ctypes
from typing import Any, NoReturn


class Fmi2Slave:
    """The name by which PythonFMU finds a slave class; no copy of its Python package is needed."""


class LogMessage:
    """An entry of the log queue: status (FMI number), category and message."""

    def __init__(self, status: int, category: str, msg: str) -> None:
        self.status = status
        self.category = category
        self.msg = msg


class SlaveFailure(Exception):
    """What a failing slave raises; its repr is the line that the log shows."""

    def __repr__(self) -> str:
        return str(self)


def keep(*held: Any) -> None:
    """Take one more reference to each object, for one that PythonFMU releases without having it."""
    for value in held:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(value))


def abort(slave: Fmi2Slave, log_queue: list[LogMessage], message: str) -> NoReturn:
    """Raise SlaveFailure such that the instance, and the process, outlive it.

    On an exception PythonFMU releases its references to the class, the instance and the log queue and
    releases them again with the instance; each is taken once more here, so that the counts stay right.
    The queue must be empty, because PythonFMU would call the logger with the exception pending and lose it.
    """
    log_queue.clear()
    keep(type(slave), slave, log_queue)
    raise SlaveFailure(message)
