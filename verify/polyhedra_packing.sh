#!/usr/bin/env bash
# verify/polyhedra_packing.sh [SEEDS [GRAINS]] - how densely cubes and octahedra without friction pack, means of
# SEEDS (2) beds of GRAINS (450), JOBS (all cores) at a time; minutes.
#   Grains at random places, turned at random, sink through a liquid at rest in a box that is periodic sideways. It is
# so viscous that it takes their speed in 20 ms, 1.4 sqrt(d/g), so nothing is shaken, as in the slow
# compressions by which jammed packings without friction are made, and what would slide to and fro on faces for ever
# comes to rest (dry, octahedra had not after minutes). They come down on 12 of their kind that are held fast, for on a
# flat floor cubes lie down in layers. The fraction, of the rounded volume, is that between 7 mm, two diameters above
# those, and 2.5 diameters below the highest grain.
#   Bands (verify/reference/shape_packing.csv): octahedra between shaken dice, 0.64 +- 0.01 [BakerKudrolli10], and
# maximally random jammed ones, 0.697 +- 0.005 [JiaoTorquato11]; cubes between the maximally dense random packing,
# 0.637 [LiuEtAl17], and random close packing by relaxation, 0.7755 [ZhaoEtAl08] (shaken dice: 0.67 +- 0.01).
#   Printed besides: how far the axes of the grains there are the same, (<sum_kl (a_k b_l)^4> - 9/5)/(6/5) over all
# pairs, 0 at random and 1 in a crystal, for cubes without friction come to lie face to face in small boxes; and the
# kinetic energy that is left, of m g d.
# Cores are dilated by a 20th of their diameter; grains overlap by some 2e-3 of it, and their crowned faces are less
# than 7e-3 of it flatter than what the volume counts: together the fraction is too high by up to a hundredth.
set -euo pipefail
cd "$(dirname "$0")/.."
seeds=${1:-2}
grains=${2:-450}
out=out/polyhedra_packing
mkdir -p "$out"
passed=0
failed=0

scene() { # FORM
    cat << END
[modules]
shape    = dilated_polyhedron
contact  = hertz_mindlin
fluid    = prescribed
drag     = stokes
porosity = centre
forces   = none viscous_torque
[domain]
size  = 12 12 $(awk -v n="$grains" 'BEGIN { print 7 + 0.19 * n }') mm
cells = 1 1 4
x     = periodic
y     = periodic
[fluid]
density   = 1 kg/m3
viscosity = 0.028 Pa s
velocity  = 0 0 0 m/s
dt        = 0.5 ms
[grains floor]
form     = $1
dilation = 0.1 mm
diameter = 2 mm
density  = 2500 kg/m3
count    = 12
frozen   = yes
fill     = random
to       = 12 12 3 mm
material = smooth
[grains a]
form     = $1
dilation = 0.1 mm
diameter = 2 mm
density  = 2500 kg/m3
count    = $grains
fill     = random
from     = 0 0 3 mm
to       = 12 12 $(awk -v n="$grains" 'BEGIN { print 5 + 0.19 * n }') mm
material = smooth
[material smooth]
young       = 5 MPa
poisson     = 0.3
restitution = 0.1
friction    = 0
[run]
end    = $(awk -v n="$grains" 'BEGIN { print 0.45 + 0.0007 * n }') s
speed  = 0.25 m/s
safety = 0.3
[output]
series       = 1 s
profile      = z
profile_bins = 200
bed          = end
END
}

series() { # VARIABLE FILE, one a line
    ncdump -v "$1" "$2" | sed -n "/^ $1 =/,/;/p" | sed 's/.*=//' | tr -d ' \n;' | tr ',' '\n'
}

vectors() { # VARIABLE FILE, one a line
    ncdump -v "$1" "$2" | sed -n "/^ $1 =/,/;/p" | tr -d ',;' | awk 'NF > 2'
}

