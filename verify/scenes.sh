#!/usr/bin/env bash
# verify/scenes.sh - the shipped scenes, in short form where they are long, against their references;
# what each binary holds; the same bits on any number of threads; signals; guards; outputs.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0

verdict() { # status, text
    if [ "$1" = 0 ]; then
        passed=$((passed + 1))
        echo "ok   $2"
    else
        failed=$((failed + 1))
        echo "FAIL $2"
        tail -n 12 "$tmp/log" 2> /dev/null | sed 's/^/     /'
    fi
}

value() { # DIR KEY: from summary.txt
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}

within() { # VALUE LIMIT: |VALUE| <= LIMIT
    awk -v x="$1" -v m="$2" 'BEGIN { exit !(x != "" && x == x + 0 && x <= m && -x <= m) }'
}

run() { # NAME [ARGUMENT...]: through run.sh, into $tmp/NAME
    local name=$1
    shift
    ./run.sh "$@" -o "$tmp/$name" > "$tmp/log" 2>&1
}

binary_of() {
    make -s $(build/release/front slots "$1") where
}

# The shipped scenes. The bed in short form: a fifth of the grains, six levels.
run settling scenes/settling.ini
verdict $? "settling.ini runs"
grep -q '^verdict = pass' "$tmp/settling/summary.txt"
verdict $? "settling.ini: terminal velocity within 0.1 % of the drag law's"
run bounce scenes/bounce.ini
verdict $? "bounce.ini runs"
grep -q '^verdict = pass' "$tmp/bounce/summary.txt"
verdict $? "bounce.ini: heights on restitution squared"
REAL=float run single scenes/bounce.ini
verdict $? "bounce.ini runs in single precision"
within "$(awk -v a="$(value "$tmp/single" rebound_4_error)" -v b="$(value "$tmp/bounce" rebound_4_error)" 'BEGIN { print a - b }')" 1e-4
verdict $? "and comes to the heights of double within 1e-4, and not to its bits: $(value "$tmp/single" rebound_4_error)"
grep -q '^ledger = closes' "$tmp/single/summary.txt" && ! cmp -s "$tmp/single/run.nc" "$tmp/bounce/run.nc"
verdict $? "its ledger closes"
# Outputs come at the times asked, within a step of the grains, and leave the run as it was.
last_position() { # DIR
    ncdump -p 17,17 -v position "$tmp/$1/run.nc" | tail -n 2 | head -n 1
}
run often scenes/bounce.ini "output.every=13.7 ms" "run.end=310 ms"
ncdump -v time "$tmp/often/run.nc" | sed -n '/^ time =/,$p' | tr -d ' ;}' | tr ',=' '\n\n' | grep '^[0-9]' |
    awk -v dt="$(sed -n 's/^ *steps *\([^ ]*\) s for the grains.*/\1/p' "$tmp/log" | head -n 1)" -v every=0.0137 '
        { d = $1 - (NR - 1) * every; if (NR < 24 && (d < -1e-9 || d > dt + 1e-9)) bad = 1 }
        END { exit bad || NR != 24 || !(dt > 0) }'
verdict $? "outputs within a step of their times"
run seldom scenes/bounce.ini "run.end=310 ms"
[ -n "$(last_position often)" ] && [ "$(last_position often)" = "$(last_position seldom)" ]
verdict $? "and the same bits at the end as without them"
run darcy scenes/darcy_column.ini
verdict $? "darcy_column.ini runs"
grep -q '^verdict = pass' "$tmp/darcy/summary.txt"
verdict $? "darcy_column.ini: on the exact layered solution to 1e-6"
run channel scenes/channel.ini
verdict $? "channel.ini runs"
grep -q '^verdict = pass' "$tmp/channel/summary.txt" && grep -q '^drop_drop = .* Pa' "$tmp/channel/summary.txt"
verdict $? "channel.ini: the profile on its parabola, the probe in the summary"
run cavity scenes/lid_cavity.ini "domain.cells=32 32 1" "fluid.dt=10 ms" reference.tolerance=0.01
verdict $? "lid_cavity.ini in short form runs"
grep -q '^verdict = pass' "$tmp/cavity/summary.txt"
verdict $? "lid_cavity.ini: on the converged centre lines, $(value "$tmp/cavity" cavity_error)"
run carried scenes/settling.ini modules.fluid=prescribed modules.reference=none fluid.field=file \
    "fluid.file=$tmp/settling/run.nc"
