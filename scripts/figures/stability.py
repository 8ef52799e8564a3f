#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Largest clean stiffness of closed loops, found by 'lmdbench stability', against the exact boundary: tables
(stability.md) and a figure (stability.svg, stability.png). Every row is a search by simulation. Exit code 1 where a wall's
row is farther than TOLERANCE from the exact boundary."""

import argparse
import json
import math
import os
import sys
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)
import figure_style as style
from lmdbench_results import EXIT_CHECK_FAILED, run_script
from program import PROGRAM, printed, settings_words
from tables import shown, table_text, write_text

import matplotlib.pyplot as plt

TOLERANCE = 1e-3  # relative; for the wall

# (mass in kg, damping in N s/m): light and heavy, free and damped devices.
DEVICES = [(0.02, 0.5), (0.04, 0.8), (0.075, 0.2), (0.136, 2.0), (0.5, 5.0)]
RATES_HZ = [250, 1000, 4000, 10000]
DELAYS_FRAMES = [0, 1, 2, 5, 10, 20, 50]

# Six actuated degrees of freedom, contact 50 mm off: an immobile mass leaves a wall of K l^2.
LEVERS = [
    ("turns only", {"/loop/mass_kg": 1000, "/loop/damping_n_s_per_m": 10000, "/loop/rotation/inertia_kg_m2": 1e-4,
                    "/loop/rotation/damping_n_m_s": 2e-3}),
    ("moves and turns", {}),
    ("moves and turns, hand", {"/loop/hand": "postural-arm", "/loop/mass_kg": 0.136, "/loop/damping_n_s_per_m": 0.005}),
]
LEVER_DELAYS_FRAMES = [0, 1, 5, 20]

SCENES = ["box", "wedge", "peg", "bunny"]
SCENE_DELAYS_FRAMES = [0, 5]


class Searches:
    """Searches by the program, kept in a file of one JSON object a line, so that an interrupted table goes on."""

    def __init__(self, program, file):
        self.program = program
        self.file = file
        self.known = {}
        if os.path.exists(file):
            with open(file, encoding="utf-8") as stream:
                for line in stream:
                    entry = json.loads(line)
                    self.known[self.key(entry["experiment"], entry["settings"])] = entry["rows"]

    @staticmethod
    def key(experiment, settings):
        return json.dumps([os.path.basename(experiment), settings], sort_keys=True)

    def rows(self, experiment, settings):
        """Rows of one search; 'settings' maps JSON pointers to values."""
        key = self.key(experiment, settings)
        if key not in self.known:
            # 3: a row has no stiffness, and tells the reason
            said = printed([self.program, "stability", experiment, "--json", *settings_words(settings)], allowed=(0, 3))
            self.known[key] = json.loads(said)
            with open(self.file, "a", encoding="utf-8") as stream:
                stream.write(json.dumps({"experiment": experiment, "settings": settings, "rows": self.known[key]}) + "\n")
        return self.known[key]


def deviation(row):
    return row["critical_stiffness_n_per_m"] / row["exact_n_per_m"] - 1


def wall_rows(searches, folder):
    for mass, damping in DEVICES:
        for rate in RATES_HZ:
            for delay in DELAYS_FRAMES:
                yield from searches.rows(os.path.join(folder, "wall.json"), {
                    "/loop/mass_kg": mass, "/loop/damping_n_s_per_m": damping,
                    "/loop/delay_frames": delay, "/frame_rate_hz": rate})


def lever_rows(searches, folder):
    """(what the device does, row)"""
    for name, settings in LEVERS:
        for delay in LEVER_DELAYS_FRAMES:
            for row in searches.rows(os.path.join(folder, "wall-6dof.json"), {**settings, "/loop/delay_frames": delay}):
                yield name, row


def cells(row):
    """Of a row with an exact boundary, from its delay on."""
    return [row["delay_frames"], *(f"{row[name]:.7g}" for name in ("critical_stiffness_n_per_m", "exact_n_per_m", "bound_n_per_m")), f"{deviation(row):+.1e}"]


def lever_table(rows):
    return table_text(["device", "delay, frames", "critical, N/m", "exact, N/m", "bound, N/m", "difference"], [[name, *cells(row)] for name, row in rows])


def scene_rows(searches, folder):
    """(scene, profile, row)"""
    for scene in SCENES:
        file = os.path.join(folder, "stability", f"{scene}.json")
        profiles = json.loads(Path(file).read_text(encoding="utf-8"))["force"]
        for profile in profiles:
            for delay in SCENE_DELAYS_FRAMES:
                for row in searches.rows(file, {"/loop/delay_frames": delay, "/force": [profile]}):
                    yield scene, row["profile"], row


def number(value):
    return shown(value, 6, missing="none")


def wall_table(rows):
    return table_text(["mass, kg", "damping, N s/m", "rate, Hz", "delay, frames", "critical, N/m", "exact, N/m", "b/(T/2 + t_d), N/m", "difference"],
                      [[*(f"{row[name]:g}" for name in ("mass_kg", "damping_n_s_per_m", "servo_rate_hz")), *cells(row)] for row in rows])


def scene_table(rows):
    """One line a scene, profile and delay; a column a method."""
    methods = list(dict.fromkeys(row["method"] for _, _, row in rows))
    lines, groups = [], {}
    for scene, profile, row in rows:
        groups.setdefault((scene, profile, row["delay_frames"]), []).append(row)
    for (scene, profile, delay), group in groups.items():
        found = {row["method"]: row for row in group}
        ends = ", ".join(dict.fromkeys(row["clean_until"] for row in group))
        lines.append([scene, profile, delay, *(number(found[m]["critical_stiffness_n_per_m"]) for m in methods), number(group[0]["exact_n_per_m"]), ends])
    return table_text(["scene", "profile", "delay, frames", *(f"{m}, N/m" for m in methods), "one contact, exact, N/m", "ended by"], lines)


def draw(walls, scenes, directory):
    style.use_style()
    figure, axes = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS_IN, 3.0), layout="constrained")
    axes[0].set_xscale("symlog", linthresh=1)
    axes[0].set(yscale="log", xlabel="delay, frames", ylabel="largest clean stiffness, N/m", title="wall, 0.04 kg, 0.8 N s/m: found (points), exact (lines)")
    for rate, colour in zip(RATES_HZ, (style.VERMILLION, style.BLUE, style.GREEN, style.PURPLE)):
        rows = [r for r in walls if r["servo_rate_hz"] == rate and (r["mass_kg"], r["damping_n_s_per_m"]) == (0.04, 0.8)]
        delays = [r["delay_frames"] for r in rows]
        axes[0].plot(delays, [r["exact_n_per_m"] for r in rows], color=colour, label=f"{rate:g} Hz")
        axes[0].plot(delays, [r["critical_stiffness_n_per_m"] for r in rows], "o", color=colour, markersize=3)
    axes[0].legend()
    axes[1].set_title("with a hand, no delay; line: exact")
    places = list(dict.fromkeys((scene, profile) for scene, profile, _ in scenes))
    methods = list(dict.fromkeys(row["method"] for _, _, row in scenes))
    for i, method in enumerate(methods):
        rows = [(places.index((s, p)), r["critical_stiffness_n_per_m"] or math.nan, r["exact_n_per_m"])
                for s, p, r in scenes if r["method"] == method and r["delay_frames"] == 0]
        axes[1].plot([place + 0.2 * (i - (len(methods) - 1) / 2) for place, _, _ in rows], [found for _, found, _ in rows], "os^Dv"[i % 5],
                     color=style.METHOD_COLOURS[i % len(style.METHOD_COLOURS)], markersize=4, label=method)
        axes[1].plot([place for place, _, _ in rows], [exact for _, _, exact in rows], color=style.GREY, zorder=0)
    axes[1].set_yscale("log")
    axes[1].set_xticks(range(len(places)), [f"{scene}\n{profile}" for scene, profile in places])
    axes[1].legend(loc="lower left")
    return style.save(figure, directory, "stability")


def note(text):
    print(text, file=sys.stderr, flush=True)


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=PROGRAM, help="the program; %(default)s without it")
    parser.add_argument("--experiments", default="experiments", help="folder of the experiment files")
    parser.add_argument("--rows", default="results/stability.jsonl", help="searches already made; new ones are added")
    parser.add_argument("--out", default="results/figures", help="folder of the tables and the figure")
    options = parser.parse_args(argv)

    searches = Searches(options.program, options.rows)
    walls = []
    for row in wall_rows(searches, options.experiments):
        walls.append(row)
        note(f"wall {len(walls)} of {len(DEVICES) * len(RATES_HZ) * len(DELAYS_FRAMES)}: {deviation(row):+.1e}")
    levers = list(lever_rows(searches, options.experiments))
    scenes = []
    for scene, profile, row in scene_rows(searches, options.experiments):
        scenes.append((scene, profile, row))
        note(f"{scene}, {profile}, delay {row['delay_frames']}, {row['method']}: "
             f"{number(row['critical_stiffness_n_per_m'])} N/m, {row['clean_until']}")
    turned = max((row for _, row in levers), key=lambda row: abs(deviation(row)))
    worst = max(walls, key=lambda row: abs(deviation(row)))
    write_text(TEXT.format(count=len(walls), worst=deviation(worst), row=worst, scenes=scene_table(scenes), walls=wall_table(walls),
                           levers=lever_table(levers), turned=deviation(turned)), options.out, "stability.md")
    draw(walls, scenes, options.out)
    return EXIT_CHECK_FAILED if max(abs(deviation(worst)), abs(deviation(turned))) > TOLERANCE else 0


TEXT = """# Stability of the closed loop

