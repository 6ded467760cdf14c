#!/usr/bin/env bash
# verify/drag_figures.sh - two figures a law of drag can be chosen by, and the table of their errors.
#   docs/drag_settling.png   terminal velocity of one sphere, every law against Brown and Lawler's
#   docs/drag_porosity.png   normalised drag against porosity at four Reynolds numbers
# verify/drag_figures.c says what is compared. Part of `make verify`; takes seconds.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-docs}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
make -s -j"$(nproc)" build/release/verify/drag_figures
build/release/verify/drag_figures "$tmp"

# style INDEX FAMILY: colours of the suspensions first; beds dashed, isolated grains dotted
colours=('#d55e00' '#0072b2' '#009e73' '#cc79a7' '#e69f00' '#56b4e9' '#7f3c8d' '#5a8a00' '#000000'
    '#b2182b' '#2166ac' '#8c510a' '#01665e' '#c51b7d')
style() {
    local dash=1
    [ "$2" = packed ] && dash="'-'"
    [ "$2" = isolated ] && dash="'.'"
    [ "$1" -ge ${#colours[@]} ] && dash="'_.'"
    echo "lc rgb '${colours[$(($1 % ${#colours[@]}))]}' dt $dash"
}

# The curves of a list as `plot` arguments: LIST FORMAT, with FILE, STYLE, TITLE replaced.
curves() {
    local k family title text index=-1 last=
    while IFS=';' read -r k family title; do
        [ "$family" = "$last" ] || index=-1
        last=$family
        index=$((index + 1))
        text=${2//FILE/$tmp/${1%.list}_$k.dat}
        printf '%s, ' "${text//STYLE/$(style $index "$family")}"
    done < <(sort -t ';' -k 2,2r -k 3,3 "$tmp/$1")
}

# The legend, a line of the picture each: families with their headings, long titles broken.
legend() {
    local k family title index=-1 last= part
    while IFS=';' read -r k family title; do
        if [ "$family" != "$last" ]; then
            index=-1
            [ -z "$last" ] || printf "NaN with lines lc bgnd title ' ', "
            case $family in
                suspension) printf "NaN with lines lc bgnd title 'beds and suspensions', " ;;
                packed) printf "NaN with lines lc bgnd title 'packed beds only', " ;;
                isolated) printf "NaN with lines lc bgnd title 'one grain on its own', " ;;
            esac
        fi
        last=$family
        index=$((index + 1))
        part="lw 2 $(style $index "$family")"
        while read -r line; do
            printf "NaN with lines %s title '%s', " "$part" "$line"
            part="lc bgnd"
        done < <(sed 's/ = /, /g' <<< "$title" | fold -s -w 26 | sed 's/ *$//')
    done < <(sort -t ';' -k 2,2r -k 3,3 "$tmp/$1")
}

# What both pictures begin and end with.
legend_panel="set lmargin at screen 0.78; set rmargin at screen 0.995; set tmargin at screen 0.965
set bmargin at screen 0.03; unset title; unset border; unset tics; unset grid; unset xlabel
unset ylabel; unset arrow; unset logscale; set xrange [0:1]; set yrange [0:1]
set key noenhanced inside left top Left reverse spacing 1.2 samplen 3"

gnuplot << GNUPLOT
set terminal pngcairo size 1050,1100 font 'Sans,10' linewidth 1.2
set output '$out/drag_settling.png'
set multiplot
set logscale x
set xrange [1e-3:1e5]
set format x '10^{%T}'
set lmargin at screen 0.07
set rmargin at screen 0.75
set grid lc rgb '#dddddd'
set arrow 1 from 40, graph 0 to 40, graph 1 nohead lc rgb '#999999' dt 3
unset key
set tmargin at screen 0.965
set bmargin at screen 0.72
set title 'One sphere settles: every law against Brown and Lawler (2003), at equal Archimedes number'
set logscale y
set yrange [1e-3:1e2]
set format y '10^{%T}'
set ylabel 'u* = u [rho^2 / (mu g drho)]^{1/3}' noenhanced
plot $(curves settling.list '"FILE" using 1:3 with lines lw 1.5 STYLE') \
    "< head -n 1000 $tmp/settling_$(head -n 1 "$tmp/settling.list" | cut -d ';' -f 1).dat" using 1:2 every 20 with points pt 6 lc rgb 'black'
unset title
unset logscale y
set format y '%g'
set tmargin at screen 0.685
set bmargin at screen 0.385
set yrange [-50:60]
set ylabel 'velocity over theirs - 1, %'
plot $(curves settling.list '"FILE" using 1:(100*$4) with lines lw 1.5 STYLE') 0 lc rgb 'black' lw 0.7
set tmargin at screen 0.35
set bmargin at screen 0.05
set yrange [-10:10]
set xlabel 'Reynolds number of Brown and Lawler''s sphere (dotted: 40)'
plot $(curves settling.list '"FILE" using 1:(100*$4) with lines lw 1.5 STYLE') 0 lc rgb 'black' lw 0.7
$legend_panel
plot $(legend settling.list) NaN with points pt 6 lc rgb 'black' title 'Brown and Lawler (above)'
unset multiplot

reset
set terminal pngcairo size 1450,880 font 'Sans,10' linewidth 1.2
set output '$out/drag_porosity.png'
set multiplot
set grid lc rgb '#dddddd'
set xrange [0.35:1]
set xtics 0.4, 0.2
array re = [0.01, 1, 100, 1000]
array low = [0.7, 0.7, 2, 10]
array high = [70, 70, 200, 2000]
array most = [4, 4, 12, 80]
unset key
do for [p=1:4] {
    set lmargin at screen 0.052 + 0.186 * (p - 1)
    set rmargin at screen 0.052 + 0.186 * (p - 1) + 0.152
    set tmargin at screen 0.95
    set bmargin at screen 0.54
    set logscale y
    set yrange [low[p]:high[p]]
    set title sprintf('Re = %g', re[p])
    unset xlabel
    set ylabel (p == 1 ? 'F / (3 pi mu d U)' : '') noenhanced
    plot $(curves porosity.list '"FILE" index p-1 using 1:2 with lines lw 0.6 STYLE, "" index p-1 using 1:3 with lines lw 2 STYLE') 1/0
    set tmargin at screen 0.48
    set bmargin at screen 0.06
    unset logscale y
    set yrange [0:most[p]]
    unset title
    set xlabel 'fluid fraction eps'
    set ylabel (p == 1 ? 'the same times eps^3' : '') noenhanced
    plot $(curves porosity.list '"FILE" index p-1 using 1:($1**3*$2) with lines lw 0.6 STYLE, "" index p-1 using 1:($1**3*$3) with lines lw 2 STYLE') 1/0
}
$legend_panel
set lmargin at screen 0.79
plot $(legend porosity.list) NaN with lines lc bgnd title ' ', NaN with lines lc bgnd title 'thick where the law holds'
unset multiplot
GNUPLOT
