#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks the documents: no line of more than 100 columns, no relative link that leads nowhere, a
# README of at most 60 lines in each folder of code, and tests for what SECURITY.md promises.
# Usage: documents_test.sh SOURCE_FOLDER
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$1"
failed=0
complain() {
    echo "$*"
    failed=1
}

pages=$(find . -name '*.md' -not -path './build*' -not -path './out/*' -not -path './.*' | sort)
while read -r page; do
    long=$(grep -nE '^.{101}' "$page" | cut -c 1-60) || true
    [ -z "$long" ] || complain "$page has lines over 100 columns: $long"
    # The links are [text](target) without a scheme; a heading after # is cut off.
    while read -r target; do
        [ -e "$(dirname "$page")/${target%%#*}" ] || complain "$page links to $target, which isn't there"
    done < <(sed '/^```/,/^```/d' "$page" | tr '\n' ' ' | grep -oE '\]\([^)# ]+[^) ]*\)' |
        sed -E 's/^\]\((.*)\)$/\1/' | grep -vE '^[a-z]+:' || true)
done <<<"$pages"

# What SECURITY.md promises is tested by files that exist.
while read -r name; do
    [ -n "$(find tests -name "$name.cpp")" ] || complain "SECURITY.md names $name, which is no test"
done < <(grep -oE '`[a-z0-9_]+_test`' SECURITY.md | tr -d '`' | sort -u)

while read -r folder; do
    readme=$folder/README.md
    if [ ! -f "$readme" ]; then
        complain "$folder has no README.md"
    elif [ "$folder" != scenes ] && [ "$(wc -l <"$readme")" -gt 60 ]; then
        complain "$readme is longer than a screen"
    fi
done < <(find cli kernels runtime scenes tests -type f -not -name README.md -printf '%h\n' | sort -u)
exit "$failed"
