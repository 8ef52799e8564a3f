#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Stability maps from the raw runs of 'lmdbench-study stability' (files of one JSON object a line): which stiffness stays clean over
the age of the LMD set, by scene, profile and method. Leaves stability-map.md and a figure (stability-map.svg, stability-map.png)."""

import argparse
import json
import math

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from lmdbench_results import ResultError, run_script
from tables import table_text, write_text

import matplotlib.pyplot as plt

METHODS = ("original", "improved", "certified", "nearest")
DETAIL_N_PER_M = (1500, 5000, 16000)
DETAIL_AGE_FRAMES = 20  # of methods that track
# (key, title, scale, digits) of the means of the detail table
MEASURES = (
    ("amplitude_m", "amplitude, mm", 1e3), ("frequency_hz", "frequency, Hz", 1), ("force_above_30_hz_n", "above 30 Hz, N", 1),
    ("power_created_w", "power created, mW", 1e3), ("clearance_m", "smallest clearance, mm", 1e3), ("penetration_share", "touching, % of frames", 100),
    ("effective_stiffness_p99_n_per_m", "K_eff 99 %, N/m", 1), ("jumps", "jumps", 1), ("dropouts", "dropouts", 1))


def read_runs(files):
    """{(scene, profile, method, age): {stiffness: [run, ...]}}"""
    points = {}
    for file in files:
        with open(file, encoding="utf-8") as stream:
            for number, line in enumerate(stream, 1):
                try:
                    run = json.loads(line)
                    key = (run["scene"].removeprefix("stability-"), run["profile"], run["method"], run["age_frames"])
                except (ValueError, KeyError) as error:
                    raise ResultError(f"{file}: line {number}: is not a run ({error}) (remedy: name what "
                                      "'lmdbench-study stability' printed)") from error
                points.setdefault(key, {}).setdefault(run["stiffness_n_per_m"], []).append(run)
    return points


def wilson(count, total, z=1.959964):
    """95 % interval of a share (Wilson's score)."""
    share = count / total
    centre = share + z * z / (2 * total)
    half = z * math.sqrt(share * (1 - share) / total + z * z / (4 * total * total))
    return max(0.0, (centre - half) / (1 + z * z / total)), min(1.0, (centre + half) / (1 + z * z / total))


STUDENT_975 = {1: 12.706, 2: 4.303, 4: 2.776, 9: 2.262, 14: 2.145, 19: 2.093, 29: 2.045}


def mean_and_half(values):
    """Mean and half of its 95 % interval (Student's t)."""
    values = np.asarray(values, dtype=float)
    if values.size < 2:
        return float(values.mean()), math.nan
    known = [n for n in STUDENT_975 if n <= values.size - 1]
    return float(values.mean()), STUDENT_975[max(known)] * float(values.std(ddof=1)) / math.sqrt(values.size)


def verdict(runs):
    """How many are clean, and where not all are, why."""
    text = str(sum(run["clean"] for run in runs))
    shaking, through = sum(run["shaking"] for run in runs), sum(run["through"] for run in runs)
    return text + (f", shakes {shaking}" if shaking else "") + (f", through {through}" if through else "")


def largest_clean(by_stiffness):
    """'5000 to 11000': the largest stiffness at which every run is clean, and the next one tried, at which not all are."""
    clean = [stiffness for stiffness, runs in by_stiffness.items() if all(run["clean"] for run in runs)]
    if not clean:
        return "none"
    beyond = [stiffness for stiffness in by_stiffness if stiffness > max(clean)]
    return f"{max(clean):g} to {min(beyond):g}" if beyond else f"{max(clean):g} and more"


def ordered(points):
    scenes = list(dict.fromkeys(key[0] for key in points))
    return sorted(points, key=lambda key: (scenes.index(key[0]), key[1], METHODS.index(key[2]) if key[2] in METHODS else 9, key[3]))


def headline(points):
    """Largest clean stiffness: a line a scene and profile, a column a method and age."""
    columns = sorted({(key[2], key[3]) for key in points},
                     key=lambda c: (METHODS.index(c[0]) if c[0] in METHODS else 9, c[1]))
    rows = []
    for place in dict.fromkeys(key[:2] for key in ordered(points)):
        found = [points.get((*place, *column)) for column in columns]
        rows.append([*place, *(largest_clean(by_stiffness) if by_stiffness else "not run" for by_stiffness in found)])
    return table_text(["scene", "profile", *(f"{m}, {a} ms" for m, a in columns)], rows)


def counts(points):
    stiffnesses = sorted({s for by in points.values() for s in by})
    return table_text(["scene", "profile", "method", "age, ms", *(f"{s:g} N/m" for s in stiffnesses)],
                      [[*key, *(verdict(points[key][s]) if s in points[key] else "-" for s in stiffnesses)] for key in ordered(points)])


def details(points):
    lines = []
    for key in ordered(points):
        if key[3] not in (0, DETAIL_AGE_FRAMES) or (key[3] == 0 and key[2] in METHODS[:2]):
            continue
        for stiffness in DETAIL_N_PER_M:
            runs = points[key].get(stiffness)
            if not runs:
                continue
            cells = []
            for name, _, scale in MEASURES:
                mean, half = mean_and_half([run[name] for run in runs])
                cells.append(f"{scale * mean:.3g} +- {scale * half:.2g}")
            lines.append([key[0], key[1], f"{key[2]}, {key[3]} ms", f"{stiffness:g}", *cells])
    return table_text(["scene", "profile", "method, age", "K, N/m", *(title for _, title, _ in MEASURES)], lines)


def draw(points, directory):
    style.use_style()
    rows = list(dict.fromkeys((key[0], key[1]) for key in ordered(points)))
    methods = [m for m in METHODS if any(key[2] == m for key in points)]
    stiffnesses = sorted({s for by in points.values() for s in by})
    figure, axes = plt.subplots(len(rows), len(methods), figsize=(style.TWO_COLUMNS_IN, 0.95 * len(rows) + 0.6),
                                layout="constrained", squeeze=False)
    for row, (scene, profile) in enumerate(rows):
        for column, method in enumerate(methods):
            axis = axes[row, column]
            ages = sorted(key[3] for key in points if key[:3] == (scene, profile, method))
            if not ages:
                axis.set_axis_off()
                continue
            share = np.array([[np.mean([run["clean"] for run in points[scene, profile, method, a][s]])
                               if s in points[scene, profile, method, a] else np.nan for s in stiffnesses] for a in ages])
            image = axis.imshow(share, origin="lower", aspect="auto", vmin=0, vmax=1, cmap="viridis")
            axis.set_xticks(range(len(stiffnesses)), [f"{s / 1000:g}" for s in stiffnesses] if row == len(rows) - 1 else [])
            axis.set_yticks(range(len(ages)), ages)
            axis.grid(False)
            axis.set_facecolor(style.PALE_GREY)  # of points that were not run
            if row == 0:
                axis.set_title(method)
            if column == 0:
                axis.set_ylabel(f"{scene}, {profile}\nage, ms")
    for axis in axes[-1]:
        axis.set_xlabel("stiffness, N/mm")
    figure.colorbar(image, ax=axes, label="share of clean runs (grey: not run)", shrink=0.6)
    return style.save(figure, directory, "stability-map")


TEXT = """# Stability maps

Made by `lmdbench-study stability`{commit} ({runs} closed loops) and `scripts/figures/stability_map.py`.

The device (0.075 kg, hand `postural-arm`, 1 kHz) is pressed into the contact by {load} N while the hand trembles, {seeds} tremors a point
(`src/lmdbench/stability/stability_map.h`). Stiffness is K_eff of the exact set at the first pose; all methods get the same F_max. Age: a search
starts every so many frames and its set arrives as many later; `certified` and `nearest` search in every frame. The exact boundary of one linear
contact with this hand is 12,932 N/m. Energy balances close to {balance:.0e} of the energy moved.

- *Shakes*: contact lost after it had settled, or more than a tenth of the load above 30 Hz.
- *Through*: the meshes touch, so the stiffness did not carry the load.
- *Clean*: neither.

![share of clean runs over stiffness and age](stability-map.png)

## Largest clean stiffness, N/m

From the largest of the stiffnesses tried at which all {seeds} runs are clean to the next one, at which not all are. A soft contact rests farther out
on its exponential: its slope under the load is less than at the first pose.

{headline}

- `original`: on the large triangles of box, wedge and peg its feature points miss the contact; on the bunny its force jumps and drops out while the
  load pushes it through. Claim K1 (unusable when hard) holds in the closed loop.
- `improved`: its soft box is never clean in all runs. Age costs it the hard box from 5 ms on; hard wedge and peg bear 20 ms as well as none.
- `nearest` moves as `certified` does, to all digits shown, where there is one contact (box, wedge; on the box the power created differs by up to
  0.012 mW), and is worse on the peg, where there are several. On the bunny its one spring has a lower K_eff: it falls through where `certified`
  carries, and stays clean at higher stiffness.
- Clean is a band: at low stiffness the forces, clipped at F_max, do not carry the load.

## Clean runs

Of {seeds}; 95 % intervals (Wilson): {intervals}.

{counts}

## What was measured

Means over the tremors with 95 % intervals (Student), methods that track at an age of {age} ms.

{details}
"""


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUNS.jsonl", help="what 'lmdbench-study stability' printed")
    parser.add_argument("--commit", help="of the program that made the runs, for the table")
    parser.add_argument("--out", default="results/figures", help="folder of the tables and the figure")
    options = parser.parse_args(argv)
    points = read_runs(options.runs)
    if not points:
        raise ResultError(f"{options.runs[0]}: holds no run (remedy: run 'lmdbench-study stability')")
    every = [runs for by in points.values() for runs in by.values()]
    seeds = max(map(len, every))
    write_text(TEXT.format(runs=sum(map(len, every)), seeds=seeds, load=1, age=DETAIL_AGE_FRAMES,
                           commit=f" at commit {options.commit}" if options.commit else "",
                           balance=max(abs(run["balance_error"]) for runs in every for run in runs),
                           intervals=", ".join(f"{n}{' of ' + str(seeds) if n == 0 else ''} [{low:.2f}, {high:.2f}]"
                                               for n in (0, seeds // 2, seeds) for low, high in [wilson(n, seeds)]), headline=headline(points), counts=counts(points),
                           details=details(points)), options.out, "stability-map.md")
    draw(points, options.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
