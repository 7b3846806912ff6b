"""A C program with sanitizers opens, misuses and closes instances, and offers damaged resources."""

import os
import shutil
import struct
import subprocess
import zlib
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    BushReaction,
    BushWear,
    FullFilm,
    Groove,
    JournalBearing,
    MapFilm,
    PorousCage,
    PressureDamBearing,
    ReynoldsFilm,
    RigidRotor,
    RigidShaft,
    SpeedProfile,
    SqueezeFilmDamper,
    pressure_dam_pads,
)
from rotorfilm.bearings import AxialFeed, LocalMelting, MapTable, f4k20_bush
from rotorfilm.fmu.reference import LinearSystem
from rotorfilm.native.film_kernels import periodic
from rotorfilm.native.resource import FILE_NAME
from rotorfilm.rotors import SpeedInputRotor, mount

OPTIONS = ["-g1", "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-DRF_MOST_STEPS=1000"]
"""Sanitizers, and few steps of an integration: one of extreme numbers takes as many as it may."""


def small_bearing():
    """Return a bearing over a small table of five slendernesses, for files that are quick to damage.

    It is stored in quanta, as that of the package is.
    """
    rng = np.random.default_rng(2)
    table = MapTable(
        slenderness_range=(0.2, 1.0),
        reach=3.0,
        log_center=rng.normal(size=10),
        coefficients=1e-8 * rng.integers(-30_000_000, 30_000_000, size=(10, 7, 7)),
    )
    return JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm(table))


def grid_bearing():
    """Return a bearing with a groove under pressure, on a grid as small as may be."""
    groove = Groove(center=1.5, width=0.4)
    return replace(small_bearing(), film=ReynoldsFilm(cells=(16, 4)), grooves=(groove,), supply_pressure=1e5)


def dam_bearing():
    """Return a pressure dam with a relief track, on grids as small as may be."""
    pads = pressure_dam_pads(depth=1e-4, end=2.3, share=0.7, track_depth=1e-4, preload=0.3)
    return PressureDamBearing(
        radius=0.05, length=0.03, assembled_clearance=1e-4, viscosity=0.1, pads=pads, cells=(16, 8)
    )


DAMPER = {"radius": 0.05, "length": 0.02, "clearance": 1e-4, "viscosity": 0.01}


def fed_damper():
    """Return a short damper with feed at its ends, whose film is clipped."""
    feed = AxialFeed(start_pressure=2e4, end_pressure=1e4)
    return SqueezeFilmDamper(**DAMPER, feed=feed)


def porous_damper():
    """Return a short damper with a porous cage, whose film is full."""
    cage = PorousCage(thickness=2.5e-3, permeability=4e-13, vented=True, supply_pressure=1e4)
    return SqueezeFilmDamper(**DAMPER, extent=FullFilm(), cage=cage)


def driven_system():
    """Return a rotor with its speed as an input, in a bearing and on a damper that adds mass."""
    heavy = SqueezeFilmDamper(**DAMPER, density=800.0)
    stations = (("left", -0.1), ("right", 0.1))
    shaft = RigidShaft(mass=5.0, diametral_inertia=0.1, polar_inertia=0.05, speed=100.0, stations=stations)
    return mount(SpeedInputRotor(rotor=shaft), {"left": small_bearing(), "right": heavy})


class RoughGrooves(JournalBearing):
    """A bearing with openings over a small map at random."""

    def native(self):
        """Return its kernel."""
        rng = np.random.default_rng(3)
        rough, numbers = 0.1 * rng.normal(size=(7, 6, 8)), np.array([self.slenderness, 3.0, 0.7, 0.4])
        wide = periodic(periodic(rough, 1), 2)
        tables = {"coefficients": wide, "center": periodic(rng.normal(size=12), 0), "map": numbers}
        return replace(JournalBearing.native(small_bearing()), kernel="grooved_journal", tables=tables)


def system():
    """Return the bearing with a rotor in it, one system."""
    return mount(run_up(), {"": small_bearing()})


