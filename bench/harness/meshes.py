"""Folders of meshes, their categories, and meshes changed in stated ways."""

import math
import random
from pathlib import Path

ENDINGS = {".off", ".obj", ".ply", ".stl", ".gltf", ".glb"}

# Twenty meshes each, by number; the fourteenth category of the numbering is not part of the benchmark.
PRINCETON = ("human cup glasses airplane ant chair octopus table teddy hand plier fish bird (none) armadillo bust mech "
             "bearing vase fourleg").split()


def find(folder):
    """All meshes below a folder, numbered names in the order of their numbers."""
    paths = [path for path in Path(folder).rglob("*") if path.suffix.lower() in ENDINGS]
    return sorted(paths, key=lambda path: (path.parent, not path.stem.isdecimal(), int(path.stem) if path.stem.isdecimal()
                                           else 0, path.name))


def princeton_category(path):
    return PRINCETON[(int(path.stem) - 1) // 20]


def folder_category(path):
    return path.parent.name


def first_of_each(paths, category):
    first = {}
    for path in paths:
        first.setdefault(category(path), path)
    return list(first.values())


def spread(paths, count, category):
    """At least `count` of them if there are so many: equally many of each category, evenly by size of file, in their order."""
    groups = {}
    for path in paths:
        groups.setdefault(category(path), []).append(path)
    each = -(-count // max(len(groups), 1))
    kept = set()
    for group in groups.values():
        group.sort(key=lambda path: path.stat().st_size)
        some = min(each, len(group))
        kept.update(group[(2 * k + 1) * len(group) // (2 * some)] for k in range(some))
    return [path for path in paths if path in kept]


def chosen(folder, only, category):
    """Those of the folder that `only` names: "first-of-category", or names without ending, separated by commas; all for
    None."""
    paths = find(folder)
    if only == "first-of-category":
        return first_of_each(paths, category)
    names = only.split(",") if only else None
    return [path for path in paths if names is None or path.stem in names]


def read_off(path):
    """Vertices and triangles of an OFF file."""
    words = (word for line in Path(path).read_text().splitlines() for word in line.split("#")[0].split())
    if next(words, "") != "OFF":
        raise ValueError(f"{path}: expected OFF: only such files can be turned or thinned out")
    vertex_count, face_count, _ = (int(next(words)) for _ in range(3))
    vertices = [tuple(float(next(words)) for _ in range(3)) for _ in range(vertex_count)]
    faces = []
    for _ in range(face_count):
        if next(words) != "3":
            raise ValueError(f"{path}: expected triangles")
        faces.append(tuple(int(next(words)) for _ in range(3)))
    return vertices, faces


def write_off(path, vertices, faces):
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += ["%r %r %r" % vertex for vertex in vertices]
    lines += ["3 %d %d %d" % face for face in faces]
    Path(path).write_text("\n".join(lines) + "\n")


def volume(vertices, faces):
    """Of a closed mesh, counter-clockwise from outside."""
    total = 0.0
    for a, b, c in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = vertices[a], vertices[b], vertices[c]
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def rotated(vertices, seed):
    """By a rotation drawn evenly from all (a random unit quaternion)."""
    generator = random.Random(seed)
    w, x, y, z = (generator.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return [tuple(row[0] * p[0] + row[1] * p[1] + row[2] * p[2] for row in rows) for p in vertices]


def thinned_out(faces, share, seed):
    """Without `share` of the faces, drawn evenly; the others in their order."""
    dropped = set(random.Random(seed).sample(range(len(faces)), round(share * len(faces))))
    return [face for number, face in enumerate(faces) if number not in dropped]
