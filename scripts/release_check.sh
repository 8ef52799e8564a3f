#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# All claims of the project at one commit, part by part; a new call continues, on another day or
# machine too. A part's commit is the last one that changed what the part may read: no page and no
# result, so that what was measured can be committed; for searches, studies, fuzzing, planted
# defects and tables no test, so that a better test leaves them valid; for searches in generated
# scenes what they include, without rooms above the methods. Leaves
# results/release/COMMIT/PART.txt (the output, not committed) and PART.verdict, and page.md in the
# newest of these folders, with the cause of each part that failed (results/release/causes.txt).
# Exit code 1 if a part failed or is missing.
#   scripts/release_check.sh            every part: two nights on two cores
#   scripts/release_check.sh PART...    only these; those that are done are done again
#   scripts/release_check.sh --list     the parts
#   scripts/release_check.sh --page     the page of those that are done, no part
#   LMDBENCH_POSES=N                    poses of each study and judge (1000000)
#   LMDBENCH_SEED=N                     their seed (the day, such as 20261124)
#   LMDBENCH_FUZZ_MINUTES=N             minutes of fuzzing in all (360), a third of them for `lmd`
set -uo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT" || exit 1

mapfile -t READERS < <(scripts/fuzz.sh --list | grep -vx lmd) # `lmd`, which all methods need, has a third of the time
PARTS=(setup lint reproduce test develop heavy asan-ubsan tsan smallest packages cluster mutants-{1..24} completeness hostile parts solids
  shapes metamorphic rest generated "${READERS[@]/#/fuzz-}" fuzz-lmd regression reference)
# Rooms and files that make no set: commands, drivers, numbers, files of results, interfaces, what
# is told of meshes; and what reads meshes and paths, which searches in generated scenes make, or
# finds instances, of which those have none.
ABOVE_METHODS=(src/lmdbench/{base/git_state.cmake,base/'child_process.*',scene/'instance_tree.*',catalogue/{CMakeLists.txt,'assimp_*','*_check.*','*_file.*','import.*',line_reader.h,'mesh_limits.*','polygon*'},cli,comparison,drivers,force,library,lmdbench.h,manual,mesh/'validity_report.*',metrics,motion}
  src/lmdbench/{phantom,plugin,prepare,probes,python,realtime,result,result_file,run,stability,sweep,view} experiments/judge/main.cpp
  experiments/support/'program.*')
# Of these what only the program itself reads.
COMMANDS=(src/lmdbench/{cli,manual,python})
# What only tests and this script read.
TESTS=(':!*_test.cpp' ':!*_test.py' ':!scripts/mutants.txt' ':!scripts/release_check.sh')
# What every part reads that builds something.
BUILD=(CMakeLists.txt CMakePresets.json)
# What searches in generated scenes include beside their study or judge.
SEARCHED=("${BUILD[@]}" src experiments/support "${ABOVE_METHODS[@]/#/:!}" "${TESTS[@]}")
# What fuzzers are made of beside the library.
FUZZED=(tests/{CMakeLists.txt,fuzz,support} scripts/{fuzz,lib}.sh)
STUDIES=(experiments/study/{CMakeLists.txt,completeness,studies.h,hostile.cpp,metamorphic.cpp,parts.cpp})
POSES="${LMDBENCH_POSES:-1000000}"
SEED="${LMDBENCH_SEED:-$(date +%Y%m%d)}"
FUZZ_MINUTES="${LMDBENCH_FUZZ_MINUTES:-360}"
for number in POSES SEED FUZZ_MINUTES; do
  [[ ${!number} =~ ^[1-9][0-9]{0,14}$ ]] ||
    die 2 "LMDBENCH_$number is '${!number}' (remedy: a whole number above 0, such as 1000000)"
done
MACHINE="$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1), $JOBS cores"

# in_fresh_clone COMMAND: for a newcomer, whose folder only has committed files; with the pages of
# now, which tell how old they are since COMMIT.
in_fresh_clone() (
  clone="$(mktemp -d)"
  trap 'rm -rf "$clone"' EXIT
  trap 'exit 143' TERM
  chmod 755 "$clone" # some tests run the program as another user
  git clone --quiet "$ROOT" "$clone/lmdbench" && cd "$clone/lmdbench" && "$@" </dev/null
)
# of_each N: poses of each of N kinds (pairs of shapes in each of their coordinates) that make POSES
# in all.
of_each() { echo $(((POSES + $1 - 1) / $1)); }
study() { build_preset release >&2 && build/release/lmdbench-study "$@" --seed "$SEED"; }
# Some studies begin by meshes that are fetched.
all_meshes() { build_preset release >&2 && build_meshes build/release/lmdbench; }

