#!/usr/bin/env bash
# bench/clumps.sh [CLUMPS [STEPS]] - clumps of 8 spheres at rest, beside LIGGGHTS' multispheres: the same
# recipe (sizes, material, time step, box), one thread each; sphere-steps per second and their ratio.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
clumps=${1:-1000}
steps=${2:-5000}
settle=${3:-15000}
limit="timeout ${LIMIT:-300}"
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
side=$(awk -v n="$clumps" 'BEGIN { printf "%.4f", 0.024 * sqrt(n / 1000) }')
make -s build/release/front
slots=$(build/release/front slots bench/clumps.ini | tr '\n' ' ')
# shellcheck disable=SC2086
make -s $slots silt
# shellcheck disable=SC2086
binary=$(make -s $slots where)
box="domain.size=$side $side 0.08 m"
# the time of both runs together, less that of the first
$limit "$binary" bench/clumps.ini "$box" "grains cubes.count=$clumps" "output.bed=end" -j 1 -o "$tmp/settle" \
    > "$tmp/log" 2>&1 || tail -n 3 "$tmp/log"
$limit "$binary" bench/clumps.ini "$box" "grains cubes.fill=file" "grains cubes.file=$tmp/settle/bed.nc" \
    "run.end=$(awk -v n="$steps" 'BEGIN { print n * 1e-5 }') s" -j 1 -o "$tmp/timed" > "$tmp/log" 2>&1 ||
    tail -n 3 "$tmp/log"
silt=$(awk -F ' = ' '/^grain_steps_per_second/ { print 8 * $2 }' "$tmp/timed/summary.txt")
touching=$(awk -F ' = ' '/^contacts_per_grain/ { print $2 / 4 }' "$tmp/timed/summary.txt")
printf '%-28s %10.3g sphere-steps/s, %.2f contacts a sphere\n' "silt, $clumps clumps" "$silt" "$touching"
if command -v liggghts > /dev/null; then
    (cd "$tmp" && OMP_NUM_THREADS=1 $limit liggghts -in "$OLDPWD/bench/clumps.lig" -var n "$clumps" -var side "$side" \
        -var settle $settle -var steps "$steps" > log.lig 2>&1)
    sed -n '/^TIMED/,$p' "$tmp/log.lig" > "$tmp/timed.lig"
    peer=$(awk '/^Loop time of/ { print $12 * $9 / $4 }' "$tmp/timed.lig")
    near=$(awk '$1 == "Step" { getline; getline; print $3 }' "$tmp/timed.lig")
    printf '%-28s %10.3g sphere-steps/s, %s contacts a sphere\n' "LIGGGHTS multisphere" "$peer" "$near"
    awk -v a="$silt" -v b="$peer" 'BEGIN { printf "ratio %.2f\n", a / b }'
else
    echo "(liggghts is not installed and left out; apt-get install liggghts)"
fi
