#!/usr/bin/python3
"""The dissertation's Tables 3.1 and 3.2 for trained networks, on views, materials and lights that they have not seen. See
bench/README.md.

    editing_bench.py NETS [--rows ROW...] [--count 500] [--refine [ROW...]] [--lines DIR] [--record]

NETS is a folder of editing_training.py; of its networks, those that are there are judged. Refinement takes seconds a picture:
with --lines what is measured is kept in DIR, a file of JSON lines for each row, and a run that was stopped goes on from there.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import cell, mean, table  # noqa: E402

# Name of the row; network, how it is judged, which of its figures; the dissertation's L2 and SSIM. With --refine,
# rows of pictures that were looked at without help are followed by the same refined.
ROWS = {
    "material alone, standalone": ("standalone", ["--given"], "render", (544.1, 0.9297)),
    "material alone, combined": ("combined", ["--given"], "render", (355.5, 0.9517)),
    "true normals, the rest optimised": ("joint", ["--known-normals"], "transfer", (802.7, 0.9416)),
    "encoder-decoder": ("encoder_decoder", [], "transfer", (1076.7, 0.9173)),
    "individual": ("separate", [], "transfer", (886.9, 0.9256)),
    "joint": ("joint", [], "transfer", (805.2, 0.9408)),
    "joint, parts": ("joint", ["--parts"], "transfer", None),
}
REFINED = {"individual": (1273.7, 0.9159), "joint": (530.9, 0.9557), "joint, parts": (1272.1, 0.9362)}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("nets", type=Path, help="a folder of editing_training.py")
    add("--rows", nargs="+", choices=ROWS, default=list(ROWS), metavar="ROW", help="of the tables: " + "; ".join(ROWS))
    add("--count", type=int, default=500, help="pictures")
    add("--refine", nargs="*", choices=REFINED, metavar="ROW", help="refine what networks find as well, in these rows or all that can be")
    add("--lines", type=Path, metavar="DIR", help="keep what is measured, and go on from it")
    add("--tool", type=Path, default=BIN / "editing_errors")
    add("--record", action="store_true", help="append the result to bench/history/editing.jsonl")
    options = parser.parse_args(words)
    options.refine = list(REFINED) if options.refine == [] else options.refine or []
    return options


def measured(options, name, how):
    network, words, _, _ = ROWS[name]
    views = options.nets / "views" / ("test_parts" if "--parts" in words else "test")
    command = [options.tool, options.nets / network / "best.pt", views, *words, *how]
    if not options.lines:
        return [json.loads(line) for line in expect([*command, "--count", options.count], 36000).output.splitlines()]
    options.lines.mkdir(parents=True, exist_ok=True)
    # Of weights that were trained since, what is kept tells nothing.
    kept = options.lines / f"{'-'.join([network, *words, *how]).replace('---', '-')}.jsonl"
    if kept.exists() and kept.stat().st_mtime < (options.nets / network / "best.pt").stat().st_mtime:
        kept.unlink()
    with open(kept, "a+b") as lines:
        lines.seek(0)
        whole = [line for line in lines if line.endswith(b"\n")]
        lines.truncate(sum(map(len, whole)))  # the last one may be half written
        if (missing := options.count - len(whole)) > 0:
            subprocess.run([*map(str, command), "--first", str(len(whole)), "--count", str(missing)], stdout=lines, check=True)
        lines.seek(0)
        return [json.loads(line) for line in lines][:options.count]


def figures(pictures, prefix, key):
    images = [each[prefix + key] for each in pictures]
    found = {name: mean([each[name] for each in images if name in each]) for name in ("l2", "ssim", "l2_frame", "ssim_frame")}
    for name in ("l2_frame", "ssim_frame"):
        found[f"{name}_same_exposure"] = mean([each["same_exposure"][name] for each in images])
    if prefix + "cosine" in pictures[0]:
        found["cosine"] = mean([each[prefix + "cosine"] for each in pictures])
    if key == "transfer" and prefix + "render" in pictures[0]:
        found["render_l2"] = mean([each[prefix + "render"]["l2"] for each in pictures])
    if not prefix and "material" in pictures[0]:
        found["material"] = mean([each["material"] for each in pictures])
    return found


def main(words):
    options = parse(words)
    found, published = {}, {}
    for name, (network, _, key, known) in ROWS.items():
        if name not in options.rows or not (options.nets / network / "best.pt").exists():
            continue
        refine = name in options.refine
        pictures = measured(options, name, ["--refine"] if refine else [])
        found[name], published[name] = figures(pictures, "", key), known
        if refine:
            again = f"{name}, refined"
            found[again], published[again] = figures(pictures, "refined_", key), REFINED[name]

    columns = {"l2": ".1f", "ssim": ".4f", "l2_frame": ".1f", "ssim_frame": ".4f", "l2_frame_same_exposure": ".1f", "ssim_frame_same_exposure": ".4f",
               "cosine": ".3f", "render_l2": ".1f", "material": ".2f"}
    rows = [[name, *(cell(each.get(key), form) for key, form in columns.items()), *map(cell, published[name] or (None, None))]
            for name, each in found.items()]
    print(table(["", "L2", "SSIM", "L2 frame", "SSIM frame", "same exposure, L2 frame", "SSIM frame", "cosine", "seen, L2", "material", "published L2", "SSIM"], rows))
    print(f"{options.count} pictures; L2 and SSIM over the object, then over the frame, each image exposed by itself or both as the true one; "
          "seen: the picture itself rendered anew")
    if options.record:
        print(f"recorded in {history.record('editing', {'count': options.count, 'tables': found})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
