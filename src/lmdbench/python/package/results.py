# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Result files as pandas frames. Names are those of the file (results/README.md), which the figures' readers share: a
dataset (N) is the column of its name, one of (N, 3) the columns name_x, name_y, name_z. `frame.attrs["units"]` has the unit
of every column but the axes of a sweep, whose names end in it; a value that was not measured is NaN."""

from __future__ import annotations

import json

import h5py
import numpy as np
import pandas as pd

from . import InputError
from .result_file import Result, ResultError, open_h5

OF_SEARCHES = ("global_frame", "candidates", "kept_after_reduction")
AXES = {2: ("_0", "_1"), 3: ("_x", "_y", "_z"), 4: ("_x", "_y", "_z", "_w")}


class ResultFrames:
    """One file of `lmdbench run`. `methods` are the labels of its methods; `result` is the reader behind it.

    Raises InputError for a file that is none, is unfinished, or is of a format that this version cannot read.
    """

    def __init__(self, file: str) -> None:
        self.result = _or_input_error(Result, file)
        self.methods: list[str] = list(self.result.methods)

    def frames(self, method: str) -> pd.DataFrame:
        """A row a haptic frame: time, force, counts, distances, the counters of the frame's local part."""
        group = self._group(method)
        rows = self.result.time.size
        table = self._table(group, rows, also={"time": self.result.h5["/path/time"]})
        table.index.name = "frame"
        return table

    def movers(self, method: str) -> pd.DataFrame:
        """A row a mover and frame, where several meshes move: frame, mover (0: the moving mesh), its pose at this method, what it felt.
        Empty where not."""
        group = self._group(method)
        if "movers" not in group:
            return pd.DataFrame()
        poses = _datasets(self.result.h5["/path/movers"])
        datasets = {name: (item, item[()]) for name, item in {**poses, **_datasets(group["movers"])}.items()}
        if "path" in group:  # in a closed loop the method moves the moving mesh, and the column has what was meant
            for name in poses:
                datasets[name][1][:, 0] = group[f"path/{name}"][()]
        frames, movers = datasets["position"][1].shape[:2]
        columns = {"frame": np.repeat(np.arange(frames), movers), "mover": np.tile(np.arange(movers), frames)}
        units = {"frame": "1", "mover": "1"}
        for name, (item, values) in datasets.items():
            endings = AXES[values.shape[2]] if values.ndim == 3 else ("",)
            for ending, column in zip(endings, values.reshape(frames * movers, -1).T):
                columns[name + ending] = column
                units[name + ending] = _unit(item)
        table = pd.DataFrame(columns)
        table.attrs["units"] = units
        return table

    def searches(self, method: str) -> pd.DataFrame:
        """A row a global search (methods that track locally): frame, candidates, what was kept, the search's counters."""
        group = self._group(method)
        if "global_frame" not in group:
            return pd.DataFrame()
        columns = {name: group[name] for name in OF_SEARCHES if name in group}
        if "global_counters" in group:
            columns.update({f"global_counters/{name}": item for name, item in _datasets(group["global_counters"]).items()})
        return _frame(columns, group["global_frame"].shape[0])

    def times(self, method: str) -> pd.DataFrame:
        """A row a frame, a column a repetition that counts [s]: of the local part of the frame."""
        samples = _or_input_error(self._method(method).times, "local_update_time")
        table = pd.DataFrame(samples.T)
        table.index.name, table.columns.name = "frame", "repetition"
        table.attrs["units"] = {column: "s" for column in table}
        return table

    def truth(self, method: str) -> pd.DataFrame:
        """A row a frame that was compared with truth: recall, precision, errors. Empty without a truth probe."""
        group = self._group(method)
        return _frame(_datasets(group["truth"]), group["truth/frame"].shape[0]) if "truth" in group else pd.DataFrame()

    def lmds(self, method: str) -> pd.DataFrame:
        """A row an LMD, with its frame; where the run recorded them (/record/lmds). Empty where not."""
        group = self._group(method)
        if "lmds" not in group:
            return pd.DataFrame()
        offsets = group["lmds/frame_offset"][()]
        columns = {name: item for name, item in _datasets(group["lmds"]).items() if name != "frame_offset"}
        table = _frame(columns, int(offsets[-1]))
        table.insert(0, "frame", np.repeat(np.arange(offsets.size - 1), np.diff(offsets)))
        table.attrs["units"]["frame"] = "1"
        return table

    def summary(self) -> pd.DataFrame:
        """A row a method, a column a reported number."""
        rows = {}
        units: dict[str, str] = {}
        for label in self.methods:
            if "summary" not in self._group(label):
                _or_input_error(self.result.read, f"/methods/{label}/summary/recall")  # its error says why
            numbers = _datasets(self._group(label)["summary"])
            rows[label] = {name: float(np.ravel(item[()])[0]) for name, item in numbers.items()}
            units.update({name: _unit(item) for name, item in numbers.items()})
        table = pd.DataFrame.from_dict(rows, orient="index")
        table.index.name = "method"
        table.attrs["units"] = units
        return table

    def _method(self, label: str):  # type: ignore[no-untyped-def]
        return _or_input_error(self.result.method, label)

    def _group(self, label: str) -> h5py.Group:
        self._method(label)
        return self.result.h5[f"/methods/{label}"]

    def _table(self, group: h5py.Group, rows: int, also: dict[str, h5py.Dataset]) -> pd.DataFrame:
        columns = {**also, **{name: item for name, item in _datasets(group).items() if name not in OF_SEARCHES}}
        if "counters" in group:
            columns.update({f"counters/{name}": item for name, item in _datasets(group["counters"]).items()})
        return _frame(columns, rows)


