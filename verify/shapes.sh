#!/usr/bin/env bash
# verify/shapes.sh - a clump of one sphere is a sphere: the same motion to the last bit, with history,
# rolling, cohesion, frozen grains, walls of several kinds, a moving STL mesh among them, in a throng that
# comes to lie with several contacts a grain, on one and two threads.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0
make -s build/release/front
cat > "$tmp/one.ini" << 'EOF'
[modules]
contact  = hertz_mindlin
rolling  = epsd
cohesion = jkr
[domain]
size = 60 60 120 mm
y    = periodic
[grains a]
sizes        = uniform
diameter_min = 2.9 mm
diameter_max = 4.3 mm
density      = 2385 kg/m3
fill         = random
count        = 300
from         = 10 10 30 mm
to           = 50 50 100 mm
spin         = 3 -7 11 rad/s
velocity     = 0.1 0.2 -0.3 m/s
[grains fixed]
diameter = 5 mm
density  = 2385 kg/m3
frozen   = yes
fill     = lattice
count    = 10
to       = 60 60 12 mm
material = a
[material a]
young          = 7 MPa
poisson        = 0.27
restitution    = 0.53
friction       = 0.47
rolling_friction = 0.13
work_of_adhesion = 0.4 J/m2
[wall tube]
kind   = cylinder
point  = 30 30 -10 mm
axis   = 0 0 1
radius = 29.3 mm
[wall drum]
kind     = mesh
file     = scenes/funnel.stl
scale    = 0.5 mm
shift    = 30 30 30 mm
velocity = 0 0 -50 mm/s
[output]
contacts = on
[run]
end         = 120 ms
overlap_max = 0.5
force       = on
EOF
numbers() { # SHAPE THREADS
    local slots binary
    slots=$(build/release/front slots "$tmp/one.ini" "modules.shape=$1" | tr '\n' ' ')
    # shellcheck disable=SC2086
    make -s $slots silt
    # shellcheck disable=SC2086
    binary=$(make -s $slots where)
    sed -e "s/^\\[modules\\]/&\\nshape = $1/" "$tmp/one.ini" > "$tmp/$1.ini"
    [ "$1" = sphere ] ||
        sed -i -e 's/^\[grains .*/&\nspheres = 0.3 0.2 0.1 0.7/' "$tmp/$1.ini"
    "$binary" "$tmp/$1.ini" -o "$tmp/$1" -j "$2" > "$tmp/log" 2>&1 || tail -n 3 "$tmp/log" >&2
    # the orientation of a sphere is not told
    ncdump -p 17 -v position,velocity,spin,force "$tmp/$1/run.nc" |
        sed -n '/^data:/,$p'
}
sphere=$(numbers sphere 2)
clump=$(numbers clump 1)
lines=$(wc -l <<< "$sphere")
if [ "$lines" -gt 300 ] && [ "$sphere" = "$clump" ]; then
    echo "ok   a clump of one sphere moves as a sphere does, to the last bit of $lines lines"
    passed=$((passed + 1))
else
    echo "FAIL a clump of one sphere does not move as a sphere ($lines lines)"
    failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
