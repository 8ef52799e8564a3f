# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small result files with known contents, in the layout of results/README.md, for the tests of the scripts."""

import json

import h5py
import numpy as np

LAWS = {"original": "linear", "improved": "exponential", "certified": "exponential", "exhaustive": "exponential"}


def dataset(group, name, values, units, long_name):
    item = group.create_dataset(name, data=values)
    item.attrs["units"] = units
    item.attrs["long_name"] = long_name


def write_result(file, name="hard", frames=2000, repetitions=5, methods=("original", "improved"), search_every=20,
                 truth_stride=50, maximum_force=2.0, seed=1, true_counts=None, triangles=16_298, settings=None):
    """A run of `frames` haptic frames in contact in its middle; the original loses LMDs now and then, the improved
    one follows truth, every other method equals it. `settings` are keys of the experiment, for what it says of itself alone."""
    random = np.random.default_rng(seed)
    time = np.arange(frames) / 1000.0
    depth = np.clip(np.sin(np.pi * np.arange(frames) / frames) * 1.6 - 0.4, 0.0, 1.0)
    contacts = np.round(depth * (4 if name == "hard" else 14)).astype(int) if true_counts is None else true_counts
    true_force = np.column_stack([np.zeros(frames), 0.2 * depth, depth]) * maximum_force
    probed = np.arange(0, frames - 1, truth_stride) if truth_stride else np.empty(0, dtype=int)
    searches = np.arange(0, frames, search_every)
    with h5py.File(file, "w") as h5:
        h5.attrs["format"] = "lmdbench-result"
        h5.attrs["format_version"] = 2
        h5.attrs["creator"] = "lmdbench 0.0.0"
        h5.attrs["created_utc"] = "2000-01-01T00:00:00Z"
        provenance = h5.create_group("provenance")
        experiment = {
            "name": name,
            "title": f"synthetic {name}",
            "moving": {"mesh": "a"},
            "fixed": [{"mesh": "b"}],
            "methods": [{"name": label, "label": label, "force_law": LAWS[label]} for label in methods],
            "driver": {"search_every_frames": search_every, "repetitions": repetitions},
            **(settings or {}),
        }
        dataset(provenance, "experiment", [json.dumps(experiment)], "1", "the experiment, JSON")
        provenance.create_group("machine").attrs["processor"] = "Synthetic"
        scene = h5.create_group("scene")
        scene.attrs.update({"maximum_force_n": maximum_force, "cutoff_m": 0.001, "device_maximum_force_n": 10.0,
                            "frame_rate_hz": 1000.0})
        dataset(scene, "in_contact", (contacts > 0).astype("u1"), "1", "1 where in contact")
        for role in ("moving", "fixed_0"):
            scene.create_group(role).attrs["triangles"] = triangles
        dataset(scene, "warnings", ["synthetic data"], "1", "notes")
        path = h5.create_group("path")
        dataset(path, "time", time, "s", "time of each frame")
        all_methods = h5.create_group("methods")
        all_methods.attrs["warm_up_repetitions"] = 1
        for label in methods:
            group = all_methods.create_group(label)
            group.attrs["method"] = label
            group.attrs["method_order"] = list(LAWS).index(label)
            group.attrs["promise"] = "complete-set" if label in ("certified", "exhaustive") else "approximation"
            group.attrs["tracks_locally"] = int(label in ("original", "improved"))
            group.attrs["trackings_after_search"] = 2 if label == "improved" else 0
            group.attrs["force_law"] = LAWS[label]
            write_method(group, label, frames, repetitions, searches, contacts, true_force, depth, random)
            if truth_stride:
                write_truth(group, label, probed, contacts, true_force)
            write_summary(group, label, bool(truth_stride), np.count_nonzero(contacts))
        overall = h5.create_group("summary")
        for key, value in (("frames_in_contact", np.count_nonzero(contacts)), ("frames_probed", probed.size),
                           ("true_lmd_count_median", 3.0), ("true_lmd_count_maximum", contacts.max(initial=0))):
            dataset(overall, key, [float(value)], "1", key)
        if truth_stride:
            reference = h5.create_group("reference")
            dataset(reference, "frame", probed, "1", "probed frames")
            dataset(reference, "lmd_count", contacts[probed], "1", "true LMDs")
            dataset(reference, "contact_without_direction", np.zeros(len(probed), dtype=np.int64), "1", "true LMDs without a direction")
            dataset(reference, "minimum_distance", np.where(contacts[probed] > 0, 1e-3, np.nan), "m", "least true distance")
            for law in ("linear", "exponential"):
                dataset(reference, f"force_{law}", true_force[probed], "N", "true force")
        fcl = h5.create_group("crosscheck/fcl")
        checked = probed if truth_stride else np.arange(0, frames, 100)
        dataset(fcl, "frame", checked, "1", "checked frames")
        dataset(fcl, "relative_difference", np.full(checked.size, 2e-9), "1", "relative difference")
        dataset(fcl, "separated", np.ones(checked.size, dtype="u1"), "1", "1 where separated")
        dataset(fcl, "agrees", np.ones(checked.size, dtype="u1"), "1", "1 where both agree")
    return file


