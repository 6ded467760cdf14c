#!/usr/bin/env bash
# bench/peers.sh [quick] - the contact loop beside Debian's LIGGGHTS, LAMMPS and YADE: the same settled
# bed (bench/dem.ini), the same law, time step and distance of the lists, from rest, one after another
# in each of three rounds. Grain-steps a second and core, medians of the rounds. A program that is not
# installed is left out. silt's figure is that of its summary, all of a run but its end, with the first
# lists; theirs is of the steps after some that are not timed, without the first lists. silt takes eight
# times as many steps (in 90 steps of 100,000 grains its first lists were a sixth of the time).
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
. bench/dem.sh
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none

rounds=3
sizes="10000 100000"
[ "$quick" = quick ] && rounds=1
cores=1
[ "$(nproc)" -lt 2 ] || cores="1 2"
peers=()
for peer in liggghts:liggghts lmp:lammps yade:yade; do
    if command -v "${peer%:*}" > /dev/null; then
        peers+=("${peer%:*}")
    else
        echo "(${peer%:*} is not installed and left out; apt-get install ${peer#*:})"
    fi
done
have() {
    [[ " ${peers[*]:-} " == *" $1 "* ]]
}

make -s -j"$(nproc)" CONTACT=hertz_mindlin ROLLING=epsd silt
rolling=$(make -s CONTACT=hertz_mindlin ROLLING=epsd where)
float=$(single CONTACT=hertz_mindlin)
float_rolling=$(single CONTACT=hertz_mindlin ROLLING=epsd)
settled

# Steps for about a second of a program that does so many grain-steps a second; at least 3.
steps() { # RATE GRAINS CORES
    awk -v r="$1" -v n="$2" -v c="$3" -v q="$quick" 'BEGIN {
        k = int(r * c / n * (q == "quick" ? 0.5 : 0.9)); print k < 3 ? 3 : k }'
}

note() { # NAME GRAINS CORES RATE BYTES
    echo "rate $1 $2 $3 $4" >> "$tmp/figures"
    echo "bytes $1 $2 $3 $5" >> "$tmp/figures"
}

run_silt() { # NAME BINARY GRAINS CORES [section.key=value ...]
    local name=$1 binary=$2 grains=$3 threads=$4
    shift 4
    [ -n "$binary" ] || return 0
    silt "$binary" "$grains" "$threads" "$(steps 1.6e8 "$grains" "$threads")" "$@" || return 0
    note "$name" "$grains" "$threads" "$(summary grain_steps_per_second)" "$(cat "$tmp/peak")"
    echo "touching $name $(summary contacts_per_grain)" >> "$tmp/touching"
}

# A peer that reads a data file, by mpirun where it has several cores (then its peak is not known).
run_peer() { # NAME GRAINS CORES PROGRAM INPUT [-var NAME VALUE ...]
    local name=$1 grains=$2 n=$3 program=$4 input=$5 k launch=() seconds
    shift 5
    have "$program" || return 0
    k=$(steps 5e6 "$grains" "$n")
    [ "$n" -eq 1 ] || launch=(mpirun -np "$n" --bind-to core)
    local file
    file=$(bed atoms "$grains")
    if ! OMP_NUM_THREADS=1 $peak "$tmp/peak" "${launch[@]}" "$program" -in "$input" -log "$tmp/log" -screen none \
        -var in "$file" -var relax $((k / 4 + 2)) -var steps "$k" "$@" > "$tmp/out" 2>&1 < /dev/null; then
        echo "($name does not run: $(cat "$tmp/out" "$tmp/log" 2> /dev/null | grep -v '^ *$' | tail -n 1))"
        return 0
    fi
    seconds=$(sed -n 's/^Loop time of \([^ ]*\) .*/\1/p' "$tmp/log" | tail -n 1)
    note "$name" "$grains" "$n" "$(awk -v n="$grains" -v k="$k" -v t="$seconds" 'BEGIN { print n * k / t }')" \
        "$(cat "$tmp/peak")"
}

