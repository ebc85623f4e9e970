#!/usr/bin/python3
"""Names parts of the Princeton benchmark's meshes (leg, arm, wing, ...) by a fixed rule from people's segmentations, for
retrieval_bench.py: label_parts.py OFF_DIR SEG_DIR OUT_DIR [--only 1,2,...].

OUT_DIR/N.kinds gets a line a face: the kind of part it belongs to, or -. The rule, which knows nothing of retrieval:

1. Tips. The centre is the vertex with the least mean distance along the surface to 24 others that are spread evenly; tips are
   the maxima of the distance from the centre. A tip is as long as the distance falls before its hill meets a higher one.
   The longest tips count, as many as the category has limbs.
2. Names, by category (KINDS), from where tips are and how far apart along the surface.
3. Limbs. In each person's segmentation the segments on the shortest chains of neighbours between all *other* tips are the
   body; what hangs together with the tip without it is the tip's limb. Cups, tables and teddies have no tips: a handle is every segment
   whose centroid lies aside, by over 0.6 of the mean horizontal radius of the largest segment; a leg of a table is what hangs
   together without the largest segment and has under a quarter of the faces; teddies' limbs are told apart by height.
4. A face has the kind that more than half of the people give it.
"""

import argparse
import heapq
import sys
from collections import Counter, defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import meshes  # noqa: E402


def neighbour_lists(vertices, faces):
    lists = [{} for _ in vertices]
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            if b not in lists[a]:
                length = sum((p - q) ** 2 for p, q in zip(vertices[a], vertices[b])) ** 0.5
                lists[a][b] = lists[b][a] = length
    return [list(entry.items()) for entry in lists]


def distances(lists, source):
    found = [float("inf")] * len(lists)
    found[source] = 0.0
    heap = [(0.0, source)]
    while heap:
        d, v = heapq.heappop(heap)
        if d > found[v]:
            continue
        for w, length in lists[v]:
            if d + length < found[w]:
                found[w] = d + length
                heapq.heappush(heap, (found[w], w))
    return found


def finite_max(values):
    return max(range(len(values)), key=lambda v: values[v] if values[v] < float("inf") else -1)


def from_centre(lists):
    """Distances from the centre of the largest connected piece; infinite elsewhere."""
    start = next(v for v, entry in enumerate(lists) if entry)
    total, nearest, source = [0.0] * len(lists), [float("inf")] * len(lists), start
    for _ in range(24):
        found = distances(lists, source)
        total = [t + d for t, d in zip(total, found)]
        nearest = [min(n, d) for n, d in zip(nearest, found)]
        source = finite_max(nearest)
    return distances(lists, min(range(len(lists)), key=lambda v: total[v]))


def tips(lists, height):
    """(length, vertex), longest first."""
    order = sorted((v for v in range(len(lists)) if height[v] < float("inf")), key=lambda v: -height[v])
    top, lengths = {}, []

    def find(v):
        while top[v][0] != v:
            top[v][0] = top[top[v][0]][0]
            v = top[v][0]
        return v

    for v in order:
        top[v] = [v, v]  # parent, its highest vertex
        for w, _ in lists[v]:
            if w not in top:
                continue
            a, b = find(v), find(w)
            if a == b:
                continue
            if height[top[a][1]] < height[top[b][1]]:
                a, b = b, a
            if top[b][1] != v:
                lengths.append((height[top[b][1]] - height[v], top[b][1]))
            top[b][0] = a
    lengths.append((height[order[0]], order[0]))
    return sorted(lengths, reverse=True)


class Tips:
    """The longest tips of a mesh, longest first: their vertices, how high each is (along the axis that is up), how far from the
    centre, and how far from each other along the surface."""

    def __init__(self, mesh, count, lying):
        up = 2 if lying else 1
        self.stands = not lying
        height = from_centre(mesh.lists)
        self.vertices = [v for _, v in tips(mesh.lists, height)[:count]]
        self.up = {v: mesh.vertices[v][up] for v in self.vertices}
        self.reach = {v: height[v] for v in self.vertices}
        self.low, self.high = min(p[up] for p in mesh.vertices), max(p[up] for p in mesh.vertices)
        away = {v: distances(mesh.lists, v) for v in self.vertices}
        self.apart = {v: {w: away[v][w] for w in self.vertices} for v in self.vertices}

    def lowest(self, count):
        return sorted(self.vertices, key=self.up.get)[:count]

    def loneliness(self, v):
        return sum(self.apart[v].values())


def named(chosen, kind, others, rest="other"):
    return {v: rest for v in others} | {v: kind for v in chosen}


