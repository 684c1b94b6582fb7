#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a bare Debian 12 in an empty folder, from an archive in CACHE_FOLDER that the first call
# fills. As root; needs debootstrap. The packages come from where this machine has its own, or from
# where VXL_DEBIAN_MIRROR says.
# Usage: bare_debian.sh FOLDER CACHE_FOLDER
set -euo pipefail
folder=$1
cache=$2
mirror=${VXL_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(SITE)' \
    'Codename: bookworm' 'Component: main' | head -n 1)}
if [ ! -f "$cache/minimal.tar" ]; then
    made=$(mktemp -d)
    trap 'rm -rf --one-file-system "$made"' EXIT
    debootstrap --variant=minbase bookworm "$made" "$mirror" >"$cache/debootstrap.log" ||
        { tail "$cache/debootstrap.log"; exit 1; }
    rm -rf "$made"/var/cache/apt/archives/*.deb
    tar -C "$made" --one-file-system -cf "$cache/minimal.tar.part" .
    mv "$cache/minimal.tar.part" "$cache/minimal.tar"
fi
tar -C "$folder" -xf "$cache/minimal.tar"
