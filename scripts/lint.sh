#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Style and static analysis.
#   --quick  clang-format, shellcheck, ASCII and licence headers (seconds)
#   --tidy   clang-tidy over the library and the program (minutes; needs the release build's compile commands)
#   (none)   both
set -uo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT" || exit 1

# Files that git knows or would add: what is ignored (build, meshes, results) is not ours to check.
sources() { git ls-files --cached --others --exclude-standard -- "$@" | while read -r f; do [[ -e $f ]] && echo "$f"; done; }

format() {
  local files bad
  mapfile -t files < <(sources '*.h' '*.cpp')
  bad="$(clang-format --dry-run --Werror "${files[@]}" 2>&1 | grep -o '^[^:]*:[0-9]*:[0-9]*: error' | cut -d: -f1 | sort -u)"
  [[ -z $bad ]] && say "clang-format: ${#files[@]} files" && return 0
  # shellcheck disable=SC2086  # one name a word, no spaces in our file names
  printf '%s: not formatted (remedy: clang-format -i)\n' $bad >&2
  return 1
}

shell_scripts() {
  local files
  mapfile -t files < <(sources '*.sh' '.ci/run')
  shellcheck -x "${files[@]}" && say "shellcheck: ${#files[@]} files"
}

headers() {
  local files bad
  mapfile -t files < <(sources '*.h' '*.cpp' '*.py' '*.sh' '*CMakeLists.txt' '.ci/run')
  bad="$(for f in "${files[@]}"; do head -n 3 "$f" | grep -q SPDX-License-Identifier || echo "$f: no SPDX header"; done)"
  # LC_ALL=C: a byte outside ASCII is a byte, whatever it means in another encoding.
  bad+="$(LC_ALL=C grep -nP '[^\x00-\x7F]' "${files[@]}" | sed 's/$/  (not ASCII)/')"
  [[ -z $bad ]] && say "headers and ASCII: ${#files[@]} files" && return 0
  printf '%s\n' "$bad" >&2
  return 1
}

tidy() {
  local database="$ROOT/build/release/compile_commands.json" log="$ROOT/build/release/clang-tidy.log"
  [[ -e $database ]] || die "$EXIT_ENVIRONMENT" "$database is missing (remedy: cmake --preset release)"
  # The database also holds tests and benchmarks; the rules are for what ships.
  if run-clang-tidy -quiet -j "$JOBS" -p "$(dirname "$database")" "$ROOT/src/lmdbench/.*\.cpp" >"$log" 2>/dev/null; then
    say "clang-tidy: no findings"
    return 0
  fi
  sed -i 's/\x1b\[[0-9;]*m//g' "$log"
  grep -E "(warning|error): " "$log" | sort -u >&2
  say "clang-tidy: see $log"
  return 1
}

status=0
case "${1:-}" in
  --quick | "")
    format || status=1
    shell_scripts || status=1
    headers || status=1
    ;;&
  --tidy | "") tidy || status=1 ;;
  --quick) ;;
  *) die 2 "unknown argument '$1' (remedy: ./scripts/lint.sh [--quick|--tidy])" ;;
esac
exit "$status"