Made by `scripts/figures/stability.py`. Each stiffness was found by simulation through meshes, method, force law, zero-order hold and delay: the
device rests in contact and is tapped (`src/lmdbench/stability/stability_trial.h`; what counts as clean: `src/lmdbench/metrics/cleanliness.h`).

![largest clean stiffness over delay](stability.png)

## Contacts with a hand

A device of 0.075 kg and 0.005 N s/m in the hand `postural-arm` (0.554 kg, 6.45 N s/m, 135 N/m). The hard profile is the experiment's; the soft one
has a cutoff five times as far and no saturation. Stiffness is the slope of the summed force along itself (K_eff where a method's set changes just at
rest). The paper's methods track in every frame, so at rest their sets do not age: the delay is the force's. Where contacts of several directions act
the loop is not one-dimensional and may end before the exact boundary of one contact.

{scenes}

*Undecided*: the time of the search was spent; the largest clean stiffness up to then, which depends on the machine's speed.

## Walls

{count} devices, rates and delays, `certified`, linear law, without hand, friction and quantisation. The largest difference to the exact boundary is
{worst:+.1e} ({row[mass_kg]:g} kg, {row[damping_n_s_per_m]:g} N s/m, {row[servo_rate_hz]:g} Hz, {row[delay_frames]} frames).

{walls}

## A contact on a lever

Six actuated degrees of freedom (`experiments/wall-6dof.json`): the contact is 50 mm beside the point that the device holds, which gives way by moving
and by turning; the boundary is that of both (`phantom/stability_boundary.h`). Inertia, damping and hand of the turn are those of the translation at a
lever of 50 mm (ours). In the first rows the device is too heavy to move and turns with 1e-4 kg m^2 and 2e-3 N m s: K l^2 is the critical stiffness of
a rotational wall. The largest difference is {turned:+.1e}.

{levers}
"""

if __name__ == "__main__":
    raise SystemExit(run_script(main))
