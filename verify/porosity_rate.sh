#!/usr/bin/env bash
# verify/porosity_rate.sh - the noise of the pressure while one grain crosses faces of cells: a
# heavy grain of 1 mm goes at 0.1 m/s through water at rest, cells of 2 mm, for 4 mm (two faces);
# largest less smallest pressure at a point 9 mm aside, in Pa, for every porosity answer, each way
# to take d(eps)/dt, and three steps of the fluid. Part of `make verify`.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s -j"$(nproc)" build/release/front || exit 2
cat > "$tmp/crossing.ini" <<'INI'
[modules]
contact  = linear
drag     = schiller_naumann
porosity = divided
fluid    = navier_stokes
[domain]
size    = 24 24 24 mm
cells   = 12 12 12
x       = periodic
y       = periodic
z+      = outflow
gravity = 0 0 0 m/s2
[grains ball]
diameter = 1 mm
density  = 1e7 kg/m3
fill     = point
position = 9.1 11.3 12.4 mm
velocity = 100 0 0 mm/s
[material ball]
stiffness   = 1e6 N/m
restitution = 0.9
friction    = 0.3
[fluid]
density   = 1000 kg/m3
viscosity = 1 mPa s
dt        = 1 ms
[probe aside]
kind = point
at   = 11 20 12 mm
[run]
end   = 40 ms
force = on
INI
printf '  %-14s %-11s' porosity 'd(eps)/dt'
for dt in 2 0.5 0.125; do printf ' %9s' "dt $dt ms"; done
echo
for porosity in centre divided trilinear porous_sphere gaussian; do
    [ -e porosity/$porosity.c ] || continue
    slots=$(build/release/front slots "$tmp/crossing.ini" modules.porosity=$porosity) || exit 2
    binary=$(make -s $slots silt where)
    for rate in difference flux off; do
        printf '  %-14s %-11s' $porosity $rate
        for dt in 2 0.5 0.125; do
            if "$binary" "$tmp/crossing.ini" modules.porosity=$porosity fluid.porosity_rate=$rate \
                "fluid.dt=$dt ms" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1; then
                awk -F ' = ' '$1 == "aside_pressure_least" { a = $2 + 0 } $1 == "aside_pressure_most" { b = $2 + 0 }
                    END { printf " %9.3g", b - a }' "$tmp/run/summary.txt"
            else
                printf ' %9s' stopped
            fi
        done
        echo
    done
done
