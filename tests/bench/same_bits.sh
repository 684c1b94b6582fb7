#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compares one hash per scene over compilers and devices' settings: same_bits.sh [BUILD-FOLDER
# [BUILD ...]]
#
# A BUILD is g++-Release, g++-Debug, clang++-Release or clang++-Debug; by default all four run.
# SCENES="solids fog" in the environment restricts the scenes, JOBS=1 compiles one file at a time,
# and COMPILERS_ONLY=1 leaves out lanes, work-groups, threads, units and the OpenCL compiler's
# options. CMake's environment variable CMAKE_CXX_COMPILER_LAUNCHER=ccache shortens the second run.
#
# Builds the program with g++ and clang++, as Debug and Release, and renders every scene of scenes/
# small with lanes {1,4,8,16}, work-groups {own,1,24}, threads {own,1,2}, one compute unit, and with
# the OpenCL compiler's optimizer off. Prints a line for each scene and setting that differs from
# the first, and the number of images; exits with 1 if any differs. The first run compiles for an
# hour on two cores, and all settings take half an hour more.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
work=${1:-$source/build/same-bits}
[ $# -gt 0 ] && shift
builds=${*:-g++-Release g++-Debug clang++-Release clang++-Debug}
scenes=${SCENES:-$(find "$source/scenes" -name '*.json' ! -name '*.schema.json' -exec basename {} .json \;)}
mkdir -p "$work"
images=0
differing=0

# check PROGRAM SETTING...: renders all scenes under these settings of the environment.
check() {
    program=$1
    shift
    for name in $scenes; do
        env "$@" "$program" render "$source/scenes/$name.json" --assets /usr/share/glmark2/models --size 48x36 --float --no-cache -q \
            --frames 1 -o "$work/image.####.exr"
        hash=$(sha256sum <"$work/image.0001.exr")
        [ -f "$work/$name.hash" ] || echo "$hash" >"$work/$name.hash"
        images=$((images + 1))
        if [ "$hash" != "$(cat "$work/$name.hash")" ]; then
            differing=$((differing + 1))
            echo "$name differs: $program with $*"
        fi
    done
}

rm -f "$work"/*.hash
for build in $builds; do
    compiler=${build%-*}
    folder=$work/$build
    command -v "$compiler" >/dev/null || { echo "no $compiler: left out"; continue; }
    cmake -G Ninja -S "$source" -B "$folder" -DCMAKE_BUILD_TYPE="${build#*-}" \
        -DCMAKE_CXX_COMPILER="$compiler" -DBUILD_TESTING=OFF >/dev/null
    nice ninja -j "${JOBS:-2}" -C "$folder" voxelume >"$folder/build.log" || { tail -40 "$folder/build.log"; exit 1; }
    program=$folder/voxelume
    check "$program" VOXELUME_DEVICE=cpu
    echo "$build: $images images so far, $differing differ"
    # The settings of the device don't depend on the C++ compiler, so only the first build tries
    # them.
    [ "$build" = "${builds%% *}" ] && [ "${COMPILERS_ONLY:-0}" = 0 ] || continue
    for lanes in 1 4 8 16; do
        check "$program" VOXELUME_LANES=$lanes
        check "$program" VOXELUME_LANES=$lanes POCL_MAX_PTHREAD_COUNT=1
        check "$program" VOXELUME_LANES=$lanes POCL_MAX_PTHREAD_COUNT=2
        check "$program" VOXELUME_LANES=$lanes VOXELUME_WORK_GROUP=1
        check "$program" VOXELUME_LANES=$lanes VOXELUME_WORK_GROUP=24
        check "$program" VOXELUME_LANES=$lanes VOXELUME_UNITS=1
        check "$program" VOXELUME_LANES=$lanes VOXELUME_BUILD_OPTIONS=-cl-opt-disable
    done
done
echo "$images images, $differing differ"
[ "$differing" = 0 ]
