#!/usr/bin/env bash
# bench/cubes.sh [quick] - a settled bed of 1,000 cubes with rounded edges (bench/cubes.ini) and ten such beds
# side by side, beside YADE's polyhedra and potential particles and LAMMPS' body/rounded/polyhedron on the same
# bed, one core each: grain-steps a second, median of three runs (the peers: one). Target: 100,000, and 10,000
# cubes no slower a grain. First what a pair costs that does not touch, for cubes, tetrapods, superquadrics and level
# sets. The bed settles once (minutes) and is kept in build/bench.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
command -v ncdump > /dev/null || ./run.sh install netcdf-bin
quick=${1:-}
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
export OMP_NUM_THREADS=1
limit="timeout ${LIMIT:-120}"
kept=build/bench
side=0.024
mkdir -p $kept
make -s SHAPE=dilated_polyhedron CONTACT=hertz_mindlin silt
silt=$(make -s SHAPE=dilated_polyhedron CONTACT=hertz_mindlin where)
if ! cmp -s bench/cubes.ini $kept/cubes.ini; then
    echo "(a bed of 1,000 cubes settles first)" >&2
    timeout 1200 "$silt" bench/cubes.ini -j 1 -o "$tmp/bed" > "$tmp/log" 2>&1 || { tail -n 3 "$tmp/log"; exit 1; }
    cp "$tmp/bed/bed.nc" $kept/cubes.nc && cp bench/cubes.ini $kept/cubes.ini
fi
ncdump -l 200 -v position,orientation,radius $kept/cubes.nc > "$tmp/bed.cdl"

lay() { # FORMAT NX NY
    awk -v format="$1" -v nx="$2" -v ny="$3" -v side=$side -f bench/cubes.awk "$tmp/bed.cdl"
}

# Wall clock and processor time of one step: those of a run, less those of one with a tenth of its steps.
time_silt() { # NX NY STEPS; prints grain-steps a second by wall clock, by processor time
    local n=$((1000 * $1 * $2)) steps
    local keys=("domain.size=$((24 * $1)) $((24 * $2)) 60 mm" "grains cubes.count=$n" "grains cubes.fill=file"
        "grains cubes.file=$tmp/$n.nc" output.bed=none run.dt="10 us" -j 1 -o "$tmp/run")
    for steps in $(($3 / 10)) "$3"; do
        TIMEFORMAT='%R %U'
        { time "$silt" bench/cubes.ini "run.end=$((10 * steps)) us" "${keys[@]}" > "$tmp/log" 2>&1; } 2>&1 || {
            tail -n 3 "$tmp/log" >&2
            exit 1
        }
    done | awk -v w="$(($3 - $3 / 10))" -v n=$n '{ for (k = 1; k <= 2; k++) t[k] = $k - t[k] }
        END { print n * w / t[1], n * w / t[2] }'
}

report() { # NAME RATE; beside silt's
    awk -v name="$1" -v r="$2" -v own="$rate" 'BEGIN {
        printf "%-34s %9.0f grain-steps/s, silt %.0f times that\n", name, r, own / r }'
}

# Grain-steps a second from the last line "Loop time of T [on 1 procs] for K steps with N atoms".
peer_rate() { # LOG
    sed -n 's/^Loop time of \([^ ]*\) .*for \([0-9]*\) steps with \([0-9]*\) atoms.*/\1 \2 \3/p' "$1" | tail -n 1 |
        awk '{ print $2 * $3 / $1 }'
}

rounds=3
[ "$quick" = quick ] && rounds=1
echo "pairs whose balls overlap: how they are told apart, and what it costs (bench/far_pairs.h)"
for kind in dilated multi_dilated superquadric level_set; do
    make -s "build/release/bench/far_$kind" && build/release/bench/far_$kind
done
for tiles in "1 1" "2 5"; do
    read -r nx ny <<< "$tiles"
    n=$((1000 * nx * ny))
    lay cdl "$nx" "$ny" | ncgen -o "$tmp/$n.nc"
    for ((k = 0; k < rounds; k++)); do
        time_silt "$nx" "$ny" $((nx * ny == 1 ? 2000 : 200)) || exit 1
    done > "$tmp/rates"
    wall=$(cut -d ' ' -f 1 "$tmp/rates" | sort -g | sed -n "$(((rounds + 1) / 2))p")
    own=$(cut -d ' ' -f 2 "$tmp/rates" | sort -g | sed -n "$(((rounds + 1) / 2))p")
    [ "$n" -eq 1000 ] && rate=$wall
    printf '%-34s %9.0f grain-steps/s by wall clock, %.0f by processor time, %s contacts a grain\n' \
        "silt, $n dilated cubes" "$wall" "$own" \
        "$(sed -n 's/^contacts_per_grain = \([^ ]*\).*/\1/p' "$tmp/run/summary.txt")"
done

absent() { # PROGRAM PACKAGE
    ! command -v "$1" > /dev/null && echo "($1 is not installed and left out; apt-get install $2)"
}
if ! absent lmp lammps; then
    lay body 1 1 > "$tmp/bed.body"
    $limit lmp -in bench/cubes.lmp -log "$tmp/lmp.log" -screen none -var in "$tmp/bed.body" -var side $side \
        -var relax 10 -var steps 40 > "$tmp/out" 2>&1 < /dev/null &&
        report "LAMMPS body rounded/polyhedron" "$(peer_rate "$tmp/lmp.log")" ||
        echo "(LAMMPS does not run: $(cat "$tmp/out" "$tmp/lmp.log" | grep -v '^ *$' | tail -n 1))"
fi
if ! absent yade yade; then
    lay text 1 1 > "$tmp/bed.text"
    for kind in polyhedra:60 particles:10; do
        $limit yade -j1 -n -x bench/cubes_yade.py "$tmp/bed.text" $side "${kind%:*}" $((${kind#*:} / 5)) "${kind#*:}" \
            > "$tmp/yade.log" 2>&1 < /dev/null &&
            report "YADE ${kind%:*}" "$(peer_rate "$tmp/yade.log")" ||
            echo "(YADE's ${kind%:*} do not run within ${LIMIT:-120} s: $(tail -n 1 "$tmp/yade.log"))"
    done
fi
exit 0
