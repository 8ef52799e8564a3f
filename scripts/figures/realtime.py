#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's four threads on the clock: runs both bunnies, hard and soft, each method, over the floor of the machine; the force error
that age causes, by path speed, with and without prediction; overload; the closed loops. Leaves realtime.md and realtime.png.

What is there already is not run again, so the study can be made in parts: --parts names them, --most limits how many runs this call makes."""

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import interpreter  # noqa: F401  (chooses one that has what follows)

import numpy as np

import figure_style as style
from clock_results import Clock, age_table, clocks, draw_timing, excess_table, lateness_table, micro, role_table
from lmdbench_results import Result, ResultError, run_script
from program import PROGRAM, failure, printed, settings_words
from tables import table, write_text

import matplotlib.pyplot as plt

METHODS = {"original": "linear", "improved": "exponential", "certified": "exponential"}
SCENES = ("bunny-hard", "bunny-soft")
SPEEDS_MM_S = (1, 10, 100)
PREDICTIONS = ("none", "linear")
AGE_PATH_M = 0.01  # of the recorded path
AGE_SECONDS = 10.0
STOPPED_S = 0.3
WALL_SHARES = (0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05)  # of the lockstep's boundary
WALL_STEPS = 100  # of the simulated ball in a servo period: 10 us
WALL_WINDOW = 150  # frames
PARTS = ("clock", "free", "age", "overload", "closed")


class OutOfRuns(Exception):
    """This call has made as many runs as it may."""


class Study:
    def __init__(self, program, out, most, seconds):
        self.program, self.out, self.left, self.seconds = program, out, most, seconds
        self.missing, self.loads = [], []
        os.makedirs(out, exist_ok=True)

    def file(self, name):
        return os.path.join(self.out, name + ".h5")

    def command(self, experiment, file, settings):
        return [self.program, "-q", "run", experiment, "--out", file, *settings_words(settings)]

    def spend(self):
        if self.left == 0:
            raise OutOfRuns
        self.left -= 1

    def run(self, name, experiment, settings):
        """The result of a run, made unless it is there."""
        file = self.file(name)
        if not os.path.exists(file):
            self.spend()
            printed(self.command(experiment, file, settings))
        result = Result(file)
        self.loads.append(float(result.machine().get("load_average_1_minute", "nan")))
        return result

    def clock(self, name, experiment, settings):
        return clocks(self.run(name, experiment, {"/driver/kind": "realtime", **settings}))[0]

    def if_there(self, make, name, *arguments):
        """What `make` gives, or None where this call may make no more runs: then the tables go without it and say so."""
        try:
            return make(name, *arguments)
        except OutOfRuns:
            self.missing.append(name)
            return None


def one(method, **more):
    return {"/methods": [{"name": method, "force_law": METHODS[method], **more}]}


NO_PROBES = {"/probes/truth/stride_frames": 0, "/probes/fcl/stride_frames": 0}


def clock_part(study):
    named = []
    for scene in SCENES:
        for method in METHODS:
            settings = {**one(method), **NO_PROBES, "/driver/realtime/seconds": study.seconds}
            clock = study.if_there(study.clock, f"{scene}-{method}", f"experiments/{scene}.json", settings)
            if clock:
                named.append((f"{scene}, {method}", clock))
    if not named:
        return []
    style.save(draw_timing(named), study.out, "realtime-timing")
    searches = [[name, f"{clock.attribute('rate_hz', 'search'):.0f}", f"{clock.attribute('rate_hz', 'tracking'):.0f}"]
                if "search" in clock.roles() else [name, f"one loop: {clock.attribute('rate_hz', 'servo'):.0f}", "-"] for name, clock in named]
    refused = sorted({what for _, clock in named for what in clock.refused()})
    return ["## Both bunnies on the clock", "",
            f"{study.seconds:g} s each, two bunnies of 16,298 triangles, the recorded path there and back. Refused by the system: {'; '.join(refused) or 'nothing'}. "
            "What the empty loop is late by, under the same policy on the same core before and after each run, is the machine's own.", "",
            *excess_table(named), "", *answers(named), *lateness_table(named), "", "Rates and loads:", "", *role_table(named), "",
            "The paper: \"the thread can sometimes make only a several loops per second\" (section 5), on an Opteron 275 of 2005. Here:", "",
            *table(["run", "searches a second", "local updates a second"], searches), "Ages:", "", *age_table(
                [(name, clock) for name, clock in named if "search" in clock.roles()]), ""]


LARGEST_EXCESS_S = 20e-6


def answers(named):
    """K8 as the paper meant it, and what `certified` takes in one loop."""
    rows = []
    for name, clock in named:
        loads = {role: 100 * clock.attribute("load", role) for role in clock.roles()}
        excess = micro(clock.quantiles("excess")[0.99])
        if "tracking" in loads:
            rows.append([name, *(f"{load:.2f}" for load in (loads["servo"], loads["tracking"], loads["servo"] + loads["tracking"])), f"{loads['search']:.1f}", excess])
        else:
            rows.append([name, f"{loads['servo']:.2f}, searches included", "-", f"{loads['servo']:.2f}", "-", excess])
    lines = ["K8 (the PHANTOM loop takes much less than the other threads and can share a core with tracking): share of one core of servo loop and tracking, which "
             "shared it, and of the search:", "", *table(["run", "servo [%]", "tracking [%]", "both [%]", "search [%]", "servo loop beyond the floor, p99 [us]"], rows)[:-1]]
    for name, clock in named:
        if "search" in clock.roles():
            continue
        woken, force = clock.quantiles("excess")[0.99], clock.quantiles("response_excess")[0.99]

        def verdict(row):
            return "within" if row[2] <= LARGEST_EXCESS_S else "above" if row[1] > LARGEST_EXCESS_S else "not decided at"
        lines += ["", f"{name} in one loop, p99 over the floor: waking {micro(woken)} us, {verdict(woken)} 20 us; the force, its search included, {micro(force)} us, "
                  f"{verdict(force)} 20 us."]
    return [*lines, ""]


def free_part(study):
    """K9: local updates as fast as they come, on the core of the servo loop."""
    rows = []
    for scene in SCENES:
        for method in ("original", "improved"):
            settings = {**one(method), **NO_PROBES, "/driver/realtime/seconds": min(study.seconds, 20.0), "/driver/realtime/tracking_rate_hz": 0}
            clock = study.if_there(study.clock, f"free-{scene}-{method}", f"experiments/{scene}.json", settings)
            if not clock:
                continue
            turns, processor = (clock.attribute(key, "tracking") for key in ("turns", "processor_s"))
            rows.append([f"{scene}, {method}", f"{clock.attribute('rate_hz', 'tracking'):.0f}", f"{1e6 * processor / turns:.2f}", f"{turns / processor:.0f}",
                         f"{100 * clock.attribute('load', 'servo'):.2f}"])
    return ["## Local tracking as fast as it can (K9)", "",
            "Tracking without a grid, at normal priority on the servo loop's core, as the paper ran it; processor time of a turn is what a core of its own would give.", "",
            *table(["run", "updates a second", "processor time an update [us]", "updates a second of processor time", "servo loop's share of the core [%]"], rows)]


def scaled_path(study, speed):
    """The same stretch of the hard path at a mean speed [mm/s], there and back for AGE_SECONDS; at most 1000 poses a second."""
    poses = np.loadtxt(os.path.join("paths", "bunny-hard.tum"))
    # The recorded path is in contact from one second on.
    poses = poses[poses[:, 0] >= 1.0]
    way = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(poses[:, 1:4], axis=0), axis=1))))
    poses = poses[: np.searchsorted(way, AGE_PATH_M) + 1]
    factor = way[len(poses) - 1] / (1e-3 * speed) / (poses[-1, 0] - poses[0, 0])
    times = (poses[:, 0] - poses[0, 0]) * factor
    rows, start = [], 0.0
    forth, back = poses[:, 1:], poses[::-1, 1:]
    back_times = times[-1] - times[::-1]
    while start < AGE_SECONDS:
        for leg, leg_times in ((forth, times), (back, back_times)):
            rows += [np.concatenate(([start + t], pose)) for t, pose in zip(leg_times[:-1], leg[:-1])]
            start += times[-1]
    file = os.path.join(study.out, f"path-{speed}.tum")
    np.savetxt(file, np.array(rows), fmt="%.9g", header="time x y z qx qy qz qw")
    return os.path.abspath(file)


def age_part(study):
    """Force with aged sets against the same method's force with a set that was searched at the frame's own pose."""
    rows, points = [], {}
    for speed in SPEEDS_MM_S:
        path = scaled_path(study, speed)
        common = {"/path/file": path, "/frames": int(1000 * AGE_SECONDS), **NO_PROBES}
        for method in METHODS:
            fresh = study.if_there(study.run, f"fresh-{speed}-{method}", "experiments/bunny-hard.json", {
                **one(method), **common, "/driver/search_every_frames": 1, "/driver/search_latency_frames": 0, "/driver/repetitions": 1})
            if not fresh:
                continue
            true = fresh.methods[method].read("force")
            contact = fresh.in_contact()
            for prediction in PREDICTIONS if method != "certified" else PREDICTIONS[:1]:
                clock = study.if_there(study.clock, f"age-{speed}-{method}-{prediction}", "experiments/bunny-hard.json",
                                       {**one(method), **common, "/driver/prediction": prediction, "/driver/realtime/floor_s": 0.5})
                if not clock:
                    continue
                force = clock.result.methods[method].read("force")
                error = np.linalg.norm(force - true, axis=1)[contact]
                rms = float(np.sqrt(np.mean(error**2)))
                scale = float(np.sqrt(np.mean(np.sum(true[contact]**2, axis=1))))
                _, age, search_age = clock.ages_ms()
                points[method, prediction, speed] = rms
                rows.append([speed, method, prediction, f"{np.median(age):.2f}", f"{np.median(search_age):.2f}",
                             *(f"{value:.3g}" for value in (rms, np.median(error), np.quantile(error, 0.99), error.max())), f"{100 * rms / scale:.2g}"])
    style.save(draw_age(points), study.out, "realtime")
    return ["## Force error that age causes", "",
            f"{1e3 * AGE_PATH_M:.0f} mm of the hard path at three mean speeds, there and back for {AGE_SECONDS:g} s; hard profile (F_max 3 N, cutoff 0.75 mm). Error: length of the difference to "
            "the force of the same method whose set was searched at that very pose, over the frames in contact; so only age counts, not what the method misses.", "",
            *table(["mean speed [mm/s]", "method", "prediction", "age of the set, p50 [ms]", "since its search, p50 [ms]", "error, RMS [N]", "median [N]", "p99 [N]",
                    "largest [N]", "share of the RMS force [%]"], rows), "![Force error by speed and method, with and without prediction](realtime.png)", ""]


def draw_age(points):
    style.use_style()
    figure, axes = plt.subplots(figsize=(0.75 * style.TWO_COLUMNS_IN, 2.6))
    for order, method in enumerate(METHODS):
        for prediction in PREDICTIONS:
            values = [points.get((method, prediction, speed)) for speed in SPEEDS_MM_S]
            speeds = [speed for speed, value in zip(SPEEDS_MM_S, values) if value is not None]
            if not speeds:
                continue
            label = f"{method}, one loop" if method == "certified" else f"{method}{', predicted' if prediction == 'linear' else ''}"
            axes.plot(speeds, np.maximum([value for value in values if value is not None], 1e-7), color=style.METHOD_COLOURS[order], linestyle="--" if prediction == "linear" else "-",
                      marker="o", markersize=3, label=label)
    axes.set(xscale="log", yscale="log", xlabel="mean speed [mm/s]", ylabel="force error caused by age, RMS [N]")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    figure.tight_layout()
    return figure


def frames_of(clock):
    source = clock.read("frame_source")
    return {"ticks": int(np.sum(source == 0)), "skipped": int(np.sum(source == 1)), "lost": int(np.sum(source == 2)), "all": source.size}


def kept_grid(clock):
    """Every tick at its instant or later, in its period, none twice."""
    asked, woken, frame = (clock.read(f"servo/{name}") for name in ("asked", "woken", "frame"))
    period = clock.attribute("period_s")
    on_grid = np.allclose(np.round(asked / period) * period, asked, atol=1e-8, rtol=0)
    return bool(on_grid and np.all(woken >= asked) and np.all(np.diff(frame) > 0) and np.all(frame == np.floor((woken + 1e-10) / period)))


def run_with_a_stop(command, file, frames, seconds, **options):
    """SIGSTOP of the whole program for so long once the part of the result has so many frames."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **options) as process:
        while process.poll() is None and measured(file + ".part") < frames:
            time.sleep(0.02)
        process.send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        process.send_signal(signal.SIGCONT)
        errors = process.communicate()[1]
    if process.returncode != 0:
        raise failure(command, process.returncode, errors)


