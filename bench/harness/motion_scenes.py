"""Obstacles of space, made for the bench: the buildings of a town extruded, and the frame of a building."""

import json
import math
from pathlib import Path

EARTH = 6371008.8


def tube(first, last, lines, offset):
    """Walls between two rings of as many corners each, and the rings as one polygon each; last is where the outside sees
    its ring run counter-clockwise. The number of vertices is returned."""
    count = len(first)
    lines += ["v " + " ".join(map(str, corner)) for corner in (*first, *last)]
    for i in range(count):
        j = (i + 1) % count
        lines.append(f"f {offset + i + 1} {offset + j + 1} {offset + count + j + 1} {offset + count + i + 1}")
    lines.append("f " + " ".join(str(offset + count - i) for i in range(count)))
    lines.append("f " + " ".join(str(offset + count + i + 1) for i in range(count)))
    return offset + 2 * count


def town(geojson, count, path, seed=1):
    """The `count` footprints nearest to the centre, without courtyards, 6 to 30 m high."""
    rings = [feature["geometry"]["coordinates"][0][:-1] for feature in json.loads(Path(geojson).read_text())["features"]]
    corners = [corner for ring in rings for corner in ring]
    middle = [(min(c[k] for c in corners) + max(c[k] for c in corners)) / 2 for k in (0, 1)]
    scale = EARTH * math.pi / 180
    projected = [[(scale * math.cos(math.radians(middle[1])) * (x - middle[0]), scale * (y - middle[1])) for x, y in ring] for ring in rings]
    projected.sort(key=lambda ring: min(math.hypot(*corner) for corner in ring))
    lines, offset = [], 0
    for i, ring in enumerate(projected[:count]):
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))
        height = 6 + (i * 2654435761 * seed % 97) / 4
        ring = ring if area > 0 else ring[::-1]
        offset = tube([(x, 0, -y) for x, y in ring], [(x, height, -y) for x, y in ring], lines, offset)
    Path(path).write_text("\n".join(lines) + "\n")


def bar(a, b, radius, lines, offset, sides=8):
    """A prism of `sides` sides along the segment from a to b."""
    along = [q - p for p, q in zip(a, b)]
    length = math.hypot(*along)
    along = [each / length for each in along]
    helper = (1, 0, 0) if abs(along[0]) < 0.9 else (0, 1, 0)
    u = cross(along, helper)
    u = [each / math.hypot(*u) for each in u]
    v = cross(along, u)
    turns = [(math.cos(2 * math.pi * k / sides), math.sin(2 * math.pi * k / sides)) for k in range(sides)]
    rings = [[[e + radius * (c * x + s * y) for e, x, y in zip(end, u, v)] for c, s in turns] for end in (a, b)]
    return tube(*rings, lines, offset)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def frame(path):
    """148 bars: 16 columns of three floors, 24 beams a floor, and a roof of 28."""
    bays, step, height, radius = 4, 5.0, 3.5, 0.15
    bars = []
    for floor in range(3):
        low, high = floor * height, (floor + 1) * height
        bars += [((x * step, low, z * step), (x * step, high, z * step)) for x in range(bays) for z in range(bays)]
        bars += [((x * step, high, z * step), ((x + 1) * step, high, z * step)) for x in range(bays - 1) for z in range(bays)]
        bars += [((x * step, high, z * step), (x * step, high, (z + 1) * step)) for x in range(bays) for z in range(bays - 1)]
    top, ridge, middle, wide = 3 * height, 3 * height + 4, (bays - 1) * step / 2, (bays - 1) * step
    for k in range(9):
        z = k * wide / 8
        bars += [((0, top, z), (middle, ridge, z)), ((wide, top, z), (middle, ridge, z)), ((middle, top, z), (middle, ridge, z))]
    bars.append(((middle, ridge, 0), (middle, ridge, wide)))
    lines, offset = [], 0
    for a, b in bars:
        offset = bar(a, b, radius, lines, offset)
    Path(path).write_text("\n".join(lines) + "\n")
    return len(bars)
