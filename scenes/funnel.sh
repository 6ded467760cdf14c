#!/usr/bin/env bash
# scenes/funnel.sh - writes scenes/funnel.stl: a cone frustum that opens upwards, open at both ends, in
# mm about the z axis: from the outlet's radius at z = 0 to the rim's at the top.
#   scenes/funnel.sh [OUTLET RIM HEIGHT FACETS] > scenes/funnel.stl
set -euo pipefail
awk -v r="${1:-7}" -v R="${2:-30}" -v h="${3:-30}" -v n="${4:-48}" '
function at(radius, k, z) {
    return sprintf("%.9g %.9g %g", radius * cos(2 * pi * k / n), radius * sin(2 * pi * k / n), z)
}
function facet(a, b, c) {
    print " facet normal 0 0 0\n  outer loop"
    print "   vertex " a "\n   vertex " b "\n   vertex " c
    print "  endloop\n endfacet"
}
BEGIN {
    pi = atan2(0, -1)
    print "solid funnel"
    for (k = 0; k < n; k++) {
        facet(at(r, k, 0), at(R, k, h), at(R, k + 1, h))
        facet(at(r, k, 0), at(R, k + 1, h), at(r, k + 1, 0))
    }
    print "endsolid funnel"
}'
