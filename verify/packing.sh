#!/usr/bin/env bash
# verify/packing.sh [SEEDS [GRAINS]] - how densely spheres pack, against published values: jammed
# without friction (some minutes), and poured with friction 0.5. Part of `make verify`.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0
make -s build/release/verify/packing || exit 2
OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} build/release/verify/packing jam "${1:-3}" "${2:-2000}" || bad=1
if ./run.sh verify/poured_bed.ini -o "$tmp/bed" > "$tmp/log" 2>&1; then
    build/release/verify/packing measure "$tmp/bed/bed.nc" || bad=1
else
    tail -n 3 "$tmp/log"
    echo "  FAIL the poured bed does not run"
    bad=1
fi
exit $bad
