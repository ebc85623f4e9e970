#!/usr/bin/python3
"""Chooses the clusters and the smoothness of `partwise segment` on half of the Princeton benchmark and reports the other
half apart. Reads the lines of segmentation_sweep, from files or standard input.

    build/release/bin/segmentation_sweep sdf MESHES SEG --clusters 2,3,4,5,6,7 --smoothness 4,8,12,16,24,32,48 \\
        | bench/fit_segmentation.py

Odd numbers fit, even ones judge. No mesh may become a single part with the chosen pair."""

import collections
import fileinput
import json
import statistics
import sys


def table(lines):
    """By pair of settings, then by mesh: the Rand error and the number of parts."""
    pairs = collections.defaultdict(dict)
    for line in lines:
        row = json.loads(line)
        pairs[row["clusters"], row["smoothness"]][int(row["mesh"])] = row["rand_error"], row["parts"]
    meshes = set.union(*(set(rows) for rows in pairs.values()))
    return {pair: rows for pair, rows in pairs.items() if set(rows) == meshes}


def mean_error(rows, chosen):
    return statistics.fmean(error for mesh, (error, _) in rows.items() if chosen(mesh))


def whole(rows):
    """Meshes that are one part."""
    return sorted(mesh for mesh, (_, parts) in rows.items() if parts == 1)


def best(pairs):
    """The pair with the least mean error over odd meshes, of those that leave no mesh whole if there are any."""
    cutting = {pair: rows for pair, rows in pairs.items() if not whole(rows)} or pairs
    return min(cutting, key=lambda pair: (mean_error(cutting[pair], lambda mesh: mesh % 2 == 1), pair))


def main(words):
    pairs = table(fileinput.input(words))
    pair = best(pairs)
    rows = pairs[pair]
    print(f"clusters {pair[0]}, smoothness {pair[1]:g}: Rand error over {len(rows)} meshes "
          f"{mean_error(rows, lambda mesh: True):.4f}")
    for name, remainder in (("odd numbers, which fitted", 1), ("even numbers", 0)):
        print(f"  {name}: {mean_error(rows, lambda mesh: mesh % 2 == remainder):.4f}")
    print(f"  parts {statistics.fmean(parts for _, parts in rows.values()):.1f} on average; whole: {whole(rows) or 'none'}")
    each = statistics.fmean(min(other[mesh][0] for other in pairs.values()) for mesh in rows)
    print(f"  with the best pair for each mesh it would be {each:.4f}")
    for clusters in sorted({clusters for clusters, _ in pairs}):
        errors = (f"{smoothness:g}: {mean_error(pairs[clusters, smoothness], lambda mesh: True):.4f}"
                  for smoothness in sorted(s for c, s in pairs if c == clusters))
        print(f"  {clusters} clusters: " + ", ".join(errors))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
