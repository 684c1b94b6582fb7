#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders a run in parts with GNU parallel, on this machine or on those of PARALLEL_OPTIONS, such as
# "--sshlogin node1,node2 --workdir .", and merges them. A part that fails is begun again twice.
# Usage: parallel.sh PARTS OUTPUT SCENE [options of `voxelume render`]
set -euo pipefail
[ $# -ge 3 ] || { sed -n 's/^# Usage: /usage: /p' "$0" >&2; exit 2; }
parts=$1 output=$2
shift 2
[[ $parts =~ ^[1-9][0-9]*$ ]] || { echo "parallel.sh: PARTS is a number from 1 on" >&2; exit 2; }
case $output in
    *'{'*) echo "parallel.sh: $output: one run has no {} in its output" >&2; exit 2 ;;
esac
# shellcheck disable=SC2086 # several options
seq "$parts" | parallel --quote -I @PART@ --halt soon,fail=1 --retries 3 ${PARALLEL_OPTIONS:-} \
    voxelume render -o "$output" "$@" --shard "@PART@/$parts" --resume --progress plain
voxelume merge "$output".*-of-"$parts".shard
