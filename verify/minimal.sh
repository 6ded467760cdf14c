#!/usr/bin/env bash
# verify/minimal.sh - model only what a scene requires: of every shipped scene what its binary holds, and
# what that saves. The same scene with every slot filled, by answers that do nothing there (no rolling
# friction, bonds without stiffness, no adhesion, a fluid without viscosity that is at rest), comes
# to the same end; both are timed, in turns. Fails where a binary holds more than its scene asks for.
#   minimal.sh [quick]   quick: one run each of the smallest scenes, for the check
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0
repeats=3
mapfile -t scenes < <(cd scenes && ls ./*.ini | sed 's|^\./||; s|\.ini$||')
[ "${1:-}" = quick ] && repeats=1 && scenes=(bounce settling darcy_column)

# What shortens a scene: some seconds at most, of the start alone.
short_of() {
    case $1 in
        hopper) echo "run.end=30 ms;reference.after=10 ms;reference.until=30 ms" ;;
        packed_bed) echo "grains beads.count=2000;domain.size=12.25 12.25 55 mm;domain.cells=3 3 30;flow.steps=2;flow.hold=30 ms;run.end=60 ms" ;;
        channel | lid_cavity) echo "run.end=0.2 s" ;;
        angle_of_repose | drum | funnel | level_set) echo "run.end=50 ms" ;;
        clumps | ellipsoids | fluidised_bed | triaxial) echo "run.end=5 ms" ;;
        letters | prism_hopper | shape_discharge | cone_pair_hopper) echo "run.end=10 ms" ;;
    esac
}

word() { # SCENE SECTION KEY
    awk -v s="[$2]" -v k="$3" '
        /^\[/ { in_it = index($0, s) == 1 }
        in_it && $1 == k { sub(/^[^=]*= */, ""); sub(/ *;.*/, ""); print; exit }' "$1"
}

# Overrides that fill the slots which the scene leaves empty, one a line.
fill_of() {
    local scene=$1 names name
    has() { [ -n "$(word "$scene" modules "$1")" ]; }
    mapfile -t names < <(sed -n 's/^\[material \(.*\)\].*/\1/p' "$scene")
    if has contact; then
        has rolling || echo modules.rolling=constant_torque
        has bond || echo modules.bond=contact_bond
        echo modules.cohesion=van_der_waals
        echo "cohesion.separation_min=1 nm"
        echo "cohesion.range=10 nm"
        for name in "${names[@]}"; do
            has rolling || echo "material $name.rolling_friction=0"
            echo "material $name.bond_stiffness=0 N/m"
            echo "material $name.bond_stiffness_shear=0 N/m"
            echo "material $name.bond_strength=0 N"
            echo "material $name.bond_strength_shear=0 N"
            echo "material $name.hamaker=0 J"
        done
    fi
    if ! has fluid && [ "$(word "$scene" modules reference)" != rebound ]; then # which has none
        echo modules.fluid=prescribed
        echo "fluid.density=1e-9 kg/m3"
        echo "fluid.viscosity=1e-30 Pa s"
        echo "fluid.velocity=0 0 1e-30 m/s"
        echo "domain.cells=8 8 8"
        echo "fluid.dt=0.1 ms"
    fi
    has drag || echo modules.drag=stokes
    has porosity || [ "$(word "$scene" grains\  diameter)" = "" ] || echo modules.porosity=divided
}

libraries() {
    readelf -d "$1" | sed -n 's/.*NEEDED.*\[lib\([a-z0-9_]*\)[^]]*\].*/\1/p' | grep -v -E '^(c|m|gcc_s)$' | xargs
}

functions() {
    nm --defined-only "$1" | grep -c -i ' t '
}

# Core time of a run.
timed() { # BINARY DIR ARGUMENTS...
    local binary=$1 dir=$2
    shift 2
    TIMEFORMAT='%U %S'
    { time "$binary" "$@" -o "$dir" -j 1 > "$tmp/log" 2>&1; } 2>&1 | awk '{ print $1 + $2 }'
}

