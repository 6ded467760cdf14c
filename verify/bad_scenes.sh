#!/usr/bin/env bash
# verify/bad_scenes.sh - wrong scenes are refused: exit 2, file:line, key, value, what is allowed, all
# errors at once, and nothing written.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
passed=0
failed=0

cat > "$tmp/good.ini" <<'INI'
; a small bed in a slow flow
[modules]
contact  = linear
drag     = ergun
porosity = divided
fluid    = navier_stokes
[domain]
size  = 10 10 20 mm
cells = 5 5 10
x     = periodic
y     = periodic
z-    = inflow
z+    = outflow
[grains beads]
diameter = 1 mm
density  = 2500 kg/m3
count    = 50
fill     = random
[material beads]
stiffness   = 1000 N/m
restitution = 0.8
friction    = 0.3
[fluid]
density   = 1000 kg/m3
viscosity = 1 mPa s
dt        = 0.1 ms
[flow]
velocity = 1 mm/s
[run]
end = 1 ms
dt  = 2 us
INI

./run.sh "$tmp/good.ini" -o "$tmp/good" > "$tmp/log" 2>&1 || { cat "$tmp/log"; echo "FAIL the good scene runs"; failed=1; }
slots=$(build/release/front slots "$tmp/good.ini")
binary=$(make -s $slots where)

verdict() { # good-or-not, text
    if [ "$1" = 0 ]; then
        passed=$((passed + 1))
        echo "ok   $2"
    else
        failed=$((failed + 1))
        echo "FAIL $2"
        sed 's/^/     /' "$tmp/err" | head -n 5
    fi
}

# The last run: exit code 2, this on stderr, no folder.
judge() { # status, pattern, name
    local good=0
    [ "$1" = 2 ] || good=1
    grep -q -E -- "$2" "$tmp/err" || good=1
    [ ! -e "$tmp/out" ] || good=1
    verdict $good "$3"
    rm -rf "$tmp/out"
}

# edit NAME SED-EXPRESSION PATTERN: the good scene, edited
edit() {
    local status=0
    sed -e "$2" "$tmp/good.ini" > "$tmp/bad.ini"
    cmp -s "$tmp/good.ini" "$tmp/bad.ini" && echo "FAIL $1: the edit changes nothing" && failed=$((failed + 1))
    "$binary" "$tmp/bad.ini" -o "$tmp/out" > /dev/null 2> "$tmp/err" || status=$?
    judge $status "$3" "$1"
}

# with NAME PATTERN OVERRIDE...: the good scene, overridden
with() {
    local name=$1 pattern=$2 status=0
    shift 2
    "$binary" "$tmp/good.ini" "$@" -o "$tmp/out" > /dev/null 2> "$tmp/err" || status=$?
    judge $status "$pattern" "$name"
}

# whole NAME PATTERN FILE [ARGUMENT...]: through run.sh
whole() {
    local name=$1 pattern=$2 status=0
    shift 2
    ./run.sh "$@" -o "$tmp/out" > /dev/null 2> "$tmp/err" || status=$?
    judge $status "$pattern" "$name"
}

