# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""How often the regression check cries wolf, and which slowdowns it sees: the whole rule of scripts/ci/regression.py, many
times over, every comparison with processes of its own. The candidate is the base itself ("again") or the base with work
planted in one stage. Needs a program that was configured with -DLMDBENCH_PLANTED_SLOWDOWN=ON.

    python3 scripts/ci/verdict_study.py run --program build/planted/lmdbench --out results/verdicts --condition idle \\
        --variants again --comparisons 500 --minutes 8
    python3 scripts/ci/verdict_study.py table --out results/verdicts

`run` adds comparisons to results/verdicts/comparisons.jsonl, a line each, until there are as many of the condition and
variants or the time is up; `table` writes verdicts.md and verdicts.png beside it."""

import argparse
import itertools
import json
import math
import os
import random
import shutil
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.path.insert(0, os.path.join(HERE, "..", "figures"))

import interpreter  # noqa: E402, F401  (in the figures' folder; chooses one that has what follows)
import intervals  # noqa: E402
import outcome  # noqa: E402
import regression  # noqa: E402
import tables  # noqa: E402

AGAIN = "again"
# Every method has its turn, and every stage of the improved one.
STAGES = ("improved:search", "certified:local update", "original:search", "improved:reduction", "improved:local update",
          "original:local update")
# 0.1 s on an idle machine: no probes, no free flight; certified and the paper's two methods.
SCENE = (os.path.join(regression.ROOT, "experiments", "shapes.json"), "--set", "/probes/truth/stride_frames=0", "--set",
         "/probes/fcl/stride_frames=0", "--set", "/frames=400", "--set", "/driver/repetitions=4", "--set",
         '/methods/-={"name":"certified","force_law":"exponential"}')
VARIABLE = "LMDBENCH_PLANTED"
LEAST_DRAWN = 20  # comparisons of the base with itself; fewer give no curve


def planted(variant, index):
    """(stage, value of VARIABLE for the candidate, the same length for the base: its length moves the stack)."""
    if variant == AGAIN:
        return "", "", ""
    stage = STAGES[index % len(STAGES)]
    value = f"{stage}:{variant}"
    return stage, value, "-" * len(stage.split(":")[0]) + value[value.index(":"):]


def one_comparison(arguments, variant, index):
    results = tempfile.mkdtemp(prefix="verdicts-")  # TMPDIR=/dev/shm: no waiting for a disk
    programs = {}
    for name in regression.NAMES:
        programs[name] = os.path.join(os.path.abspath(arguments.out), "bin", name, "lmdbench")
    stage, ours, theirs = planted(variant, index)
    environments = {name: {VARIABLE: ours if name == "cand" else theirs} for name in regression.NAMES}
    comparison = regression.Regression(programs, os.path.abspath(arguments.judge or arguments.program), SCENE, results,
                                       environments=environments, generator=random.Random(f"{variant} {index}"))
    started, load = time.monotonic(), os.getloadavg()[0]
    try:
        word, why = comparison.behaviour() or comparison.times(arguments.pairs, arguments.most)
    finally:
        shutil.rmtree(results)
    return {"condition": arguments.condition, "variant": variant, "index": index, "stage": stage, "verdict": word, "why": why,
            "named": stage.replace(":", "'s ") in why if stage else False, "rounds": comparison.rounds,
            "load": round(0.5 * (load + os.getloadavg()[0]), 2), "seconds": round(time.monotonic() - started, 2),
            "looks": comparison.looks}


def read(out):
    file = os.path.join(out, "comparisons.jsonl")
    if not os.path.exists(file):
        return []
    with open(file, encoding="utf-8") as stream:
        return [json.loads(line) for line in stream]


def run(arguments):
    variants = arguments.variants.split(",")
    end = time.monotonic() + 60 * arguments.minutes
    for name in regression.NAMES:
        place = os.path.join(arguments.out, "bin", name)
        os.makedirs(place, exist_ok=True)
        shutil.copy2(arguments.program, os.path.join(place, "lmdbench"))
    done = [row for row in read(arguments.out) if row["condition"] == arguments.condition]
    counts = {variant: sum(row["variant"] == variant for row in done) for variant in variants}
    with open(os.path.join(arguments.out, "comparisons.jsonl"), "a", encoding="utf-8") as stream:
        for variant in itertools.cycle(variants):
            if time.monotonic() > end or min(counts.values()) >= arguments.comparisons:
                break
            if counts[variant] >= arguments.comparisons:
                continue
            stream.write(json.dumps(one_comparison(arguments, variant, counts[variant])) + "\n")
            stream.flush()
            counts[variant] += 1
    print(", ".join(f"{count} of {variant}" for variant, count in counts.items()))


def share(count, total):
    low, high = intervals.share_interval(count, total)
    return f"{count} ({100 * count / total:.1f} %, {100 * low:.1f} to {100 * high:.1f})"


def quantile(values, part):
    """The value at the nearest rank."""
    values = sorted(values)
    return values[max(0, math.ceil(part * len(values)) - 1)]


def table(rows):
    lines = []
    for condition in sorted({row["condition"] for row in rows}):
        for variant in sorted({row["variant"] for row in rows}, key=lambda name: 0 if name == AGAIN else int(name)):
            chosen = [row for row in rows if row["condition"] == condition and row["variant"] == variant]
            if not chosen:
                continue
            total = len(chosen)
            count = {word: sum(row["verdict"] == word for row in chosen) for word in outcome.EXIT_CODES}
            named = "" if variant == AGAIN else sum(row["verdict"] == "slower" and row["named"] for row in chosen)
            seconds, loads = [row["seconds"] for row in chosen], [row["load"] for row in chosen]
            label = "nothing" if variant == AGAIN else variant + " %"
            lines.append([condition, label, total, share(count["slower"], total), named, share(count["unsure"], total), count["same"], count["faster"],
                          f"{sum(row['rounds'] for row in chosen) / total:.1f}",
                          f"{quantile(seconds, 0.5):.1f}, {quantile(seconds, 0.99):.1f}, {max(seconds):.1f}", f"{min(loads):.1f} to {max(loads):.1f}"])
    return "\n".join(tables.table(["condition", "planted", "comparisons", "slower (95 % interval)", "right stage named", "unsure", "same", "faster",
                                   "rounds, mean", "s a verdict: median, p99, worst", "load"], lines))


def draw(rows, file):
    """Share of planted slowdowns found over share of false alarms, at the first look, as the ratio moves that the interval's
    lower end of any stage must exceed; and where the whole rule stands."""
    import figure_style  # noqa: F401  sets matplotlib's backend
    from matplotlib import pyplot

    nothing = [row["condition"] for row in rows if row["variant"] == AGAIN]
    conditions = sorted(name for name in set(nothing) if nothing.count(name) >= LEAST_DRAWN)
    if not conditions:
        return
    sizes = sorted({row["variant"] for row in rows} - {AGAIN}, key=int)
    figure, panels = pyplot.subplots(1, len(conditions), figsize=(4.6 * len(conditions), 4.2), squeeze=False, sharey=True)
    for axes, condition in zip(panels[0], conditions):
        of = {}
        for row in rows:
            if row["condition"] == condition:
                of.setdefault(row["variant"], []).append(row)
        null = [row["looks"][0]["highest_low"] for row in of.get(AGAIN, []) if row["looks"]]
        for colour, variant in enumerate(sizes):
            found = [row["looks"][0]["highest_low"] for row in of.get(variant, []) if row["looks"]]
            if not found:
                continue
            cuts = sorted(set(null + found), reverse=True) + [0.0]
            axes.step([sum(v > cut for v in null) / len(null) for cut in cuts],
                      [sum(v > cut for v in found) / len(found) for cut in cuts], where="post", color=f"C{colour}",
                      label=f"{variant} % planted, {len(found)} comparisons")
            axes.plot(sum(row["verdict"] == "slower" for row in of[AGAIN]) / len(of[AGAIN]),
                      sum(row["verdict"] == "slower" for row in of[variant]) / len(of[variant]), "o", color=f"C{colour}")
        axes.set(title=condition, xlabel=f"false alarms (share of {len(null)} equal programs)", xlim=(-0.02, 1.0), ylim=(0.0, 1.02))
        axes.legend(loc="lower right", fontsize=8, title="line: first look alone; dot: whole rule", title_fontsize=8)
    panels[0][0].set_ylabel("slowdowns found (share)")
    figure.tight_layout()
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    runs = commands.add_parser("run")
    runs.add_argument("--program", required=True)
    runs.add_argument("--judge", help="whose `compare` judges (the program's)")
    runs.add_argument("--condition", required=True, help="a name for the state of the machine")
    runs.add_argument("--variants", default=f"{AGAIN},3,5,10,20", help="what is planted, in percent, or 'again'")
    runs.add_argument("--comparisons", type=int, default=500, help="of each variant, those of earlier calls included")
    runs.add_argument("--minutes", type=float, default=8.0)
    runs.add_argument("--pairs", type=int, default=6)
    runs.add_argument("--most", type=int, default=24)
    for command in (runs, commands.add_parser("table")):
        command.add_argument("--out", required=True)
    arguments = parser.parse_args()
    if arguments.command == "run":
        run(arguments)
        return 0
    rows = read(arguments.out)
    if not rows:
        raise SystemExit(f"error: {arguments.out} holds no comparisons (remedy: verdict_study.py run)")
    text = table(rows)
    with open(os.path.join(arguments.out, "verdicts.md"), "w", encoding="utf-8") as stream:
        stream.write(text)
    draw(rows, os.path.join(arguments.out, "verdicts.png"))
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
