#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Kills an animation at random moments with SIGKILL and goes on by --resume. Each time the files must
# be those of an undisturbed run, no file that was finished may be written again, and nothing else
# may stay in the folder. Takes minutes, so it is run by hand.
# Usage: killed_resume.sh PROGRAM [MOMENTS] [FRAMES] [SEED]
set -euo pipefail
program=$(realpath "$1")
moments=${2:-50}
frames=${3:-200}
RANDOM=${4:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >scene.json <<END
{"voxelume": 1,
 "world": {"voxel_size": 0.1, "bounds": {"min": [0, 0, 0], "max": [3, 2, 1]},
           "ambient": [0.3, 0.3, 0.3]},
 "models": {"thing": {"shape": "box", "size": [1.2, 0.8, 0.4], "surface": "cubes"}},
 "objects": [{"name": "thing", "model": "thing", "position": [1.5, 1, 0.5]}],
 "lights": [{"type": "directional", "direction": [0.2, -0.5, -1]}],
 "observer": {"position": [1.5, 1, 4], "look_at": [1.5, 1, 0.5],
              "display": {"shape": "pyramid", "angles": [45, 34]}},
 "render": {"size": [64, 48]},
 "animation": {"frames": $frames, "tracks": [{"target": "objects.thing.turn",
     "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": $frames, "value": [90, 200, 40]}]}]}}
END
render() {
    "$program" render scene.json -q -o "$1/f.####.exr" -o "$1/f.####.png" "${@:2}"
}
# Names, inodes and times of all files of a folder.
listed() {
    find "$1" -name 'f.*' -printf '%f %i %T@\n' | sort
}

mkdir whole
render whole
start=$(date +%s%N)
render whole
milliseconds=$((($(date +%s%N) - start) / 1000000))
echo "an undisturbed run of $frames frames takes $milliseconds ms"
kept=0
for ((moment = 1; moment <= moments; moment++)); do
    rm -rf killed
    mkdir killed
    wait=$((RANDOM * milliseconds / 32768))
    "$program" render scene.json -q -o killed/f.####.exr -o killed/f.####.png &
    sleep "$(printf '%d.%03d' $((wait / 1000)) $((wait % 1000)))"
    kill -KILL $! 2>/dev/null || true
    wait $! 2>/dev/null || true
    listed killed >before
    render killed --resume
    diff -r whole killed || { echo "moment $moment, $wait ms: other files"; exit 1; }
    listed killed | comm -13 - before >again
    [ ! -s again ] || { echo "moment $moment, $wait ms: written again"; cat again; exit 1; }
    kept=$((kept + $(wc -l <before)))
done
echo "$moments moments: the same files; of $((2 * frames * moments)), $kept were finished and stayed"
