# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the rules of claim regions share: a setting holds, does not hold, or is undecided because its interval crosses a
threshold; a claim's verdict is made of its settings."""

import json
import math
from pathlib import Path

import numpy as np

from intervals import Rate
from tables import shown, table

HOLDS, FAILS, OPEN = "holds", "does not hold", "undecided"  # a setting
REPRODUCED, NOT_REPRODUCED, HOLDS_WHERE, NOT_MEASURED = "reproduced", "not reproduced", "holds where", "not measured"  # a claim, or OPEN
LEAST_REPETITIONS = 2  # one does not tell how far the next would lie from it
MEAN_EDGE_DIAGONAL = 0.0128  # of bunny-16k: `lmdbench mesh info bunny-16k`, mean edge / diagonal
MANIFEST = Path(__file__).resolve().parents[2] / "meshes" / "manifest.json"
BLOCK = 200  # frames that are resampled together: neighbours resemble each other


class Found:
    """What a claim's rule finds: rows of a table, {column: value}, and {setting in words: HOLDS, FAILS or OPEN}."""

    def __init__(self):
        self.rows, self.cells = [], {}

    def add(self, row, setting=None, cell=""):
        self.rows.append(row)
        if setting is not None:  # that two sweeps measured holds where it does in both
            self.cells[setting] = all_of(cell, self.cells.get(setting, cell))

    def table(self):
        return table(list(self.rows[0]), [row.values() for row in self.rows]) if self.rows else []


def span(values):
    """From the least to the largest; one number where both are shown alike."""
    return " to ".join(dict.fromkeys((shown(min(values)), shown(max(values)))))


def decide(low, high, at_least=None, at_most=None):
    """Verdict of an interval against one or two thresholds."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return OPEN
    if (at_least is None or low >= at_least) and (at_most is None or high <= at_most):
        return HOLDS
    if (at_least is not None and high < at_least) or (at_most is not None and low > at_most):
        return FAILS
    return OPEN


def all_of(*parts):
    """A setting of several parts."""
    return FAILS if FAILS in parts else OPEN if OPEN in parts else HOLDS


def of_repetitions(values):
    """(low, high) of what the repetitions say; no interval where there are too few of them, so that they decide nothing."""
    return (min(values), max(values)) if len(values) >= LEAST_REPETITIONS else (math.nan, math.nan)


def verdict(cells, why=""):
    """(verdict, its reason) of {setting in words: HOLDS, FAILS or OPEN}.
    @param why what the claim fails on where it fails everywhere"""
    good = [name for name, cell in cells.items() if cell == HOLDS]
    undecided = sum(cell == OPEN for cell in cells.values())
    if undecided == len(cells):
        return OPEN, "no setting has an interval on one side of its threshold"
    rest = f"; {undecided} undecided" if undecided else ""
    if not good:
        return NOT_REPRODUCED, f"in none of {len(cells)} settings{rest}" + (f": {why}" if why else "")
    if len(good) == len(cells):
        return REPRODUCED, f"in all {len(cells)} settings" if len(cells) > 1 else "in the one setting"
    return HOLDS_WHERE, "; ".join(by_group(good, cells)) + rest


def by_group(good, cells):
    """Settings in words; of a group ("GROUP | setting") whose settings all hold the name, of others the settings that hold."""
    words = {}
    for name in good:
        group, _, setting = name.partition(" | ")
        words.setdefault(group, []).append(setting)
    texts = []
    for group, settings in words.items():
        members = [cell for other, cell in cells.items() if other.startswith(group + " | ")]
        if settings == [""]:
            texts.append(group)
        elif all(cell == HOLDS for cell in members):
            texts.append(f"{group} (all {len(members)} settings)" if len(members) > 1 else f"{group}, {settings[0]}")
        elif len(settings) > 3:
            texts.append(f"{group} ({len(settings)} of {len(members)} settings)")
        else:
            texts.append(f"{group}, {' or '.join(settings)}")
    return texts


def cutoff_share(point):
    return point.experiment["force"].get("cutoff_diagonal", math.nan)


def in_edges(share):
    """A cutoff in mean edges of bunny-16k."""
    return shown(share / MEAN_EDGE_DIAGONAL, 2)


def tolerance(point):
    return point.experiment["methods"][0].get("g5_tolerance_deg")


def mesh(point):
    return point.experiment["moving"]["mesh"]


def triangles(name):
    """Of a mesh of the manifest; NaN for another one."""
    meshes = json.loads(MANIFEST.read_text(encoding="utf-8"))["meshes"]
    return meshes.get(name, {}).get("triangles", math.nan)


def mean_edges(point):
    """Its cutoff in mean edges of its mesh; the bunnies' edges shrink with the root of their number of triangles."""
    return shown(cutoff_share(point) / (MEAN_EDGE_DIAGONAL * math.sqrt(16298 / triangles(mesh(point)))), 2)


def rate(points, name):
    return Rate([point.number(name) for point in points], [point.number("seconds_in_contact") for point in points])


def usable(points):
    return [point for point in points if not point.failure]


def groups(points, *keys):
    """{values of the keys: points}, in order of appearance."""
    found = {}
    for point in usable(points):
        found.setdefault(tuple(key(point) for key in keys), []).append(point)
    return found


class Setting:
    """The paths of a series with its search period, G5 tolerance and cutoff."""

    def __init__(self, series, period, angle, share, points):
        self.series, self.period, self.share, self.points = series, period, share, points
        self.angle = "-" if angle is None else f"{angle:.0f}"
        self.columns = {"series": series, "search every [frames]": period, "G5 [deg]": self.angle, "cutoff [mean edges]": in_edges(share), "paths": len(points)}
        wider = ", Fig. 5 (a) with edge neighbours" if "edge-neighbours" in series else ""
        self.words = f"cutoff {in_edges(share)} mean edges, G5 {self.angle} deg{wider} | {schedule(period)}"


def settings(sweep):
    """[(setting, the points of `improved` under the same schedule and cutoff, or none)]; only one of `original` is held against them."""
    controls = groups(sweep.of(series="improved") + sweep.of(series="improved-cutoff"), lambda p: p.period, cutoff_share)
    found = [Setting(*key, points) for key, points in groups(sweep.points, lambda p: p.series, lambda p: p.period, tolerance, cutoff_share).items()]
    return [(one, controls.get((one.period, one.share), []) if one.series.startswith("original") else []) for one in found]


def schedule(period):
    return "a search in every frame" if period == 1 else f"a search every {period} frames"


def blocks(*columns):
    """Frames in blocks that are resampled together."""
    length = len(columns[0])
    return [tuple(column[begin:begin + BLOCK] for column in columns) for begin in range(0, length, BLOCK)]


def joined(rows, index):
    return np.concatenate([row[index] for row in rows])


def partner(point, sweep):
    """The point of `improved` under the same axes as one of `original`."""
    series = point.series.replace("original", "improved")
    return next((other for other in usable(sweep.of(scene=point.scene, series=series)) if other.axes == point.axes), None)
