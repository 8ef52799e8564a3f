# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Baselines of a few scenes: hashes of all results, sums of all work counters, and how the methods' times relate.

    python3 scripts/baseline.py check [--without-times] [--program build/release/lmdbench]
    python3 scripts/baseline.py renew [--program build/release/lmdbench]

`check` runs the scenes and names what differs from results/baseline/; `renew` writes these files anew, to be committed with
the change that explains them. Hashes and counters must be equal on every machine; a ratio of times only within a factor
of RATIO_FACTOR, since caches and vector units move it: absolute times are the business of scripts/ci_regression.sh.
Exit codes: 0 as the baseline, 1 not, 4 no program."""

import argparse
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts", "figures"))

import interpreter  # noqa: E402, F401  (chooses one that has what follows)

import h5py  # noqa: E402
import numpy as np  # noqa: E402

FOLDER = os.path.join(ROOT, "results", "baseline")
# Parts with faces of thousands of corners: no set shows work that was not needed, its counters do.
OF_PARTS = ['/methods=[{"name":"certified"},{"name":"certified","label":"from-scratch","frame_coherence":false},{"name":"improved"}]']
# Generated or committed meshes only, so no network. Probes cost time and judge no method.
SCENES = {
    "shapes": ("experiments/shapes.json", ['/methods/-={"name":"certified","force_law":"exponential"}']),
    "combs": ("experiments/extreme/combs.json", []),
    "rocking-box": ("experiments/extreme/rocking-box.json", []),
    "gears": ("experiments/extreme/gears.json", OF_PARTS + ["/frames=101"]),
    "peg-round": ("experiments/extreme/peg-round.json", OF_PARTS),
}
OVERRIDES = ["/driver/repetitions=4", "/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0"]
RATIO_FACTOR = 3.0
TIMES = ("global_search_time", "first_reduction_time", "second_tracking_time", "local_update_time")
# A shorter total is mostly the cost of reading the clock.
LEAST_TOTAL_S = 5e-4


def total_time(group, warm_up):
    """Seconds of all stages: of every frame and search the least over the measured repetitions."""
    total = 0.0
    for name in TIMES:
        times = group[name][warm_up:] if name in group else np.empty((0, 0))
        measured = times[:, ~np.all(np.isnan(times), axis=0)] if times.size else times
        total += float(np.nanmin(measured, axis=0).sum()) if measured.size else 0.0
    return total


def counter_sums(group, name):
    if name not in group:
        return {}
    return {counter: int(group[name][counter][:].sum()) for counter in sorted(group[name])}


def measure(program, scene):
    experiment, own_overrides = SCENES[scene]
    with tempfile.TemporaryDirectory() as folder:
        result = os.path.join(folder, "result.h5")
        command = [program, "--quiet", "run", os.path.join(ROOT, experiment), "--out", result]
        for override in own_overrides + OVERRIDES:
            command += ["--set", override]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise SystemExit(f"error: {scene}: lmdbench run left with {done.returncode}: {done.stderr}")
        with h5py.File(result) as h5:
            methods, totals = {}, {}
            warm_up = int(h5["methods"].attrs["warm_up_repetitions"])
            for label in sorted(h5["methods"]):
                group = h5["methods"][label]
                methods[label] = {"result_hash": group.attrs["result_hash"], "lmds": int(group["lmd_count"][:].sum()),
                                  "counters": counter_sums(group, "counters"),
                                  "global_counters": counter_sums(group, "global_counters")}
                totals[label] = total_time(group, warm_up)
            frames = int(h5["path/time"].size)
    ratios = {f"{a} / {b}": float(f"{totals[a] / totals[b]:.3g}") for a in totals for b in totals
              if a < b and min(totals[a], totals[b]) > LEAST_TOTAL_S}
    return {"experiment": experiment, "overrides": own_overrides + OVERRIDES, "frames": frames, "methods": methods,
            "time_ratios": ratios}


def leaves(value, place=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{place}/{key}")
    else:
        yield place, value


def differences(baseline, measured, with_times=True):
    """One line each: what is not as in the baseline."""
    before, now = dict(leaves(baseline)), dict(leaves(measured))
    lines = []
    for place in sorted(before.keys() | now.keys()):
        old, new = before.get(place), now.get(place)
        if place.startswith("/time_ratios/"):
            if not with_times or old is None or new is None:
                continue
            if not isinstance(old, (int, float)) or not old > 0:
                lines.append(f"{place}: {old} is no ratio: the baseline is damaged")
            elif not 1 / RATIO_FACTOR <= new / old <= RATIO_FACTOR:
                lines.append(f"{place}: {old} became {new}, more than a factor of {RATIO_FACTOR:g}")
        elif old != new:
            lines.append(f"{place}: {old} became {new}")
    return lines


def baseline_file(folder, scene):
    return os.path.join(folder, scene + ".json")


def check(program, folder, with_times=True):
    wrong = 0
    for scene in SCENES:
        file = baseline_file(folder, scene)
        if not os.path.exists(file):
            lines = ["no such baseline"]
        else:
            try:
                with open(file, encoding="utf-8") as stream:
                    baseline = json.load(stream)
            except ValueError as error:
                lines = [f"the baseline is damaged: {error}"]
            else:
                lines = differences(baseline, measure(program, scene), with_times)
        for line in lines:
            print(f"{os.path.relpath(file, ROOT)}: {line}")
        wrong += len(lines)
    if wrong:
        print(f"{wrong} differences (remedy: mend the change, or, where they are meant, python3 scripts/baseline.py renew)")
    else:
        print(f"{len(SCENES)} scenes are as their baselines")
    return 1 if wrong else 0


def renew(program, folder):
    os.makedirs(folder, exist_ok=True)
    for scene in SCENES:
        measured = measure(program, scene)  # before the file is opened, which empties it
        with open(baseline_file(folder, scene), "w", encoding="utf-8") as stream:
            json.dump(measured, stream, indent=1, sort_keys=True)
            stream.write("\n")
        print(f"wrote {os.path.relpath(baseline_file(folder, scene), ROOT)}")
    return 0


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=["check", "renew"])
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "release", "lmdbench"))
    parser.add_argument("--folder", default=FOLDER)
    parser.add_argument("--without-times", action="store_true", help="check: hashes and counters alone, where other programs run beside this one")
    options = parser.parse_args(arguments)
    if not os.access(options.program, os.X_OK):
        print(f"error: {options.program} is no program (remedy: cmake --build --preset release)", file=sys.stderr)
        return 4
    program = os.path.abspath(options.program)
    return renew(program, options.folder) if options.command == "renew" else check(program, options.folder, not options.without_times)


if __name__ == "__main__":
    sys.exit(main())
