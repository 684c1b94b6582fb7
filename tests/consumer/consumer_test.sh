#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs everything elsewhere, moves it, and builds a program against it that knows nothing of the
# source tree, by CMake and by pkg-config. The program checks what it renders. The library exports
# no name but its own.
# Usage: consumer_test.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1
consumer=$2/tests/consumer
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/staged" >"$folder/log"
mv "$folder/staged" "$folder/installed"
prefix=$folder/installed
library=$(dirname "$(find "$prefix" -name libvoxelume.so)")

fail() {
    echo "$*"
    exit 1
}

# Inner headers and those of OpenCL and JSON aren't installed.
if grep -rnE '#include.*(runtime/|CL/|nlohmann|glm|fmt)' "$prefix/include"; then
    fail "an installed header includes what isn't installed with it"
fi
if nm -D --defined-only "$library/libvoxelume.so" | grep -vE ' A | _Z(N|NK|TI|TS|TV|TIN|TSN|TVN)[A-Z]*8voxelume2v1'; then
    fail "the library exports names that aren't in its header"
fi

# The example at the head of the header is a program.
sed -nE 's#^//     ##p' "$prefix/include/voxelume.hpp" >"$folder/example.cpp"
grep -q 'int main' "$folder/example.cpp" || fail "the header has no example"
c++ -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" "$folder/example.cpp"
# Each header can be included alone.
for header in "$prefix"/include/voxelume.hpp "$prefix"/include/voxelume/*.hpp; do
    echo "#include \"$header\"" |
        c++ -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" -x c++ - ||
        fail "${header##*/} needs what it doesn't include"
done
for clang in clang++-14 clang++; do # which finds faults in headers that GCC overlooks
    command -v "$clang" >/dev/null || continue
    "$clang" -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" \
        "$folder/example.cpp" "$consumer/consumer.cpp"
    break
done

cmake -S "$consumer" -B "$folder/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >"$folder/log" 2>&1 ||
    fail "$(cat "$folder/log")"
cmake --build "$folder/cmake" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
cd "$folder"
"$folder/cmake/consumer" >said 2>&1 || fail "$(cat said)"
[ ! -s said ] || fail "the library prints: $(cat said)"

export PKG_CONFIG_PATH=$library/pkgconfig
# shellcheck disable=SC2046 # options are words
c++ "$consumer/consumer.cpp" -fvisibility=hidden $(pkg-config --cflags --libs voxelume) -Wl,-rpath,"$library" -o with_pkg_config
./with_pkg_config
