#!/usr/bin/env bash
# verify/verify.sh - `make verify`: the verification cases at full size, as text in build/verify.txt and
# as the page verify/report/index.html (report.sh). With the studies it takes an hour;
# STUDIES=none: some minutes; STUDIES="packed_bed contact": these.
#   the shipped scenes against their references
#   a bed of uniform porosity: the drag law's pressure drop, two laws, two solvers
#   lid-driven cavities; the noise of the pressure when a grain crosses faces of cells
#   Beverloo's 5/2 power (beverloo.sh); a sandpile with three models of rolling (sandpile.sh)
#   every law of drag: its terminal velocity, its error against measured ones, its picture
#   grains of other shapes: long runs, packings, hoppers (dilated.sh, ellipsoids.sh, letters.sh,
#     shape_discharge.sh, shape_hoppers.sh)
#   the tests of all modules, in release builds, with every value that they compare
#   what each scene's binary holds, and what that saves (minimal.sh); the studies
#   pressure noise and self-disturbance of every porosity answer (coupling.sh)
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
report=build/verify.txt
keep=build/verify
rm -rf "$keep"
mkdir -p "$keep"/{scenes,tests,sections,studies}
bad=0

# A part of the report that is a table in text: its title, the command.
section() { # NAME TITLE COMMAND...
    local name=$1 title=$2
    shift 2
    echo
    echo "$title"
    { echo "$title"; "$@" 2>&1 || echo "  FAIL: $name ended with status $?"; } > "$keep/sections/$name.txt"
    tail -n +2 "$keep/sections/$name.txt"
}

# The laws of drag in a bed, each with its own program.
uniform_beds() {
    local t status=0
    for t in ergun_navier_stokes ergun_darcy kozeny_carman_navier_stokes kozeny_carman_darcy; do
        make -s build/release/verify/test_bed_$t
        build/release/verify/test_bed_$t > "$tmp/log" || status=1
        echo "  $t: $(tail -n 1 "$tmp/log")"
    done
    return $status
}

tests() {
    local t begin status=0
    make -s -j"$(nproc)" $(cd verify && ls test_*.c | sed 's|^|build/release/verify/|; s|\.c$||')
    for t in $(cd verify && ls test_*.c | sed 's/\.c$//'); do
        begin=$(date +%s.%N)
        build/release/verify/"$t" > "$keep/tests/$t.log" 2> /dev/null || status=1
        awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN { printf "%.2f\n", b - a }' > "$keep/tests/$t.seconds"
        echo "  $t: $(tail -n 1 "$keep/tests/$t.log")"
    done
    return $status
}

studies() {
    local s name begin status=0
    for s in scenes/studies/*.study; do
        name=$(basename "$s" .study)
        [[ " ${STUDIES:-$name} " == *" $name "* ]] || continue
        begin=$SECONDS
        ./run.sh study "$s" -o "$keep/studies/$name" > "$keep/studies/$name.out" 2> "$tmp/log"
        case $? in
            0) ;;
            1) # no variant within the error, or a point that is broken
                grep -q '^BROKEN' "$keep/studies/$name.out" && { echo "  $name: FAIL, a point is broken"; status=1; } ;;
            *) echo "  $name: FAIL $(tail -n 1 "$tmp/log")"; status=1 ;;
        esac
        echo $((SECONDS - begin)) > "$keep/studies/$name.seconds"
        grep -E '^(==|edge:|[0-9]+ points)|(^|: )(the cheapest|no variant)' "$keep/studies/$name.out" | sed "s/^/  /"
        echo "  $name took $((SECONDS - begin)) s"
    done
    return $status
}

value() {
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1/summary.txt"
}

{
    echo "silt $(git describe --always --dirty 2> /dev/null), $(date -u +%F), $(uname -srm), $(nproc) cores"
    echo
    echo "Shipped scenes against their references"
    for scene in scenes/*.ini; do
        name=$(basename "$scene" .ini)
        [ "$name" = fluidised_bed ] && continue # verify/fluidised_bed.sh, by hand
        if ! ./run.sh "$scene" -o "$keep/scenes/$name" > "$tmp/log" 2>&1; then
            echo "  $name: FAIL, it does not run"
            bad=1
            continue
        fi
        grep -E '^(reference:|terminal velocity)' "$tmp/log" | sed "s/^/  $name: /"
        # of a scene without a reference there is no verdict, but its ledger
        grep -q '^verdict = ' "$keep/scenes/$name/summary.txt" &&
            ! grep -q '^verdict = pass' "$keep/scenes/$name/summary.txt" && echo "  $name: FAIL"
        grep -q '^ledger = closes' "$keep/scenes/$name/summary.txt" || echo "  $name: FAIL, the ledger does not close"
        rm -f "$keep/scenes/$name"/*.nc
        echo "  $name: ledger $(sed -n 's/^ledger = //p' "$keep/scenes/$name/summary.txt"), wall time $(value "$keep/scenes/$name" wall_time) s"
    done
    section uniform_bed "A bed of uniform porosity gives the drag law's pressure drop (1e-6)" uniform_beds
    section coupling "What each answer of porosity/ costs in accuracy" verify/coupling.sh
    section cavity "Lid-driven cavity, 128 x 128 cells, against converged values (1 % of the lid's velocity)" \
        verify/cavity.sh
    section porosity_rate "Noise of the pressure, Pa, while one grain crosses faces of cells" \
        verify/porosity_rate.sh
    section beverloo "Beverloo's law: six circular orifices, C and k of the fit" verify/beverloo.sh
    section sandpile "A pile of discs with three models of rolling resistance, against Ai et al. 2011" verify/sandpile.sh
    section drag_settling "Every law of drag with an isolated sphere comes to its own terminal velocity, one-way" \
        verify/drag_settling.sh
    section drag_figures "Terminal velocity by every law against Brown and Lawler; pictures docs/drag_*.png" \
        verify/drag_figures.sh
    section packing "How densely spheres pack (one thread; 3 packings of 2000, 3000 poured)" verify/packing.sh
    section mass_error "Volume, centre and inertia over a grid against exact ones; its picture is below" \
        verify/mass_error.sh "$keep"
    section dilated "Dilated polyhedra: detectors of contacts (picture below), cores of nothing, stacks of ten cubes" \
        timeout 900 verify/dilated.sh "$keep"
    section ellipsoids "How densely ellipsoids without friction pack" timeout 900 verify/ellipsoids.sh
    section polyhedra_packing "How densely cubes and octahedra without friction pack" \
        timeout 1200 verify/polyhedra_packing.sh
    section letters "How densely letters pack" timeout 1200 verify/letters.sh
    section shape_discharge "Four shapes run out of a hopper: rate, angle of the heap" timeout 2400 verify/shape_discharge.sh
    section shape_hoppers "Prisms and cone pairs run out of a hopper: fraction left" timeout 3600 verify/shape_hoppers.sh
    section tests "Tests of all modules" tests
    echo
    echo "What each scene's binary holds, and what that saves"
    verify/minimal.sh | tee "$keep/minimal.txt"
    section studies "What accuracy costs, and where it breaks" studies
} 2>&1 | tee "$report"
grep -q FAIL "$report" && bad=1
rm -f "$keep/sections"/{tests,studies}.txt
verify/report.sh || bad=1
exit $bad
