#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders a run as a Slurm job array, and merges its parts when all of them are done. Prints the
# numbers of both jobs.
# Usage: slurm_submit.sh PARTS SCENE -o OUTPUT [options of `voxelume render`]
# SBATCH_OPTIONS has further options for the array, such as "--gres=gpu:1 --time=2:00:00".
set -euo pipefail
[ $# -ge 4 ] || { sed -n 's/^# Usage: /usage: /p' "$0" >&2; exit 2; }
here=$(dirname "$(realpath "$0")")
parts=$1
shift
[[ $parts =~ ^[1-9][0-9]*$ ]] || { echo "slurm_submit.sh: PARTS is a number from 1 on" >&2; exit 2; }
# Parts are named after the first output, or after the first volume where there is none.
output="" volume=""
for ((i = 1; i < $#; ++i)); do
    next=$((i + 1))
    case ${!i} in
        -o | --output) output=${output:-${!next}} ;;
        --volume) volume=${volume:-${!next}} ;;
    esac
done
first=${output:-$volume}
[ -n "$first" ] || { echo "slurm_submit.sh: give the output as -o OUTPUT" >&2; exit 2; }
case $first in
    *'{'*) echo "slurm_submit.sh: $first: one run has no {} in its output" >&2; exit 2 ;;
esac
# shellcheck disable=SC2086 # several options
array=$(sbatch --parsable --array="1-$parts" ${SBATCH_OPTIONS:-} \
    "$here/slurm_part.sbatch" "$parts" "$@")
merge=$(sbatch --parsable --dependency="afterok:$array" --kill-on-invalid-dep=yes \
    "$here/slurm_merge.sbatch" "$parts" "$first")
echo "$array $merge"
