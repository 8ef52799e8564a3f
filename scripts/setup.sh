#!/usr/bin/env bash
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages of scripts/packages.txt that are missing. Does nothing, and needs neither network nor root,
# when all are there.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$ROOT/scripts/packages.txt")

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
  say "All ${#wanted[@]} packages of scripts/packages.txt are installed."
  exit 0
fi

say "Missing packages: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  # Without a terminal nobody can type a password: then only a sudo that asks for none is of use.
  if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
    as_root=(sudo)
  else
    die "$EXIT_ENVIRONMENT" "installing needs root, and there is no usable sudo" \
      "(remedy: as root, apt-get update && apt-get install --no-install-recommends ${missing[*]})"
  fi
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3)
"${apt[@]}" update </dev/null >&2 ||
  die "$EXIT_ENVIRONMENT" "apt-get update failed (remedy: check the network and /etc/apt/sources.list)"
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >&2 ||
  die "$EXIT_ENVIRONMENT" "apt-get install failed (remedy: read its message above; Debian 12 has every package)"
