#!/usr/bin/env bash
# verify/report.sh - build/verify (made by verify.sh) as one page, verify/report/index.html: what was
# compared with what, by how much it is off, what it cost; the studies; the figures. It holds its
# pictures and needs no network. Run again alone after a look at build/verify.
#   scenes/NAME/{summary.txt,*.png}   a run, with the lines reference_* of its summary
#   tests/NAME.{log,seconds}          lines "ok TEXT: GOT, want WANT within TOLERANCE"
#   sections/NAME.txt                 tables as text; the first line is the title
#   studies/NAME.{out,seconds}, studies/NAME/1/trade.png ...
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
from=build/verify
page=verify/report/index.html
mkdir -p verify/report

escape() {
    sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g' -e 's/>/\&gt;/g'
}

value() { # FILE KEY: without its unit
    sed -n "s/^$2 = \([^ ]*\).*/\1/p" "$1"
}

text() { # FILE KEY
    sed -n "s/^$2 = //p" "$1"
}

picture() { # FILE CAPTION
    printf '<figure><img alt="%s" src="data:image/png;base64,%s"><figcaption>%s</figcaption></figure>\n' \
        "$2" "$(base64 -w 0 "$1")" "$2"
}

# "[Stokes1851]; [Ergun52, eq. 3]": each key with what NOTATION.md says of it as a tooltip.
source_of() {
    local key title out=
    while read -r key; do
        [ -n "$key" ] || continue
        title=$(grep -F "| $key |" NOTATION.md | head -n 1 | cut -d '|' -f 3 | escape | tr -d '"')
        out+="<abbr title=\"$title\">$key</abbr> "
    done < <(grep -o '\[[A-Za-z0-9]*' <<< "$1" | tr -d '[')
    echo "${out:-$(escape <<< "$1")}"
}

verdict() { # pass|FAIL|...
    case $1 in
        pass | ok) echo '<td class="good">pass</td>' ;;
        none | "") echo '<td>none</td>' ;;
        *) echo "<td class=\"bad\">$1</td>" ;;
    esac
}

head_of_table() {
    echo '<table><tr><th>case<th>reference<th>quantity<th>silt<th>reference value<th>error<th>tolerance<th>verdict<th>cost</tr>'
}

scene_rows() {
    local f name
    for f in "$from"/scenes/*/summary.txt; do
        [ -e "$f" ] || continue
        name=$(basename "$(dirname "$f")")
        if ! grep -q '^verdict = ' "$f"; then # no reference: what it handed over and what is left
            printf '<tr><td>%s<td>none<td>ledger of mass, momentum, energy<td>%s<td>closes<td><td>' "$name" \
                "$(text "$f" ledger | escape)"
            verdict "$(text "$f" ledger | sed 's/^closes.*/pass/' | escape)"
            printf '<td>%.3g s</tr>\n' "$(value "$f" wall_time)"
            continue
        fi
        printf '<tr><td>%s<td>%s<td>%s<td>%s<td>%s<td>%s<td>%s' "$name" \
            "$(source_of "$(text "$f" reference_source)") ($(value "$f" module_reference))" \
            "$(text "$f" reference_quantity | escape)" "$(text "$f" reference_value)" \
            "$(text "$f" reference_expected)" "$(value "$f" reference_error)" \
            "$(value "$f" reference_tolerance)"
        verdict "$(value "$f" verdict)"
        printf '<td>%.3g s</tr>\n' "$(value "$f" wall_time)"
    done
}

