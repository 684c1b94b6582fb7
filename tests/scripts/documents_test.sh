#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks the documents: no line of more than 100 columns, no relative link to a file or heading that
# isn't there, a README of at most 60 lines in each folder, and tests for what SECURITY.md
# promises.
# Usage: documents_test.sh SOURCE_FOLDER
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$1"
failed=0
complain() {
    echo "$*"
    failed=1
}

# anchors_of PAGE: the anchors that GitHub gives the page's headings.
anchors_of() {
    sed '/^```/,/^```/d' "$1" | sed -n 's/^##* *//p' | sed -E 's/\]\([^)]*\)//g' |
        tr '[:upper:]' '[:lower:]' | sed 's/[^[:alnum:] _-]//g; s/ /-/g'
}

pages=$(find . -name '*.md' -not -path './build*' -not -path './out/*' -not -path './.*' | sort)
while read -r page; do
    long=$(grep -nE '^.{101}' "$page" | cut -c 1-60) || true
    [ -z "$long" ] || complain "$page has lines over 100 columns: $long"
    # The links are [text](target) without a scheme; what follows # is a heading of the target.
    while read -r target; do
        file=$(dirname "$page")/${target%%#*}
        [ -n "${target%%#*}" ] || file=$page
        if [ ! -e "$file" ]; then
            complain "$page links to $target, which isn't there"
        elif [[ $target == *.md#* || $target == '#'* ]]; then
            grep -qxF -- "${target#*#}" <<<"$(anchors_of "$file")" ||
                complain "$page links to $target, a heading that isn't there"
        fi
    done < <(sed '/^```/,/^```/d' "$page" | tr '\n' ' ' | grep -oE '\]\([^) ]+\)' |
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
    elif [ "$(wc -l <"$readme")" -gt 60 ]; then
        complain "$readme is longer than a screen"
    fi
done < <(find .ci cli cmake kernels python runtime scenes tests -type f -not -name README.md \
    -not -path '*/__pycache__/*' -printf '%h\n' | sort -u)
exit "$failed"
