# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the other reading of the paper's text would have changed, decision by decision (E1 to E13): the sweep
experiments/sweeps/readings.json, every variant beside the default under the same schedule; and, of a run with every LMD, the
decision on contacts without direction."""

import json
import math

import numpy as np

from lmdbench_results import law
from tables import shown, table

DECISIONS = {
    "e1": "leaf cones", "e2": "inequality of G3", "e3": "overlapping spheres", "e4": "line cone of the original",
    "e5": "G5 tolerance", "e6": "visibility", "e7": "reduction and its order", "e9": "exponential law", "e10": "clip",
    "e11": "second tracking", "e13": "duplicates", "figure": "Fig. 5 (a)", "g4": "feature points"}
OPTIONS = ("leaf_cones", "literal_g3", "clamped_sigma", "line_cone", "g5_tolerance_deg", "visibility", "tracking_order", "reduction",
           "second_tracking", "merge_duplicates", "face_neighbourhood", "feature_points")


def variation(point, default):
    """What differs from the default, in words."""
    options, usual = point.experiment["methods"][0], default.experiment["methods"][0]
    words = [f"{name} {json.dumps(options[name]).strip(chr(34))}" if not isinstance(options[name], float) else f"{name} {options[name]:.3g}"
             for name in OPTIONS if options.get(name) != usual.get(name)]
    force, usual_force = point.experiment["force"], default.experiment["force"]
    words += [f"{name} {force.get(name)}" for name in ("sharpness", "saturation_cutoff", "clip") if force.get(name) != usual_force.get(name)]
    return ", ".join(words) or "as decided"


def row(point, default, decision):
    same_as = point is not default and point.result_hash == default.result_hash
    seconds = point.number("seconds_in_contact")
    work = point.counter("leaf_pairs") / default.counter("leaf_pairs") if default.counter("leaf_pairs") else math.nan
    return [decision, point.scene, point.method, "**as decided**" if point is default else variation(point, default),
            "-" if point is default else "nothing" if same_as else "forces or sets", shown(100 * point.number("recall")),
            shown(100 * point.number("recall_adjacent")), shown(100 * point.number("precision")),
            f"{shown(point.number('lmd_count_mean'))} ({shown(point.number('true_lmd_count_mean'))})",
            f"{shown(point.number('force_mean_n'))} ({shown(point.number('true_force_mean_n'))})", shown(100 * point.force_error),
            shown(point.number("jumps") / seconds), shown(work), shown(point.number("candidates"))]


def readings(sweep, direction_memory=None):
    rows, failed = [], []
    for scene in sweep.scenes:
        for method in ("improved", "original"):
            default = sweep.of(scene, method)[0]
            rows.append(row(default, default, "-"))
            for point in sweep.of(scene):
                if point.method != method or point is default:
                    continue
                key = point.series.split("-")[0]
                decision = f"{key.upper()}: {DECISIONS[key]}" if key.startswith("e") else DECISIONS[key]
                if point.failure:
                    failed.append(f"{scene}, {point.series}: {point.failure}")
                else:
                    rows.append(row(point, default, decision))
    text = ["Schedule: a search every 20 frames that takes 20. Error is against the true set of every frame under the same law and clip, so what "
            "changes truth itself (E9, E10) shows in the forces. Leaf pairs: relative to the default. E1 to E7, E11, E13 and both readings of "
            "Fig. 5 (a) are options of the methods, E9 and E10 of the force. E8 has no second reading: its choices are what K1 to K10 sweep.", ""]
    text += table(["decision", "scene", "method", "reading", "changes", "recall [%]", "with neighbours [%]", "precision [%]", "LMDs, mean (true)",
                   "force [N], mean (true)", "force error, RMS [% of F_max]", "jumps [1/s]", "leaf pairs", "candidates"], rows)
    text += [f"Failed: {'; '.join(failed)}.", ""] if failed else []
    return text + (memory_text(direction_memory) if direction_memory is not None else
                   ["E12 (contacts without direction) was not measured here.", ""])


def memory_text(result):
    """E12: LMDs at distance 0 push along the last valid direction; the other reading lets them push not at all."""
    rows = []
    profile = [result.scene(name) for name in ("cutoff_m", "saturation_m", "maximum_force_n", "sharpness")]
    for method in result.methods.values():
        if not method.has("lmds/distance"):
            continue
        distance, direction, offset = (method.read(f"lmds/{name}") for name in ("distance", "direction", "frame_offset"))
        touching = distance == 0.0
        frames = np.zeros(len(offset) - 1, dtype=bool)
        lengths, without = [], []
        for frame in range(len(frames)):
            rows_here = slice(offset[frame], offset[frame + 1])
            if not touching[rows_here].any():
                continue
            frames[frame] = True
            here, free = direction[rows_here], ~touching[rows_here]
            lengths.append(np.linalg.norm(method.read("force")[frame]))
            lengths_here = law(distance[rows_here], *profile, method.force_law)
            push = -(lengths_here[free, None] * here[free]).sum(axis=0) if free.any() else np.zeros(3)
            without.append(min(np.linalg.norm(push), result.scene("force_limit_n")))
        if lengths:
            rows.append([result.name, method.label, int(frames.sum()), shown(float(np.mean(lengths))), shown(float(np.mean(without))),
                         shown(100 * float(np.mean(np.array(without) == 0.0)))])
    return ["E12, contacts: frames in which triangles touch or intersect, and the force there.", "",
            *table(["scene", "method", "frames with touching pairs", "force as decided [N], mean", "without the last direction [N], mean",
                    "of these frames without any force then [%]"], rows)]
