#!/usr/bin/env bash
# run.sh - from a scene to a result: installs what is missing, builds what the scene requires, runs
# it, draws. `./run.sh help` lists the commands.
set -euo pipefail

caller=$PWD
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=build/${MODE:-release}             # MODE=debug: with sanitizers
real=${REAL:-double}                   # REAL=float: the contact loop in single precision
unset MAKEFLAGS MFLAGS MAKELEVEL REAL  # this may be called by make

usage() {
    cat <<'TEXT'
./run.sh [SCENE] [section.key=value ...] [-o DIR] [-j THREADS]
                         build what the scene requires, run it, draw; default: scenes/packed_bed.ini
./run.sh check SCENE [section.key=value ...]
                         the feasibility report: every limit as a ratio; runs nothing
./run.sh trade SCENE axis=values ... [--within 5%]
                         error against cost; axis: a key, a slot, real, threads, a named axis,
                         or name@FILE: sets of keys, as scenes/studies/grains.sets
./run.sh extremes SCENE [axis=values ...]
                         where it breaks: each point right, wrong, refused, stopped or broken
./run.sh study FILE [--short] [-o DIR]
                         the trades and extremes of scenes/studies/NAME.study
./run.sh axes            the named axes of trade and extremes
    options of trade:    --within E: the error to be within; exit 1 where none is
                         --error KEY: the line of summary.txt that is the error (reference_error)
                         --quantity KEY,...: or lines that are compared, with
                         --against finest | NUMBER | TABLE.csv: the last value on every axis, ...
                         --per AXIS: a condition, no choice: what is best at each of its values
                         --mean AXIS: repetitions (seeds): errors and costs of means over them
                         --plan grid | one | front: all variants; each axis alone; where the front is
                         --cost wall | core | memory     --confirm: runs what it recommends again
    of both:             --repeats N  --timeout S  --fresh  --keep  -j THREADS  -o DIR
    of extremes:         --within E  --no-edges  --no-force
./run.sh build SCENE [section.key=value ...]
                         the path of the binary for the scene
./run.sh plot DIR        the pictures of a run again
./run.sh modules [SLOT]  every answer of every slot (of one): equation, source, range, keys
./run.sh keys            every key of a scene: unit, range, default, meaning
./run.sh install [PACKAGE ...]
                         install the Debian packages that are missing, and these
./run.sh help            this text
Exit codes: 0 good; 2 bad scene or usage; 3 unstable or unphysical state; 4 could not write;
130, 143 stopped by a signal, outputs complete up to there.
TEXT
}

refuse() {
    echo "silt: $*" >&2
    exit 2
}

# Debian packages that are missing, by the file or command that shows each.
missing_packages() {
    command -v gcc > /dev/null || echo gcc
    command -v make > /dev/null || echo make
    command -v gnuplot > /dev/null || echo gnuplot-nox
    local include=/usr/include
    [ -e $include/stdlib.h ] || echo libc6-dev
    [ -e $include/gsl/gsl_rng.h ] || echo libgsl-dev
    [ -e $include/fftw3.h ] || echo libfftw3-dev
    [ -e $include/netcdf.h ] || echo libnetcdf-dev
    [ -e $include/libqhull_r/libqhull_r.h ] || echo libqhull-dev
    [ -e $include/ini.h ] || echo libinih-dev
    [ -e $include/udunits2.h ] || [ -e $include/udunits2/udunits2.h ] || echo libudunits2-dev
}

