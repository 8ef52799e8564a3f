#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs every method on the scenes of experiments/extreme: results/extreme/*.h5, summary.md and
# summary.json, and the table on standard output. Exit code 1 where a value is no number or an exact
# method is not exact.
#   scripts/extreme.sh [SCENE...]   only these, such as 'needles far'; all without any
#   LMDBENCH_BUILD=DIR              where the program is (build/release)
#   LMDBENCH_EXTREME=DIR            where the results go (results/extreme)
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

cd "$ROOT"
program="${LMDBENCH_BUILD:-build/release}/lmdbench"
out="${LMDBENCH_EXTREME:-results/extreme}"
[[ -x $program ]] || die "$EXIT_ENVIRONMENT" "no program at $program (remedy: cmake --preset release && cmake --build --preset release)"
scenes=("$@")
(($#)) || mapfile -t scenes < <(basename -s .json experiments/extreme/*.json)
PYTHON="$(find_python h5py matplotlib numpy)"

mkdir -p "$out"
results=()
for scene in "${scenes[@]}"; do
  [[ -e experiments/extreme/$scene.json ]] || die 2 "no scene '$scene' (remedy: ls experiments/extreme)"
  run_anew "$program" "experiments/extreme/$scene.json" "$out/$scene.h5" --set /record/torque=true >/dev/null 2>"$out/$scene.log" || {
    status=$?
    cat "$out/$scene.log" >&2
    die 1 "scene $scene: exit code $status"
  }
  results+=("$out/$scene.h5")
done
"$PYTHON" scripts/figures/extreme.py "${results[@]}" --out "$out/summary" --check
