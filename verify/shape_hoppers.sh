#!/usr/bin/env bash
# verify/shape_hoppers.sh [FILLINGS] - prisms and cone pairs run out of the flat-bottomed hopper of [LiLiuJi23,
# figs 6 to 9], 1,000 grains, each from FILLINGS random fillings (5): the fraction of grains left in it against time
# as a band, when the flow stood still, what stayed; out/shape_hoppers/hoppers.png.
# The paper: prisms (convex) form arches near 1.6 and 2.4 s that collapse; cone pairs (concave) a lasting one near 0.8 s.
# As the scenes have them, with edges of 0.3 mm at 10 MPa (0.1 mm and 1 GPa there): some five minutes of one core a
# filling, JOBS (all cores) fillings at a time. FULL=1: 30 MPa and half the steps.
# A filling that is there from an earlier call is taken as it is (its program's version is printed), so a call that was
# interrupted goes on; rm -r out/shape_hoppers begins anew.
set -euo pipefail
cd "$(dirname "$0")/.."
fillings=${1:-5}
out=out/shape_hoppers${FULL:+_full}
scenes=("prism_hopper prisms 2.5" "cone_pair_hopper pairs 1.1") # and the time after the gate, s
gate=0.75                                                       # s
still=0.15                                                      # s without a grain at the end: it is at rest
pause=0.05                                                      # s without a grain: ten or twenty would have left
heaps=0.2                                                       # of all; about as many can lie beside the slot
mkdir -p "$out"

series() { # VARIABLE FILE, one a line
    ncdump -v "$1" "$2" | sed -n "/^ $1 =/,/;/p" | sed 's/.*=//' | tr -d ' \n;' | tr ',' '\n'
}

# What decides a run: the scene without its comments, how long, which form.
stamp() { # SCENE SECONDS
    echo "# $(sed 's/[ \t]*;.*//; /^$/d' "scenes/$1.ini" | sha256sum | cut -c 1-12) $2 s ${FULL:+full}"
}

# One filling: OUT/NAME.K.left, lines "s after the gate, fraction left".
filling() { # SCENE SPECIES SECONDS K
    local scene=$1 species=$2 k=$4 dir=$out/$1.$4 file=$out/$1.$4.left full=()
    [ -z "${FULL:-}" ] || full=("material plastic.young=30 MPa" "run.safety=0.2")
    [ -e "$file" ] && [ "$(head -n 1 "$file")" = "$(stamp "$scene" "$3")" ] && return
    rm -f "$file"
    ./run.sh "scenes/$scene.ini" "run.seed=$k" "run.end=$(awk -v g=$gate -v s="$3" 'BEGIN { print g + s }') s" \
        "${full[@]}" -o "$dir" -j 1 > "$dir.log" 2>&1 || { tail -n 3 "$dir.log"; return 1; }
    {
        stamp "$scene" "$3"
        echo "# $(grep -m 1 -o '^silt [^,]*' "$dir.log")"
        paste <(series sample_time "$dir/run.nc") <(series slot_count "$dir/run.nc") |
            awk -v g=$gate -v n="$(sed -n 's/^.*_made = \([0-9]*\)$/\1/p' "$dir/summary.txt")" '
                { t = $1 - g; if (t > -0.003) printf "%.4f %.4f\n", t < 0 ? 0 : t, 1 - $2 / n }'
    } > "$file.part"
    mv "$file.part" "$file"
    rm -f "$dir/run.nc"
}

# Of one filling: when nothing left for a while though more lay there than the heaps beside the slot and the flow went on
# later, and how it ends; or, with `numbers`, how many such times, 1 if it ends at rest, when the last grain left, the
# fraction left.
stops() { # FILE [numbers]
    awk -v still=$still -v pause=$pause -v heaps=$heaps -v numbers="${2:-}" '/^#/ { next }
        { if (!n++ || $2 < left) {
              if (n > 1 && since > 0 && $1 - since >= pause && left > heaps) {
                  text = text sprintf(" %.2f to %.2f s,", since, $1); stops++ }
              since = $1; left = $2 }
          t = $1 }
        END { rest = t - since >= still
              if (numbers) { printf "%d %d %.3f %.4f\n", stops, rest, since, left; exit }
              printf "%s at the end %.3f left", text ? text : " at no time,", left
              if (rest) printf ", at rest since %.2f s", since; else printf ", still running" }' "$1"
}

# Least, mean and most of several series, every 0.02 s.
band() { # FILE...
    awk '/^#/ { next }
        FNR < last { file++ }
        { last = FNR; k = int($1 / 0.02 + 0.5); at[file + 0, k] = $2; if (k > most) most = k }
        END { for (f = 0; f <= file + 0; f++) for (k = 1; k <= most; k++) if (!((f, k) in at)) at[f, k] = at[f, k - 1]
              for (k = 0; k <= most; k++) {
                  low = 1; high = sum = 0
                  for (f = 0; f <= file + 0; f++) {
                      v = at[f, k]; sum += v; if (v < low) low = v; if (v > high) high = v }
                  printf "%.2f %.4f %.4f %.4f\n", 0.02 * k, low, sum / (file + 1), high } }' "$@"
}

