#!/usr/bin/python3
"""Models of measured materials beside each other, by log-RMSE and by pictures of balls.

    material_bench.py [--build build/release] [--only NAME,NAME] [--no-balls] [--lines F] [--record] DIR_OR_FILE...

Fits every .binary or .h5 with material_errors and prints the table: our model, 8 to 64 principal components of it, and the
models of others. --lines keeps what material_errors prints, a JSON line a material, or is read instead of measuring where no
files are named. --record appends the totals to bench/history/material.jsonl. Exits with 1 when a target is missed.
"""

import argparse
import json
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness import history, table  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
LIGHTS = ("studio", "park", "city")
MODELS = ("dsbrdf", "pca64", "pca32", "pca16", "pca8", "ggx3", "ggx2", "ggx1", "cook-torrance", "blinn-phong", "lambert")
GLOSSY = ("plastic", "phenolic", "paint", "acrylic", "polyethylene", "obsidian", "ball", "nylon", "delrin", "jasper", "hematite")
CLOTH = ("fabric", "felt")


def files_of(arguments, only):
    for argument in map(Path, arguments):
        files = sorted(argument.iterdir()) if argument.is_dir() else [argument]
        yield from (file for file in files if file.suffix in (".binary", ".h5") and (not only or file.stem in only))


def measure(options):
    files = list(files_of(options.measured, options.only.split(",") if options.only else []))
    command = [Path(options.build) / "bin" / "material_errors", *files]
    if not options.no_balls:
        for light in LIGHTS:
            command += ["--light", ROOT / "data" / "lights" / f"{light}.exr"]
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if result.returncode:
        sys.exit(result.stderr.strip())
    return result.stdout


def is_kind(row, words):
    return any(word in row["material"] for word in words)


def summary(rows):
    """Totals by model."""
    totals = {}
    for model in MODELS:
        errors = [row["log_rmse"][model] for row in rows]
        totals[model] = {"log_rmse_median": statistics.median(errors), "log_rmse_worst": max(errors)}
        if all("psnr" in row for row in rows):
            psnr = [row["psnr"][model] for row in rows]
            totals[model] |= {"psnr_median": statistics.median(psnr), "psnr_worst": min(psnr),
                              "ssim_median": statistics.median(row["ssim"][model] for row in rows)}
    return totals


def gains(rows, words):
    """Decibels above GGX with one lobe, of the materials that a word names."""
    return sorted(row["psnr"]["dsbrdf"] - row["psnr"]["ggx1"] for row in rows if "psnr" in row and is_kind(row, words))


def targets(rows, totals):
    ours = totals["dsbrdf"]
    yield "median log-RMSE at most 0.16", ours["log_rmse_median"], ours["log_rmse_median"] <= 0.16
    yield "worst log-RMSE at most 0.40", ours["log_rmse_worst"], ours["log_rmse_worst"] <= 0.40
    seconds = statistics.median(row["seconds_fit"] + row["seconds_reading"] for row in rows)
    yield "a fit with its reading about 1 s (at most 1.5, median)", seconds, seconds <= 1.5
    glossy, cloth = gains(rows, GLOSSY), gains(rows, CLOTH)
    if glossy:
        yield "glossy: at least 6 dB above GGX of one lobe (median)", statistics.median(glossy), statistics.median(glossy) >= 6
    if cloth:
        yield "cloth: not below GGX of one lobe (worst)", cloth[0], cloth[0] >= 0
    unseen = [row["psnr"]["dsbrdf"] - row["psnr"]["pca32"] for row in rows if "psnr" in row and row["test"]]
    if unseen:
        yield "unseen: 32 components lose at most 3 dB (median)", statistics.median(unseen), statistics.median(unseen) <= 3


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("measured", nargs="*")
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--only")
    parser.add_argument("--no-balls", action="store_true")
    parser.add_argument("--lines", metavar="F")
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    if not options.measured and not options.lines:
        parser.error("name measured materials, or lines that are kept")
    text = measure(options) if options.measured else Path(options.lines).read_text()
    if options.measured and options.lines:
        Path(options.lines).write_text(text)
    rows = [json.loads(line) for line in text.splitlines()]
    if not rows:
        sys.exit("no material to measure")
    totals = summary(rows)
    header = ["model", "log-RMSE", "worst"] + (["PSNR", "worst", "SSIM"] if "psnr" in rows[0] else [])
    print(table.table(header, [[name, *(f"{value:.3f}" if "psnr" not in key else f"{value:.1f}" for key, value in of.items())]
                               for name, of in totals.items()]))
    held = list(targets(rows, totals))
    for what, value, holds in held:
        print(f"{'holds' if holds else 'MISSED'}: {what}: {value:.3f}")
    if options.record:
        entry = {"settings": {"materials": len(rows), "lights": [] if options.no_balls else list(LIGHTS)}, "totals": totals,
                 "targets": {what: {"value": value, "holds": holds} for what, value, holds in held}}
        print(f"recorded in {history.record('material', entry)}")
    return 0 if all(holds for _, _, holds in held) else 1


if __name__ == "__main__":
    sys.exit(main())
