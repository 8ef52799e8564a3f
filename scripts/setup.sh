#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing packages of a list, by default scripts/packages.txt. If none is missing it does
# nothing, and needs neither network nor root.
#   setup.sh [LIST]
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

list="${1:-$ROOT/scripts/packages.txt}"
[[ -r $list ]] || die 2 "$list: cannot be read (remedy: name a list of packages, one a line)"
mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$list")

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  die "$EXIT_ENVIRONMENT" "this is not a Debian system, so nothing can be installed for you" \
    "(remedy: Debian 12, or your system's packages for: ${wanted[*]})"
fi

installed="$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)"
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "installed $package" <<<"$installed" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  say "All ${#wanted[@]} packages of ${list#"$ROOT/"} are installed."
  exit 0
fi

say "Missing packages: ${missing[*]}"
{ apt_as_root update && apt_as_root install -y --no-install-recommends "${missing[@]}"; } ||
  die "$EXIT_ENVIRONMENT" "packages are missing (remedy: see the message above; then, as root," \
    "apt-get update && apt-get install --no-install-recommends ${missing[*]})"
