#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Everything that a change must pass: style, build without warnings, tests, experiment files, a run
# end to end. Continues after failures; the last line is 'N passed, N failed' (each other check is
# one), with ', N skipped' for tests that proved nothing. Exit code 0 only if nothing failed. Not
# here, for time: sanitizer_tests.sh and heavy_tests.sh, which also builds studies, benchmarks and
# judges, and the program without optional parts.
set -uo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

(($# == 0)) || die 2 "unknown argument '$1' (remedy: ./scripts/test.sh takes none)"

passed=0
failed=0
skipped=0
failures=()
record_failure() {
  failed=$((failed + $1))
  failures+=("$2")
}

# check "title" command...: one check, passed or failed.
check() {
  if step "$@"; then
    passed=$((passed + 1))
  else
    record_failure 1 "$1"
    return 1
  fi
}

# tests "title" PRESET: runs the preset's tests and adds their counts.
tests() {
  local title="$1" preset="$2" report="$ROOT/build/$2/test-report.xml" total bad left_out
  rm -f "$report"
  step "$title" ctest_preset "$preset" "$report"
  local status=$?
  # Attributes of the report's first element; without a report or with an empty one nothing passed.
  total="$(grep -om1 'tests="[0-9]*"' "$report" 2>/dev/null | tr -dc 0-9)"
  bad="$(grep -om1 'failures="[0-9]*"' "$report" 2>/dev/null | tr -dc 0-9)"
  left_out="$(grep -om1 'skipped="[0-9]*"' "$report" 2>/dev/null | tr -dc 0-9)"
  if [[ -z $total || $total -eq 0 ]]; then
    record_failure 1 "$title: no test ran"
    return 1
  fi
  left_out="${left_out:-0}"
  passed=$((passed + total - bad - left_out))
  skipped=$((skipped + left_out))
  if ((bad > 0)); then
    record_failure "$bad" "$title: $bad of $total"
  elif ((status != 0)); then
    record_failure 1 "$title: ctest left with exit code $status"
  fi
}
# One test more than processors: some wait for the clock, for a browser or for a plugin that hangs.
ctest_preset() {
  (cd "$ROOT" && ctest --preset "$1" --label-exclude heavy --parallel "$((JOBS + 1))" --no-tests=error \
    --output-junit "$2" </dev/null)
}

# Every committed experiment must pass the program's check (schema and further rules). A clean clone
# has no fetched meshes: a file is right if only its mesh is missing.
experiment_files() {
  local file message count=0 bad=0
  for file in "$ROOT"/experiments/*.json; do
    [[ -e $file && $file != *schema.json ]] || continue
    count=$((count + 1))
    if ! message="$("$ROOT/build/release/lmdbench" plan "$file" --json 2>&1 >/dev/null)" &&
      [[ $message != *"is not built yet"* ]]; then
      say "$message"
      bad=$((bad + 1))
    fi
  done
  say "$count experiment files, $bad wrong"
  ((count > 0 && bad == 0))
}

# A whole run on generated shapes, without network: the result must be as in results/README.md
# describes, and give its figure.
end_to_end() {
  local python result="$ROOT/build/release/shapes.h5" folder="$ROOT/build/release/figures"
  python="$(find_python h5py matplotlib numpy)" || return
  (cd "$ROOT" && run_anew build/release/lmdbench experiments/shapes.json "$result") &&
    "$python" "$ROOT/scripts/figures/check_format.py" "$result" &&
    "$python" "$ROOT/scripts/figures/figure7.py" "$result" --out "$folder" &&
    [[ -s $folder/figure7.png ]]
}

if ! step "Set-up" "$ROOT/scripts/setup.sh"; then
  die "$EXIT_ENVIRONMENT" "set-up failed, see above"
fi

check "Format and shell scripts" "$ROOT/scripts/lint.sh" --quick
if check "Build (release, warnings are errors)" build_normal release -DLMDBENCH_WARNINGS_AS_ERRORS=ON; then
  tests "Tests (release)" release
  check "Experiment files" experiment_files
  check "Run, result format and figure" end_to_end
  # The full check takes minutes: ./scripts/lint.sh
  check "Static analysis of what changed" "$ROOT/scripts/lint.sh" --tidy-changed
fi
print_steps
for failure in "${failures[@]}"; do say "FAILED: $failure"; done
((skipped == 0)) || say "skipped tests are named by ctest above, with the reason"
echo "$passed passed, $failed failed$( ((skipped == 0)) || echo ", $skipped skipped")"
((failed == 0))
