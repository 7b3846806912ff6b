"""Models of a flexible shaft: from few shapes to fine meshes; one seen in the coordinates of another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate
from typing import Any

import numpy as np

from ...errors import InputError
from ...model import Array
from ..structure import FlexibleRotor, both_planes
from .beam import Beam, ClassicalBeam, FourthOrderBeam
from .elements import Coupling, LayeredElement, ShaftElement, ShaftPiece
from .reduced_rotor import ReducedRotor
from .shaft_rotor import ShaftRotor

REDUCED = (0, 2, 6)
"""Modes, in each plane, of the reduced models; none leaves the static shapes, which is Rayleigh's method."""

PIECES = (1, 2, 4, 8)
"""Elements into which the meshes split one of the file."""


@dataclass(frozen=True, kw_only=True)
class ShaftModel:
    """A model of the shaft of a file.

    Attributes
    ----------
    shaft : ShaftRotor
        With the elements of the file.
    beam : Beam
    pieces : int
        Elements for one of the file.
    modes : int or None
        Modes between the bearings that are kept; None for all.
    """

    shaft: ShaftRotor
    beam: Beam
    pieces: int = 1
    modes: int | None = None

    @property
    def name(self) -> str:
        """Number of modes beside the static shapes, or of elements and their kind if not that of the file."""
        if self.modes is not None:
            return f"{self.modes} modes" if self.modes else "static shapes"
        count = sum(len(pieces_of(element, self.pieces)) for element in self.shaft.elements)
        return f"{count} elements" if self.beam == self.shaft.beam else f"{count} elements, classical beam"

    @cached_property
    def mesh(self) -> ShaftRotor:
        """All elements, before anything is left out."""
        rotor = self.shaft if self.beam == self.shaft.beam else replace(self.shaft, beam=self.beam)
        return split(rotor, self.pieces)

    @cached_property
    def rotor(self) -> FlexibleRotor:
        """The rotor that is solved; InputError if it is to be reduced and its stations do not hold it."""
        if self.modes is None:
            return self.mesh
        rotor = self.mesh
        return ReducedRotor(rotor=rotor, modes=self.modes, speed=rotor.speed, gravity=rotor.gravity)

    @cached_property
    def quick(self) -> ShaftModel:
        """A model to look about with: this one, or a reduced one if its stations hold it."""
        return self if self.modes is not None else self.widest

    @cached_property
    def widest(self) -> ShaftModel:
        """The reduced model with most modes; this one if its stations do not hold it."""
        if not _known(self.shaft):
            return self
        small = ShaftModel(shaft=self.shaft, beam=self.shaft.beam, modes=_known(self.shaft)[-1])
        try:
            _ = small.rotor
        except InputError:
            return self
        return small

    @cached_property
    def finer(self) -> ShaftRotor:
        """What this model is judged by: elements half as long, of fourth order where they shear."""
        fine = split(self.mesh, 2)
        sheared = all(_shears(element) for element in self.shaft.elements)
        return replace(fine, beam=FourthOrderBeam()) if sheared else fine

    def nodal(self, shape: np.ndarray) -> np.ndarray:
        """Return a shape (N,) at the nodes of the file and the supports, both planes."""
        if isinstance(self.rotor, ReducedRotor):
            shape = both_planes(self.rotor.basis) @ shape
        return np.asarray(shape[self._file_places])

    def seen(self, nodal: np.ndarray) -> np.ndarray:
        """Return what a shape at the nodes of the file, as a load, is in the coordinates of this model."""
        load = np.zeros(len(self.mesh.structure.mass), dtype=nodal.dtype)
        load[self._file_places] = nodal
        return both_planes(self.rotor.basis).T @ load if isinstance(self.rotor, ReducedRotor) else load

    @cached_property
    def _file_places(self) -> Array:
        n, supports = len(self.mesh.structure.coordinates), len(self.mesh.structure.supports)
        nodes = _nodes([pieces_of(element, self.pieces) for element in self.shaft.elements])
        plane = [*(2 * node + k for node in nodes for k in (0, 1)), *range(n - supports, n)]
        return np.array([*plane, *(n + k for k in plane)])

    def lifted(self, shapes: np.ndarray) -> np.ndarray:
        """Return shapes (N, ...) of this model in the coordinates of `finer`; inside its elements 0."""
        if isinstance(self.rotor, ReducedRotor):
            shapes = both_planes(self.rotor.basis) @ shapes
        here, there = shared_places(self.mesh, self.finer)
        fine = np.zeros((len(self.finer.structure.mass), *shapes.shape[1:]), dtype=shapes.dtype)
        fine[there] = shapes[here]
        return fine


