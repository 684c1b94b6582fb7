#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests whether memory grows over an animation: memory.sh [PROGRAM] [FRAMES]
#
# Renders frames that go to and fro every 50. Each differs from the one before in its model, in the
# place of an object in the world's voxels, and in that of an instance. Prints the process's memory
# in kB at every tenth of the run. Exits with 1 if the last value is more than 5 % above that at two
# tenths.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
program=${1:-$source/build/voxelume}
frames=${2:-500}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# keys A B: prints the keys of a track that goes from A to B and back.
keys() {
    awk -v a="$1" -v b="$2" -v last="$frames" 'BEGIN {
        for (frame = 1; frame < last + 50; frame += 50)
            printf "%s{\"frame\": %d, \"value\": %s}", frame == 1 ? "" : ", ", frame, frame % 100 == 1 ? a : b}'
}

cat >"$work/scene.json" <<SCENE
{"voxelume": 1,
 "world": {"voxel_size": 0.02, "bounds": {"min": [-1.4, -1.1, -1.2], "max": [1.4, 1.1, 1.2]}},
 "models": {"bunny": {"mesh": "bunny.obj", "morph": {"center": [0.05, -0.25, 0], "radius": 0.6}},
            "ball": {"shape": "sphere", "radius": 0.2}},
 "objects": [{"name": "bunny", "model": "bunny", "placement": "world"},
             {"name": "baked", "model": "ball", "placement": "world", "position": [0.8, 0, 0.5]},
             {"name": "instance", "model": "ball", "position": [-0.8, 0, 0.5]}],
 "lights": [{"type": "point", "position": [-2, 4, 3], "intensity": 30}],
 "observer": {"position": [-1, 0.7, 4], "look_at": [0, 0, 0],
              "display": {"shape": "pyramid", "angle": 40, "near": 0.5, "far": 8, "voxels": [8, 6, 8]}},
 "animation": {"frames": $frames, "tracks": [
   {"target": "models.bunny.morph.amount", "keys": [$(keys 0 1)]},
   {"target": "objects.baked.position[1]", "keys": [$(keys -0.8 0.8)]},
   {"target": "objects.instance.position[1]", "keys": [$(keys 0.8 -0.8)]}]},
 "render": {"size": [320, 240]}}
SCENE
"$program" render "$work/scene.json" --assets /usr/share/glmark2/models --no-cache \
    -o "$work/frame.####.exr" 2>"$work/log" &
process=$!
early=0
tenth=1
memory=0
while kill -0 $process 2>/dev/null; do
    now=$(awk '/VmRSS/ {print $2}' /proc/$process/status 2>/dev/null || true)
    [ -n "$now" ] && memory=$now
    if [ "$(grep -c '^frame' "$work/log")" -ge $((frames * tenth / 10)) ]; then
        echo "frame $((frames * tenth / 10)): $memory kB"
        [ $tenth = 2 ] && early=$memory
        tenth=$((tenth + 1))
    fi
    sleep 0.02
done
wait $process
echo "at the end: $memory kB"
[ "$memory" -le $((early * 105 / 100)) ]