# commit_of PART: the last one that changed what the part may read.
commit_of() {
  local -a read=(.)
  case $1 in
  hostile | parts | solids | shapes | metamorphic) read=("${SEARCHED[@]}" "${STUDIES[@]}") ;;
  rest | generated) read=("${SEARCHED[@]}" experiments/judge) ;;
  completeness)
    read=("${BUILD[@]}" src experiments meshes paths ':!experiments/judge' "${COMMANDS[@]/#/:!}" "${TESTS[@]}")
    ;;
  fuzz-lmd | fuzz-triangle) read=("${SEARCHED[@]}" "${FUZZED[@]}" tests/{geometry,methods}/fuzz) ;;
  fuzz-off | fuzz-ply | fuzz-obj | fuzz-manifest)
    read=("${BUILD[@]}" src/lmdbench/{CMakeLists.txt,base,geometry,mesh,shape,catalogue} "${FUZZED[@]}" "${TESTS[@]}"
      ':!src/lmdbench/base/child_process.*')
    ;;
  fuzz-*) read=("${BUILD[@]}" src experiments/schema "${FUZZED[@]}" "${COMMANDS[@]/#/:!}" "${TESTS[@]}") ;;
  mutants-*) read=("${BUILD[@]}" src experiments meshes paths tests scripts/{mutants,lib}.sh ':!*.py' "${TESTS[@]}") ;;
  reference) read+=("${TESTS[@]}") ;;
  esac
  git log -1 --format=%h -- "${read[@]}" ':!results/re*' ':!*.md' # not what runs left, as baselines are read
}
# What a part was asked for, beside its name.
conditions() {
  case $1 in
  hostile | parts | solids | shapes | metamorphic | rest | generated) printf '%s poses, seed %s' "$POSES" "$SEED" ;;
  completeness) printf 'seed %s' "$SEED" ;;
  fuzz-*) printf '%s minutes in all' "$FUZZ_MINUTES" ;;
  esac
}
part() {
  case $1 in
  setup) scripts/setup.sh ;;
  lint) scripts/lint.sh ;;
  reproduce) in_fresh_clone ./scripts/reproduce.sh ;;
  test) in_fresh_clone ./scripts/test.sh ;;
  develop) build_preset develop && ctest --preset develop --label-exclude heavy --parallel "$JOBS" --no-tests=error ;;
  heavy) build_preset release && ctest --preset release --label-regex heavy --parallel "$JOBS" --no-tests=error ;;
  asan-ubsan | tsan) scripts/sanitizer_tests.sh "$1" ;;
  smallest) build_preset release >&2 && python3 scripts/smallest_build.py ;;
  packages) scripts/package.sh --check ;;
  cluster) scripts/cluster_test.sh ;;
  mutants-*) scripts/mutants.sh --share "${1#*-}/24" --keep ;;
  completeness) all_meshes && study completeness --poses 1000 ;;
  hostile) study hostile --poses "$(of_each 3)" --frames "$(of_each 3)" ;; # poses twice: none, laid
  parts) study parts --poses "$(of_each 236)" ;;
  solids) study parts --generator solids --poses "$(of_each 12)" ;;
  shapes) study parts --generator shapes --poses "$(of_each 72)" ;;
  metamorphic) study metamorphic --poses "$(of_each 370)" ;; # 37 kinds, ten changes of each pose
  generated) build_preset release >&2 && build/release/lmdbench-judge generated --poses "$(of_each 4)" --seed "$SEED" ;;
  rest) build_preset release >&2 && build/release/lmdbench-judge rest --poses "$(of_each 37)" --seed "$SEED" ;;
  fuzz-lmd) scripts/fuzz.sh "$(((FUZZ_MINUTES + 2) / 3))" lmd ;;
  fuzz-*) scripts/fuzz.sh "$(((FUZZ_MINUTES * 2 / 3 + ${#READERS[@]} - 1) / ${#READERS[@]}))" "${1#*-}" ;;
  regression)
    local before
    before="$(git describe --tags --abbrev=0 --match 'v*' HEAD^ 2>/dev/null)" || before=""
    [[ -n $before ]] || { say "there is no release before this one" && return 0; }
    scripts/ci_regression.sh "$before" || (($? == 4)) # unsure, as its last line says
    ;;
  reference) python3 scripts/reference_ages.py --none-older ;; # made by scripts/reference.sh, in a night
  esac
}

