# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Shared by the scripts, to be sourced. Messages go to stderr.

ROOT="$(CDPATH="" cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
JOBS="$(nproc 2>/dev/null || echo 2)"
# The program's own exit code for a missing part of the environment.
EXIT_ENVIRONMENT=4

# Equal runs on a terminal and in CI: no questions, no colours in logs, decimal points.
export LC_ALL=C.UTF-8

say() { printf '%s\n' "$*" >&2; }
die() {
  local code="$1"
  shift
  say "error: $*"
  exit "$code"
}

# worktree_at FOLDER COMMIT: makes one unless it is there. What a killed call left in its place may
# be none: git would act on the repository around it.
worktree_at() {
  [[ "$(git -C "$1" rev-parse --show-toplevel 2>/dev/null)" != "$(realpath -m "$1")" ]] || return 0
  rm -rf "$1" && git -C "$ROOT" worktree prune && git -C "$ROOT" worktree add --quiet --detach "$1" "$2"
}

# step "title" command...: runs the command (or function); `print_steps` prints title and time.
STEP_LINES=()
step() {
  local title="$1" started=$EPOCHREALTIME status=0
  shift
  say ""
  say "== $title"
  "$@" || status=$?
  local mark=""
  ((status == 0)) || mark="  FAILED (exit code $status)"
  STEP_LINES+=("$(printf '%9s  %s%s' "$(seconds_since "$started")" "$title" "$mark")")
  return "$status"
}
seconds_since() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f s", b - a }'; }
print_steps() {
  say ""
  say "Wall time of each step:"
  printf '%s\n' "${STEP_LINES[@]}" >&2
}

# find_python MODULE...: prints the first interpreter that can import all modules. python3 may be a
# private build (pyenv, conda) without them; then the distribution's own is tried.
find_python() {
  local candidate imports
  imports="$(printf 'import %s;' "$@")"
  for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c "$imports" >/dev/null 2>&1; then
      command -v "$candidate"
      return 0
    fi
  done
  say "error: no python3 can import: $* (remedy: ./scripts/setup.sh, or a python3 first in PATH that has them)"
  return "$EXIT_ENVIRONMENT"
}

# apt_as_root ARGUMENT...: apt-get with root's rights, without questions.
apt_as_root() {
  local as_root=()
  if ((EUID != 0)); then
    # Without a terminal nobody can type a password: sudo must not need one.
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      say "error: apt-get needs root, and there is no usable sudo (remedy: as root, apt-get $*)"
      return "$EXIT_ENVIRONMENT"
    fi
  fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 "$@" </dev/null >&2
}

# build_meshes PROGRAM [MESH]...: all meshes, or these. They come from Debian packages; images often
# lack the package lists.
build_meshes() {
  local program="$1"
  shift
  "$program" mesh build "$@" </dev/null >&2 ||
    { apt_as_root update && "$program" mesh build "$@" </dev/null >&2; }
}

# run_anew PROGRAM EXPERIMENT RESULT [OPTION]...: begins again what was interrupted.
run_anew() {
  rm -f "$3.part"
  "$1" run "$2" --out "$3" "${@:4}" </dev/null
}

# build_normal PRESET [cmake option]...: all that ships and the programs of normal tests, not those
# of "heavy" ones, of studies and of benchmarks.
build_normal() {
  (cd "$ROOT" && cmake --preset "$@" && cmake --build --preset "$1" --target lmdbench_normal --parallel "$JOBS")
}

# build_preset PRESET [cmake option]...: everything.
build_preset() {
  local preset="$1"
  shift
  (cd "$ROOT" && cmake --preset "$preset" "$@" && cmake --build --preset "$preset" --parallel "$JOBS")
}
