#!/usr/bin/env bash
# The golden hashes from another compiler or level of optimisation: builds the library with the tests that need no program,
# and runs those of the hashes.
#
#   tests/other_builds.sh gcc-O1|gcc-O2|gcc-O3|clang-O1|clang-O2|clang-O3 ...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for name in "${@:?which build: gcc-O1, gcc-O2, gcc-O3, clang-O1, clang-O2 or clang-O3}"; do
    case $name in
        gcc-O[123]) compiler=g++ ;;
        clang-O[123]) compiler=clang++ ;;
        *) echo "no build is named '$name'" >&2; exit 2 ;;
    esac
    command -v "$compiler" >/dev/null || { echo "$compiler is missing: ./dev setup all installs it" >&2; exit 1; }
    cmake -S . -B "build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
        -DPLIANT_OPTIMISE="-${name#*-}" -DPLIANT_BUILD_TOOL=OFF -DPLIANT_BUILD_TESTS=ON
    cmake --build "build/$name" --target pliant_tests
    "build/$name/bin/pliant_tests" golden_test
done