def sweep_frame(file: str) -> pd.DataFrame:
    """A row a point of `lmdbench work-precision`: scene, series, method, the values of its axes by their places in the
    experiment, its numbers, and why it has none (failure)."""
    with _or_input_error(open_h5, file) as h5:
        if "sweep" not in h5:
            raise InputError(f"{file}: is no sweep (remedy: name a file that `lmdbench work-precision` wrote)")
        points = _datasets(h5["points"])
        table = _frame({name: item for name, item in points.items() if name not in ("axes", "experiment")}, points["scene"].size)
        axes = [json.loads(text) for text in points["axes"].asstr()[()]]
    for place in dict.fromkeys(place for chosen in axes for place in chosen):
        table[place] = [chosen.get(place) for chosen in axes]
    return table


def _or_input_error(make, argument):  # type: ignore[no-untyped-def]
    """The figures' readers have an error of their own; its text stays."""
    try:
        return make(argument)
    except ResultError as error:
        raise InputError(str(error)) from None


def _datasets(group: h5py.Group) -> dict[str, h5py.Dataset]:
    return {name: item for name, item in group.items() if isinstance(item, h5py.Dataset)}


def _unit(dataset: h5py.Dataset) -> str:
    unit = dataset.attrs.get("units", "1")
    return unit.decode() if isinstance(unit, bytes) else str(unit)


def _frame(datasets: dict[str, h5py.Dataset], rows: int) -> pd.DataFrame:
    """The datasets with that many rows; those of other lengths (searches) and samples of times are not of this table."""
    columns, units = {}, {}
    for name, item in datasets.items():
        if name.endswith("_time") or item.ndim not in (1, 2) or item.shape[0] != rows or (item.ndim == 2 and item.shape[1] not in AXES):
            continue
        values = item[()] if item.dtype.kind != "O" else item.asstr()[()]
        for ending, column in zip(AXES[item.shape[1]], values.T) if item.ndim == 2 else [("", values)]:
            columns[name + ending] = column
            units[name + ending] = _unit(item)
    table = pd.DataFrame(columns, index=pd.RangeIndex(rows))
    table.attrs["units"] = units
    return table
