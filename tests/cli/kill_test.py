# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Kills a run again and again at random moments, resumes it each time, and compares what comes of it with a run that
nobody killed. After every kill: the part opens, holds at least what it held when it was last looked at before the kill,
and every frame of it has the force of the uninterrupted run. Now and then a copy of the part is resumed to its end.

    kill_test.py PROGRAM EXPERIMENT.json [--kills N] [--repetitions R] [--longest SECONDS] [--set /pointer=value]...
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

SIGNALS = [signal.SIGKILL, signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT]
POLL_SECONDS = 0.02


def measured(part):
    """(frames measured, file opens); (0, False) where there is nothing to open."""
    try:
        with h5py.File(part, "r") as file:
            return int(file["frames_measured"][0]), True
    except OSError:
        return 0, False


def is_time(name, dataset):
    return name.endswith("_time") or dataset.attrs.get("made_of_times", 0) == 1


def differences(a, b):
    """Names of datasets that differ between two results, times and provenance aside."""
    names = []
    with h5py.File(a, "r") as first, h5py.File(b, "r") as second:
        found = {}
        for which, file in enumerate((first, second)):
            def visit(name, item, which=which):
                if isinstance(item, h5py.Dataset) and not name.startswith("provenance") and not is_time(name, item):
                    found.setdefault(name, [None, None])[which] = item[()]
            file.visititems(visit)
        for name, (left, right) in sorted(found.items()):
            if left is None or right is None or left.shape != right.shape or left.tobytes() != right.tobytes():
                if left is not None and left.dtype.kind == "O" and list(left) == list(right):
                    continue
                names.append(name)
    return names


def check_part(part, whole):
    """Problems of a part against the uninterrupted result; every frame counted is there with the same force."""
    problems = []
    with h5py.File(part, "r") as file, h5py.File(whole, "r") as reference:
        counted = 0
        for label, group in file.get("methods", {}).items():
            times = group["local_update_time"][()]
            known = ~np.isnan(times)
            counted += int(known.sum())
            frames = int(known[0].sum())
            if not known[0][:frames].all():
                problems.append(f"{label}: the frames have gaps")
            expected = reference[f"methods/{label}/force"][()][:frames]
            if group["force"][()][:frames].tobytes() != expected.tobytes():
                problems.append(f"{label}: other forces than the uninterrupted run's")
        # The count is written after the frame, so it may be one behind.
        if not 0 <= counted - int(file["frames_measured"][0]) <= 1:
            problems.append(f"{counted} frames have times, {int(file['frames_measured'][0])} are counted")
    return problems


def kept_times_differ(part, result):
    """Labels of methods whose known times of local updates are others in the final result."""
    labels = []
    with h5py.File(part, "r") as file, h5py.File(result, "r") as final:
        for label, group in file.get("methods", {}).items():
            times = group["local_update_time"][()]
            known = ~np.isnan(times)
            if times[known].tobytes() != final[f"methods/{label}/local_update_time"][()][known].tobytes():
                labels.append(label)
    return labels


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("experiment")
    parser.add_argument("--kills", type=int, default=8)
    parser.add_argument("--repetitions", type=int, default=40)
    parser.add_argument("--longest", type=float, default=1.0, help="seconds to the latest kill after a start")
    parser.add_argument("--complete-every", type=int, default=20, help="resume a copy to its end after so many kills")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--set", action="append", default=[], dest="overrides")
    arguments = parser.parse_args()
    pick = random.Random(arguments.seed)
    command = [arguments.program, "run", arguments.experiment, "-q", "--set",
               f"/driver/repetitions={arguments.repetitions}"]
    for override in arguments.overrides:
        command += ["--set", override]

    def resume(file):
        subprocess.run(command + ["--out", file, "--resume"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    folder = tempfile.mkdtemp(prefix="lmdbench-kills-")
    whole, out = os.path.join(folder, "whole.h5"), os.path.join(folder, "r.h5")
    part = out + ".part"
    failures = []
    try:
        begin = time.monotonic()
        subprocess.run(command + ["--out", whole], check=True, stdout=subprocess.DEVNULL)
        whole_seconds = time.monotonic() - begin
        with h5py.File(whole, "r") as file:
            frames = sum(group["local_update_time"].size for group in file["methods"].values())
        opened = nothing_yet = finished = largest_loss = completed = 0
        by_signal = {}
        for kill in range(arguments.kills):
            process = subprocess.Popen(command + ["--out", out, "--resume"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            until = time.monotonic() + pick.uniform(0.0, arguments.longest)
            seen = 0
            while time.monotonic() < until and process.poll() is None:
                count, _ = measured(part)
                seen = max(seen, count)
                if count < 0:
                    failures.append(f"kill {kill}: the part counts {count} frames")
                time.sleep(min(POLL_SECONDS, max(0.0, until - time.monotonic())))
            sent = pick.choice(SIGNALS)
            by_signal[sent.name] = by_signal.get(sent.name, 0) + 1
            process.send_signal(sent)
            errors = process.communicate()[1]
            # It had finished, perhaps killed after its last act: begin again.
            if process.returncode == 0 or (os.path.exists(out) and not os.path.exists(part)):
                finished += 1
                if os.path.exists(out):
                    failures += [f"kill {kill}: {name} differs in the finished result"
                                 for name in differences(whole, out)]
                    os.remove(out)
                continue
            if process.returncode != -sent:
                failures.append(f"kill {kill}: {sent.name} ended the run with {process.returncode}: {errors}")
            count, opens = measured(part)
            if not opens:
                if seen > 0 or (os.path.exists(part) and os.path.getsize(part) > 0):
                    failures.append(f"kill {kill}: the part does not open, {seen} frames were in it")
                nothing_yet += 1
                continue
            opened += 1
            largest_loss = max(largest_loss, seen - count)
            if count < seen:
                failures.append(f"kill {kill}: {seen - count} frames lost that were in the part before")
            failures += [f"kill {kill}: {problem}" for problem in check_part(part, whole)]
            if kill % arguments.complete_every == arguments.complete_every - 1:
                copy = os.path.join(folder, "copy.h5")
                shutil.copyfile(part, copy + ".part")
                kept = os.path.join(folder, "kept.h5")
                shutil.copyfile(part, kept)
                resume(copy)
                failures += [f"kill {kill}: {name} differs after resuming" for name in differences(whole, copy)]
                failures += [f"kill {kill}: {label}: known times were not kept"
                             for label in kept_times_differ(kept, copy)]
                if os.path.exists(copy + ".part"):
                    failures.append(f"kill {kill}: a part is left beside the finished result")
                completed += 1
        if os.path.exists(part):
            resume(out)
            failures += [f"at the end: {name} differs" for name in differences(whole, out)]
            completed += 1
        print("| what | |\n|---|---|")
        for name, value in [
                ("uninterrupted run", f"{whole_seconds:.1f} s, {frames} frames of all methods and repetitions"),
                ("kills", f"{arguments.kills} ({', '.join(f'{n} {k}' for k, n in sorted(by_signal.items()))})"),
                ("before anything could be opened", nothing_yet),
                ("after the run was through", finished),
                ("part opened, every frame as in the uninterrupted run", opened),
                ("most frames lost that had been in the part", largest_loss),
                ("resumed to the end and compared", completed),
                ("failures", len(failures))]:
            print(f"| {name} | {value} |")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures or opened == 0 else 0


if __name__ == "__main__":
    raise SystemExit(main())
