#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to the paper's figures: packages, build, meshes, hard and soft experiment, a
# small sweep of error against time, figures, page, summary. Leaves results/bunny-hard.h5,
# results/bunny-soft.h5, results/quick.h5, results/figures/ and results/report/index.html. The
# summary goes to standard output, everything else to standard error.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
(($# == 0)) || die 2 "unknown argument '$1' (remedy: ./scripts/reproduce.sh takes none)"
cd "$ROOT"

EXPERIMENTS=(bunny-hard bunny-soft)
LMDBENCH=build/release/lmdbench
FIGURES=results/figures
REPORT=results/report
started=$EPOCHREALTIME

# A failing step stops the script; the times so far are still printed.
trap 'print_steps; say "  in all: $(seconds_since "$started")"' EXIT

# The meshes that the experiments name, each once.
meshes_of_experiments() {
  local names meshes
  names="$("$PYTHON" - "${EXPERIMENTS[@]}" <<'PYTHON_END'
import json
import sys

names = set()
for name in sys.argv[1:]:
    with open(f"experiments/{name}.json", encoding="utf-8") as file:
        experiment = json.load(file)
    names.update(body["mesh"] for body in [experiment["moving"], *experiment["fixed"]])
print("\n".join(sorted(names)))
PYTHON_END
)" || return
  mapfile -t meshes <<<"$names"
  build_meshes "$LMDBENCH" "${meshes[@]}"
}

# Only the program: tests and benchmarks belong to scripts/test.sh.
build_program() { cmake --preset release && cmake --build --preset release --parallel "$JOBS" --target lmdbench; }

# With the methods' own LMD sets, which the page shows beside the true ones. Goes on with a run that
# was stopped.
run_experiment() { "$LMDBENCH" run "experiments/$1.json" --out "results/$1.h5" --set /record/lmds=true --resume </dev/null >&2; }

# Figures 1 to 6: meshes, hierarchy, tests, neighbourhoods, visibility, on the soft contact's path.
paper_figures() {
  local number
  for number in 1 2 3 4 5 6; do
    "$PYTHON" "scripts/figures/figure$number.py" experiments/bunny-soft.json --program "$LMDBENCH" --out "$FIGURES" >&2 || return
  done
}

# Error against time over the search period; points of a stopped run come from its journal.
run_sweep() { "$LMDBENCH" work-precision "experiments/sweeps/$1.json" --out "results/$1.h5" </dev/null >&2; }

figures() {
  mkdir -p "$FIGURES" && paper_figures &&
    "$PYTHON" scripts/figures/sweep.py "$SWEEP" --out "$FIGURES" >&2 &&
    "$PYTHON" scripts/figures/figure7.py "$HARD" "$SOFT" --out "$FIGURES" >&2 &&
    "$PYTHON" scripts/figures/work_precision.py "$HARD" "$SOFT" --out "$FIGURES" >&2 &&
    "$PYTHON" scripts/figures/claims.py "$HARD" "$SOFT" --out "$FIGURES" >&2
}

page() { "$LMDBENCH" report "$HARD" "$SOFT" "$SWEEP" --out "$REPORT" --paper "$FIGURES" --study results/reference/*.md >&2; }

step "Packages" scripts/setup.sh
PYTHON="$(find_python h5py jinja2 markdown matplotlib numpy PIL)"
HARD=results/bunny-hard.h5
SOFT=results/bunny-soft.h5
SWEEP=results/quick.h5

step "Build" build_program >&2
step "Meshes" meshes_of_experiments
for experiment in "${EXPERIMENTS[@]}"; do
  step "Experiment $experiment" run_experiment "$experiment"
done
step "Error against run time" run_sweep quick
step "Figures" figures
step "Page" page
step "Summary" "$PYTHON" scripts/figures/summary.py "$HARD" "$SOFT" --files "$FIGURES"/* "$REPORT/index.html"
