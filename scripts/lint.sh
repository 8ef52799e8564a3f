#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Style and static analysis.
#   --quick  clang-format, shellcheck, flake8, ASCII, licence headers, comments (seconds)
#   --tidy   clang-tidy over the library and the program (minutes; needs compile commands)
#   --tidy-changed   the same for changes since LMDBENCH_LINT_BASE (a commit; default: the parent)
#   (none)   --quick and --tidy
set -uo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
cd "$ROOT" || exit 1

# Files that git knows or would add; ignored ones (build, meshes, results) are not checked.
sources() { git ls-files --cached --others --exclude-standard -- "$@" | while read -r f; do [[ -e $f ]] && echo "$f"; done; }

format() {
  local files bad
  command -v clang-format >/dev/null || die "$EXIT_ENVIRONMENT" "there is no clang-format (remedy: ./scripts/setup.sh)"
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
  shellcheck -x "${files[@]}" && shadows_nothing "${files[@]}" && say "shellcheck: ${#files[@]} files"
}
# A function that has the name of one of lib.sh takes its place there as well, without end if it
# calls it.
shadows_nothing() {
  local shared found
  shared="$(sed -nE 's/^([a-z_]+)\(\).*/\1/p' scripts/lib.sh | paste -sd '|')"
  found="$(printf '%s\n' "$@" | grep -vxF scripts/lib.sh | xargs -d '\n' grep -nE "^($shared)\(\)")" || return 0
  say "$found" "is a name of scripts/lib.sh (remedy: another one)"
  return 1
}

python_files() {
  local files
  mapfile -t files < <(sources '*.py')
  flake8 "${files[@]}" && say "flake8: ${#files[@]} files"
}

headers() {
  local files bad
  mapfile -t files < <(sources '*.h' '*.cpp' '*.c' '*.js' '*.py' '*.sh' '*CMakeLists.txt' '.ci/run')
  bad="$(for f in "${files[@]}"; do head -n 3 "$f" | grep -q SPDX-License-Identifier || echo "$f: no SPDX header"; done)"
  # LC_ALL=C: grep takes bytes outside ASCII as they are, in any encoding.
  [[ -z $bad ]] || bad+=$'\n'
  bad+="$(LC_ALL=C grep -nP '[^\x00-\x7F]' "${files[@]}" | sed 's/$/  (not ASCII)/')"
  [[ -z $bad ]] && say "headers and ASCII: ${#files[@]} files" && return 0
  printf '%s\n' "$bad" >&2
  return 1
}

# Comments: at most 100 columns, but for a URL or NOLINT; and none of the words that the table "Terms"
# of CONTRIBUTING.md replaces and that mean nothing else in this code.
comments() {
  local files bad words='ghosts?|company|doubts?|allowances?|contact pairs?|engaged|penetrat(e|es|ed|ing)'
  words+='|hardness|calm(er)?|haptic (ticks?|steps?)'
  mapfile -t files < <(sources '*.h' '*.cpp' '*.c' '*.py' '*.sh')
  bad="$(awk -v words="[^a-z](${words})[^a-z]" '
    FNR == 1 { mark = FILENAME ~ /[.](py|sh)$/ ? "^ *#" : "(^|[ ;])//|^ */?[*] " }
    !match($0, mark) || /NOLINT/ { next }
    length($0) > 100 && !/https?:/ {
      print FILENAME ":" FNR ": comment up to column " length($0) " (remedy: end at 100; shorten it or move it above)" }
    { text = tolower(substr($0, RSTART)) " " }
    match(text, words) {
      print FILENAME ":" FNR ": \"" substr(text, RSTART + 1, RLENGTH - 2) "\" (remedy: the term in CONTRIBUTING.md, Terms)" }
  ' "${files[@]}")"
  [[ -z $bad ]] && say "comments: ${#files[@]} files" && return 0
  printf '%s\n' "$bad" >&2
  return 1
}