# OUT/FORM.SEED.txt: fraction, top of the bed, order, energy over m g d per grain
bed() { # FORM SEED
    local at=$out/$1.$2
    scene "$1" > "$at.ini"
    ./run.sh "$at.ini" "run.seed=$2" -o "$at" -j 1 > "$at.log" 2>&1 || { tail -n 3 "$at.log"; return 1; }
    {
        paste <(series solid_profile_position "$at/run.nc") <(series solid_profile_end "$at/run.nc") |
            awk '{ z[NR] = $1; f[NR] = $2; if ($2 > 0) top = $1 }
                 END { for (i = 1; i <= NR; i++) if (z[i] > 0.007 && z[i] < top - 0.006) { sum += f[i]; n++ }
                       print sum / n, top }'
        paste -d ' ' <(vectors orientation "$at/bed.nc") <(vectors position "$at/bed.nc") | awk '
            { height[NR] = $7; top = $7 > top ? $7 : top
              a[NR, 1] = 1 - 2 * ($3^2 + $4^2); a[NR, 2] = 2 * ($2 * $3 + $1 * $4); a[NR, 3] = 2 * ($2 * $4 - $1 * $3)
              a[NR, 4] = 2 * ($2 * $3 - $1 * $4); a[NR, 5] = 1 - 2 * ($2^2 + $4^2); a[NR, 6] = 2 * ($3 * $4 + $1 * $2)
              a[NR, 7] = 2 * ($2 * $4 + $1 * $3); a[NR, 8] = 2 * ($3 * $4 - $1 * $2); a[NR, 9] = 1 - 2 * ($2^2 + $3^2) }
            END { for (i = 1; i <= NR; i++) if (height[i] > 0.007 && height[i] < top - 0.005) in_bed[++n] = i
                  for (p = 2; p <= n; p++) for (q = 1; q < p; q++) {
                      i = in_bed[p]; j = in_bed[q]
                      for (k = 1; k < 9; k += 3) for (l = 1; l < 9; l += 3)
                          s += (a[i, k] * a[j, l] + a[i, k + 1] * a[j, l + 1] + a[i, k + 2] * a[j, l + 2])^4
                      pairs++ }
                  print (s / pairs - 1.8) / 1.2 }'
        vectors velocity "$at/bed.nc" | awk '{ e += 0.5 * ($1^2 + $2^2 + $3^2) / (9.81 * 0.002); n++ }
            END { printf "%.1e\n", e / n }'
    } | paste -s -d ' ' > "$at.txt"
    rm -f "$at/run.nc"
}

verdict() { # FORM LEAST MOST
    local text
    text=$(cat "$out/$1".[0-9]*.txt 2> /dev/null | awk -v seeds="$seeds" -v least="$2" -v most="$3" -v form="$1" '
        { sum += $1; square += $1 * $1; order += $3; energy = $4 > energy ? $4 : energy; all = all sprintf(" %.4f", $1) }
        END { if (NR < seeds) { printf "FAIL %s: %d of %d beds\n", form, NR, seeds; exit }
              m = sum / NR; s = NR > 1 ? sqrt((square - sum * m) / (NR - 1)) : 0; if (!(s > 0)) s = 0
              printf "%s %s: packing fraction %.4f, scatter %.4f (%s ), band %s to %s; order %.2f; kinetic energy %.1e of m g d\n",
                  m > least && m < most && energy < 1e-4 ? "ok  " : "FAIL", form, m, s, all, least, most, order / NR, energy }' || true)
    echo "$text"
    if [[ $text == ok* ]]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

scene cube > "$out/cube.ini"
./run.sh build "$out/cube.ini" > /dev/null
rm -f "$out"/*.txt
for form in cube octahedron; do
    for seed in $(seq "$seeds"); do
        while [ "$(jobs -rp | wc -l)" -ge "${JOBS:-$(nproc)}" ]; do wait -n || true; done
        bed "$form" "$seed" &
    done
done
wait
while IFS=, read -r form least most _; do
    case $form in cube | octahedron) verdict "$form" "$least" "$most" ;; esac
done < verify/reference/shape_packing.csv
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