def shaft_models(shaft: ShaftRotor) -> tuple[ShaftModel, ...]:
    """Return the models of a shaft, the cheapest first: reduced ones, the classical element, meshes."""
    reduced = [ShaftModel(shaft=shaft, beam=shaft.beam, modes=modes) for modes in _known(shaft)]
    classical = [] if shaft.beam == ClassicalBeam() else [ShaftModel(shaft=shaft, beam=ClassicalBeam())]
    meshes = [ShaftModel(shaft=shaft, beam=shaft.beam, pieces=pieces) for pieces in PIECES]
    return (*reduced, *classical, *meshes)


def _known(shaft: ShaftRotor) -> list[int]:
    most = len(shaft.structure.coordinates) - len(shaft.stations) - len(shaft.structure.supports)
    return [modes for modes in REDUCED if modes < most]


def _shears(element: ShaftPiece) -> bool:
    if isinstance(element, Coupling):
        return True
    layers = element.layers if isinstance(element, LayeredElement) else (element,)
    return all(layer.shear_coefficient is None or np.isfinite(layer.shear_coefficient) for layer in layers)


def pieces_of(element: ShaftPiece, pieces: int) -> tuple[ShaftPiece, ...]:
    """Return an element in so many; a coupling has no length and stays one."""
    if isinstance(element, Coupling):
        return (element,)
    if isinstance(element, ShaftElement):
        return element.split(pieces)
    layers = zip(*(layer.split(pieces) for layer in element.layers), strict=True)
    return tuple(LayeredElement(layers=layer) for layer in layers)


def split(rotor: ShaftRotor, pieces: int) -> ShaftRotor:
    """Return the rotor with each element in so many pieces; what sits at nodes stays in place."""
    if pieces == 1:
        return rotor
    parts = [pieces_of(element, pieces) for element in rotor.elements]
    nodes = _nodes(parts)

    def moved(items: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(replace(item, node=nodes[item.node]) for item in items)

    return replace(
        rotor,
        elements=tuple(piece for part in parts for piece in part),
        disks=moved(rotor.disks),
        stations=moved(rotor.stations),
        tilt_springs=moved(rotor.tilt_springs),
        probes=moved(rotor.probes),
        unbalances=moved(rotor.unbalances),
    )


def _nodes(parts: Sequence[Sequence[ShaftPiece]]) -> list[int]:
    """Return the places of the nodes after a split."""
    return list(accumulate((len(part) for part in parts), initial=0))


def shared_places(coarse: ShaftRotor, fine: ShaftRotor) -> tuple[Array, Array]:
    """Return the coordinates, of both planes, that a mesh and the one split in halves have in common."""
    n, m = len(coarse.structure.coordinates), len(fine.structure.coordinates)
    supports = len(coarse.structure.supports)
    nodes = _nodes([pieces_of(element, 2) for element in coarse.elements])
    here = [*range(2 * len(nodes)), *range(n - supports, n)]
    there = [*(2 * node + k for node in nodes for k in (0, 1)), *range(m - supports, m)]
    return np.array([*here, *(n + k for k in here)]), np.array([*there, *(m + k for k in there)])