verdict $? "a flow from the run.nc of another run carries a grain"
! ldd "$(make -s $(build/release/front slots scenes/settling.ini modules.fluid=prescribed modules.reference=none) where)" | grep -q fftw
verdict $? "its binary links no FFTW"
run drum scenes/drum.ini "run.end=0.6 s"
verdict $? "drum.ini in short form runs"
awk -v a="$(value "$tmp/drum" bed_angle)" 'BEGIN { exit !(a < -20 && a > -45) }'
verdict $? "drum.ini: its surface has risen with the wall, $(value "$tmp/drum" bed_angle) degree"
run funnel scenes/funnel.ini "run.end=0.3 s"
verdict $? "funnel.ini in short form runs"
awk -v m="$(value "$tmp/funnel" outlet_mass)" 'BEGIN { exit !(m > 0.001) }'
verdict $? "funnel.ini: grains leave through the mesh's outlet, $(value "$tmp/funnel" outlet_mass) kg"
run level_set scenes/level_set.ini "run.end=0.11 s" -j 3
verdict $? "level_set.ini in short form runs"
run level_set_1 scenes/level_set.ini "run.end=0.11 s" -j 1
command -v ncdump > /dev/null || ./run.sh install netcdf-bin > "$tmp/log" 2>&1
numbers_of() { ncdump -p 17 "$tmp/$1/run.nc" | sed -n '/^data:/,$p'; }
cmp -s <(numbers_of level_set_1) <(numbers_of level_set) && [ "$(numbers_of level_set_1 | wc -l)" -gt 60 ]
verdict $? "level_set.ini: the same bits on 1 and 3 threads"
run triaxial scenes/triaxial.ini "run.end=0.1 s"
verdict $? "triaxial.ini in short form runs"
awk -v p="$(value "$tmp/triaxial" wall_left_stress)" 'BEGIN { exit !(p > 18e3 && p < 22e3) }'
verdict $? "triaxial.ini: the servo holds 20 kPa within 10 %, $(value "$tmp/triaxial" wall_left_stress) Pa"
short=("domain.size=12.25 12.25 40 mm" "domain.cells=3 3 24" "grains beads.count=2000" flow.steps=6 "run.end=0.18 s")
run bed scenes/packed_bed.ini "${short[@]}"
verdict $? "packed_bed.ini in short form runs"
within "$(value "$tmp/bed" error_law_profile)" 0.015
verdict $? "packed bed: drop over its porosity profile, $(value "$tmp/bed" error_law_profile)"
within "$(value "$tmp/bed" plateau_error)" 0.015
verdict $? "packed bed: plateau against the buoyant weight, $(value "$tmp/bed" plateau_error)"
within "$(value "$tmp/bed" u_mf_error)" 0.05
verdict $? "packed bed: fluidisation velocity, $(value "$tmp/bed" u_mf_error)"
for s in settling bounce bed drum funnel level_set triaxial; do
    grep -q '^ledger = closes' "$tmp/$s/summary.txt"
    verdict $? "$s: the ledger closes"
done
for f in drum/bed.png funnel/bed.png level_set/bed.png triaxial/force_chains.png bed/pressure_drop.png bed/bed.png bed/series.png bed/run.xmf settling/settling.png bounce/rebound.png darcy/head.png \
    channel/velocity.png channel/pressure.png cavity/vertical.png bed/porosity.png; do
    [ -s "$tmp/$f" ]
    verdict $? "$f is drawn"
done
grep -q '^pressure_drop_1_simulated = .* Pa' "$tmp/bed/summary.txt"
verdict $? "summary.txt holds the table"
for t in motion sort search lists contacts gather ledger; do
    awk -v x="$(value "$tmp/bed" time_$t)" 'BEGIN { exit !(x > 0) }' || break
done
verdict $? "each part of the grains' step has its time ($t: $(value "$tmp/bed" time_$t) s)"

