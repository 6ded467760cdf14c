#!/usr/bin/env bash
# verify/shape_discharge.sh [COUNT [SEED]] - hollow boxes, tetrapods, crosses and dolosse of 1 x 1 x 1 m run out of a
# flat-bottomed hopper on to a floor: rate of discharge and angle of the heap [LiLiuJi23, figs 13 to 15];
# out/shape_discharge/discharge.png. The paper: the hollow ones run fastest and lie flattest, the
# dolos-like ones run slowest and lie steepest; its other two shapes are in pictures alone.
# COUNT is 400; FULL=1: the paper's 4,000 in a hopper of 24 x 24 m (its L0 : W0 : H0 = 2 : 2 : 1, filled to about 12 m)
# over 8 x 8 m. Fewer: a hopper less wide by the cube root, an opening of no more than 0.55 of it.
# Measured with 500 (AFTER=8, one filling): hollow boxes 48 +- 4 grains/s (23.2 m3/s), 9 +- 2 degrees (15 by a version with other contacts at plates);
# dolosse 209 +- 100 (35.4 m3/s), 5 degrees; tetrapods 121 +- 71 (34.7), 6 degrees; crosses 142 +- 65 (36.3), 2 degrees. That is not the paper's order. Of the same
# count and width the slender ones fill the hopper to a third of its opening's width and leave in one go; what
# they heap up is two grains high, so neither is a rate nor an angle to compare; most of all, dolosse stay in
# the hopper (59 %; hollow boxes 52 %), as locked grains should. The hollow boxes, whose bars enter each
# other's windows, fill it and run out in bursts. The paper's shapes are in pictures alone; they must be thicker.
# FULL has not been run (an hour and a half of one core).
# Ours: edges of 6 cm (2 cm there) at 0.2 GPa (10 there), for steps ten times as long: overlaps must stay below the edges'.
#
# Rate: between the times when a fifth and 7 tenths of those that leave have left; its spread that of four parts of that
# time. Angle: the program's own ([surface], kind = heap); its spread that of the four quarters of the heap.
# A shape that is there from an earlier call with the same settings is taken as it is.
set -euo pipefail
cd "$(dirname "$0")/.."
count=${1:-$([ -n "${FULL:-}" ] && echo 4000 || echo 400)}
seed=${2:-1}
shapes=${SHAPES:-hollow_box dolos tetrapod cross}
out=out/shape_discharge
mkdir -p "$out"
make -s build/release/verify/boxes_in_air
# m, s: the hopper, its floor's height, the opening, how high its grains start, box, gate, after it
eval "$(awk -v n="$count" 'BEGIN { k = (n / 4000) ^ (1 / 3); wide = 24 * k; open = 0.55 * wide; if (open > 8) open = 8
    floor = 13 * k + 2; air = n / (0.26 * wide * wide) + 1
    printf "wide=%.3f floor=%.3f open=%.3f air=%.3f box=%.3f gate=%.2f run=%.2f", wide, floor, open, air,
        52 * k + 4, sqrt(2 * air / 9.81) + 1.2, 4 + 12 * k }')"
run=${AFTER:-$run}

series() { # VARIABLE FILE, one a line
    ncdump -v "$1" "$2" | sed -n "/^ $1 =/,/;/p" | sed 's/.*=//' | tr -d ' \n;' | tr ',' '\n'
}

plate() { # NAME CORNER EDGE1 EDGE2
    printf '[wall %s]\nkind = rectangle\ncorner = %s m\nedge1 = %s m\nedge2 = %s m\n\n' "$@"
}

# m: of the volume, of a shape that is 1 m wide, edges and all
diameter() {
    case $1 in hollow_box) echo 0.9730 ;; tetrapod) echo 0.8181 ;; cross) echo 0.7884 ;; dolos) echo 0.6865 ;; esac
}

scene() { # FORM
    local a b c d quarter m
    read -r a b c d m <<< "$(awk -v w="$wide" -v o="$open" -v b="$box" 'BEGIN {
        printf "%.4f %.4f %.4f %.4f %.4f", (b - w) / 2, (b - o) / 2, (b + o) / 2, (b + w) / 2, b / 2 }')"
    cat << END