def stopped_process(study, experiment, settings):
    file = study.file("overload-sigstop")
    if not os.path.exists(file):
        study.spend()
        run_with_a_stop(study.command(experiment, file, {"/driver/kind": "realtime", **settings}), file, 1000, STOPPED_S)
    return clocks(Result(file))[0]


def measured(part):
    """Frames in the part file of a run that goes on."""
    import h5py
    try:
        with h5py.File(part, "r", locking=False) as h5:
            return int(h5["/frames_measured"][0])
    except (OSError, KeyError):
        return 0


# In its own mount namespace, on a small disk that fills once the run resumes. Prints its exit code.
FULL_DISK = """
mount -t tmpfs -o size=16m lmdbench "$1" || exit 99
disk=$1 keep=$2; shift 2
"$@" & run=$!
for _ in $(seq 600); do [ -s "$disk/full.h5.part" ] && break; sleep 0.1; done
sleep 4
dd if=/dev/zero of="$disk/filler" bs=4k 2>/dev/null
wait $run; echo $?
cp "$disk/full.h5.part" "$keep"
[ ! -e "$disk/full.h5" ]
"""


def full_disk(study, settings):
    """A disk that is full before the result can be written: what is said, and what is left; None where nobody may mount."""
    note = os.path.join(study.out, "overload-full-disk.json")
    if not os.path.exists(note):
        if os.geteuid() != 0:
            return None
        study.spend()
        kept = os.path.join(study.out, "overload-full-disk.part")
        with tempfile.TemporaryDirectory() as disk:
            command = study.command("experiments/bunny-hard.json", os.path.join(disk, "full.h5"), {"/driver/kind": "realtime", **settings})
            done = subprocess.run(["unshare", "--mount", "bash", "-c", FULL_DISK, "full", disk, kept, *command], capture_output=True, text=True,
                                  check=False, stdin=subprocess.DEVNULL)
            if not done.stdout.strip():
                raise ResultError(f"a full disk could not be made: {done.stderr}")
            said = [line.replace(disk, "DISK") for line in done.stderr.splitlines() if "error" in line]
        write_text(json.dumps({"exit": int(done.stdout.split()[0]), "error": said, "frames": measured(kept), "result": done.returncode != 0}), note)
    return json.loads(Path(note).read_text(encoding="utf-8"))


