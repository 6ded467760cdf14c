#!/usr/bin/env bash
# verify/drag_settling.sh - a run of scenes/settling.ini with every law of drag that has an isolated
# sphere: the grain's velocity against the exact solution of its equation of motion with that law.
# Laws that see a shape are run with one besides. Part of `make verify`; a few seconds a law.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0
make -s -j"$(nproc)" build/release/front build/release/plot answers || exit 2

value() {
    sed -n "s/^$1 = \([^ ]*\).*/\1/p" "$tmp/run/summary.txt"
}

# fall NAME OVERRIDE...: on the terminal velocity within the scene's 0.1 %, and at it
fall() {
    local name=$1 binary slots verdict=FAIL
    shift
    slots=$(build/release/front slots scenes/settling.ini "$@") || return
    binary=$(make -s $slots silt where)
    rm -rf "$tmp/run"
    "$binary" scenes/settling.ini "$@" -o "$tmp/run" > "$tmp/log" 2>&1
    if grep -q '^verdict = pass' "$tmp/run/summary.txt" 2> /dev/null &&
        awk -v v="$(value velocity)" -v t="$(value terminal_velocity)" \
            'BEGIN { exit !(v > 0.999 * t && v < 1.001 * t) }'; then
        verdict=ok
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        tail -n 3 "$tmp/log"
    fi
    printf '  %-4s %-32s u %-11s terminal %-11s (Re %-8s) largest difference on the way %s\n' $verdict \
        "$name" "$(value velocity)" "$(value terminal_velocity)" "$(value terminal_reynolds)" \
        "$(value velocity_error_worst)"
}

for source in drag/*.c; do
    law=$(basename "$source" .c)
    grep -q '\.isolated = ' "$source" || continue
    # long enough for the terminal velocity: a fall of 24 relaxation times
    fall "$law" modules.drag="$law" "run.end=20 ms"
    if grep -q '\.shape' "$source"; then
        fall "$law, sphericity 0.7" modules.drag="$law" "run.end=20 ms" \
            "grains bead.sphericity=0.7"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
