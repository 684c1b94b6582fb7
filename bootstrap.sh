#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 to a picture (./bootstrap.sh demo) or to tested code (./bootstrap.sh test).
set -euo pipefail
cd "$(dirname "$0")"

preset=release
build=${VXL_BUILD:-build/$preset}

usage() {
    cat <<'TEXT'
Usage: ./bootstrap.sh COMMAND

  demo    render scenes/bunny.json to out/bunny.exr and out/bunny.png
  test    run the tests; with --slow, those too that take long, which takes twice as long;
          with --all, every combination of settings too, which takes hours
  build   build the program, build/release/voxelume
  fuzz    feed damaged files to each reader for 60 seconds, or for as many as follow: fuzz 300
  coverage  run the tests with clang's counters and tell which share of the lines ran; half an hour
  sanitize  run the tests with clang's sanitizers of addresses and undefined behaviour, or of threads:
          sanitize thread; hours
  trust   kill the program, break its disk, damage its files and tire it, for hours or for a share of
          them: trust 0.01
  drivers hold what Intel's OpenCL driver for CPUs computes against the golden bits; half an hour
  watch   hold what compilers for GPUs of NVIDIA, AMD and Intel make of kernels against limits
  farm    try the recipes of scenes/farm with the real Slurm, GNU parallel and OpenJD
  readers open what is written with the programs that people open it with, and their files here;
          with --blender in Blender too, which pip brings in 400 MB
  lint    check the format of the code, the host code and each kernel
  python  build the Python package, build/python/wheels, and test it in a fresh environment
  package make build/package/voxelume_*.deb and check it; with --install, also install, use and
          purge it in a bare Debian, and make what the container holds, which takes minutes and root
  docs    write the library's reference to build/docs/html/index.html
  packages  install what all of these but drivers, watch, farm and readers need

Each installs the Debian packages that are missing (as root, or with sudo) and builds first.
TEXT
}

say() { printf '\n== %s\n' "$*"; }

# missing_packages FILE...: those named in the files that aren't installed.
missing_packages() {
    comm -23 <(sed 's/#.*//' "$@" | tr -s ' \n' '\n' | sed '/^$/d' | sort -u) \
        <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null |
            sed -n 's/^installed //p' | sort -u)
}

# install_packages FILE...: every package named in the files, when one is missing. One bootstrap.sh
# at a time installs: apt doesn't wait for another.
install_packages() {
    [ -n "$(missing_packages "$@")" ] || return 0
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "bootstrap.sh: these packages are missing; install them as root:" \
                $(missing_packages "$@") >&2
            exit 1
        fi
        root=(sudo)
    fi
    {
        flock 9
        local missing
        missing=$(missing_packages "$@")
        [ -n "$missing" ] || return 0
        say "Installing" $missing
        # Without the lock, which services that are started would keep.
        "${root[@]}" apt-get update -q 9<&-
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends $missing 9<&-
    } 9<bootstrap.sh
}

# Configures once; afterwards ninja itself notices changed CMake files and new sources.
configure() {
    [ -f "$build/build.ninja" ] && return
    say "Configuring $build"
    # Several files at a time: what they include is read once.
    cmake --preset "$preset" -DVXL_WERROR="${VXL_WERROR:-OFF}" -DCMAKE_UNITY_BUILD=ON \
        -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DVXL_FIRST_BUILD="${VXL_FIRST_BUILD:-OFF}"
}

build_targets() {
    configure
    ninja -C "$build" "$@"
}

demo() {
    build_targets voxelume
    mkdir -p out
    "$build/voxelume" render scenes/bunny.json --assets /usr/share/glmark2/models \
        -o out/bunny.exr -o out/bunny.png
    echo "The pictures are out/bunny.exr and out/bunny.png."
}

# run_tests [--slow | --all]: see tests/README.md for what they add.
run_tests() {
    local configuration=()
    case "${1:-}" in
        --slow) configuration=(-C slow) ;;
        --all)
            configuration=(-C exhaustive)
            export VXL_TEST_ALL=1
            ;;
    esac
    build_targets
    say "Testing"
    ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "${configuration[@]}"
}

# clang_build NAME OPTION...: build/NAME, configured for clang.
clang_build() {
    [ -f "build/$1/build.ninja" ] || CC=clang-14 CXX=clang++-14 cmake --preset release \
        -B "build/$1" -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 "${@:2}"
}

