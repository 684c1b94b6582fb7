#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run_fuzzer.sh FOLDER SECONDS FUZZER: one fuzzer of the folder, and a line on what it did or, if it
# found a fault, its output.
set -euo pipefail
cd "$1"
format=${3#*_fuzz_}
mkdir -p "corpus/$format" "seeds/$format"
options=(-seed="${VXL_FUZZ_SEED:-25}" -max_total_time="$2" -timeout=60 -print_final_stats=1
    -malloc_limit_mb=640 -rss_limit_mb=2048)
[ ! -f "seeds/$format.dict" ] || options+=(-dict="seeds/$format.dict")
# Freed memory is kept back for 8 MB, not 256, and stays with the process: up to 1.5 times as many
# runs a second.
export ASAN_OPTIONS=quarantine_size_mb=8:allocator_release_to_os_interval_ms=-1:malloc_context_size=2
if ! "./$3" "${options[@]}" -artifact_prefix="$format-" "corpus/$format" "seeds/$format" \
    >"$format.log" 2>&1; then
    tail -n 60 "$format.log"
    echo "$3: FAULT" >&2
    exit 1
fi
echo "$3: $(sed -n 's/stat::number_of_executed_units: *//p' "$format.log") runs"
