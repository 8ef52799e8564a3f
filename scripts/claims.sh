#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# The region of our free choices in which each claim of the paper holds: makes paths of other seeds, runs the sweeps
# experiments/sweeps/claim-*.json and judges. Stopped and started again it goes on where it was. Leaves results/claims/.
#   scripts/claims.sh [SWEEP...]   only these, such as claim-k3
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT"
LMDBENCH=build/release/lmdbench
OUT=results/claims
PATHS=3
PYTHON="$(find_python h5py numpy)"
mkdir -p "$OUT"

# The hard contact's specification from another seed.
make_path() {
  local spec="$OUT/hard-$1.json" file="$OUT/hard-$1.tum"
  [[ -s $file ]] && return 0
  sed "s/\"seed\": 1,/\"seed\": $((100 + 10#$1)),/" paths/bunny-hard.json >"$spec"
  "$LMDBENCH" path generate "$spec" --out "$file" >/dev/null
}

sweeps=("$@")
if ((${#sweeps[@]} == 0)); then
  for file in experiments/sweeps/claim-*.json; do sweeps+=("$(basename "$file" .json)"); done
fi
for sweep in "${sweeps[@]}"; do
  if [[ $sweep == claim-k1 ]]; then
    for ((i = 1; i <= PATHS; i++)); do make_path "$(printf '%02d' "$i")"; done
  fi
  step "$sweep" "$LMDBENCH" work-precision "experiments/sweeps/$sweep.json" --out "$OUT/$sweep.h5" >"$OUT/$sweep.txt"
done
step "Verdicts" "$PYTHON" scripts/figures/claim_regions.py "$OUT"/claim-*.h5 --out "$OUT" >&2
