#!/usr/bin/python3
"""Cuts a mesh into nearly convex parts, writes their hulls and shows the parts: decompose.py MESH HULLS.obj PICTURE.png"""

import sys

import partwise as pw

mesh = pw.read_mesh(sys.argv[1])
parts = pw.decompose(mesh, tolerance=0.1)
print(f"{len(parts)} parts, no hull reaches out by more than {parts.concavity:.3f} of the radius")
pw.write_meshes(sys.argv[2], parts.hulls)
paints = ["red-plastic", "blue-metallic-paint", "yellow-paint", "green-plastic", "pearl-paint", "white-paint"]
seen = pw.render(parts.mesh, paints, parts.mesh_labels, light="studio", size=(640, 480))
pw.write_image(sys.argv[3], pw.tone_mapped(seen.image, seen.mask), shown=True)
