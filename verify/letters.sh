#!/usr/bin/env bash
# verify/letters.sh [COUNT [SEED]] - six letters fall into a box: packing fraction and porosity of each bed, and
# out/letters/letters.png. The paper's order is O > (T, Z, K) > (A, C) [LiLiuJi23, figs 10 to 12], its fractions are in a
# picture alone. COUNT is 250, on 0.9 x 0.9 m that are periodic: minutes. FULL=1: the paper's 4,000 in its box of 1.8 x 1.8 m.
#
# What its letters are: 100 x 30 x 180 mm and a ball of 20 mm (its table 2) cannot be sizes over all, 2 x 20 > 30. They
# are taken as those of the cores here: letters of 140 x 70 x 220 mm over all (verify/letters.c), of which 4,000 fill 3 to
# 4 m of its box 5 m high. STROKE=30 (mm) is how wide the strokes' cores are; the paper does not say; 30 is
# how thick they are, and closes the hole of the O: nothing catches in it.
# Measured, 1,000 each on 0.9 x 0.9 m (COUNT=1000), one filling: O 0.651, A 0.640, T 0.594, K 0.591, Z 0.574, C 0.570,
# +- 0.002 to 0.012 between layers: the paper's order but for the A (four minutes each on
# half of a core; FULL has not been run, it should take four times that). 250 each, 0.05 GPa: STROKE=20: A 0.613, T 0.580, K 0.563, O 0.561,
# Z 0.523, C 0.509; STROKE=10: A 0.575, T 0.564, O 0.513, Z 0.494, C 0.485. 100 x 30 x 180 mm over all, edges of 4 mm, strokes
# of 30 mm, 250 each: A 0.447, T 0.428, O 0.360. The A packs densely in all of them, whose legs leave little room between
# them; the paper explains its low fraction by a large hollow: its A must be another. The O leads where its hole is closed.
# Ours: 0.1 GPa (10 there), for steps ten times as long; letters start further up than 5 m, where 4,000 find no room.
#
# A letter that is there from an earlier call with the same settings is taken as it is: a call that was
# interrupted goes on; rm -r out/letters begins anew.
set -euo pipefail
cd "$(dirname "$0")/.."
count=${1:-$([ -n "${FULL:-}" ] && echo 4000 || echo 250)}
seed=${2:-1}
stroke=${STROKE:-30}
letters=${LETTERS:-O T Z K A C}
out=out/letters
mkdir -p "$out"
make -s build/release/verify/letters
if [ -n "${FULL:-}" ]; then # mm
    base=1800 sides=()
else
    base=900 sides=(domain.x=periodic domain.y=periodic)
fi
column=$(awk -v n="$count" -v b="$base" 'BEGIN { print int(0.1 * n * 1e8 / (b * b)) + 400 }') # mm
seconds=${END:-$(awk -v h="$column" 'BEGIN { printf "%.2f", sqrt(2e-3 * h / 9.81) + 0.9 }')} # the fall, and rest
sizes=$(awk -v b="$base" -v h="$column" 'BEGIN { print b, b, h }')

value() { # KEY FILE
    sed -n "s/^$1 = \([^ ]*\).*/\1/p" "$2"
}

# m, mean of the contacts that overlap.
overlap() { # FILE
    ncdump -v contact_overlap "$1" | sed -n '/^ contact_overlap =/,/;/p' | sed 's/.*=//' | tr ',;' '\n\n' |
        awk '$1 > 0 { s += $1; n++ } END { print n ? s / n : 0 }'
}

