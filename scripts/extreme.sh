#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs every method on the extreme scenes (experiments/extreme/). Leaves results/extreme/*.h5,
# summary.md and summary.json beside them, and prints the table. Exit code 1 if a value that must be
# a number is none, or if an exact method is not exact.
#   --program FILE   the program; build/release/lmdbench without it
#   --out DIR        folder of the result files; results/extreme without it
#   SCENE...         only these, such as 'needles far'; all without any
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

program="$ROOT/build/release/lmdbench"
out="$ROOT/results/extreme"
scenes=()
while (($# > 0)); do
  case "$1" in
    --program | --out)
      (($# > 1)) || die 2 "$1 needs a value (remedy: $1 NAME)"
      if [[ $1 == --program ]]; then program="$2"; else out="$2"; fi
      shift
      ;;
    -*) die 2 "unknown argument '$1' (remedy: ./scripts/extreme.sh [--program FILE] [--out DIR] [SCENE...])" ;;
    *)
      [[ -e $ROOT/experiments/extreme/$1.json ]] || die 2 "no scene '$1' (remedy: ls experiments/extreme)"
      scenes+=("$1")
      ;;
  esac
  shift
done
[[ -x $program ]] || die "$EXIT_ENVIRONMENT" "no program at $program (remedy: cmake --preset release && cmake --build --preset release)"
if ((${#scenes[@]} == 0)); then
  for file in "$ROOT"/experiments/extreme/*.json; do scenes+=("$(basename "$file" .json)"); done
fi
PYTHON="$(find_python h5py matplotlib numpy)"

mkdir -p "$out"
results=()
for scene in "${scenes[@]}"; do
  "$program" run "$ROOT/experiments/extreme/$scene.json" --set /record/torque=true --out "$out/$scene.h5" </dev/null >/dev/null 2>"$out/$scene.log" || {
    status=$?
    cat "$out/$scene.log" >&2
    die 1 "scene $scene: exit code $status"
  }
  results+=("$out/$scene.h5")
done
"$PYTHON" "$ROOT/scripts/figures/extreme.py" "${results[@]}" --out "$out/summary" --check