# run_fuzzers SECONDS: each reader with clang's sanitizers, from small valid files, as many at a time
# as there are cores. What breaks one is left in build/fuzz.
run_fuzzers() {
    build_targets voxelume voxelume_api voxelume_verify
    grep -qs voxelume_fuzzers build/fuzz/CMakeCache.txt || rm -rf build/fuzz # of another project
    CC=clang-14 CXX=clang++-14 cmake -G Ninja -S tests/fuzz -B build/fuzz -DVXL_BUILD="$build"
    ninja -C build/fuzz
    tests/fuzz/make_seeds.py build/fuzz/seeds "$build/voxelume"
    say "Fuzzing for $1 s each"
    find build/fuzz -maxdepth 1 -name '*_fuzz_*' -printf '%f\n' | sort |
        xargs -r -P "$(nproc)" -n 1 tests/fuzz/run_fuzzer.sh build/fuzz "$1"
}

# Compiled by clang, whose counters outlive processes that are killed.
coverage() {
    clang_build coverage -DVXL_COVERAGE=ON -DCMAKE_CXX_FLAGS_RELEASE=-O1
    ninja -C build/coverage
    .ci/coverage build/coverage
}

# sanitize address | thread: -O1 and the lines alone, so that building takes minutes.
sanitize() {
    clang_build "sanitize-$1" -DVXL_SANITIZE="$1" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" \
        -DVXL_FIRST_BUILD=ON
    ninja -C "build/sanitize-$1"
    .ci/sanitize "build/sanitize-$1" "$1"
}

# The version that CMakeLists.txt gives the project.
project_version() {
    sed -n 's/^project(voxelume VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt
}

# Fails on a warning: on a name without a description, or a description without its name.
docs() {
    mkdir -p build/docs
    VXL_VERSION=$(project_version) doxygen runtime/Doxyfile
    echo "The reference is build/docs/html/index.html."
}

# pip_environment NAME PACKAGE...: build/NAME, a virtual environment with packages of pip, whose
# programs are found before all others.
pip_environment() {
    local environment=$PWD/build/$1
    shift
    [ -x "$environment/bin/pip" ] || python3 -m venv "$environment"
    "$environment/bin/pip" install -q "$@"
    PATH=$environment/bin:$PATH
}

# run_each_test NAME OPTION...: tests of ctest that skip themselves where a program is missing, which
# is a fault here. NAME.log is theirs alone, since CI runs two of these at a time.
run_each_test() {
    local log=$build/$1.log
    shift
    ctest --test-dir "$build" --output-on-failure "$@" | tee "$log"
    if grep -q 'Skipped' "$log"; then
        echo "bootstrap.sh: a test was skipped" >&2
        return 1
    fi
}

