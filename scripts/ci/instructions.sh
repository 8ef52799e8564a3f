#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Compares the instructions that two builds spend in the methods' searches and trackings, counted by callgrind: equal within
# 2 in 100,000 from run to run (addresses of memory), whatever else the machine does. Valgrind knows no AVX-512 and tells programs so, so the kernels that
# choose their instructions at run time take their AVX2 form: a change of an AVX-512 form alone does not show here.
#
#   scripts/ci/instructions.sh BASE_PROGRAM CANDIDATE_PROGRAM EXPERIMENT SHARE FOLDER [--set PTR=VALUE]...
#
# Prints a table. Exit code: 1 where a function needs more than SHARE (0.01: 1 %) more instructions, 4 without valgrind.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/../lib.sh"
(($# >= 5)) || die 2 "$# arguments (remedy: BASE_PROGRAM CANDIDATE_PROGRAM EXPERIMENT SHARE FOLDER)"
base="$1" candidate="$2" experiment="$3" share="$4" folder="$5"
overrides=("${@:6}")
command -v valgrind >/dev/null || die "$EXIT_ENVIRONMENT" "no valgrind (remedy: ./scripts/setup.sh)"
mkdir -p "$folder"

# count PROGRAM NAME: lines "Method::function instructions" of one run, in $folder/NAME.txt. One repetition counts the same
# as many; address randomisation off: sizes of hash tables and alignments are then the same, too.
count() {
  local program="$1" name="$2"
  (cd "$ROOT" && setarch --addr-no-randomize valgrind --tool=callgrind --callgrind-out-file="$folder/$name.callgrind" \
    "$program" --quiet run "$experiment" "${overrides[@]}" --set /driver/repetitions=1 --set /probes/truth/stride_frames=0 \
    --set /probes/fcl/stride_frames=0 --set /frames=400 --out "$folder/$name.h5") >"$folder/$name.log" 2>&1 </dev/null ||
    die "$EXIT_ENVIRONMENT" "callgrind failed on $program, see $folder/$name.log"
  callgrind_annotate --inclusive=yes --threshold=100 "$folder/$name.callgrind" 2>/dev/null |
    sed -nE 's/^ *([0-9,]+) .*[:]lmdbench::([A-Za-z]+::(search|track))\(lmdbench::Pose.*$/\2 \1/p' |
    tr -d , | sort -u -k1,1 >"$folder/$name.txt"
  [[ -s $folder/$name.txt ]] || die "$EXIT_ENVIRONMENT" "callgrind saw no search in $program (remedy: keep its symbols)"
}
count "$base" base
count "$candidate" candidate

join "$folder/base.txt" "$folder/candidate.txt" | awk -v share="$share" '
  BEGIN { printf "%-24s %14s %14s %9s\n", "instructions of", "base", "candidate", "change" }
  {
    change = $2 > 0 ? $3 / $2 - 1 : ($3 > 0 ? 1 : 0)
    mark = ""
    if (change > share) { mark = "  slower"; slower = 1 }
    printf "%-24s %14d %14d %+8.2f %%%s\n", $1, $2, $3, 100 * change, mark
  }
  END { exit slower ? 1 : 0 }'
