#!/usr/bin/env bash
# verify/dilated.sh - dilated polyhedra in long runs:
#   grains whose core is nothing against spheres: the same places within 1e-9 of a diameter;
#   a stack of ten cubes for ten seconds; the same with its cubes shifted.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
bad=0
command -v ncdump > /dev/null || ./run.sh install netcdf-bin

say() { # GOOD TEXT
    if [ "$1" = 1 ]; then echo "ok   $2"; else echo "FAIL $2"; bad=1; fi
}

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
