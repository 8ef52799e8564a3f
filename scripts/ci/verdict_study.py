# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""How often `lmdbench compare` cries wolf, and which slowdowns it sees.

Runs one experiment process by process, in rounds: the base, the base again, and the base with work planted in one stage
(3, 5, 10, 20 %), every round in an order of its own. A comparison takes the base and one of the others from so many
consecutive rounds; no process is used in two comparisons of a kind. Needs a program that was configured with
-DLMDBENCH_PLANTED_SLOWDOWN=ON.

    python3 scripts/ci/verdict_study.py run --program build/planted/lmdbench --out results/verdicts --minutes 30
    python3 scripts/ci/verdict_study.py judge --program build/release/lmdbench --out results/verdicts --processes 6

`run` adds rounds to what is there; `judge` writes verdicts.csv, verdicts.md and roc.png. Exit codes as lmdbench's."""

import argparse
import csv
import json
import os
import random
import subprocess
import sys
import time

SIZES = (3, 5, 10, 20)
# Every method has its turn, every stage too; the stage changes every ROUNDS_A_STAGE rounds.
STAGES = ("improved:search", "certified:local update", "original:search", "improved:reduction", "improved:local update",
          "original:local update")
ROUNDS_A_STAGE = 6
# A tenth of a second on an idle machine: probes and free flight left out, certified beside the paper's two methods.
SCENE = ("experiments/shapes.json", "--set", "/probes/truth/stride_frames=0", "--set", "/probes/fcl/stride_frames=0",
         "--set", "/frames=400", "--set", "/driver/repetitions=4", "--set",
         '/methods/-={"name":"certified","force_law":"exponential"}')


