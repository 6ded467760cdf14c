#!/usr/bin/env bash
# verify/sandpile.sh - a pile of discs under a funnel with three models of rolling resistance: its height
# against Ai, Chen, Rotter & Ooi 2011, whose curves are digitised in verify/reference/ai2011_sandpile.csv
# [Ai11]. Where the pile stands (EPSD, viscous) the height at rest must lie within 5 % (the paper gives no
# scatter); a constant torque lets it creep, and the height at the paper's first times is compared. The
# order of the three is part of the verdict. Some minutes each on a quiet core.
#   verify/sandpile.sh [MODEL ...]     of constant_torque viscous epsd
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
[ $# -gt 0 ] || set -- viscous constant_torque epsd
gate=4.5 # s, when the paper's gate opens; here at 0
end=8

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
