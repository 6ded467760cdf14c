#!/usr/bin/env bash
# bench/superquadrics.sh [GRAINS] - grain-steps a second and core of a settled bed of superquadrics on
# one core, contact loop, search and motion together: ellipsoids of aspect 1.25 and blocks of blockiness
# 8. Target: 200,000. (Debian's LIGGGHTS is built without superquadrics and cannot be timed beside.)
set -euo pipefail
cd "$(dirname "$0")/.."
grains=${1:-1000}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s SHAPE=superquadric CONTACT=hertz_mindlin silt
silt=$(make -s SHAPE=superquadric CONTACT=hertz_mindlin where)
value() {
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}
bed() { # NAME KEYS
    cat > "$tmp/$1.ini" << END
[modules]
shape   = superquadric
contact = hertz_mindlin
[domain]
size = 24 24 $(awk -v n="$grains" 'BEGIN { print 30 + 0.07 * n }') mm
[grains a]
$2
diameter  = 2 mm
density   = 2500 kg/m3
count     = $grains
fill      = settle
material  = stone
[material stone]
young       = 5 MPa
poisson     = 0.3
restitution = 0.4
friction    = 0.5
[run]
dt            = 10 us
end           = 0.02 s
settle_energy = 1e-4
[output]
bed = end
END
    OMP_NUM_THREADS=1 timeout "${LIMIT:-300}" "$silt" "$tmp/$1.ini" -o "$tmp/$1" > "$tmp/log" 2>&1 ||
        { tail -n 3 "$tmp/log"; exit 1; }
    printf '%-11s %8.0f grain-steps/s, %.2f contacts a grain\n' "$1" \
        "$(value "$tmp/$1" grain_steps_per_second)" "$(value "$tmp/$1" contacts_per_grain)"
}
bed ellipsoids "half_axes = 1 1 1.25"
bed blocks "blockiness = 8"
if ! command -v liggghts > /dev/null; then
    echo "(liggghts is not installed and left out; apt-get install liggghts)"
elif (cd "$tmp" && echo 'atom_style superquadric' | liggghts 2>&1) | grep -q 'Invalid atom style'; then
    echo "(this LIGGGHTS is built without superquadrics, as Debian's is: nothing to time beside)"
fi