# OUT/LETTER.txt: fraction in the middle of the bed, its standard deviation between layers, that of
# the whole bed, m that it is high, mean overlap in mm, kinetic energy over m g d.
letter() { # LETTER
    local l=$1 dir=$out/$1 stamp d
    stamp="# $count letters, stroke $stroke, seed $seed, base $base, $seconds s"
    [ -e "$dir.txt" ] && [ "$(head -n 1 "$dir.txt")" = "$stamp" ] && return
    d=$(build/release/verify/letters "$out" "$l" "$stroke" 20 "$count" "$seed" "$base" "$column")
    d=${d% *}
    ./run.sh scenes/letters.ini "domain.size=$sizes mm" "${sides[@]}" "grains letters.form=mesh" "grains letters.mesh=$PWD/$dir.obj" \
        "grains letters.diameter=$d mm" "grains letters.count=$count" "grains letters.fill=file" \
        "grains letters.file=$PWD/$dir.places" "run.end=$seconds s" output.profile_bins=$((column / 10)) \
        output.contacts=on -o "$dir" \
        > "$dir.log" 2>&1 || { tail -n 3 "$dir.log"; exit 1; }
    {
        echo "$stamp"
        ncdump -v solid_profile_end "$dir/run.nc" | sed -n '/^ solid_profile_end =/,/;/p' | sed 's/.*=//' |
            tr ',; ' '\n\n\n' | grep . | awk -v h="$column" -v bins=$((column / 10)) -v d="$d" -v n="$count" -v b="$base" \
            -v deep="$(overlap "$dir/run.nc")" -v m="$(value letters_mass "$dir/summary.txt")" \
            -v e="$(value energy_kinetic "$dir/summary.txt")" '
            { f[NR] = $1 }
            END { dz = h / bins
                for (top = NR; top > 1 && f[top] < 0.05; top--) {}
                first = int(top / 5); each = int(top / 10)
                for (k = 0; k < 4; k++) {
                    s = 0
                    for (i = 1; i <= each; i++) s += f[first + k * each + i]
                    sum += s / each; square += s / each * s / each }
                mean = sum / 4; spread = sqrt((square - 4 * mean * mean) / 3 + 1e-12)
                for (edge = top; f[edge] < 0.5 * mean; edge--) {}
                printf "%.4f %.4f %.4f %.3f %.2f %.3g\n", mean, spread,
                    n * 3.14159265 / 6 * d * d * d / (b * b * edge * dz), edge * dz / 1e3, 1e3 * deep, 1e3 * e / (m * 9.81 * d) }'
        echo "# $(grep -m 1 -o '^silt [^,]*' "$dir.log"), $(value wall_time "$dir/summary.txt") s"
    } > "$dir.part"
    mv "$dir.part" "$dir.txt"
    rm -f "$dir/run.nc" "$dir/run.xmf" "$dir.places"
}

echo "$count letters each, stroke of the core $stroke mm; porosity of the bed's middle"
printf '%-6s %8s %7s %8s %10s %7s %10s %8s\n' letter fraction +- porosity "whole bed" high,m overlap,mm E/mgd
for l in $letters; do
    letter "$l"
    read -r f spread whole high deep e < <(sed -n 2p "$out/$l.txt")
    printf '%-6s %8.3f %7.3f %8.3f %10.3f %7.2f %10.2f %8.1e\n' "$l" "$f" "$spread" \
        "$(awk -v f="$f" 'BEGIN { print 1 - f }')" "$whole" "$high" "$deep" "$e"
done
[ "$letters" = "O T Z K A C" ] || exit 0

passed=0 failed=0
denser() { # LETTER LETTER: the paper has the first packed denser
    local a b
    read -r a _ < <(sed -n 2p "$out/$1.txt")
    read -r b _ < <(sed -n 2p "$out/$2.txt")
    if awk -v a="$a" -v b="$b" 'BEGIN { exit !(a > b) }'; then
        passed=$((passed + 1)); echo "ok    $1 packs denser than $2"
    else
        failed=$((failed + 1)); echo "FAIL  $1 packs denser than $2: $a, $b"
    fi
}
for l in T Z K; do denser O "$l"; done
for l in T Z K; do denser "$l" A; denser "$l" C; done
for l in $letters; do echo "$l $(sed -n 2p "$out/$l.txt")"; done > "$out/letters.dat"
gnuplot << END
set terminal pngcairo size 620,420 font 'DejaVu Sans,11'
set output '$out/letters.png'
set title '$count letters each; colours: the groups of the paper, the densest on the left'
set ylabel 'packing fraction'
set y2label 'porosity'
set yrange [0.4:0.75]
set y2range [0.6:0.25]
set ytics nomirror
set y2tics
set xrange [0.4:6.6]
set grid ytics lc rgb '#dddddd'
set style fill solid 0.7
set boxwidth 0.6
unset key
plot '$out/letters.dat' using (\$0 + 1):2:(\$0 < 1 ? 0x0072b2 : \$0 < 4 ? 0x009e73 : 0xd55e00):xtic(1) with boxes lc rgb variable, \
     '' using (\$0 + 1):2:3 with yerrorbars pt 0 ps 0 lc rgb '#333333', \
     '' using (\$0 + 1):(\$2 + \$3 + 0.012):(sprintf('%.3f', \$2)) with labels
END
echo "picture: $out/letters.png"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
