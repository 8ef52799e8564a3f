#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Makes the numbers of results/reference again, all at the commit that is checked out; a new call
# continues. Leaves results/reference-runs/COMMIT/PART.txt and figures, which
# scripts/reference_write.py puts into results/reference; the text around is written by hand. Not
# here: verdicts.md, from programs with a planted slowdown (scripts/ci/verdict_study.py --help).
#   scripts/reference.sh            every part: a night on two cores that have nothing else to do
#   scripts/reference.sh PART...    only these, such as deform or recall
#   scripts/reference.sh --list     the parts
#   LMDBENCH_BUILD=DIR              where the programs are (build/release)
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT"
BUILD="${LMDBENCH_BUILD:-build/release}"

# results/reference/PART.md (or a name that begins so) is written from what PART prints.
PARTS=(claims claim-regions completeness continuous-force deep-contact deform devices extreme figures flat global-search hard-soft hostile-input
  interrupted-runs jumps kernel leave-out ledger own-parts packages passivity realtime recall rivals scaling stability stability-map
  triangle_accuracy triangle_accuracy_million truth tuned-constants work-precision worlds)

study() { "$BUILD/lmdbench-study" "$@"; }
judge() { "$BUILD/lmdbench-judge" "$@"; }
run() { run_anew "$BUILD/lmdbench" "experiments/$1.json" "$OUT/${1##*/}.h5" "${@:2}" >&2; }
figure() { "$PYTHON" "scripts/figures/$1.py" "${@:2}"; }
# sweep NAME PAGE: the sweep's tables as PAGE.md and its figure as PAGE.png.
sweep() {
  "$BUILD/lmdbench" work-precision "experiments/sweeps/$1.json" --out "$OUT/$2.h5"
  figure sweep "$OUT/$2.h5" --out "$OUT" --name "$2"
}
# Without machine parts, which are for the judge of flat contact: a bolt in a nut takes hours.
extreme_scenes() { printf '%s\n' experiments/extreme/*.json | grep -vE '/(bolt|gears|peg|box-on-table)[^/]*$'; }
# Open loops with LMD lists, for several parts.
runs_with_lmds() {
  local scene
  for scene in "$@"; do [[ -s $OUT/$scene.h5 ]] || run "$scene" --set /record/lmds=true; done
}

part() {
  case "$1" in
    claims)
      runs_with_lmds bunny-hard bunny-soft
      figure claims "$OUT/bunny-hard.h5" "$OUT/bunny-soft.h5" --out "$OUT"
      figure figure7 "$OUT/bunny-hard.h5" "$OUT/bunny-soft.h5" --out "$OUT"
      figure summary "$OUT/bunny-hard.h5" "$OUT/bunny-soft.h5" | tee "$OUT/summary.txt"
      ;;
    claim-regions)
      LMDBENCH_BUILD="$BUILD" LMDBENCH_CLAIMS="$OUT/claims" scripts/claims.sh
      cp "$OUT"/claims/claim-{regions.md,verdicts.json} "$OUT"
      ;;
    completeness)
      study completeness --truth-stride 20 --experiment experiments/bunny-hard.json --experiment experiments/bunny-soft.json \
        --experiment experiments/armadillo-bunny.json --experiment experiments/shapes.json
      study completeness --far-poses 20000 --flat-poses 0 --rounded-poses 0 --poses 10 --cutoff 0.02
      study completeness --no-pairs --far-poses 0 --rounded-poses 0 --flat-poses 1000
      study completeness --no-pairs --far-poses 0 --flat-poses 0 --rounded-poses 1000
      study hostile --poses 20000 --frames 100000 --seed 9131
      study parts --generator shapes --poses 300 --seed 9132
      study parts --coordinates recut --poses 400 --seed 501
      ;;
    continuous-force)
      study continuous-force --part paths --part events --json "$OUT/continuous-force.json"
      study continuous-force --part loops --scene shapes --scene bunny-hard
      study continuous-force --part cuts --part cups --part notches --part drag --part decimation
      study continuous-force --part bores --rolls 4 --slope-steps 16
      study continuous-force --part cost --cost-poses 600
      study continuous-force --part sums --no-exhaustive
      study continuous-force --part sums --poses 100 --seed 7
      figure continuous_force "$OUT/continuous-force.json" --out "$OUT"
      ;;
    deep-contact) study depth --frames 2000 --passes 4 --truth-stride 100 ;;
    deform) study deform ;;
    devices) figure device_table --program "$BUILD/lmdbench" ;;
    extreme) LMDBENCH_BUILD="$BUILD" scripts/extreme.sh ;;
    figures)
      figure figure4 experiments/bunny-soft.json --program "$BUILD/lmdbench" --time 3.396 --out "$OUT"
      figure what_is_an_lmd --program "$BUILD/lmdbench" --out "$OUT"
      figure tilt --program "$BUILD/lmdbench" --out "$OUT"
      run world --set '/methods=[{"name": "certified"}]' --set /probes/truth/stride_frames=0 --set /probes/fcl/stride_frames=0
      figure world "$OUT/world.h5" --out "$OUT"
      run press-fit
      figure press_fit "$OUT/press-fit.h5" --out "$OUT"
      run bunny-cut
      figure polylines "$OUT/bunny-cut.h5" --out "$OUT"
      ;;
    flat)
      study flat --poses 30 --repetitions 3
      study flat --poses 30 --repetitions 9 --no-fcl
      study flat --parts --paths 8 --repetitions 3
      ;;
    global-search) study compare ;;
    hard-soft) figure hard_soft --program "$BUILD/lmdbench" --runs "$OUT/hard-soft" --out "$OUT" ;;
    hostile-input) "$PYTHON" tests/cli/hostile_set.py "$BUILD/lmdbench" . --count 340 ;;
    interrupted-runs)
      "$PYTHON" tests/cli/kill_test.py "$BUILD/lmdbench" experiments/shapes.json --kills 200 --repetitions 1000 --longest 2.5 \
        --complete-every 25 --seed 3
      ;;
    jumps)
      runs_with_lmds bunny-hard bunny-soft recorded-hard recorded-soft
      figure jumps "$OUT"/{bunny-hard,bunny-soft,recorded-hard,recorded-soft}.h5
      ;;
    kernel) sweep kernel kernel ;;
    leave-out)
      study leave-out --processes 5 experiments/{shapes,dropouts,bunny-hard}.json \
        experiments/extreme/{flush-cubes,start-inside,sliding-faces,rocking-box,deep}.json
      ;;
    ledger)
      local scene results=() OUT="$OUT/ledger" # with probes of its own, not in place of the others' runs
      mkdir -p "$OUT"
      for scene in bunny-hard bunny-soft; do run "$scene" --set /probes/fcl/stride_frames=10; done
      for scene in $(extreme_scenes); do
        scene="$(basename "$scene" .json)"
        run "extreme/$scene"
        results+=("$OUT/$scene.h5")
      done
      judge ledger "$OUT/bunny-hard.h5" "$OUT/bunny-soft.h5" "${results[@]}"
      ;;
    own-parts) "$PYTHON" tests/cli/own_parts.py "$BUILD/lmdbench" --limit 240 --lenient ;;
    packages) scripts/package.sh --check ;;
    passivity) study passivity ;;
    realtime) figure realtime --program "$BUILD/lmdbench" --out "$OUT" ;;
    recall)
      study recall --moving bunny-16k --fixed bunny-16k --seed 2 | tee "$OUT/recall-bunny-bunny.md"
      study recall --moving armadillo --fixed bunny-16k --seed 2 | tee "$OUT/recall-armadillo-bunny.md"
      ;;
    rivals) # needs scripts/packages_rivals.txt
      cmake -S experiments/rivals -B build/rivals >&2
      cmake --build build/rivals >&2
      figure rivals --program "$BUILD/lmdbench" --poses 30 --stretch 1 --stability-seconds 40 --out "$OUT"
      ;;
    scaling)
      "$BUILD/lmdbench" mesh build dragon-11k dragon-47k dragon-202k dragon-871k >&2
      study scaling --json "$OUT/scaling.json"
      study scaling --only dragon --large --json "$OUT/dragon.json"
      echo
      figure scaling "$OUT/scaling.json" "$OUT/dragon.json" --out "$OUT"
      ;;
    stability) figure stability --program "$BUILD/lmdbench" --rows "$OUT/stability.jsonl" --out "$OUT" ;;
    stability-map)
      study stability experiments/stability/{box,wedge,peg,bunny}.json >"$OUT/stability-map.jsonl"
      figure stability_map "$OUT/stability-map.jsonl" --out "$OUT"
      ;;
    triangle_accuracy) judge accuracy ;;
    triangle_accuracy_million) judge accuracy --million ;;
    truth)
      local scenes=()
      mapfile -t scenes < <(extreme_scenes)
      judge truth "${scenes[@]}"
      judge truth experiments/{bunny-hard,bunny-soft,armadillo-bunny}.json --frames 201
      ;;
    tuned-constants) "$PYTHON" scripts/tuned_constants.py experiments/bunny-hard.json ;;
    work-precision)
      sweep budget work-precision
      sweep budget-short work-precision-extreme
      ;;
    worlds)
      study worlds --part cost --part broad-phase --part slack --part pile-slack
      study worlds --part completeness --world-frames 1000
      study worlds --part pile --pile-frames 100 --pile-passes 2
      ;;
    *) die 2 "no part is called $1 (remedy: one of ${PARTS[*]})" ;;
  esac
}

if [[ ${1:-} == --list ]]; then
  printf '%s\n' "${PARTS[@]}"
  exit 0
fi
PYTHON="$(find_python h5py numpy matplotlib)"
if [[ ${1:-} == --one ]]; then # a process of its own, so that a command that fails ends the part
  OUT="$2"
  part "$3"
  exit 0
fi
commit="$(git rev-parse --short HEAD)"
git diff --quiet HEAD -- . ':!results/release' || die 2 "the checkout has changes that no commit names (remedy: commit or stash them)"
[[ -n ${LMDBENCH_BUILD:-} ]] || build_preset release # a table is filed under the commit of its program
OUT="results/reference-runs/$commit"
mkdir -p "$OUT"
(($#)) || set -- "${PARTS[@]}"
failed=0
for name in "$@"; do
  if [[ -e $OUT/$name.txt ]]; then
    say "$name: $OUT/$name.txt is there"
    continue
  fi
  if step "$name" "$ROOT/scripts/reference.sh" --one "$OUT" "$name" >"$OUT/$name.part"; then
    mv "$OUT/$name.part" "$OUT/$name.txt"
  else
    failed=1
  fi
done
print_steps
exit "$failed"
