#!/usr/bin/env bash
# verify/coupling.sh - what each answer of porosity/ costs in accuracy: tables on the terminal.
#   a grain carried through faces of cells: noise of the pressure, against the fluid's step
#   one sphere falls, two-way: what it disturbs of its own cell, against cell/d
#   the same in MFiX's set-up DEM06, its cells 20 diameters wide
# Ends with status 1 where a run fails. Some minutes.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0
answers=$(cd porosity && ls ./*.c | sed 's|^./||; s|\.c$||')

value() {
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}

run() {
    ./run.sh "$@" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1
}

make -s build/release/verify/crossing
echo "A grain of 0.5 mm is carried at 10 mm/s through 3 cells of 1 mm of a liquid at rest:"
echo "  largest pressure / largest change of a cell's pressure in a step, over rho V^2"
printf '  %-14s' "dt V/h"
for dt in 0.1 0.02 0.004; do printf ' %16s' $dt; done
echo
for porosity in $answers; do
    printf '  %-14s' "$porosity"
    for dt in 10 2 0.4; do
        if run verify/crossing.ini modules.porosity="$porosity" "fluid.dt=$dt ms" "output.every=$dt ms"; then
            read -r most jump < <(build/release/verify/crossing "$tmp/run/run.nc" 1000 0.01)
            printf ' %16s' "$most / $jump"
        else
            printf ' %16s' stopped
            bad=1
        fi
    done
    echo
done
echo
echo "One sphere falls, two-way: terminal velocity over the exact one, minus 1 (self-disturbance)"
echo "  d = 0.1 mm, Re = 0.19, Di Felice; box 3.2 x 3.2 x 6.4 mm, slip sides, open above"
printf '  %-14s' "cell/d"
for c in 1 2 4 8; do printf ' %9s' $c; done
echo
for porosity in $answers; do
    printf '  %-14s' "$porosity"
    for c in 1 2 4 8; do
        n=$((32 / c))
        if run scenes/settling.ini modules.porosity="$porosity" coupling.ways=two \
            "domain.size=3.2 3.2 6.4 mm" "domain.cells=$n $n $((2 * n))" \
            "grains bead.position=1.63 1.63 4.83 mm" "fluid.dt=50 us"; then
            printf ' %+9.4f' "$(value "$tmp/run" velocity_error)"
        else
            printf ' %9s' stopped
        fi
    done
    echo
done
echo
echo "MFiX DEM06: a sphere of 0.1 mm falls in gas that rises with 0.4 m/s; cells of 2 x 2 x 5 mm"
echo "  largest error of its velocity on the way, over its terminal velocity in gas at rest"
for ways in one two; do
    for porosity in $answers; do
        [ "$ways" = two ] || [ "$porosity" = none ] || continue
        if run scenes/settling.ini modules.porosity="$porosity" modules.drag=schiller_naumann \
            coupling.ways=$ways "domain.size=10 10 100 mm" "domain.cells=5 5 20" domain.z-=inflow \
            "flow.velocity=0.4 m/s" "grains bead.position=5 5 92.5 mm" \
            "grains bead.density=2000 kg/m3" "fluid.density=1.2 kg/m3" \
            "fluid.viscosity=1.8e-5 Pa s" "fluid.dt=1 ms" "run.dt=0.1 ms" "run.end=0.35 s"; then
            printf '  %-14s %s-way %+9.5f\n' "$porosity" $ways "$(value "$tmp/run" velocity_error_worst)"
        else
            printf '  %-14s %s-way stopped\n' "$porosity" $ways
            bad=1
        fi
    done
done
exit $bad
