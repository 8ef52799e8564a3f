#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Hard against soft on one contact, open and closed loop: runs experiments/bunny-closed.json, whose two force profiles each run puts
through the same poses, with both kinds of loop, and with LMD sets of several ages in the closed one; leaves hard-soft.md (tables) and a figure (hard-soft.svg,
hard-soft.png) of force, spectrum, stiffness and clearance."""

import argparse
import functools
import itertools
import json
import os
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import Result, quantile, run_script
from program import PROGRAM, printed, settings_words, timed
from tables import shown, table_text, write_text

import matplotlib.pyplot as plt

PROFILES = ("hard", "soft")
KINDS = ("open", "closed")
AGES_FRAMES = (1, 5, 20, 50, 100)
PREDICTIONS = ("none", "linear")
LAWS = {"original": "linear", "improved": "exponential"}  # of methods with sets that age
COST_FRAMES = 5000
COST_REPETITIONS = 7
BUZZ_HZ = 30.0  # a hand feels it as buzzing from here on
WINDOW_S = (2.2, 2.8)  # of the path: the second contact


def buzz(force, rate):
    """Root mean square of the force above BUZZ_HZ [N], by its Fourier transform under a Hann window."""
    window = np.hanning(force.shape[0])[:, None]
    spectrum = np.fft.rfft((force - force.mean(axis=0)) * window, axis=0)
    high = np.fft.rfftfreq(force.shape[0], 1.0 / rate) > BUZZ_HZ
    power = 2.0 * np.sum(np.abs(spectrum[high]) ** 2) / (force.shape[0] * np.sum(window**2))
    return float(np.sqrt(power))


def a_second(method, name):
    """Events a second of contact, of which there is at least a frame."""
    return method.number(name) * method.result.scene("frame_rate_hz") / max(method.number("frames_in_contact"), 1.0)


COLUMNS = {
    "force, median of contact, N": lambda method: method.number("rendered_force_median_n"),
    "force above 30 Hz, N": lambda method: buzz(method.read("force"), method.result.scene("frame_rate_hz")),
    "jumps, 1/s": lambda method: a_second(method, "jumps"),
    "dropouts, 1/s": lambda method: a_second(method, "dropouts"),
    "clipped, %": lambda method: 100 * method.number("force_clipped_share"),
    "K_eff, 99 %, N/m": lambda method: method.number("effective_stiffness_p99_n_per_m"),
    "smallest distance, mm": lambda method: 1e3 * quantile(method.read("minimum_distance"), 0.0),
    "energy created, mJ": lambda method: 1e3 * method.number("energy_created_j"),
}


def methods_of(result, profile):
    """{name: method} under a profile, by name."""
    return dict(sorted((label.removesuffix("-" + profile), method) for label, method in result.methods.items() if method.profile == profile))


def table(runs, first):
    """A line a run and method."""
    return table_text([first, "method", *COLUMNS], [
        [name, label, *(shown(value(method)) for value in COLUMNS.values())]
        for name, (result, profile) in runs.items() for label, method in methods_of(result, profile).items()])


def draw(runs, directory):
    style.use_style()
    figure, axes = plt.subplots(4, 4, figsize=(style.TWO_COLUMNS_IN, 6.4), layout="constrained", sharex="row")
    for column, (name, (result, profile)) in enumerate(runs.items()):
        rate, time = result.scene("frame_rate_hz"), result.time
        window = (time >= WINDOW_S[0]) & (time <= WINDOW_S[1])
        axes[0, column].set_title(name)
        for label, method in reversed(methods_of(result, profile).items()):  # the exact one on top
            force = method.read("force")
            options = {"color": style.colour_of(method), "label": label, "linewidth": 0.6}
            axes[0, column].plot(time[window], method.force_magnitude()[window], **options)
            taper = np.hanning(force.shape[0])[:, None]
            spectrum = np.abs(np.fft.rfft(force * taper, axis=0)) * 2 / np.sum(taper)
            axes[1, column].loglog(np.fft.rfftfreq(force.shape[0], 1 / rate)[1:],
                                   np.linalg.norm(spectrum, axis=1)[1:], **options)
            stiffness = method.read("effective_stiffness")
            axes[2, column].semilogy(time[window], np.where(stiffness > 0, stiffness, np.nan)[window], **options)
            axes[3, column].plot(time[window], 1e3 * method.read("minimum_distance")[window], **options)
        axes[3, column].set_xlabel("time, s")
        axes[1, column].set_xlabel("frequency, Hz")
    for row, text in enumerate(("force, N", "force spectrum, N", "stiffness K_eff, N/m", "smallest distance, mm")):
        axes[row, 0].set_ylabel(text)
    axes[0, 0].legend()
    return style.save(figure, directory, "hard-soft")


def errors(result, profile, label):
    """Error of a method's force against the exact set's under the same law, over the frames in contact: (root mean square, 99 %) [N]."""
    method, exact = (result.method(f"{name}-{profile}") for name in (label, f"exact-{label}"))
    length = np.linalg.norm(method.read("force") - exact.read("force"), axis=1)[method.in_contact()]
    return float(np.sqrt(np.mean(length**2))) if length.size else np.nan, quantile(length, 0.99)


def prediction_table(runs):
    """runs: {(age, prediction): result}; a line a profile, age and method."""
    rows = []
    for profile, age, label in itertools.product(PROFILES, AGES_FRAMES, LAWS):
        (rms, p99), (rms_ahead, p99_ahead) = (errors(runs[age, p], profile, label) for p in PREDICTIONS)
        rows.append([profile, age, label, f"{rms:.3g}", f"{rms_ahead:.3g}", f"{p99:.3g}", f"{p99_ahead:.3g}"])
    return table_text(["profile", "age, frames", "method", "error, RMS, N", "predicted", "error, 99 %, N", "predicted"], rows)


def cost_table(program, experiment, scratch):
    """Processor time of a second of closed loop with 'certified': what COST_FRAMES more frames take, over their seconds."""
    profiles = json.loads(Path(experiment).read_text(encoding="utf-8"))["force"]
    rows = []
    for profile in profiles:
        for command, made in (("record", os.path.splitext(scratch)[0] + ".tum"), ("run", scratch)):
            def take(frames):
                return timed([program, command, experiment, "--out", made, *settings_words({
                    "/force": profile, "/methods": [{"name": "certified", "force_law": "exponential"}], "/frames": frames})])[1]
            seconds = sorted((take(COST_FRAMES + 1) - take(1)) / (COST_FRAMES / 1000) for _ in range(COST_REPETITIONS))
            rows.append([profile["name"], f"`{command}`", *(f"{1e3 * value:.1f}" for value in (seconds[0], seconds[len(seconds) // 2], seconds[-1]))])
            os.remove(made)
    return table_text(["profile", "command", "least, ms", "median, ms", "most, ms"], rows)


TEXT = """# Hard against soft

