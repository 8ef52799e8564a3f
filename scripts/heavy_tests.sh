#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# For a nightly run: the long tests (ctest label "heavy") that scripts/test.sh leaves out and,
# without arguments, the build without optional parts. Arguments go to ctest, e.g. -R triangle.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

"$ROOT/scripts/setup.sh"
build_preset release
cd "$ROOT"
ctest --preset release --label-regex heavy --parallel "$JOBS" --no-tests=error "$@" </dev/null
if (($# == 0)); then python3 "$ROOT/scripts/smallest_build.py" >&2; fi
