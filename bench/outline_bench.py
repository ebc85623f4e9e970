#!/usr/bin/env python3
"""Decompositions in the plane over many shapes, each judged by outline_check.

    outline_bench.py [--build build/release] [--tolerance 0.05] [--noise] [--jobs N] [--list] [--json F] SHAPE_OR_DIR...

Prints the count of shapes, of failures by kind, parts and times; with --list a line a shape; with --acd2d DIR the table of
acd2d's published and measured figures beside ours at equal absolute tolerance. --noise decomposes a noisy version of each
shape as well (outline_noise) and prints the Rand index between the two, for outline_peer too, and with --mncd SECONDS for
outline_mncd, which gets so long for a shape. --record appends the totals to bench/history/outline.jsonl.
"""

import argparse
import concurrent.futures
import json
import statistics
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402

ENDINGS = {".poly", ".png", ".svg", ".wkt", ".geojson"}
# Radius of acd2d over ours, and its parts at 0.1, 0.05 and 0.01 of its radius.
ACD2D = {
    "bird": (1.24, 7, 12, 27),
    "mammoth": (1.03, 10, 16, 41),
    "texas": (1.23, 5, 8, 24),
    "nazca_monkey": (1.10, 30, 43, 104),
    "neuron": (1.14, 41, 64, 160),
    "hole3": (1.18, 17, 21, 49),
    "fisheye": (1.19, 25, 36, 91),
}


def shapes_of(arguments):
    for argument in map(Path, arguments):
        if argument.is_dir():
            yield from sorted(p for p in argument.rglob("*") if p.suffix in ENDINGS)
        else:
            yield argument


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True)


class Bench:
    def __init__(self, build, tolerance, mncd=None):
        self.bin = Path(build) / "bin"
        self.tolerance = tolerance
        self.peers = {"peer": ["outline_peer"]} | ({"mncd": ["outline_mncd", "--seconds", mncd]} if mncd else {})

    def outline(self, shape, parts, tolerance):
        result = run(self.bin / "partwise", "outline", shape, "--lenient", "--tolerance", tolerance, "--parts", parts,
                     "--json", "-")
        if result.returncode:
            return None, result.stderr.strip() or f"exit {result.returncode}"
        return json.loads(result.stdout), ""

    def judged(self, shape, parts, tolerance=None):
        """A row: what the program reports, what the judge says, and a list of what is wrong."""
        tolerance = tolerance or self.tolerance
        report, error = self.outline(shape, parts, tolerance)
        if report is None:
            return {"shape": str(shape), "wrong": [error]}
        check = run(self.bin / "outline_check", "--lenient", shape, parts)
        if check.returncode:
            return {"shape": str(shape), "wrong": [check.stderr.strip() or "the judge failed"]}
        judge = json.loads(check.stdout)
        wrong = [k for k in ("area_error", "outside", "missing", "overlap") if not abs(judge[k] or 0) <= 1e-9]
        wrong += [k for k in ("foreign", "invalid") if judge[k]]
        if judge["depth"] > tolerance * report["radius"] * (1 + 1e-9):
            wrong.append("depth")
        return {
            "shape": str(shape),
            "parts": report["parts"],
            "holes_kept": report["holes_kept"],
            "holes_noise": report["holes_noise"],
            "unresolved": report["unresolved"],
            "seconds": report["seconds"]["cutting"],
            "concavity": report["concavity"],
            "judge": judge,
            "wrong": wrong,
        }

    def row(self, shape, noise):
        with tempfile.TemporaryDirectory(prefix="outline-bench-") as folder:
            clean, noisy, noisy_parts = (Path(folder) / name for name in ("c.geojson", "n.geojson", "np.geojson"))
            row = self.judged(shape, clean)
            if not noise or row["wrong"]:
                return row
            made = run(self.bin / "outline_noise", shape, noisy, "--seed", zlib.crc32(shape.name.encode()) % 1000)
            if made.returncode:
                row["noisy"] = {"wrong": [made.stderr.strip()]}
                return row
            row["noisy"] = self.judged(noisy, noisy_parts)
            if not row["noisy"]["wrong"]:
                compared = run(self.bin / "partwise", "compare2d", clean, noisy_parts, "--json", "-")
                if compared.returncode == 0:
                    row["rand_index"] = json.loads(compared.stdout)["rand_index"]
                for name, command in self.peers.items():
                    row[name] = self.peer(command, shape, noisy, Path(folder))
            return row

    def peer(self, command, shape, noisy, folder):
        """The same of a peer, which takes every hole for structure."""
        row, outputs = {}, [folder / "peer_clean.geojson", folder / "peer_noisy.geojson"]
        for name, given, parts in zip(("clean", "noisy"), (shape, noisy), outputs):
            made = run(self.bin / command[0], given, parts, "--tolerance", self.tolerance, *command[1:])
            if made.returncode:
                return {"wrong": made.stderr.strip()}
            row[name] = json.loads(made.stdout.splitlines()[-1])  # CBC may speak before
        compared = run(self.bin / "partwise", "compare2d", *outputs, "--json", "-")
        if compared.returncode == 0:
            row["rand_index"] = json.loads(compared.stdout)["rand_index"]
        return row


