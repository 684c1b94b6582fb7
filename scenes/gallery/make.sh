#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the pictures of this folder again.
set -euo pipefail
cd "$(dirname "$0")/.."
export VOXELUME_ASSETS=/usr/share/glmark2/models
voxelume render daylight.json --size 1280x1280 -o gallery/daylight.png
voxelume render gallery/box.json --view-transform agx --exposure 1.5 -o gallery/box.png
voxelume render gallery/caustics.json --view-transform agx -o gallery/caustics.png
voxelume render stage.json --size 1280x960 --samples 512 -o gallery/stage.png
gallery/city.py city.vox
voxelume render gallery/city.json --assets . --view-transform agx --exposure 2.3 -o gallery/city.png
gallery/nautilus.py nautilus.nrrd
voxelume render nautilus.json --size 1280x960 --samples 8 -o gallery/nautilus.png
optipng -o5 gallery/*.png