# is_done VERDICT PART: made of as many poses or minutes as asked for, with any seed. `reference` is
# asked each time, as it reads pages.
is_done() {
  local asked wanted
  wanted="$(conditions "$2")"
  [[ -s $1 && $2 != reference ]] && IFS='|' read -r _ _ _ _ asked _ <"$1" && [[ ${asked%seed*} == "${wanted%seed*}" ]]
}

if [[ ${1:-} == --list ]]; then
  printf '%s\n' "${PARTS[@]}"
  exit 0
fi
chosen=("$@")
(($# > 0)) || chosen=("${PARTS[@]}")
[[ ${1:-} != --page ]] || chosen=()
for name in "${chosen[@]}"; do
  [[ " ${PARTS[*]} " == *" $name "* ]] || die 2 "there is no part '$name' (remedy: scripts/release_check.sh --list)"
done
[[ -z "$(git status --porcelain -- . ':!results/release')" ]] || # where verdicts of an earlier call are
  die 2 "the tree differs from its commit (remedy: commit or stash; 'git status' shows what)"
OUT="$ROOT/results/release"
COMMIT="$(commit_of all)"
mkdir -p "$OUT/$COMMIT"

for name in "${chosen[@]}"; do
  made="$OUT/$(commit_of "$name")/$name"
  (($# == 0)) && is_done "$made.verdict" "$name" && continue
  say "== $name"
  mkdir -p "${made%/*}"
  started=$EPOCHREALTIME status=0
  (part "$name") >"$made.txt" 2>&1 || status=$?
  # What ctest counts stands above the tests that it skipped; test.sh counts more than tests.
  counts='% tests passed'
  case $name in
  test) counts='^[0-9]* passed, [0-9]* failed' ;;
  fuzz-*) counts="^${name#*-} " ;; # below it stands where finds are
  esac
  last="$( (grep -a "$counts" "$made.txt" || grep -av '^[[:space:]]*$' "$made.txt") | tail -n 1 | tr '|' '/' | cut -c1-120)"
  skipped="$(grep -ac '(Skipped)$' "$made.txt")"
  [[ $name == test ]] || ((skipped == 0)) || last+=", $skipped skipped"
  printf '%s|%s|%s|%s|%s|%s\n' "$status" "$(seconds_since "$started")" "$(date +%F)" "$MACHINE" "$(conditions "$name")" "$last" \
    >"$made.verdict"
  say "   exit code $status, $(seconds_since "$started")"
done

failed=0 causes=""
{
  # shellcheck disable=SC2016  # code spans, no commands
  printf '# lmdbench at %s\n\nMade by `scripts/release_check.sh`, part by part.\n\n' "$COMMIT"
  printf '| part | at | verdict | time | date | machine | conditions | last line |\n|---|---|---|---|---|---|---|---|\n'
  for name in "${PARTS[@]}"; do
    status=missing
    seconds="" day="" machine="" asked="" last=""
    at="$(commit_of "$name")"
    made="$OUT/$at/$name.verdict"
    [[ ! -s $made ]] || IFS='|' read -r status seconds day machine asked last <"$made"
    case $status in 0) verdict="passed" ;; missing) verdict="not run" ;; *) verdict="FAILED ($status)" ;; esac
    [[ $status == 0 ]] || failed=1
    [[ $verdict != FAILED* ]] ||
      causes+="- $(grep "^$name@$at: " "$OUT/causes.txt" || printf '%s@%s: not looked into yet.' "$name" "$at")"$'\n'
    printf '| %s | %s | %s | %s | %s | %s | %s | %s |\n' "$name" "$at" "$verdict" "$seconds" "$day" "$machine" "$asked" "$last"
  done
  [[ -z $causes ]] || printf '\nWhy parts failed:\n\n%s' "$causes"
  printf '\nWhat was found on the way: [notes](../notes.md).\n'
} >"$OUT/$COMMIT/page.md"
cat "$OUT/$COMMIT/page.md"
exit "$failed"