def misses(frames):
    """Frames in which the synthetic original has lost all its LMDs."""
    return (np.arange(frames) // 20) % 5 == 0


def write_method(group, label, frames, repetitions, searches, contacts, true_force, depth, random):
    lost = misses(frames) if label == "original" else np.zeros(frames, dtype=bool)
    count = np.where(lost, 0, contacts)
    force = np.where(lost[:, None], 0.0, true_force)
    dataset(group, "force", force, "N", "rendered force")
    dataset(group, "lmd_count", count, "1", "LMDs in use")
    every_frame = label not in ("original", "improved")
    cost = {"original": 1.0, "improved": 1.1, "certified": 0.05, "exhaustive": 40.0}[label] * 1e-3
    local = (2e-6 if label == "original" else 8e-6) * (1 + contacts) * (1 + 0.05 * random.random((repetitions, frames)))
    started = searches[:0] if every_frame else searches
    if every_frame:
        local += cost * (0.3 + depth)
    search = cost * (0.3 + depth[started]) * (1 + 0.05 * random.random((repetitions, started.size)))
    local[0] *= 10.0  # a warm-up, which no number may include
    search[0] *= 10.0
    dataset(group, "local_update_time", local, "s", "time of each local update")
    if every_frame:
        return
    dataset(group, "lmd_count_before_reduction", count * (12.0 if label == "improved" else 1.0), "1", "candidates")
    dataset(group, "global_frame", started, "1", "frame of each search")
    dataset(group, "global_search_time", search, "s", "time of each search")
    if label == "improved":
        dataset(group, "first_reduction_time", 0.8 * search, "s", "time of each first reduction")


SUMMARY_UNITS = {"_m": "m", "_n": "N", "_rad": "rad", "_s": "s", "_per_second": "1/s"}
# Known numbers of each method, or of the improved one.
LOSSES = {"recall": 0.8, "recall_adjacent": 0.9, "precision": 0.7, "precision_adjacent": 0.95, "frames_wrong": 8.0,
          "force_error_rms_n": 0.9, "force_error_maximum_n": 2.0, "jumps": 20.0}
EXACT = {"recall": 1.0, "recall_adjacent": 1.0, "precision": 1.0, "precision_adjacent": 1.0, "frames_wrong": 0.0,
         "force_error_rms_n": 0.0, "force_error_maximum_n": 0.0, "jumps": 0.0}
COMMON = {"frames_touching": 0.0, "frames_late": 0.0, "lmd_count_median": 2.0, "lmd_count_p99": 4.0, "lmd_count_maximum": 4.0,
          "candidates_median": 24.0, "minimum_distance_error_maximum_m": 0.0, "force_error_median_n": 0.0,
          "force_error_p99_n": 0.0, "force_angle_error_median_rad": 0.0, "force_jump_p99_n": 0.0,
          "force_jump_maximum_n": 0.0, "true_force_jump_p99_n": 0.0, "true_force_jump_maximum_n": 0.0,
          "true_jumps": 1.0, "true_jump_frames": 40.0}
REDUCTION = {"reduction_ratio": 12.0, "reduction_ratio_maximum": 14.0}
TIMES = {  # local update, search, search with reduction, frame
    "original": (5e-6, 1e-3, 1e-3, 55e-6), "improved": (20e-6, 1.1e-3, 1.98e-3, 119e-6),
    "certified": (50e-6, np.nan, np.nan, 50e-6), "exhaustive": (40e-3, np.nan, np.nan, 40e-3)}


def write_summary(group, label, probed, in_contact):
    local, search, both, frame = TIMES[label]
    numbers = {"frames_in_contact": float(in_contact)} | COMMON | (LOSSES if label == "original" else EXACT)
    if not probed:
        numbers |= {name: np.nan for name in LOSSES if name != "jumps"} | {"true_jumps": np.nan}
    if label == "improved":
        numbers |= REDUCTION
    else:
        numbers |= {name: np.nan for name in REDUCTION}
    for name, value in (("local_update", local), ("global_search", search), ("search_with_reduction", both),
                        ("frame_time", frame)):
        numbers |= {f"{name}_median_s": value, f"{name}_p99_s": 2.0 * value}
    numbers |= {"local_update_maximum_s": 3.0 * local, "frame_time_maximum_s": 3.0 * frame,
                "first_reduction_median_s": both - search, "second_tracking_median_s": 0.1 * (both - search)}
    summary = group.create_group("summary")
    for name, value in numbers.items():
        ending = max((end for end in SUMMARY_UNITS if name.endswith(end)), key=len, default=None)
        dataset(summary, name, [value], SUMMARY_UNITS.get(ending, "1"), name)


def write_truth(group, label, probed, contacts, true_force):
    lost = misses(contacts.size)[probed] if label == "original" else np.zeros(probed.size, dtype=bool)
    true_count = contacts[probed]
    recall = np.where(true_count > 0, np.where(lost, 0.0, 1.0), np.nan)
    precision = np.where((true_count > 0) & ~lost, 1.0, np.nan)
    error = np.where(lost, np.linalg.norm(true_force[probed], axis=1), 0.0)
    truth = group.create_group("truth")
    dataset(truth, "frame", probed, "1", "probed frames")
    for name, values in (("recall", recall), ("recall_adjacent", recall), ("precision", precision),
                         ("precision_adjacent", precision)):
        dataset(truth, name, values, "1", name)
    dataset(truth, "force_error", error, "N", "force error")