def of_person(found):
    """Legs are farthest from all other tips along the surface, the head is nearest."""
    head, arm, other_arm, *legs = sorted(found.vertices, key=found.loneliness)
    return {head: "head", arm: "arm", other_arm: "arm"} | named(legs, "leg", ())


def of_insect(found):
    """Legs are the six tips nearest to the centre."""
    return named(sorted(found.vertices, key=found.reach.get)[:6], "leg", found.vertices)


def standing(found):
    """Legs reach to the lowest sixth of the height."""
    return {v: "leg" if found.up[v] < found.low + (found.high - found.low) / 6 else "other" for v in found.vertices}


def mirror_pairs(found, count):
    """Pairs of tips that mirror each other: those farthest apart first of the pairs that are about equally far from all others,
    by 12 % of their own distance in the mean; then the pairs that are most so."""
    def lopsided(pair):
        a, b = pair
        others = [v for v in found.vertices if v not in pair]
        return sum(abs(found.apart[a][v] - found.apart[b][v]) for v in others) / len(others) / found.apart[a][b]
    pairs = [(a, b) for i, a in enumerate(found.vertices) for b in found.vertices[:i]]
    even = sorted((pair for pair in pairs if lopsided(pair) < 0.12), key=lambda pair: -found.apart[pair[0]][pair[1]])
    chosen = []
    for pair in even + sorted(pairs, key=lopsided):
        if len(chosen) < count and not {*pair} & {v for other in chosen for v in other}:
            chosen.append(pair)
    return chosen


def winged(found):
    return named(mirror_pairs(found, 1)[0], "wing", found.vertices)


def four_legged(found):
    """The lowest four where the animal stands, else two pairs that mirror each other."""
    first, second = mirror_pairs(found, 2)
    return named(found.lowest(4) if found.stands else first + second, "leg", found.vertices)


def upright(found):
    """Arms are the higher of two pairs."""
    legs, arms = sorted(mirror_pairs(found, 2), key=lambda pair: sum(found.up[v] for v in pair))
    return named(legs, "leg", found.vertices) | named(arms, "arm", ())


def fingers(found):
    """All tips but the wrist, the one farthest from the others."""
    return named([max(found.vertices, key=found.loneliness)], "other", found.vertices, "finger")


KINDS = {  # category: how many tips, and their names
    "human": (5, of_person),
    "airplane": (5, winged),
    "ant": (8, of_insect),
    "chair": (8, standing),
    "octopus": (8, lambda found: named(found.vertices, "leg", ())),
    "hand": (6, fingers),
    "bird": (4, winged),
    "armadillo": (7, upright),
    "fourleg": (6, four_legged),
}
LYING = {"104", "105", "106", "382", "383", "386", "389"}  # y is not up; in the chairs z is


class Mesh:
    def __init__(self, path):
        self.vertices, self.faces = meshes.read_off(path)
        self.lists = neighbour_lists(self.vertices, self.faces)
        edges = defaultdict(list)
        for number, face in enumerate(self.faces):
            for a, b in zip(face, face[1:] + face[:1]):
                edges[min(a, b), max(a, b)].append(number)
        self.sides = [pair[:2] for pair in edges.values() if len(pair) > 1]
        self.face_of = {v: number for number, face in enumerate(self.faces) for v in face}

    def named_tips(self, category, lying):
        count, names = KINDS[category]
        return names(Tips(self, count, lying))

    def segment_graph(self, labels, least=0.0):
        """Neighbours of each segment: those with which it shares more than `least` of its border, or they with it."""
        borders, whole = Counter(), Counter()
        for a, b in self.sides:
            if labels[a] != labels[b]:
                for one, other in ((labels[a], labels[b]), (labels[b], labels[a])):
                    borders[one, other] += 1
                    whole[one] += 1
        graph = defaultdict(set)
        for (one, other), count in borders.items():
            if count > least * min(whole[one], whole[other]):
                graph[one].add(other)
        return graph


def chain(graph, start, goal):
    """The shortest chain of neighbours, ends included; empty if there is none."""
    before, queue = {start: None}, [start]
    for segment in queue:
        if segment == goal:
            break
        for other in sorted(graph[segment]):
            if other not in before:
                before[other] = segment
                queue.append(other)
    path = []
    while goal is not None and goal in before:
        path.append(goal)
        goal = before[goal]
    return path


def limb(graph, start, body):
    found, queue = {start}, [start]
    for segment in queue:
        for other in graph[segment] - body - found:
            found.add(other)
            queue.append(other)
    return found


