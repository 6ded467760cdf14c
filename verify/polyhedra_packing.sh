#!/usr/bin/env bash
# verify/polyhedra_packing.sh [GRAINS] - frictionless cubes and octahedra settle in a box that is periodic
# sideways: packing fraction in the middle of the bed.
#   Bands: octahedra between shaken dice, 0.64 +- 0.01 [BakerKudrolli10], and maximally random jammed ones,
#   0.697 +- 0.005 [JiaoTorquato11]; cubes between the maximally dense random packing, 0.637 [LiuEtAl17], and random
#   close packing by relaxation, 0.7755 [ZhaoEtAl08] (shaken dice: 0.67 +- 0.01). verify/reference/shape_packing.csv
# Cores dilated by a 20th of their diameter; the fraction counts the rounded volume. Takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
grains=${1:-600}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s SHAPE=dilated_polyhedron CONTACT=hertz_mindlin silt
silt=$(make -s SHAPE=dilated_polyhedron CONTACT=hertz_mindlin where)
bad=0
pack() { # FORM LEAST MOST
    cat > "$tmp/bed.ini" << END
[modules]
shape   = dilated_polyhedron
contact = hertz_mindlin
[domain]
size = 12 12 $(awk -v n="$grains" 'BEGIN { print 10 + 0.14 * n }') mm
x = periodic
y = periodic
[grains a]
form     = $1
dilation = 0.1 mm
diameter = 2 mm
density  = 2500 kg/m3
count    = $grains
fill     = settle
material = smooth
[material smooth]
young       = 20 MPa
poisson     = 0.3
restitution = 0.3
friction    = 0
[run]
end           = 1 ms
settle_energy = 1e-4
[output]
bed = end
END
    "$silt" "$tmp/bed.ini" -o "$tmp/bed" > "$tmp/log" 2>&1 || { tail -n 3 "$tmp/log"; exit 1; }
    # centres between 3 diameters above the floor and 2.5 below the highest grain
    ncdump -v position "$tmp/bed/bed.nc" | awk -v form="$1" -v least="$2" -v most="$3" '
    /^ position =/ { on = 1; next }
    on && /,/ { gsub(/[,;}]/, " "); if (NF >= 3) { z[n++] = $3; top = $3 > top ? $3 : top } }
    END {
        lo = 0.006; hi = top - 0.005
        for (i = 0; i < n; i++) inside += z[i] > lo && z[i] < hi
        f = inside * 3.14159265 / 6 * 8e-9 / (0.012 * 0.012 * (hi - lo))
        good = f > least && f < most
        printf "%s %s: %d of %d between %.1f and %.1f mm, packing fraction %.4f (band: %s to %s)\n",
            good ? "ok  " : "FAIL", form, inside, n, 1e3 * lo, 1e3 * hi, f, least, most
        exit !good
    }' || bad=1
}
while IFS=, read -r form least most _; do
    case $form in cube | octahedron) pack "$form" "$least" "$most" ;; esac
done < verify/reference/shape_packing.csv
exit $bad
