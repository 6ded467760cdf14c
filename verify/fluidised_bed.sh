#!/usr/bin/env bash
# verify/fluidised_bed.sh [SECONDS] - over a long run the Goldschmidt bed's pressure drop averages to its
# weight within 3 %. Simulates so many seconds (5) and leaves out the first; ten minutes of one core for
# each, so `make verify` does not run it. Ends with status 1 where it is off.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
./run.sh scenes/fluidised_bed.ini "run.end=${1:-5} s" "reference.from=1 s" -j 1 -o "$tmp/run" > "$tmp/log" 2>&1
grep '^reference:' "$tmp/log" || tail -n 3 "$tmp/log"
grep -q '^verdict = pass' "$tmp/run/summary.txt"
