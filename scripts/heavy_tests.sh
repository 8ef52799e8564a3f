#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# The long tests (ctest label "heavy"), which scripts/test.sh leaves out. Arguments go to ctest, e.g. -R triangle.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

"$ROOT/scripts/setup.sh"
build_preset release
cd "$ROOT"
ctest --preset release --label-regex heavy --parallel "$JOBS" --no-tests=error "$@" </dev/null
