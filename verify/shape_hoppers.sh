#!/usr/bin/env bash
# verify/shape_hoppers.sh [FILLINGS] - prisms and cone pairs run out of the flat-bottomed hopper of [LiLiuJi23,
# figs 6 to 9], each from FILLINGS random fillings (2; FULL=1: 5): the fraction of grains left in it against time as
# a band, when the flow stood still, what stayed; out/shape_hoppers/hoppers.png.
# The paper: prisms (convex) form arches near 1.6 and 2.4 s that collapse; cone pairs (concave) a lasting one near 0.8 s.
# As the scenes have them, 500 and 400 grains: two to five minutes of one core a filling. FULL=1: the paper's 1,000,
# with edges of 0.3 mm at 30 MPa (0.1 mm and 1 GPa there), 15 to 30 minutes a filling.
# A filling that is there from an earlier call is taken as it is (its program's version is printed), so a call that was
# interrupted goes on; rm -r out/shape_hoppers begins anew.
set -euo pipefail
cd "$(dirname "$0")/.."
fillings=${1:-$([ -n "${FULL:-}" ] && echo 5 || echo 2)}
out=out/shape_hoppers
gate=0.6 # s
[ -z "${FULL:-}" ] || gate=0.75
still=0.15 # s without a grain: the flow stands still
mkdir -p "$out"

series() { # VARIABLE FILE, one a line
    ncdump -v "$1" "$2" | sed -n "/^ $1 =/,/;/p" | sed 's/.*=//' | tr -d ' \n;' | tr ',' '\n'
}

# One filling: OUT/NAME.K.left, lines "s after the gate, fraction left".
filling() { # SCENE SPECIES SECONDS K
    local scene=$1 species=$2 k=$4 dir=$out/$1.$4 file=$out/$1.$4.left full=() stamp
    [ -z "${FULL:-}" ] || full=("grains $species.count=1000" "grains $species.to=140 50 795 mm"
        "grains $species.dilation=0.3 mm" "material plastic.young=30 MPa" "wall gate.start=0.75 s" "wall gate.stop=0.85 s")
    stamp="# $(sha256sum < "scenes/$scene.ini" | cut -c 1-12) $3 s ${FULL:+full}"
    [ -e "$file" ] && [ "$(head -n 1 "$file")" = "$stamp" ] && return
    ./run.sh "scenes/$scene.ini" "run.seed=$k" "run.end=$(awk -v g=$gate -v s="$3" 'BEGIN { print g + s }') s" \
        "${full[@]}" -o "$dir" > "$dir.log" 2>&1 || { tail -n 3 "$dir.log"; exit 1; }
    {
        echo "$stamp"
        echo "# $(grep -m 1 -o '^silt [^,]*' "$dir.log")"
        paste <(series sample_time "$dir/run.nc") <(series slot_count "$dir/run.nc") |
            awk -v g=$gate -v n="$(sed -n 's/^.*_made = \([0-9]*\)$/\1/p' "$dir/summary.txt")" '
                { t = $1 - g; if (t > -0.003) printf "%.4f %.4f\n", t < 0 ? 0 : t, 1 - $2 / n }'
    } > "$file.part"
    mv "$file.part" "$file"
    rm -f "$dir/run.nc"
}

# Of one filling: the times in which nothing left, and how it ends.
stops() { # FILE
    awk -v still=$still '/^#/ { next }
        { if (!n++ || $2 < left) { if (n > 1 && $1 - since >= still) text = text sprintf(" %.2f to %.2f s,", since, $1)
              since = $1; left = $2 }
          t = $1 }
        END { printf "%s at the end %.3f left", text, left
              if (t - since >= still) printf ", at rest since %.2f s", since; else printf ", still running" }' "$1"
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

if [ -n "${FULL:-}" ]; then echo "the paper's 1,000 grains"; else echo "short form: the scenes' 500 and 400 grains"; fi
for of in "prism_hopper prisms ${AFTER:-2.5}" "cone_pair_hopper pairs ${AFTER:-1.5}"; do
    read -r scene species seconds <<< "$of"
    for k in $(seq "$fillings"); do
        filling "$scene" "$species" "$seconds" "$k"
    done
    files=()
    for k in $(seq "$fillings"); do
        files+=("$out/$scene.$k.left")
        echo "$scene, filling $k: stood still$(stops "$out/$scene.$k.left") ($(sed -n '2s/# //p' "$out/$scene.$k.left"))"
    done
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