install_packages() {
    local packages sudo=()
    mapfile -t packages < <(missing_packages)
    packages+=("$@")
    [ ${#packages[@]} -eq 0 ] && return
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo > /dev/null || ! sudo -n true 2> /dev/null; then
            refuse "packages are missing; install them with: apt-get install ${packages[*]}"
        fi
        sudo=(sudo -n)
    fi
    command -v apt-get > /dev/null ||
        refuse "packages are missing, and there is no apt-get here: ${packages[*]}"
    echo "installing ${packages[*]}" >&2
    mkdir -p "$root/build"
    if ! { "${sudo[@]}" apt-get update &&
        "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y \
            --no-install-recommends "${packages[@]}"; } > "$root/build/install.log" 2>&1; then
        tail -n 5 "$root/build/install.log" >&2
        refuse "the packages could not be installed; the whole log is in build/install.log"
    fi
}

# make, quiet unless it fails; one at a time, for runs that start together
build() {
    local log
    mkdir -p build
    if ! log=$(flock build/lock make -s -j"$(nproc)" "$@" 2>&1); then
        echo "$log" >&2
        refuse "the build has failed"
    fi
}

# A path as the caller means it: from where he is, or from the project's folder.
find_scene() {
    local path=$1
    if [[ $path != /* && $caller != "$root" && -e $caller/$path ]]; then
        path=$caller/$path
    fi
    if [ ! -e "$path" ]; then
        [[ $path == *[./]* ]] ||
            refuse "$path: No such file, and no such command; there are check, plot, modules, keys," \
                "install, help"
        refuse "$path: No such file"
    fi
    echo "$path"
}

from_caller() {
    case $1 in
        /*) echo "$1" ;;
        *) if [ "$caller" = "$root" ]; then echo "$1"; else echo "$caller/$1"; fi ;;
    esac
}

# Splits the arguments of `run` and `check` into the variables below.
scene=
directory=
threads=()
overrides=()
status=0
parse() {
    while [ $# -gt 0 ]; do
        case $1 in
            -o | -j)
                [ -n "${2:-}" ] || refuse "$1 needs a value"
                if [ "$1" = -o ]; then
                    directory=$2
                else
                    [[ $2 =~ ^[1-9][0-9]{0,3}$ ]] ||
                        refuse "-j takes a number of threads, 1 to 1024, not $2"
                    threads=(-j "$2")
                fi
                shift
                ;;
            "") refuse "an empty argument (./run.sh help)" ;;
            -*) refuse "no such option: $1 (./run.sh help)" ;;
            *=*) overrides+=("$1") ;;
            *)
                [ -z "$scene" ] || refuse "one scene only, not also $1 (./run.sh help)"
                scene=$1
                ;;
        esac
        shift
    done
}

# Builds the binary of the scene; its path in $binary.
build_scene() {
    local slots
    build "$bin/front"
    slots=$("$bin/front" slots "$scene" "${overrides[@]}") || exit $?
    read -r -a slots <<< "$slots"
    build "${slots[@]}" REAL="$real" silt
    binary=$(make -s "${slots[@]}" REAL="$real" where)
}

# Runs the program and hands signals on to it: it completes its outputs and ends by itself. In
# $status its exit code.
run_program() {
    local child again=yes
    # The shell lets what it starts by & ignore Ctrl-C, which the program must not.
    (trap - INT && exec "$binary" "$scene" "${overrides[@]}" -o "$directory" "${threads[@]}") &
    child=$!
    trap 'kill -INT $child 2> /dev/null || :; again=yes' INT
    trap 'kill -TERM $child 2> /dev/null || :; again=yes' TERM HUP
    while [ $again = yes ]; do
        again=no
        status=0
        wait $child || status=$?
    done
    trap - INT TERM HUP
}

run_scene() {
    local name plot
    scene=$(find_scene "${scene:-scenes/packed_bed.ini}")
    if [ -z "$directory" ]; then
        name=$(basename "$scene")
        directory=out/${name%.ini}
        [ "$caller" = "$root" ] || directory=$root/$directory
    else
        directory=$(from_caller "$directory")
    fi
    build_scene
    build "$bin/plot" &
    plot=$!
    run_program
    wait $plot || [ $status -ne 0 ] || status=2
    if [ $status -eq 0 ]; then
        "$bin/plot" "$directory" || status=$?
    fi
    exit $status
}

# trade, extremes: the scene and -o as the caller means them, everything else as it is.
run_study() {
    local verb=$1 arguments=() found=
    shift
    while [ $# -gt 0 ]; do
        case $1 in
            -o)
                [ -n "${2:-}" ] || refuse "$1 needs a value"
                arguments+=(-o "$(from_caller "$2")")
                shift
                ;;
            --within | --error | --quantity | --per | --mean | --against | --plan | --cost | --repeats | --timeout | -j)
                [ -n "${2:-}" ] || refuse "$1 needs a value"
                arguments+=("$1" "$2")
                shift
                ;;
            -* | *=*) arguments+=("$1") ;;
            *)
                [ -z "$found" ] || refuse "one scene only, not also $1 (./run.sh help)"
                found=$(find_scene "$1")
                arguments+=("$found")
                ;;
        esac
        shift
    done
    [ -n "$found" ] || refuse "usage: ./run.sh $verb SCENE axis=values ... (./run.sh help)"
    build "$bin/front" "$bin/$verb"
    REAL="$real" exec "$bin/$verb" "${arguments[@]}"
}

# A .study: commands (trade, extremes) with their scene, then one argument a line; `#` begins a comment.
# Below [short]: what stands in place of, or beside, these in the short form of the first command.
# Each command's output goes to DIR/NUMBER.
study() {
    local file=$1 short=$2 out=$3 line key part=full n=0 i arguments=() worst=0 status
    run_command() {
        [ ${#arguments[@]} -eq 0 ] && return
        n=$((n + 1))
        echo "== ${arguments[*]}"
        status=0
        "$root/run.sh" "${arguments[@]}" -o "$out/$n" || status=$?
        [ $status -lt 128 ] || exit $status
        [ $status -le $worst ] || worst=$status
        arguments=()
    }
    while IFS= read -r line || [ -n "$line" ]; do
        line=${line%%#*}
        line=$(sed -e 's/^[[:space:]]*//' -e 's/[[:space:]]*$//' -e 's/[[:space:]]*=[[:space:]]*/=/' \
            -e 's/,[[:space:]]*/,/g' <<< "$line")
        [ -n "$line" ] || continue
        case $line in
            "[short]")
                [ "$short" = yes ] || break
                part=short
                ;;
            trade\ * | extremes\ *)
                run_command
                arguments=("${line%% *}" "${line#* }")
                ;;
            --* | -j*)
                key=${line%% *}
                [ "$key" = "$line" ] && arguments+=("$line") || arguments+=("$key" "${line#* }")
                ;;
            *=*)
                key=${line%%=*}
                for i in "${!arguments[@]}"; do
                    [[ $part = short && ${arguments[i]} == "$key="* ]] && unset "arguments[i]"
                done
                arguments+=("$line")
                ;;
            *) refuse "$file: neither a command, nor an axis, nor an option: $line" ;;
        esac
    done < "$file"
    run_command
    exit $worst
}

