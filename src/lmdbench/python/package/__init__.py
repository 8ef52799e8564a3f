# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Local minimum distance pairs (LMDs) of two triangle meshes.

    import lmdbench
    sets = lmdbench.query("peg.off", "hole.stl", "path.tum", cutoff=0.002)
    sets[0]["distance"]            # (n) metres, rising
    sets[0]["point_moving"]        # (n, 3) metres, world frame

Lengths are metres, forces newtons, in world coordinates; N counts poses, V vertices, T triangles. Arrays that come back are
read-only views of the memory that the search left its results in; `.copy()` one to write into it. Long calls let other
threads of Python run, and end at Ctrl-C. What is refused raises `Error` with the text that the program `lmdbench` prints.
"""

from __future__ import annotations

import enum
import json
import os
import sys
from collections.abc import Sequence
from typing import NamedTuple, Optional, Union, overload

import numpy as np
import numpy.typing as npt

try:
    from . import _lmdbench
except ImportError as error:
    raise ImportError(
        f"{os.path.dirname(os.path.abspath(__file__))} holds no compiled module for this Python ({sys.implementation.cache_tag}): "
        f"{error} (remedy: 'pip install .' in lmdbench's tree with this Python, or the Python that the module was built for)"
    ) from None
from ._lmdbench import EnvironmentError, Error, InputError, UsageError, __version__

__all__ = ["Agreement", "EnvironmentError", "Error", "FeatureKind", "Forces", "InputError", "LMD_DTYPE", "LmdSets", "Mesh",
           "Search", "UsageError", "agreement", "forces", "method_names", "open_result", "open_sweep", "query", "read_tum",
           "truth", "__version__"]

#: Of a set: distance (m), point_moving, point_fixed (3, m), direction (3, moving to fixed point),
#: feature_moving, feature_fixed (kind: a FeatureKind, index), fixed_body (its mesh), intersecting.
#: Where triangles intersect, the distance is 0 and the direction NaN.
LMD_DTYPE: np.dtype = _lmdbench.LMD_DTYPE

FileName = Union[str, "os.PathLike[str]"]
MeshLike = Union["Mesh", FileName, "tuple[npt.ArrayLike, npt.ArrayLike]"]
MeshesLike = Union[MeshLike, "list[Mesh]", "list[FileName]", "list[str]", "list[tuple[npt.ArrayLike, npt.ArrayLike]]", "list[MeshLike]"]
PosesLike = Union[npt.ArrayLike, FileName]


class FeatureKind(enum.IntEnum):
    """What `feature_moving["kind"]` counts: rows of `Mesh.vertices`, `Mesh.edges` or `Mesh.triangles`."""

    VERTEX = 0
    EDGE = 1
    FACE = 2


class Mesh:
    """A mesh made ready for searches; immutable, to be used in any number of them.

    Mesh(file)                  OFF, PLY, OBJ, STL; glTF 2 where the build has assimp. Vertices of one position are
                                welded, those without triangles left out.
    Mesh(vertices, triangles)   (V, 3) metres and (T, 3) whole numbers, counter-clockwise seen from outside; features count
                                the caller's rows. Vertices without triangles count for nothing, and stand at a corner of
                                one. A triangle without area that closes a T junction is flipped with the
                                one beside it, one with a side as short as rounding collapses, and all keep their
                                rows: see `triangles` and `findings`.

    planar_tolerance: how far vertices of one plane may have left it, and are put back: "auto" (what single-precision
    coordinates leave), "off", metres ("1e-6") or a share of the diagonal ("0.0001%"). name: for messages.

    Raises InputError naming the vertex, triangle or line, UsageError for an array of another shape.
    """

    def __init__(self, source: Union[FileName, npt.ArrayLike], triangles: Optional[npt.ArrayLike] = None, *,
                 planar_tolerance: str = "auto", name: str = "mesh") -> None:
        if triangles is None:
            if not isinstance(source, (str, os.PathLike)):
                raise UsageError("mesh: vertices without triangles (remedy: give both, or the name of a file)")
            self._mesh = _lmdbench.Mesh.from_file(os.fspath(source), planar_tolerance)
        else:
            self._mesh = _lmdbench.Mesh.from_arrays(_array(source, f"{name}: vertices"), _array(triangles, f"{name}: triangles"),
                                                    planar_tolerance, name)

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """(V, 3) metres, after planes were put back."""
        return self._mesh.vertices

    @property
    def triangles(self) -> npt.NDArray[np.int32]:
        """(T, 3) rows of `vertices`."""
        return self._mesh.triangles

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """(E, 2) rows of `vertices`, the smaller one first, in the order that features of kind EDGE count."""
        return self._mesh.edges

    @property
    def findings(self) -> list[str]:
        """What a reader of its LMDs should know: open borders, triangles without area, ...; empty for a sound solid."""
        return self._mesh.findings


class LmdSets(Sequence[np.ndarray]):
    """One structured array of LMD_DTYPE a pose, by rising distance."""

    def __init__(self, sets: _lmdbench.Sets, times: npt.NDArray[np.float64]) -> None:
        self._sets = sets
        self.times = times  #: (N) seconds of a TUM file; 0, 1, 2, ... of an array

    def __len__(self) -> int:
        return len(self._sets)

    @overload
    def __getitem__(self, index: int) -> np.ndarray: ...
    @overload
    def __getitem__(self, index: slice) -> list[np.ndarray]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[np.ndarray, list[np.ndarray]]:
        if isinstance(index, slice):
            return [self._sets.array(i) for i in range(*index.indices(len(self)))]
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError(f"pose {index} of {len(self)}")
        return self._sets.array(place)

    @property
    def counts(self) -> npt.NDArray[np.int64]:
        """(N) LMDs of each pose."""
        return np.array([lmds.size for lmds in self], dtype=np.int64)

    @property
    def minimum_distance(self) -> npt.NDArray[np.float64]:
        """(N) smallest distance of each pose, metres; NaN where there is no LMD."""
        return np.array([lmds["distance"][0] if lmds.size else np.nan for lmds in self])

    @property
    def seconds(self) -> npt.NDArray[np.float64]:
        """(N) what the search of each pose took."""
        return self._sets.seconds


class Search:
    """A method on a pair of meshes, or on one and several fixed ones, to be asked for many poses.

    Takes what `query` takes; prepares the meshes once. Threads may share one: they wait for each other.
    """

    def __init__(self, moving: MeshLike, fixed: MeshesLike, cutoff: float, method: str = "certified",
                 **options: object) -> None:
        several = fixed if isinstance(fixed, list) else [fixed]
        self.moving = as_mesh(moving, "moving")  #: a Mesh
        self.fixed = [as_mesh(mesh, "fixed") for mesh in several]  #: a list of Mesh
        self._search = _lmdbench.Search(self.moving._mesh, [mesh._mesh for mesh in self.fixed], float(cutoff), method,
                                        _json_of(options))

    def __call__(self, poses: PosesLike) -> LmdSets:
        """The LMD sets of all poses: (N, 4, 4), (4, 4) or the name of a TUM file."""
        chosen = as_poses(poses)
        return LmdSets(self._search.at(chosen), chosen.times)


def _array(values: npt.ArrayLike, name: str) -> npt.NDArray[np.generic]:
    try:
        return np.asarray(values)
    except ValueError as error:  # rows of unlike lengths
        raise UsageError(f"{name}: no array: {error} (remedy: rows of one length)") from None


def _plain(value: object) -> object:
    """numpy's numbers as Python's, for JSON."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"an option of type {type(value).__name__} (remedy: a text, a number or a truth value)")


