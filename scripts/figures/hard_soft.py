#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Hard against soft on one contact, open and closed loop: runs experiments/bunny-closed.json, whose two force profiles each run puts
through the same poses, with both kinds of loop, and with LMD sets of several ages in the closed one; leaves hard-soft.md (tables) and a figure (hard-soft.svg,
hard-soft.png) of force, spectrum, stiffness and clearance."""

import argparse
import json
import os
import resource
import subprocess

import numpy as np

import figure_style as style
from lmdbench_results import Result, ResultError, run_script

import matplotlib.pyplot as plt

PROFILES = ("hard", "soft")
KINDS = ("open", "closed")
AGES_FRAMES = (1, 5, 20, 50, 100)
PREDICTIONS = ("none", "linear")
LAWS = {"original": "linear", "improved": "exponential"}  # of the methods whose sets age
COST_FRAMES = 5000
COST_REPETITIONS = 7
BUZZ_HZ = 30.0  # a hand feels what is above as buzzing
WINDOW_S = (2.2, 2.8)  # of the path: the second contact


def run(program, experiment, out, settings):
    """The result of a run, made unless it is there."""
    if not os.path.exists(out):
        command = [program, "run", experiment, "--out", out]
        for pointer, value in settings.items():
            command += ["--set", f"{pointer}={json.dumps(value)}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise ResultError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    return Result(out).h5


def buzz(force, rate):
    """Root mean square of the force above BUZZ_HZ [N], by its Fourier transform under a Hann window."""
    window = np.hanning(force.shape[0])[:, None]
    spectrum = np.fft.rfft((force - force.mean(axis=0)) * window, axis=0)
    high = np.fft.rfftfreq(force.shape[0], 1.0 / rate) > BUZZ_HZ
    power = 2.0 * np.sum(np.abs(spectrum[high]) ** 2) / (force.shape[0] * np.sum(window**2))
    return float(np.sqrt(power))


def figures_of(group, rate, contact):
    """What the tables tell of one method under one profile."""
    force = group["force"][:]
    length = np.linalg.norm(force, axis=1)
    maximum = float(group.attrs["maximum_force_n"])
    jumps = np.linalg.norm(np.diff(force, axis=0), axis=1) > 0.25 * maximum
    fallen = (length[1:] == 0) & (length[:-1] > 0) & contact[1:]
    seconds = max(contact.sum() / rate, 1.0 / rate)
    stiffness = group["effective_stiffness"][:][contact]
    created = group["loop/energy_rendered"][:].max() if "loop" in group else np.nan
    return {
        "force, median of contact, N": np.median(length[contact]) if contact.any() else np.nan,
        "force above 30 Hz, N": buzz(force, rate),
        "jumps, 1/s": jumps.sum() / seconds,
        "dropouts, 1/s": fallen.sum() / seconds,
        "clipped, %": 100 * group["force_clipped"][:][contact].mean() if contact.any() else np.nan,
        "K_eff, 99 %, N/m": np.percentile(stiffness, 99) if stiffness.size else np.nan,
        "smallest distance, mm": 1e3 * np.nanmin(group["minimum_distance"][:]),
        "energy created, mJ": 1e3 * max(created, 0.0) if np.isfinite(created) else np.nan,
    }


def contact_of(group):
    return (group["loop/in_contact"] if "loop" in group else group["in_contact"])[:].astype(bool)


def text_attribute(group, name):
    value = group.attrs[name]
    return value.decode() if isinstance(value, bytes) else str(value)


def groups_of(h5, profile):
    """{method: group} under a profile, in the order of reports."""
    groups = {label.removesuffix("-" + profile): group for label, group in h5["/methods"].items()
              if text_attribute(group, "profile") == profile}
    return dict(sorted(groups.items()))


def lines_of(name, h5, profile):
    """One line a method of a run under a profile."""
    rate = float(h5["/scene"].attrs["frame_rate_hz"])
    lines, columns = [], []
    for label, group in groups_of(h5, profile).items():
        values = figures_of(group, rate, contact_of(group))
        columns = list(values)
        lines.append(f"| {name} | {label} | " + " | ".join("-" if np.isnan(v) else f"{v:.3g}" for v in values.values())
                     + " |")
    return columns, lines


def table(runs, first):
    lines = []
    for name, (h5, profile) in runs.items():
        columns, more = lines_of(name, h5, profile)
        lines += more
    return "\n".join([f"| {first} | method | " + " | ".join(columns) + " |", "|---|---|" + "---|" * len(columns)] + lines)


def draw(runs, directory):
    style.use_style()
    figure, axes = plt.subplots(4, 4, figsize=(style.TWO_COLUMNS_IN, 6.4), layout="constrained", sharex="row")
    for column, (name, (h5, profile)) in enumerate(runs.items()):
        rate = float(h5["/scene"].attrs["frame_rate_hz"])
        time = h5["/path/time"][:]
        shown = (time >= WINDOW_S[0]) & (time <= WINDOW_S[1])
        axes[0, column].set_title(name)
        for label, group in reversed(groups_of(h5, profile).items()):  # the paper's methods do not hide the exact one
            force = group["force"][:]
            colour = style.METHOD_COLOURS[int(group.attrs["method_order"]) % len(style.METHOD_COLOURS)]
            options = {"color": colour, "label": label, "linewidth": 0.6}
            axes[0, column].plot(time[shown], np.linalg.norm(force, axis=1)[shown], **options)
            spectrum = np.abs(np.fft.rfft(force * np.hanning(force.shape[0])[:, None], axis=0)) * 2 / force.shape[0]
            axes[1, column].loglog(np.fft.rfftfreq(force.shape[0], 1 / rate)[1:],
                                   np.linalg.norm(spectrum, axis=1)[1:], **options)
            stiffness = group["effective_stiffness"][:]
            axes[2, column].semilogy(time[shown], np.where(stiffness > 0, stiffness, np.nan)[shown], **options)
            axes[3, column].plot(time[shown], 1e3 * group["minimum_distance"][:][shown], **options)
        axes[3, column].set_xlabel("time, s")
        axes[1, column].set_xlabel("frequency, Hz")
    for row, text in enumerate(("force, N", "force spectrum, N", "stiffness K_eff, N/m", "smallest distance, mm")):
        axes[row, 0].set_ylabel(text)
    axes[0, 0].legend()
    return style.save(figure, directory, "hard-soft")


def errors(h5, profile, label):
    """Error of a method's force against the exact set's under the same law, over the frames in contact: (root mean square, 99 %) [N]."""
    group, exact = h5[f"/methods/{label}-{profile}"], h5[f"/methods/exact-{label}-{profile}"]
    contact = contact_of(group)
    length = np.linalg.norm(group["force"][:] - exact["force"][:], axis=1)[contact]
    return float(np.sqrt(np.mean(length**2))), float(np.percentile(length, 99))


def prediction_table(runs):
    """runs: {(age, prediction): h5}; a line a profile, age and method."""
    lines = ["| profile | age, frames | method | error, RMS, N | predicted | error, 99 %, N | predicted |", "|---|---|---|---|---|---|---|"]
    for profile in PROFILES:
        for age in AGES_FRAMES:
            for label in LAWS:
                (rms, p99), (rms_ahead, p99_ahead) = (errors(runs[age, p], profile, label) for p in PREDICTIONS)
                lines.append(f"| {profile} | {age} | {label} | {rms:.3g} | {rms_ahead:.3g} | {p99:.3g} | {p99_ahead:.3g} |")
    return "\n".join(lines)


def processor_seconds(command):
    """User and system time of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise ResultError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def cost_table(program, experiment, scratch):
    """Processor time of a second of closed loop with 'certified': what COST_FRAMES more frames take, over their seconds."""
    with open(experiment, encoding="utf-8") as file:
        profiles = json.load(file)["force"]
    lines = ["| profile | command | least, ms | median, ms | most, ms |", "|---|---|---|---|---|"]
    for profile in profiles:
        for command, made in (("record", os.path.splitext(scratch)[0] + ".tum"), ("run", scratch)):
            def take(frames):
                return processor_seconds([program, command, experiment, "--out", made, "--set", f"/force={json.dumps(profile)}",
                                          "--set", '/methods=[{"name": "certified", "force_law": "exponential"}]',
                                          "--set", f"/frames={frames}"])
            seconds = sorted((take(COST_FRAMES + 1) - take(1)) / (COST_FRAMES / 1000) for _ in range(COST_REPETITIONS))
            lines.append(f"| {profile['name']} | `{command}` | " + " | ".join(f"{1e3 * value:.1f}" for value in (
                seconds[0], seconds[len(seconds) // 2], seconds[-1])) + " |")
            os.remove(made)
    return "\n".join(lines)


TEXT = """# Hard against soft

Made by `scripts/figures/hard_soft.py` from `experiments/bunny-closed.json`, whose run puts both profiles through the same meant path with the same force law and F_max; only the
cutoff differs (0.5 % and 5 % of the diagonal), and with it the stiffness. In the closed loop an arm (0.554 kg, 6.45 N s/m, 135 N/m)
draws a simulated PHANTOM Desktop with friction and encoder counts along the path. Jumps are changes of force above a quarter of F_max from a
frame to the next; dropouts are frames in contact in which the force falls to zero; energy created is the largest net work of the
rendered force, which would be at most zero for a passive contact that begins and ends apart.

![force, spectrum, stiffness and clearance, hard and soft, open and closed loop](hard-soft.png)

{kinds}

## Age of the LMD set

The closed loops again with searches that start every so many frames and arrive as many later; `predicted`: they take place
where the mesh will be when they arrive. `certified` searches in every frame and has no age.

{ages}

## What prediction does to the error

The same ages in the open loop, where all methods see the same poses: the length of the difference between a method's force and that of
the exact set (`certified`) under the same law, over the frames in contact.

{predicted}

## What a second costs

Processor time (user and system) of the whole program, `certified`, closed loop at 1 kHz: the difference between runs of {frames} frames and of one,
over {seconds:g} s; {repetitions} repetitions. `record` is the loop alone: search, force, simulated device, the path's file. `run` judges afterwards:
which frames are in contact takes nearest distances of the meshes wherever they are about the cutoff, as they are in the hard profile.

{cost}
"""


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/lmdbench", help="the program; %(default)s without it")
    parser.add_argument("--experiment", default="experiments/bunny-closed.json")
    parser.add_argument("--runs", default="results/hard-soft", help="folder of the result files; existing ones are used")
    parser.add_argument("--out", default="results/figures", help="folder of the tables and the figure")
    options = parser.parse_args(argv)
    os.makedirs(options.runs, exist_ok=True)
    os.makedirs(options.out, exist_ok=True)

    opened = {}

    def result(name, settings):
        if name not in opened:
            opened[name] = run(options.program, options.experiment, os.path.join(options.runs, f"{name}.h5"), settings)
        return opened[name]

    loops = {kind: result(kind, {"/loop/kind": kind}) for kind in KINDS}
    kinds = {f"{profile}, {kind}": (loops[kind], profile) for profile in PROFILES for kind in KINDS}
    ages = {}
    for profile in PROFILES:
        for age in AGES_FRAMES:
            for prediction in PREDICTIONS:
                ages[f"{profile}, {age} frames{', predicted' if prediction == 'linear' else ''}"] = (result(
                    f"{age}-{prediction}",
                    {"/driver/search_every_frames": age,
                     "/driver/search_latency_frames": age, "/driver/prediction": prediction,
                     "/methods": [{"name": name, "force_law": law} for name, law in LAWS.items()]}), profile)
    exact = [{"name": "certified", "label": f"exact-{name}", "force_law": law} for name, law in LAWS.items()]
    predicted = {(age, prediction): result(f"open-{age}-{prediction}", {
        "/loop/kind": "open", "/driver/search_every_frames": age, "/driver/search_latency_frames": age,
        "/driver/prediction": prediction,
        "/methods": [{"name": name, "force_law": law} for name, law in LAWS.items()] + exact})
                 for age in AGES_FRAMES for prediction in PREDICTIONS}
    with open(os.path.join(options.out, "hard-soft.md"), "w", encoding="ascii") as file:
        file.write(TEXT.format(kinds=table(kinds, "profile, loop"), ages=table(ages, "profile, age"),
                               predicted=prediction_table(predicted), frames=COST_FRAMES + 1, seconds=COST_FRAMES / 1000,
                               repetitions=COST_REPETITIONS, cost=cost_table(options.program, options.experiment,
                                                                             os.path.join(options.runs, "cost.h5"))))
    draw(kinds, options.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
