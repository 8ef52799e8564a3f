#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# For both workflow files: compares a change with its starting commit (scripts/ci_regression.sh,
# whose options may follow) and shows the outcome in the service.
#
#   scripts/ci/pull_request.sh BASE_REV CANDIDATE_REV [option]...
#
# GitHub Actions (with GITHUB_ACTIONS set): the job's summary gets verdict.md, an annotation its
# first line; "unsure" passes with a notice. Elsewhere the exit code is that of ci_regression.sh:
# GitLab takes 4 for a warning (allow_failure).
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/../lib.sh"

# ci_regression.sh writes there by default.
out="$ROOT/build/ci"
rm -f "$out/verdict.md"
status=0
"$ROOT/scripts/ci_regression.sh" "$@" --out "$out" || status=$?
if [[ ${GITHUB_ACTIONS:-} == true ]]; then
  [[ ! -s $out/verdict.md || -z ${GITHUB_STEP_SUMMARY:-} ]] || cat "$out/verdict.md" >>"$GITHUB_STEP_SUMMARY"
  # The verdict and its reason: the line between asterisks, escaped for the service.
  headline="$(sed -n '1{s/^\*\*//;s/\*\*$//;s/%/%25/g;p}' "$out/verdict.md" 2>/dev/null || true)"
  headline="${headline:-no comparison (exit code $status): see the log}"
  case "$status" in
    0) ;;
    4) echo "::notice::$headline" && status=0 ;;
    *) echo "::error::$headline" ;;
  esac
fi
exit "$status"
