"""Pictures of a shaft: the rotor to scale, mode shapes in two planes and in space."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from ..analysis import DeflectedShape, RotorModes
from ..analysis.rotor_modes import senses
from ..bearings.films.geometry import Pad
from ..bearings.thrust import SectorPads
from ..core.errors import InputError
from ..core.inputs import arguments
from ..rotors import Coupling, ShaftElement, ShaftRotor
from ..rotors.shaft_elements import LayeredElement, ShaftPiece
from .picture import CurveMark, LevelMark, Mark, NoteMark, Picture, PicturePanel, circle

RPM, HERTZ = math.pi / 30.0, 2.0 * math.pi

STEEL = "#8fa3b5"
_CIRCLE = 1e-6
"""Share of an orbit that is no circle, below which it has no longest direction."""


_STILL = 1e-6
"""Deflection / the largest, below which a node has no orbit."""


@arguments
def plot_rotor(rotor: ShaftRotor, bearings: Mapping[str, object] | None = None) -> Picture:
    """Describe a rotor to scale [mm]: elements, disks, bearings, seals, probes and unbalances.

    A disk is drawn as the solid one with its mass and moments of inertia.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction, optional
        Bearings by station; seals, by the name of their class, are drawn as combs and not as triangles.
    """
    z, radii = 1e3 * rotor.positions, _radii(rotor)
    tall = max(radii)
    marks: list[Mark] = list(_elements(rotor))
    for k, disk in enumerate(rotor.disks):
        if disk.mass > 0.0:
            height = 1e3 * math.sqrt(2.0 * disk.polar_inertia / disk.mass) or 2.0 * radii[disk.node]
            squares = 12.0 * (disk.diametral_inertia - 0.5 * disk.polar_inertia) / disk.mass
            width = max(1e3 * math.sqrt(max(squares, 0.0)), 0.01 * z[-1])
            box = _box(z[disk.node] - 0.5 * width, z[disk.node] + 0.5 * width, -height, height)
            marks.append(CurveMark(*box, "" if k else "disk", "#4c72b0", width=0.8, fill=0.6))
            tall = max(tall, height)
    for station in rotor.stations:
        seal = "Seal" in type((bearings or {}).get(station.name)).__name__
        at, low = z[station.node], -radii[station.node]
        label, marker = ("seal", "s") if seal else ("bearing", "^")
        known = any(isinstance(one, CurveMark) and one.label == label for one in marks)
        marks.append(
            CurveMark([at], [low - 0.05 * tall], "" if known else label, "C2", "", marker=marker, size=9.0)
        )
        marks.append(NoteMark(float(at), float(low - 0.3 * tall), station.name, "C2"))
    for label, parts, color, marker, above in (
        ("unbalance", rotor.unbalances, "C3", "*", 0.1),
        ("probe", rotor.probes, "C4", "v", 0.35),
    ):
        nodes = [one.node for one in parts]
        if nodes:
            heights = [radii[node] + above * tall for node in nodes]
            marks.append(CurveMark(z[nodes], heights, label, color, "", marker=marker, size=8.0))
    marks.append(LevelMark(0.0, color="0.3", dash="-."))
    text = "along the shaft [mm]", "radius [mm]", f"Rotor of {rotor.mass:.4g} kg"
    return Picture((PicturePanel(marks, *text, equal=True, legend="beside"),), size=(9.0, 4.0))


def _box(left: float, right: float, low: float, high: float) -> tuple[list[float], list[float]]:
    return [left, right, right, left, left], [low, low, high, high, low]


def _layers(element: ShaftPiece) -> tuple[ShaftElement, ...]:
    """Return the layers of an element; none of a coupling, whose size is not known."""
    if isinstance(element, Coupling):
        return ()
    return element.layers if isinstance(element, LayeredElement) else (element,)


def _radii(rotor: ShaftRotor) -> list[float]:
    """Return the radius of the shaft at each node [mm], the largest beside it; 0 between couplings."""
    outer = [
        max((500.0 * one.outer_diameter for one in _layers(part)), default=0.0) for part in rotor.elements
    ]
    return [max(pair) for pair in zip([0.0, *outer], [*outer, 0.0], strict=True)]


def _elements(rotor: ShaftRotor) -> Iterator[CurveMark]:
    z = 1e3 * rotor.positions
    for left, right, element in zip(z, z[1:], rotor.elements, strict=False):
        for layer in _layers(element):
            outer, inner = 500.0 * layer.outer_diameter, 500.0 * layer.inner_diameter
            for side in (1.0, -1.0):
                yield CurveMark(
                    *_box(left, right, side * inner, side * outer), "", STEEL, width=0.6, fill=0.5
                )


OUTSIDE = 1.3
"""Outer radius of a bearing as it is drawn / that of its shaft."""


def plot_bearing(bearing: Any) -> Picture:
    """Describe a bearing to scale [mm]: a section across, with its pads and grooves, and one along.

    The film is too thin to be seen. Around the bore is a wall of a thickness that nobody gave.

    Parameters
    ----------
    bearing : object
        With a radius and a length; of balls with their number, diameter and pitch diameter; or sector pads
        of a thrust bearing, which are seen along the shaft.
    """
    if isinstance(bearing, SectorPads):
        return _plot_sectors(bearing)
    balls = getattr(bearing, "balls", 0)
    radius = 500.0 * bearing.pitch_diameter if balls else 1e3 * bearing.radius
    length = 1e3 * bearing.ball_diameter if balls else 1e3 * bearing.length
    across = [_filled(_ring(0.0, 2.0 * math.pi, 0.0, radius - 0.5 * length * bool(balls)), "shaft", STEEL)]
    if balls:
        wheel = [circle(0.5 * length)] * balls
        angles = 2.0 * math.pi * np.arange(balls) / balls
        across += [
            one._replace(
                x=one.x + radius * math.cos(at), y=one.y + radius * math.sin(at), label="" if at else "ball"
            )
            for one, at in zip(wheel, angles, strict=True)
        ]
    else:
        geometry = getattr(bearing, "geometry", None)
        pads = getattr(geometry, "pads", ()) or (Pad(start=0.0, extent=2.0 * math.pi),)
        across += [
            _filled(_ring(pad.start, pad.extent, radius, OUTSIDE * radius), "" if k else "bearing", "#4c72b0")
            for k, pad in enumerate(pads)
        ]
        for k, groove in enumerate(getattr(bearing, "grooves", ())):
            arc = groove.center - 0.5 * groove.width, groove.width, radius, 1.1 * radius
            across.append(_filled(_ring(*arc), "" if k else "groove", "w"))
    outer, inner = (radius + 0.5 * length, radius - 0.5 * length) if balls else (OUTSIDE * radius, radius)
    along = [_filled(_box(-0.8 * length, 0.8 * length, -inner, inner), "", STEEL)]
    along += [
        _filled(_box(-0.5 * length, 0.5 * length, side * inner, side * outer), "", "#4c72b0")
        for side in (1, -1)
    ]
    panels = (
        PicturePanel(across, "x [mm]", "y [mm]", f"radius {radius:.4g} mm", equal=True, legend="none"),
        PicturePanel(
            along, "along the shaft [mm]", "y [mm]", f"length {length:.4g} mm", equal=True, legend="none"
        ),
    )
    return Picture(panels, columns=2, size=(4.2, 4.0))


def _plot_sectors(bearing: SectorPads) -> Picture:
    """Describe the pads of a thrust bearing as seen along the shaft, with their pivots."""
    inner, outer = 1e3 * bearing.inner_radius, 1e3 * bearing.outer_radius
    starts = bearing.start + 2.0 * math.pi / bearing.pads * np.arange(bearing.pads)
    marks = [_filled(_ring(0.0, 2.0 * math.pi, 0.0, 0.9 * inner), "shaft", STEEL)]
    marks += [_filled(_ring(at, bearing.pad_arc, inner, outer), "", "#4c72b0") for at in starts]
    marks[1] = marks[1]._replace(label="pad")
    if bearing.tilts:
        middle, radius = starts + bearing.origin * bearing.pad_arc, 1e3 * bearing.pivot_radius
        pivots = radius * np.cos(middle), radius * np.sin(middle)
        marks.append(CurveMark(*pivots, "pivot", "k", "", marker="x"))
    text = f"{bearing.pads} pads of {math.degrees(bearing.pad_arc):.4g} deg, {inner:.4g} to {outer:.4g} mm"
    panel = PicturePanel(marks, "x [mm]", "y [mm]", text, equal=True, legend="beside")
    return Picture((panel,), size=(5.4, 4.0))


def _filled(polygon: tuple[Any, Any], label: str, color: str) -> CurveMark:
    return CurveMark(*polygon, label, color, width=0.8, fill=0.6)


def _ring(start: float, extent: float, inner: float, outer: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the closed outline of a sector of a ring."""
    angle = start + extent * np.linspace(0.0, 1.0, 73)
    there_and_back = np.concatenate([angle, angle[::-1], angle[:1]])
    radius = np.concatenate([np.full(73, outer), np.full(73, inner), [outer]])
    return radius * np.cos(there_and_back), radius * np.sin(there_and_back)


