#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Is a candidate slower than its base, or does it behave otherwise? Builds both, each in a worktree of its own and nothing but
# the program, and lets scripts/ci/regression.py run and judge them: `scripts/ci/regression.py --help` says how.
#
#   scripts/ci_regression.sh BASE_REV [CANDIDATE_REV] [option]...
#
# CANDIDATE_REV is HEAD unless given. Options:
#   --experiment FILE     scene file of the working copy (experiments/shapes.json)
#   --set PTR=VALUE       override of the scene, for both; repeatable (unless given: certified as a third method, no
#                         probes, four repetitions)
#   --cmake OPTION        for the build of both, such as -DCMAKE_CXX_COMPILER=clang++; repeatable
#   --out DIR             worktrees, results, tables and reports (build/ci); worktrees stay for the next call
#   --judge PROGRAM       whose `compare` judges (the candidate's)
#   --pairs N, --most N, --threshold SHARE, --allow COUNTER, --instructions SHARE
#                         as scripts/ci/regression.py has them: 6, 24, 0.05, none, 0.01
# Exit code: 0 same or faster, 1 slower or changed, 2 usage, 4 unsure or the environment lacks something.
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
out="$(mkdir -p "$out" && cd "$out" && pwd)"

# build_revision COMMIT: $out/tree/COMMIT/build/release/lmdbench, compiled as users' programs are, but for precompiled headers,
# which ccache keeps only with settings of the user's. All worktrees share its hits: paths below a worktree do not count.
build_revision() {
  local tree="$out/tree/$1"
  [[ ! -x $tree/build/release/lmdbench ]] || return 0
  if [[ ! -e $tree ]]; then
    git -C "$ROOT" worktree prune
    git -C "$ROOT" worktree add --quiet --detach "$tree" "$1"
  fi
  say "building $1"
  (cd "$tree" && export CCACHE_BASEDIR="${CCACHE_BASEDIR:-$tree}" CCACHE_NOHASHDIR=1 &&
    cmake --preset release -DLMDBENCH_BUILD_TESTS=OFF -DLMDBENCH_BUILD_EXPERIMENTS=OFF -DLMDBENCH_WITH_CGAL=OFF \
      -DLMDBENCH_PRECOMPILED_HEADERS=OFF "${cmake_options[@]}" &&
    cmake --build --preset release --parallel "$JOBS" --target lmdbench) >"$out/build-$1.log" 2>&1 ||
    die "$EXIT_ENVIRONMENT" "commit $1 does not build, see $out/build-$1.log"
}

say "base      $base"
say "candidate $candidate"
build_revision "$base"
build_revision "$candidate"
judge="${judge:-$out/tree/$candidate/build/release/lmdbench}"
[[ "$("$judge" compare --help 2>/dev/null || true)" == *--false-alarm* ]] ||
  die 2 "$judge knows no 'compare --false-alarm' (remedy: --judge with a program that does)"
exec python3 "$ROOT/scripts/ci/regression.py" --base "$out/tree/$base/build/release/lmdbench" \
  --candidate "$out/tree/$candidate/build/release/lmdbench" --judge "$judge" --experiment "$experiment" \
  "${sets[@]}" "${rule[@]}" --out "$out"
