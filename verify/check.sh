#!/usr/bin/env bash
# verify/check.sh - `make check`: every test, one after the other; the sum of their counts at the end.
#   every answer compiles without a warning; the layout is clang-format's
#   unit and contract tests, with address and undefined-behaviour sanitizers
#   the exported symbols of every answer; a throw-away answer is one new file
#   wrong scenes are refused; the shipped scenes in short form against their references
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
log=build/check.log
mkdir -p build
: > "$log"
passed=0
failed=0

# One test: its output to the log, failures to the terminal, its counts to the sum.
tally() {
    local name=$1 out status counts
    shift
    out=$("$@" 2>&1)
    status=$?
    printf '== %s\n%s\n' "$name" "$out" >> "$log"
    counts=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' <<< "$out" | tail -n 1)
    if [ -z "$counts" ]; then
        counts="0 passed, 1 failed"
        out+=$'\n'"FAIL $name ended with status $status before its count"
    elif [ "$status" -ne 0 ] && [[ $counts == *" 0 failed" ]]; then
        counts="${counts%% *} passed, 1 failed"
        out+=$'\n'"FAIL $name ended with status $status"
    fi
    passed=$((passed + ${counts%% *}))
    failed=$((failed + $(cut -d ' ' -f 3 <<< "$counts")))
    printf '%-28s %s\n' "$name" "$counts"
    if [[ $counts != *" 0 failed" ]]; then
        grep -E '^FAIL' <<< "$out" || tail -n 25 <<< "$out"
    fi
}

# A command that either works or does not, as one test.
single() {
    local out
    if out=$("$@" 2>&1); then
        echo "1 passed, 0 failed"
    else
        printf '%s\nFAIL %s\n0 passed, 1 failed\n' "$out" "$*"
    fi
}

# ncdump lets the tests compare run.nc number by number; without it they compare the summaries.
command -v ncdump > /dev/null || ./run.sh install netcdf-bin || :

jobs=$(nproc)
tally "build, no warnings" single make -s -j"$jobs" WERROR=-Werror tools answers
if command -v clang-format > /dev/null; then
    tally "format" single make -s format-check
else
    echo "format                       skipped: no clang-format here"
fi
tests=$(cd verify && ls test_*.c | sed 's/\.c$//')
tally "build of the tests" single make -s -j"$jobs" WERROR=-Werror MODE=debug \
    $(printf 'build/debug/verify/%s ' $tests)
export ASAN_OPTIONS=detect_leaks=0
for t in $tests; do
    tally "$t" "build/debug/verify/$t"
done
for t in symbols bad_scenes scenes threads shapes studies; do
    tally "$t" "verify/$t.sh"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