@arguments
def plot_mode_shape(rotor: ShaftRotor, modes: RotorModes, number: int) -> Picture:
    """Describe one whirl mode along a shaft at the moment of its largest deflection, in both planes.

    Parameters
    ----------
    rotor : ShaftRotor
    modes : RotorModes
        Modes of this rotor.
    number : int
        Place of the mode in `modes`, from 0.

    Raises
    ------
    InputError
        If there is no such mode.
    """
    return _in_planes(_mode(rotor, modes, number))


@arguments
def plot_mode_orbits(rotor: ShaftRotor, modes: RotorModes, number: int) -> Picture:
    """Describe one whirl mode in space: the shaft at its largest deflection, and the orbits of its nodes.

    A dot on each orbit is where the shaft is; blue orbits are forward, red ones backward.

    Parameters
    ----------
    rotor, modes, number
        As in `plot_mode_shape`.
    """
    return _in_space(_mode(rotor, modes, number))


def plot_deflected_shape(found: DeflectedShape) -> Picture:
    """Describe the response to unbalance along a shaft [um] at the moment of its largest deflection."""
    return _in_planes(_response(found))


def plot_deflected_orbits(found: DeflectedShape) -> Picture:
    """Describe the same in space, with the orbits of the nodes, as `plot_mode_orbits` does."""
    return _in_space(_response(found))


