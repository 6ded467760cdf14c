#!/usr/bin/env bash
# verify/letters.sh [COUNT] - six letters fall into a box: solid fraction of each bed, between a fifth and
# three fifths of its height. The paper's order is O > (T, Z, K) > (A, C) [LiLiuJi23, fig. 12], with 4,000
# grains; here COUNT (40; the box of the scene has no room for many more) of each.
set -euo pipefail
cd "$(dirname "$0")/.."
count=${1:-40}
out=out/letters
mkdir -p "$out"
printf '%-8s %s\n' letter "solid fraction" | tee "$out/letters.txt"
# mm, of the volumes of strokes of 30 x 30 mm, letters of 100 x 180 mm
for of in O:91.1 T:75.5 Z:81.9 K:82.0 A:83.3 C:81.9; do
    letter=${of%:*}
    ./run.sh scenes/letters.ini "grains letters.form=$letter" "grains letters.diameter=${of#*:} mm" \
        "grains letters.count=$count" output.profile_bins=100 -o "$out/$letter" > "$out/$letter.log" 2>&1 ||
        { tail -n 3 "$out/$letter.log"; exit 1; }
    ncdump -v solid_profile_end "$out/$letter/run.nc" | sed -n '/^ solid_profile_end =/,/;/p' |
        sed 's/.*=//' | tr ',; ' '\n\n\n' | grep . |
        awk -v l="$letter" '{ f[NR] = $1 } END {
            for (k = NR; k > 1 && f[k] < 0.1; k--) {}
            for (i = int(k / 5) + 1; i <= 3 * k / 5; i++) { s += f[i]; n++ }
            printf "%-8s %.3f\n", l, s / n }' | tee -a "$out/letters.txt"
done
