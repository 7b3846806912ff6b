"""Pictures of films: dampers and their orbits, the melting bush, pressure and temperature over a film."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ..analysis import BistableMap, OrbitBranch, OrbitsOverSpeed, SynchronousOrbits
from ..bearings.damper import DamperTurn, JFOOrbit
from ..bearings.journal import FilmState, HeatedState, JFOState
from ..bearings.linear import TabulatedBearing
from ..bearings.thrust import SectorPressure
from ..core.errors import InputError
from ..core.model import Array
from ..core.units import CELSIUS
from .picture import ColorScale, CurveMark, FieldMark, LevelMark, Mark, Picture, PicturePanel, closed

Curves = Mapping[str, tuple[np.ndarray, np.ndarray]]

RPM = np.pi / 30.0


def plot_critical_speed(curves: Curves) -> Picture:
    """Describe critical speeds, relative to that of the unworn bush, over half the contact angle.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, angle [rad] and speed ratio [1], each of shape (n,).
    """
    marks = [CurveMark(*curve, label, f"C{k}") for k, (label, curve) in enumerate(curves.items())]
    text = "half contact angle [rad]", "critical speed / that of the unworn bush"
    return Picture((PicturePanel(marks, *text, "Critical speed of the bush as it wears"),))


def plot_contact_pressure(curves: Curves, *, assumed: Curves | None = None, modulus: float) -> Picture:
    """Describe contact pressures over the angle from the load line.

    Parameters
    ----------
    curves : mapping of str to (ndarray, ndarray)
        Label, angle [rad] and pressure [Pa], each of shape (n,).
    assumed : mapping of str to (ndarray, ndarray), optional
        Pressures of an assumed shape, by the labels of `curves`; dashed in the same color.
    modulus : float [Pa]
        Unit of the vertical axis.
    """
    marks = []
    for k, (label, (angle, pressure)) in enumerate(curves.items()):
        marks.append(CurveMark(angle, pressure / modulus, label, f"C{k}"))
        if assumed is not None and label in assumed:
            x, y = assumed[label]
            marks.append(CurveMark(x, y / modulus, "", f"C{k}", "--", 1.0))
    text = "angle from the load line [rad]", "pressure / shear modulus"
    return Picture((PicturePanel(marks, *text, "Contact pressure of the bush as it wears"),))


# An unbalanced rotor on a damper: response to the unbalance and over speed, transient, bistable region.


def plot_transmissibility(orbits: Mapping[str, SynchronousOrbits], *, unit: float) -> Picture:
    """Describe the transmissibility of all orbits over the unbalance; unstable ones are dotted.

    Parameters
    ----------
    orbits : mapping of str to SynchronousOrbits
        Label and orbits over many unbalances.
    unit : float [kg m]
        Mass times clearance, the scale of the unbalance.
    """
    marks = _response(orbits, unit, lambda branch: branch.transmissibility)
    return _over_unbalance(
        [LevelMark(1.0, color="0.6"), *marks], "force on housing / unbalance force", "Transmissibility"
    )


def plot_eccentricity(orbits: Mapping[str, SynchronousOrbits], *, unit: float) -> Picture:
    """Describe the eccentricity ratio of all orbits over the unbalance, a cross where they touch the wall.

    Parameters are those of `plot_transmissibility`.
    """
    marks = _response(orbits, unit, lambda branch: branch.eccentricity_ratio)
    last = max((float(np.asarray(one.x).max(initial=0.0)) for one in marks), default=0.0)
    for number, found in enumerate(orbits.values()):
        if found.contact_unbalance is not None and found.contact_unbalance / unit <= 1.05 * last:
            marks.append(CurveMark([found.contact_unbalance / unit], [1.0], "", f"C{number}", "", marker="x"))
    return _over_unbalance(marks, "eccentricity ratio", "Orbit radius", (0.0, 1.0))


def plot_phase(orbits: Mapping[str, SynchronousOrbits], *, unit: float) -> Picture:
    """Describe the lag of all orbits over the unbalance; parameters as in `plot_transmissibility`."""
    marks = _response(orbits, unit, lambda branch: -np.degrees(branch.phase))
    return _over_unbalance(marks, "phase lag [deg]", "Lag of the displacement behind the unbalance")


def _over_unbalance(
    marks: Sequence[Mark], label: str, title: str, limits: tuple[float, float] | None = None
) -> Picture:
    return Picture((PicturePanel(marks, "unbalance / (mass * clearance)", label, title, y_limits=limits),))


def _response(
    orbits: Mapping[str, SynchronousOrbits], unit: float, value: Callable[[OrbitBranch], np.ndarray]
) -> list[CurveMark]:
    """Return stable branches as lines and unstable ones dotted."""
    marks = []
    for number, (label, found) in enumerate(orbits.items()):
        shown = label
        for branch in found.branches:
            for kept, dash in ((branch.stable, "-"), (~branch.stable, ":")):
                if np.any(kept):
                    y = np.where(kept, value(branch), np.nan)
                    marks.append(CurveMark(branch.unbalance / unit, y, shown, f"C{number}", dash, 1.3))
                    shown = ""
    return marks


def plot_damper_speeds(result: OrbitsOverSpeed) -> Picture:
    """Describe a damper over speed [rpm] at one unbalance: eccentricity ratio and transmissibility.

    Filled dots are stable orbits, open ones unstable; where there are three at a speed, the rotor may jump.
    """
    found = result.orbits
    speeds, stable = (
        np.array([one.speed for one in found]) / RPM,
        np.array([one.stable for one in found], dtype=bool),
    )
    size = np.array([one.eccentricity_ratio for one in found])
    force = np.array([one.transmissibility for one in found])

    def dots(values: Array, label: str, color: str) -> list[CurveMark]:
        return [
            CurveMark(speeds[at], values[at], text, color, "", marker="o", filled=filled)
            for at, filled, text in ((stable, True, label), (~stable, False, f"{label}, unstable"))
            if at.any()
        ]

    above = PicturePanel(
        dots(size, "eccentricity ratio", "C0"), "", "eccentricity ratio", y_limits=(0.0, 1.0)
    )
    below: list[Mark] = [*dots(force, "transmissibility", "C1"), LevelMark(1.0, color="0.6")]
    panels = above, PicturePanel(below, "speed [rpm]", "force on housing / unbalance force")
    return Picture(
        panels, size=(7.4, 2.9), title=f"Damper over speed, unbalance {1e6 * result.unbalance:.4g} g mm"
    )


def plot_transmitted(runs: Curves) -> Picture:
    """Describe the transmitted force over time.

    Parameters
    ----------
    runs : mapping of str to (ndarray, ndarray)
        Label, angle turned by the shaft [rad] and force on the housing / unbalance force [1], each (n,).
    """
    marks = [CurveMark(*run, label, f"C{k}", width=1.3) for k, (label, run) in enumerate(runs.items())]
    text = "speed * time [rad]", "force on housing / unbalance force", "Transmitted force over time"
    return Picture((PicturePanel(marks, *text),))


def plot_damper_run(time: np.ndarray, eccentricity_ratio: np.ndarray, force: np.ndarray) -> Picture:
    """Describe the motion of a rotor on a damper over time: eccentricity ratio, and force on a second axis.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
    eccentricity_ratio : ndarray, shape (n,) [1]
    force : ndarray, shape (n,) [N]
        Force on the housing.
    """
    marks: list[Mark] = [
        CurveMark(time, eccentricity_ratio, "eccentricity ratio", "C0", width=1.3),
        LevelMark(1.0, color="0.6"),
        CurveMark(time, force, "force on housing", "C1", width=0.9, right=True),
    ]
    text = "time [s]", "eccentricity ratio", "Rotor on a damper"
    return Picture((PicturePanel(marks, *text, right="force on housing [N]", y_limits=(0.0, 1.05)),))


def plot_damper_turn(turn: DamperTurn) -> Picture:
    """Describe where a damper that conserves its oil is empty, around it and over a turn, half-way along it.

    A line is where the rotor is nearest to the wall.
    """
    order = np.argsort(turn.angle)
    place, turned = np.degrees(turn.angle[order]), turn.time / turn.time[-1]
    middle = turn.oil_content[:, order, turn.axial.size // 2]
    nearest = np.degrees(np.arctan2(turn.position[1], turn.position[0]) % (2.0 * np.pi))
    jump = np.abs(np.diff(nearest, append=nearest[0])) > 180.0
    marks: list[Mark] = [
        FieldMark(place, turned, middle, ColorScale("share of the gap that is oil", "YlGnBu", 0.0, 1.0)),
        CurveMark(np.where(jump, np.nan, nearest), turned, "least gap", "C1", width=1.3),
    ]
    text = "angle from +x towards +y [deg]", "turns", "Oil over a turn"
    return Picture((PicturePanel(marks, *text, x_limits=(0.0, 360.0)),))


def plot_bistable(found: BistableMap) -> Picture:
    """Describe the bistable region, between the unbalances of the jump up and of the fall back."""
    marks: list[Mark] = []
    for k, spring in enumerate(found.spring_ratio):
        up, down = found.jump_up[:, k], found.jump_down[:, k]
        known = np.isfinite(up) & np.isfinite(down)
        region = closed(found.squeeze_number[known], down[known], up[known])
        marks.append(CurveMark(*region, "", f"C{k}", "", fill=0.15))
        marks.append(CurveMark(found.squeeze_number, up, f"spring ratio {spring:g}", f"C{k}"))
        marks.append(CurveMark(found.squeeze_number, down, "", f"C{k}", "--"))
    text = "squeeze number", "unbalance / (mass * clearance)", "Two stable orbits"
    return Picture((PicturePanel(marks, *text),))


# Pressure and temperature over a film, load and film over the circumference, coefficients over speed.


PRESSURE, WARM = "pressure [MPa]", "temperature [degC]"

ACROSS = 61
"""Distances from the bush at which the temperature across a film is shown."""


def plot_film(state: FilmState | JFOState | JFOOrbit) -> Picture:
    """Describe the pressure [MPa] of a film, unwrapped: the angle in the bearing, and from end to end.

    Of a film that conserves its oil there is a line too around what is not full; that of a damper is drawn
    in axes that turn with its orbit, and with its mirror image where a groove is at one end.
    """
    if state.angle is None or state.axial is None or state.pressure is None:
        raise InputError("state must have a pressure field, as that of a ReynoldsFilm, got one without")
    full = state.oil_content if isinstance(state, JFOState | JFOOrbit) else None
    origin = "the line of centers in the sense of +z" if isinstance(state, JFOOrbit) else "+x towards +y"
    pressure = _field(state.angle, state.axial, 1e-6 * state.pressure, PRESSURE, full)
    panel = _over_film(pressure, "Pressure of the film", f" from {origin}")
    return Picture((panel,), size=(8.0, 4.0))


def plot_circumference(state: FilmState | HeatedState) -> Picture:
    """Describe the largest pressure along the axis [MPa] and the film thickness [um] over the angle [deg].

    The area under the pressure is the load that the film carries.
    """
    pressure, film = state.pressure, getattr(state, "thickness", None)
    if isinstance(state, HeatedState):
        film = _gap(state, state.angle)
    if film is None or pressure is None or state.angle is None:
        raise InputError("state must have pressure and thickness, as that of a ReynoldsFilm, got one without")
    order = np.argsort(state.angle)
    angle = np.degrees(state.angle[order])
    highest = 1e-6 * pressure[order].max(axis=1)
    marks: list[Mark] = [
        CurveMark(*closed(angle, 0.0 * angle, highest), "", "C3", "", fill=0.2),
        CurveMark(angle, highest, "pressure", "C3"),
        CurveMark(angle, 1e6 * film[order], "film thickness", "C0", "--", right=True),
    ]
    text = "angle from +x towards +y [deg]", "largest pressure along the axis [MPa]", "Load and film"
    panel = PicturePanel(
        marks, *text, right="film thickness [um]", x_limits=(0.0, 360.0), right_limits=(0.0, None)
    )
    return Picture((panel,), size=(8.0, 4.0))


def plot_pad_pressure(found: SectorPressure, *, title: str = "Pressure on a pad") -> Picture:
    """Describe the pressure [MPa] on one pad of a thrust bearing over angle [deg] and radius [mm]."""
    field = FieldMark(
        np.degrees(found.angle), 1e3 * found.radius, 1e-6 * found.pressure.T, ColorScale(PRESSURE)
    )
    panel = PicturePanel([field], "angle from +x towards +y [deg]", "radius [mm]", title)
    return Picture((panel,), size=(8.0, 4.0))


def _temperature_panel(state: HeatedState) -> PicturePanel:
    T = state.oil_temperature if state.oil_temperature.ndim == 2 else state.oil_temperature.mean(axis=-1)
    title = "Temperature, mean across; white: edge of the full film"
    return _over_film(_field(state.angle, state.axial, T - CELSIUS, WARM, state.filled), title)


def _pressure_panel(state: HeatedState) -> PicturePanel:
    return _over_film(
        _field(state.angle, state.axial, 1e-6 * state.pressure, PRESSURE, state.filled), "Pressure"
    )


def _across_panel(state: HeatedState) -> PicturePanel:
    """Describe the temperature across a film in the middle of the bearing."""
    if state.oil_temperature.ndim != 3:
        raise InputError("state must be that of a film with LayeredTemperature(...), got a mean")
    order = np.argsort(state.angle)
    angle, T = state.angle[order], state.oil_temperature[order, 0] - CELSIUS
    gap = 1e6 * _gap(state, angle)
    height = np.linspace(0.0, gap.max(), ACROSS)
    layer = (height[:, None] / gap * T.shape[1]).astype(int)
    inside = layer < T.shape[1]
    shown = np.where(inside, np.take_along_axis(T.T, np.where(inside, layer, 0), axis=0), np.nan)
    marks: list[Mark] = [
        FieldMark(np.degrees(angle), height, shown, ColorScale(WARM, "inferno")),
        CurveMark(np.degrees(angle), gap, "journal", "k"),
    ]
    text = "angle [deg]", "distance from the bush [um]", "Temperature in the middle of the bearing"
    return PicturePanel(marks, *text, x_limits=(0.0, 360.0))


def _gap(state: HeatedState, angle: Array) -> Array:
    """Return the film's thickness [m]: the clearance less the journal's displacement towards the angle."""
    x, y = state.position
    return np.asarray(state.film.clearance - x * np.cos(angle) - y * np.sin(angle))


def plot_temperature_field(state: HeatedState) -> Picture:
    """Describe the temperature of a film, its mean across the gap, over angle and length.

    A white line is the edge of the film that fills the gap.
    """
    return Picture((_temperature_panel(state),), size=(8.0, 4.0))


def plot_pressure_field(state: HeatedState) -> Picture:
    """Describe the pressure of a film over angle and length; white as in `plot_temperature_field`."""
    return Picture((_pressure_panel(state),), size=(8.0, 4.0))


def plot_temperature_across(state: HeatedState) -> Picture:
    """Describe the temperature across a film in the middle of the bearing, over angle and distance.

    Raises
    ------
    InputError
        If the state has one temperature across its film.
    """
    return Picture((_across_panel(state),), size=(8.0, 4.0))


def plot_heated_film(state: HeatedState, *, title: str = "") -> Picture:
    """Describe a film that warms: temperature, pressure and, with layers, the temperature across it."""
    across = (_across_panel(state),) if state.oil_temperature.ndim == 3 else ()
    panels = (_temperature_panel(state), _pressure_panel(state), *across)
    return Picture(panels, size=(9.0, 3.2), title=title)


def _over_film(field: FieldMark, title: str, origin: str = "") -> PicturePanel:
    """Return the axes of a field over angle and length, from end to end."""
    z = np.asarray(field.y)
    limits = {"x_limits": (0.0, 360.0), "y_limits": (float(z[0]), float(z[-1]))}
    return PicturePanel([field], f"angle{origin} [deg]", "axial position [mm]", title, **limits)  # type: ignore[arg-type]


def _field(angle: Array, axial: Array, values: Array, label: str, full: Array | None) -> FieldMark:
    """Return a field on its nodes, both halves of the bearing, and in white the edges of the full film."""
    order = np.argsort(angle)
    # A node in the middle of the bearing is no part of the mirror image.
    mirrored = slice(None, 0 if axial[0] == 0.0 else None, -1)

    def whole(half: Array) -> Array:
        return np.concatenate([half[order][:, mirrored], half[order]], axis=1).T

    z = 1e3 * np.concatenate([-axial[mirrored], axial])
    scale = ColorScale(label, "inferno" if label == WARM else "viridis")
    contour = None if full is None or np.min(full) >= 1.0 else whole(full)
    return FieldMark(np.degrees(angle[order]), z, whole(values), scale, contour, 0.999)


def plot_coefficients(table: TabulatedBearing) -> Picture:
    """Describe stiffness [MN/m] and damping [kN s/m] of a bearing over speed [rpm]; dashed where negative."""
    speeds, panels = np.asarray(table.speeds) / RPM, []
    for letter, name, unit, values in (
        ("K", "stiffness", "MN/m", 1e-6 * np.asarray(table.stiffness)),
        ("C", "damping", "kN s/m", 1e-3 * np.asarray(table.damping)),
    ):
        marks = []
        for k, (row, column) in enumerate(np.ndindex(values.shape[1:])):
            entry, label = values[:, row, column], f"{letter}{table.freedoms[row]}{table.freedoms[column]}"
            for sign, dash in ((1.0, "-"), (-1.0, "--")):
                if (sign * entry > 0.0).any():
                    shown = np.where(sign * entry > 0.0, np.abs(entry), np.nan)
                    marks.append(
                        CurveMark(speeds, shown, label if sign > 0.0 else f"-{label}", f"C{k % 10}", dash)
                    )
        panels.append(PicturePanel(marks, "speed [rpm]", f"{name} [{unit}]", log="y", legend="beside"))
    return Picture(tuple(panels), size=(7.4, 3.4))