[modules]
shape   = multi_dilated_polyhedron
contact = hertz_mindlin
[domain]
size = $box $box $(awk -v f="$floor" -v a="$air" 'BEGIN { print f + a + 0.5 }') m
[grains units]
form     = $1
dilation = 6 cm
diameter = $(diameter "$1") m
density  = 2500 kg/m3
fill     = file
file     = $1.places
material = concrete
[material concrete]
young       = 0.2 GPa
poisson     = 0.3
friction    = 0.3
restitution = 0.3
[meter opening]
point  = 0 0 $(sub "$floor" 1.3) m
normal = 0 0 -1
[output]
series = 20 ms
[run]
end         = $(awk -v g="$gate" -v r="$run" 'BEGIN { print g + r }') s
seed        = $seed
overlap_max = 0.3
END
    plate west "$a $a $floor" "$(sub "$b" "$a") 0 0" "0 $wide 0"
    plate east "$c $a $floor" "$(sub "$d" "$c") 0 0" "0 $wide 0"
    plate south "$b $a $floor" "$open 0 0" "0 $(sub "$b" "$a") 0"
    plate north "$b $c $floor" "$open 0 0" "0 $(sub "$d" "$c") 0"
    plate x1 "$a $a $floor" "0 $wide 0" "0 0 $air"
    plate x2 "$d $a $floor" "0 $wide 0" "0 0 $air"
    plate y1 "$a $a $floor" "$wide 0 0" "0 0 $air"
    plate y2 "$a $d $floor" "$wide 0 0" "0 0 $air"
    # the opening is as deep as a grain: arms do not hook under its edge
    plate c1 "$b $b $floor" "0 $open 0" "0 0 -1"
    plate c2 "$c $b $floor" "0 $open 0" "0 0 -1"
    plate c3 "$b $b $floor" "$open 0 0" "0 0 -1"
    plate c4 "$b $c $floor" "$open 0 0" "0 0 -1"
    plate gate "$b $b $floor" "$open 0 0" "0 $open 0"
    printf 'velocity = 0 0 -40 m/s\nstart = %s s\nstop = %s s\n' "$gate" "$(awk -v g="$gate" 'BEGIN { print g + 1 }')"
    for quarter in "sw 0 0 $m $m" "se $m 0 $box $m" "nw 0 $m $m $box" "ne $m $m $box $box" "heap 0 0 $box $box"; do
        read -r name x0 y0 x1 y1 <<< "$quarter"
        printf '[surface %s]\nkind = heap\nfrom = %s %s 0 m\nto = %s %s %s m\n' "$name" "$x0" "$y0" "$x1" "$y1" \
            "$(sub "$floor" 1.3)"
    done
}

sub() {
    awk -v a="$1" -v b="$2" 'BEGIN { printf "%.4f", a - b }'
}

# OUT/FORM.txt: grains a second, their spread, angle, its spread, part that left; OUT/FORM.left: the curve.
discharge() { # FORM
    local f=$1 dir=$out/$1 stamp
    stamp="# $count, seed $seed, hopper $wide m, opening $open m, floor at $floor m, $gate + $run s"
    [ -e "$dir.txt" ] && [ "$(head -n 1 "$dir.txt")" = "$stamp" ] && return
    build/release/verify/boxes_in_air 1 "$count" "$seed" "$wide" "$air" \
        $(awk -v w="$wide" -v b="$box" -v f="$floor" 'BEGIN { print (b - w) / 2, (b - w) / 2, f + 0.05 }') "$(diameter "$f")" > "$dir.places"
    scene "$f" > "$dir.ini"
    ./run.sh "$dir.ini" -o "$dir" > "$dir.log" 2>&1 || { tail -n 3 "$dir.log"; exit 1; }
    paste <(series sample_time "$dir/run.nc") <(series opening_count "$dir/run.nc") |
        awk -v g="$gate" -v n="$count" '$1 >= g - 0.03 { printf "%.3f %.5f\n", $1 - g, $2 / n }' > "$dir.left"
    {
        echo "$stamp"
        awk -v n="$count" '{ t[NR] = $1; f[NR] = $2; last = $2 }
            function when(part, k) {
                for (k = 2; k < NR && f[k] < part * last; k++) {}
                return t[k - 1] + (t[k] - t[k - 1]) * (f[k] > f[k - 1] ? (part * last - f[k - 1]) / (f[k] - f[k - 1]) : 0) }
            END { for (k = 0; k < 4; k++) { r = n * last * 0.125 / (when(0.325 + 0.125 * k) - when(0.2 + 0.125 * k)); s += r; q += r * r }
                printf "%.2f %.2f ", n * last * 0.5 / (when(0.7) - when(0.2)), sqrt((q - s * s / 4) / 3 + 1e-12)
                printf "%.3f\n", last }' "$dir.left"
        for q in sw se nw ne; do sed -n "s/^${q}_angle = \([^ ]*\).*/\1/p" "$dir/summary.txt"; done |
            awk -v whole="$(sed -n 's/^heap_angle = \([^ ]*\).*/\1/p' "$dir/summary.txt")" '
                $1 == $1 + 0 { s += $1; q += $1 * $1; n++ }
                END { printf "%s %.2f\n", whole == "" ? "nan" : sprintf("%.2f", whole), (n > 1 ? sqrt((q - s * s / n) / (n - 1)) : 0) }'
        echo "# $(grep -m 1 -o '^silt [^,]*' "$dir.log"), $(sed -n 's/^wall_time = //p' "$dir/summary.txt")"
    } > "$dir.part"
    mv "$dir.part" "$dir.txt"
    rm -f "$dir.places"
}

