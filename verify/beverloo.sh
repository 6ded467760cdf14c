#!/usr/bin/env bash
# verify/beverloo.sh - Beverloo's 5/2 power: a flat-bottomed round hopper, its bottom a plate with a
# circular orifice with sharp edges; six orifices; C and k by least squares of
#   (W/(rho_b sqrt(g)))^(2/5) = C^(2/5) (D - k d)
# against what is published for spheres, C 0.55 to 0.65 and k 1.3 to 1.6 [Beverloo61]. The power is
# fitted too: log W against log(D - 1.4 d). rho_b is that of the grains that flow: in a box as wide as
# the orifice, from 0.5 D to 1.5 D over it, the same in shape for all. The hopper is 2.4 D wide at least,
# and its bed higher than wide. About 15 minutes on a quiet core.
#   verify/beverloo.sh [D/d ...]
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
[ $# -gt 0 ] || set -- 5 6 7 8 10 12
for ratio; do
    # mm: hopper, its height; s: when the rate is taken, longer for a trickle
    read -r wide high until <<< "$(awk -v r="$ratio" 'BEGIN {
        w = 2 * (r < 25 / 3 ? 20 : 2.4 * r); print w, 1.3 * w, 0.15 + 5 / (r - 1.4) ^ 1.4 }')"
    cat > "$tmp/hopper.ini" <<TEXT
[modules]
contact   = hertz_mindlin
reference = beverloo
[domain]
size = $wide $wide $(awk -v h="$high" 'BEGIN { print h + 8 }') mm
[wall hopper]
kind   = cylinder
point  = $(awk -v w="$wide" 'BEGIN { print w / 2, w / 2, 6 }') mm
axis   = 0 0 1
radius = $(awk -v w="$wide" 'BEGIN { print w / 2 }') mm
length = 1 m
[wall bottom]
kind   = disc
point  = $(awk -v w="$wide" 'BEGIN { print w / 2, w / 2, 6 }') mm
normal = 0 0 1
radius = $(awk -v w="$wide" 'BEGIN { print w / 2 }') mm
hole   = $(awk -v r="$ratio" 'BEGIN { print r }') mm
[side z-]
grains = open
[grains beads]
diameter = 2 mm
density  = 2500 kg/m3
fill     = grow
porosity = 0.44
from     = 0 0 6.01 mm
to       = $wide $wide $(awk -v h="$high" 'BEGIN { print h + 6 }') mm
[material beads]
young       = 10 MPa
poisson     = 0.3
restitution = 0.6
friction    = 0.5
[meter outlet]
point  = 0 0 4 mm
normal = 0 0 -1
[region above]
from = $(awk -v w="$wide" -v r="$ratio" 'BEGIN { print w / 2 - r, w / 2 - r, 6 + r }') mm
to   = $(awk -v w="$wide" -v r="$ratio" 'BEGIN { print w / 2 + r, w / 2 + r, 6 + 3 * r }') mm
[reference]
orifice   = $(awk -v r="$ratio" 'BEGIN { print 2 * r }') mm
after     = 0.15 s
until     = $until s
tolerance = 99 %
[output]
series = 5 ms
[run]
end         = $until s
overlap_max = 0.3
TEXT
    if ! ./run.sh "$tmp/hopper.ini" -o "$tmp/run" > "$tmp/log" 2>&1; then
        echo "  D/d = $ratio: FAIL, it does not run"
        tail -n 5 "$tmp/log"
        exit 1
    fi
    awk -v ratio="$ratio" '$1 == "discharge_rate" { w = $3 } $1 == "bulk_density" { b = $3 }
        $1 == "beverloo_rate" { l = $3 } $1 == "outlet_count" { n = $3 }
        END { print ratio, w, b, l, n }' "$tmp/run/summary.txt" | tee -a "$tmp/rates" |
        awk '{ printf "  D/d %4g  rate %.4g kg/s  Beverloo %.4g kg/s  %+5.1f %%  (%d grains, bulk %.0f kg/m3)\n",
               $1, $2, $4, 100 * ($2 / $4 - 1), $5, $3 }'
done
awk '{ D = 0.002 * $1; y = ($2 / ($3 * sqrt(9.81))) ^ 0.4
       n++; sx += D; sy += y; sxx += D * D; sxy += D * y
       a = log(D - 1.4 * 0.002); b = log($2 / $3); lx += a; ly += b; lxx += a * a; lxy += a * b }
     END { s = (n * sxy - sx * sy) / (n * sxx - sx * sx); c = (sy - s * sx) / n
           C = s ^ 2.5; k = -c / s / 0.002; p = (n * lxy - lx * ly) / (n * lxx - lx * lx)
           good = n >= 5 && C >= 0.55 && C <= 0.65 && k >= 1.3 && k <= 1.6 && p > 2.4 && p < 2.6
           printf "  %d orifices: C = %.3f (0.55 to 0.65), k = %.2f (1.3 to 1.6), power at k = 1.4: %.2f (2.5 +- 0.1): %s\n",
               n, C, k, p, good ? "pass" : "FAIL"
           exit !good }' "$tmp/rates"
