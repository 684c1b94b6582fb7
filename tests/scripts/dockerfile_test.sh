#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Does what cmake/Dockerfile says, without Docker: its stages are bare Debians in folders, and its
# lines run there by chroot. Then renders a picture as the container would. The first stage, which
# builds the package from the last commit's sources, is left out where PACKAGE is one: that takes a
# quarter of an hour. Runs as root; needs what bare_debian.sh does. Usage: dockerfile_test.sh
# SOURCE_FOLDER CACHE_FOLDER [PACKAGE]
set -euo pipefail
source=$(realpath "$1")
mkdir -p "$2"
cache=$(realpath "$2")
package=${3:+$(realpath "$3")}
[ "$(id -u)" -eq 0 ] || { echo "dockerfile_test.sh: needs root"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf --one-file-system "$folder"' EXIT
fail() {
    echo "dockerfile_test.sh: $*"
    exit 1
}

# What lines of a stage set.
root="" work=/ entry="" stage=0
environment=()

# in_root COMMAND...: in the stage, with the network of this machine, but with none of its variables
# other than those of a proxy. /proc and /sys are mounted for each command alone.
in_root() {
    local proxies=() name
    for name in http_proxy https_proxy no_proxy; do
        [ -z "${!name:-}" ] || proxies+=("$name=${!name}")
    done
    # shellcheck disable=SC2016 # the inner shell's variables
    unshare --mount bash -c 'mount --rbind /proc "$0/proc" && mount --rbind /sys "$0/sys" &&
        mount --bind /etc/resolv.conf "$0/etc/resolv.conf" && exec chroot "$0" "$@"' "$root" \
        env -i -C "$work" PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        HOME=/root DEBIAN_FRONTEND=noninteractive "${proxies[@]}" "${environment[@]}" "$@"
}

from() {
    stage=$((stage + 1)) root=$folder/${3:-last} work=/ entry="" environment=()
    [ "$1" = debian:12 ] || fail "a stage is from $1 instead of debian:12"
    mkdir "$root"
    [ -n "$package" ] && [ "${3:-}" = build ] && return
    tests/scripts/bare_debian.sh "$root" "$cache" || fail "there is no bare Debian"
    touch "$root/etc/resolv.conf"
}

# copy SOURCE TARGET, or copy --from=STAGE PATTERN TARGET/
copy() {
    case $1 in
        .) git clone -q --depth 1 "file://$source" "$root$2" ;;
        --from=build)
            mkdir -p "$root$3"
            # shellcheck disable=SC2086 # a pattern
            cp ${package:-$folder/build$2} "$root$3"
            ;;
        *) fail "COPY $*: this test can't do that" ;;
    esac
}

cd "$source"
# Lines that end in a backslash go on in the next one.
sed -e '/^#/d' -e ':more' -e '/\\$/{N;s/\\\n//;b more}' cmake/Dockerfile >"$folder/lines"
while read -r word rest; do
    # The first stage only makes the package.
    case ${package:+given}:$(basename "$root"):$word in
        given:build:FROM) ;;
        given:build:*) continue ;;
    esac
    case $word in
        '') ;;
        FROM) read -r -a words <<<"$rest" && from "${words[@]}" ;;
        COPY) read -r -a words <<<"$rest" && copy "${words[@]}" ;;
        WORKDIR) work=$rest && mkdir -p "$root$work" ;;
        ENV) environment+=("$rest") ;;
        VOLUME) mkdir -p "$root$rest" ;;
        RUN)
            echo "== $rest"
            in_root sh -c "$rest" </dev/null >"$cache/dockerfile.log" 2>&1 ||
                fail "$(tail -n 20 "$cache/dockerfile.log")"
            ;;
        ENTRYPOINT) entry=$(sed 's/[]["]//g' <<<"$rest") ;;
        *) fail "$word $rest: this test can't do that" ;;
    esac
done <"$folder/lines"

[ "$stage" -eq 2 ] && [ "$entry" = voxelume ] || fail "the Dockerfile has other stages"
cp scenes/solids.json "$root$work/scene.json"
in_root "$entry" render scene.json -o picture.png --size 64x48 >"$cache/dockerfile.log" 2>&1 ||
    fail "$(cat "$cache/dockerfile.log")"
[ -s "$root$work/picture.png" ] || fail "the container makes no picture"
[ -n "$(find "$root/var/cache/voxelume" -type f -print -quit)" ] || fail "its cache stays empty"
echo "what cmake/Dockerfile says makes $(in_root "$entry" --version | head -n 1), which renders"
