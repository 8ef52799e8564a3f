#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Is a candidate slower than its base, or does it behave otherwise? Builds both, runs one experiment process by process in
# random balanced order, with the base a second time as a null control, and prints the verdict of `lmdbench compare`.
#
#   scripts/ci_regression.sh BASE_REV [CANDIDATE_REV] [option]...
#
# CANDIDATE_REV is HEAD unless given. Options:
#   --experiment FILE     scene file of the working copy (experiments/shapes.json)
#   --set PTR=VALUE       override of the scene, for both; repeatable (unless given: certified as a third method, no
#                         probes, four repetitions)
#   --pairs N             processes a side before the first verdict (6)
#   --most N              processes a side at most (24)
#   --threshold SHARE     least effect that matters (0.05)
#   --allow COUNTER       counter that may differ; repeatable
#   --instructions SHARE  least change of an instruction count that matters (0.01); 0 leaves callgrind out
#   --out DIR             results, tables and reports (build/ci)
#
# The judge is the candidate's `lmdbench compare`. Three gates:
#   1. results and counters, exactly, from one process a side: a difference ends it at once, "changed";
#   2. instructions of the methods' searches and trackings under callgrind, which no noise touches;
#   3. times: after the first N rounds sure verdicts stand. Anything else, "slower" included, gets as many rounds again,
#      until it is sure or there are --most; "slower" needs the fresh rounds alone to say slower, too, or at least not the
#      contrary. Where the base is slower or faster than itself the machine is no judge: unsure.
# Exit code: 0 same or faster, 1 slower or changed, 2 usage, 4 unsure or the environment lacks something.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

usage() { die 2 "$1 (remedy: scripts/ci_regression.sh BASE_REV [CANDIDATE_REV] [option]..., see the head of the file)"; }

revisions=()
experiment="$ROOT/experiments/shapes.json"
sets=()
pairs=6
most=24
threshold=0.05
allow=()
instructions=0.01
out="$ROOT/build/ci"
while (($# > 0)); do
  case "$1" in
    --*)
      (($# > 1)) || usage "$1 needs a value"
      case "$1" in
        --experiment) experiment="$(realpath "$2")" ;;
        --set) sets+=(--set "$2") ;;
        --pairs) pairs="$2" ;;
        --most) most="$2" ;;
        --threshold) threshold="$2" ;;
        --allow) allow+=(--allow "$2") ;;
        --instructions) instructions="$2" ;;
        --out) out="$2" ;;
        *) usage "unknown option $1" ;;
      esac
      shift 2
      ;;
    *)
      revisions+=("$1")
      shift
      ;;
  esac
