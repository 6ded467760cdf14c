#!/usr/bin/env bash
# verify/verify.sh - `make verify`: the verification cases at full size, their figures in one report,
# build/verify.txt. Takes some minutes.
#   the shipped scenes against their references
#   a bed of uniform porosity: the drag law's pressure drop, two laws, two solvers
#   lid-driven cavities; the noise of the pressure when a grain crosses faces of cells
#   Beverloo's 5/2 power (beverloo.sh)
#   every law of drag: its terminal velocity, its error against measured ones, its picture
#   pressure noise and self-disturbance of every porosity answer (coupling.sh)
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
report=build/verify.txt
mkdir -p build
bad=0

value() {
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}

{
    echo "silt $(git describe --always --dirty 2> /dev/null), $(date -u +%F), $(uname -srm), $(nproc) cores"
    echo
    echo "Shipped scenes against their references"
    for scene in scenes/*.ini; do
        name=$(basename "$scene" .ini)
        [ "$name" = fluidised_bed ] && continue # verify/fluidised_bed.sh, by hand
        if ! ./run.sh "$scene" -o "$tmp/$name" > "$tmp/log" 2>&1; then
            echo "  $name: FAIL, it does not run"
            bad=1
            continue
        fi
        grep -E '^(reference:|terminal velocity)' "$tmp/log" | sed "s/^/  $name: /"
        grep -q '^verdict = pass' "$tmp/$name/summary.txt" || bad=1
        echo "  $name: ledger $(value "$tmp/$name" ledger), wall time $(value "$tmp/$name" wall_time) s"
    done
    echo
    echo "A bed of uniform porosity gives the drag law's pressure drop (1e-6)"
    for t in ergun_navier_stokes ergun_darcy kozeny_carman_navier_stokes kozeny_carman_darcy; do
        make -s build/release/verify/test_bed_$t
        build/release/verify/test_bed_$t > "$tmp/log" || bad=1
        echo "  $t: $(tail -n 1 "$tmp/log")"
    done
    echo
    verify/coupling.sh || bad=1
    echo
    echo "Lid-driven cavity, 128 x 128 cells, against converged values (1 % of the lid's velocity)"
    verify/cavity.sh || bad=1
    echo
    echo "Noise of the pressure, Pa, while one grain crosses faces of cells (verify/porosity_rate.sh)"
    verify/porosity_rate.sh || bad=1
    echo
    echo "Beverloo's law: five circular orifices, C and k of the fit"
    verify/beverloo.sh || bad=1
    echo
    echo "Every law of drag with an isolated sphere comes to its own terminal velocity, one-way"
    verify/drag_settling.sh || bad=1
    echo
    echo "Terminal velocity by every law against Brown and Lawler; pictures docs/drag_*.png"
    verify/drag_figures.sh || echo "  FAIL"
    echo
    echo "How densely spheres pack (one thread; 3 packings of 2000, 3000 poured)"
    verify/packing.sh || bad=1
} 2>&1 | tee "$report"
grep -q FAIL "$report" && bad=1
exit $bad