def bushes():
    """Return a bush under a load and bushes with a worn profile, on an arc and all around."""
    bush = f4k20_bush()
    arc = BushReaction(bush=bush, melting_heat=1e8, nodes=8, extent=1.4)
    ring = replace(arc, nodes=12, extent=2.0 * np.pi, melting=LocalMelting(), retardation=1e-3)
    return BushWear(bush=bush, melting_heat=1e8), arc, ring


def run_up():
    return RigidRotor(mass=5.0, speed=SpeedProfile((0.0, 0.002, 0.01), (1.0, 200.0, 100.0)), unbalance=1e-3)


def state_space():
    """Return a system that grows, with inputs and outputs at the references that the program counts on."""
    A, B, C, D = (np.random.default_rng(6).normal(size=s) for s in ((4, 4), (4, 9), (2, 4), (2, 9)))
    labels = (tuple(f"{kind}{k}" for k in range(count)) for kind, count in (("u", 9), ("y", 2), ("x", 4)))
    inputs, outputs, states = labels
    return LinearSystem(
        A=100.0 * A, B=B, C=C, D=D, input_labels=inputs, output_labels=outputs, state_labels=states
    )


def sealed(content):
    """Return the content of a resource with its size and checksum set right."""
    body = content[24:]
    return content[:12] + struct.pack("<IQ", zlib.crc32(body), len(content)) + body


def damaged(good):
    """Return contents that no library may open."""
    version = good[:8] + struct.pack("<I", 1) + good[12:]
    yield from (good[:length] for length in (0, 7, 23, 24, 100, 200, 300, len(good) - 8, len(good) - 1))
    yield from (sealed(good[:length]) for length in (200, 300, 500, len(good) - 8))
    yield from (good + b"\0", version, b"RFILMMAP" + good[8:], good[:-1] + bytes([good[-1] ^ 1]))
    for name, wrong in ((b"journal\0", b"journey\0"), (b"rotor_system\0", b"motor_system\0")):
        if name in good:
            yield sealed(good.replace(name, wrong))
    yield sealed(good[:-8] + struct.pack("<d", np.nan))
    yield sealed(good.replace(b"coefficients\0", b"coefficienty\0"))


def impossible(good):
    """Return contents of a bearing with openings whose map no library may take."""
    for place, value in ((0, -0.3), (1, 0.0), (2, 0.0), (2, 1.5)):
        numbers = np.frombuffer(good[-32:], "<f8").copy()
        numbers[place] = value
        yield sealed(good[:-32] + numbers.tobytes())
    yield sealed(good.replace(struct.pack("<III", 7, 11, 13), struct.pack("<III", 77, 13, 1)))


def mutated(good, count):
    """Yield contents with a few bytes changed, most of them in the directories, under a right checksum."""
    rng = np.random.default_rng(4)
    for _ in range(count):
        content = bytearray(good)
        for _ in range(rng.integers(1, 4)):
            content[rng.integers(24, min(len(good), 2200))] = rng.integers(0, 256)
        yield sealed(bytes(content))


@pytest.fixture(scope="module")
def stress(compiled):
    return compiled([compiled.here / "stress.c", *sorted(compiled.native.rglob("*.c"))], *OPTIONS)


@pytest.fixture(scope="module")
def stress_loops(compiled):
    """Return the program of the loops, of a third of the library: it calls nothing that reads a resource."""
    folders = ("films", "grids", "heat", "loops", "solvers")
    sources = [path for name in folders for path in sorted((compiled.native / name).glob("*.c"))]
    program = compiled.here / "stress_loops.c"
    return compiled([program, *sources], *OPTIONS, "-no-pie", "-Wl,--unresolved-symbols=ignore-all")


def resources(tmp_path, contents):
    for number, content in enumerate(contents):
        folder = tmp_path / f"resource {number}"
        folder.mkdir()
        (folder / FILE_NAME).write_bytes(content)
        yield str(folder)


