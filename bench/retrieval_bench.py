#!/usr/bin/python3
"""Part-based retrieval on the Princeton benchmark: of the nine parts most like a leg, an arm, a wing, ..., how many are of the
same kind. See bench/README.md.

    label_parts.py OFF_DIR SEG_DIR KINDS_DIR          names the parts by a fixed rule, once
    retrieval_bench.py OFF_DIR KINDS_DIR INDEX_DIR    searches the meshes that have names
"""

import argparse
import json
import os
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, meshes  # noqa: E402
from harness.process import BIN, run  # noqa: E402
from harness.table import cell, mean, table  # noqa: E402

QUERIES = Path(__file__).resolve().parent / "retrieval_queries.json"
TOP, ENOUGH = 9, 7
NAMED = ("leg", "arm", "wing", "handle", "finger")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    for name in ("off_dir", "kinds_dir", "index_dir"):
        add(name, type=Path)
    add("--program", type=Path, default=BIN / "partwise")
    add("--choose", action="store_true", help="write the list of queries anew: of every category and kind the first "
        "two meshes that have it, there the part with the largest area")
    add("--record", action="store_true", help="append the result to bench/history/retrieval.jsonl")
    options = parser.parse_args(words)
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def area(vertices, face):
    a, b, c = (vertices[v] for v in face)
    u, w = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    cross = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
    return sum(x * x for x in cross) ** 0.5 / 2


class Parts:
    """The parts that the program cuts a mesh into, and what they are: the kind that over half of a part's area has."""

    def __init__(self, mesh, kinds_dir, index_dir):
        vertices, faces = meshes.read_off(mesh)
        self.labels = json.loads((index_dir / f"{mesh.name}.parts.json").read_text())["labels"]
        self.areas, shares = defaultdict(float), defaultdict(float)
        for face, label, kind in zip(faces, self.labels, (kinds_dir / f"{mesh.stem}.kinds").read_text().split()):
            size = area(vertices, face)
            self.areas[label] += size
            shares[label, kind] += size
        self.kinds = {label: kind for (label, kind), share in shares.items()
                      if kind in NAMED and share > self.areas[label] / 2}

    def largest(self, kind):
        return max((part for part in self.kinds if self.kinds[part] == kind), key=self.areas.get)


class Search:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def __call__(self, mesh, part, *words):
        command = [self.options.program, "retrieve", self.folder / mesh, part, self.folder, "--index",
                   self.options.index_dir, "--threads", 1, "--json", "-", *words]
        result = run(command, 24 * 3600)
        if result.trouble:
            sys.exit(f"retrieval_bench: {mesh}: {result.trouble}")
        return json.loads(result.output), result.cpu_seconds


def choose(parts):
    found, queries = defaultdict(list), []
    for name in sorted(parts, key=lambda name: int(Path(name).stem)):
        for kind in sorted(set(parts[name].kinds.values())):
            found[meshes.princeton_category(Path(name)), kind].append(name)
    for (category, kind), names in found.items():
        for name in names[:2]:
            face = parts[name].labels.index(parts[name].largest(kind))
            queries.append({"mesh": name, "face": face, "kind": kind, "category": category})
    QUERIES.write_text("[\n" + ",\n".join("  " + json.dumps(query) for query in queries) + "\n]\n")


def judged(query, parts, search):
    """How many of the nine are of the kind, of all but the query's own mesh, and of all but the query itself; and how many of
    the former are of its category as well."""
    part = parts[query["mesh"]].labels[query["face"]]
    others, cpu = search(query["mesh"], part, "--others", "--top", TOP)
    everywhere, _ = search(query["mesh"], part, "--top", TOP + 1)

    def is_right(match):
        return parts[match["file"]].kinds.get(match["part"]) == query["kind"]
    rest = [m for m in everywhere["matches"] if (m["file"], m["part"]) != (query["mesh"], part)][:TOP]
    right = [m for m in others["matches"] if is_right(m)]
    return {"others": len(right), "everywhere": sum(map(is_right, rest)), "cpu": cpu,
            "category": sum(meshes.princeton_category(Path(m["file"])) == query["category"] for m in right)}


def main(words):
    options = parse(words)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        paths = [path for path in meshes.find(options.off_dir) if (options.kinds_dir / f"{path.stem}.kinds").exists()]
        if not paths:
            sys.exit(f"retrieval_bench: no mesh of {options.off_dir} has names in {options.kinds_dir}")
        for path in paths:
            (folder / path.name).symlink_to(path.resolve())
        search = Search(options, folder)
        report, cpu = search(paths[0].name, 0)
        print(f"{len(paths)} meshes, {report['indexed']} indexed now in {cpu:.1f} CPU s")
        parts = {path.name: Parts(path, options.kinds_dir, options.index_dir) for path in paths}
        if options.choose:
            choose(parts)
        queries = json.loads(QUERIES.read_text())
        chance = {kind: mean(own == kind for each in parts.values() for own in (each.kinds.get(p) for p in each.areas))
                  for kind in NAMED}
        rows, results = [], []
        for query in queries:
            result = judged(query, parts, search)
            results.append(result)
            rows.append([f"{query['category']} {query['kind']}", query["mesh"], *(str(result[key]) for key in
                         ("others", "category", "everywhere")), cell(9 * chance[query["kind"]], ".1f")])
    print(table(["query", "mesh", "of 9, other meshes", "same category", "of 9, all meshes", "by chance"], rows))
    entry = {"meshes": len(paths), "parts": sum(len(each.areas) for each in parts.values()), "queries": len(queries),
             "cpu_seconds_a_query": mean(result["cpu"] for result in results)}
    for key, title in (("others", "other meshes"), ("everywhere", "all meshes, the part itself left out")):
        entry |= {f"{key}_of_9": mean(result[key] for result in results),
                  f"{key}_enough": sum(result[key] >= ENOUGH for result in results)}
        print(f"{title}: {entry[f'{key}_of_9']:.2f} of 9 in the mean, {entry[f'{key}_enough']} of {len(queries)} queries have "
              f"{ENOUGH} or more")
    entry["by_kind"] = {kind: mean(result["others"] for query, result in zip(queries, results) if query["kind"] == kind)
                        for kind in NAMED}
    print("by kind, other meshes:", ", ".join(f"{kind} {cell(value, '.2f')}" for kind, value in entry["by_kind"].items()))
    if options.record:
        print(f"recorded in {history.record('retrieval', entry)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
