#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# For a nightly run: builds everything, also the studies, benchmarks and judges that scripts/test.sh
# leaves out, runs the tests of them and the long ones (ctest label "heavy") and, without arguments,
# makes the build without optional parts and the one of every file by itself, which no include
# that is missing passes. Arguments go to ctest, e.g. -R triangle.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

"$ROOT/scripts/setup.sh"
build_preset release -DLMDBENCH_WARNINGS_AS_ERRORS=ON
cd "$ROOT"
ctest --preset release --label-regex heavy --parallel "$JOBS" --no-tests=error "$@" </dev/null
if (($# == 0)); then
  python3 "$ROOT/scripts/smallest_build.py" >&2
  build_preset develop
fi
