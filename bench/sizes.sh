#!/usr/bin/env bash
# bench/sizes.sh [quick] - what a contact costs where sizes differ: beds of about 46,000 grains, of one
# size, and of 10:1 and 50:1 in diameter on the grading of least voids, of which a part
# sqrt(d / largest) is finer than d [Fuller07], cut off at the least. In the last one the largest grains
# touch about a thousand others. Each bed is made once and kept in build/bench (a minute or three of one
# core; quick: only those that are there already and the first); then steps on all of them in turns, by
# one thread, medians of three rounds. Bits and speeds do not hang on the threads that settled it.
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
. bench/dem.sh

case_of() { # RATIO: least, largest diameter in mm, porosity to grow to, settling in s, step in us, steps timed
    case $1 in
        1) echo 11.7 11.7 0.40 0.2 30 400 ;;
        10) echo 5.6 56 0.28 0.3 16 400 ;;
        50) echo 4 200 0.25 0.35 12 400 ;;
    esac
}

# The sizes of a bed, as keys of its scene.
sizes_of() { # RATIO
    local least most
    read -r least most _ <<< "$(case_of "$1")"
    if [ "$1" = 1 ]; then
        printf 'grains g.sizes=one\ngrains g.diameter=%s mm\n' "$least"
        return
    fi
    awk -v a="$least" -v b="$most" 'BEGIN {
        print "diameter mm, fraction"
        for (k = 0; k <= 24; k++) {
            d = a * (b / a) ^ (k / 24)
            print d ", " (sqrt(d) - sqrt(a)) / (sqrt(b) - sqrt(a))
        } }' > "$tmp/grading_$1.csv"
    printf 'grains g.sizes=curve\ngrains g.size_file=%s\n' "$tmp/grading_$1.csv"
}

cmp -s bench/sizes.ini "$beds/sizes.ini" || rm -f "$beds"/sizes_*.nc
cp bench/sizes.ini "$beds/sizes.ini"
ratios=""
for r in 1 10 50; do
    read -r _ _ porosity settling dt _ <<< "$(case_of "$r")"
    if [ ! -e "$beds/sizes_$r.nc" ]; then
        [ "$quick" != quick ] || [ "$r" = 1 ] || { echo "(no bed of $r:1 at hand: bench/sizes.sh makes it)" && continue; }
        echo "(a bed with diameters $r:1 is made first)" >&2
        mapfile -t sizes < <(sizes_of "$r")
        "$plain" bench/sizes.ini "${sizes[@]}" "grains g.porosity=$porosity" "run.dt=$dt us" \
            "run.end=$settling s" -o "$tmp/settled" > "$tmp/log" 2>&1 ||
            { tail -n 3 "$tmp/log" >&2 && continue; }
        cp "$tmp/settled/bed.nc" "$beds/sizes_$r.nc"
    fi
    ratios+=" $r"
done

rounds=3
[ "$quick" = quick ] && rounds=1
: > "$tmp/figures"
for ((round = 0; round < rounds; round++)); do
    for r in $ratios; do
        read -r least _ _ _ dt steps <<< "$(case_of "$r")"
        "$plain" bench/sizes.ini "grains g.fill=file" "grains g.file=$beds/sizes_$r.nc" \
            "grains g.diameter=$least mm" output.bed=none "run.dt=$dt us" \
            "run.end=$((dt * steps)) us" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1 ||
            { tail -n 3 "$tmp/log" >&2 && continue; }
        rate=$(summary grain_steps_per_second)
        per=$(summary contacts_per_grain)
        {
            echo "made $r $(summary g_made)"
            echo "per $r $per"
            echo "builds $r $(summary list_builds)"
            awk -v a="$rate" -v b="$per" -v r="$r" 'BEGIN { printf "ns %s %.2f\n", r, 1e9 / (a * b) }'
        } >> "$tmp/figures"
    done
done

printf '%-10s %8s %17s %12s %14s %10s %8s\n' diameters grains "contacts a grain" "ns a step" "ns a contact" \
    "over 1:1" lists
for r in $ratios; do
    ns=$(median "$tmp/figures" "ns $r")
    per=$(median "$tmp/figures" "per $r")
    one=$(median "$tmp/figures" "ns 1")
    [ "$ns" != - ] || continue
    printf '%-10s %8s %17.2f %12.1f %14.1f %10.2f %8s\n' "$r:1" "$(median "$tmp/figures" "made $r")" "$per" \
        "$(awk -v a="$ns" -v b="$per" 'BEGIN { print a * b }')" "$ns" \
        "$(awk -v a="$ns" -v b="$one" 'BEGIN { print a / b }')" "$(median "$tmp/figures" "builds $r")"
done
echo "one thread; all of a step (search and motion too) over the grains that touch; asked: at most twice 1:1"
