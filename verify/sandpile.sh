#!/usr/bin/env bash
# verify/sandpile.sh - a pile of discs under a funnel with three models of rolling resistance, against the
# heights of Ai, Chen, Rotter & Ooi 2011 [Ai11] in verify/reference/ai2011_sandpile.csv.
#   epsd             comes to rest: the height stays (0.5 % in the last 1.5 s) and is the highest
#   constant_torque  creeps: the height falls, and lies between the two
#   viscous          comes to rest at the height of no rolling resistance, the lowest
# Each height must lie within 5 % of the paper's at the same time after the gate opened. The sources at hand
# give no scatter, no restitution, no steps and no thickness of the discs, and with it no stiffness over
# weight: Hertz contacts of spheres of 4 MPa under discs of 8.9 mm are about 8 times softer than the line
# contact of such discs. Measured, over the published: epsd -7.2 to -10.3 % (three fillings, one of them
# without easing the spring: no difference beyond their scatter), restitution 0.1 or 0.3 in place of 0.7
# -6.6 %, 40 MPa in place of 4 -1.9 %; constant_torque -5.5 and -3.6 % (two fillings), restitution 0.3
# -5.8 %; viscous +0.3 % at restitution 0.7 and 0.3. Two or three minutes each on a quiet core.
#   verify/sandpile.sh [MODEL ...]     of constant_torque viscous epsd
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
[ $# -gt 0 ] || set -- viscous constant_torque epsd
gate=4.5 # s, when the paper's gate opens; here at 0
end=8
bad=0

scene() { # MODEL
    local rolling=""
    [ "$1" = epsd ] && rolling=$'[rolling]\nform = disc'
    cat <<TEXT
[modules]
shape   = disc
contact = hertz_mindlin
rolling = $1
[domain]
size = 2000 8.9 1800 mm
[side x-]
grains = open                 ; the floor ends
[side x+]
grains = open
TEXT
    # the funnel, its channel and its walls: x0 z0 x1 z1 in mm
    local k=0 x0 z0 x1 z1
    while read -r x0 z0 x1 z1; do
        k=$((k + 1))
        cat <<TEXT
[wall plate$k]
kind   = rectangle
corner = $x0 -5 $z0 mm
edge1  = $((x1 - x0)) 0 $((z1 - z0)) mm
edge2  = 0 20 0 mm
TEXT
    done <<< "965 350 965 570
1035 350 1035 570
965 570 495 1140
1035 570 1505 1140
495 1140 495 1800
1505 1140 1505 1800"
    cat <<TEXT
[wall gate]
kind     = rectangle
corner   = 965 -5 570 mm
edge1    = 70 0 0 mm
edge2    = 0 20 0 mm
velocity = 5 0 0 m/s          ; aside, into the room beside the funnel
stop     = 40 ms
[grains small]
diameter = 6.9 mm
density  = 1056 kg/m3
count    = 2500
fill     = settle
material = disc
from     = 740 0 865 mm
to       = 1260 8.9 1400 mm
[grains large]
diameter = 8.9 mm
density  = 1056 kg/m3
count    = 500
fill     = settle
material = disc
from     = 740 0 865 mm
to       = 1260 8.9 1400 mm
[material disc]
young            = 4 MPa
poisson          = 0.49
restitution      = 0.7
friction         = 0.8
$([ "$1" = viscous ] && echo "rolling_viscosity = 0.3 s/m" || echo "rolling_friction = 0.3")
$rolling
[surface heap]
kind = ridge
axis = x
cell = 20 mm
to   = 2000 8.9 330 mm       ; below the funnel
[output]
series = 50 ms
[run]
end         = $end s
safety      = 0.4
overlap_max = 0.5
TEXT
}

# m: the paper's height of a model when our run ends.
published() { # MODEL
    awk -F, -v model="$1" -v t="$(awk -v g="$gate" -v e="$end" 'BEGIN { print g + e }')" '
        $1 == model { if ($2 >= t && n++ == 0) print n0 ? h0 + ($3 - h0) * (t - t0) / ($2 - t0) : $3
                      t0 = $2; h0 = $3; n0++ }' verify/reference/ai2011_sandpile.csv
}

for model; do
    scene "$model" > "$tmp/$model.ini"
    if ! OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} ./run.sh "$tmp/$model.ini" -o "$tmp/$model" > "$tmp/log" 2>&1; then
        echo "  $model: FAIL, it does not run: $(tail -n 1 "$tmp/log")"
        exit 1
    fi
    # heights of the last 1.5 s, 30 samples
    ncdump -v heap_height "$tmp/$model/run.nc" | tr -d '\n' | sed 's/.*heap_height = //; s/;.*//' | tr ',' '\n' |
        tail -n 31 | awk -v model="$model" -v want="$(published "$model")" \
            -v angle="$(sed -n 's/^heap_angle = \([^ ]*\).*/\1/p' "$tmp/$model/summary.txt")" '
            NR == 1 { first = $1 } { last = $1 }
            END { off = last / want - 1; drift = last / first - 1
                  rests = drift < 0.005 && drift > -0.005
                  good = off < 0.05 && off > -0.05 && (model == "constant_torque" ? drift < -0.005 : rests)
                  printf "  %-16s height %.4f m, published %.4f m, %+.1f %%; angle %.1f degrees; in the last 1.5 s %+.2f %%: %s\n",
                      model, last, want, 100 * off, angle, 100 * drift, good ? "pass" : "FAIL"
                  print model, last > "'"$tmp"'/height." model
                  exit !good }' || bad=1
done
if [ -s "$tmp/height.epsd" ] && [ -s "$tmp/height.constant_torque" ] && [ -s "$tmp/height.viscous" ]; then
    cat "$tmp"/height.{epsd,constant_torque,viscous} | awk '
        NR > 1 && $2 >= last { wrong = 1 } { last = $2 }
        END { print "  epsd stands highest, viscous lowest: " (wrong ? "FAIL" : "pass"); exit wrong }' || bad=1
fi
exit $bad
