#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# model_files_test.sh PROGRAM: renders every model file of Debian's assimp-testmodels, and of the
# folders in VXL_MODEL_FOLDERS (parted by colons), without a scene. Each is seen, or refused by one
# sentence for the reason that the list below gives. Exits with 77 where there are no such files.
set -uo pipefail
program=$1
assimp=/usr/share/assimp/models

# What is refused, and why: damaged files, glTF 1, and what is none of a mesh.
refused='
OBJ/number_formats.obj              is not a finite number
PLY/issue623.ply                    the line ends before the last value
PLY/pond.0.ply                      the file is damaged or incomplete
glTF/*                              version
glTF2/BoxTextured-glTF-techniqueWebGL/* KHR_technique_webgl
glTF2/BoxWithInfinites-glTF-Binary/*    a vertex isn.t finite
glTF2/IndexOutOfRange/*             names vertex
glTF2/MissingBin/*                  there is no file
glTF2/RecursiveNodes/*              is a child of two nodes
glTF2/SchemaFailures/*              there is no file
glTF2/TestNoRootNode/NoScene.gltf   the file has 0 of these
glTF2/TestNoRootNode/SceneWithoutNodes.gltf     has no triangles, points or lines
glTF2/wrongTypes/badArray.gltf      should be
glTF2/wrongTypes/badExtension.gltf  should be
glTF2/wrongTypes/badUint.gltf       should be
invalid/*                           the file is empty|names vertex|without numbers
'

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export VOXELUME_CACHE_DIR=${VOXELUME_CACHE_DIR:-$work/cache}

# reason_of FILE: why it is to be refused; nothing where it isn't.
reason_of() {
    local pattern reason
    while read -r pattern reason; do
        # shellcheck disable=SC2053 # it is a pattern
        [ -n "$pattern" ] && [[ ${1#"$assimp/"} == $pattern ]] && echo "$reason"
    done <<<"$refused"
}

shown=0
failed=0
fail() {
    echo "$1: $2"
    failed=$((failed + 1))
}
IFS=: read -ra folders <<<"$assimp${VXL_MODEL_FOLDERS:+:$VXL_MODEL_FOLDERS}"
while read -r file; do
    reason=$(reason_of "$file")
    rm -f "$work/picture.png"
    timeout 600 "$program" render "$file" --size 64x48 --samples 1 -o "$work/picture.png" \
        >"$work/said" 2>&1
    code=$?
    last=$(tail -1 "$work/said")
    if [ -n "$reason" ]; then
        [ "$code" -eq 4 ] && grep -Eq "$reason" <<<"$last" || fail "$file" "exit $code: $last"
        [ ! -e "$work/picture.png" ] || fail "$file" "was refused, and left a picture"
    elif [ "$code" -ne 0 ] || [ ! -s "$work/picture.png" ]; then
        fail "$file" "exit $code: $last"
    elif grep -q 'no sight ray meets an object' "$work/said"; then
        fail "$file" "nothing is in view"
    else
        shown=$((shown + 1))
    fi
done < <(find -L "${folders[@]}" -type f -regextype posix-extended \
    -iregex '.*\.(vox|obj|ply|stl|gltf|glb|vdb|nrrd|nhdr|nii|nii\.gz|npy|vxm|qb|kv6|binvox|gox|schem)' \
    2>"$work/missing" | sort)
echo "$shown files are shown, $failed are wrong"
[ $((shown + failed)) -gt 0 ] || exit 77
[ "$failed" -eq 0 ]
