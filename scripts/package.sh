#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages lmdbench, liblmdbench-dev and python3-lmdbench into
# build/package/packages.
#   --check  also lintian, and install, run, upgrade and purge in a clean root that mmdebstrap makes
#            (as root; needs the archive; scripts/packaging/check_packages.py)
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

check=0
case "${1:-}" in
  "") ;;
  --check) check=1 ;;
  *) die 2 "unknown argument '$1' (remedy: ./scripts/package.sh [--check])" ;;
esac
build="$ROOT/build/package"
(cd "$ROOT" && cmake --preset package) >&2
cmake --build "$build" --parallel "$JOBS" \
  --target lmdbench lmdbench_manual_pages lmdbench_whole lmdbench_python >&2
rm -rf "$build/packages"
(cd "$build" && cpack -G DEB) >&2
ls -l "$build"/packages/*.deb
((check == 0)) || python3 "$ROOT/scripts/packaging/check_packages.py" "$build"