cd "$root"
case ${1:-} in
    help | -h | --help)
        usage
        ;;
    install)
        shift
        install_packages "$@"
        ;;
    modules | keys)
        [ $# -eq 1 ] || { [ "$1" = modules ] && [ $# -eq 2 ]; } ||
            refuse "usage: ./run.sh modules [SLOT], ./run.sh keys"
        install_packages
        build "$bin/front" answers
        "$bin/front" "$@"
        ;;
    axes)
        build "$bin/extremes"
        "$bin/extremes" axes
        ;;
    build)
        shift
        parse "$@"
        [ -n "$scene" ] || refuse "usage: ./run.sh build SCENE [section.key=value ...]"
        scene=$(find_scene "$scene")
        build_scene
        echo "$binary"
        ;;
    study)
        [ $# -ge 2 ] || refuse "usage: ./run.sh study FILE [--short] [-o DIR]"
        file=$(find_scene "$2")
        shift 2
        short=no
        name=$(basename "$file")
        directory=$root/out/${name%.study}-study
        while [ $# -gt 0 ]; do
            case $1 in
                --short) short=yes ;;
                -o)
                    [ -n "${2:-}" ] || refuse "$1 needs a value"
                    directory=$(from_caller "$2")
                    shift
                    ;;
                *) refuse "usage: ./run.sh study FILE [--short] [-o DIR]" ;;
            esac
            shift
        done
        install_packages
        study "$file" $short "$directory"
        ;;
    trade | extremes)
        install_packages
        run_study "$@"
        ;;
    plot)
        [ $# -eq 2 ] || refuse "usage: ./run.sh plot DIR"
        install_packages
        build "$bin/plot"
        "$bin/plot" "$(from_caller "$2")"
        ;;
    check)
        shift
        parse "$@"
        [ -n "$scene" ] || refuse "usage: ./run.sh check SCENE [section.key=value ...]"
        [ -z "$directory" ] || refuse "check writes nothing: it takes no -o"
        install_packages
        scene=$(find_scene "$scene")
        build_scene
        "$binary" "$scene" "${overrides[@]}" --check "${threads[@]}"
        ;;
    *)
        parse "$@"
        install_packages
        run_scene
        ;;
esac
