#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the program elsewhere and lets it write and read .vdb files there, by the module and the
# reader that were installed with it. Without the reader, reading is refused; without the module,
# both are, before any work, and commands that need no .vdb still work. Commands that make pictures
# start the helper that compiles kernels.
# Usage: install_test.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1
scenes=$2/scenes
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder" >"$folder/log"
cd "$folder"
printf '%s\n' 'v 0 0 0' 'v 3 0 0' 'v 0 2 0' 'v 0 0 1' 'f 1 3 2' 'f 1 2 4' 'f 2 3 4' 'f 3 1 4' >a.obj
failed=0

# expect CODE TEXT ARGUMENT...: expects that the program, given the arguments, exits with the code
# and prints the text.
expect() {
    local code=0 said
    said=$(bin/voxelume "${@:3}" 2>&1) || code=$?
    [ "$code" -eq "$1" ] && [[ $said == *"$2"* ]] && return
    echo "voxelume ${*:3}: exit code $code instead of $1, or not \"$2\": $said"
    failed=1
}

expect 0 '' voxelize a.obj --resolution 16 -o a.vdb -q
expect 0 'OpenVDB volume' info a.vdb
head -c 1000 a.vdb >cut.vdb
expect 4 'cut.vdb: not a readable OpenVDB file' info cut.vdb

reader=$(find . -name voxelume-vdb-reader)
rm "$reader"
expect 4 "voxelume-vdb-reader can't be started: No such file or directory; install voxelume again" info a.vdb
printf '#!/bin/sh\nkill -SEGV $$\n' >"$reader"
chmod +x "$reader"
expect 4 "a.vdb: not a readable OpenVDB file: its reader ended: Segmentation fault, so it is damaged" info a.vdb
compressed=/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf
expect 0 'triangles' info $compressed
rm "$(find . -name voxelume-mesh-decoder)"
expect 4 "its compressed meshes can't be read: voxelume-mesh-decoder can't be started" info $compressed
picture=$scenes/pictures/fog.png
expect 0 'PNG picture' info "$picture"
rm "$(find . -name voxelume-image-decoder)"
expect 4 "can't be read: voxelume-image-decoder can't be started" info "$picture"
rm "$(find . -name libvoxelume_vdb.so)"
gone="the part of voxelume for OpenVDB can't be loaded: libvoxelume_vdb.so:"
expect 4 "a.vdb: can't be read: $gone" info a.vdb
expect 5 "b.vdb: can't be written: $gone" voxelize no.obj -o b.vdb
expect 5 "b.1.vdb: can't be written: $gone" render "$scenes/turntable.json" --frames 1 --volume b.#.vdb
expect 0 '' voxelize a.obj --resolution 16 -o a.vxm -q
expect 0 'voxelized model' info a.vxm

# Another program stands in the helper's place, tells that it was started, and becomes the helper.
compiler=$(find "$PWD" -name voxelume-kernel-compiler)
mv "$compiler" "$compiler.own"
printf '#!/bin/sh\necho >>started\nexec "%s.own" "$@"\n' "$compiler" >"$compiler"
chmod +x "$compiler"

# helpers: how many have told that they were started.
helpers() { cat started 2>/dev/null | wc -l; }

# expect_helpers NUMBER PERMITTED ARGUMENT...: expects that the program, given the arguments, starts
# so many helpers when kernels aren't compiled yet and so many may run. Helpers end with the program,
# on a busy machine before they have told. So what is expected to start some writes an image to
# standard output, which is more than a pipe holds and isn't read before, for at most a minute. A
# helper without work ends after ten seconds, though.
expect_helpers() {
    local image program tries=0
    rm -rf started kernels
    exec {image}< <(VOXELUME_CACHE_DIR=$PWD/kernels VOXELUME_COMPILERS=$2 VOXELUME_SELF_TEST=off \
        VOXELUME_BUILD_OPTIONS=-cl-opt-disable exec bin/voxelume "${@:3}" 2>log)
    program=$!
    until [ "$(helpers)" -ge "$1" ] || ! kill -0 "$program" 2>/dev/null || ((++tries == 1200)); do
        sleep 0.05
    done
    cat <&"$image" >/dev/null
    exec {image}<&-
    wait "$program" || { cat log; failed=1; }
    [ "$(helpers)" -eq "$1" ] && return
    echo "voxelume ${*:3}: $(helpers) helpers instead of $1"
    failed=1
}

small=(--size 128x96 --samples 1 --float -o -.exr)
expect_helpers 1 1 render "$scenes/whitted.json" "${small[@]}"
expect_helpers 2 2 render "$scenes/solids.json" "${small[@]}"
expect_helpers 0 0 render "$scenes/whitted.json" "${small[@]}"
expect_helpers 0 1 check "$scenes/whitted.json" --size 32x24 --samples 1
expect_helpers 0 1 voxelize a.obj --resolution 16 -o c.vxm

for script in share/voxelume/scenes/farm/{parallel.sh,slurm_submit.sh,slurm_part.sbatch,slurm_merge.sbatch}; do
    [ -x "$script" ] && continue
    echo "$script isn't a program"
    failed=1
done
exit "$failed"