def kinds_by_tips(mesh, labels, named):
    graph = mesh.segment_graph(labels)
    segment_of = {v: labels[mesh.face_of[v]] for v in named}
    kinds = {}
    for tip, kind in named.items():
        others = sorted({segment_of[v] for v in named} - {segment_of[tip]})
        body = {segment for i, a in enumerate(others) for b in others[:i] for segment in chain(graph, a, b)}
        if segment_of[tip] in body:  # this person did not cut the limb off
            continue
        for segment in limb(graph, segment_of[tip], body):
            kinds[segment] = kind
    return kinds


def handles(mesh, labels):
    size, sums = Counter(), defaultdict(lambda: [0.0, 0.0])
    points = [[sum(mesh.vertices[v][k] for v in face) / 3 for k in (0, 2)] for face in mesh.faces]
    for label, point in zip(labels, points):
        size[label] += 1
        sums[label][0] += point[0]
        sums[label][1] += point[1]
    largest = size.most_common(1)[0][0]
    x, z = (s / size[largest] for s in sums[largest])
    radius = sum(((p[0] - x) ** 2 + (p[1] - z) ** 2) ** 0.5 for label, p in zip(labels, points) if label == largest) / size[largest]
    aside = {s: ((sums[s][0] / size[s] - x) ** 2 + (sums[s][1] / size[s] - z) ** 2) ** 0.5 for s in size}
    return {s: "handle" for s in size if aside[s] > 0.6 * radius}


def table_legs(mesh, labels):
    size = Counter(labels)
    top = size.most_common(1)[0][0]
    graph, kinds = mesh.segment_graph(labels), {}
    for segment in size:
        if segment != top and sum(size[s] for s in limb(graph, segment, {top})) < len(labels) / 4:
            kinds[segment] = "leg"
    return kinds


def bear_limbs(mesh, labels):
    """The body is the segment about which the fifth largest limb is largest; of the five legs are lowest and the head is highest,
    by mean height."""
    graph, faces_of = mesh.segment_graph(labels, 0.2), defaultdict(list)  # hands may touch the head
    for number, label in enumerate(labels):
        faces_of[label].append(number)

    def size(each):
        return sum(len(faces_of[s]) for s in each)

    def limbs(body):
        found = {frozenset(limb(graph, segment, {body})) for segment in faces_of if segment != body}
        return sorted(found, key=lambda each: (-size(each), min(each)))[:5]
    largest = max(map(limbs, faces_of), key=lambda found: size(found[4]) if len(found) == 5 else 0)
    if len(largest) < 5:  # this person did not cut all limbs off
        return {}

    def height(each):
        heights = [mesh.vertices[mesh.faces[number][0]][1] for s in each for number in faces_of[s]]
        return sum(heights) / len(heights)
    order = sorted(largest, key=height)
    return {s: kind for each, kind in zip(order, ("leg", "leg", "arm", "arm", "head")) for s in each}


def face_kinds(mesh_path, seg_dir):
    mesh = Mesh(mesh_path)
    category = meshes.princeton_category(mesh_path)
    if category in BY_SEGMENTS:
        kinds_of = BY_SEGMENTS[category]
    else:
        tips_named = mesh.named_tips(category, mesh_path.stem in LYING)

        def kinds_of(mesh, labels):
            return kinds_by_tips(mesh, labels, tips_named)
    votes = [Counter() for _ in mesh.faces]
    files = sorted((seg_dir / mesh_path.stem).glob("*.seg"))
    for file in files:
        labels = [int(word) for word in file.read_text().split()]
        kinds = kinds_of(mesh, labels)
        for vote, label in zip(votes, labels):
            if label in kinds:
                vote[kinds[label]] += 1
    result = []
    for vote in votes:
        kind, count = vote.most_common(1)[0] if vote else ("-", 0)
        result.append(kind if count > len(files) / 2 and kind != "other" else "-")
    return result


BY_SEGMENTS = {"cup": handles, "table": table_legs, "teddy": bear_limbs}


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("off_dir", "seg_dir", "out_dir"):
        parser.add_argument(name, type=Path)
    parser.add_argument("--only", help="names without ending, separated by commas")
    options = parser.parse_args(words)
    options.out_dir.mkdir(parents=True, exist_ok=True)
    for path in meshes.chosen(options.off_dir, options.only, None):
        if meshes.princeton_category(path) not in {*KINDS, *BY_SEGMENTS}:
            continue
        kinds = face_kinds(path, options.seg_dir)
        (options.out_dir / f"{path.stem}.kinds").write_text("\n".join(kinds) + "\n")
        print(path.stem, meshes.princeton_category(path), dict(Counter(kinds)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
