#!/usr/bin/env bash
# verify/cavity.sh - the lid-driven cavity at 128 x 128 cells, steady: largest error on the centre
# lines against converged values (verify/reference/lid_cavity.csv), 1 % of the lid's velocity
# allowed; centred convection, and van Leer's for comparison. Part of `make verify`; a minute each.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0

cavity() { # RE VISCOSITY DT END SCHEME
    ./run.sh scenes/lid_cavity.ini "domain.cells=128 128 1" "fluid.viscosity=$2" "fluid.dt=$3" "run.end=$4" \
        fluid.convection="$5" reference.tolerance=0.01 -o "$tmp/run" > "$tmp/log" 2>&1
    grep -q '^verdict = pass' "$tmp/run/summary.txt" || [ "$5" != centred ] || bad=1
    echo "  Re $1, $5: $(sed -n 's/^reference: //p' "$tmp/log")"
}

cavity 100 "10 mPa s" "0.76 ms" "16 s" centred
cavity 1000 "1 mPa s" "1.8 ms" "80 s" centred
cavity 1000 "1 mPa s" "1.8 ms" "80 s" van_leer
exit $bad
