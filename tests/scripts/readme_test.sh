#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every `voxelume` command of README.md and of the command line's manual in order, each page in
# its own folder. A line that ends in \ continues in the next one. What a command leaves to the scene,
# the size of pictures and the number of a display's voxels, is small unless VXL_TEST_ALL is set.
# Usage: readme_test.sh SOURCE_FOLDER PROGRAM
set -euo pipefail
source=$1
program=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# run_page PAGE COUNT: runs the page's commands; fails if it has fewer than COUNT.
run_page() {
    local page=$1 here commands=0
    here=$folder/$(basename "$page" .md)
    mkdir "$here"
    ln -s "$program" "$here/voxelume"
    ln -s "$source/scenes" "$here/scenes"
    cd "$here"
    while read -r line; do
        case "${VXL_TEST_ALL:-}$line" in
            'voxelume render '*' --volume '*) line="$line --set observer.display.voxels=48,36,48" ;;
            *size*) ;;
            'voxelume render '*) line="$line --size 160x90" ;;
        esac
        echo "\$ $line"
        PATH="$here:$PATH" bash -c "$line"
        commands=$((commands + 1))
    done < <(sed -n '/^```sh/,/^```/p' "$source/$page" | sed -e ':more' -e '/\\$/{N;s/\\\n *//;b more' -e '}' |
        grep '^voxelume ')
    [ "$commands" -ge "$2" ] || { echo "only $commands commands found in $page"; exit 1; }
}
run_page README.md 5
run_page cli/MANUAL.md 15
