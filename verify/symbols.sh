#!/usr/bin/env bash
# verify/symbols.sh - every answer of a slot exports what the slot's reference answer exports, and
# adding an answer is one new file: a throw-away law of drag is built into a binary, found in it,
# and removed again, with nothing else in the tree changed.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
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

exported() {
    nm -D --defined-only "$1" | awk '{ print $NF }' | sort
}

# Names that a sanitizer or the linker adds are no part of a contract.
contract() {
    exported "$1" | grep -v -E '^(__|_init$|_fini$|_edata$|_end$)'
}

state() {
    git status --porcelain --untracked-files=all 2> /dev/null
    git ls-files -z --cached --others --exclude-standard |
        xargs -0 sh -c 'for f; do [ -e "$f" ] && cksum "$f"; done' sh
}

make -s -j"$(nproc)" answers > /dev/null
check $? "every answer builds"
for folder in shapes contact contact/rolling contact/bond contact/cohesion contact/lubrication \
    drag porosity solver/fluid reference; do
    reference=none
    [ "$folder" = shapes ] && reference=sphere
    want=$(contract "build/release/answers/$folder/$reference.so")
    [ -n "$want" ]
    check $? "$folder/$reference exports $(wc -w <<< "$want") symbols"
    for source in "$folder"/*.c; do
        name=$(basename "$source" .c)
        [ "$name" = "$reference" ] && continue
        difference=$(diff <(echo "$want") <(contract "build/release/answers/$folder/$name.so") |
            grep '^[<>]' | tr '\n' ' ')
        [ -z "$difference" ]
        check $? "$folder/$name exports the same${difference:+: $difference}"
    done
done

for source in forces/*.c; do
    name=$(basename "$source" .c)
    [ "$(contract "build/release/answers/forces/$name.so")" = "force_$name" ]
    check $? "forces/$name exports force_$name alone"
done

# What a binary says of keys that it lacks is read from the sources: it must be what the answers say.
make -s build/release/front
said=$(build/release/front keys | sed -n '/^with a fluid/,$p' | awk '
    /^[a-z]+ = / { owner = $1 " " $3 } /^$/ { next } /^[a-z]/ && !/ = / { owner = "" }
    /^  / && owner { print owner, $1 }' | sort)
read_there=$(sed -n 's/^    {"\(.*\)", "\(.*\)", "\(.*\)", "\(.*\)"},$/\3 \4 \1.\2/p' build/release/lists/keys.c |
    grep -v '^wall\.kind' | sort)
difference=$(diff <(echo "$said") <(echo "$read_there") | grep '^[<>]' | tr '\n' ' ')
[ -n "$said" ] && [ -z "$difference" ]
check $? "$(wc -l <<< "$said") keys of answers are found in their sources${difference:+: $difference}"

name=zz_throwaway_$$
remove() {
    rm -rf "drag/$name.c" build/release/obj/drag/"$name".* build/release/answers/drag/"$name".so \
        build/release/bin/*"$name"*
}
trap remove EXIT
before=$(state)
sed -e "s/\"none\"/\"$name\"/" -e 's/return 0\.0;/return 1.25;/' drag/none.c > "drag/$name.c"
grep -q '1\.25' "drag/$name.c" && grep -q "\"$name\"" "drag/$name.c"
check $? "a throw-away law: one new file, drag/$name.c"
make -s WERROR=-Werror DRAG="$name" silt > build/throwaway.log 2>&1
binary=$(make -s DRAG="$name" where)
[ -n "$binary" ] && [ -x "$binary" ]
check $? "a binary links with it$(grep -m 1 -E 'error|undefined' build/throwaway.log | sed 's/^/: /')"
refusal=$("$binary" scenes/bounce.ini -o build/throwaway 2>&1)
[[ $refusal == *"built with $name"* ]]
check $? "the binary holds it: it refuses a scene of another law"
if [ -x run.sh ]; then
    listed=$(./run.sh modules 2> /dev/null | grep -c "$name")
    [ "$listed" -ge 1 ]
    check $? "run.sh modules lists it"
fi
for folder in contact drag porosity; do # slots that have their folder's name
    files=$(cd "$folder" && echo *.c | sed 's/\.c//g')
    listed=$(./run.sh modules "$folder" 2> /dev/null | grep -E '^  [a-z]' | awk '{ print $1 }' | xargs)
    [ "$listed" = "$files" ]
    check $? "run.sh modules $folder lists the files of $folder/"
done
added=$(diff <(echo "$before") <(state) | grep '^[<>]' | grep -v "drag/$name.c")
[ -z "$added" ]
check $? "nothing else in the tree has changed${added:+: $added}"
remove
[ "$before" = "$(state)" ]
check $? "removed again, the tree is as before"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