class _Shape(NamedTuple):
    """Deflections of the nodes as phasors, turned to where the largest is real."""

    positions: np.ndarray
    bearings: np.ndarray
    x: np.ndarray
    y: np.ndarray
    speed: float
    unit: str
    title: str


def _in_planes(one: _Shape) -> Picture:
    marks: list[Mark] = [
        CurveMark(one.positions, one.x.real, "x", "#1f4fb4", marker="o", size=3.0),
        CurveMark(one.positions, one.y.real, "y", "#d62728", "--", marker="s", size=3.0),
        CurveMark(one.bearings, 0.0 * one.bearings, "bearing", "k", "", marker="^"),
        LevelMark(0.0),
    ]
    return Picture((PicturePanel(marks, "along the shaft [m]", f"deflection {one.unit}", one.title),))


def _in_space(one: _Shape) -> Picture:
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 73))
    marks: list[Mark] = [
        CurveMark(one.positions, one.x.real, "shaft", "k", width=2.0, z=one.y.real, marker="o", size=3.0)
    ]
    told = set()
    largest = np.sqrt(np.abs(one.x) ** 2 + np.abs(one.y) ** 2).max()
    for place, a, b in zip(one.positions, one.x, one.y, strict=True):
        if abs(a) + abs(b) <= _STILL * largest:
            continue
        forward = ((np.conj(a) * b).imag <= 0.0) != (one.speed < 0.0)
        label, color = ("forward", "C0") if forward else ("backward", "C3")
        orbit = np.full(73, place), (a * turn).real, "" if label in told else label, color
        marks.append(CurveMark(*orbit, width=0.9, z=(b * turn).real))
        told.add(label)
    ends, none, held = one.positions[[0, -1]], np.zeros(2), 0.0 * one.bearings
    marks.append(CurveMark(ends, none, "", "0.5", "-.", 1.0, z=none))
    marks.append(CurveMark(one.bearings, held, "bearing", "C2", "", marker="^", size=8.0, z=held))
    text = "along the shaft [m]", f"x {one.unit}", one.title, f"y {one.unit}"
    return Picture((PicturePanel(marks, *text),), size=(8.4, 6.0))


def _response(found: DeflectedShape) -> _Shape:
    turn = 1e6 * _turn(found.x, found.y)
    title = f"Response to unbalance at {found.speed / RPM:.0f} rpm, zero-to-peak"
    places = found.positions, found.bearings, turn * found.x, turn * found.y
    return _Shape(*places, found.speed, "[um]", title)


def _titled(modes: RotorModes, number: int) -> str:
    frequency, decrement = modes.frequency[number] / HERTZ, modes.log_decrement[number]
    return (
        f"Mode {number + 1}: {frequency:.4g} Hz at {modes.speed / RPM:.0f} rpm, "
        f"log decrement {decrement:.3g}, {senses(modes.direction)[number]}"
    )


def _mode(rotor: ShaftRotor, modes: RotorModes, number: int) -> _Shape:
    """Return the deflections of the nodes along x and y, real where they are largest, there 1."""
    if not 0 <= number < len(modes.eigenvalues):
        raise InputError(f"number must be from 0 to {len(modes.eigenvalues) - 1}, got {number!r}")
    n, nodes = len(rotor.assembly.coordinates), 2 * (len(rotor.elements) + 1)
    x, y = (modes.shapes[k : k + nodes : 2, number] for k in (0, n))
    turn = _turn(x, y) / np.sqrt(np.abs(x) ** 2 + np.abs(y) ** 2).max()
    held = rotor.positions[[station.node for station in rotor.stations]]
    title = _titled(modes, number)
    return _Shape(rotor.positions, held, turn * x, turn * y, modes.speed, "/ the largest", title)


def _turn(x: np.ndarray, y: np.ndarray) -> complex:
    """Return the phase, exp(i p), at which the node that moves most is farthest out; on a circle along x."""
    k = int(np.argmax(np.abs(x) ** 2 + np.abs(y) ** 2))
    # |Re(x e)|^2 + |Re(y e)|^2 is largest where x^2 + y^2 is turned to the real axis
    squares = x[k] ** 2 + y[k] ** 2
    circular = abs(squares) < _CIRCLE * (abs(x[k]) ** 2 + abs(y[k]) ** 2)
    return complex(np.exp(-1j * (np.angle(x[k]) if circular else 0.5 * np.angle(squares))))
