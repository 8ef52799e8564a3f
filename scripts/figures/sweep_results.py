# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reading what `lmdbench work-precision` wrote: a point a row, with its axes and numbers."""

import copy
import json
import math
import shlex

import h5py
import numpy as np

from lmdbench_results import MISSES_ALL, NOT_JUDGED, ResultError, misses_all, open_h5, text, texts_of


def is_sweep(file):
    """Whether the file is a sweep's and not a run's; False for what cannot be read, which others complain about."""
    try:
        with h5py.File(file, "r") as h5:
            return "sweep" in h5
    except OSError:
        return False


def commit_of(build):
    """Short, with a word where the program was built from something else than the commit."""
    return str(build.get("git_commit", "unknown"))[:12] + (" with local changes" if build.get("git_dirty") == "yes" else "")


class Point:
    """A method with the values of its axes in a scene; numbers by name, NaN for what was not measured. Points of one `problem`
    (results/README.md) are asked the same and can be compared."""

    def __init__(self, sweep, index):
        self.sweep = sweep
        self.index = index
        self.scene, self.series, self.method, self.force_law, self.failure, self.result_hash = (
            sweep.texts[name][index] for name in ("scene", "series", "method", "force_law", "failure", "result_hash"))
        self.problem = sweep.texts.get("problem", sweep.texts["scene"])[index]
        self.axes = json.loads(sweep.texts["axes"][index])

    def number(self, name):
        return float(self.sweep.columns[name][self.index])

    def counter(self, name):
        column = self.sweep.counters.get(name)
        return float(column[self.index]) if column is not None else math.nan

    def axis(self, name):
        """The value of the axis whose place ends in the name; None where the point has no such axis."""
        return next((value for place, value in self.axes.items() if place.rsplit("/", 1)[-1] == name), None)

    @property
    def experiment(self):
        return json.loads(self.sweep.texts["experiment"][self.index])

    @property
    def force_error(self):
        """Root mean square of the force error as a share of F_max of one LMD."""
        return self.number("force_error_rms_n") / self.number("maximum_force_n")

    @property
    def trouble(self):
        """Why the point stands in the lane of failures; empty where it does not."""
        if self.failure:
            return self.failure
        if not math.isfinite(self.number("force_error_rms_n")):
            return NOT_JUDGED
        return MISSES_ALL if misses_all(self.number("recall"), self.force_error) else ""

    @property
    def period(self):
        """Frames from a search to the next; 1 for a method that searches in every frame."""
        return self.experiment["driver"]["search_every_frames"] if self.number("candidates") > 0 else 1

    def words(self, but=()):
        """A text for each axis, without those whose place ends in one of `but`."""
        shown = {place.rsplit("/", 1)[-1]: value for place, value in self.axes.items()}
        if shown.get("search_every_frames") == shown.get("search_latency_frames"):
            shown.pop("search_latency_frames", None)
        names = {"search_every_frames": "a search every {} frames"}
        return [names.get(name, name.replace("_", " ") + " {}").format(value) for name, value in shown.items() if name not in but]

    def text(self):
        return ", ".join([self.series, *self.words()])


