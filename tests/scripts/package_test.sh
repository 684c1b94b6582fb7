#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian package in a bare Debian of its own, renders with it, builds a program against
# it, and removes it: then the system is as it was. As root; needs debootstrap and Debian's archive.
# The bare system stays in CACHE_FOLDER for the next time.
# Usage: package_test.sh PACKAGE SOURCE_FOLDER CACHE_FOLDER
set -euo pipefail
package=$(realpath "$1")
source=$(realpath "$2")
mkdir -p "$3"
cache=$(realpath "$3")

fail() {
    echo "package_test.sh: $*"
    exit 1
}
[ "$(id -u)" -eq 0 ] || fail "needs root"

# A bare system with what the package depends on, so that the package alone makes the difference.
if [ ! -f "$cache/bare.tar" ]; then
    made=$(mktemp -d)
    trap 'rm -rf --one-file-system "$made"' EXIT
    "$source/tests/scripts/bare_debian.sh" "$made" "$cache" || fail "there is no bare Debian"
    needs=$(dpkg-deb -f "$package" Depends | tr ',' '\n' | sed -E 's/[|(].*//' | tr -d ' ' | sort -u)
    for one in g++ man-db pkg-config $needs; do
        case $one in libopencl*) ;; *) echo "$one" ;; esac
    done | xargs chroot "$made" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y \
        --no-install-recommends pocl-opencl-icd >"$cache/log" 2>&1 || fail "$(tail "$cache/log")"
    rm -rf "$made"/var/cache/apt/archives/*.deb
    tar -C "$made" --one-file-system -cf "$cache/bare.tar.part" .
    mv "$cache/bare.tar.part" "$cache/bare.tar"
    rm -rf --one-file-system "$made"
fi

root=$(mktemp -d)
trap 'rm -rf --one-file-system "$root"' EXIT
tar -C "$root" -xf "$cache/bare.tar"
files() {
    (cd "$root" && find . -xdev \( -path ./tmp -o -path ./root -o -path './var/cache' -o \
        -path './var/lib/dpkg' -o -path './var/log' -o -path './dev' \) -prune -o -print | sort)
}
files >"$cache/before"

cp "$package" "$root/tmp/voxelume.deb"
cp "$source/tests/consumer/consumer.cpp" "$root/tmp/"
# PoCL asks /proc and /sys for the processor. They are mounted for each command alone.
in_root() {
    # shellcheck disable=SC2016 # the inner shell's variables
    unshare --mount bash -c 'mount --rbind /proc "$0/proc" && mount --rbind /sys "$0/sys" &&
        exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root bash -c "$1"' "$root" "$1"
}
in_root 'dpkg -i /tmp/voxelume.deb' >"$cache/log" 2>&1 || fail "$(cat "$cache/log")"
in_root 'cd /tmp && voxelume render /usr/share/voxelume/scenes/solids.json -o solids.png --size 64x48 &&
    voxelume render /usr/share/voxelume/scenes/lighthouse.vox -o lighthouse.png --size 64x48 &&
    voxelume voxelize --help >/dev/null && ! ldd /usr/bin/voxelume | grep "not found"' >"$cache/log" 2>&1 ||
    fail "$(cat "$cache/log")"
in_root 'cd /tmp && c++ consumer.cpp $(pkg-config --cflags --libs voxelume) -o consumer && ./consumer' \
    >"$cache/log" 2>&1 || fail "$(cat "$cache/log")"
in_root 'man voxelume | grep -q "^COMMANDS" &&
    source /usr/share/bash-completion/completions/voxelume && complete -p voxelume >/dev/null' ||
    fail "the manual page or the completion of bash is missing"
in_root 'test -s /usr/share/doc/voxelume/copyright && test -s /usr/share/doc/voxelume/voxelume.spdx.json' ||
    fail "licence or bill of materials is missing"
in_root 'dpkg --purge voxelume' >"$cache/log" 2>&1 || fail "$(cat "$cache/log")"
files | diff "$cache/before" - || fail "purging leaves something, or takes too much"
echo "installed, used, and purged without a trace: $(basename "$package")"
