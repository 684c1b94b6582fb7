#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compares every frame of the animations in scenes/ at full size: same_frames.sh [PROGRAM]
# [SCENE...]
#
# Renders each animation in one run, which retains what it can between frames and overlaps them, and
# then every frame by its own process. Prints the frames whose files differ, and the number
# compared; exits with 1 if any differs. It takes twenty minutes on two busy cores.
# (animation_frames_test compares the turntable's volumes, smaller.)
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
program=${1:-$source/build/voxelume}
[ $# -gt 0 ] && shift
scenes=${*:-turntable procession pendulum melt drill}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
compared=0
differing=0

# frames SCENE FOLDER OPTION...: renders the scene's frames into the folder.
frames() {
    scene=$1
    folder=$2
    shift 2
    "$program" render "$source/scenes/$scene.json" --assets /usr/share/glmark2/models -q --no-cache --float \
        -o "$folder/$scene.####.exr" "$@"
}

mkdir "$work/run" "$work/alone"
for scene in $scenes; do
    begin=$(date +%s)
    frames "$scene" "$work/run"
    middle=$(date +%s)
    for file in "$work/run/$scene".*.exr; do
        number=${file%.exr}
        number=${number##*.}
        frames "$scene" "$work/alone" --frames "$(expr "$number" + 0)"
    done
    echo "$scene: $((middle - begin)) s in one run, $(($(date +%s) - middle)) s one by one"
    for file in "$work/run/$scene".*.exr; do
        compared=$((compared + 1))
        cmp -s "$file" "$work/alone/${file##*/}" && continue
        differing=$((differing + 1))
        echo "${file##*/} differs"
    done
    rm -f "$work"/run/* "$work"/alone/*
done
echo "$compared files, $differing differ"
[ "$differing" = 0 ]