# Debian's compiler for Intel's GPUs, without making it a driver of this machine.
unpack_intel_compiler() {
    local folder=$PWD/build/watch/intel package
    [ -x "$folder/usr/bin/ocloc" ] && return
    mkdir -p "$folder/packages"
    (cd "$folder/packages" && apt-get -q -o APT::Sandbox::User=root download intel-opencl-icd \
        libigc1 libigdfcl1 libigdgmm12 libllvmspirvlib14 libopencl-clang14)
    for package in "$folder"/packages/*.deb; do dpkg -x "$package" "$folder"; done
}

farm() {
    build_targets voxelume
    pip_environment farm openjd-cli
    run_each_test farm -C farm -R '^farm\.'
}

# readers [--blender]
readers() {
    build_targets voxelume
    pip_environment readers numpy OpenEXR trimesh pygltflib nibabel pynrrd midvoxio pillow matplotlib \
        ${1:+bpy}
    run_each_test readers -V -R '\.readers$'
}

# What `cmake --install` installs.
installed='voxelume voxelume_shared voxelume_vdb voxelume_vdb_reader voxelume_mesh_decoder'
installed+=' voxelume_image_decoder voxelume_kernel_compiler'

# The wheel holds the library as it is installed; tests see the wheel alone. Both come from pip, as
# does what builds them.
python_package() {
    build_targets $installed
    local folder=$PWD/build/python
    say "Building the wheel"
    rm -rf "$folder/library" "$folder/wheels"
    cmake --install "$build" --prefix "$folder/library" >/dev/null
    python3 -m venv "$folder/fresh" --clear
    "$folder/fresh/bin/pip" wheel -q --no-deps -w "$folder/wheels" ./python \
        -C build-dir="$folder/module" -C cmake.define.CMAKE_UNITY_BUILD=ON \
        -C cmake.define.voxelume_DIR="$folder/library/lib/cmake/voxelume"
    "$folder/fresh/bin/pip" install -q "$(echo "$folder"/wheels/*.whl)[test]"
    say "Testing the wheel"
    # From a folder without sources, so that what is tested is what was installed.
    cd "$folder"
    fresh/bin/python -m mypy.stubtest voxelume --allowlist ../../python/tests/stubs_allowed.txt
    fresh/bin/python -m mypy --strict -p voxelume
    fresh/bin/python -m pytest -q -p no:cacheprovider ../../python/tests
    echo "The wheel is $(echo "$folder"/wheels/*.whl)."
}

# debian_package [--install]. Its files have the date of the last commit.
debian_package() {
    local folder=$PWD/build/package
    build_targets $installed
    SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
    export SOURCE_DATE_EPOCH
    cmake "$build" >/dev/null # the changelog has the date, too
    say "Packing"
    rm -rf "$folder"
    cpack --config "$build/CPackConfig.cmake" -G DEB -B "$folder" >"$build/package.log" 2>&1 ||
        { cat "$build/package.log"; return 1; }
    lintian --fail-on error --allow-root "$folder"/*.deb
    if [ "${1:-}" = --install ]; then
        tests/scripts/package_test.sh "$folder"/*.deb . build/package-root
        tests/scripts/dockerfile_test.sh . build/package-root "$folder"/*.deb
    fi
    echo "The package is $(echo "$folder"/*.deb)."
}

case "$*" in
    demo | build | test | 'test --slow' | 'test --all' | lint) install_packages packages.txt ;;
    fuzz | 'fuzz '[1-9]* | coverage | sanitize | 'sanitize address' | 'sanitize thread')
        install_packages packages.txt .ci/packages.txt
        ;;
    trust | 'trust '[0-9]*) install_packages packages.txt ;;
    drivers) install_packages packages.txt .ci/driver_packages.txt ;;
    watch | 'watch --accept') install_packages packages.txt .ci/watch_packages.txt ;;
    farm) install_packages packages.txt .ci/farm_packages.txt ;;
    readers | 'readers --blender') install_packages packages.txt .ci/readers_packages.txt ;;
    docs) install_packages .ci/docs_packages.txt ;;
    packages)
        install_packages packages.txt .ci/packages.txt .ci/{docs,package,python}_packages.txt
        ;;
    python) install_packages packages.txt .ci/python_packages.txt ;;
    package | 'package --install') install_packages packages.txt .ci/package_packages.txt ;;
    help | -h | --help)
        usage
        exit 0
        ;;
    *)
        usage >&2
        exit 2
        ;;
esac

case "$1" in
    demo) demo ;;
    build)
        build_targets voxelume
        echo "The program is $build/voxelume."
        ;;
    test) run_tests "${2:-}" ;;
    fuzz) run_fuzzers "${2:-60}" ;;
    coverage) coverage ;;
    sanitize) sanitize "${2:-address}" ;;
    trust)
        build_targets voxelume write_faults
        tests/trust/all.py "$build/voxelume" "$build/tests/libwrite_faults.so" "${2:-1}"
        ;;
    drivers)
        build_targets voxelume pictures_tests kernels_tests
        .ci/drivers "$build"
        ;;
    watch)
        build_targets voxelume stand_in_gpu
        unpack_intel_compiler
        pip_environment watch nvidia-cuda-nvcc-cu12==12.9.86
        .ci/watch "$build" "${@:2}"
        ;;
    farm) farm ;;
    readers) readers "${2:-}" ;;
    docs) docs ;;
    packages) ;; # they are there
    python) python_package ;;
    package) debian_package "${2:-}" ;;
    lint)
        install_packages .ci/packages.txt
        build_targets voxelume # the generated sources and compile_commands.json
        pip_environment lint clang-tidy==23.1.4
        .ci/lint "$build"
        ;;
esac
