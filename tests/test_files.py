"""Files: whole or as they were, sealed, and all of several or none."""

import errno
import hashlib
import os
import re
import stat
import subprocess
import sys

import pytest

from rotorfilm import InputError, Measurements, RigidRotor, TabulatedBearing, read_ross
from rotorfilm.bearings.journal.map_film import packaged_table
from rotorfilm.charts import new_axes, save
from rotorfilm.core import write_csv
from rotorfilm.core.files import (
    read_sealed,
    read_text,
    sealed_line,
    unsealed_line,
    write_atomically,
    write_sealed,
    written_together,
)
from rotorfilm.fmu import export_fmu

posix = pytest.mark.skipif(os.name != "posix", reason="limits and devices of POSIX")


@pytest.fixture
def full_disk():
    """Let no file grow beyond a kilobyte, as on a disk that is nearly full."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1024, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_what_is_written_is_read(tmp_path):
    path = write_sealed(tmp_path / "a", b"content", "settings")
    assert read_sealed(path, "settings", "rule") == b"content"
    assert path.read_bytes().startswith(b"content")
    assert [each.name for each in tmp_path.iterdir()] == ["a"]


def test_every_damage_is_seen(tmp_path):
    whole = write_sealed(tmp_path / "a", b"content", "settings").read_bytes()
    damages = [
        whole[:k] + bytes([whole[k] ^ bit]) + whole[k + 1 :] for k in range(len(whole)) for bit in (1, 128)
    ]
    damages += [whole[:k] for k in range(len(whole))]
    damages += [whole + b"x", whole[1:], whole + whole]
    for content in damages:
        (tmp_path / "a").write_bytes(content)
        with pytest.raises(InputError, match=r"'.*a' must"):
            read_sealed(tmp_path / "a", "settings", "rule")


def test_other_settings_are_refused(tmp_path):
    write_sealed(tmp_path / "a", b"content", "settings")
    with pytest.raises(InputError, match=r"^path must be mine, got '.*a'$"):
        read_sealed(tmp_path / "a", "others", "path must be mine")


def test_lines():
    line = sealed_line("text", "settings")
    assert unsealed_line(line, "settings") == "text"
    damages = [line[:k] + bytes([line[k] ^ 1]) + line[k + 1 :] for k in range(len(line))]
    assert {unsealed_line(other, "settings") for other in (*damages, line[:-1], b"\n", b"")} == {None}
    assert unsealed_line(line, "others") is None


@posix
@pytest.mark.parametrize(
    ("name", "write"),
    [
        ("out.bin", lambda path: write_atomically(path, bytes(5000))),
        ("out.csv", lambda path: write_csv(path, {"a": range(5000)})),
        ("out.map", lambda path: packaged_table().save(path)),
        ("out.png", lambda path: save(new_axes("a chart"), path)),
        ("out.fmu", lambda path: export_fmu(RigidRotor(mass=1.0, speed=1.0), path)),
    ],
)
@pytest.mark.parametrize("earlier", [None, b"earlier"])
def test_a_full_disk_leaves_what_was_there(tmp_path, full_disk, name, write, earlier):
    path = tmp_path / name
    if earlier is not None:
        path.write_bytes(earlier)
    with pytest.raises(OSError, match=rf"File too large: '.*{name}'") as caught:
        write(path)
    assert caught.value.errno == errno.EFBIG
    assert [each.read_bytes() for each in tmp_path.iterdir()] == ([] if earlier is None else [earlier])


def together(folder, files):
    with written_together(folder) as part:
        for name, content in files.items():
            write_atomically(part / name, content)


@posix
def test_several_files_are_there_together_or_none(tmp_path, full_disk):
    folder = tmp_path / "new" / "folder"
    with pytest.raises(OSError, match=r"File too large: '.*folder.b'"):
        together(folder, {"a": b"a", "b": bytes(5000)})
    assert not folder.exists()
    together(folder, {"a": b"a", "b": b"b"})
    (folder / "c").mkdir()
    with pytest.raises(OSError, match=r"Is a directory: '.*folder.c'"):
        together(folder, {"a": b"other", "c": b"c"})
    assert {each.name for each in folder.iterdir()} == {"a", "b", "c"}
    assert (folder / "a").read_bytes() == b"a"


@posix
def test_links_and_devices_stay_what_they_are(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "real")
    write_atomically(tmp_path / "link", b"content")
    assert (tmp_path / "real").read_bytes() == b"content"
    assert (tmp_path / "link").is_symlink()
    write_atomically("/dev/null", b"content")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    script = "from rotorfilm.core.files import write_atomically; write_atomically('/dev/stdout', b'through')"
    ran = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, check=True)
    assert ran.stdout == b"through"


@posix
def test_a_file_keeps_its_mode_and_one_that_is_read_only_is_refused(tmp_path, monkeypatch):
    path = write_atomically(tmp_path / "a", b"before")
    path.chmod(0o640)
    write_atomically(path, b"after")
    assert (path.read_bytes(), stat.S_IMODE(path.stat().st_mode)) == (b"after", 0o640)
    path.chmod(0o400)
    # The superuser may write everything, and is no one to test this with.
    monkeypatch.setattr(os, "access", lambda path, mode: not mode & os.W_OK)
    with pytest.raises(PermissionError, match=r"Permission denied: '.*a'"):
        write_atomically(path, b"other")
    assert path.read_bytes() == b"after"
    assert len(list(tmp_path.iterdir())) == 1


def test_a_seal_of_another_length_says_so(tmp_path):
    content = b"longer content"
    whole = write_sealed(tmp_path / "a", content, "settings").read_bytes()
    head = whole[len(content) : -32]
    (tmp_path / "a").write_bytes(content[1:] + head + hashlib.sha256(content[1:] + head).digest())
    with pytest.raises(InputError, match=r"must have 14 bytes before its seal, got 13"):
        read_sealed(tmp_path / "a", "settings", "rule")


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"'.*absent.a'"):
        write_atomically(tmp_path / "absent" / "a", b"")


@posix
@pytest.mark.parametrize(
    "read",
    [read_text, TabulatedBearing.from_csv, Measurements.read, read_ross],
    ids=lambda read: read.__qualname__,
)
def test_what_never_ends_is_not_read(tmp_path, read):
    endless, pipe, large, binary = (tmp_path / name for name in ("link.csv", "pipe", "large", "binary"))
    endless.symlink_to("/dev/zero")
    os.mkfifo(pipe)
    with large.open("wb") as file:
        file.truncate(2**26 + 1)  # without a byte on the disk
    binary.write_bytes(b"\xff\xfe\x00")
    for path, rule in (
        (endless, "a regular file"),
        (pipe, "a regular file"),
        (tmp_path, "a regular file"),
        (large, "at most 67108864 bytes long"),
        (binary, "UTF-8 text"),
    ):
        with pytest.raises(InputError, match=f"^{re.escape(repr(str(path)))} must be {rule}"):
            read(path)