Made by `scripts/figures/hard_soft.py` from `experiments/bunny-closed.json`.

![force, spectrum, stiffness and clearance, hard and soft, open and closed loop](hard-soft.png)

Both profiles go through the same meant path with the same force law and F_max. In the closed loop an arm (0.554 kg, 6.45 N s/m, 135 N/m) draws a
simulated PHANTOM Desktop with friction and encoder counts.

- *Jumps*: changes of force above a quarter of F_max from a frame to the next. *Dropouts*: frames in contact in which the force falls to zero.
- *Energy created*: the largest net work of the contacts, on the device and on the turn that the path gives the mesh; at most zero for passive
  contacts that begin apart.

{kinds}

## Age of the LMD set

The closed loops again with searches that start every so many frames and arrive as many later; `predicted`: they take place where the mesh will be
when they arrive. `certified` searches in every frame and has no age.

{ages}

## What prediction does to the error

The same ages in the open loop, where all methods see the same poses: the length of the difference between a method's force and that of the exact set
(`certified`) under the same law, over the frames in contact.

{predicted}

## What a second costs

Processor time of the whole program, `certified`, closed loop at 1 kHz: the difference between runs of {frames} frames and of one, over {seconds:g} s;
{repetitions} repetitions. `record` is the loop alone: search, force, simulated device, the path's file. `run` judges afterwards, too: which frames are in contact
takes nearest distances wherever the meshes are about the cutoff, as they are in the hard profile.

{cost}
"""


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=PROGRAM, help="the program; %(default)s without it")
    parser.add_argument("--experiment", default="experiments/bunny-closed.json")
    parser.add_argument("--runs", default="results/hard-soft", help="folder of the result files; existing ones are used")
    parser.add_argument("--out", default="results/figures", help="folder of the tables and the figure")
    options = parser.parse_args(argv)
    os.makedirs(options.runs, exist_ok=True)

    opened = functools.cache(Result)

    def result(name, settings):
        """Of a run, made unless it is there."""
        file = os.path.join(options.runs, f"{name}.h5")
        if not os.path.exists(file):
            printed([options.program, "run", options.experiment, "--out", file, *settings_words(settings)])
        return opened(file)

    def aged(age, prediction, methods=()):
        """Settings of searches that start every so many frames and arrive as many later."""
        return {"/driver/search_every_frames": age, "/driver/search_latency_frames": age, "/driver/prediction": prediction,
                "/methods": [*({"name": name, "force_law": law} for name, law in LAWS.items()), *methods]}

    loops = {kind: result(kind, {"/loop/kind": kind}) for kind in KINDS}
    kinds = {f"{profile}, {kind}": (loops[kind], profile) for profile in PROFILES for kind in KINDS}
    ages = {f"{profile}, {age} frames{', predicted' if prediction == 'linear' else ''}": (result(f"{age}-{prediction}", aged(age, prediction)), profile)
            for profile in PROFILES for age in AGES_FRAMES for prediction in PREDICTIONS}
    exact = [{"name": "certified", "label": f"exact-{name}", "force_law": law} for name, law in LAWS.items()]
    predicted = {(age, prediction): result(f"open-{age}-{prediction}", {"/loop/kind": "open", **aged(age, prediction, exact)})
                 for age in AGES_FRAMES for prediction in PREDICTIONS}
    cost = cost_table(options.program, options.experiment, os.path.join(options.runs, "cost.h5"))
    write_text(TEXT.format(kinds=table(kinds, "profile, loop"), ages=table(ages, "profile, age"), predicted=prediction_table(predicted),
                           frames=COST_FRAMES + 1, seconds=COST_FRAMES / 1000, repetitions=COST_REPETITIONS, cost=cost), options.out, "hard-soft.md")
    draw(kinds, options.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
