#!/usr/bin/env bash
# verify/threads.sh - the same bits on 1, 2, 3, 7 and 16 threads, for the granular scenes in short form and for a
# throng of grains of 10:1 in diameter, poured in, stirred and drained, with other laws and in single precision:
# every number of run.nc, contacts with their forces among them.
#   verify/threads.sh [CASE ...]          a scene of scenes/, or a case of the list below
#   FULL=1 verify/threads.sh              every law of every slot, other shapes and flows too (half an hour of a core)
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive} # more threads than processors
passed=0
failed=0
cases="hopper angle_of_repose drum funnel triaxial clumps throng throng_float throng_epsd throng_capillary"
[ "${FULL:-}" != 1 ] || cases+=" throng_constant_torque throng_viscous throng_matter throng_jiang throng_epsd_float
    throng_jkr throng_van_der_waals throng_contact_bond throng_parallel_bond throng_squeeze throng_hertz
    throng_hertz_mindlin_liu throng_linear hopper_float drum_float ellipsoids level_set letters prism_hopper
    cone_pair_hopper shape_discharge packed_bed fluidised_bed"
[ $# -gt 0 ] || set -- $cases
make -s build/release/front

throng() { # LAW: of any slot
    local slot="" material="" section="" cells="" contact=hertz_mindlin
    case $1 in
        hertz | hertz_mindlin_liu) contact=$1 ;;
        linear) contact=linear material="stiffness = 20 kN/m" ;;
        epsd | constant_torque) slot="rolling = $1" material="rolling_friction = 0.2" ;;
        viscous) slot="rolling = $1" material="rolling_viscosity = 0.3 s/m" ;;
        matter) slot="rolling = $1" material=$'rolling_friction = 0.2\ntorsion_friction = 0.1
rolling_stiffness = 1e-4 N m\ntorsion_stiffness = 1e-4 N m' ;;
        jiang) slot="rolling = $1" material="shape_parameter = 0.3" ;;
        capillary) slot="cohesion = $1" material=$'surface_tension = 0.07 N/m\nbridge_volume = 2e-12 m3' ;;
        jkr) slot="cohesion = $1" material="work_of_adhesion = 0.1 J/m2" ;;
        van_der_waals) slot="cohesion = $1" material="hamaker = 1e-14 J"
            section=$'[cohesion]\nseparation_min = 1 um\nrange = 0.1 mm' ;;
        contact_bond) slot="bond = $1" material=$'bond_stiffness = 1e4 N/m\nbond_stiffness_shear = 1e4 N/m
bond_strength = 0.01 N\nbond_strength_shear = 0.01 N' section=$'[bond]\ngap = 0.1 mm\ntime = 2 ms' ;;
        parallel_bond) slot="bond = $1" material=$'bond_stiffness = 1e10 Pa/m\nbond_stiffness_shear = 1e10 Pa/m
bond_strength = 1e4 Pa\nbond_strength_shear = 1e4 Pa' section=$'[bond]\ngap = 0.1 mm\ntime = 2 ms' ;;
        squeeze) slot=$'lubrication = squeeze\nfluid = prescribed' cells="cells = 6 5 10"
            section=$'[fluid]\ndensity = 1000 kg/m3\nviscosity = 1 mPa s\ndt = 0.1 ms\nvelocity = 0 0 0 m/s
[lubrication]\ngap_min = 10 um\nrange = 0.2 mm' ;;
    esac
    [ "$contact" = linear ] || material+=$'\nyoung = 20 MPa\npoisson = 0.3'
    [ "$contact" = hertz ] || material+=$'\nfriction = 0.4'
    cat <<TEXT
[modules]
contact = $contact
$slot
[domain]
size = 24 20 40 mm
y    = periodic
$cells
[grains g]
sizes        = uniform
diameter_min = 0.6 mm
diameter_max = 6 mm
density      = 2500 kg/m3
count        = 3000
fill         = random
from         = 0 0 5 mm
to           = 24 20 30 mm
velocity     = 0 0 -0.5 m/s
[material g]
restitution  = 0.6
$material
$section
[insert rain]
from     = 0 0 33 mm
to       = 24 20 40 mm
rate     = 20000 1/s
velocity = 0 0 -1 m/s
[delete drain]
from = 0 0 0 mm
to   = 10 20 2 mm
[wall stirrer]
kind   = rectangle
corner = 6 10 4 mm
edge1  = 12 0 0 mm
edge2  = 0 0 12 mm
spin   = 50 rad/s
spin_axis = 0 0 1
spin_point = 12 10 10 mm
[output]
contacts = on
[run]
dt          = 2 us
overlap_max = 0.95
TEXT
}

same() { # CASE
    local name=$1 scene real="" slots binary keys=("run.end=40 ms" "output.every=20 ms") j
    [[ $name != *_float ]] || real=float name=${name%_float}
    scene=scenes/$name.ini
    if [[ $name == throng* ]]; then
        scene=$tmp/$name.ini
        throng "${name#throng_}" > "$scene"
        keys=("run.end=20 ms" "output.every=10 ms")
    fi
    slots=$(build/release/front slots "$scene") || return 1
    # shellcheck disable=SC2086
    make -s REAL="${real:-double}" $slots silt || return 1
    # shellcheck disable=SC2086
    binary=$(make -s REAL="${real:-double}" $slots where)
    for j in 1 2 3 7 16; do
        if ! "$binary" "$scene" "${keys[@]}" -o "$tmp/$j" -j $j > "$tmp/log" 2>&1; then
            echo "FAIL $1: stopped on $j threads: $(tail -n 1 "$tmp/log")"
            failed=$((failed + 1))
            return 1
        fi
        # every number of run.nc by value where ncdump is there, else those of the summary
        if command -v ncdump > /dev/null; then
            ncdump -p 17 "$tmp/$j/run.nc" | sed -n '/^data:/,$p' > "$tmp/$j.sum"
        else
            grep -v -E '^(time_|wall|threads|grain_steps_per|date)' "$tmp/$j/summary.txt" > "$tmp/$j.sum"
        fi
        if [ -s "$tmp/$j.sum" ] && cmp -s "$tmp/1.sum" "$tmp/$j.sum"; then
            passed=$((passed + 1))
        else
            echo "FAIL $1: other bits on $j threads"
            failed=$((failed + 1))
            return 1
        fi
    done
    echo "ok   $1: the same bits on 1, 2, 3, 7 and 16 threads, $(wc -l < "$tmp/1.sum") lines, lists made" \
        "$(sed -n 's/^list_builds = \([^ ]*\).*/\1/p' "$tmp/1/summary.txt") times"
}

for case; do
    same "$case" || true
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