# Sources in src/ that changed since the base, also by their header; all if there is no base. Not
# templates, which are projects of their own.
changed_sources() {
  local base="${LMDBENCH_LINT_BASE:-HEAD~1}" file templates=':!src/lmdbench/plugin/template'
  if ! git rev-parse --quiet --verify "$base^{commit}" >/dev/null; then
    git ls-files 'src/*.cpp' "$templates"
    return
  fi
  git diff --name-only "$base" -- 'src/*.cpp' 'src/*.h' "$templates" | while read -r file; do
    [[ -e ${file%.*}.cpp ]] && echo "${file%.*}.cpp"
  done | sort -u
}

# tidy PRESET FOLDER UNITY [ARGUMENT...] PATTERN...: sources whose names match, in the tree
# configured in build/FOLDER, with ON those of a library at once; not tests and benchmarks, as the
# rules are for code that ships.
tidy() {
  local preset="$1" folder="$ROOT/build/$2" options=(-DLMDBENCH_UNITY="$3" -DLMDBENCH_PRECOMPILED_HEADERS=OFF)
  shift 3
  [[ $preset == smallest ]] || options+=(-DLMDBENCH_WITH_PYTHON=ON) # the module is code that ships, too
  # A configured tree with its generated header is enough; it must have no precompiled headers, as
  # clang cannot read GCC's.
  (cd "$ROOT" && cmake --preset "$preset" -B "$folder" "${options[@]}" && cmake --build "$folder" --target lmdbench_git_state) >/dev/null ||
    die "$EXIT_ENVIRONMENT" "the tree cannot be configured (remedy: ./scripts/setup.sh)"
  # The compile commands are GCC's; clang may not know all warnings.
  local log="$folder/clang-tidy.log" status=0 count least
  run-clang-tidy -quiet -extra-arg=-Wno-unknown-warning-option -j "$JOBS" -p "$folder" "$@" 2>/dev/null | sed 's/\x1b\[[0-9;]*m//g' >"$log" || status=1
  grep -E "(warning|error): " "$log" | sort -u >&2
  count="$(grep -ac '^clang-tidy' "$log")"
  least="$(printf '%s\n' "$@" | grep -vc '^-')" # patterns
  ((count >= least)) || status=1
  say "clang-tidy: $count sources$( ((count >= least)) || echo " of $least, as the others are not compiled in $folder")$( ((status == 0)) || echo "; see $log")"
  return "$status"
}
# Compiled only where an option is off.
SMALLEST='/(few_commands|assimp_missing|fcl_missing)[.]cpp$'
tidy_smallest() { tidy smallest tidy-smallest OFF "$@"; }
# The files of a library at once, by which headers are read a fifth as often; what is only asked of
# a whole source (using-declarations that nobody needs) tidy_changed asks.
tidy_all() {
  local failed=0
  tidy develop tidy ON -checks=-bugprone-suspicious-include /src/lmdbench/ || failed=1
  tidy_smallest "$SMALLEST" || failed=1
  return "$failed"
}
tidy_changed() {
  local files small failed=0
  mapfile -t files < <(changed_sources | grep -vE "$SMALLEST")
  mapfile -t small < <(changed_sources | grep -E "$SMALLEST")
  ((${#files[@]} + ${#small[@]} > 0)) || say "clang-tidy: nothing to check"
  ((${#files[@]} == 0)) || tidy develop develop OFF "${files[@]/%/\$}" || failed=1
  ((${#small[@]} == 0)) || tidy_smallest "${small[@]/%/\$}" || failed=1
  return "$failed"
}

status=0
case "${1:-}" in
  --quick | "")
    format || status=1
    shell_scripts || status=1
    python_files || status=1
    headers || status=1
    comments || status=1
    ;;&
  --tidy | "") tidy_all || status=1 ;;
  --tidy-changed) tidy_changed || status=1 ;;
  --quick) ;;
  *) die 2 "unknown argument '$1' (remedy: ./scripts/lint.sh [--quick|--tidy|--tidy-changed])" ;;
esac
exit "$status"
