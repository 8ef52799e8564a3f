#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# The tests under sanitizers: address and undefined behaviour or, with the argument "tsan", threads.
# Further arguments go to ctest, e.g. -R Certified.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

preset="${1:-asan-ubsan}"
shift || true
[[ $preset == asan-ubsan || $preset == tsan ]] ||
  die 2 "unknown sanitizer preset '$preset' (remedy: asan-ubsan or tsan)"
"$ROOT/scripts/setup.sh"
build_normal "$preset"
cd "$ROOT"
ctest --preset "$preset" --label-exclude heavy --parallel "$JOBS" --no-tests=error "$@" </dev/null
