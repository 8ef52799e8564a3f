#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# The region of our free choices in which each claim of the paper holds, and the effect of other
# readings of decisions E1 to E13: makes paths of other seeds, runs experiments/sweeps/claim-*.json,
# readings.json, roles of a closed loop, polylines and contacts, and judges. A new call continues.
# Leaves results/claims/claim-regions.md; takes about an hour of processor time.
#   scripts/claims.sh [PART...]   only these, such as claim-k3, roles or verdicts
#   LMDBENCH_BUILD=DIR            where the programs are (build/release)
#   LMDBENCH_CLAIMS=DIR           where the results go (results/claims). verdicts compares them with
#                                 results/claims-busy, made on another load by
#                                 scripts/claims.sh claim-k5 claim-k7 roles with that DIR
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT"
BUILD="${LMDBENCH_BUILD:-build/release}"
OUT="${LMDBENCH_CLAIMS:-results/claims}"
OTHER=results/claims-busy
PATH_FOLDER=results/claims # claim-k1.json names its files there
PATHS=20
APPROACHES=5 # of 6 s each
PYTHON="$(find_python h5py matplotlib numpy)"
mkdir -p "$OUT" "$PATH_FOLDER"
[[ -n ${LMDBENCH_BUILD:-} ]] || build_preset release
build_meshes "$BUILD/lmdbench"

# The hard contact's specification with other seeds, its approaches one after another.
make_paths() {
  "$PYTHON" - "$PATH_FOLDER" "$PATHS" "$APPROACHES" <<'PYTHON_END' || return
import json
import sys
from pathlib import Path

out, paths, approaches = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
with open("paths/bunny-hard.json", encoding="utf-8") as file:
    specification = json.load(file)
gaps = specification["gaps"]
end = gaps[-1]["time_s"]
specification["gaps"] = gaps + [{**gap, "time_s": round(gap["time_s"] + k * end, 3)} for k in range(1, approaches) for gap in gaps[1:]]
for number in range(1, paths + 1):
    name, text = Path(f"{out}/hard-{number:02d}.json"), json.dumps({**specification, "seed": 100 + number})
    if not name.exists() or name.read_text(encoding="utf-8") != text:
        name.write_text(text, encoding="utf-8")
PYTHON_END
  local spec file
  for spec in "$PATH_FOLDER"/hard-[0-9][0-9].json; do
    file="${spec%.json}.tum"
    [[ -s $file && ! $spec -nt $file ]] || "$BUILD/lmdbench" path generate "$spec" --out "$file" >/dev/null || return
  done
}

# A point that fails is told by the verdicts.
sweep() { "$BUILD/lmdbench" work-precision "experiments/sweeps/$1.json" --out "$OUT/$1.h5" >"$OUT/$1.txt" || (($? == 1)); }
run() { run_anew "$BUILD/lmdbench" "experiments/$1.json" "$OUT/$2.h5" "${@:3}" >&2; }

# The files among the arguments that exist, one a line.
existing() {
  local file
  for file in "$@"; do [[ ! -e $file ]] || printf '%s\n' "$file"; done
}

part() {
  case "$1" in
    claim-k1) step "Paths" make_paths && step "$1" sweep "$1" ;;
    roles) step "$1" "$BUILD/lmdbench-study" roles --json "$OUT/roles.json" >"$OUT/roles.txt" ;;
    bunny-cut | bunny-cut-ball)
      local moving=()
      [[ $1 == bunny-cut ]] || moving=(--set /moving/mesh=ball)
      # What a search finds at a cutoff of a nanometre are pairs of triangles that cross.
      step "$1" run bunny-cut "$1" --set "/name=\"$1\"" --set '/methods=[{"name": "improved", "force_law": "exponential"}]' \
        --set '/force={"cutoff_m": 1e-9, "maximum_force_n": 3}' --set /driver/search_every_frames=1 --set /driver/search_latency_frames=0 \
        --set /probes/truth/stride_frames=0 "${moving[@]}"
      ;;
    direction-memory)
      step "$1" run recorded-hard direction-memory --set '/name="direction-memory"' --set /record/lmds=true --set /driver/repetitions=2 \
        --set /probes/truth/stride_frames=0 --set /probes/fcl/stride_frames=0
      ;;
    verdicts)
      local more other
      mapfile -t more < <(existing "$OUT"/{readings,bunny-cut,bunny-cut-ball,direction-memory}.h5 "$OUT/roles.json")
      mapfile -t other < <(existing "$OTHER"/claim-*.h5 "$OTHER/roles.json")
      ((${#other[@]} == 0)) || other=(--other "${other[@]}")
      step "Verdicts" "$PYTHON" scripts/figures/claim_regions.py "$OUT"/claim-*.h5 "${more[@]}" "${other[@]}" --out "$OUT" >&2
      ;;
    *) step "$1" sweep "$1" ;;
  esac
}

parts=("$@")
if ((${#parts[@]} == 0)); then
  parts=(claim-k1 claim-k3 claim-k5 claim-k7 claim-k10 claim-k10-unequal readings roles bunny-cut bunny-cut-ball direction-memory verdicts)
fi
for name in "${parts[@]}"; do part "$name"; done
