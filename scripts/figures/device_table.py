#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Largest clean stiffness of PHANTOM presets: experiments/stability/device.json on each device, with its Coulomb friction and without
friction, where a closed form exists. Markdown on standard output. Exit code 1 where the frictionless rows are farther than TOLERANCE
from the closed form, or a search takes more processor time than MOST_SECONDS."""

import argparse
import json
import math
import os
import sys

import interpreter  # noqa: F401  (chooses one that has what follows)
from lmdbench_results import run_script
from program import PROGRAM, printed, settings_words, timed

DEVICES = ["phantom-desktop", "phantom-premium-1.5", "phantom-omni", "phantom-premium-3.0-6dof"]
FRICTIONS = [
    ("Coulomb", []),
    ("none, exact encoders", settings_words({"/loop/friction_n": 0, "/loop/resolution_m": 0})),
]
PERIOD_S = 1e-3
TOLERANCE = 1e-3
MOST_SECONDS = 30  # of processor time
WALL_SECONDS = 900  # of the clock, so that a machine under load has an answer, too


def closed_form(mass, damping):
    """K = b^2 (1 - a) / (m (1 - a - a b T / m)), a = e^(-b T / m): the wall held for a period, no delay, no friction. With x = b T / m the
    last bracket is a (e^x - 1 - x), whose difference loses its digits: as a series."""
    x = damping * PERIOD_S / mass
    remainder = sum(x ** n / math.factorial(n) for n in range(2, 12))
    return damping ** 2 * -math.expm1(-x) / (mass * math.exp(-x) * remainder)


def search(program, experiment, device, settings):
    words = [experiment, "--json", "--set", f"/device={device}", *settings]
    found, seconds = timed([program, "stability", *words, "--seconds", str(WALL_SECONDS)], allowed=(0, 3))  # 3: no answer, with its reason in the row
    return json.loads(found)[0], json.loads(printed([program, "plan", *words]))["experiment"]["loop"], seconds


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=PROGRAM)
    parser.add_argument("--experiment", default=os.path.join("experiments", "stability", "device.json"))
    arguments = parser.parse_args(argv)
    wrong = []
    print("| device | mass [kg] | damping [N s/m] | friction | [N] | encoder [um] | largest clean stiffness [N/m] | ends by | tap [mm] "
          "| linear boundary [N/m] | closed form | trials | processor time [s] |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for device in DEVICES:
        for name, settings in FRICTIONS:
            row, loop, seconds = search(arguments.program, arguments.experiment, device, settings)
            critical = row["critical_stiffness_n_per_m"]
            exact = closed_form(row["mass_kg"], row["damping_n_s_per_m"])
            shown = "none" if critical is None else f"{critical:,.5g}" if critical < 1000 else f"{critical:,.0f}"
            tap = "" if row["tap_m"] is None else f"{1e3 * row['tap_m']:.3g}"
            print(f"| {device} | {row['mass_kg']:g} | {row['damping_n_s_per_m']:g} | {name} | {loop['friction_n']:g} "
                  f"| {1e6 * loop['resolution_m']:g} | {shown} | {row['clean_until']} | {tap} | {row['exact_n_per_m']:.5g} "
                  f"| {exact:.5g} | {row['trials']} | {seconds:.1f} |")
            if loop["friction_n"] == 0 and (critical is None or abs(critical / exact - 1) > TOLERANCE):
                wrong.append(f"{device} without friction: {critical} N/m, closed form {exact} N/m")
            if seconds > MOST_SECONDS:
                wrong.append(f"{device}, {name}: {seconds:.0f} s")
    for sentence in wrong:
        print(sentence, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
