#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# What both workflow files run: compares a change with the commit that it starts from (scripts/ci_regression.sh, whose options
# may follow) and says the outcome where the service shows it.
#
#   scripts/ci/pull_request.sh BASE_REV CANDIDATE_REV [option]...
#
# GitHub Actions (it sets GITHUB_ACTIONS): verdict.md is appended to the job's summary, an annotation names the outcome, and
# "unsure" passes with a notice. Elsewhere the exit code is that of ci_regression.sh: GitLab takes 4 for a warning
# (allow_failure).
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/../lib.sh"

# ci_regression.sh writes there unless told otherwise.
out="$ROOT/build/ci"
rm -f "$out/verdict.md"
status=0
"$ROOT/scripts/ci_regression.sh" "$@" --out "$out" || status=$?
if [[ ${GITHUB_ACTIONS:-} == true ]]; then
  [[ ! -s $out/verdict.md || -z ${GITHUB_STEP_SUMMARY:-} ]] || cat "$out/verdict.md" >>"$GITHUB_STEP_SUMMARY"
  case "$status" in
    0) ;;
    1) echo "::error::the candidate is slower, behaves otherwise, or does not build or run: see the summary" ;;
    4) echo "::notice::unsure: this runner's times do not decide" && status=0 ;;
    *) echo "::error::no comparison (exit code $status): see the log" ;;
  esac
fi
exit "$status"
