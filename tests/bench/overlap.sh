#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Measures what overlapping frames saves: overlap.sh [PROGRAM] [SCENE] [FRAMES] [ROUNDS] [OPTION...]
#
# Renders the frames by whole processes with and without --no-overlap in turn, so that other work of
# the machine slows both equally. Prints each time, the ratio of the medians, and the fraction of a
# frame without overlap that is voxelization.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
program=${1:-$source/build/voxelume}
scene=${2:-$source/scenes/melt.json}
frames=${3:-1-48}
rounds=${4:-5}
[ $# -gt 4 ] && shift 4 || set -- --size 160x120
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run NAME OPTION...: appends the milliseconds of a run to those of the earlier runs.
run() {
    name=$1
    shift
    begin=$(date +%s%N)
    "$program" render "$scene" --assets /usr/share/glmark2/models --no-cache -q --frames "$frames" \
        -o "$work/frame.####.exr" --stats-json "$work/$name.json" "$@"
    echo $((($(date +%s%N) - begin) / 1000000)) >>"$work/$name"
}

median() {
    sort -n "$1" | sed -n "$((($(wc -l <"$1") + 1) / 2))p"
}

run warm "$@"
for _ in $(seq "$rounds"); do
    run overlapped "$@"
    run in_turn --no-overlap "$@"
done
echo "with overlap:    $(tr '\n' ' ' <"$work/overlapped")ms"
echo "without overlap: $(tr '\n' ' ' <"$work/in_turn")ms"
awk -v a="$(median "$work/overlapped")" -v b="$(median "$work/in_turn")" \
    'BEGIN {printf "medians: %d of %d ms, %.3f\n", a, b, a / b}'
# The first "seconds" in the statistics are those of the run.
awk '/"seconds": \{/ {inside = 1} inside && /"(load|voxelize|place|index|image)"/ {gsub(/[",:]/, ""); s[$1] = $2; n += $2}
     inside && /\}/ {printf "voxelization: %.2f of a frame without overlap (place %.2f, index %.2f, image %.2f)\n",
                     s["voxelize"] / n, s["place"] / n, s["index"] / n, s["image"] / n; exit}' "$work/in_turn.json"
