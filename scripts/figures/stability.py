#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Largest clean stiffness of closed loops, measured by 'lmdbench stability', against the exact boundary.

Runs the wall over devices, servo rates and delays, every row one search by the simulation, and prints the tables of
results/reference/stability.md. Ends with exit code 1 where a wall's row is farther than TOLERANCE from the exact boundary.
"""

import argparse
import json
import subprocess
import sys

TOLERANCE = 1e-3  # relative: what the wall must reach

# (mass in kg, damping in N s/m): light and heavy, free and damped devices.
DEVICES = [(0.02, 0.5), (0.04, 0.8), (0.075, 0.2), (0.136, 2.0), (0.5, 5.0)]
RATES_HZ = [250, 1000, 4000, 10000]
DELAYS_FRAMES = [0, 1, 2, 5, 10, 20, 50]


def search(program, experiment, settings):
    """Rows of one search; 'settings' maps JSON pointers to values."""
    command = [program, "stability", experiment, "--json"]
    for pointer, value in settings.items():
        command += ["--set", f"{pointer}={json.dumps(value)}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"stability.py: {' '.join(command)} failed:\n{done.stderr}")
    return json.loads(done.stdout)


def deviation(row):
    return row["critical_stiffness_n_per_m"] / row["exact_n_per_m"] - 1


def wall_rows(program, experiment):
    for mass, damping in DEVICES:
        for rate in RATES_HZ:
            for delay in DELAYS_FRAMES:
                yield from search(program, experiment, {
                    "/loop/mass_kg": mass, "/loop/damping_n_s_per_m": damping,
                    "/loop/delay_frames": delay, "/frame_rate_hz": rate})


def wall_table(rows):
    lines = ["| mass, kg | damping, N s/m | rate, Hz | delay, frames | critical, N/m | exact, N/m | b/(T/2 + t_d), N/m "
             "| difference |", "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['mass_kg']:g} | {row['damping_n_s_per_m']:g} | {row['servo_rate_hz']:g} "
                     f"| {row['delay_frames']} | {row['critical_stiffness_n_per_m']:.7g} | {row['exact_n_per_m']:.7g} "
                     f"| {row['bound_n_per_m']:.7g} | {deviation(row):+.1e} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/lmdbench")
    parser.add_argument("--wall", default="experiments/wall.json")
    parser.add_argument("--out", help="write the tables to this file instead of standard output")
    options = parser.parse_args()

    rows = []
    for row in wall_rows(options.program, options.wall):
        rows.append(row)
        print(f"{len(rows)} of {len(DEVICES) * len(RATES_HZ) * len(DELAYS_FRAMES)}: {deviation(row):+.1e}",
              file=sys.stderr)
    worst = max(rows, key=lambda row: abs(deviation(row)))
    text = (f"{len(rows)} walls; the largest difference to the exact boundary is {deviation(worst):+.1e} "
            f"({worst['mass_kg']:g} kg, {worst['damping_n_s_per_m']:g} N s/m, {worst['servo_rate_hz']:g} Hz, "
            f"{worst['delay_frames']} frames).\n\n{wall_table(rows)}\n")
    if options.out:
        with open(options.out, "w", encoding="ascii") as file:
            file.write(text)
    else:
        print(text, end="")
    if abs(deviation(worst)) > TOLERANCE:
        sys.exit("stability.py: a wall is farther from the exact boundary than it may be")


if __name__ == "__main__":
    main()
