#!/usr/bin/python3
"""The way of a van through a town that keeps away from its buildings: plan_path.py TOWN.geojson WAY.txt"""

import sys

import numpy as np
import partwise as pw

town = pw.read_city(sys.argv[1], limit=12)
streets = pw.roadmap(town, samples=200, seed=1)
wide = streets.samples[streets.distances[:, 0] > 3]  # room for the van in any direction
west, east = (np.append(wide[pick(wide[:, 0])], 0) for pick in (np.argmin, np.argmax))
van = [[-2.5, -1], [2.5, -1], [2.5, 1], [-2.5, 1]]
problem = pw.Problem("se2", pw.prisms(town.footprints), pw.prisms([[van]]), queries=[(west, east)])
way = pw.plan(problem, seed=1)
print(f"{np.linalg.norm(np.diff(way.configurations[:, :2], axis=0), axis=1).sum():.0f} m and {len(way) - 2} bends, "
      f"nowhere nearer than {way.clearance_min:.1f} m to a building")
np.savetxt(sys.argv[2], way.configurations, header="east, north (metres), angle (radians)")
