#!/usr/bin/env bash
# bench/dem.sh - read by bench/peers.sh and bench/scaling.sh: the settled bed of bench/dem.ini, larger
# ones of it, runs of silt on them, medians. Beds are kept in build/bench.
#
# A thread that waits for another stays awake for a tenth of a millisecond, then sleeps: where other
# programs hold the processors, it would spin in the time of the one it waits for.
export GOMP_SPINCOUNT=${GOMP_SPINCOUNT:-20000}
make -s -j"$(nproc)" build/release/bench/dem_tile build/release/bench/dem_peak
make -s -j"$(nproc)" CONTACT=hertz_mindlin silt
tile=build/release/bench/dem_tile
peak=build/release/bench/dem_peak
plain=$(make -s CONTACT=hertz_mindlin where)
beds=build/bench
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
mkdir -p $beds

# Path of a binary in single precision, or nothing where it does not build.
single() { # SLOT=ANSWER ...
    local path
    path=$(make -s REAL=float "$@" where 2> /dev/null) || return 0
    [ "$path" != "$(make -s "$@" where)" ] || return 0
    make -s -j"$(nproc)" REAL=float "$@" silt > /dev/null 2>&1 || return 0
    echo "$path"
}

# The bed of 10,000, settled once; as long as the scene is the same.
settled() {
    if ! cmp -s bench/dem.ini $beds/dem.ini; then
        echo "(a bed of 10,000 spheres settles first)" >&2
        "$plain" bench/dem.ini -o "$tmp/settled" > /dev/null 2>&1
        cp "$tmp/settled/bed.nc" $beds/dem.nc
        cp bench/dem.ini $beds/dem.ini
    fi
}

# Tiles for a number of grains: beds side by side in x and y.
tiles() { # GRAINS
    case $1 in
        10000) echo 1 1 ;;
        100000) echo 2 5 ;;
        1000000) echo 10 10 ;;
    esac
}

bed() { # FORMAT GRAINS; its path
    local file=$tmp/$2.$1 nx ny
    if [ ! -e "$file" ]; then
        read -r nx ny <<< "$(tiles "$2")"
        $tile "$1" $beds/dem.nc 0.04 0.04 "$nx" "$ny" > "$file"
    fi
    echo "$file"
}

# Runs silt on a bed: the summary in $tmp/run, the peak of memory in $tmp/peak. What it prints is
# shown where it fails.
silt() { # BINARY GRAINS THREADS STEPS [section.key=value ...]
    local binary=$1 grains=$2 threads=$3 steps=$4 nx ny
    shift 4
    read -r nx ny <<< "$(tiles "$grains")"
    $peak "$tmp/peak" "$binary" bench/dem.ini "domain.size=$((40 * nx)) $((40 * ny)) 60 mm" \
        "grains g.fill=file" "grains g.file=$(bed text "$grains")" output.bed=none \
        "run.end=$((10 * steps)) us" "$@" -j "$threads" -o "$tmp/run" > "$tmp/log" 2>&1 ||
        { tail -n 3 "$tmp/log" >&2 && return 1; }
}

summary() { # KEY
    sed -n "s/^$1 = \([^ ]*\).*/\1/p" "$tmp/run/summary.txt"
}

# Median of the last word of the lines that begin with these words; "-" where there is none.
median() { # FILE WORDS
    awk -v words="$2 " 'index($0, words) == 1 { print $NF }' "$1" | sort -g |
        awk '{ x[NR] = $1 } END { print NR == 0 ? "-" : NR % 2 ? x[(NR + 1) / 2] : (x[NR / 2] + x[NR / 2 + 1]) / 2 }'
}
