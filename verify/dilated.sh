#!/usr/bin/env bash
# verify/dilated.sh [FOLDER] - dilated polyhedra:
#   what their detectors of contacts give (verify/detectors.c): GJK against brute force, crowned faces and the
#   envelope for many k against it, with their cost, and jumps of force and torque along sweeps;
#   FOLDER/detectors.png, by default build/verify;
#   grains whose core is nothing against spheres: the same places within 1e-9 of a diameter;
#   a stack of ten cubes for ten seconds; the same with its cubes shifted.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
out=${1:-build/verify}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0
command -v ncdump > /dev/null || ./run.sh install netcdf-bin

say() { # GOOD TEXT
    if [ "$1" = 1 ]; then echo "ok   $2"; else echo "FAIL $2"; bad=1; fi
}

mkdir -p "$out"
make -s build/release/verify/detectors || exit 2
nice=$(build/release/verify/detectors "$tmp" > "$tmp/log" && echo 1 || echo 0)
cat "$tmp/log"
say "$nice" "distance of two cubes by GJK within 1e-10 of brute force"
say "$(awk '/JUMPS/ && $2 != "exact" { bad = 1 } /continuous/ { n++ } END { print (n > 20 && !bad) }' "$tmp/log")" \
    "force and torque along sweeps: continuous with crowned faces and with the envelope"
gnuplot << END || exit 2
set terminal pngcairo size 1500,460 font 'DejaVu Sans,11'
set output '$out/detectors.png'
set multiplot layout 1,3 title 'Two dilated cubes, 0.02 radii deep: detectors of contacts'
set logscale xy
set format '10^{%T}'
set grid lc rgb '#dddddd'
set key top left
set xrange [5e-7:1]
set yrange [1e-8:1e3]
set xlabel 'k of the envelope'
set ylabel 'mean error (dashed: crowned faces)'
mean(h, c) = sprintf("< awk '\$1 == %d && \$2 > 0 { print \$2, \$%d }' $tmp/errors.dat", h, c)
crowned(h, c) = sprintf("< awk '\$1 == %d && \$2 == 0 { print 6e-7, \$%d; print 0.9, \$%d }' $tmp/errors.dat", h, c, c)
set title 'error (edge to edge)'
plot mean(1, 3) with linespoints pt 5 lc rgb '#0072b2' title 'depth over the radius', \
     mean(1, 5) with linespoints pt 9 lc rgb '#d55e00' title 'normal, rad', \
     mean(1, 7) with linespoints pt 7 lc rgb '#009e73' title 'force, relative', \
     crowned(1, 3) with lines dt 2 lc rgb '#0072b2' notitle, crowned(1, 5) with lines dt 2 lc rgb '#d55e00' notitle, \
     crowned(1, 7) with lines dt 2 lc rgb '#009e73' notitle
set title 'what accuracy costs'
set xlabel 'ns a pair'
set ylabel 'mean error of the force, relative'
set xrange [300:1e5]
set yrange [1e-6:1e4]
set key top right
both(h, crown) = sprintf("< awk '\$1 == %d && (%d ? \$2 == 0 : \$2 > 0) { print \$9, \$7 }' $tmp/errors.dat", h, crown)
plot both(0, 0) with linespoints pt 5 lc rgb '#0072b2' title 'envelope, face to face', \
     both(1, 0) with linespoints pt 9 lc rgb '#d55e00' title 'edge to edge', \
     both(2, 0) with linespoints pt 7 lc rgb '#009e73' title 'vertex to face', \
     both(0, 1) with points pt 4 ps 2 lw 2 lc rgb '#0072b2' title 'crowned, face to face', \
     both(1, 1) with points pt 8 ps 2 lw 2 lc rgb '#d55e00' title 'edge to edge', \
     both(2, 1) with points pt 6 ps 2 lw 2 lc rgb '#009e73' title 'vertex to face'
