#!/usr/bin/python3
"""The dissertation's Tables 3.1 and 3.2 for trained networks, on views, materials and lights that they have not seen. See
bench/README.md.

    editing_bench.py VIEWS... --joint F.pt [--alone F.pt] [--combined F.pt] [--separate F.pt]
        [--encoder-decoder F.pt] [--count 500] [--refine]
"""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history  # noqa: E402
from harness.process import BIN, expect  # noqa: E402
from harness.table import mean, table  # noqa: E402

PUBLISHED = {"Table 3.2, encoder-decoder": (1076.7, 0.9173), "Table 3.1, standalone": (544.1, 0.9297), "Table 3.1, combined": (355.5, 0.9517), "Table 3.2, individual": (886.9, 0.9256),
             "Table 3.2, individual, refined": (1273.7, 0.9159), "Table 3.2, joint": (805.2, 0.9408),
             "Table 3.2, joint, refined": (530.9, 0.9557)}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("views", type=Path, nargs="+", help="folders of shards of views")
    add("--joint", type=Path, help="weights trained through the rendering layer")
    add("--separate", type=Path, help="weights of networks trained one by one (baseline 2)")
    add("--encoder-decoder", type=Path, help="weights of an encoder-decoder (baseline 1)")
    add("--alone", type=Path, help="weights whose material network was trained on coefficients alone")
    add("--combined", type=Path, help="weights whose material network was trained through the layer, normals and light given")
    add("--count", type=int, default=500, help="pictures")
    add("--refine", action="store_true")
    add("--tool", type=Path, default=BIN / "editing_errors")
    add("--record", action="store_true", help="append the result to bench/history/editing.jsonl")
    return parser.parse_args(words)


def measured(options, weights, *more):
    done = expect([options.tool, weights, *options.views, "--count", options.count, *more], 36000)
    return [json.loads(line) for line in done.output.splitlines()]


def figures(pictures, key):
    return {name: mean([each[key][name] for each in pictures if name in each[key]])
            for name in ("l2", "ssim", "l2_frame", "ssim_frame")}


def main(words):
    options = parse(words)
    found = {}
    for name, weights in (("standalone", options.alone), ("combined", options.combined)):
        if weights:
            pictures = measured(options, weights, "--given")
            found[f"Table 3.1, {name}"] = figures(pictures, "render") | {"material": mean([each["material"] for each in pictures])}
    if options.encoder_decoder:
        pictures = measured(options, options.encoder_decoder)
        found["Table 3.2, encoder-decoder"] = figures(pictures, "transfer") | {"material": mean([each["material"] for each in pictures])}
    for name, weights in (("individual", options.separate), ("joint", options.joint)):
        if weights:
            pictures = measured(options, weights, *(["--refine"] if options.refine else []))
            for prefix, ending in (("", ""), ("refined_", ", refined")):
                if prefix + "transfer" in pictures[0]:
                    found[f"Table 3.2, {name}{ending}"] = figures(pictures, prefix + "transfer") | {
                        "render_l2": figures(pictures, prefix + "render")["l2"],
                        "cosine": mean([each[prefix + "cosine"] for each in pictures])}
    rows = [[name, f"{each['l2']:.1f}", f"{each['ssim']:.4f}", f"{each['l2_frame']:.1f}", f"{each['ssim_frame']:.4f}",
             *(f"{value:g}" for value in PUBLISHED[name])] for name, each in found.items()]
    print(table(["", "L2", "SSIM", "L2 frame", "SSIM frame", "published L2", "SSIM"], rows))
    for name, each in found.items():
        more = {key: round(value, 4) for key, value in each.items() if key in ("material", "render_l2", "cosine")}
        print(f"{name}: {more}")
    print(f"{options.count} pictures; L2 and SSIM over the object, then over the frame")
    if options.record:
        print(f"recorded in {history.record('editing', {'count': options.count, 'tables': found})}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
