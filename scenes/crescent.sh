#!/usr/bin/env bash
# scenes/crescent.sh - writes scenes/crescent.stl: a closed, concave grain, in mm: a round rod bent along
# an arc about the z axis, thickest in the middle, its ends rounded off, with lumps as of a broken ring.
#   scenes/crescent.sh [RING ROD ARC ALONG AROUND] > scenes/crescent.stl   (mm, mm, degrees, facets)
set -euo pipefail
awk -v R="${1:-3}" -v r="${2:-1.3}" -v arc="${3:-200}" -v n="${4:-20}" -v m="${5:-10}" '
# Along the rod from end to end: u from -1 to 1. The radius falls to nothing as the root of 1 - u^8 does.
function at(i, k,    u, a, b, c) {
    u = -cos(pi * i / n)
    a = 0.5 * arc * pi / 180 * u
    b = 2 * pi * k / m
    c = r * (1 - 0.35 * u * u) * sqrt(1 - u ^ 8) * (1 + 0.08 * sin(7 * u + 2 * b))
    return sprintf("%.4f %.4f %.4f", (R + c * cos(b)) * cos(a), (R + c * cos(b)) * sin(a), c * sin(b))
}
function facet(a, b, c) {
    print "facet normal 0 0 0\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet"
}
BEGIN {
    pi = atan2(0, -1)
    print "solid crescent"
    first = sprintf("%.4f %.4f 0", R * cos(0.5 * arc * pi / 180), -R * sin(0.5 * arc * pi / 180))
    last = sprintf("%.4f %.4f 0", R * cos(0.5 * arc * pi / 180), R * sin(0.5 * arc * pi / 180))
    for (k = 0; k < m; k++) {
        facet(first, at(1, k), at(1, (k + 1) % m))
        for (i = 1; i < n - 1; i++) {
            facet(at(i, k), at(i + 1, k), at(i + 1, (k + 1) % m))
            facet(at(i, k), at(i + 1, (k + 1) % m), at(i, (k + 1) % m))
        }
        facet(last, at(n - 1, (k + 1) % m), at(n - 1, k))
    }
    print "endsolid crescent"
}'
