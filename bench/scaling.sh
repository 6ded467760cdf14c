#!/usr/bin/env bash
# bench/scaling.sh [quick] - how the contact loop of silt grows: with the number of grains (the bed of
# bench/dem.ini side by side), with threads, and with the ratio of the largest diameter to the smallest.
# Medians of three rounds in which the cases take turns.
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

# Sizes: a bed each, settled once; then the same steps on it, with the time of a contact in each.
echo
case_of() { # RATIO: least, largest diameter in mm, the steps of the grains in us, steps timed, MPa
    case $1 in
        1) echo 24.9 25.1 100 600 5 ;;
        10) echo 10 100 40 600 5 ;;
        50) echo 4 200 15 200 20 ;;
    esac
}
ratios="1 10 50"
cmp -s bench/sizes.ini "$beds/sizes.ini" || rm -f "$beds"/sizes_*.nc
cp bench/sizes.ini "$beds/sizes.ini"
[ "$quick" != quick ] || [ -e "$beds/sizes_50.nc" ] || ratios="1 10" # half a minute to settle
for r in $ratios; do
    read -r least most dt _ young <<< "$(case_of "$r")"
    if [ ! -e "$beds/sizes_$r.nc" ]; then
        echo "(a bed with diameters $r:1 settles first)" >&2
        "$plain" bench/sizes.ini "grains g.sizes=uniform" "grains g.diameter_min=$least mm" \
            "grains g.diameter_max=$most mm" "run.dt=$dt us" \
            "material g.young=$young MPa" -o "$tmp/settled" > "$tmp/log" 2>&1 ||
            { tail -n 3 "$tmp/log" >&2 && continue; }
        cp "$tmp/settled/bed.nc" "$beds/sizes_$r.nc"
    fi
    $tile text "$beds/sizes_$r.nc" 0.5 0.5 1 1 > "$tmp/sizes_$r.text"
done

for ((round = 0; round < rounds; round++)); do
    for r in $ratios; do
        read -r least most dt steps young <<< "$(case_of "$r")"
        "$plain" bench/sizes.ini "grains g.fill=file" "grains g.file=$tmp/sizes_$r.text" \
            "grains g.diameter=$least mm" "grains g.porosity=auto" output.bed=none "run.dt=$dt us" \
            "material g.young=$young MPa" \
            "run.end=$((dt * steps)) us" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1 ||
            { tail -n 3 "$tmp/log" >&2 && continue; }
        made=$(summary g_made)
        per=$(summary contacts_per_grain)
        rate=$(summary grain_steps_per_second)
        echo "made $r $made" >> "$tmp/figures"
        printf 'per %s %.2f\n' "$r" "$per" >> "$tmp/figures"
        echo "builds $r $(summary list_builds)" >> "$tmp/figures"
        echo "ns $r $(ratio 1e9 "$(awk -v a="$rate" -v b="$per" 'BEGIN { print a * b }')" %.2f)" >> "$tmp/figures"
    done
done
printf '%-10s %8s %20s %12s %15s %14s\n' diameters grains "contacts a grain" "ns a step" "ns a contact" "over 1:1"
for r in $ratios; do
    ns=$(median "$tmp/figures" "ns $r")
    per=$(median "$tmp/figures" "per $r")
    printf '%-10s %8s %20s %12s %15s %14s\n' "$r:1" "$(median "$tmp/figures" "made $r")" "$per" \
        "$(awk -v a="$ns" -v b="$per" 'BEGIN { printf "%.1f", a * b }')" "$ns" \
        "$(ratio "$ns" "$(median "$tmp/figures" "ns 1")" %.2f)"
done
echo "one thread; all of a step (search and motion too) over the grains that touch; uniform by mass"