panel() { # SCENE TITLE
    local k
    echo "set title '$2'"
    printf "plot '%s' using 1:2:4 with filledcurves lc rgb '#bcd0e8' title 'least to most of %d fillings'" \
        "$out/$1.band" "$fillings"
    for k in $(seq "$fillings"); do
        printf ", '%s' using 1:2 with lines lw 0.6 lc rgb '#7090b8' notitle" "$out/$1.$k.left"
    done
    echo ", '$out/$1.band' using 1:3 with lines lw 2 lc rgb '#1f4e8c' title 'mean'"
}

for of in "${scenes[@]}"; do
    ./run.sh build "scenes/${of%% *}.ini" > /dev/null
done
for k in $(seq "$fillings"); do
    for of in "${scenes[@]}"; do
        read -r scene species seconds <<< "$of"
        while [ "$(jobs -rp | wc -l)" -ge "${JOBS:-$(nproc)}" ]; do wait -n || true; done
        filling "$scene" "$species" "$seconds" "$k" &
    done
done
wait
passed=0
failed=0
say() { # TRUE TEXT
    if [ "$1" = 1 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    echo "$([ "$1" = 1 ] && echo "ok  " || echo FAIL) $2"
}
echo "1,000 grains, edges of 0.3 mm, $([ -n "${FULL:-}" ] && echo 30 || echo 10) MPa; the paper: 0.1 mm, 1 GPa"
for of in "${scenes[@]}"; do
    read -r scene species seconds <<< "$of"
    files=()
    for k in $(seq "$fillings"); do
        [ -e "$out/$scene.$k.left" ] || {
            echo "FAIL $scene, filling $k: $(tail -n 1 "$out/$scene.$k.log")"
            echo "0 passed, 1 failed"
            exit 1
        }
        files+=("$out/$scene.$k.left")
        echo "$scene, filling $k: stood still$(stops "$out/$scene.$k.left") ($(sed -n '2s/# //p' "$out/$scene.$k.left"))"
    done
    for file in "${files[@]}"; do stops "$file" numbers; done > "$out/$scene.ends"
    band "${files[@]}" > "$out/$scene.band"
    echo "$scene: s after the gate, fraction left: least, mean, most of $fillings fillings"
    awk 'NR % 10 == 1' "$out/$scene.band" | sed 's/^/  /'
done
gnuplot << END
set terminal pngcairo size 1000,460 font 'Sans,10'
set output '$out/hoppers.png'
set multiplot layout 1,2
set xlabel 'time after the gate has opened, s'
set ylabel 'fraction of grains left'
set yrange [0:1.02]
set xrange [0:]
set grid lc rgb '#dddddd'
set key bottom left
set style fill solid
set arrow 1 from 1.6, graph 0 to 1.6, graph 1 nohead lc rgb '#999999' dt 3
set arrow 2 from 2.4, graph 0 to 2.4, graph 1 nohead lc rgb '#999999' dt 3
$(panel prism_hopper 'prisms (dotted: arches of the paper, which collapse)')
unset arrow 2
set arrow 1 from 0.8, graph 0 to 0.8, graph 1 nohead lc rgb '#999999' dt 3
$(panel cone_pair_hopper 'cone pairs (dotted: the lasting arch of the paper)')
unset multiplot
END
echo "picture: $out/hoppers.png"
# What the paper says of its figures 7 to 9.
read -r good n <<< "$(awk '$2 { n++ } END { print (n == NR), n + 0 }' "$out/cone_pair_hopper.ends")"
say "$good" "cone pairs: a lasting arch in $n of $fillings fillings (the paper: all)"
read -r good n t <<< "$(awk '$2 { sum += $3; n++ } END { m = n ? sum / n : 0; printf "%d %d %.2f\n", (m > 0.4 && m < 1.2), n, m }' \
    "$out/cone_pair_hopper.ends")"
say "$good" "cone pairs: of the $n that lock the last grain leaves after $t s, mean (the paper: near 0.8 s; half of it either way)"
read -r good n <<< "$(awk '{ n += $1 > 0 } END { print (n > 0), n + 0 }' "$out/prism_hopper.ends")"
say "$good" "prisms: an arch that collapses (nothing leaves for $pause s, then the flow goes on) in $n of $fillings fillings (the paper: near 1.6 and 2.4 s)"
read -r good prisms pairs <<< "$(paste "$out/prism_hopper.ends" "$out/cone_pair_hopper.ends" |
    awk '{ a += $4; b += $8 } END { printf "%d %.3f %.3f\n", (a < b), a / NR, b / NR }')"
say "$good" "fewer prisms stay than pairs: $prisms against $pairs of all"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