def _json_of(options: dict[str, object]) -> str:
    for name, value in options.items():
        try:
            json.dumps(value, default=_plain, allow_nan=False)
        except ValueError:
            raise UsageError(f"options: {name}: {value} is no value of an option (remedy: a finite number)") from None
    return json.dumps(options, default=_plain)


def as_mesh(mesh: MeshLike, name: str = "mesh") -> Mesh:
    """The mesh itself, of a file, or of a pair (vertices, triangles)."""
    if isinstance(mesh, Mesh):
        return mesh
    if isinstance(mesh, (str, os.PathLike)):
        return Mesh(mesh)
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return Mesh(*mesh, name=name)
    raise UsageError(f"{name}: a {type(mesh).__name__} is no mesh (remedy: give a file name, a pair (vertices, triangles) or a "
                     "Mesh)")


def as_poses(poses: PosesLike) -> _lmdbench.Poses:
    if isinstance(poses, (str, os.PathLike)):
        return _lmdbench.Poses.from_tum(os.fspath(poses))
    return _lmdbench.Poses.from_matrices(_array(poses, "poses"))


def query(moving: MeshLike, fixed: MeshesLike, poses: PosesLike, cutoff: float,
          method: str = "certified", **options: object) -> LmdSets:
    """The LMD set of every pose.

    moving, fixed: a file name, a pair (vertices (V, 3), triangles (T, 3)) or a Mesh; several fixed ones as a list.
    poses:   X_WM of the moving mesh, (N, 4, 4) or (4, 4), for column vectors; or the name of a TUM file.
    cutoff:  LMDs up to this distance [m], above 0.
    method:  one of `method_names()`; options are its own (`lmdbench query --help`). `certified` reuses work of the pose
             before, unless frame_coherence=False.

    Returns a sequence of N structured arrays (LMD_DTYPE), without copying them.
    Raises UsageError, InputError (a mesh, path or pose), EnvironmentError (a method that the build lacks).
    """
    return Search(moving, fixed, cutoff, method, **options)(poses)