bad="$tmp/bad.ini"
edit "unknown key" 's/^viscosity/viscositty/' "$bad:25: fluid.viscositty = 1 mPa s: no such key \(did you mean fluid.viscosity\?\)"
edit "unknown section" 's/^\[flow\]/[flwo]/' "$bad:27: \[flwo\]: no such section \(did you mean flow\?\)"
with "form c gives no viscous force" "modules.forces = viscous: fluid.form = c has viscous in the drag" fluid.form=c modules.forces=viscous
with "a table that is not there" "flow.table = nowhere.csv: no such file" flow.table=nowhere.csv
with "a rate along a side" "flow.rate = 0 0 1 mm/s: drives periodic directions only" "flow.rate=0 0 1 mm/s"
with "a rate and a gradient" "contradicts flow.rate" "flow.rate=1 0 0 mm/s" "flow.pressure_gradient=1 0 0 Pa/m"
with "a probe outside" "probe a.at = 0 0 30 mm: lies outside the box in z" "probe a.at=0 0 30 mm"
with "a line without its end" "probe a.to: must differ from probe.at" "probe a.kind=line"
with "an inflow of a wall" "only a side of kind inflow takes it" "side x-.inflow=1 mm/s"
edit "repeated key" '/^count/a count = 60' "$bad:18: grains beads.count = 60: given twice, first in line 17"
edit "repeated section" '/^\[run\]/i [fluid]\ndensity = 900 kg/m3' "$bad:29: \[fluid\]: given twice, first in line 23"
edit "wrong dimension" 's/2500 kg\/m3/2500 kg/' "$bad:16: grains beads.density = 2500 kg: .*wrong dimension.*kg m-3"
edit "missing unit" 's/diameter = 1 mm/diameter = 1/' "$bad:15: grains beads.diameter = 1: needs a unit, as in m"
edit "unknown unit" 's/1 mPa s/1 mPaa s/' "$bad:25: fluid.viscosity = 1 mPaa s: .*is not a unit"
edit "unit on a pure number" 's/restitution = 0.8/restitution = 0.8 mm/' "$bad:21: material beads.restitution = 0.8 mm: .*pure number"
edit "restitution above 1" 's/restitution = 0.8/restitution = 1.3/' "$bad:21: material beads.restitution = 1.3: must lie in \(0, 1\]"
edit "restitution zero" 's/restitution = 0.8/restitution = 0/' "must lie in \(0, 1\]"
edit "negative friction" 's/friction    = 0.3/friction = -1/' "$bad:22: material beads.friction = -1: must lie in \[0, inf\)"
edit "negative size" 's/10 10 20 mm/10 -10 20 mm/' "$bad:8: domain.size = 10 -10 20 mm: must lie in \(0, 1e6\] m"
edit "two numbers for three" 's/10 10 20 mm/10 10 mm/' "$bad:8: domain.size = 10 10 mm: must be three numbers"
edit "four numbers for three" 's/10 10 20 mm/10 10 20 5 mm/' "$bad:8: domain.size"
edit "a word for a number" 's/= 1000 N\/m/= stiff/' "$bad:20: material beads.stiffness = stiff: must be one number"
edit "not a number" 's/= 1000 N\/m/= nan N\/m/' "$bad:20: material beads.stiffness = nan N/m: must be one number"
edit "infinite" 's/= 1000 N\/m/= 1e999 N\/m/' "$bad:20: material beads.stiffness = 1e999"
edit "half a grain" 's/^count    = 50/count = 50.5/' "$bad:17: grains beads.count = 50.5: must be one whole number"
edit "cells zero" 's/^cells = 5 5 10/cells = 5 0 10/' "$bad:9: domain.cells = 5 0 10: .*each 1 at least"
edit "no cells" '/^cells/d' "domain.cells.*a scene with a fluid needs"
edit "choice that is none" 's/^fill     = random/fill = rain/' "$bad:18: grains beads.fill = rain: must be one of lattice"
edit "grains that cannot fit" 's/^count    = 50/count = 1000000/' "$bad:17: grains beads.count = 1000000: the grains fill .* % of their region"
edit "a shape for a law of spheres" 's/^count    = 50/&\nsphericity = 0.8/' "$bad:18: grains beads.sphericity = 0.8: drag = ergun does not depend on it: it takes every grain for a sphere"
edit "grain wider than the box" 's/diameter = 1 mm/diameter = 25 mm/' "$bad:15: grains beads.diameter = 25 mm: the widest grain, 0.025 m, is wider than the region"
edit "periodic on one side" 's/^z-    = inflow/z- = periodic/' "$bad:12: domain.z- = periodic: periodic must hold for both sides"
edit "side given twice" 's/^y     = periodic/&\ny- = wall/' "domain.y- = wall: contradicts domain.y"
edit "inflow without outflow" 's/^z+    = outflow/z+ = wall/' "an inflow side needs an outflow side"
edit "head with Navier-Stokes" 's/^z+    = outflow/z+ = head/' "$bad:13: domain.z\+ = head: head sides are for fluid = darcy"
edit "grain step past its limit" 's/^dt  = 2 us/dt = 90 us/' "$bad:31: run.dt = 90 us: .*a quarter of a contact.* allows"
edit "fluid step past its limit" 's/0.1 ms/2 s/' "$bad:26: fluid.dt = 2 s: .*allows"
edit "grain step above the fluid's" 's/^dt  = 2 us/dt = 1 ms/' "run.dt = 1 ms: must not be longer than fluid.dt"
edit "required key missing" '/^end/d' "$bad:29: run.end: must be given"
edit "required section missing" '/^\[fluid\]/,/^dt/d' "fluid.density: must be given"
edit "material missing" '/^\[material/,/^friction/d' "material beads.stiffness: must be given"
edit "section without a name" 's/^\[grains beads\]/[grains]/' "$bad:14: \[grains\]: needs a name"
edit "unclosed section" 's/^\[flow\]/[flow/' "$bad:27: .*without its closing bracket"
edit "line that is nothing" 's/^velocity = .*/velocity 1 mm\/s/' "$bad:28: .*neither a \[section\]"
edit "key before any section" '1s/.*/end = 1 s/' "$bad:1: end = 1 s: stands before the first"
edit "key that nothing uses" 's/^fill     = random/&\nspacing = 2 mm/' "$bad:19: grains beads.spacing = 2 mm: nothing in this scene uses it"
edit "pair of no materials" '$a [pair beads-steel]\nfriction = 0.1' "pair beads-steel.friction = 0.1: nothing in this scene uses it"
edit "wall of no material" '$a [wall lid]\npoint = 0 0 15 mm\nnormal = 0 0 -1\nmaterial = steel' "wall lid.material = steel: there is no \[material steel\]"
edit "staircase without steps" 's/^velocity = 1 mm\/s/&\nvelocity_end = 2 mm\/s/' "flow.steps.*at least 2"
edit "count and mass" 's/^count    = 50/&\nmass = 1 g/' "$bad:18: grains beads.mass = 1 g: give one of count, mass and porosity"
edit "less than a grain" 's/^count    = 50/mass = 0.1 mg/' "$bad:17: grains beads.mass = 0.1 mg: is less than half a grain"
edit "sizes without their ends" 's/^count    = 50/&\nsizes = uniform/; /^diameter/d' "grains beads.diameter_min: must be given for sizes = uniform"
edit "sizes upside down" 's/^count    = 50/&\nsizes = uniform\ndiameter_min = 1 mm\ndiameter_max = 0.9 mm/; /^diameter = 1/d' "grains beads.diameter_max = 0.9 mm: must be above diameter_min"
edit "log-normal without a spread" 's/^count    = 50/&\nsizes = lognormal/' "grains beads.spread: must be given for sizes = lognormal"
edit "size table missing" 's/^count    = 50/&\nsizes = table\nsize_file = nosuch.csv/; /^diameter/d' "grains beads.size_file = nosuch.csv: nosuch.csv: No such file"
printf 'diameter mm, fraction\n1, 0.3\n2, 0.6\n' > "$tmp/sizes.csv"
edit "size table that adds up to less" 's/^count    = 50/&\nsizes = table\nsize_file = sizes.csv/; /^diameter/d' "sizes.csv: the fractions must add up to 1 .or 100., they add up to 0.9"
printf 'diameter mm, fraction\n1, 0.3\n0.9, 0.7\n' > "$tmp/falls.csv"
edit "size table that falls" 's/^count    = 50/&\nsizes = table\nsize_file = falls.csv/; /^diameter/d' "falls.csv:3: diameters must rise"
edit "denser than random" 's/^count    = 50/porosity = 0.37/' "grains beads.porosity = 0.37: the grains find no room without overlap.*or fill = grow"
edit "denser than they can grow" 's/10 10 20 mm/5 5 6 mm/; s/^cells = 5 5 10/cells = 5 5 6/; s/^count    = 50/porosity = 0.33/; s/= random/= grow/' "grains beads.porosity = 0.33: the growing grains jam at 0.9.* of their diameter, where the porosity of their region is 0.[34]"
edit "a grain inside a named wall" 's/= random/= point/; s/^count    = 50/position = 6.3 5 10 mm/; $a [wall post]\nkind = cylinder\npoint = 5 5 0 mm\naxis = 0 0 1\nradius = 1 mm\nlength = 20 mm' "$bad:[0-9]+: .wall post.: a grain starts inside it, at 0.0063 0.005 0.01 m, by 0.4 of its radius"
edit "a grain behind a named wall" 's/= random/= point/; s/^count    = 50/position = 5 5 2 mm/; $a [wall floor]\npoint = 0 0 3 mm\nnormal = 0 0 1' "$bad:[0-9]+: .wall floor.: a grain starts behind it, at 0.005 0.005 0.002 m"
edit "a wall out of the box" '$a [wall post]\nkind = disc\npoint = 5 5 300 mm\nnormal = 0 0 1\nradius = 1 mm' "$bad:[0-9]+: .wall post.: lies outside of the box: its z goes from 0.3 to 0.3 m"
edit "a wall too wide for the period" '$a [wall ramp]\nkind = rectangle\ncorner = 0 0 1 mm\nedge1 = 10 0 3 mm\nedge2 = 0 10 0 mm' "$bad:[0-9]+: .wall ramp.: is 0.01 m wide in periodic x, across which it does not run straight"
edit "a servo with a speed of its own" '$a [wall lid]\npoint = 0 0 19 mm\nnormal = 0 0 -1\ndirection = 0 0 -1\npush = 1 N\nspeed_max = 1 m/s\nvelocity = 1 0 -1 m/s' "wall lid.velocity = 1 0 -1 m/s: a servo sets the speed along its direction"
edit "no room between the walls" '$a [wall roof]\npoint = 0 0 0.7 mm\nnormal = 0 0 -1' "between the walls there is no place in the region for a grain of 0.001 m"
edit "a source with two rates" '$a [insert rain]\nrate = 100 1/s\nmass_flow = 1 g/s' "insert rain.rate = 100 1/s: give one of rate and mass_flow"
edit "a source of no species" '$a [insert rain]\nrate = 100 1/s\nspecies = sand' "insert rain.species = sand: there is no .grains sand."
edit "a source outside the box" '$a [insert rain]\nrate = 100 1/s\nshape = sphere\nradius = 4 mm\ncentre = 5 5 18 mm' ".insert rain.: the region leaves the box in z"
edit "a source too narrow" '$a [insert rain]\nrate = 100 1/s\nshape = disc\nradius = 0.4 mm' ".insert rain.: the region is narrower than the largest grain"
edit "a source that cannot find room" '$a [insert rain]\nrate = 1e7 1/s\nevery = 1 ms' "insert rain.rate = 1e7 1/s: a batch .* would fill"
edit "a region without its radius" '$a [delete hole]\nshape = sphere' "delete hole.radius: must be given for this shape"
edit "an open side that is periodic" '$a [side x-]\ngrains = open' "side x-.grains = open: a periodic side is no way out"
edit "bed file missing" 's/^fill     = random/fill = file\nfile = nosuch.txt/; /^count/d' "grains beads.file = nosuch.txt: nosuch.txt: No such file"
printf 'x y z d\n' > "$tmp/bed.txt"
edit "bed file without grains" "s/^fill     = random/fill = file\nfile = bed.txt/; /^count/d" "bed.txt: holds no grain"
printf 'x y z d\n1 2 a\n' > "$tmp/bed.txt"
edit "bed file that is no bed" "s/^fill     = random/fill = file\nfile = bed.txt/; /^count/d" "bed.txt:2: must hold x y z diameter"
edit "unit cells that do not fit" 's/^fill     = random/fill = unit_cell\nspacing = 3 mm/; /^count/d' "grains beads.spacing = 3 mm: the region holds 3.33333 unit cells"
edit "periodic box of one grain" 's/10 10 20 mm/1.7 10 20 mm/; s/^count    = 50/count = 5/' "$bad:8: domain.size = 1.7 10 20 mm: must be 0.002 m at least in periodic x"
edit "grains inside a wall" 's/^fill     = random/fill = unit_cell\ncell = bcc\nspacing = 2.5 mm/; /^count/d; s/diameter = 1 mm/diameter = 1.5 mm/' "grains beads.fill = unit_cell: places a grain at .* inside a wall in z"
edit "several errors at once, first" 's/= 0.8/= 1.3/; s/1 mPa s/1 kg/' "$bad:21: material beads.restitution = 1.3"
grep -q "$bad:25: fluid.viscosity = 1 kg" "$tmp/err"
verdict $? "several errors at once, second"
edit "reciprocal of the unit" 's/1 mPa s/1 1\/(mPa s)/' "$bad:25: fluid.viscosity = 1 1/\(mPa s\): .*has the wrong dimension"
edit "hexadecimal" 's/^count    = 50/count = 0x32/' "$bad:17: grains beads.count = 0x32: must be one whole number"
edit "poisson of another law" '/^friction/a poisson = 0.6' "$bad:23: material beads.poisson = 0.6: no such key here; it belongs to contact = hertz, hertz_mindlin, hertz_mindlin_liu; cohesion = jkr$"
edit "rolling friction without rolling" '/^friction/a rolling_friction = 0.1' "$bad:23: material beads.rolling_friction = 0.1: no such key here; it belongs to rolling = constant_torque, epsd, matter$"
edit "a section of a law that is not chosen" '/^\[flow\]/i [rolling]\ndamping = 0.3' "$bad:27: \[rolling\]: no such section here; it belongs to rolling = constant_torque, epsd, jiang, matter$"
edit "a key of another kind of wall" '/^\[flow\]/i [wall post]\nkind = plane\npoint = 1 1 1 mm\nhole = 1 mm' "wall post.hole = 1 mm: no such key here; it belongs to wall.kind = disc$"
edit "two regions out of order" '/^count/a from = 0 0 15 mm\nto = 10 10 5 mm' "grains beads.to = 10 10 5 mm: the region must lie inside the box"
edit "a bare carriage return" "s/^count    = 50/count = 50\rfrozen = yes/" "$bad:17: the file is not text"
edit "a line without end" "s/^count    = 50/count = 5$(printf '0%.0s' {1..300})/" "$bad:17: .*the line is longer than 180 letters"
with "override of an unknown key" "command line: fluid.densty = 1000: no such key \(did you mean fluid.density\?\)" fluid.densty=1000
with "override out of range" "command line: material beads.restitution = 2: must lie in" "material beads.restitution=2"
with "override without a key" "command line: fluid = 3: must read section.key=value|fluid=3" fluid=3
with "another binary's scene" "command line: modules.drag = stokes: this binary was built with ergun" modules.drag=stokes