def run(program, *arguments):
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=1"}
    environment.pop("LD_PRELOAD", None)
    # Against an endless loop only: with sanitizers and other work on the machine it may well take minutes.
    return subprocess.run(
        [program, *arguments], capture_output=True, text=True, check=False, env=environment, timeout=3600
    )


def fault(program, *arguments):
    """Return how a program failed; nothing where it did not."""
    ran = run(program, *arguments)
    return f"{ran.returncode}: {ran.stderr[-4000:]}" if ran.returncode else ""


@pytest.mark.long
def test_no_misuse_and_no_damaged_file_breaks_an_instance(unzipped, stress, tmp_path):
    token = "a token"
    grooved = RoughGrooves(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    models = (small_bearing(), grooved, system(), run_up(), state_space(), *bushes())
    good = [unzipped(m, folder=str(k), token=token) for k, m in enumerate(models)]
    plain, openings, whole = (folder.resource.read_bytes() for folder in good[:3])
    worn = [folder.resource.read_bytes() for folder in good[5:]]
    contents = (*damaged(plain), *damaged(openings), *damaged(whole), *impossible(openings))
    bad = list(resources(tmp_path, contents))
    missing = tmp_path / "missing"
    shutil.rmtree(missing, ignore_errors=True)
    (tmp_path / "maybe").mkdir()
    maybe = resources(
        tmp_path / "maybe",
        (
            *mutated(plain, 300),
            *mutated(openings, 300),
            *mutated(whole, 300),
            *(content for bush in worn for content in mutated(bush, 30)),
        ),
    )
    folders = [str(folder.resource.parent) for folder in good]
    ran = run(stress, token, "60000", *folders, "--", *bad, str(missing))
    assert ran.returncode == 0, ran.stderr[-4000:]
    assert "messages" in ran.stdout
    assert not fault(stress, token, "200", "--", "--", *maybe)


@pytest.mark.long
@pytest.mark.parametrize("made", [grid_bearing, dam_bearing, fed_damper, porous_damper, driven_system])
def test_no_misuse_and_no_damaged_file_breaks_a_film_or_a_machine(made, unzipped, stress, tmp_path):
    good = unzipped(made(), folder="grid", token="a token").resource
    content = good.read_bytes()
    maybe = [str(folder) for folder in resources(tmp_path, mutated(content, 60))]
    assert not fault(stress, "a token", "400", str(good.parent), "--", "--", *maybe[:30])
    assert not fault(stress, "a token", "40", "--", "--", *maybe[30:])


def ring_numbers(film, slenderness, extrapolated):
    """Yield the numbers of a ring in the order of stress_loops.c."""
    spans, grids = film.grids(slenderness)
    flags = film.cavitation.searched, film.cavitation.clipped, spans.pinned, spans.turning, extrapolated
    yield from (slenderness, *flags, len(spans.start), *spans.start, *spans.extent)
    for grid in grids:
        yield from (len(grid.span), len(grid.width), *grid.span, *grid.line, *grid.face)
        yield from (*grid.held, *grid.value, *grid.width, *grid.conductance)


@pytest.mark.parametrize(("grooves", "extrapolated"), [((), True), ((Groove(center=1.5, width=0.4),), False)])
def test_no_numbers_break_a_loop_over_films(stress_loops, tmp_path, grooves, extrapolated):
    film = replace(grid_bearing(), grooves=grooves, supply_pressure=0.0).fitted_film
    path = tmp_path / "ring.txt"
    numbers = ring_numbers(film, 0.3, extrapolated)
    path.write_text(" ".join(repr(float(number)) for number in numbers), encoding="utf-8")
    assert not fault(stress_loops, str(path), "80")


@pytest.mark.long
def test_wrong_token_is_refused(unzipped, stress):
    folder = unzipped(run_up(), token="right")
    assert not fault(stress, "right", "0", str(folder.resource.parent))
    assert not fault(stress, "wrong", "0", "--", str(folder.resource.parent))