def summarise(rows, name):
    wrong = [row for row in rows if row["wrong"]]
    good = [row for row in rows if not row["wrong"]]
    print(f"{name}: {len(rows)} shapes, {len(wrong)} wrong")
    for row in wrong:
        print(f"  {row['shape']}: {', '.join(row['wrong'])}")
    if good:
        seconds = sorted(row["seconds"] for row in good)
        parts = [row["parts"] for row in good]
        print(f"  parts: mean {statistics.mean(parts):.2f}, most {max(parts)}; holes kept {sum(r['holes_kept'] for r in good)}, "
              f"noise {sum(r['holes_noise'] for r in good)}; unresolved {sum(r['unresolved'] for r in good)}")
        print(f"  seconds: mean {statistics.mean(seconds):.4f}, median {statistics.median(seconds):.4f}, largest {seconds[-1]:.4f}")


def stability(rows):
    """By method, over the shapes that we cut into three parts or more and that all methods did, clean and noisy."""
    methods = ["ours"] + [name for name in ("peer", "mncd") if any(name in row for row in rows)]
    rows = [row for row in rows if row.get("parts", 0) >= 3 and "rand_index" in row
            and all("rand_index" in row.get(name, {}) for name in methods[1:])]
    totals = {}
    for name in methods if rows else []:
        clean = [row if name == "ours" else row[name]["clean"] for row in rows]
        noisy = [row["noisy"] if name == "ours" else row[name]["noisy"] for row in rows]
        rand = [(row if name == "ours" else row[name])["rand_index"] for row in rows]
        totals[name] = {"shapes": len(rows), "rand_index": round(statistics.mean(rand), 4), "rand_index_min": round(min(rand), 4)}
        for kind, results in (("clean", clean), ("noisy", noisy)):
            totals[name] |= {
                f"parts_{kind}": round(statistics.mean(result["parts"] for result in results), 2),
                f"seconds_{kind}": round(statistics.mean(result["seconds"] for result in results), 4),
                f"seconds_max_{kind}": round(max(result["seconds"] for result in results), 4),
            }
            if name == "mncd":
                totals[name][f"finished_{kind}"] = sum(result["finished"] for result in results)
    return totals


def print_acd2d(bench, folder):
    print(f"{'':14}{'parts at 0.1, 0.05, 0.01 of the radius of acd2d: ours / its':>60}")
    for name, (ratio, *theirs) in ACD2D.items():
        shape = next(Path(folder).rglob(f"{name}.poly"))
        cells = []
        with tempfile.TemporaryDirectory() as temporary:
            for tolerance, parts in zip((0.1, 0.05, 0.01), theirs):
                row = bench.judged(shape, Path(temporary) / "p.geojson", tolerance * ratio)
                cells.append("wrong" if row["wrong"] else f"{row['parts']} / {parts} ({1000 * row['seconds']:.0f} ms)")
        print(f"{name:14}" + "".join(f"{cell:>20}" for cell in cells))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shapes", nargs="*")
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--tolerance", type=float, default=0.05)
    parser.add_argument("--noise", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--json")
    parser.add_argument("--acd2d", metavar="DIR")
    parser.add_argument("--mncd", type=float, metavar="SECONDS")
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    bench = Bench(options.build, options.tolerance, options.mncd)
    if options.acd2d:
        print_acd2d(bench, options.acd2d)
    shapes = list(shapes_of(options.shapes))
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda shape: bench.row(shape, options.noise), shapes))
    if options.list:
        for row in rows:
            print(json.dumps(row))
    if rows:
        summarise(rows, "clean")
    noisy = [row["noisy"] for row in rows if "noisy" in row]
    if noisy:
        summarise(noisy, "noisy")
        totals = stability(rows)
        for name, figures in totals.items():
            print(f"{name}: " + ", ".join(f"{key} {value}" for key, value in figures.items()))
        if options.record:
            settings = {"tolerance": options.tolerance, "mncd_seconds": options.mncd, "shapes": len(rows)}
            print(f"recorded in {history.record('outline', {'settings': settings, 'totals': totals})}")
    if options.json:
        Path(options.json).write_text("".join(json.dumps(row) + "\n" for row in rows))
    return 1 if any(row["wrong"] or row.get("noisy", {}).get("wrong") for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
