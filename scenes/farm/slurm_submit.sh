#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders a run as a Slurm job array, and merges its parts when all of them are done. Prints the
# numbers of both jobs.
# Usage: slurm_submit.sh PARTS SCENE... -o OUTPUT [options of `voxelume render`]
# SBATCH_OPTIONS has further options for the array, such as "--gres=gpu:1 --time=2:00:00".
set -euo pipefail
[ $# -ge 4 ] || { sed -n 's/^# Usage: /usage: /p' "$0" >&2; exit 2; }
here=$(dirname "$(realpath "$0")")
parts=$1
shift
# Parts are named after the first output, or volume.
first=""
for ((i = 1; i < $#; ++i)); do
    case ${!i} in
        -o | --output | --volume)
            next=$((i + 1))
            [ -n "$first" ] || first=${!next} ;;
    esac
done
[ -n "$first" ] || { echo "slurm_submit.sh: give the output as -o OUTPUT" >&2; exit 2; }
# shellcheck disable=SC2086 # several options
array=$(sbatch --parsable --array="1-$parts" ${SBATCH_OPTIONS:-} \
    "$here/slurm_part.sbatch" "$parts" "$@")
merge=$(sbatch --parsable --dependency="afterok:$array" --kill-on-invalid-dep=yes \
    "$here/slurm_merge.sbatch" "$parts" "$first")
echo "$array $merge"
