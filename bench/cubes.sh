#!/usr/bin/env bash
# bench/cubes.sh [BED] - a settled bed of 1,000 cubes with rounded edges (bench/cubes.ini): grain-steps a
# second on one core, median of three runs. BED: a bed.nc saved before, else it is settled first (minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bed=${1:-}
if [ -z "$bed" ]; then
    ./run.sh bench/cubes.ini -j 1 -o "$tmp/bed" > "$tmp/log" 2>&1 || { tail -n 3 "$tmp/log"; exit 1; }
    bed=$tmp/bed/bed.nc
fi
for round in 1 2 3; do
    ./run.sh bench/cubes.ini "grains cubes.fill=file" "grains cubes.file=$bed" output.bed=none \
        "run.end=${END:-10 ms}" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1 || { tail -n 3 "$tmp/log"; exit 1; }
    sed -n 's/^grain_steps_per_second = \([^ ]*\).*/\1/p' "$tmp/run/summary.txt"
done | sort -g | awk '{ r[NR] = $1 } END { printf "1000 dilated cubes, one core: %.0f grain-steps/s\n", r[2] }'