passed=0 failed=0
check() { # WORDS AWK-CONDITION
    if awk "BEGIN { exit !($2) }"; then passed=$((passed + 1)); echo "ok    $1"; else failed=$((failed + 1)); echo "FAIL  $1"; fi
}

echo "$count of each, hopper $wide x $wide m, opening $open x $open m"
printf '%-11s %9s %6s %9s %7s %6s %9s\n' shape grains/s +- m3/s degrees +- "left it"
declare -A rate angle spread
for f in $shapes; do
    discharge "$f"
    { read -r _; read -r r dr left; read -r a da; } < "$out/$f.txt"
    printf '%-11s %9.1f %6.1f %9.2f %7.1f %6.1f %9.3f\n' "$f" "$r" "$dr" \
        "$(awk -v r="$r" -v d="$(diameter "$f")" 'BEGIN { print r * 3.14159265 / 6 * d ^ 3 }')" "$a" "$da" "$left"
    rate[$f]=$r angle[$f]=$a spread[$f]="$dr $da"
done
[ "$shapes" = "hollow_box dolos tetrapod cross" ] || exit 0
for f in tetrapod cross; do
    check "hollow boxes run faster than $f" "${rate[hollow_box]} > ${rate[$f]}"
    check "dolosse run slower than $f" "${rate[dolos]} < ${rate[$f]}"
    check "hollow boxes lie flatter than $f" "${angle[hollow_box]} < ${angle[$f]}"
    check "dolosse lie steeper than $f" "${angle[dolos]} > ${angle[$f]}"
done
check "hollow boxes run faster than dolosse" "${rate[hollow_box]} > ${rate[dolos]}"
check "hollow boxes lie flatter than dolosse" "${angle[hollow_box]} < ${angle[dolos]}"
for f in $shapes; do
    echo "$f ${rate[$f]} ${angle[$f]} ${spread[$f]}"
done > "$out/discharge.dat"
gnuplot << END
set terminal pngcairo size 1150,430 font 'DejaVu Sans,10'
set output '$out/discharge.png'
set multiplot layout 1,2 title '$count grains of 1 x 1 x 1 m run out of a hopper'
set grid lc rgb '#dddddd'
set xlabel 'time after the gate has opened, s'
set ylabel 'part of the grains that has left'
set yrange [0:1.02]
set xrange [0:*]
set key top right
set style line 1 lw 2 lc rgb '#0072b2'
set style line 2 lw 2 lc rgb '#d55e00'
set style line 3 lw 2 lc rgb '#009e73'
set style line 4 lw 2 lc rgb '#cc79a7'
shapes = '$shapes'
plot for [k = 1:4] '$out/'.word(shapes, k).'.left' using 1:2 with lines ls k title word('hollow dolos tetrapod cross', k)
set xlabel 'rate, grains a second'
set ylabel 'angle of the heap, degrees'
set yrange [0:*]
set xrange [0:*]
set offsets 0, graph 0.15, graph 0.15, graph 0.15
unset key
plot for [k = 1:4] '$out/discharge.dat' every ::(k - 1)::(k - 1) using 2:3:4:5 with xyerrorbars ls k pt 7 ps 1.4, \
     for [k = 1:4] '$out/discharge.dat' every ::(k - 1)::(k - 1) using 2:3:(word('hollow dolos tetrapod cross', k)) \
     with labels left offset 1,0.8
unset multiplot
END
echo "picture: $out/discharge.png"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
