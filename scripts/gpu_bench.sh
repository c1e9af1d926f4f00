#!/usr/bin/env bash
# Tests a GPU: speeds against their bars, and the same bits as the CPU. Needs only a Vulkan driver and the built program:
#
#   scripts/gpu_bench.sh [--quick] [PLIANT] [DEVICE] [FOLDER]
#
# --quick: tiny sizes, to compare bits only; always used with a software driver (llvmpipe).
# PLIANT: the program, default build/release/bin/pliant. DEVICE: a number of `pliant info`, default the best.
# FOLDER: for the CSV files, default build/gpu_bench.
# Exit codes: 0 all bars met and all bits equal, 1 otherwise, 2 it could not run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
quick=()
if [ "${1:-}" = --quick ]; then
    quick=(--quick)
    shift
fi
pliant=${1:-build/release/bin/pliant}
device=${2:-}
folder=${3:-build/gpu_bench}

if [ ! -x "$pliant" ]; then
    echo "gpu_bench: there is no program '$pliant': build it (./dev build), or give its path" >&2
    exit 2
fi
devices=$("$pliant" info | grep -- '--backend vulkan --device' || true)
if [ -z "$devices" ]; then
    echo "gpu_bench: no Vulkan device was found; install a driver and run '$pliant info'" >&2
    exit 2
fi
if [ -n "$device" ]; then
    chosen=$(grep -- "--device $device:" <<<"$devices" || true)
    if [ -z "$chosen" ]; then
        printf "gpu_bench: there is no device '%s'; there are:\n%s\n" "$device" "$devices" >&2
        exit 2
    fi
else
    chosen=$(grep -v '(software' <<<"$devices" | head -n 1 || true)
    [ -n "$chosen" ] || chosen=$(head -n 1 <<<"$devices")
    device=$(sed 's/.*--device \([0-9]*\):.*/\1/' <<<"$chosen")
fi
echo "$chosen"
mkdir -p "$folder"

sheets=1024,16384,262144,1048576,7817616 bodies=3000,31112,500000
if grep -q '(software' <<<"$chosen"; then quick=(--quick); fi
if [ ${#quick[@]} -gt 0 ]; then
    echo "Tiny sizes, to compare bits only."
    sheets=30,1000 bodies=1000
fi

failed=0
# Runs the same cases on both backends: bench SUITE SIZES
bench() {
    "$pliant" bench "$1" --backend vulkan --device "$device" --sizes "$2" "${quick[@]}" --csv "$folder/$1_vulkan.csv" ||
        failed=1
    "$pliant" bench "$1" --backend cpu --sizes "$2" "${quick[@]}" --csv "$folder/$1_cpu.csv" || failed=1
}
bench mss "$sheets"
bench volume "$bodies"
# The same sheets with several steps per dispatch, and with fast math.
variants=(steps_2 steps_3 steps_4 fast)
for variant in "${variants[@]}"; do
    option=(--gpu-substeps "${variant#steps_}")
    [ "$variant" = fast ] && option=(--fast-math)
    "$pliant" bench mss --backend vulkan --device "$device" --sizes "$sheets" "${quick[@]}" "${option[@]}" \
        --csv "$folder/mss_$variant.csv" || failed=1
done
if [ ${#quick[@]} -eq 0 ]; then
    "$pliant" bench constraint --backend vulkan --device "$device" --only "one to three systems a step" --csv "$folder/constraint_vulkan.csv" ||
        failed=1
fi

# Quoted fields (the device) may contain commas, which are removed first.
fields() { cat "$@" | sed -e ':again' -e 's/\(,"[^",]*\),\([^"]*",\)/\1\2/' -e 't again'; }
column='function column(name,   k) { for (k = 1; k <= NF; ++k) if (head[k] == name) return $k; }
        $1 == "row" { for (k = 1; k <= NF; ++k) head[k] = $k; next }'

echo "Bars:"
fields "$folder"/*_vulkan.csv "$folder"/mss_fast.csv | awk -F, "$column"'
    column("bar") != "" && column("backend") == "vulkan" {
        printf "  %-7s %s, %s, %s nodes: %s %s %s, asked for %s\n", column("verdict"), column("suite"), column("case"),
               column("nodes"), column("measured"), column("value"), column("unit"), column("bar")
        if (column("verdict") == "missed") missed = 1
    }
    END { exit missed }' || failed=1
echo "Bits, against the CPU:"
# Compares CSV files of both backends: bits REMARK FILE...
bits() {
    fields "${@:2}" | awk -F, -v remark="$1" "$column"'
    column("state_hash") != "" {
        key = column("suite") ", " column("case") ", " column("nodes") " nodes"
        hash[key, column("backend")] = column("state_hash")
        if (column("backend") == "vulkan") keys[key] = 1
    }
    END {
        for (key in keys) {
            same = hash[key, "vulkan"] == hash[key, "cpu"]
            printf "  %-7s %s%s: %s, %s\n", same ? "equal" : "DIFFER", key, remark, hash[key, "vulkan"], hash[key, "cpu"]
            if (same) ++equal; else different = 1
        }
        exit different || !equal
    }' || failed=1
}
bits "" "$folder"/{mss,volume}_{vulkan,cpu}.csv
for steps in 2 3 4; do bits ", $steps steps in a dispatch" "$folder/mss_steps_$steps.csv" "$folder/mss_cpu.csv"; done
echo "Steps of sheets, ms:"
for variant in vulkan "${variants[@]}"; do
    fields "$folder/mss_$variant.csv" | awk -F, -v variant="$variant" "$column"'
    column("backend") == "vulkan" && column("case") == "sheet" && !seen[column("nodes")]++ {
        printf "  %-7s %9d nodes: %s\n", variant, column("nodes"), column("ms_per_step_median")
    }'
done
exit $failed