# A binary holds what its scene requires.
dry=$(binary_of scenes/bounce.ini)
! ldd "$dry" | grep fftw > /dev/null # not -q: it would end the pipe early, which counts as a failure
verdict $? "the binary of the dry scene links no FFTW"
! nm "$dry" | grep -E ' T (coupling_|poisson_|pressure_)' > /dev/null
verdict $? "nor does it hold the coupling or the pressure solve"
ldd "$(binary_of scenes/packed_bed.ini)" | grep -q fftw
verdict $? "that of the packed bed does link it"

# The same bits on 1, 2, 3, 7 and 16 threads.
wet=$(binary_of scenes/packed_bed.ini)
for j in 1 2 3 7 16; do
    "$wet" scenes/packed_bed.ini "${short[@]}" "run.end=0.02 s" "run.settle_energy=1e-3" \
        "flow.velocity=20 mm/s" flow.steps=1 flow.velocity_end=same -o "$tmp/j$j" -j $j > "$tmp/log" 2>&1
    if command -v ncdump > /dev/null; then
        ncdump -p 17 "$tmp/j$j/run.nc" | sed -n '/^data:/,$p' > "$tmp/j$j.txt"
    else
        grep -v -E '^(date|time_|wall|threads|grain_steps_per|settling_wall)' "$tmp/j$j/summary.txt" > "$tmp/j$j.txt"
    fi
    [ -s "$tmp/j$j.txt" ] && cmp -s "$tmp/j1.txt" "$tmp/j$j.txt"
    verdict $? "the same bits on 1 and $j threads"
done

# A signal in the middle: outputs complete up to there, exit 130 and 143.
for signal in INT TERM; do
    "$wet" scenes/packed_bed.ini "${short[@]}" run.settle_energy=0.5 "run.end=100 s" -o "$tmp/$signal" > "$tmp/log" 2>&1 &
    pid=$!
    sleep 3
    if [ $signal = INT ]; then # and a second run to the same folder
        "$dry" scenes/bounce.ini -o "$tmp/$signal" > "$tmp/second" 2>&1
        [ $? = 4 ] && grep -q "another run writes to this folder" "$tmp/second"
        verdict $? "a folder that another run writes to is refused"
    fi
    kill -$signal $pid
    wait $pid
    status=$?
    [ $status = $([ $signal = INT ] && echo 130 || echo 143) ] && [ -s "$tmp/$signal/run.nc" ] && [ -s "$tmp/$signal/summary.txt" ]
    verdict $? "SIG$signal in the middle of a run: exit $status, outputs complete"
done

# Guards: what, where, when, exit 3, the state kept.
"$wet" scenes/packed_bed.ini "${short[@]}" "material beads.young=0.5 kPa" "run.dt=0.2 ms" run.force=on -o "$tmp/soft" > "$tmp/log" 2>&1
[ $? = 3 ] && grep -q -E 'grain [0-9]+ overlaps (grain|wall) .* at t = ' "$tmp/log" && [ -s "$tmp/soft/crash.nc" ]
verdict $? "grains too soft: exit 3, which grain, when, crash.nc"
"$wet" scenes/packed_bed.ini "${short[@]}" run.settle_energy=0.5 "flow.velocity=2 m/s" "flow.velocity_end=2.1 m/s" run.force=on \
    "fluid.dt=5 ms" -o "$tmp/fast" > "$tmp/log" 2>&1
[ $? = 3 ]
verdict $? "a flow that outruns its step: exit 3"
"$wet" scenes/packed_bed.ini "${short[@]}" run.settle_energy=0.5 "domain.cells=12 12 40" coupling.porosity_min=0.35 -o "$tmp/full" > "$tmp/log" 2>&1
[ $? = 3 ] && grep -q 'the fluid fraction of cell' "$tmp/log"
verdict $? "a cell full of grains: exit 3, which cell"
./run.sh check scenes/packed_bed.ini > "$tmp/log" 2>&1
[ $? = 0 ] && grep -q 'nearest limit' "$tmp/log"
verdict $? "check reports the limits"
./run.sh modules > "$tmp/log" 2>&1
[ $? = 0 ] && [ "$(grep -c ' = ' "$tmp/log")" -ge 24 ]
verdict $? "modules lists every answer"
./run.sh keys > "$tmp/log" 2>&1
[ $? = 0 ] && grep -q 'material.young' "$tmp/log" && grep -q 'flow.velocity_end' "$tmp/log"
verdict $? "keys lists every key"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
