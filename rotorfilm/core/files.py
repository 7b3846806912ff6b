"""Files that are written whole or not at all, and that are read back only if they are what was written.

A sealed file is its content, of any format, followed by a seal of 84 bytes: magic, version, length of the
content, SHA-256 of the settings that it belongs to, SHA-256 of all before. The seal is at the end, where
readers of NetCDF do not mind it.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import struct
from collections.abc import Iterator
from pathlib import Path

from .errors import InputError
from .limits import RECORD_BYTES

MAGIC = b"\x93RFSEAL\n"
VERSION = 1

_SEAL = struct.Struct("<8sIQ32s")
_CHECKSUM = hashlib.sha256().digest_size
_LINE = 16
"""Digits of the checksum in front of a line."""


def read_text(path: str | os.PathLike[str], most: int = RECORD_BYTES) -> str:
    """Return the text of a file, which must be a regular one: a pipe or a device may never end.

    Raises
    ------
    InputError
        If it is no regular file, longer than `most` bytes or no UTF-8 text; the message names it.
    OSError
        If it is not there or cannot be read.
    """
    name, source = repr(str(path)), Path(path)
    if source.exists() and not source.is_file():
        raise InputError(f"{name} must be a regular file, got a folder, a pipe or a device")
    with source.open("rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise InputError(f"{name} must be at most {most} bytes long, got more")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{name} must be UTF-8 text, got {error}") from None


def write_atomically(path: str | os.PathLike[str], content: bytes) -> Path:
    """Write a file that is either whole or as it was before, whoever else writes it; return the path.

    A file that was there keeps its mode, and is refused where it is not to be written.

    Raises
    ------
    OSError
        If it cannot be written; it names the file.
    """
    target = Path(path)
    with failures_named(target):
        if target.exists() and not target.is_file():  # a pipe or a device; a folder says what it is
            target.write_bytes(content)
        else:
            # The file that a link names, not the link, is replaced.
            _replace(Path(os.path.realpath(target)), content)
    return target


@contextlib.contextmanager
def failures_named(path: Path) -> Iterator[None]:
    """Let an OSError name the file that was to be written: that of a full disk names none."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error


def _replace(target: Path, content: bytes) -> None:
    # Not by tempfile, whose files are for one user alone: the mode of this one follows the umask.
    part = target.with_name(f"{target.stem}-{os.urandom(16).hex()}.part")
    there = target.exists()
    if there and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(target))
    try:
        with part.open("wb") as file:
            if there:
                part.chmod(target.stat().st_mode)
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, target)
    finally:
        part.unlink(missing_ok=True)


@contextlib.contextmanager
def written_together(folder: Path) -> Iterator[Path]:
    """Yield a folder to write files into; they move to `folder`, made if absent, once all are written.

    None moves where one of them cannot be written, or is a folder already. They move one after another: a
    move that fails all the same leaves those before it in place, and folders above `folder` stay where made.

    Raises
    ------
    OSError
        If a file cannot be written; it names the file, in `folder`.
    """
    import shutil

    new = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    part = folder / f"{os.urandom(16).hex()}.part"
    try:
        part.mkdir()
        yield part
        made = sorted(part.iterdir())
        for path in made:
            if (folder / path.name).is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(folder / path.name))
        for path in made:
            os.replace(path, folder / path.name)
    except OSError as error:
        name = Path(str(error.filename))
        if name.is_relative_to(part):
            error.filename = str(folder / name.relative_to(part))
        raise
    finally:
        shutil.rmtree(part, ignore_errors=True)
        if new and not any(folder.iterdir()):
            folder.rmdir()


def write_sealed(path: str | os.PathLike[str], content: bytes, settings: str) -> Path:
    """Write content with its seal; `settings` is a text of all that the content belongs to."""
    head = _SEAL.pack(MAGIC, VERSION, len(content), _digest(settings.encode()))
    return write_atomically(path, content + head + _digest(content + head))


def read_sealed(path: str | os.PathLike[str], settings: str, rule: str) -> bytes:
    """Return the content that `write_sealed` wrote.

    Parameters
    ----------
    path : path
    settings : str
        Settings as written.
    rule : str
        What the message says where the file is whole but belongs to other settings.

    Raises
    ------
    InputError
        If the file is damaged, of another version or of other settings; the message names it.
    OSError
        If it cannot be read.
    """
    data = Path(path).read_bytes()
    sealed = data[:-_CHECKSUM]
    content, head = sealed[: -_SEAL.size], sealed[-_SEAL.size :]
    name = repr(str(path))
    if len(head) < _SEAL.size or not head.startswith(MAGIC):
        raise InputError(
            f"{name} must end with the seal of rotorfilm: the file is incomplete, or rotorfilm did not write "
            "it"
        )
    if _digest(sealed) != data[-_CHECKSUM:]:
        raise InputError(f"{name} must have the checksum that was written with it: the file is damaged")
    _, version, length, owner = _SEAL.unpack(head)
    if version != VERSION:
        raise InputError(f"{name} must have a seal of version {VERSION}, got {version}")
    if length != len(content):
        raise InputError(f"{name} must have {length} bytes before its seal, got {len(content)}")
    if owner != _digest(settings.encode()):
        raise InputError(f"{rule}, got {name}")
    return content


def sealed_line(text: str, settings: str) -> bytes:
    """Return a line with its checksum in front, for files that grow."""
    checksum = _digest(f"{settings}\n{text}".encode()).hex()[:_LINE]
    return f"{checksum} {text}\n".encode()


def unsealed_line(line: bytes, settings: str) -> str | None:
    """Return the text of a line that `sealed_line` made, its end included; None of any other."""
    text = line[_LINE + 1 : -1].decode(errors="replace")
    return text if sealed_line(text, settings) == line else None


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).digest()