median() {
    sort -g | awk '{ x[NR] = $1 } END { print (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2 }'
}

# Answers of slots in a binary that its scene did not ask for: the one per slot that exports
# SLOT_about is what was linked; what the scene asks for is what front says.
foreign() { # BINARY SCENE...
    local binary=$1 held asked shape file
    shift
    held=$(gdb -batch -ex 'info sources' "$binary" 2> /dev/null | tr ',' '\n' |
        grep -o -E '/(shapes|contact|drag|porosity|reference|forces|solver/fluid)/[a-z_/0-9]*\.c' || :)
    [ -n "$held" ] || held=$(readelf --debug-dump=info "$binary" 2> /dev/null |
        sed -n 's/.*DW_AT_name .*: \([a-z_/0-9]*\.c\)$/\/\1/p' |
        grep -E '^/(shapes|contact|drag|porosity|reference|forces|solver/fluid)/')
    asked=$(build/release/front slots "$@" | tr ' ' '\n' | sed 's/^[A-Z]*=//' | tr '+' '\n')
    shape=$(sed 's/.*SHAPE=\([a-z_]*\).*/\1/' <<< "$(build/release/front slots "$@")")
    while read -r file; do
        # the geometry of polyhedra goes with the shapes that name it
        [[ $file == /shapes/geometry/* ]] && grep -q '"geometry/' "shapes/$shape.c" && continue
        grep -q -x "$(basename "$file" .c)" <<< "$asked" || echo "$file"
    done < <(sort -u <<< "$held")
}

mkdir -p build && flock build/lock make -s -j"$(nproc)" build/release/front
printf '%-14s %7s %7s %5s %5s %9s %9s %6s  %s\n' scene KiB filled func. filled 'core, s' 'filled, s' gain libraries
for name in "${scenes[@]}"; do
    scene=scenes/$name.ini
    mapfile -t -d ';' short < <(printf '%s' "$(short_of "$name")")
    mapfile -t fill < <(fill_of "$scene")
    lean=$(./run.sh build "$scene" "${short[@]}") || { bad=1; continue; }
    extra=$(foreign "$lean" "$scene")
    [ -n "$(word "$scene" modules fluid)" ] || [[ " $(libraries "$lean") " != *" fftw3 "* ]] || extra+=" FFTW"
    full=$(./run.sh build "$scene" "${short[@]}" "${fill[@]}") || { bad=1; continue; }
    : > "$tmp/lean"
    : > "$tmp/full"
    for _ in $(seq $repeats); do
        timed "$lean" "$tmp/a" "$scene" "${short[@]}" >> "$tmp/lean"
        timed "$full" "$tmp/b" "$scene" "${short[@]}" "${fill[@]}" >> "$tmp/full"
    done
    why=$(grep -m 1 -E '^(scenes|silt:|command line)' "$tmp/log" | grep -v warning)
    a=$(median < "$tmp/lean")
    b=$(median < "$tmp/full")
    kib() { size "$1" | awk 'NR == 2 { printf "%.0f", ($1 + $2) / 1024 }'; }
    printf '%-14s %7s %7s %5s %5s %9s %9s %6s  %s\n' "$name" "$(kib "$lean")" "$(kib "$full")" \
        "$(functions "$lean")" "$(functions "$full")" "$a" \
        "$([ -s "$tmp/b/summary.txt" ] && echo "$b" || echo refused)" \
        "$([ -s "$tmp/b/summary.txt" ] && awk -v a="$a" -v b="$b" 'BEGIN { printf "%.2fx", b / a }' || echo -)" \
        "$(libraries "$lean")"
    [ -s "$tmp/b/summary.txt" ] || echo "    filled: ${why:0:150}"
    if [ -n "$extra" ]; then
        echo "    FAIL: it holds $extra, which the scene does not ask for"
        bad=1
    fi
    rm -rf "$tmp/a" "$tmp/b"
done
exit $bad