def overload_part(study):
    settings = {**one("improved"), **NO_PROBES, "/driver/realtime/seconds": 8}
    plants = (("nothing", {}), ("a search that sleeps 100 ms", {"search_sleep_s": 0.1}), ("a recorder that stands still 1 s, room for 256 ticks", {"recorder_stall_s": 1.0}),
              ("tracking stopped 0.3 s", {"stopped_role": "tracking", "stop_s": STOPPED_S}), ("search stopped 0.3 s", {"stopped_role": "search", "stop_s": STOPPED_S}),
              ("a neighbour of the same priority, 10 of 50 ms", {"neighbour_busy_s": 0.01}))
    rows = []

    def row(name, clock):
        frames = frames_of(clock)
        _, age, search_age = clock.ages_ms()
        whole = frames["ticks"] + frames["skipped"] + frames["lost"] == frames["all"]
        rows.append([name, *frames.values(), "yes" if kept_grid(clock) and whole else "NO", f"{age.max():.1f}", f"{search_age.max():.1f}"])

    for number, (name, plant) in enumerate(plants):
        more = {"/driver/realtime/queue_ticks": 256} if "recorder_stall_s" in plant else {}
        clock = study.if_there(study.clock, f"overload-{number}", "experiments/bunny-hard.json", {**settings, **more, "/driver/realtime/plant": plant})
        if clock:
            row(name, clock)
    stopped = study.if_there(lambda _: stopped_process(study, "experiments/bunny-hard.json", settings), "overload-sigstop")
    if stopped:
        row(f"the whole program stopped {STOPPED_S:g} s (SIGSTOP)", stopped)
    disk = study.if_there(lambda _: full_disk(study, settings), "overload-full-disk")
    lines = ["## Overload", "", "`improved` on the hard path for 8 s. Every frame is a tick, a skip that is counted, or a record that is counted as lost.", "",
             *table(["planted", "ticks", "skipped", "lost", "of frames", "grid kept", "age of the set, largest [ms]", "since its search, largest [ms]"], rows)]
    if disk:
        lines += [f"A disk that is full before the end: exit code {disk['exit']}, {disk['frames']} frames in the part file, result file "
                  f"{'there' if disk['result'] else 'not there'}: \"{' '.join(disk['error'])}\"", ""]
    elif os.geteuid() != 0:
        lines += ["A full disk was not tried: it takes root to make one.", ""]
    return lines


