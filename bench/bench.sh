#!/usr/bin/env bash
# bench/bench.sh [quick] - `make bench`: how fast this machine runs the contact loop and the direct pressure
# solve, beside what its memory gives in the same minute. Levels, not exact figures: compare ratios.
set -euo pipefail
cd "$(dirname "$0")/.."
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s -j"$(nproc)" build/release/front build/release/bench/kernels build/release/bench/answers \
    build/release/bench/contact_answers build/release/bench/walls
slots=$(build/release/front slots scenes/packed_bed.ini)
make -s -j"$(nproc)" $slots silt
binary=$(make -s $slots where)

value() {
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}

# Dry part of the bed: grains settle (Hertz-Mindlin with history, friction, restitution), two rounds.
bed() { # THREADS
    "$binary" scenes/packed_bed.ini "run.end=1 ms" flow.steps=1 flow.velocity_end=same \
        run.settle_energy=1e-6 -j "$1" -o "$tmp/bed" > /dev/null 2>&1
    value "$tmp/bed" grain_steps_per_second
}
printf '%-8s %22s %12s\n' threads "grain-steps per second" "per thread"
for round in 1 2; do
    for j in 1 $(nproc); do
        rate=$(bed "$j")
        awk -v r="$rate" -v j="$j" 'BEGIN { printf "%-8d %20.2f M %10.2f M\n", j, r / 1e6, r / 1e6 / j }'
    done
done
build/release/bench/kernels
OMP_NUM_THREADS=1 build/release/bench/answers
OMP_NUM_THREADS=1 build/release/bench/contact_answers
OMP_NUM_THREADS=1 build/release/bench/walls
make -s build/release/bench/fluid
for j in 1 $(nproc); do
    OMP_NUM_THREADS=$j GOMP_SPINCOUNT=1000 build/release/bench/fluid
done
bench/scaling.sh "${1:-}"
echo
bench/sizes.sh "${1:-}"
bench/peers.sh "${1:-}"
echo
echo "Grains that are no spheres"
bench/cubes.sh "${1:-}" || true
if [ "${1:-}" = quick ]; then
    bench/clumps.sh 1000 1000 10000
else
    bench/clumps.sh
fi
bench/superquadrics.sh || true
bench/dpmfoam.sh "${1:-}"
