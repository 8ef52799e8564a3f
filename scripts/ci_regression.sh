#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Is a candidate slower than its base, or does it behave otherwise? Builds the program of both, each
# in its own worktree. scripts/ci/regression.py runs and judges them: see its --help.
#
#   scripts/ci_regression.sh BASE_REV [CANDIDATE_REV] [option]...
#
# CANDIDATE_REV is HEAD unless given. Options:
#   --experiment FILE     scene file of the working copy (experiments/shapes.json)
#   --set PTR=VALUE       override of the scene, for both; repeatable (default: certified as a third
#                         method, no probes, four repetitions)
#   --cmake OPTION        for the build of both, such as -DCMAKE_CXX_COMPILER=clang++; repeatable
#   --out DIR             worktrees (kept for the next call), results, reports (build/ci)
#   --judge PROGRAM       whose `compare` judges (the candidate's)
#   --pairs N, --most N, --threshold SHARE, --allow COUNTER, --instructions SHARE
#                         as scripts/ci/regression.py has them: 6, 24, 0.05, none, 0.01
# Exit code: 0 same or faster; 1 slower or changed, or the candidate does not build or run; 2 usage;
# 3 no comparison: the base fails or the environment lacks something; 4 only unsure. All but 2 leave
# verdict.md and junit.xml in DIR, which agree; there a failed build or run is an error.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

usage() { die 2 "$1 (remedy: scripts/ci_regression.sh BASE_REV [CANDIDATE_REV] [option]..., see the head of the file)"; }

revisions=()
experiment="$ROOT/experiments/shapes.json"
sets=()
cmake_options=()
rule=()
judge=""
out="$ROOT/build/ci"
while (($# > 0)); do
  case "$1" in
    --*)
      (($# > 1)) || usage "$1 needs a value"
      case "$1" in
        --experiment) experiment="$(realpath -m "$2")" ;;
        --set) sets+=(--set "$2") ;;
        --cmake) cmake_options+=("$2") ;;
        --judge) judge="$(realpath -m "$2")" ;;
        --out) out="$2" ;;
        --pairs | --most)
          [[ $2 =~ ^[1-9][0-9]*$ ]] || usage "$1 is a number of processes, not '$2'"
          rule+=("$1" "$2")
          ;;
        --threshold | --instructions)
          [[ $2 =~ ^[0-9]*\.?[0-9]+$ ]] || usage "$1 is a share such as 0.05, not '$2'"
          rule+=("$1" "$2")
          ;;
        --allow) rule+=("$1" "$2") ;;
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
[[ -f $experiment ]] || usage "no experiment $experiment"
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
mkdir -p "$out" || usage "the folder $out cannot be made"
out="$(cd "$out" && pwd)"

# broken SIDE STEP MESSAGE LOG: outcome without comparison; exit code by scripts/ci/outcome.py.
broken() { exec python3 "$ROOT/scripts/ci/outcome.py" "$out" "$@"; }

# tree_of COMMIT: its worktree; one for each set of CMake options.
tree_of() {
  local options=""
  ((${#cmake_options[@]} == 0)) || options="-$(printf '%s\n' "${cmake_options[@]}" | sha256sum | cut -c1-8)"
  printf '%s' "$out/tree/$1$options"
}
# build_revision COMMIT: builds build/release/lmdbench in its tree like users' programs, but
# without precompiled headers, which ccache keeps only with user settings. Worktrees share hits.
build_revision() {
  local tree
  tree="$(tree_of "$1")"
  [[ ! -x $tree/build/release/lmdbench ]] || return 0
  say "building $1"
  # Whole, though a call was killed in its checkout.
  (worktree_at "$tree" "$1" && cd "$tree" && rm -f "$(git rev-parse --git-path index.lock)" && git reset --quiet --hard &&
    export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$tree}" CCACHE_NOHASHDIR=1 &&
    cmake --preset release -DLMDBENCH_BUILD_TESTS=OFF -DLMDBENCH_BUILD_EXPERIMENTS=OFF -DLMDBENCH_WITH_CGAL=OFF \
      -DLMDBENCH_PRECOMPILED_HEADERS=OFF "${cmake_options[@]}" &&
    cmake --build --preset release --parallel "$JOBS" --target lmdbench) >"$out/build-$1.log" 2>&1
}

say "base      $base"
say "candidate $candidate"
rm -f "$out/verdict.md" "$out/junit.xml"
# The base first: if it builds and the candidate does not, the candidate is at fault.
build_revision "$base" ||
  broken base build "the base $base does not build, or this machine cannot build it" "$out/build-$base.log"
build_revision "$candidate" ||
  broken candidate build "the candidate $candidate does not build" "$out/build-$candidate.log"
program="$(tree_of "$candidate")/build/release/lmdbench"
"$program" --help >"$out/start.log" 2>&1 || broken candidate run "the candidate $candidate does not start" "$out/start.log"
judge="${judge:-$program}"
[[ "$("$judge" compare --help 2>/dev/null || true)" == *--false-alarm* ]] ||
  die 2 "$judge knows no 'compare --false-alarm' (remedy: --judge with a program that does)"
exec python3 "$ROOT/scripts/ci/regression.py" --base "$(tree_of "$base")/build/release/lmdbench" \
  --candidate "$program" --judge "$judge" --experiment "$experiment" \
  "${sets[@]}" "${rule[@]}" --out "$out"
