# YADE on the bed of bench/cubes.sh: yade -j1 -n -x cubes_yade.py BED SIDE KIND RELAX STEPS
# BED: x y z, w x y z of the quaternion a line, m; KIND: polyhedra | particles (potential particles).
# Both run with laws of their own and with softer contacts than silt's: their cost is that of the geometry.
import sys, time
from yade import polyhedra_utils
bed, side, kind, relax, steps = sys.argv[1], float(sys.argv[2]), sys.argv[3], int(sys.argv[4]), int(sys.argv[5])
rows = [[float(v) for v in line.split()] for line in open(bed)]
edge, rounding = 2e-3, 2e-4
if kind == 'polyhedra':
    # no rounded edges: cubes a little smaller, or the corners of the bed would overlap from the start
    edge *= 0.875
    stone = O.materials.append(PolyhedraMat(density=2500, young=1e8, poisson=0.3, frictionAngle=atan(0.5)))
else:
    stone = O.materials.append(FrictMat(density=2500, young=5e6, poisson=0.3, frictionAngle=atan(0.5)))
stone = O.materials[stone]


def block(half, place, turn, fixed):
    """A potential particle: a box with rounded edges."""
    h = Vector3(half)
    r = 0.1 * edge
    b = Body()
    b.aspherical = True
    box = 1.02 * (h if fixed else sqrt(3.0) * h)
    planes = [[1, -1, 0, 0, 0, 0], [0, 0, 1, -1, 0, 0], [0, 0, 0, 0, 1, -1]]
    b.shape = PotentialParticle(
        k=0.1 if fixed else 0.2, r=r, R=1.2 * h.norm(), a=planes[0], b=planes[1], c=planes[2],
        d=[h[0] - r, h[0] - r, h[1] - r, h[1] - r, h[2] - r, h[2] - r], isBoundary=fixed, AabbMinMax=True,
        minAabb=box, maxAabb=box, minAabbRotated=1.02 * h, maxAabbRotated=1.02 * h, id=len(O.bodies))
    inertia = edge**5 / 6 * Vector3(1, 1, 1)
    utils._commonBodySetup(b, 8 * h[0] * h[1] * h[2], inertia, material=stone, pos=place, fixed=fixed)
    b.state.pos, b.state.ori = place, turn
    b.mask = 3 if fixed else 1
    return O.bodies.append(b)


for x, y, z, w, qx, qy, qz in rows:
    turn, place = Quaternion(w, qx, qy, qz), Vector3(x, y, z)
    if kind == 'polyhedra':
        corners = [Vector3(i, j, k) * edge / 2 for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
        b = polyhedra_utils.polyhedra(stone, v=corners)
        b.state.pos, b.state.ori = place, turn * b.state.ori
        O.bodies.append(b)
    else:
        block((edge / 2,) * 3, place, turn, False)
if kind == 'polyhedra':
    for axis in (0, 1):
        O.bodies.append(wall(0, axis=axis, sense=1, material=stone))
        O.bodies.append(wall(side, axis=axis, sense=-1, material=stone))
    O.bodies.append(wall(0, axis=2, sense=1, material=stone))
    boxes = [Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()]
    loop = InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom(), Ig2_Wall_Polyhedra_PolyhedraGeom()],
                           [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()], [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()])
else:
    n, thick, tile = 3, 1e-3, side / 6  # walls of blocks: of one block each, the method does not converge
    one = Quaternion(1, 0, 0, 0)
    for i in range(n):
        for j in range(n):
            u, v = (i + 0.5) * side / n, (j + 0.5) * side / n
            block((tile, tile, thick), Vector3(u, v, -thick), one, True)
            for place in (-thick, side + thick):
                block((thick, tile, tile), Vector3(place, u, v), one, True)
                block((tile, thick, tile), Vector3(u, place, v), one, True)
    boxes = [PotentialParticle2AABB()]
    loop = InteractionLoop(
        [Ig2_PP_PP_ScGeom(twoDimension=False, unitWidth2D=1.0, calContactArea=False, areaStep=5)],
        [Ip2_FrictMat_FrictMat_KnKsPhys(kn_i=500.0, ks_i=300.0, Knormal=500.0, Kshear=300.0, useFaceProperties=False, viscousDamping=0.05)],
        [Law2_SCG_KnKsPhys_KnKsLaw(neverErase=False)])
O.engines = [ForceResetter(), InsertionSortCollider(boxes, verletDist=1e-4), loop,
             NewtonIntegrator(damping=0.3, exactAsphericalRot=True, gravity=(0, 0, -9.81))]
O.dt = 1e-5
O.dynDt = False
O.run(relax, True)
start = time.time()
O.run(steps, True)
start = time.time() - start
touching = sum(1 for i in O.interactions if i.isReal and max(i.id1, i.id2) < len(rows))
print('Loop time of %g for %d steps with %d atoms, touching %g' % (start, steps, len(rows), 2 * touching / len(rows)))