whole "module that does not exist" "command line: modules.drag = erghun: must be one of .*did you mean ergun" "$tmp/good.ini" modules.drag=erghun
whole "poisson out of range" "command line: material beads.poisson = 0.6: must lie in \(-1, 0.5\]" "$tmp/good.ini" modules.contact=hertz_mindlin "material beads.poisson=0.6" "material beads.young=5 MPa"
whole "module by a path" "modules.drag = ../drag/ergun: must be one of" "$tmp/good.ini" modules.drag=../drag/ergun
whole "force that does not exist" "modules.forces = saffman, safman: safman is none of: brownian" "$tmp/good.ini" "modules.forces=saffman, safman"
whole "force by a path" "modules.forces = ../drag/ergun: ../drag/ergun is none of: brownian" "$tmp/good.ini" modules.forces=../drag/ergun
whole "force taken away that does not exist" "modules.forces = -bouyancy: bouyancy is none of: brownian" "$tmp/good.ini" modules.forces=-bouyancy
whole "force without a fluid" "modules.forces = saffman: there is no fluid to exert them" scenes/bounce.ini modules.forces=saffman
whole "key of a force that is not asked for" "forces.saffman = mei: no such key here; it belongs to forces = saffman$" "$tmp/good.ini" forces.saffman=mei
whole "slot that does not exist" "modules.drug = ergun: no such key \(did you mean modules.drag\?\)" "$tmp/good.ini" modules.drug=ergun
whole "no such scene" "nosuch.ini: No such file" nosuch.ini
: > "$tmp/empty.ini"
whole "empty file" "empty.ini: the file holds no \[section\]" "$tmp/empty.ini"
printf '; only a comment\n\n' > "$tmp/comment.ini"
whole "only comments" "comment.ini: the file holds no \[section\]" "$tmp/comment.ini"
head -c 4096 /dev/urandom > "$tmp/garbage.ini"
printf '\000\001' | cat - "$tmp/garbage.ini" > "$tmp/binary.ini"
whole "binary garbage" "binary.ini:1: the file is not text" "$tmp/binary.ini"
whole "a folder" "is a directory" "$tmp"
ln -s "$tmp/nowhere" "$tmp/dangling.ini"
whole "unreadable file" "dangling.ini: No such file" "$tmp/dangling.ini"
whole "no such option" "no such option: --fast" "$tmp/good.ini" --fast
whole "two scenes" "one scene only" "$tmp/good.ini" scenes/bounce.ini
whole "no such command" "chek: No such file, and no such command; there are check" chek
whole "an option without its value" "-j needs a value" "$tmp/good.ini" -j ""
whole "an override without its section" "command line: end=3: must read section.key=value" "$tmp/good.ini" end=3
whole "threads that are none" "-j takes a number of threads" "$tmp/good.ini" -j many