done
((${#revisions[@]} == 1 || ${#revisions[@]} == 2)) || usage "${#revisions[@]} revisions"
[[ $pairs =~ ^[1-9][0-9]*$ && $most =~ ^[1-9][0-9]*$ ]] || usage "--pairs and --most are numbers of processes"
if ((${#sets[@]} == 0)); then
  sets=(--set /driver/repetitions=4 --set /probes/truth/stride_frames=0 --set /probes/fcl/stride_frames=0)
  [[ $experiment != "$ROOT/experiments/shapes.json" ]] ||
    sets+=(--set '/methods/-={"name":"certified","force_law":"exponential"}')
fi

commit_of() {
  git -C "$ROOT" rev-parse --quiet --verify "$1^{commit}" || die 2 "no revision '$1' (remedy: git fetch, git log)"
}
base="$(commit_of "${revisions[0]}")"
candidate="$(commit_of "${revisions[1]:-HEAD}")"
out="$(mkdir -p "$out" && cd "$out" && pwd)"
results="$out/results"
rm -rf "$results"
mkdir -p "$results"

# build_revision COMMIT NAME: the program of a commit as $out/bin/NAME/lmdbench. All names have one length: the place of
# a process' arguments moves its stack, and with it its speed.
build_revision() {
  local commit="$1" name="$2" tree="$out/tree/$1"
  if [[ ! -x $tree/build/release/lmdbench ]]; then
    [[ -e $tree ]] || git -C "$ROOT" worktree add --quiet --detach --force "$tree" "$commit"
    (cd "$tree" && export CCACHE_BASEDIR="$tree" CCACHE_NOHASHDIR=1 &&
      cmake --preset release -DLMDBENCH_BUILD_TESTS=OFF -DLMDBENCH_BUILD_EXPERIMENTS=OFF -DLMDBENCH_WITH_CGAL=OFF &&
      cmake --build --preset release --parallel "$JOBS" --target lmdbench) >"$out/build-$name.log" 2>&1 ||
      die "$EXIT_ENVIRONMENT" "commit $commit does not build, see $out/build-$name.log"
  fi
  mkdir -p "$out/bin/$name"
  cp "$tree/build/release/lmdbench" "$out/bin/$name/lmdbench"
}

# run_once NAME INDEX: one process; its result is $results/NAME-INDEX.h5.
run_once() {
  (cd "$ROOT" && "$out/bin/$1/lmdbench" --quiet run "$experiment" "${sets[@]}" --out "$results/$1-$2.h5" \
    >/dev/null </dev/null) || die "$EXIT_ENVIRONMENT" "the $1's run failed, see above"
}

# The six orders of three programs, shuffled anew for every six rounds: every program is as often first, second and last.
ORDERS=("base null cand" "base cand null" "null base cand" "null cand base" "cand base null" "cand null base")
rounds=0
order_list=()
run_rounds() {
  local count="$1" name
  for ((; count > 0; count--)); do
    ((${#order_list[@]} > 0)) || mapfile -t order_list < <(printf '%s\n' "${ORDERS[@]}" | shuf)
    for name in ${order_list[0]}; do run_once "$name" "$rounds"; done
    order_list=("${order_list[@]:1}")
    rounds=$((rounds + 1))
  done
}

# files NAME FIRST: results of a program from round FIRST on.
files() {
  local i
  for ((i = $2; i < rounds; i++)); do echo "$results/$1-$i.h5"; done
}

# judge BASE CANDIDATE FIRST [option]...: exit code of the comparison; its output goes to stdout.
judge() {
  local a b
  mapfile -t a < <(files "$1" "$3")
  mapfile -t b < <(files "$2" "$3")
  "$out/bin/cand/lmdbench" --quiet compare --base "${a[@]}" --candidate "${b[@]}" --threshold "$threshold" \
    "${allow[@]}" "${@:4}" </dev/null
}
# verdict BASE CANDIDATE FIRST: the word alone.
verdict() { judge "$1" "$2" "$3" --json 2>/dev/null | sed -n 's/^  "verdict": "\(.*\)",$/\1/p' || true; }

# Ends with the full table of the candidate against the base.
finish() {
  local word="$1" why="$2" status=0
  judge base cand 0 --junit "$out/junit.xml" --benchmark "$out/candidate.json" --benchmark-base "$out/base.json" || true
  judge base cand 0 --markdown >"$out/verdict.md" || true
  case "$word" in
    same | faster) status=0 ;;
    slower | changed) status=1 ;;
    *) status="$EXIT_ENVIRONMENT" ;;
  esac
  echo "verdict: $word ($why); $rounds processes a side, $((EPOCHSECONDS - started)) s of runs"
  exit "$status"
}

say "base      $base"
say "candidate $candidate"
build_revision "$base" base
build_revision "$candidate" cand
mkdir -p "$out/bin/null"
cp "$out/bin/base/lmdbench" "$out/bin/null/lmdbench"
"$out/bin/cand/lmdbench" compare --help >/dev/null 2>&1 ||
  die 2 "the candidate knows no 'lmdbench compare' (remedy: a later revision)"

started=$EPOCHSECONDS
run_rounds 1
word="$(verdict base cand 0)"
[[ -n $word ]] || die "$EXIT_ENVIRONMENT" "the comparison failed (remedy: see lmdbench compare on $results)"
[[ $word != changed ]] || finish changed "results or counters differ"

if [[ $instructions != 0 ]]; then
  status=0
  "$ROOT/scripts/ci/instructions.sh" "$out/bin/base/lmdbench" "$out/bin/cand/lmdbench" "$experiment" "$instructions" \
    "$out/callgrind" "${sets[@]}" || status=$?
  case "$status" in
    0) ;;
    1) finish slower "more instructions, counted by callgrind, see above" ;;
    *) say "instructions were not counted, see above" ;;
  esac
fi

run_rounds $((pairs - 1))
fresh=0
while :; do
  word="$(verdict base cand 0)"
  null="$(verdict base null 0)"
  say "after $rounds rounds: candidate $word, base against itself $null"
  case "$word:$null" in
    same:same | same:unsure | faster:same) finish "$word" "sure, and the base is the same as itself" ;;
    slower:same | slower:unsure)
      if ((fresh > 0)); then
        again="$(verdict base cand "$fresh")"
        say "rounds from $fresh on alone: $again"
        [[ $again == same || $again == faster ]] || finish slower "confirmed by fresh processes"
      fi
      ;;
  esac
  ((rounds < most)) || break
  fresh=$rounds
  run_rounds $((rounds + rounds <= most ? rounds : most - rounds))
done
case "$word:$null" in
  same:* | faster:unsure) finish "$word" "the base against itself is $null" ;;
  *:slower | *:faster) finish unsure "the base is $null than itself: this machine is no judge, see lmdbench doctor" ;;
  *) finish unsure "not sure after $rounds processes a side, see lmdbench doctor" ;;
esac