def truth(moving: MeshLike, fixed: MeshesLike, poses: PosesLike, cutoff: float) -> LmdSets:
    """Ground truth: the sets that looking at every triangle pair finds. Arguments and result as of `query`; slow."""
    return query(moving, fixed, poses, cutoff, method="exhaustive")


class Agreement(NamedTuple):
    """How sets agree with the true ones: counts by pose (N), to be summed before a ratio is taken."""

    true_lmds: npt.NDArray[np.int64]  #: LMDs of the true set
    found: npt.NDArray[np.int64]  #: true LMDs that a reported one matches
    reported: npt.NDArray[np.int64]  #: LMDs of the reported set
    right: npt.NDArray[np.int64]  #: reported LMDs that a true one matches

    @property
    def recall(self) -> float:
        """Share of all true LMDs that were found; NaN where there is none."""
        return _share(self.found, self.true_lmds)

    @property
    def precision(self) -> float:
        """Share of all reported LMDs that are true; NaN where there is none."""
        return _share(self.right, self.reported)


def _share(part: npt.NDArray[np.int64], whole: npt.NDArray[np.int64]) -> float:
    return float(part.sum() / whole.sum()) if whole.sum() > 0 else float("nan")


def agreement(true_sets: LmdSets, sets: LmdSets, *, neighbouring: bool = False) -> Agreement:
    """Compares sets of the same poses and meshes, feature pair by feature pair.

    neighbouring: features that share a triangle with the true ones count, too.
    Raises UsageError for sets of other poses (to rounding), meshes or cutoffs.
    """
    counts = _lmdbench.agreements(true_sets._sets, sets._sets, neighbouring)
    return Agreement(*counts.T)


class Forces(NamedTuple):
    """What the fixed meshes exert on the moving one, by pose, world frame, not clipped by any device."""

    force: npt.NDArray[np.float64]  #: (N, 3) newtons
    torque: npt.NDArray[np.float64]  #: (N, 3) newton metres about the reference point
    stiffness: npt.NDArray[np.float64]  #: (N) N/m, for a motion along the force


def forces(sets: LmdSets, cutoff: float, maximum_force: float, *, law: str = "exponential", saturation_distance: float = 0.0,
           sharpness: float = 4.0, reference: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Forces:
    """The sum of the LMDs' forces: each pushes the moving mesh away along its direction. Those without one, where triangles
    intersect, add nothing; `lmdbench run` keeps the last direction that an LMD had.

    cutoff:              no force at or beyond it [m]; not above that of the search
    maximum_force:       of one LMD, at or below `saturation_distance` [m] [N]
    law:                 "linear" or "exponential" with `sharpness`
    reference:           (3) or (N, 3), about which the torque is taken [m]
    Raises UsageError for constants that no force can have.
    """
    return Forces(*_lmdbench.forces(sets._sets, law, float(cutoff), float(saturation_distance), float(maximum_force),
                                    float(sharpness), _array(reference, "reference")))


def method_names() -> list[str]:
    """Methods of this build, in the order of reports."""
    return _lmdbench.method_names()


def read_tum(file: FileName) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Times (N) [s] and poses (N, 4, 4) of a TUM trajectory. Raises InputError naming the line."""
    poses = _lmdbench.Poses.from_tum(os.fspath(file))
    return poses.times, poses.matrices


def open_result(file: FileName):  # type: ignore[no-untyped-def]
    """A result file of `lmdbench run`, as pandas frames: see `lmdbench.results.ResultFrames`."""
    from .results import ResultFrames
    return ResultFrames(os.fspath(file))


def open_sweep(file: FileName):  # type: ignore[no-untyped-def]
    """The points of a file of `lmdbench work-precision`, a pandas frame: see `lmdbench.results.sweep_frame`."""
    from .results import sweep_frame
    return sweep_frame(os.fspath(file))
