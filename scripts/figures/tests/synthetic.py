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
                 truth_stride=50, maximum_force=2.0, seed=1, true_counts=None, triangles=16_298):
    """A run of `frames` haptic frames in contact in its middle; the original loses LMDs now and then, the improved
    one follows truth, every other method equals it."""
    random = np.random.default_rng(seed)
    time = np.arange(frames) / 1000.0
    depth = np.clip(np.sin(np.pi * np.arange(frames) / frames) * 1.6 - 0.4, 0.0, 1.0)
    contacts = np.round(depth * (4 if name == "hard" else 14)).astype(int) if true_counts is None else true_counts
    true_force = np.column_stack([np.zeros(frames), 0.2 * depth, depth]) * maximum_force
    probed = np.arange(0, frames - 1, truth_stride) if truth_stride else np.empty(0, dtype=int)
    searches = np.arange(0, frames, search_every)
    with h5py.File(file, "w") as h5:
        h5.attrs["format"] = "lmdbench-result"
        h5.attrs["format_version"] = 1
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
        }
        dataset(provenance, "experiment", [json.dumps(experiment)], "1", "the experiment, JSON")
        provenance.create_group("machine").attrs["processor"] = "Synthetic"
        scene = h5.create_group("scene")
        scene.attrs.update({"maximum_force_n": maximum_force, "cutoff_m": 0.001, "device_maximum_force_n": 10.0})
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
            group.attrs["force_law"] = LAWS[label]
            write_method(group, label, frames, repetitions, searches, contacts, true_force, depth, random)
            if truth_stride:
                write_truth(group, label, probed, contacts, true_force)
        if truth_stride:
            reference = h5.create_group("reference")
            dataset(reference, "frame", probed, "1", "probed frames")
            dataset(reference, "lmd_count", contacts[probed], "1", "true LMDs")
            for law in ("linear", "exponential"):
                dataset(reference, f"force_{law}", true_force[probed], "N", "true force")
                jump = np.linalg.norm(true_force[probed + 1] - true_force[probed], axis=1)
                dataset(reference, f"force_jump_{law}", jump, "N", "change of the true force")
        fcl = h5.create_group("crosscheck/fcl")
        checked = probed if truth_stride else np.arange(0, frames, 100)
        dataset(fcl, "frame", checked, "1", "checked frames")
        dataset(fcl, "distance", np.full(checked.size, 1e-3), "m", "FCL's distance")
        dataset(fcl, "lmdbench_distance", np.full(checked.size, 1e-3), "m", "exact distance")
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
    before = count * 12.0 if label == "improved" else np.full(frames, np.nan)
    dataset(group, "lmd_count_before_reduction", before, "1", "candidates")
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.where(count > 0, before / count, np.nan)
    dataset(group, "reduction_ratio", ratio, "1", "candidates / kept")
    every_frame = label not in ("original", "improved")
    cost = {"original": 1.0, "improved": 1.1, "certified": 0.05, "exhaustive": 40.0}[label] * 1e-3
    local = (2e-6 if label == "original" else 8e-6) * (1 + contacts) * (1 + 0.05 * random.random((repetitions, frames)))
    started = searches[:0] if every_frame else searches
    if every_frame:
        local += cost * (0.3 + depth)
    search = cost * (0.3 + depth[started]) * (1 + 0.05 * random.random((repetitions, started.size)))
    local[0] *= 10.0  # a warm-up that must not be seen in any number
    search[0] *= 10.0
    reduction = 0.8 * search if label == "improved" else np.full(search.shape, np.nan)
    dataset(group, "local_update_time", local, "s", "time of each local update")
    dataset(group, "global_frame", started, "1", "frame of each search")
    dataset(group, "global_search_time", search, "s", "time of each search")
    dataset(group, "first_reduction_time", reduction, "s", "time of each first reduction")
    dataset(group, "second_tracking_time", 0.1 * reduction, "s", "time of each second tracking")
    dataset(group, "candidates", count[started] * (12 if label == "improved" else 1), "1", "candidates")
    dataset(group, "kept_after_reduction", count[started], "1", "kept")


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
    dataset(truth, "force_angle_error", np.where(error > 0, np.nan, 0.0), "rad", "angle")
    dataset(truth, "minimum_distance_error", np.zeros(probed.size), "m", "error of the minimum distance")
    dataset(truth, "force_jump", np.zeros(probed.size), "N", "change of the force")
