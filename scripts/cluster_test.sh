#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Fifty points on a Slurm that the test starts on the loopback interface, as root; its node fails
# half-way. Takes some minutes. Installs missing packages of scripts/cluster/packages.txt.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

(($# == 0)) || die 2 "unknown argument '$1' (remedy: ./scripts/cluster_test.sh takes none)"
"$ROOT/scripts/setup.sh"
"$ROOT/scripts/setup.sh" "$ROOT/scripts/cluster/packages.txt"
build_preset release
cd "$ROOT"
said="$(ctest --preset release --tests-regex '^(Cluster|Slurm)$' --no-tests=error </dev/null | tee >(cat >&2))"
[[ $said != *"(Skipped)"* ]] || die "$EXIT_ENVIRONMENT" "a test was skipped, so nothing is shown (remedy: what it says above)"
