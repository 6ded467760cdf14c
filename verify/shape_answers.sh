#!/usr/bin/env bash
# verify/shape_answers.sh [SHAPE ...] - every shape with every answer of the other slots: contact, rolling, cohesion,
# bond, lubrication, drag, porosity, forces, fluid; sizes by distribution, a periodic side, walls of every kind (a
# mesh from an STL file among them), pictures and ParaView. For each shape as many scenes as the longest
# slot has answers; of each scene the answers are the next of every slot, so that each is built and run
# with each shape at least once. Fails where a scene is refused, does not end, has no run.xmf, or its ledger does not
# close; of the first scene of a shape the pictures are made. Long: about 30 builds a shape; ONLY=N does the first N
# scenes alone, KEEP=FOLDER keeps those that fail, VERBOSE=1 tells of those that do not.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 2
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
export OMP_NUM_THREADS=1
passed=0
failed=0
shapes=("$@")
[ $# -gt 0 ] || shapes=(sphere disc clump superquadric dilated_polyhedron multi_dilated_polyhedron level_set)
make -s build/release/front

answers() { # FOLDER; `none` left out
    for f in "$1"/*.c; do basename "$f" .c; done | grep -v '^none$'
}
mapfile -t contacts < <(answers contact)
mapfile -t rollings < <(answers contact/rolling)
mapfile -t cohesions < <(answers contact/cohesion)
mapfile -t bonds < <(answers contact/bond)
mapfile -t drags < <(answers drag)
mapfile -t porosities < <(answers porosity)
mapfile -t forces < <(answers forces)
fluids=(navier_stokes prescribed)
next() { # NAME OF ARRAY, K
    local -n list=$1
    echo "${list[$(($2 % ${#list[@]}))]}"
}

form_of() { # SHAPE K
    local convex=(cube tetrahedron octahedron icosahedron dodecahedron prism pyramid wedge)
    local all=("${convex[@]}" cone_pair tetrapod dolos cross hollow_box O T Z K A C)
    case $1 in
        clump) echo "spheres = 0.3 0.2 0.1 0.7, -0.3 0 0 0.6" ;;
        superquadric) echo "half_axes = 1 1 $(($2 % 3 + 1))"; echo "blockiness = $(($2 % 5 + 2))" ;;
        dilated_polyhedron) echo "form = $(next convex "$2")" ;;
        multi_dilated_polyhedron) echo "form = $(next all "$2")"; echo "mass_spacing = 0.1 mm" ;;
        level_set) echo "form = $PWD/scenes/crescent.stl"; echo "form_cells = 32"; echo "node_spacing = 0.12" ;;
    esac
}

keys_of() { # ANSWERS of contacts, as keys of the material
    local elastic=0
    for a in "$@"; do
        case $a in
            linear) echo "stiffness = 2000 N/m"; echo "friction = 0.4"; echo "restitution = 0.5" ;;
            hertz) elastic=1; echo "restitution = 0.5" ;;
            hertz_mindlin*) elastic=1; echo "friction = 0.4"; echo "restitution = 0.5" ;;
            epsd | constant_torque) echo "rolling_friction = 0.1" ;;
            viscous) echo "rolling_viscosity = 0.1 s/m" ;;
            jiang) echo "shape_parameter = 0.2"; echo "friction = 0.4" ;;
            matter) printf '%s\n' "rolling_friction = 0.1" "torsion_friction = 0.1" "rolling_stiffness = 1e-4 N m" \
                "torsion_stiffness = 1e-4 N m" ;;
            jkr) elastic=1; echo "work_of_adhesion = 0.05 J/m2" ;;
            capillary) echo "surface_tension = 0.07 N/m"; echo "bridge_volume = 0.2 mm3" ;;
            van_der_waals) echo "hamaker = 1e-19 J" ;;
            contact_bond) printf '%s\n' "bond_stiffness = 1000 N/m" "bond_stiffness_shear = 500 N/m" "bond_strength = 0.1 N" \
                "bond_strength_shear = 0.1 N" ;;
            parallel_bond) printf '%s\n' "bond_stiffness = 1e9 Pa/m" "bond_stiffness_shear = 5e8 Pa/m" \
                "bond_strength = 1e5 Pa" "bond_strength_shear = 1e5 Pa" ;;
        esac
    done | sort -u
    case " $* " in *hertz* | *jkr*) printf '%s\n' "young = 5 MPa" "poisson = 0.3" ;; esac
}

scene() { # SHAPE K
    local shape=$1 k=$2 contact rolling cohesion bond drag porosity force fluid
    contact=$(next contacts "$k")
    rolling=$(next rollings "$k")
    cohesion=$(next cohesions "$k")
    bond=$(next bonds $((k / 2)))
    drag=$(next drags "$k")
    porosity=$(next porosities "$k")
    fluid=$(next fluids $((k / 5)))
    force=$(next forces $((k / 3)))
    printf '[modules]\nshape = %s\ncontact = %s\nrolling = %s\ncohesion = %s\nbond = %s\nlubrication = squeeze\n' \
        "$shape" "$contact" "$rolling" "$cohesion" "$bond"
    printf 'drag = %s\nporosity = %s\nfluid = %s\nforces = standard %s\n' "$drag" "$porosity" "$fluid" "$force"
    if [ "$shape" = disc ]; then
        printf '[domain]\nsize = 32 3.6 40 mm\ncells = 5 1 7\nx = periodic\n'
    else
        printf '[domain]\nsize = 32 24 40 mm\ncells = 5 4 7\ny = periodic\n'
    fi
    printf '[grains g]\nsizes = uniform\ndiameter_min = 2.9 mm\ndiameter_max = 3.6 mm\ndensity = 2500 kg/m3\n'
    printf 'count = 24\nfill = random\nvelocity = 0.3 0 -0.9 m/s\nmaterial = m\nfrom = 4 0 19 mm\n'
    [ "$shape" = disc ] && printf 'to = 28 3.6 39 mm\n' || printf 'to = 28 24 39 mm\n'
    form_of "$shape" "$k"
    [ "$shape" = sphere ] || [ "$shape" = disc ] || echo "orientation = random"
    printf '[material m]\n'
    keys_of "$contact" "$rolling" "$cohesion" "$bond"
    printf '[lubrication]\ngap_min = 10 um\nrange = 0.1 mm\n'
    [ "$cohesion" = van_der_waals ] && printf '[cohesion]\nseparation_min = 1 um\nrange = 50 um\n'
    [ "$drag" = kozeny_carman_relative ] && printf '[drag]\npermeability = 1e-8 m2\n'
    [ "$force" = brownian ] && printf '[forces]\ntemperature = 300 K\n'
    printf '[fluid]\ndensity = 100 kg/m3\nviscosity = 20 mPa s\n'
    printf 'dt = 0.2 ms\n'
    [ "$fluid" = prescribed ] && printf 'velocity = 0 0 0.01 m/s\n'
    printf '[wall slope]\npoint = 0 0 8 mm\nnormal = %s 0 1\n' "$([ "$shape" = disc ] && echo 0 || echo 0.3)"
    if [ "$shape" != disc ]; then
        printf '[wall post]\nkind = cylinder\npoint = 24 12 0 mm\naxis = 0 0 1\nradius = 3 mm\nlength = 16 mm\n'
        printf '[wall tip]\nkind = cone\npoint = 16 12 6 mm\naxis = 0 0 1\nradius = 5 mm\nradius_end = 1 mm\nlength = 9 mm\n'
        printf '[wall lid]\nkind = disc\npoint = 8 6 16 mm\nnormal = 0 0 1\nradius = 4 mm\n'
        printf '[wall plate]\nkind = rectangle\ncorner = 4 14 14 mm\nedge1 = 7 0 1 mm\nedge2 = 0 7 0 mm\n'
        printf '[wall block]\nkind = box\nfrom = 20 2 5 mm\nto = 29 6 15 mm\n'
        printf '[wall net]\nkind = mesh\nfile = %s/scenes/funnel.stl\nscale = 0.12 mm\nshift = 24 19 14 mm\n' "$PWD"
    fi
    printf '[output]\nevery = 5 ms\ncontacts = on\n[run]\nend = 15 ms\noverlap_max = 0.5\nforce = on\n'
}

for shape in "${shapes[@]}"; do
    for ((k = 0; k < ${ONLY:-${#drags[@]}}; k++)); do
        scene "$shape" "$k" > "$tmp/s.ini"
        what="$shape: $(sed -n '3,10s/.* = //p' "$tmp/s.ini" | tr '\n' ' ')"
        rm -rf "$tmp/out"
        # shellcheck disable=SC2046
        slots=$(build/release/front slots "$tmp/s.ini" 2> "$tmp/log" | tr '\n' ' ') &&
            make -s $slots silt > "$tmp/log" 2>&1 &&
            timeout 300 "$(make -s $slots where)" "$tmp/s.ini" -o "$tmp/out" > "$tmp/log" 2>&1
        code=$?
        [ "$code" = 0 ] && [ "$k" = 0 ] && ./run.sh plot "$tmp/out" > "$tmp/log" 2>&1
        if [ "$code" = 0 ] && grep -q '^ledger = closes' "$tmp/out/summary.txt" && [ -s "$tmp/out/run.xmf" ] &&
            { [ "$k" != 0 ] || [ -s "$tmp/out/bed.png" ]; }; then
            passed=$((passed + 1))
            [ -n "${VERBOSE:-}" ] && echo "ok   $what"
        else
            failed=$((failed + 1))
            echo "FAIL $what (ends with $code)"
            grep -v '^running' "$tmp/log" | tail -n 4 | sed 's/^/     /'
            grep '^ledger' "$tmp/out/summary.txt" 2> /dev/null | sed 's/^/     /'
            [ -n "${KEEP:-}" ] && cp "$tmp/s.ini" "$KEEP/$shape-$k.ini"
        fi
    done
    echo "     $shape: $passed of $((passed + failed)) so far"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