class Sweep:
    """One file of `lmdbench work-precision`, read as a whole."""

    def __init__(self, file):
        self.file = str(file)
        remedy = "(remedy: name a file that `lmdbench work-precision` wrote)"
        try:
            with open_h5(self.file) as h5:
                if "sweep" not in h5:
                    raise ResultError(f"{self.file}: is no sweep of lmdbench {remedy}")
                self.texts, self.columns = {}, {}
                for name, dataset in h5["points"].items():
                    values = dataset[()]
                    if dataset.dtype.kind == "O":
                        self.texts[name] = [str(text(value)) for value in values]
                    else:
                        self.columns[name] = values
                self.counters = {name: dataset[()] for name, dataset in h5.get("counters", {}).items()}
                attributes, self.provenance = texts_of(h5["sweep"].attrs), texts_of(h5["provenance"].attrs)
                self.definition = str(text(np.ravel(h5["provenance/experiment"][()])[0])) if "provenance/experiment" in h5 else ""
                words = [str(text(word)) for word in h5["provenance/argv"][()]] if "provenance/argv" in h5 else []
                self.machine = texts_of(h5["provenance/machine"].attrs) if "provenance/machine" in h5 else {}
        except OSError as error:
            raise ResultError(f"{self.file}: cannot be read: {error} {remedy}")
        self.command = shlex.join(["lmdbench", *(words[1:] or ["work-precision"])])
        self.sweep_name = attributes["name"]
        self.title = attributes["title"] or self.sweep_name
        self.name = self.sweep_name  # variants get a longer one (variants.py)
        self.clock_overhead_ns = 1e9 * float(attributes["clock_overhead_s"])
        self.points = [Point(self, index) for index in range(len(self.texts["scene"]))]

    @property
    def experiment(self):
        return json.loads(self.definition or "{}")

    @property
    def scenes(self):
        return list(dict.fromkeys(point.scene for point in self.points))

    @property
    def problems(self):
        return list(dict.fromkeys(point.problem for point in self.points))

    @property
    def series(self):
        return list(dict.fromkeys(point.series for point in self.points))

    def of(self, scene=None, series=None, problem=None):
        return [point for point in self.points
                if scene in (None, point.scene) and series in (None, point.series) and problem in (None, point.problem)]

    def restricted(self, scene):
        """The same sweep with the points of one scene; all of it where no scene is named."""
        if not scene:
            return self
        part = copy.copy(self)
        part.points = [point for point in self.points if point.scene == scene]
        return part

    def samples(self, point, name):
        with h5py.File(self.file, "r") as h5:
            return h5[f"samples/{point.index}/{name}"][()]

    def commit(self):
        return commit_of(self.provenance)


class Line:
    """Points of one series and problem that one axis tells apart, in its order. What else varies is the same in all of them."""

    def __init__(self, points, place, fixed):
        self.points, self.place, self.fixed = points, place, fixed

    def value(self, point):
        """Of the axis, and of what tells the line from its neighbours."""
        values = [point.axes[place] for place in ([self.place] if self.place else []) + self.fixed]
        return ", ".join(str(value) for value in values)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def lines(points):
    """The lines of points of one series and problem: along the numeric axis with most values; every other axis that varies, and
    every axis of words, parts them. An axis that goes with another one (its values pair off) is the same axis."""
    varying = {place: [point.axes.get(place) for point in points] for place in dict.fromkeys(p for point in points for p in point.axes)}
    varying = {place: values for place, values in varying.items() if len({json.dumps(value) for value in values}) > 1}
    leaders = []
    for place, values in varying.items():
        texts = [json.dumps(value) for value in values]
        pairs = [{(a, b) for a, b in zip(texts, [json.dumps(value) for value in varying[other]])} for other in leaders]
        if not any(len(found) == len({a for a, _ in found}) == len({b for _, b in found}) for found in pairs):
            leaders.append(place)
    numeric = [place for place in leaders if all(is_number(value) for value in varying[place])]
    place = max(numeric, key=lambda name: len(set(varying[name])), default=None)
    fixed = [name for name in leaders if name != place]
    groups = {}
    for point in points:
        groups.setdefault(json.dumps([point.axes.get(name) for name in fixed]), []).append(point)
    return [Line(sorted(group, key=lambda point: point.axes[place]) if place else group, place, fixed) for group in groups.values()]


def front(points, cost, error):
    """Points that no other one beats in both, by falling error."""
    usable = sorted((point for point in points if not point.trouble and np.isfinite(cost(point)) and np.isfinite(error(point))),
                    key=lambda point: (cost(point), error(point)))
    best, kept = math.inf, []
    for point in usable:
        if error(point) < best:
            kept.append(point)
            best = error(point)
    return kept


def along_period(points):
    """[(what tells a group from the others, in words; its points)] of groups in which the period of search alone differs."""
    groups = {}
    for point in points:
        groups.setdefault(tuple(point.words(but=("search_every_frames",))), []).append(point)
    shared = set.intersection(*map(set, groups)) if groups else set()
    return [([word for word in words if word not in shared], group) for words, group in groups.items()]


def crossing(points, reference, value):
    """Period of search at which the value of a series falls below that of the reference, interpolated log-log between
    the points on both sides; NaN where it does not within the points."""
    line = sorted(((point.period, value(point)) for point in points if not point.trouble))
    for (before, high), (after, low) in zip(line, line[1:]):
        if high > reference >= low:
            share = math.log(high / reference) / math.log(high / low)
            return math.exp(math.log(before) + share * math.log(after / before))
    return math.nan
