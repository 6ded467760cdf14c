# bench/cubes.awk - the bed of cubes of bench/cubes.sh for other programs, from `ncdump -l 200 -v position,orientation,radius`
# of its bed.nc. format: text (x y z, w x y z of the quaternion), body (LAMMPS, body rounded/polyhedron: edge 2 mm,
# rounding radius 0.2 mm), cdl (silt itself, nx x ny beds side by side); side: m, of the bed.
/^ position =/ { on = "p"; next }
/^ orientation =/ { on = "q"; next }
/^ radius =/ { radius = $3 + 0; on = ""; next }
on && NF > 2 {
    line = $0
    gsub(/[,;}]/, " ", line)
    m = split(line, v, " ")
    if (on == "p" && m >= 3) { n++; for (a = 1; a <= 3; a++) x[n, a] = v[a]; if (v[3] > top) top = v[3] }
    if (on == "q" && m >= 4) { k++; for (a = 1; a <= 4; a++) q[k, a] = v[a] }
    if ($0 ~ /;/) on = ""
}
function turned(i, a, b, c, r,    w, X, Y, Z, tx, ty, tz) {
    w = q[i, 1]; X = q[i, 2]; Y = q[i, 3]; Z = q[i, 4]
    tx = 2 * (Y * c - Z * b); ty = 2 * (Z * a - X * c); tz = 2 * (X * b - Y * a)
    r[1] = a + w * tx + Y * tz - Z * ty
    r[2] = b + w * ty + Z * tx - X * tz
    r[3] = c + w * tz + X * ty - Y * tx
}
function body(    i, k, h, mass, r) {
    h = 8e-4; mass = 2500 * 8e-9
    printf "cubes\n\n%d atoms\n%d bodies\n1 atom types\n\n-1e-4 %g xlo xhi\n-1e-4 %g ylo yhi\n-1e-4 %g zlo zhi\n\nAtoms\n\n", n, n, side + 1e-4, side + 1e-4, top + 5e-3
    for (i = 1; i <= n; i++) printf "%d 1 1 %.9g %.9g %.9g %.9g\n", i, mass, x[i, 1], x[i, 2], x[i, 3]
    print "\nBodies\n"
    for (i = 1; i <= n; i++) {
        printf "%d 3 79\n8 12 6\n%.9g %.9g %.9g 0 0 0\n", i, mass * 4e-6 / 6, mass * 4e-6 / 6, mass * 4e-6 / 6
        for (k = 0; k < 8; k++) {
            turned(i, k % 2 ? h : -h, int(k / 2) % 2 ? h : -h, k > 3 ? h : -h, r)
            printf "%.9g %.9g %.9g\n", r[1], r[2], r[3]
        }
        print "0 1 2 3 4 5 6 7 0 2 1 3 4 6 5 7 0 4 1 5 2 6 3 7"
        print "0 1 3 2 4 5 7 6 0 1 5 4 2 3 7 6 0 2 6 4 1 3 7 5\n4e-4"
    }
}
# A variable of all tiles, rows of m numbers; px, py: how far a tile lies off, of the first two.
function rows(name, m, of, px, py,    a, b, i, c, left) {
    left = n * nx * ny
    printf " %s =\n", name
    for (a = 0; a < nx; a++)
        for (b = 0; b < ny; b++)
            for (i = 1; i <= n; i++) {
                for (c = 1; c <= m; c++)
                    printf " %.15g%s", of[i, c] + (c == 1 ? a * px : c == 2 ? b * py : 0), c < m ? "," : ""
                print --left ? "," : " ;"
            }
}
function cdl(    i) {
    for (i = 1; i <= n; i++) r[i, 1] = radius
    printf "netcdf bed {\ndimensions:\n grain = %d ;\n component = 3 ;\n quaternion = 4 ;\nvariables:\n", n * nx * ny
    print " double orientation(grain, quaternion) ;\n double position(grain, component) ;\n double radius(grain) ;\ndata:"
    rows("position", 3, x, side, side)
    rows("orientation", 4, q, 0, 0)
    rows("radius", 1, r, 0, 0)
    print "}"
}
END {
    if (format == "text") for (i = 1; i <= n; i++) print x[i, 1], x[i, 2], x[i, 3], q[i, 1], q[i, 2], q[i, 3], q[i, 4]
    else if (format == "body") body()
    else cdl()
}
