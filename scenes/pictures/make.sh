#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of this folder again.
set -euo pipefail
cd "$(dirname "$0")/.."
export VOXELUME_ASSETS=/usr/share/glmark2/models
voxelume render voxels.json -o pictures/voxels.png
voxelume render bunny.json cubes.json --size 960x720 --samples 16 -o 'pictures/{name}.png'
for s in whitted glass_bunny prism fog stained_glass lamp solids turntable; do
    voxelume render $s.json --size 640x480 --samples 16 -o pictures/$s.png
done
volume=$(mktemp --suffix=.vdb)
voxelume render turntable.json --volume "$volume"
voxelume view "$volume" --size 1280x960 -o pictures/turntable_volume.png
voxelume render cornell.json daylight.json -o 'pictures/{name}.png'
voxelume render still_life.json --view-transform filmic -o pictures/still_life.png
voxelume render lighthouse.vox --size 640x480 --samples 16 -o pictures/lighthouse.png
for s in melt:1,24,48 pendulum:1,12,24 drill:20 procession:40; do
    voxelume render ${s%:*}.json --size 640x480 --samples 16 --frames ${s#*:} \
        -o pictures/${s%:*}.####.png
done
m=/usr/share/assimp/models
pictures/contact_sheet.py pictures/model_files.png $m/{glTF2,glTF2/*}/*/*.gl* $m/OBJ/*.obj $m/PLY/*
optipng -o5 pictures/*.png
