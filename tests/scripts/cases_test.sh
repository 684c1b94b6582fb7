#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks tests/CASES.md: all 94 stress cases are in it, and every test that it names exists. So does
# every test that slow_tests.txt names.
# Usage: cases_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1/tests"
failed=0

expected=$(for group in V:17 S:9 T:22 P:12 G:9 O:12 X:6 D:7; do
    seq -f "${group%:*}%.0f" 1 "${group#*:}"
done)
listed=$(sed -nE 's/^- \*\*([VSTPGOXD][0-9]+)\*\* .*/\1/p' CASES.md)
diff <(echo "$expected") <(echo "$listed") || { echo "CASES.md lists other cases"; failed=1; }

# names_of MACRO: all `Suite.Name`, from MACRO(Suite, Name), however the line is broken.
sources=$(find . -name '*_test.cpp' -exec cat {} + | tr '\n' ' ')
names_of() {
    grep -oE "\\b$1\\([[:space:]]*[A-Za-z0-9_]+,[[:space:]]*[A-Za-z0-9_]+[,)]" <<<"$sources" |
        sed -E 's/.*\([[:space:]]*([A-Za-z0-9_]+),[[:space:]]*([A-Za-z0-9_]+)[,)]/\1.\2/' | sort -u
}
existing=$(names_of 'TEST(_[FP])?')
while read -r name; do
    grep -qxF "$name" <<<"$existing" || { echo "CASES.md names $name, which is no test"; failed=1; }
done < <(grep -oE '`[A-Z][A-Za-z0-9]*\.[A-Z][A-Za-z0-9_]*`' CASES.md | tr -d '`' | sort -u)

# What slow_tests.txt leaves out, `Suite.Name` or `Prefix/Suite.Name/2`, and what stays instead.
rules=$(sed '/^#/d' slow_tests.txt)
while read -r name; do
    case $name in
        *.'*') grep -qF "${name%'*'}" <<<"$existing" ;;
        *) grep -qxF "$name" <<<"$existing" ;;
    esac || { echo "slow_tests.txt names $name, which is no test"; failed=1; }
done < <(grep -oE '[A-Z][A-Za-z0-9]*\.([A-Z][A-Za-z0-9_]*|\*)' <<<"$rules" | sort -u)

# A test without parameters has no slash in its name, one with parameters has the name of their list
# before it, and one of them behind.
plain=$(names_of 'TEST(_F)?')
lists=$(names_of INSTANTIATE_TEST_SUITE_P)
left=$(sed 's/ *|.*//' <<<"$rules")
while read -r pattern; do
    suite=${pattern#*/}
    suite=${suite%%.*}
    case $pattern in
        '*'/*/*) ;;
        */*/* | */*.'*') grep -qxF "${pattern%%/*}.$suite" <<<"$lists" ;;
        *) grep -qxF "$pattern" <<<"$plain" ;;
    esac || { echo "slow_tests.txt: \"$pattern\" matches no test: is it LIST/SUITE.NAME/*?"; failed=1; }
done <<<"$left"
whole=$(sed -nE '/^[^\/]+$/p; s#^[^/]+/([^/]+)(/\*)?$#\1#p' <<<"$left") # left out with all parameters

# What stays are whole names with commas between them, and perhaps a remark in brackets. No pattern
# may leave them out.
stays=$(sed -E 's/.*\| *//; s/ \([^()]*\)$//' <<<"$rules")
name='([A-Z][A-Za-z0-9]*/)?[A-Z][A-Za-z0-9]*\.([A-Z][A-Za-z0-9_]*|\*)(/[A-Za-z0-9_]+)?'
while read -r line; do
    echo "slow_tests.txt: \"$line\" isn't a list of tests, as in Suite.Test, List/Suite.Test/2"
    failed=1
done < <(grep -vxE "$name(, $name)*" <<<"$stays")
named=$(sed 's/, /\n/g' <<<"$stays" | sort -u)
while read -r name; do
    suite=${name#*/}
    grep -qxF "${name%%/*}.${suite%%.*}" <<<"$lists" ||
        { echo "slow_tests.txt has $name stay, which is in no list of parameters"; failed=1; }
done < <(grep / <<<"$named")
while read -r name; do
    echo "slow_tests.txt has $name stay, and leaves it out"
    failed=1
done < <(grep -xf <(sed 's/[.]/\\&/g; s/\*/.*/g' <<<"$whole"$'\n'"$left") <<<"$named")

# Each case keeps a test in the default run.
while read -r case names; do
    tr ' ' '\n' <<<"$names" | grep -qvxFf <(sed 's/^/`/; s/$/`/' <<<"$whole") ||
        { echo "CASES.md: all tests of $case are slow"; failed=1; }
done < <(awk '/^- \*\*[VSTPGOXD][0-9]+\*\*/ { case_name = $2 }
    case_name { while (match($0, /`[A-Z][A-Za-z0-9]*\.[A-Z][A-Za-z0-9_]*`/)) {
        tests[case_name] = tests[case_name] " " substr($0, RSTART, RLENGTH)
        $0 = substr($0, RSTART + RLENGTH) } }
    END { for (name in tests) print name tests[name] }' CASES.md)
exit "$failed"
