#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Do the tests notice defects? Plants those of scripts/mutants.txt one by one in its own worktree,
# builds and runs the test program that must notice, and prints a table. Exit code 1 if a defect
# survives, 2 if one does not fit the code. Only committed code is tried.
#   --only NAME   this one; may be given again
#   --share K/N   the K-th of N parts of the list
#   --keep        leave the worktree and its build (build/mutants) for the next run
set -uo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

LIST="$ROOT/scripts/mutants.txt"
TREE="$ROOT/build/mutants/tree"
TIMEOUT=120  # seconds of a test program; a defect that never ends is noticed as well
only=()
keep=false
part=1 parts=1
while (($# > 0)); do
  case "$1" in
    --only)
      (($# > 1)) || die 2 "--only needs a name (remedy: its names: grep '^  [a-z]' scripts/mutants.txt)"
      only+=("$2")
      shift
      ;;
    --share)
      if ! [[ ${2:-} =~ ^([1-9][0-9]*)/([1-9][0-9]*)$ ]] || ((BASH_REMATCH[1] > BASH_REMATCH[2])); then
        die 2 "--share needs a part of parts (remedy: --share 1/6)"
      fi
      part=${BASH_REMATCH[1]} parts=${BASH_REMATCH[2]}
      shift
      ;;
    --keep) keep=true ;;
    *) die 2 "unknown argument '$1' (remedy: ./scripts/mutants.sh [--only NAME]... [--share K/N] [--keep])" ;;
  esac
  shift
done

remove_tree() {
  git -C "$ROOT" worktree remove --force "$TREE" 2>/dev/null
  git -C "$ROOT" worktree prune
}
worktree_at "$TREE" HEAD || die "$EXIT_ENVIRONMENT" "no worktree at $TREE"
git -C "$TREE" checkout --quiet --force --detach "$(git -C "$ROOT" rev-parse HEAD)" ||
  die "$EXIT_ENVIRONMENT" "$TREE cannot be brought to the commit (remedy: remove it, then git worktree prune)"
$keep || trap remove_tree EXIT

# Fields of each mutant: name, file, from, to, test, only, equivalent; a unit separator between.
mutants() {
  awk -v OFS='\037' '
    function row_ends() { if (name != "") print name, file, from, to, test, filter, reason; name = reason = "" }
    /^[^ #]/ { row_ends(); file = $1; test = $2; filter_of_file = $3 }
    /^  [^ ]/ {
      row_ends()
      colon = index($0, ": ")
      split(substr($0, 3, colon - 3), words, / [(]|[)]/)
      change = substr($0, colon + 2) " "
      arrow = index(change, " => ")
      name = words[1]; filter = words[2] == "" ? filter_of_file : words[2]
      from = substr(change, 1, arrow - 1); to = substr(change, arrow + 4, length(change) - arrow - 4)
    }
    /^    equivalent: / { reason = substr($0, 17) }
    END { row_ends() }' "$LIST"
}
mapfile -t rows < <(mutants)
names="$(printf '%s\n' "${rows[@]}" | cut -d $'\037' -f 1)"
for name in "${only[@]}"; do
  grep -qxF -- "$name" <<<"$names" ||
    die 2 "there is no defect '$name' (remedy: its names: grep '^  [a-z]' scripts/mutants.txt)"
done
begin=$(((part - 1) * ${#rows[@]} / parts)) end=$((part * ${#rows[@]} / parts))

# plant FILE FROM TO: replaces the text, which must occur exactly once.
plant() {
  [[ -f $TREE/$1 ]] || return
  FROM="$2" TO="$3" perl -0777 -i -pe '
    BEGIN { $from = $ENV{FROM}; $to = $ENV{TO}; }
    my $count = () = /\Q$from\E/g;
    if ($count != 1) { print STDERR "the text is there $count times\n"; $bad = 1; }
    else { s/\Q$from\E/$to/; }
    END { $? = 1 if $bad; }' "$TREE/$1"
}
build() {
  cmake --build "$TREE/build/release" --parallel "$JOBS" --target "lmdbench_$1_tests" >"$TREE/build/log" 2>&1
}
run_tests() {  # PROGRAM FILTER
  (cd "$TREE/build/release" &&
    timeout "$TIMEOUT" "./lmdbench_$1_tests" --gtest_brief=1 --gtest_filter="${2:-*}" >"$TREE/build/log" 2>&1 </dev/null)
}

(cd "$TREE" && cmake --preset release -DLMDBENCH_BUILD_EXPERIMENTS=ON -DLMDBENCH_WITH_CGAL=OFF) >/dev/null ||
  die "$EXIT_ENVIRONMENT" "the worktree cannot be configured (remedy: ./scripts/setup.sh)"

declare -A sound=()
killed=0 survived=0 equivalent=0 broken=0
printf '| defect | place | noticed by | verdict |\n|---|---|---|---|\n'
# shellcheck disable=SC2016  # a code span, no command
report() { printf '| %s | `%s` | %s | %s |\n' "$1" "$2" "$3" "$4"; }
for row in "${rows[@]:begin:end-begin}"; do
  IFS=$'\037' read -r name file from to program filter reason <<<"$row"
  if ((${#only[@]} > 0)) && [[ " ${only[*]} " != *" $name "* ]]; then continue; fi
  if [[ -n $reason ]]; then
    equivalent=$((equivalent + 1))
    report "$name" "$file" "-" "equivalent: $reason"
    continue
  fi
  # The test must pass without the defect, and the filter must select a test.
  if [[ -z ${sound[$program/$filter]:-} ]]; then
    if build "$program" && run_tests "$program" "$filter" && grep -qE '\[  PASSED  \] [1-9]' "$TREE/build/log"; then
      sound[$program/$filter]=yes
    else
      sound[$program/$filter]=no
      tail -n 20 "$TREE/build/log" >&2
    fi
  fi
  if [[ ${sound[$program/$filter]} == no ]]; then
    broken=$((broken + 1))
    report "$name" "$file" "$program ${filter}" "BROKEN: the tests do not pass without it"
    continue
  fi
  if ! plant "$file" "$from" "$to"; then
    broken=$((broken + 1))
    report "$name" "$file" "-" "BROKEN: does not fit the code"
  elif ! build "$program"; then
    broken=$((broken + 1))
    grep -m5 error "$TREE/build/log" >&2
    report "$name" "$file" "compiler" "BROKEN: does not compile"
  elif run_tests "$program" "$filter"; then
    survived=$((survived + 1))
    report "$name" "$file" "-" "SURVIVES in $program ${filter}"
  else
    killed=$((killed + 1))
    first="$(grep -m1 -oE '^\[  FAILED  \] [A-Za-z0-9_./]+' "$TREE/build/log" | sed 's/.*\] //')"
    report "$name" "$file" "${first:-$program, which did not end well}" "killed"
  fi
  git -C "$TREE" checkout --quiet --force -- "$file"
done
printf '\n%d killed, %d survive, %d equivalent, %d broken\n' "$killed" "$survived" "$equivalent" "$broken"
((killed + survived + equivalent + broken > 0)) || die 2 "no such defect (remedy: its names: grep '^  [a-z]' scripts/mutants.txt)"
((broken == 0)) || exit 2
((survived == 0))
