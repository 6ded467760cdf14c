#!/usr/bin/env bash
# verify/ellipsoids.sh [GRAINS] - frictionless prolate ellipsoids of aspect 1.25 settle in a box that is
# periodic sideways; packing fraction in the middle of the bed against the published 0.70 to 0.72 of
# random packings of such ellipsoids (spheres: 0.64) [Donev04]. Takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
grains=${1:-1500}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s SHAPE=superquadric CONTACT=hertz_mindlin silt
cat > "$tmp/bed.ini" << END
[modules]
shape   = superquadric
contact = hertz_mindlin
[domain]
size = 20 20 $(awk -v n="$grains" 'BEGIN { print 10 + 0.04 * n }') mm
x = periodic
y = periodic
[grains a]
half_axes = 1 1 1.25
diameter  = 2 mm
density   = 2500 kg/m3
count     = $grains
fill      = settle
material  = smooth
[material smooth]
young       = 20 MPa
poisson     = 0.3
restitution = 0.3
friction    = 0
[run]
end           = 1 ms
settle_energy = 1e-5
[output]
bed = end
END
"$(make -s SHAPE=superquadric CONTACT=hertz_mindlin where)" "$tmp/bed.ini" -o "$tmp/bed" > "$tmp/log" 2>&1 ||
    { tail -n 3 "$tmp/log"; exit 1; }
# Centres between 4 diameters above the floor and 4 below the highest grain.
ncdump -v position "$tmp/bed/bed.nc" | awk '
/^ position =/ { on = 1; next }
on && /,/ { gsub(/[,;}]/, " "); if (NF >= 3) { z[n++] = $3; top = $3 > top ? $3 : top } }
END {
    lo = 0.008; hi = top - 0.008
    for (i = 0; i < n; i++) inside += z[i] > lo && z[i] < hi
    f = inside * 3.14159265 / 6 * 8e-9 / (0.02 * 0.02 * (hi - lo))
    printf "%d of %d ellipsoids between %.1f and %.1f mm: packing fraction %.4f (published: 0.70 to 0.72)\n", inside, n, 1e3 * lo, 1e3 * hi, f
    exit !(f > 0.69 && f < 0.73)
}'
