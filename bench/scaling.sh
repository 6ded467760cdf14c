#!/usr/bin/env bash
# bench/scaling.sh [quick] - how the contact loop of silt grows: with the number of grains (the bed of
# bench/dem.ini side by side) and with threads; what identical bits cost. Medians of three rounds in
# which the cases take turns.
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
. bench/dem.sh
rounds=3
[ "$quick" = quick ] && rounds=1
threads=1
for j in 2 $(nproc); do
    [ "$j" -gt "$(nproc)" ] || [[ " $threads " == *" $j "* ]] || threads+=" $j"
done
float=$(single CONTACT=hertz_mindlin)
settled

: > "$tmp/figures"
timed() { # NAME BINARY GRAINS THREADS
    local steps
    [ -n "$2" ] || return 0
    steps=$(awk -v n="$3" -v j="$4" -v q="$quick" 'BEGIN { print int((q == "quick" ? 8e7 : 1.6e8) * (j > 4 ? 4 : j) / n) }')
    silt "$2" "$3" "$4" "$steps" || return 0
    echo "rate $1 $3 $4 $(summary grain_steps_per_second)" >> "$tmp/figures"
    echo "bytes $1 $3 $4 $(cat "$tmp/peak")" >> "$tmp/figures"
}

grains="10000 100000 1000000"
for ((round = 0; round < rounds; round++)); do
    for n in $grains; do
        for j in $threads; do
            timed double "$plain" "$n" "$j"
            timed float "$float" "$n" "$j"
        done
    done
done

ratio() { # A B FORMAT
    awk -v a="$1" -v b="$2" -v f="$3" 'BEGIN { if (a == "-" || b == "-") print "-"; else printf f, a / b }'
}

printf '\n%-8s %8s %8s %14s %10s %12s %12s\n' real grains threads "ns a step" growth speed-up "peak, MiB"
for kind in double float; do
    for j in $threads; do
        for n in $grains; do
            rate=$(median "$tmp/figures" "rate $kind $n $j")
            [ "$rate" != - ] || { printf '%-8s %8d %8d %14s\n' $kind "$n" "$j" - && continue; }
            printf '%-8s %8d %8d %14s %10s %12s %12s\n' $kind "$n" "$j" "$(ratio 1e9 "$rate" %.1f)" \
                "$(ratio "$(median "$tmp/figures" "rate $kind 10000 $j")" "$rate" %.2f)" \
                "$(ratio "$rate" "$(median "$tmp/figures" "rate $kind $n 1")" %.2f)" \
                "$(ratio "$(median "$tmp/figures" "bytes $kind $n $j")" 1048576 %.0f)"
        done
    done
done
echo "ns of a grain and step; growth over 10,000 grains; speed-up over one thread"

# What identical bits cost, and other designs, on the same bed.
make -s build/release/bench/designs
echo
for j in $threads; do
    OMP_NUM_THREADS=$j build/release/bench/designs bench/dem.ini "grains g.fill=file" \
        "grains g.file=$(bed text 10000)" output.bed=none
done