def stage_of(round_index):
    return STAGES[round_index // ROUNDS_A_STAGE % len(STAGES)]


def result_name(out, round_index, variant):
    return os.path.join(out, f"{round_index:05d}-{variant}.h5")


def variants():
    return ["base", "again"] + [f"planted{size}" for size in SIZES]


def run(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    first = 0
    while os.path.exists(result_name(arguments.out, first, "done")):
        first += 1
    end = time.monotonic() + 60 * arguments.minutes
    index = first
    while time.monotonic() < end:
        order = variants()
        random.Random(index).shuffle(order)
        started = time.monotonic()
        for variant in order:
            environment = dict(os.environ, LMDBENCH_PLANTED="")
            if variant.startswith("planted"):
                environment["LMDBENCH_PLANTED"] = f"{stage_of(index)}:{variant[len('planted'):]}"
            subprocess.run([os.path.abspath(arguments.program), "--quiet", "run", *SCENE, "--out",
                            os.path.abspath(result_name(arguments.out, index, variant))], cwd=root, env=environment,
                           check=True, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
        with open(result_name(arguments.out, index, "done"), "w", encoding="utf-8") as stream:
            stream.write(f"{os.getloadavg()[0]:.2f} {time.monotonic() - started:.2f}\n")
        index += 1
    print(f"{index - first} rounds, {index} in all")


def compare(program, base, candidate):
    started = time.monotonic()
    done = subprocess.run([program, "--quiet", "compare", "--json", "--base", *base, "--candidate", *candidate],
                          capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode not in (0, 1, 4):
        raise SystemExit(f"lmdbench compare left with {done.returncode}: {done.stderr}")
    return json.loads(done.stdout), time.monotonic() - started


def judge(arguments):
    rounds = 0
    while os.path.exists(result_name(arguments.out, rounds, "done")):
        rounds += 1
    rows = []
    for first in range(0, rounds - arguments.processes + 1, arguments.processes):
        indices = range(first, first + arguments.processes)
        if len({stage_of(i) for i in indices}) != 1:
            continue
        base = [result_name(arguments.out, i, "base") for i in indices]
        loads = []
        for i in indices:
            with open(result_name(arguments.out, i, "done"), encoding="utf-8") as stream:
                loads.append(float(stream.read().split()[0]))
        for variant in variants()[1:]:
            answer, seconds = compare(arguments.program, base,
                                      [result_name(arguments.out, i, variant) for i in indices])
            slower = [f"{t['method']}:{t['stage']}" for t in answer["timings"] if t["verdict"] == "slower"]
            planted = [t for t in answer["timings"] if f"{t['method']}:{t['stage']}" == stage_of(first)]
            rows.append({"variant": variant, "stage": stage_of(first), "load": f"{sum(loads) / len(loads):.1f}",
                         "verdict": answer["verdict"], "slower": " ".join(slower).replace("local update", "local_update"),
                         "named": int(stage_of(first) in slower), "ratio": planted[0]["ratio"],
                         "low": planted[0]["low"], "detectable": planted[0]["detectable"],
                         "highest_low": max(t["low"] for t in answer["timings"]), "seconds": f"{seconds:.2f}"})
    if not rows:
        raise SystemExit(f"error: {arguments.out} holds fewer than {arguments.processes} rounds (remedy: run more)")
    with open(os.path.join(arguments.out, "verdicts.csv"), "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    text = table(rows, arguments.processes)
    with open(os.path.join(arguments.out, "verdicts.md"), "w", encoding="utf-8") as stream:
        stream.write(text)
    draw(rows, os.path.join(arguments.out, "roc.png"))
    print(text)


def table(rows, processes):
    loads = [float(row["load"]) for row in rows]
    lines = [f"{processes} processes a side, load average {min(loads):.1f} to {max(loads):.1f}.", "",
             "| planted | comparisons | slower | right stage named | unsure | same | faster | median detectable |",
             "|---|---|---|---|---|---|---|---|"]
    for variant in variants()[1:]:
        chosen = [row for row in rows if row["variant"] == variant]
        if not chosen:
            continue
        count = {verdict: sum(row["verdict"] == verdict for row in chosen)
                 for verdict in ("slower", "unsure", "same", "faster")}
        detectable = sorted(row["detectable"] for row in chosen)[len(chosen) // 2]
        named = "" if variant == "again" else sum(row["named"] for row in chosen)
        label = "nothing (base again)" if variant == "again" else variant[len("planted"):] + " %"
        lines.append(f"| {label} | {len(chosen)} | {count['slower']} | {named} | {count['unsure']} | {count['same']} | "
                     f"{count['faster']} | {100 * detectable:.1f} % |")
    return "\n".join(lines) + "\n"


def draw(rows, file):
    """Share of planted slowdowns found over share of false alarms, as the bound that a stage's interval must exceed
    moves; the rule's own bound is 1."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    null = [row["highest_low"] for row in rows if row["variant"] == "again"]
    figure, axes = pyplot.subplots(figsize=(5.5, 4.5))
    for size in SIZES:
        planted = [row["highest_low"] for row in rows if row["variant"] == f"planted{size}"]
        cuts = sorted(set(null + planted + [0.0, 2.0 * max(null + planted)]), reverse=True)
        axes.step([sum(v > cut for v in null) / len(null) for cut in cuts],
                  [sum(v > cut for v in planted) / len(planted) for cut in cuts], where="post",
                  label=f"{size} % planted, {len(planted)} comparisons")
        axes.plot(sum(v > 1.0 for v in null) / len(null), sum(v > 1.0 for v in planted) / len(planted), "ko", markersize=4)
    axes.set_xlabel(f"false alarms (share of {len(null)} comparisons of the base with itself)")
    axes.set_ylabel("slowdowns found (share)")
    axes.set_xlim(-0.02, 1.0)
    axes.set_ylim(0.0, 1.02)
    axes.legend(loc="lower right", fontsize=8)
    axes.set_title("dots: interval above 1", fontsize=9)
    figure.tight_layout()
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("run", "judge"):
        command = commands.add_parser(name)
        command.add_argument("--program", required=True)
        command.add_argument("--out", required=True)
        if name == "run":
            command.add_argument("--minutes", type=float, default=30.0)
        else:
            command.add_argument("--processes", type=int, default=6)
    arguments = parser.parse_args()
    (run if arguments.command == "run" else judge)(arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
