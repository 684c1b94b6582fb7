#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks tests/CASES.md: all 93 stress cases are in it, and every test that it names exists.
# Usage: cases_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1/tests"
failed=0

expected=$(for group in V:17 S:9 T:22 P:12 G:9 O:12 X:5 D:7; do
    seq -f "${group%:*}%.0f" 1 "${group#*:}"
done)
listed=$(sed -nE 's/^- \*\*([VSTPGOXD][0-9]+)\*\* .*/\1/p' CASES.md)
diff <(echo "$expected") <(echo "$listed") || { echo "CASES.md lists other cases"; failed=1; }

# The names are `Suite.Name`, from TEST(Suite, Name), TEST_F or TEST_P, however the line is broken.
existing=$(find . -name '*_test.cpp' -exec cat {} + | tr '\n' ' ' |
    grep -oE '\bTEST(_[FP])?\([[:space:]]*[A-Za-z0-9_]+,[[:space:]]*[A-Za-z0-9_]+\)' |
    sed -E 's/.*\([[:space:]]*([A-Za-z0-9_]+),[[:space:]]*([A-Za-z0-9_]+)\)/\1.\2/' | sort -u)
while read -r name; do
    grep -qxF "$name" <<<"$existing" || { echo "CASES.md names $name, which is no test"; failed=1; }
done < <(grep -oE '`[A-Z][A-Za-z0-9]*\.[A-Z][A-Za-z0-9_]*`' CASES.md | tr -d '`' | sort -u)
exit "$failed"
