#!/usr/bin/env bash
# verify/shape_hoppers.sh [FILLINGS] [section.key=value ...] - prisms and cone pairs run out of the hopper of
# [LiLiuJi23, figs 6 to 9], each from FILLINGS (5) random fillings: the fraction of grains left in it, least,
# mean and most of the fillings, against time after the gate. FULL=1: the paper's 1,000 grains with edges of
# 0.3 mm at 30 MPa (0.1 mm and 1 GPa there), 15 to 30 minutes of one core a filling: cone pairs then lock.
set -euo pipefail
cd "$(dirname "$0")/.."
fillings=${1:-5}
shift || true
out=out/shape_hoppers
gate=0.6
full=()
[ -z "${FULL:-}" ] || gate=0.75
mkdir -p "$out"
left() { # DIR: time since the gate, fraction left
    local t m
    t=$(ncdump -v sample_time "$1/run.nc" | sed -n '/^ sample_time =/,/;/p' | sed 's/.*=//' | tr -d ' \n;')
    m=$(ncdump -v slot_count "$1/run.nc" | sed -n '/^ slot_count =/,/;/p' | sed 's/.*=//' | tr -d ' \n;')
    paste <(tr ',' '\n' <<< "$t") <(tr ',' '\n' <<< "$m") |
        awk -v n="$2" -v g=$gate '$1 >= g && !(k++ % 8) { printf "%.2f %.4f\n", $1 - g, 1 - $2 / n }'
}
for scene in prism_hopper cone_pair_hopper; do
    : > "$out/$scene.all"
    grains=prisms
    [ $scene = prism_hopper ] || grains=pairs
    [ -z "${FULL:-}" ] || full=("grains $grains.count=1000" "grains $grains.to=140 50 795 mm" "grains $grains.dilation=0.3 mm"
        "material plastic.young=30 MPa" "wall gate.start=0.75 s" "wall gate.stop=0.85 s" "run.end=2.25 s")
    for k in $(seq "$fillings"); do
        ./run.sh "scenes/$scene.ini" "run.seed=$k" "${full[@]}" "$@" -o "$out/$scene.$k" > "$out/log" 2>&1 ||
            { tail -n 3 "$out/log"; exit 1; }
        left "$out/$scene.$k" "$(sed -n 's/^.*_made = \([0-9]*\)$/\1/p' "$out/$scene.$k/summary.txt")" \
            >> "$out/$scene.all"
    done
    echo "$scene: s after the gate, fraction left: least, mean, most of $fillings fillings"
    sort -n "$out/$scene.all" | awk '{ t = $1; if (t != last && n) { print last, low, sum / n, high; n = 0 }
        if (!n) { low = high = $2; sum = 0 } if ($2 < low) low = $2; if ($2 > high) high = $2
        sum += $2; n++; last = t } END { if (n) print last, low, sum / n, high }' | tee "$out/$scene.txt"
done
