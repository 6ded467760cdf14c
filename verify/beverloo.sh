#!/usr/bin/env bash
# verify/beverloo.sh - Beverloo's 5/2 power: five circular orifices in a flat rough bottom (a plate of
# fixed grains with a round hole), the same bed over each; C and k by least squares of
#   (W/(rho_b sqrt(g)))^(2/5) = C^(2/5) (D - k d)
# against the band published for spheres, C 0.55 to 0.65 and k 1.3 to 1.6 [Beverloo61], widened to
# what simulations of spheres scatter by, +-10 % in the rate: C 0.49 to 0.72, k 1.0 to 2.0. The power
# itself is fitted too: log W against log(D - 1.4 d). About 6 minutes on two quiet cores.
#   verify/beverloo.sh [D/d ...]
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
[ $# -gt 0 ] || set -- 5 6 7 8 10
edge=40 # mm, of the periodic box
for ratio; do
    # the plate: rows of grains of 2 mm, 1.6 mm apart, whose surfaces stay clear of the orifice
    awk -v edge=$edge -v D="$(awk -v r="$ratio" 'BEGIN { print 2 * r }')" 'BEGIN {
        n = int(edge / 1.6)
        for (j = 0; j < n; j++)
            for (i = 0; i < n; i++) {
                x = (i + 0.5) * edge / n; y = (j + 0.5) * edge / n
                r = sqrt((x - edge / 2) ^ 2 + (y - edge / 2) ^ 2)
                if (r >= D / 2 + 1) printf "%.9g %.9g 0.039 0.002\n", x / 1000, y / 1000
            }
        m = int(3.14159265 * (D + 2) / 1.6) # a rim of grains makes it round
        for (k = 0; k < m; k++)
            printf "%.9g %.9g 0.039 0.002\n", (edge / 2 + (D / 2 + 1) * cos(6.2831853 * k / m)) / 1000,
                (edge / 2 + (D / 2 + 1) * sin(6.2831853 * k / m)) / 1000
    }' > "$tmp/plate"
    cat > "$tmp/hopper.ini" <<TEXT
[modules]
contact   = hertz_mindlin
reference = beverloo
[domain]
size = $edge $edge 105 mm
x    = periodic
y    = periodic
[grains beads]
diameter = 2 mm
density  = 2500 kg/m3
fill     = lattice
count    = 8000
from     = 0 0 41 mm
to       = $edge $edge 103 mm
[grains plate]
diameter = 2 mm
density  = 2500 kg/m3
frozen   = yes
material = beads
fill     = file
file     = $tmp/plate
[material beads]
young       = 10 MPa
poisson     = 0.3
restitution = 0.6
friction    = 0.5
[meter outlet]
point  = 0 0 36 mm
normal = 0 0 -1
[region above]
from = 10 10 44 mm
to   = 30 30 58 mm
[reference]
orifice   = $(awk -v r="$ratio" 'BEGIN { print 2 * r }') mm
after     = 0.15 s
until     = 0.4 s
tolerance = 99 %
[output]
series = 5 ms
[run]
end         = 0.4 s
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
           good = n >= 5 && C > 0.49 && C < 0.72 && k > 1.0 && k < 2.0 && p > 2.3 && p < 2.7
           printf "  %d orifices: C = %.3f (0.49 to 0.72), k = %.2f (1.0 to 2.0), power at k = 1.4: %.2f (2.5 +- 0.2): %s\n",
               n, C, k, p, good ? "pass" : "FAIL"
           exit !good }' "$tmp/rates"
