"""How far apart features of surfaces are under noise, in another pose, and on another shape: earth mover's distances of
histograms of levels.

The level of a vertex is the base-2 logarithm of its value over the mesh's area (of the shape diameter: over the area's
square root), as partwise's own histograms of parts have it: 1 is twice as much. The histogram gives each vertex a third of the
area of its faces, over 10 octaves; what is less counts as the least. A distance is therefore in octaves."""

import bisect
import itertools
import math
import tempfile
from pathlib import Path

from . import meshes, process
from .table import cell, mean, table

KINDS = ("sdf", "cvf", "cvf-avg", "cvf-strong", "cvf-weak")
AMPLITUDES = (0.005, 0.01, 0.02)  # of R
POSES = ("octopus", "hand", "armadillo", "human", "ant")  # the first two are the dissertation's, the third one body
OCTAVES, BINS = 10, 100


def vertex_areas(vertices, faces):
    areas = [0.0] * len(vertices)
    for a, b, c in faces:
        u, v = ([vertices[k][i] - vertices[a][i] for i in range(3)] for k in (b, c))
        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for corner in (a, b, c):
            areas[corner] += math.hypot(*cross) / 6
    return areas


def histogram(values, areas, kind):
    """Shares of the area by level, the least first."""
    whole = sum(areas)
    unit = math.sqrt(whole) if kind == "sdf" else whole
    bins = [0.0] * BINS
    for value, area in zip(values, areas):
        level = math.log2(value / unit) if value > 0 else -OCTAVES
        place = math.floor((level / OCTAVES + 1) * BINS)
        bins[min(max(place, 0), BINS - 1)] += area / whole
    return bins


def earth_movers_distance(a, b):
    """Octaves; of two histograms of the same sum."""
    return sum(abs(difference) for difference in itertools.accumulate(x - y for x, y in zip(a, b))) * OCTAVES / BINS


def share_nearer(near, far):
    """How often one of `near` is less than one of `far`, ties for a half: the area under the ROC curve."""
    far = sorted(far)
    if not near or not far:
        return None
    return sum(len(far) - (bisect.bisect_left(far, x) + bisect.bisect_right(far, x)) / 2 for x in near) / (
        len(near) * len(far))


def histograms_of(settings, mesh, noise, smooth=0, kinds=KINDS, seed=1):
    """By kind, of the mesh with noise, values and areas taken after so many rounds of smoothing. Errors: ValueError with a
    program's complaint."""
    with tempfile.TemporaryDirectory() as folder:
        copy, values = Path(folder) / f"{mesh.stem}.off", Path(folder) / "values.txt"
        process.expect([settings.tools / "mesh_variant", mesh, copy, "--noise", noise, "--seed", seed],
                       settings.time_limit)
        even = Path(folder) / "even.off"
        process.expect([settings.tools / "mesh_variant", copy, even, "--smooth", smooth], settings.time_limit)
        areas = vertex_areas(*meshes.read_off(even))
        found = {}
        for kind in kinds:
            process.expect([settings.program, "feature", copy, "--kind", kind, "--smooth", smooth, "--values", values, "--threads",
                            settings.threads, "--quiet"], settings.time_limit)
            found[kind] = histogram([float(line) for line in values.read_text().split()], areas, kind)
        return found


def noise_and_pose(settings, paths, category, amplitudes, smooth, kinds, jobs):
    """Noise: a mesh and its noisy copy. Pose: two meshes of a category of POSES. Other: two of different categories."""
    def one(path):
        try:
            return {noise: histograms_of(settings, path, noise, smooth, kinds) for noise in (0, *amplitudes)}
        except ValueError as error:
            return str(error)

    found, troubles = {}, []
    for path, result in zip(paths, jobs(one, paths)):
        if isinstance(result, str):
            troubles.append(f"{path.stem}: {result}")
        else:
            found[path] = result
    groups = pairs_of(found, category, amplitudes)
    rows, figures = [], {}
    for kind in kinds:
        distances = {name: [earth_movers_distance(a[kind], b[kind]) for a, b in pairs] for name, pairs in groups.items()}
        other = distances.pop("other")
        figures[kind] = {name: {"distance": mean(each), "nearer": share_nearer(each, other)}
                         for name, each in distances.items()} | {"other": {"distance": mean(other)}}
        rows.append([kind, *(text for name in distances for text in (
            f"| {cell(figures[kind][name]['distance'], '.3f')}", cell(figures[kind][name]["nearer"], ".3f"))),
            f"| {cell(mean(other), '.3f')}"])
    names = [name for name in groups if name != "other"]
    print(table(["kind", *(text for name in names for text in (f"| {name}", "nearer")), "| other"], rows))
    print("pairs: " + ", ".join(f"{name} {len(pairs)}" for name, pairs in groups.items()))
    print("earth mover's distances in octaves, means; nearer: how often such a pair is nearer than one of two categories")
    for trouble in troubles:
        print(trouble)
    return {"finished": len(found), "smooth": smooth, "pairs": {name: len(pairs) for name, pairs in groups.items()}, "kinds": figures}


def pairs_of(found, category, amplitudes):
    """Pairs of histograms by kind, by what is between them."""
    groups = {f"noise {100 * noise:g} %": [(each[0], each[noise]) for each in found.values()] for noise in amplitudes}
    pairs = [(category(a), category(b), found[a][0], found[b][0]) for a, b in itertools.combinations(found, 2)]
    for name in POSES:
        if same := [(x, y) for a, b, x, y in pairs if a == b == name]:
            groups[f"pose: {name}"] = same
    groups["other"] = [(x, y) for a, b, x, y in pairs if a != b]
    return groups