def growth(position):
    """Logarithm of the factor by which the swing grows in WALL_WINDOW frames: the slope over the first windows, before it is so wide that the
    ball leaves the plate."""
    windows = [position[i:i + WALL_WINDOW] for i in range(0, len(position) - WALL_WINDOW + 1, WALL_WINDOW)]
    spreads = [np.log(max(float(np.ptp(window[:, 2])), 1e-12)) for window in windows]
    return float(np.polyfit(np.arange(len(spreads)), spreads, 1)[0])


def crossing(shares, growths):
    """Where the growth turns positive, between the shares that enclose it; NaN where it does not."""
    for i in range(len(shares) - 1):
        if growths[i] <= 0.0 < growths[i + 1]:
            return shares[i] + (shares[i + 1] - shares[i]) * -growths[i] / (growths[i + 1] - growths[i])
    return float("nan")


def closed_part(study):
    """The wall's boundary by the lockstep, and what the clock makes of stiffnesses about it."""
    boundary = json.loads(printed([study.program, "-q", "stability", "experiments/wall.json", "--json"]))[0]["critical_stiffness_n_per_m"]
    lines = ["## Closed loops", "", f"`wall`: the lockstep's boundary is {boundary:.5g} N/m. At shares of it the ball swings about its place of rest for 0.6 s; does the swing grow? "
             "On the clock a force "
             f"comes later than the pose that it is for, and the simulated ball feels that, in steps of 10 us. With a delay t_d the boundary b / (T/2 + t_d) falls to T/2 / (T/2 + t_d) of it.", "",
             f"| share of the boundary | growth in {WALL_WINDOW} ms, lockstep | on the clock | pose to force, mean [us] | periods skipped |", "|---|---|---|---|---|"]
    stills, ticking, delays = [], [], []
    for share in WALL_SHARES:
        settings = {"/force/maximum_force_n": boundary * share * 0.02, **NO_PROBES, "/frames": 4 * WALL_WINDOW, "/loop/push_n": [0, 0, -0.02]}
        lockstep = study.if_there(study.run, f"wall-{share}-lockstep", "experiments/wall.json", settings)
        clock = study.if_there(study.clock, f"wall-{share}-clock", "experiments/wall.json", {**settings, "/driver/realtime/device_steps": WALL_STEPS, "/driver/realtime/floor_s": 0.5})
        if not lockstep or not clock:
            continue
        method = next(iter(lockstep.methods))
        stills.append(growth(lockstep.methods[method].read("loop/position")))
        ticking.append(growth(clock.result.methods[method].read("loop/position")))
        delays.append(float(np.mean(clock.read("servo/done") - clock.read("servo/woken"))))
        lines.append(f"| {share} | {np.exp(stills[-1]):.3f} | {np.exp(ticking[-1]):.3f} | {1e6 * delays[-1]:.0f} | {frames_of(clock)['skipped']} |")
    delay, half = float(np.mean(delays)) if delays else float("nan"), 0.5e-3
    if len(delays) == len(WALL_SHARES):
        lines += ["", f"Where it turns: lockstep {crossing(WALL_SHARES, stills):.3f}, on the clock {crossing(WALL_SHARES, ticking):.3f} of the boundary; a delay of {1e6 * delay:.0f} us makes "
              f"{half / (half + delay):.3f} of it."]
    lines += ["", "`bunny-closed`: an arm draws the simulated PHANTOM along the recorded path.", "",
              "| driver | method | RMS force [N] | force above 30 Hz [N] | energy created [mJ] | distance from the lockstep's device at ticks, RMS [mm] |", "|---|---|---|---|---|---|"]
    lockstep = study.if_there(study.run, "bunny-closed-lockstep", "experiments/bunny-closed.json", NO_PROBES)
    result = study.if_there(study.run, "bunny-closed-clock", "experiments/bunny-closed.json", {"/driver/kind": "realtime", **NO_PROBES})
    if not lockstep or not result:
        return [*lines, ""]
    for label, method in result.methods.items():
        for driver, of in (("lockstep", lockstep.methods[label]), ("clock", method)):
            force = of.force_magnitude()
            apart = np.linalg.norm(of.read("loop/position") - lockstep.methods[label].read("loop/position"), axis=1)
            if driver == "clock":
                apart = apart[Clock(result, label).read("frame_source") == 0]  # else that of the tick before
            lines.append(f"| {driver} | {label} | {np.sqrt(np.mean(force**2)):.3g} | {of.number('force_above_30_hz_n'):.3g} | {1e3 * of.number('energy_created_j'):.3g} | "
                         f"{1e3 * np.sqrt(np.mean(apart**2)):.3g} |")
    return [*lines, ""]


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=PROGRAM)
    parser.add_argument("--out", default="results/realtime", help="folder of results, realtime.md and figures")
    parser.add_argument("--seconds", type=float, default=60.0, help="of each run on the clock")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS)
    parser.add_argument("--most", type=int, default=-1, help="runs of this call; later calls go on; 0: tables of what is there")
    arguments = parser.parse_args(argv)
    study = Study(arguments.program, arguments.out, arguments.most, arguments.seconds)
    lines = ["# On the clock", "", "Made by `scripts/figures/realtime.py`. Lateness is that of every instant of the grid, also of those skipped, which wait for the next tick. "
             "Intervals are 95 %, by blocks of 100 instants.", ""]
    makers = {"clock": clock_part, "free": free_part, "age": age_part, "overload": overload_part, "closed": closed_part}
    for part in arguments.parts:
        study.loads = []
        made = makers[part](study)
        if study.loads and made:
            made[1:1] = ["", f"Load of the machine before these runs: {min(study.loads):.1f} to {max(study.loads):.1f} on {os.cpu_count()} processors."]
        lines += made
    if study.missing:
        lines += [f"Not run: {', '.join(study.missing)}.", ""]
        print(f"{len(study.missing)} runs are missing: call again", file=sys.stderr)
    print(write_text("\n".join(lines), arguments.out, "realtime.md"))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_script(main))
