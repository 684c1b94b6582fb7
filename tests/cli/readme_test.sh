#!/usr/bin/env bash
# Runs every `voxelume` command of README.md, in order, in a folder of its own.
# Usage: readme_test.sh SOURCE_FOLDER PROGRAM
set -euo pipefail
source=$1
program=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ln -s "$program" "$folder/voxelume"
ln -s "$source/scenes" "$folder/scenes"
cd "$folder"
commands=0
while read -r line; do
    echo "\$ $line"
    PATH="$folder:$PATH" bash -c "$line"
    commands=$((commands + 1))
done < <(sed -n '/^```sh/,/^```/p' "$source/README.md" | grep '^voxelume ')
[ "$commands" -ge 5 ] || { echo "only $commands commands found in README.md"; exit 1; }
