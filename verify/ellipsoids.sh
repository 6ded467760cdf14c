#!/usr/bin/env bash
# verify/ellipsoids.sh [GRAINS] - frictionless prolate ellipsoids of aspect 1.25 settle in a box that is periodic
# sideways: packing fraction between 4 diameters above the floor and 4 below the top, against the published 0.70 to 0.72
# of random packings of such ellipsoids (spheres: 0.64) [Donev04] (verify/reference/shape_packing.csv). Takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
grains=${1:-1500}
out=out/ellipsoids_packing
mkdir -p "$out"
cat > "$out/bed.ini" << END
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
profile      = z
profile_bins = 200
END
if ! ./run.sh "$out/bed.ini" -o "$out/bed" -j 1 > "$out/bed.log" 2>&1; then
    tail -n 3 "$out/bed.log"
    echo "0 passed, 1 failed"
    exit 1
fi
series() { # VARIABLE, one a line
    ncdump -v "$1" "$out/bed/run.nc" | sed -n "/^ $1 =/,/;/p" | sed 's/.*=//' | tr -d ' \n;' | tr ',' '\n'
}
IFS=, read -r _ least most _ < <(grep '^ellipsoid 1.25,' verify/reference/shape_packing.csv)
paste <(series solid_profile_position) <(series solid_profile_end) | awk -v least="$least" -v most="$most" -v n="$grains" '
    { z[NR] = $1; f[NR] = $2; if ($2 > 0) top = $1 }
    END {
        for (i = 1; i <= NR; i++) if (z[i] > 0.008 && z[i] < top - 0.008) { sum += f[i]; slabs++ }
        mean = slabs ? sum / slabs : 0
        good = mean > least && mean < most
        printf "%s %d ellipsoids, between 8 and %.1f mm: packing fraction %.4f (published: %s to %s)\n",
            good ? "ok  " : "FAIL", n, 1e3 * (top - 0.008), mean, least, most
        printf "%d passed, %d failed\n", good, !good
        exit !good
    }'
