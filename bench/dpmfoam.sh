#!/usr/bin/env bash
# bench/dpmfoam.sh [quick] - a fluidised bed beside OpenFOAM's DPMFoam (Debian's package openfoam): the
# Goldschmidt bed of scenes/fluidised_bed.ini, 24,750 spheres on 2 x 30 x 90 cells, from the same start
# with the same laws. DPMFoam runs for a minute (quick: 20 s, one core); silt runs the span that it reached.
# Wall time per simulated second, without start and output. DPMFoam takes the fluid's step of its
# tutorial, 20 us, and chooses its own steps for contacts; silt's steps are those of the scene.
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
if ! command -v DPMFoam > /dev/null && [ "$quick" != quick ]; then
    ./run.sh install openfoam || true
fi
if ! command -v DPMFoam > /dev/null; then
    echo "(DPMFoam is not installed and left out; apt-get install openfoam)"
    exit 0
fi
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
seconds=60
[ "$quick" = quick ] && seconds=20
config=$(dpkg -L openfoam | grep -m 1 '/etc/bashrc$')
export WM_PROJECT_DIR=${config%/etc/bashrc}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none

foam() { # FILE CLASS, the rest from stdin
    mkdir -p "$(dirname "$1")"
    { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$2" "$(basename "$1")"
      cat; } > "$1"
}

write_case() { # DIR CORES
    local c=$1
    foam "$c/system/blockMeshDict" dictionary << 'TEXT'
scale 0.001;
vertices ((0 0 0) (15 0 0) (15 150 0) (0 150 0) (0 0 450) (15 0 450) (15 150 450) (0 150 450));
blocks (hex (0 1 2 3 4 5 6 7) (2 30 90) simpleGrading (1 1 1));
boundary
(
    bottom { type wall; faces ((0 3 2 1)); }
    top    { type wall; faces ((4 5 6 7)); }
    walls  { type wall; faces ((0 1 5 4) (2 3 7 6)); }
    front  { type symmetry; faces ((1 2 6 5) (3 0 4 7)); }
);
TEXT
    foam "$c/system/controlDict" dictionary << 'TEXT'
application DPMFoam; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 2e-5;
writeControl timeStep; writeInterval 1000000; writeFormat ascii; timeFormat general; timePrecision 9;
TEXT
    foam "$c/system/fvSchemes" dictionary << 'TEXT'
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
    div(alphaPhi.air,U.air) Gauss linearUpwindV unlimited;
    div(((alpha.air*nuEff.air)*dev2(T(grad(U.air))))) Gauss linear;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
TEXT
    foam "$c/system/fvSolution" dictionary << 'TEXT'
solvers
{
    p          { solver GAMG; smoother GaussSeidel; tolerance 1e-6; relTol 0.01; }
    pFinal     { $p; relTol 0; }
    U.air      { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-5; relTol 0.1; }
    U.airFinal { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-5; relTol 0; }
}
PIMPLE { nOuterCorrectors 1; nCorrectors 2; momentumPredictor yes; pRefCell 0; pRefValue 0; }
TEXT
    foam "$c/system/decomposeParDict" dictionary << TEXT
numberOfSubdomains $2; method simple; simpleCoeffs { n (1 $2 1); delta 0.001; }
TEXT
    foam "$c/constant/g" uniformDimensionedVectorField <<< 'dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);'
    foam "$c/constant/turbulenceProperties.air" dictionary <<< 'simulationType laminar;'
    foam "$c/constant/transportProperties" dictionary <<< \
        'continuousPhase air; rho.air 1.2; transportModel Newtonian; nu 1e-5;'
    foam "$c/constant/kinematicCloudProperties" dictionary << 'TEXT'
solution
{
    active true; coupled true; transient yes; cellValueSourceCorrection off;
    interpolationSchemes { rho.air cell; U.air cellPoint; mu.air cell; }
    integrationSchemes { U Euler; }
    sourceTerms { schemes { U semiImplicit 1; } }
}
constantProperties { rho0 2526; youngsModulus 1e8; poissonsRatio 0.35; alphaMax 0.99; }
subModels
{
    particleForces { ErgunWenYuDrag { alphac alpha.air; } gravity; }
    injectionModels
    {
        start
        {
            type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0; U0 (0 0 0);
            positionsFile "start";
            sizeDistribution { type fixedValue; fixedValueDistribution { value 0.0025; } }
        }
    }
    dispersionModel none; heatTransferModel none; surfaceFilmModel none; radiation off;
    stochasticCollisionModel none;
    patchInteractionModel standardWallInteraction;
    standardWallInteractionCoeffs { U U.air; type rebound; e 0.97; mu 0.09; }
    collisionModel pairCollision;
    pairCollisionCoeffs
    {
        U U.air; maxInteractionDistance 0.0025; writeReferredParticleCloud no;
        pairModel pairSpringSliderDashpot;
        pairSpringSliderDashpotCoeffs
        {
            useEquivalentSize no; collisionResolutionSteps 12; cohesionEnergyDensity 0;
            alpha 0.02; b 1.5; mu 0.1;
        }
        wallModel wallSpringSliderDashpot;
        wallSpringSliderDashpotCoeffs
        {
            useEquivalentSize no; collisionResolutionSteps 12; cohesionEnergyDensity 0;
            youngsModulus 1e8; poissonsRatio 0.23; alpha 0.01; b 1.5; mu 0.09;
        }
    }
}
cloudFunctions {}
TEXT
    { echo '('
      awk 'BEGIN { for (k = 0; k < 99; k++) for (j = 0; j < 50; j++) for (i = 0; i < 5; i++)
          printf "(%.4f %.4f %.4f)\n", 0.003 * (i + 0.5), 0.003 * (j + 0.5), 0.003 * (k + 0.5) }'
      echo ')'; } | foam "$c/constant/start" vectorField
    foam "$c/0/U.air" volVectorField << 'TEXT'
dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{
    walls  { type noSlip; }
    front  { type symmetry; }
    bottom { type interstitialInletVelocity; inletVelocity uniform (0 0 1.875); phi phi.air;
             alpha alpha.air; value uniform (0 0 1.875); }
    top    { type pressureInletOutletVelocity; phi phi.air; value uniform (0 0 0); }
}
TEXT
    foam "$c/0/p" volScalarField << 'TEXT'
dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField
{
    "walls|bottom" { type fixedFluxPressure; phi phi.air; value uniform 0; }
    front          { type symmetry; }
    top            { type fixedValue; value uniform 0; }
}
TEXT
}

# Simulated time reached, and processor time per simulated second of the steps from the third on (of the
# first rank: what else runs on the machine counts less).
dpmfoam() { # CORES
    local c=$tmp/case$1 run=(DPMFoam)
    write_case "$c" "$1"
    (
        cd "$c"
        blockMesh > log.mesh
        if [ "$1" -gt 1 ]; then
            decomposePar > log.decompose
            run=(mpirun --mca mpi_yield_when_idle 1 --bind-to none -np "$1" DPMFoam -parallel)
        fi
        timeout "$seconds" "${run[@]}" > log.run 2>&1 || true
    )
    awk '/^Time = / { t = $3 }
         /^ExecutionTime/ { n++; if (n == 2) { t0 = t; e0 = $3 } t1 = t; e1 = $3 }
         END { if (n < 4) exit 1; printf "%.9g %.9g\n", t1, (e1 - e0) / (t1 - t0) }' "$c/log.run" ||
        { echo "DPMFoam did not run:"; tail -n 5 "$c/log.run"; } >&2
}

make -s -j"$(nproc)" build/release/front
slots=$(build/release/front slots scenes/fluidised_bed.ini)
make -s -j"$(nproc)" $slots silt
binary=$(make -s $slots where)

# The same of silt: all its verbs without start and output, times the share of a processor that a thread had.
silt() { # CORES SPAN
    local TIMEFORMAT='%R %U %S'
    { time "$binary" scenes/fluidised_bed.ini -j "$1" "run.end=$2 s" fluid.tolerance=1e-6 \
        "output.every=$2 s" "reference.from=0 s" -o "$tmp/silt" > "$tmp/log" 2>&1 || true; } 2> "$tmp/share"
    awk -v n="$1" 'NR == FNR { share = ($2 + $3) / n / $1; next }
        /^simulated_time/ { t = $3 } /^time_/ && !/^time_output/ { sum += $3 }
        END { printf "%.9g\n", sum / t * (share < 1 ? share : 1) }' \
        "$tmp/share" "$tmp/silt/summary.txt"
}

echo "Goldschmidt's bed, 24,750 spheres on 5,400 cells, from its loose lattice: seconds per simulated second"
printf '%-7s %16s %12s %12s %12s\n' cores "simulated, s" DPMFoam silt ratio
cores="1 2"
[ "$(nproc)" -gt 1 ] && [ "$quick" != quick ] || cores=1
for cores in $cores; do
    read -r span theirs < <(dpmfoam "$cores") || exit 1
    for round in 1 2 3; do
        silt "$cores" "$span"
    done | sort -g | sed -n 2p > "$tmp/ours"
    awk -v c="$cores" -v s="$span" -v a="$theirs" -v b="$(cat "$tmp/ours")" \
        'BEGIN { printf "%-7d %16.5f %12.0f %12.0f %11.1fx\n", c, s, a, b, a / b }'
done
