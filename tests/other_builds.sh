#!/usr/bin/env bash
# The same bits from other compilers, and at other levels of optimisation: builds the library with its tests that need no
# program, and holds it to the golden hashes. Exit code 77 where the compiler is missing.
#
#   tests/other_builds.sh gcc-O1|gcc-O2|gcc-O3|clang-O1|clang-O2|clang-O3
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

name=${1:?which build: gcc-O1, gcc-O2, gcc-O3, clang-O1, clang-O2 or clang-O3}
case $name in
    gcc-O[123]) compiler=g++ ;;
    clang-O[123]) compiler=clang++ ;;
    *)
        echo "no build is named '$name'" >&2
        exit 2
        ;;
esac
command -v "$compiler" >/dev/null || { echo "skipped: $name: $compiler is not installed"; exit 77; }
cmake -S . -B "build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS_RELEASE="-${name#*-} -DNDEBUG" -DPLIANT_BUILD_TOOL=OFF
cmake --build "build/$name" --target pliant_tests
"build/$name/bin/pliant_tests" golden_test
