# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the page's plots draw and what their CSV files hold: time series of a result, as little-endian single-precision
numbers in base64, so that 6,000 frames of a series are 32 kB of page; times are in double precision, as clocks may count from long ago."""

import base64

import numpy as np

import figure_style as style
from lmdbench_results import reference_force, true_forces, truth_of

# Lines must be visible on a white and on a dark page.
ON_BOTH = {style.BLACK: "#777777"}
RANGE_MARGIN = 1.05
DASHES = (None, [9, 6], [3, 6], [9, 6, 3, 6], [20, 6], [9, 6, 3, 6, 3, 6])
PERCENT_RANGE = [0.0, 105.0]
LIMIT_RANGE = 1.2  # room above the line for its label
RECALL_WINDOW = 40  # probed frames: one frame's recall is mostly 0 or 1


def encoded(values, kind="<f4"):
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")


def series(label, values, colour, **look):
    return {"label": label, "values": encoded(values), "colour": colour, **look}


def at_frames(result, frames, values):
    """(N) the values at their frames, NaN between them."""
    full = np.full(result.time.size, np.nan)
    full[frames] = values
    return full


def held(result, frames, values):
    """(N) the value of the last of `frames` up to each frame; NaN before the first."""
    if frames.size == 0:
        return np.full(result.time.size, np.nan)
    index = np.searchsorted(frames, np.arange(result.time.size), side="right") - 1
    return np.where(index >= 0, np.asarray(values, dtype=float)[np.maximum(index, 0)], np.nan)


def moving_recall(truth):
    """(K) share of the true LMDs of the last RECALL_WINDOW probed frames that the method has; NaN if it promises no set."""
    found = np.cumsum(np.where(truth.true_count > 0, truth.recall, 0.0) * truth.true_count)
    true = np.cumsum(truth.true_count)
    before = np.maximum(np.arange(found.size) - RECALL_WINDOW, -1)
    window_found = found - np.where(before >= 0, found[before], 0.0)
    window_true = true - np.where(before >= 0, true[before], 0.0)
    return np.where(window_true > 0, window_found / np.maximum(window_true, 1), np.nan)


def force_panel(result, colours):
    lines = []
    for name, method in true_forces(result.methods.values()):  # below the others
        frames, force = reference_force(method)
        lines.append(series(name, at_frames(result, frames, force), style.TRUTH_COLOURS[method.force_law], marks=True))
    lines += [series(method.label, method.force_magnitude(), colours[method.label]) for method in result.methods.values()]
    panel = {"id": "force", "title": "Force", "unit": "N", "series": lines}
    limit, highest = result.scene("device_maximum_force_n"), drawn_values(panel).max(initial=0.0)
    if 0.0 < 0.99 * limit <= highest:
        panel["limit"] = {"value": limit, "label": f"device limit {limit:g} N"}
        panel["range"] = [0.0, LIMIT_RANGE * float(highest)]
    return panel


def movers_panel(result, colours):
    lines = []
    for method in result.methods.values():
        if method.has("movers/force"):
            lengths = np.linalg.norm(method.read("movers/force"), axis=2)
            lines.append(series(method.label, lengths.max(axis=1), colours[method.label]))
    return {"id": "movers", "title": "Largest force on any mover", "unit": "N", "series": lines} if lines else None


def count_panel(result, colours):
    lines = [series(method.label, method.read("lmd_count"), colours[method.label], steps=True)
             for method in result.methods.values()]
    return {"id": "lmds", "title": "LMDs within the cutoff", "unit": "1", "series": lines}


def search_panel(result, colours):
    lines = []
    for method in result.methods.values():
        if method.searches_every_frame():
            continue
        frames = method.read("global_frame").astype(int)
        total = np.nan_to_num(method.median_times("global_search_time"))
        if method.has("first_reduction_time"):
            total = total + np.nan_to_num(method.median_times("first_reduction_time"))
        lines.append(series(method.label, held(result, frames, total * 1e3), colours[method.label], steps=True))
    return {"id": "search", "title": "Global search with first reduction", "unit": "ms", "series": lines} if lines else None


def update_panel(result, colours):
    lines = [series(method.label, method.median_times("local_update_time") * 1e6, colours[method.label])
             for method in result.methods.values()]
    return {"id": "update", "title": "Local update", "unit": "us", "log": True, "series": lines}


def age_panel(result, colours):
    """Methods whose searches are due together have one age: all lines but the first are dashed, so that each is seen."""
    methods = [method for method in result.methods.values() if method.has("lmd_age") and not method.searches_every_frame()]
    lines = [series(method.label, method.read("lmd_age") * 1e3, colours[method.label], steps=True, dash=DASHES[i % len(DASHES)])
             for i, method in enumerate(methods)]
    return {"id": "age", "title": "Age of the LMD set in use", "unit": "ms", "series": lines} if lines else None


def recall_panel(result, colours):
    lines, probed = [], 0
    for method in result.methods.values():
        truth = truth_of(method)
        if truth is not None:
            probed = max(probed, truth.frames.size)
            lines.append(series(method.label, held(result, truth.frames, 100.0 * moving_recall(truth)), colours[method.label], steps=True))
    title = f"True LMDs known, {f'in the last {RECALL_WINDOW} probed frames' if probed > RECALL_WINDOW else 'in the probed frames so far'}"
    return {"id": "recall", "title": title, "unit": "%", "range": PERCENT_RANGE, "series": lines} if lines else None


PANELS = (force_panel, movers_panel, count_panel, search_panel, update_panel, age_panel, recall_panel)


def page_colours(result):
    """{label: colour} as in the figures."""
    return {label: ON_BOTH.get(colour, colour) for label, colour in style.colours_of(result.methods.values()).items()}


def drawn_values(panel):
    values = np.concatenate([np.frombuffer(base64.b64decode(line["values"]), dtype="<f4") for line in panel["series"]])
    return values[np.isfinite(values) & (values > 0 if panel.get("log") else True)]


def panels_of(results):
    """The panels of each result; those of variants of one experiment, which are there to be compared, with one range of values."""
    made, same = [time_panels(result) for result in results], {}
    for result, entry in zip(results, made):
        for panel in entry["panels"]:
            same.setdefault((result.experiment_name, panel["id"]), []).append(panel)
    for panels in (panels for (_, panel), panels in same.items() if len(panels) > 1 and panel != "recall"):
        values = np.concatenate([drawn_values(panel) for panel in panels])
        if values.size and values.max() > 0:
            for panel in panels:
                margin = LIMIT_RANGE if any("limit" in other for other in panels) else RANGE_MARGIN
                panel["range"] = [float(values.min()) if panel.get("log") else 0.0, margin * float(values.max())]
    return made


def time_panels(result):
    """The panels of Figure 7 and those that go beyond it; what a result does not hold has no panel."""
    colours = page_colours(result)
    panels = [panel for panel in (make(result, colours) for make in PANELS) if panel]
    rounds = style.rounds_of(result.methods.values())
    for line in (line for panel in panels for line in panel["series"]):
        if number := rounds.get(line["label"], 0):
            line.setdefault("dash", DASHES[number % len(DASHES)])
    return {"name": result.name, "time": encoded(result.time, "<f8"), "panels": panels}
