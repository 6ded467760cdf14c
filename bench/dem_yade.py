# YADE on the bed of bench/dem.ini: yade -jTHREADS -n -x dem_yade.py BED LX LY RELAX STEPS
import sys, time
bed, lx, ly, relax, steps = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4]), int(sys.argv[5])
rows = [[float(v) for v in line.split()] for line in open(bed)]
top = max(r[2] + r[3] for r in rows)
glass = O.materials.append(FrictMat(young=5e6, poisson=0.3, density=2500, frictionAngle=atan(0.5)))
O.periodic = True                   # in z too: the surface is kept far from its image
O.cell.hSize = Matrix3(lx, 0, 0, 0, ly, 0, 0, 0, 3 * top)
for x, y, z, d in rows:
    O.bodies.append(sphere((x, y, z + top / 2), d / 2, material=glass))
O.bodies.append(wall(top / 2, axis=2, sense=1, material=glass))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], allowBiggerThanPeriod=True, verletDist=1e-4),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(hertzian=True)],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.7)], [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
]
O.dt = 1e-5
O.dynDt = False
O.run(relax, True)
start = time.time()
O.run(steps, True)
start = time.time() - start
touching = sum(1 for i in O.interactions if i.isReal and max(i.id1, i.id2) < len(rows))
print('Loop time of %g for %d steps with %d atoms, touching %g' % (start, steps, len(rows), 2 * touching / len(rows)))
