# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the other reading of the paper's text would have changed, decision by decision (E1 to E13): the sweep
experiments/sweeps/readings.json, every variant beside the default under the same schedule; and, of a run with every LMD, the
decision on contacts without direction."""

import json
import math

import numpy as np

from lmdbench_results import law
from region_rules import Found
from tables import shown

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
    of_default = point is default
    changes = "-" if of_default else "nothing" if point.result_hash == default.result_hash else "forces or sets"
    work = point.counter("leaf_pairs") / default.counter("leaf_pairs") if default.counter("leaf_pairs") else math.nan
    with_truth = lambda name: f"{shown(point.number(name))} ({shown(point.number('true_' + name))})"  # noqa: E731
    return {"decision": decision, "scene": point.scene, "method": point.method, "reading": "**as decided**" if of_default else variation(point, default),
            "changes": changes, "recall [%]": shown(100 * point.number("recall")), "with neighbours [%]": shown(100 * point.number("recall_adjacent")),
            "precision [%]": shown(100 * point.number("precision")), "LMDs, mean (true)": with_truth("lmd_count_mean"),
            "force [N], mean (true)": with_truth("force_mean_n"), "force error, RMS [% of F_max]": shown(100 * point.force_error),
            "jumps [1/s]": shown(point.number("jumps") / point.number("seconds_in_contact")), "leaf pairs": shown(work),
            "candidates": shown(point.number("candidates"))}


def readings(sweep, direction_memory=None):
    found, failed = Found(), []
    for scene in sweep.scenes:
        for method in ("improved", "original"):
            default = sweep.of(scene, method)[0]
            found.add(row(default, default, "-"))
            for point in (point for point in sweep.of(scene) if point.method == method and point is not default):
                key = point.series.split("-")[0]
                if point.failure:
                    failed.append(f"{scene}, {point.series}: {point.failure}")
                else:
                    found.add(row(point, default, f"{key.upper()}: {DECISIONS[key]}" if key.startswith("e") else DECISIONS[key]))
    return ["Schedule: a search every 20 frames that takes 20. Error is against the true set of every frame under the same law and clip, so what "
            "changes truth itself (E9, E10) shows in the forces. Leaf pairs: relative to the default. E1 to E7, E11, E13 and both readings of "
            "Fig. 5 (a) are options of the methods, E9 and E10 of the force. E8 has no second reading: its choices are what K1 to K10 sweep.", "",
            *found.table(), *([f"Failed: {'; '.join(failed)}.", ""] if failed else []),
            *(["E12 (contacts without direction) was not measured here.", ""] if direction_memory is None else memory_text(direction_memory))]


def memory_text(result):
    """E12: LMDs at distance 0 push along the last valid direction; the other reading lets them push not at all."""
    found = Found()
    profile = [result.scene(name) for name in ("cutoff_m", "saturation_m", "maximum_force_n", "sharpness")]
    for method in (method for method in result.methods.values() if method.has("lmds/distance")):
        distance, direction, offset = (method.read(f"lmds/{name}") for name in ("distance", "direction", "frame_offset"))
        force, with_it, without = method.read("force"), [], []
        for frame, here in enumerate(map(slice, offset[:-1], offset[1:])):
            free = distance[here] != 0.0
            if not free.all():
                push = law(distance[here], *profile, method.force_law)[free, None] * direction[here][free]
                with_it.append(np.linalg.norm(force[frame]))
                without.append(min(np.linalg.norm(push.sum(axis=0)), result.scene("force_limit_n")))
        if with_it:
            found.add({"scene": result.name, "method": method.label, "frames with touching pairs": len(with_it),
                       "force as decided [N], mean": shown(float(np.mean(with_it))), "without the last direction [N], mean": shown(float(np.mean(without))),
                       "of these frames without any force then [%]": shown(100 * float(np.mean(np.array(without) == 0.0)))})
    return ["E12, contacts: frames in which triangles touch or intersect, and the force there.", "", *found.table()]
