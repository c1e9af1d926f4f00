#!/usr/bin/env bash
# The same bits from other compilers, at other levels of optimisation, and on another machine: builds the library with
# its tests that need no program, and runs them. Exit code 77 where the compiler or the emulator is missing.
#
#   tests/other_builds.sh aarch64                 64-bit ARM, under qemu-user: laws, passes, golden scenes
#   tests/other_builds.sh gcc-O1|clang-O3|...     golden scenes
#
# PLIANT_BUILD_JOBS limits how many files are compiled at once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

name=${1:?which build: aarch64, gcc-O1, gcc-O2, gcc-O3, clang-O1, clang-O2 or clang-O3}
jobs=${PLIANT_BUILD_JOBS:-$(nproc)}

need() {
    command -v "$1" >/dev/null || { echo "$1 is missing: install the Debian package $2"; exit 77; }
}

case $name in
    aarch64)
        need aarch64-linux-gnu-g++ g++-aarch64-linux-gnu
        need qemu-aarch64 qemu-user
        cmake --preset aarch64
        cmake --build --preset aarch64 -j "$jobs"
        ctest --test-dir build/aarch64 --output-on-failure --no-tests=error -j "$jobs"
        ;;
    gcc-O[123] | clang-O[123])
        declare -A compilers=([gcc]=g++ [clang]=clang++)
        compiler=${compilers[${name%-*}]}
        need "$compiler" "${compiler/clang++/clang}"
        cmake -S . -B "build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
            -DPLIANT_OPTIMISE="-${name#*-}" -DPLIANT_BUILD_TOOL=OFF
        cmake --build "build/$name" -j "$jobs" --target golden_test
        "build/$name/bin/golden_test"
        ;;
    *)
        echo "no build is named '$name'" >&2
        exit 2
        ;;
esac
