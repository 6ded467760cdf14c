#!/usr/bin/env bash
# verify/letters.sh [COUNT] - six letters fall into a box that is periodic sideways: solid fraction of each bed,
# between a fifth and three fifths of its height. The paper's order is O > (T, Z, K) > (A, C) [LiLiuJi23, fig. 12],
# with 4,000 grains; here COUNT (50) of each. Strokes of 30 x 30 mm, dilated by the paper's 20 mm, close the
# hole of the O: that is what lets it pack well. With sharper edges (4 mm) the hole stays open, and O packs worst.
# Two fillings gave O 0.652 0.623, A 0.625 0.667, T 0.614 0.616, K 0.594 0.596, C 0.553 0.542, Z 0.543 0.556:
# O before T and K, and C among the last, as in the paper; A and Z do not lie where it has them.
# The paper's 20 mm is hardly what it ran: 4,000 letters that are 140 x 70 x 220 mm would not fit into its 1.8 x 1.8 x 5 m
# without overlap, and it speaks of the hole of the O. 100 letters of exactly 100 x 30 x 180 mm with edges of 4 mm that
# fell from up to 6.5 m on 0.5 x 0.5 m (one filling) gave T 0.49, Z 0.43, O 0.42: then O is not the densest.
set -euo pipefail
cd "$(dirname "$0")/.."
count=${1:-50}
out=out/letters
mkdir -p "$out"
printf '%-8s %s\n' letter "solid fraction" | tee "$out/letters.txt"
# mm, of the volumes of such letters of 100 x 180 mm, by sums over a grid
for of in O:155.2 T:134.2 Z:144.8 K:144.8 A:141.2 C:144.1; do
    letter=${of%:*}
    ./run.sh scenes/letters.ini "grains letters.form=$letter" "grains letters.diameter=${of#*:} mm" \
        "grains letters.dilation=20 mm" "grains letters.count=$count" domain.x=periodic domain.y=periodic \
        "domain.size=0.6 0.6 $(awk -v n="$count" 'BEGIN { print 0.7 + 0.05 * n }') m" "material stone.young=0.5 GPa" \
        "run.end=${END:-1.3} s" output.profile_bins=100 -o "$out/$letter" > "$out/$letter.log" 2>&1 ||
        { tail -n 3 "$out/$letter.log"; exit 1; }
    ncdump -v solid_profile_end "$out/$letter/run.nc" | sed -n '/^ solid_profile_end =/,/;/p' |
        sed 's/.*=//' | tr ',; ' '\n\n\n' | grep . |
        awk -v l="$letter" '{ f[NR] = $1 } END {
            for (k = NR; k > 1 && f[k] < 0.1; k--) {}
            for (i = int(k / 5) + 1; i <= 3 * k / 5; i++) { s += f[i]; n++ }
            printf "%-8s %.3f\n", l, s / n }' | tee -a "$out/letters.txt"
done