run_yade() { # GRAINS CORES
    local grains=$1 n=$2 k nx ny seconds
    have yade || return 0
    k=$(steps 6e5 "$grains" "$n")
    read -r nx ny <<< "$(tiles "$grains")"
    if ! OMP_PROC_BIND=true $peak "$tmp/peak" yade -j"$n" -n -x bench/dem_yade.py "$(bed text "$grains")" \
        "$(awk -v n="$nx" 'BEGIN { print 0.04 * n }')" "$(awk -v n="$ny" 'BEGIN { print 0.04 * n }')" \
        $((k / 4 + 2)) "$k" > "$tmp/out" 2>&1 < /dev/null; then
        echo "(yade does not run: $(tail -n 1 "$tmp/out"))"
        return 0
    fi
    seconds=$(sed -n 's/^Loop time of \([^ ]*\) .*/\1/p' "$tmp/out" | tail -n 1)
    note yade "$grains" "$n" "$(awk -v n="$grains" -v k="$k" -v t="$seconds" 'BEGIN { print n * k / t }')" \
        "$(cat "$tmp/peak")"
}

epsd=(modules.rolling=epsd "material g.rolling_friction=0.1")
: > "$tmp/figures"
for ((round = 0; round < rounds; round++)); do
    for n in $cores; do
        for grains in $sizes; do
            run_silt silt "$plain" "$grains" "$n"
            run_silt silt_float "$float" "$grains" "$n"
            run_peer liggghts "$grains" "$n" liggghts bench/dem.lig -var rolling off
            run_peer lammps_granular "$grains" "$n" lmp bench/dem.lmp -var model granular
            run_peer lammps_history "$grains" "$n" lmp bench/dem.lmp -var model history
            # YADE is an order slower: once with the large bed
            [ "$grains" -eq 10000 ] || { [ $round -eq 0 ] && [ "$n" -eq 1 ] && [ "$quick" != quick ]; } || continue
            run_yade "$grains" "$n"
        done
        run_silt silt_epsd "$rolling" 10000 "$n" "${epsd[@]}"
        run_silt silt_epsd_float "$float_rolling" 10000 "$n" "${epsd[@]}"
        run_peer liggghts_epsd 10000 "$n" liggghts bench/dem.lig -var rolling epsd
    done
done

# Bytes per grain: the peak of the larger bed less that of the smaller over the difference of grains.
bytes() { # NAME
    local small large
    small=$(median "$tmp/figures" "bytes $1 10000 1")
    large=$(median "$tmp/figures" "bytes $1 100000 1")
    awk -v a="$small" -v b="$large" 'BEGIN { print a == "-" || b == "-" ? "-" : sprintf("%.0f", (b - a) / 90000) }'
}

row() { # NAME REFERENCE GRAINS CORES LABEL
    local rate own
    rate=$(median "$tmp/figures" "rate $1 $3 $4")
    own=$(median "$tmp/figures" "rate $2 $3 $4")
    [ "$rate" = - ] && [[ $1 != silt* ]] && return
    awk -v label="$5" -v n="$3" -v c="$4" -v r="$rate" -v own="$own" -v b="$(bytes "$1")" 'BEGIN {
        known = r != "-" && own != "-"
        printf "%-34s %7d %5d %9s %12s %14s\n", label, n, c, r == "-" ? "-" : sprintf("%.2f M", r / c / 1e6),
            known ? sprintf("%.2f", own / r) : "-", c == 1 && n == 100000 ? b : "" }'
}

printf '\n%-34s %7s %5s %9s %12s %14s\n' "" grains cores "per core" "silt over it" "bytes a grain"
for n in $cores; do
    for grains in $sizes; do
        row silt silt "$grains" "$n" "silt"
        row silt_float silt "$grains" "$n" "silt, float"
        row liggghts silt "$grains" "$n" "LIGGGHTS hertz history"
        row lammps_granular silt "$grains" "$n" "LAMMPS granular, restitution"
        row lammps_history silt "$grains" "$n" "LAMMPS gran/hertz/history"
        row yade silt "$grains" "$n" "YADE Mindlin"
    done
    row silt_epsd silt_epsd 10000 "$n" "silt, EPSD rolling"
    row silt_epsd_float silt_epsd 10000 "$n" "silt, EPSD rolling, float"
    row liggghts_epsd silt_epsd 10000 "$n" "LIGGGHTS, EPSD rolling"
done
echo "grain-steps per second and core; the median of $rounds round$([ $rounds -eq 1 ] || echo s)"
