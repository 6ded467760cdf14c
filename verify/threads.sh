#!/usr/bin/env bash
# verify/threads.sh - the same bits on 1, 2, 3, 7 and 16 threads, on the granular scenes in short form:
# every number of run.nc, contacts with their forces among them.
#   verify/threads.sh [SCENE ...]
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0
[ $# -gt 0 ] || set -- hopper angle_of_repose drum funnel triaxial clumps
make -s build/release/front
for scene; do
    slots=$(build/release/front slots "scenes/$scene.ini")
    # shellcheck disable=SC2086
    make -s $slots silt
    # shellcheck disable=SC2086
    binary=$(make -s $slots where)
    for j in 1 2 3 7 16; do
        "$binary" "scenes/$scene.ini" "run.end=40 ms" "output.every=20 ms" -o "$tmp/$scene$j" -j $j \
            > "$tmp/log" 2>&1
        # every number of run.nc by value where ncdump is there, else those of the summary
        if command -v ncdump > /dev/null; then
            ncdump -p 17 "$tmp/$scene$j/run.nc" | sed -n '/^data:/,$p' > "$tmp/$scene$j.sum"
        else
            grep -v -E '^(time_|wall|threads|grain_steps_per|date)' "$tmp/$scene$j/summary.txt" > "$tmp/$scene$j.sum"
        fi
        if [ -s "$tmp/$scene$j.sum" ] && cmp -s "$tmp/${scene}1.sum" "$tmp/$scene$j.sum"; then
            passed=$((passed + 1))
            echo "ok   $scene: the same bits on 1 and $j threads, $(wc -l < "$tmp/$scene$j.sum") lines"
        else
            failed=$((failed + 1))
            echo "FAIL $scene: other bits on $j threads"
            tail -n 3 "$tmp/log"
        fi
    done
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