# What is good must stay good: CRLF, indentation, UTF-8 and a mark before it, inline comments.
sed -e 's/^\([a-z]\)/   \1/; s/1 mPa s/1 mPa s  ; water, \xc2\xb5/; s/$/\r/; 1s/^/\xef\xbb\xbf/' "$tmp/good.ini" > "$tmp/crlf.ini"
"$binary" "$tmp/crlf.ini" -o "$tmp/crlf" > /dev/null 2> "$tmp/err"
verdict $? "CRLF, indentation, UTF-8 and inline comments are good"
touch "$tmp/file"
"$binary" "$tmp/good.ini" -o "$tmp/file/out" > /dev/null 2> "$tmp/err"
[ $? = 4 ]
verdict $? "a folder that cannot be made is exit 4"

# From elsewhere, by a path with a space, and stopped by signals: outputs complete, exit 128 + signal.
mkdir -p "$tmp/a place"
cp "$tmp/good.ini" "$tmp/a place/here.ini"
(root=$PWD && cd "$tmp/a place" && "$root/run.sh" here.ini -o there -j 1) > /dev/null 2> "$tmp/err"
[ $? = 0 ] && [ -s "$tmp/a place/there/run.nc" ] && [ -s "$tmp/a place/there/summary.txt" ]
verdict $? "run.sh works from another folder"
for signal in INT TERM; do
    rm -rf "$tmp/long"
    # a shell's &, or whoever started this one in the background, would let run.sh ignore INT
    env --default-signal=INT timeout --foreground 300 ./run.sh "$tmp/good.ini" "run.end=1000 s" "flow.hold=1000 s" \
        -o "$tmp/long" > /dev/null 2> "$tmp/err" &
    run=$!
    for _ in $(seq 100); do
        grep -q "^running" "$tmp/err" && break
        sleep 0.1
    done
    kill -$signal $run
    wait $run
    [ $? = $((128 + $(kill -l $signal))) ] && [ -s "$tmp/long/summary.txt" ] &&
        grep -q "stopped by a signal" "$tmp/err"
    verdict $? "$signal to run.sh stops the program, outputs complete"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