set title 'jumps along sweeps'
set xlabel 'step of the sweep'
set ylabel 'largest change of the torque over the largest force'
set xrange [1e-5:1e-2]
set yrange [1e-5:1e4]
jump(name, k) = sprintf("< awk '\$1 == \"%s\" && \$2 == %g { print \$3, \$5 }' $tmp/jumps.dat", name, k)
plot jump('face_over_edge', 0) with linespoints pt 5 lc rgb '#0072b2' title 'crowned: over an edge', \
     jump('rocking_on_a_face', 0) with linespoints pt 4 lc rgb '#0072b2' title 'rocking', \
     jump('seam_of_a_letter', 0) with linespoints pt 6 lc rgb '#0072b2' title 'seam of a letter', \
     jump('face_over_edge', 0.01) with linespoints pt 9 lc rgb '#d55e00' title 'envelope, k 0.01: over an edge', \
     jump('rocking_on_a_face', 0.01) with linespoints pt 8 lc rgb '#d55e00' title 'rocking', \
     jump('face_over_edge', -1) with linespoints pt 7 lc rgb '#888888' title 'sharp cores: over an edge', \
     jump('rocking_on_a_face', -1) with linespoints pt 6 lc rgb '#888888' title 'rocking'
END
echo "  picture: $out/detectors.png"

# Numbers of one variable of run.nc, one a line.
numbers() { # DIR VARIABLE
    ncdump -p 9,17 -v "$2" "$1/run.nc" | sed -n "/^ $2 =/,/;/p" | sed "s/^ $2 =//" | tr ',; ' '\n\n\n' | grep .
}

balls() { # SHAPE KEYS
    cat > "$tmp/$1.ini" <<END
[modules]
shape = $1
contact = hertz_mindlin
[domain]
size = 30 30 60 mm
[grains balls]
$2
diameter = 5 mm
density = 2500 kg/m3
count = 60
fill = random
material = m
[material m]
young = 5 MPa
poisson = 0.3
restitution = 0.5
friction = 0.4
[run]
end = 60 ms
dt = 20 us
END
    ./run.sh "$tmp/$1.ini" -o "$tmp/$1" -j 1 > "$tmp/log" 2>&1 || { cat "$tmp/log"; exit 1; }
    numbers "$tmp/$1" position > "$tmp/$1.txt"
}
balls sphere ""
balls dilated_polyhedron $'form = cube\ndilation = 2.5 mm'
worst=$(paste "$tmp/sphere.txt" "$tmp/dilated_polyhedron.txt" |
    awk '{ d = $1 - $2; if (d < 0) d = -d; if (d > w) w = d } END { printf "%.3g", w / 5e-3 }')
say "$(awk -v w="$worst" 'BEGIN { print (w < 1e-9 && w != "") }')" \
    "a core of nothing against spheres: places within $worst of a diameter"

stack() { # SHIFT (mm)
    {
        printf '[modules]\nshape = dilated_polyhedron\ncontact = hertz_mindlin\n[domain]\nsize = 100 100 200 mm\n'
        printf '[material m]\nyoung = 1 GPa\npoisson = 0.3\nrestitution = 0.3\nfriction = 0.5\n[run]\nend = 10 s\n'
        for k in 0 1 2 3 4 5 6 7 8 9; do
            printf '[grains c%d]\nform = cube\ndilation = 1 mm\ndiameter = 12.305212830\ndensity = 2500 kg/m3\n' "$k"
            printf 'orientation = aligned\nfill = point\nmaterial = m\n'
            awk -v k="$k" -v s="$1" 'BEGIN { printf "position = %.9g %.9g %.9g mm\n",
                50 + s * (k * 7 % 5 - 2), 50 + s * (k * 3 % 5 - 2), 5.1 + 10.1 * k }'
        done
    } | sed 's/^diameter = .*/& mm/' > "$tmp/stack.ini"
    ./run.sh "$tmp/stack.ini" -o "$tmp/stack" -j 1 > "$tmp/log" 2>&1 || { cat "$tmp/log"; exit 1; }
    numbers "$tmp/stack" kinetic_energy | awk '{ if ($1 > m) m = $1; e = $1 } END { printf "%.3g", e / m }'
}
left=$(stack 0)
say "$(awk -v w="$left" 'BEGIN { print (w < 1e-12) }')" "stack of ten cubes: energy after 10 s $left of its most"
left=$(stack 0.3)
say "$(awk -v w="$left" 'BEGIN { print (w < 1e-12) }')" "the same, shifted by 0.3 and 0.6 mm: $left"
exit $bad