# Each test with its count; within, every comparison of two numbers.
tests() {
    local log name counts
    for log in "$from"/tests/*.log; do
        [ -e "$log" ] || continue
        name=$(basename "$log" .log)
        counts=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log" | tail -n 1)
        printf '<details><summary>%s: %s, %s s%s</summary>\n' "$name" "$counts" \
            "$(cat "${log%.log}.seconds")" \
            "$(grep -q ', 0 failed$' <<< "$counts" || echo ' <b class="bad">FAIL</b>')"
        echo '<table><tr><th>case<th>silt<th>reference value<th>error<th>tolerance<th>verdict</tr>'
        escape < "$log" | awk '
            match($0, /: [-+0-9.e]+, want [-+0-9.e]+ (within|\+-) [-+0-9.e]+$/) {
                text = substr($0, 6, RSTART - 6)
                n = split(substr($0, RSTART + 2), w, /[, ]+/)
                got = w[1]; want = w[3]; absolute = w[4] == "+-"; tol = w[5]
                off = absolute ? got - want : want != 0 ? got / want - 1 : got
                printf "<tr><td>%s<td>%s<td>%s<td>%.3g%s<td>%s<td class=\"%s\">%s</tr>\n", text, got, want,
                    off, absolute ? " (absolute)" : "", tol, /^ok/ ? "good" : "bad", /^ok/ ? "pass" : "FAIL"
                next
            }
            /^(ok|FAIL)/ {
                printf "<tr><td colspan=\"5\">%s<td class=\"%s\">%s</tr>\n", substr($0, 6),
                    /^ok/ ? "good" : "bad", /^ok/ ? "pass" : "FAIL"
            }'
        echo '</table></details>'
    done
}

studies() {
    local out name file
    for out in "$from"/studies/*.out; do
        [ -e "$out" ] || continue
        name=$(basename "$out" .out)
        file=scenes/studies/$name.study
        echo "<h3>$name</h3><p>$(sed -n '/^#/!q; s/^# *//p' "$file" | escape)</p>"
        grep -E '^(edge:|[0-9]+ points:|the limits of check|BROKEN)|(^|: )(the cheapest|no variant|the least error)' "$out" |
            escape | sed 's|.*|<p><b>&</b></p>|'
        for picture in "$from/studies/$name"/*/{trade,extremes}.png; do
            [ -e "$picture" ] && picture "$picture" "$name: $(basename "$picture" .png)"
        done
        echo "<details><summary>its tables, $(cat "$from/studies/$name.seconds") s; ./run.sh study $file</summary><pre>"
        escape < "$out"
        echo '</pre></details>'
    done
}

sections() {
    local f
    for f in "$from"/sections/*.txt; do
        [ -e "$f" ] || continue
        echo "<h3>$(head -n 1 "$f" | escape)</h3><pre>"
        tail -n +2 "$f" | escape
        echo '</pre>'
    done
}

figures() {
    local f
    for f in "$from"/scenes/*/{settling,pressure_drop,rebound,discharge,cavity_u,cavity_v,profile,head,bubbling_bed}.png "$from"/{mass_error,detectors}.png docs/drag_*.png; do
        [ -e "$f" ] && picture "$f" "$(basename "$(dirname "$f")" | sed 's/^docs$/closures/'): $(basename "$f" .png)"
    done
}

cpu=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
failed=$(grep -l 'FAIL' "$from"/tests/*.log "$from"/sections/*.txt 2> /dev/null | wc -l)
{
    cat << 'HTML'
<!doctype html><html lang="en"><meta charset="utf-8"><title>silt: verification</title>
<style>
body { font: 15px/1.45 "DejaVu Sans", sans-serif; margin: 2em auto; max-width: 75em; padding: 0 1em; color: #222 }
table { border-collapse: collapse; font-size: 13px; margin: .6em 0 }
th, td { text-align: left; padding: .25em .7em; border-bottom: 1px solid #ddd; vertical-align: top }
.good { color: #2b7a3d } .bad { color: #b8301f; font-weight: bold }
pre { background: #f6f6f6; padding: .8em; overflow-x: auto; font-size: 12px }
figure { display: inline-block; margin: .5em; width: 31em } img { width: 100% } figcaption { font-size: 12px; color: #666 }
details { margin: .3em 0 } abbr { text-decoration: none; border-bottom: 1px dotted #999 }
</style>
<h1>silt: verification</h1>
HTML
    echo "<p>$(git describe --always --dirty 2> /dev/null), $(date -u +'%F %R UTC'). $(uname -srm), $cpu, $(nproc) cores;" \
        "$(gcc --version | head -n 1); GSL $(gsl-config --version 2> /dev/null || echo '?')," \
        "netCDF $(nc-config --version 2> /dev/null | cut -d ' ' -f 2)." \
        "Made by <code>make verify</code>.</p>"
    echo '<h2>Scenes against their references</h2>'
    head_of_table
    scene_rows
    echo '</table><h2>What a scene requires, and what it holds</h2>'
    [ -e "$from/minimal.txt" ] && { echo '<pre>'; escape < "$from/minimal.txt"; echo '</pre>'; }
    echo '<h2>What accuracy costs, and where it breaks</h2>'
    studies
    echo '<h2>Cases at full size</h2>'
    sections
    echo '<h2>Every closure and every module: tests with values</h2>'
    tests
    echo '<h2>Figures</h2>'
    figures
    echo '</html>'
} > "$page.part" && mv "$page.part" "$page"
echo "$page: $(wc -c < "$page") bytes"
[ "$failed" -eq 0 ]
