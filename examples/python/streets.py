#!/usr/bin/python3
"""The middles of a town's streets, and how wide they are: streets.py TOWN.geojson STREETS.txt"""

import sys

import numpy as np
import partwise as pw

town = pw.read_city(sys.argv[1], limit=40)
roadmap = pw.roadmap(town, samples=400, seed=1)
widths = 2 * roadmap.distances[:, 0]
print(f"{len(roadmap)} places between {roadmap.obstacles} buildings, {len(roadmap.edges)} ways between them")
print(f"half of the places have {np.median(widths):.0f} m of room or more, the narrowest {widths.min():.1f} m")
np.savetxt(sys.argv[2], np.column_stack([roadmap.samples, widths]), header="east, north, width (metres)")
