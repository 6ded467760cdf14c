#!/usr/bin/env bash
# verify/studies.sh - the driver of studies on small scenes: table, files, exit codes, resuming.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0

check() { # STATUS TEXT
    if [ "$1" -eq 0 ]; then
        echo "ok   $2"
        passed=$((passed + 1))
    else
        echo "FAIL $2"
        failed=$((failed + 1))
    fi
}

# A small fall: 0.1 s a run.
fall=(scenes/settling.ini coupling.ways=two run.end="2 ms" run.dt="5 us" output.series="1 ms")
trade() { # NAME ARGUMENTS: exit code in $code
    local name=$1
    shift
    ./run.sh trade "$@" -o "$tmp/$name" > "$tmp/$name.out" 2> "$tmp/$name.err"
    code=$?
}

trade a "${fall[@]}" cell_d=4,8 porosity=divided,nonsense --repeats 2 --within 50%
check $((code != 0)) "a trade of four variants, two of which are refused"
[ "$(grep -c 'refused: .*nonsense' "$tmp/a.out")" -eq 2 ]
check $? "what is refused stays in the table with its reason"
[ "$(grep -c ',refused,' "$tmp/a/trade.csv")" -eq 2 ] && [ -s "$tmp/a/trade.nc" ] && [ -s "$tmp/a/trade.png" ]
check $? "and in trade.csv; trade.nc and trade.png are there"
grep -q 'the cheapest within 50 %' "$tmp/a.out"
check $? "the recommendation"
command=$(grep -A 1 '^the cheapest' "$tmp/a.out" | tail -n 1)
eval "$command -o $tmp/alone" > "$tmp/alone.out" 2>&1
error=$(sed -n 's/^reference_error = -\{0,1\}//p' "$tmp/alone/summary.txt")
[ -n "$error" ] && grep -q ",$error," "$tmp/a/trade.csv"
check $? "its command gives the error of the table to the last digit: $error"

before=$(wc -l < "$tmp/a/journal.txt")
trade a "${fall[@]}" cell_d=4,8 porosity=divided,nonsense --repeats 2 --within 1e-9%
check $((code != 1)) "exit code 1 where none is within the error"
[ "$(grep -c good "$tmp/a/journal.txt")" -eq 4 ]
check $? "nothing ran again ($before lines)"
grep -q 'no variant is within' "$tmp/a.out"
check $? "and it says so"

# The same study, stopped by a signal after its first run, then gone on with.
./run.sh trade "${fall[@]}" cell_d=4,5,8 --repeats 2 -o "$tmp/b" > "$tmp/b.out" 2> "$tmp/b.err" &
child=$!
for _ in $(seq 200); do
    [ -s "$tmp/b/journal.txt" ] && break
    sleep 0.05
done
kill -TERM $child
wait $child
code=$?
[ $code -eq 143 ] && grep -q 'goes on from here' "$tmp/b.err"
check $? "a signal stops a study: 143, and it says how to go on"
made=$(grep -c good "$tmp/b/journal.txt")
[ "$made" -ge 1 ] && [ "$made" -lt 6 ]
check $? "with $made of 6 runs made"
first=$(head -n 1 "$tmp/b/journal.txt")
trade b "${fall[@]}" cell_d=4,5,8 --repeats 2
[ $code -eq 0 ] && [ "$(grep -c good "$tmp/b/journal.txt")" -eq 6 ] && [ "$(head -n 1 "$tmp/b/journal.txt")" = "$first" ]
check $? "the same command makes the others and keeps those"

trade c "${fall[@]}" fluid.dt="10,20,40 us" --quantity velocity --against finest --plan one --repeats 1
check $((code != 0)) "a quantity against the finest variant"
trade d "${fall[@]}" nonsense=1,2
[ $code -eq 2 ] && grep -q 'no such axis' "$tmp/d.err"
check $? "an axis that does not exist is refused"
trade e scenes/bounce.ini density_ratio=1,2
[ $code -eq 2 ] && grep -q 'no fluid' "$tmp/e.err"
check $? "and a named axis that does not apply"

# Two of the shipped studies in short form, whose recommendation comes to the same error again.
for name in packed_bed settling_sphere; do
    ./run.sh study scenes/studies/$name.study --short -o "$tmp/$name" > "$tmp/$name.out" 2> "$tmp/$name.err"
    [ $? -eq 0 ] && [ "$(grep -c ',good,' "$tmp/$name/1/trade.csv")" -eq 8 ] && grep -q '^the cheapest within 5 %' "$tmp/$name.out"
    check $? "$name in short form: 8 variants, and one to recommend"
done

./run.sh extremes scenes/bounce.ini grain_step=0.05,0.5,20 --timeout 20 -o "$tmp/x" > "$tmp/x.out" 2> "$tmp/x.err"
[ $? -eq 0 ] && grep -q '^edge: grain_step' "$tmp/x.out" && grep -q ' 0 broken' "$tmp/x.out"
check $? "extremes find where a step is too long: $(grep -m 1 '^edge' "$tmp/x.out")"
[ -s "$tmp/x/extremes.nc" ] && [ -s "$tmp/x/extremes.png" ] && [ -s "$tmp/x/edges.csv" ]
check $? "and leave files"
grep '^edge: grain_step' "$tmp/x.out" | grep -q 'a quarter of a contact, ball is reached at 1$'
check $? "beside the limit that check names"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
