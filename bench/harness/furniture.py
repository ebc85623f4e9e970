"""Views of Sweet Home 3D's furniture (Debian's package sweethome3d-furniture) to train on and to judge by: which shapes are
kept for tests and for validation, and the data sets of views."""

import json
import re
import zipfile
from pathlib import Path

from .training import run

FOLDER = Path("/usr/share/sweethome3d/furniture")
ARCHIVES = {"zero": "BlendSwap-CC-0.sh3f", "by": "BlendSwap-CC-BY.sh3f", "kator": "KatorLegaz.sh3f", "scopia": "Scopia.sh3f",
            "people": "Reallusion.sh3f"}
# Kept for tests: cars, chairs, sofas, monitors, four each.
TEST = {"kator": ["VW-new-beetle", "office-chair", "mid-century-sofa", "apple-imac-1998"],
        "scopia": ["seat_leon", "peugeot-308", "van", "tubular_chair", "leather_sofa", "wall-flat-tv"],
        "zero": ["oakChair", "thonet", "couch", "sofa2", "led_tv"]}
VALIDATION = {"scopia": ["smart-car", "truck", "office_chair", "simple_sofa"], "zero": ["couch2", "winchesterSofa"], "by": ["couch3", "dafTruck"]}
ALSO_UNSEEN = {"by": ["sofa2"]}  # is called as one of the test shapes is


def shapes(options, chosen):
    """`chosen`: what of each archive; the name of an archive to {"ids": ...} or {"except": ...}."""
    return [{"archive": str(options.furniture.resolve() / ARCHIVES[name])} | which for name, which in chosen.items()]


def kept_back(name):
    return [each for shapes_of in (TEST, VALIDATION, ALSO_UNSEEN) for each in shapes_of.get(name, [])]


def chosen_shapes():
    only = {which: {name: {"ids": ids} for name, ids in shapes_of.items()} for which, shapes_of in (("validation", VALIDATION), ("test", TEST))}
    return {"training": {name: {"except": kept_back(name)} if kept_back(name) else {} for name in ARCHIVES},
            "cars": {name: {"categories": ["Vehicles"], "except": kept_back(name)} for name in ("zero", "by", "kator", "scopia")}} | only


LEAST = {"width": 30, "height": 40}  # centimetres; what is smaller does not stand on floors
INDOORS = ["Living room", "Kitchen", "Bedroom", "Office", "Bathroom"]


def indoor_ids(archive):
    """What stands in the rooms of flats, of a catalogue, in its order."""
    text = zipfile.ZipFile(archive).read("PluginFurnitureCatalog.properties").decode("latin-1")
    fields = {(name, int(number)): value.strip() for name, number, value in re.findall(r"^(id|category|width|height)#(\d+)=(.*)$", text, re.MULTILINE)}
    numbers = sorted({number for _, number in fields})
    return [fields["id", i].split("#")[-1] for i in numbers
            if fields["category", i] in INDOORS and all(float(fields[name, i]) >= least for name, least in LEAST.items())]


def indoor_shapes(options):
    """Of each catalogue the first of every ten is kept for tests and the sixth for validation."""
    all_of = {name: indoor_ids(options.furniture / ARCHIVES[name]) for name in ("zero", "by", "kator", "scopia")}

    def of(kept):
        return {name: {"ids": [each for i, each in enumerate(ids) if kept(i % 10)]} for name, ids in all_of.items()}

    return {"test": of(lambda i: i == 0), "validation": of(lambda i: i == 5), "training": of(lambda i: i not in (0, 5))}


def make_views(options, sets):
    """`sets`: name to which of the chosen shapes, how many views, and what their parts are."""
    for name, (which, count, parts) in sets.items():
        config = {"shapes": shapes(options, chosen_shapes()[which]), "parts": parts, "materials": "training", "lights": ["studio"],
                  "light_size": [16, 8], "map_size": 16, "samples": 4, "format": "png", "views": 1,
                  "images": count, "images_per_shard": 500}
        folder = options.out / "views"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.json").write_text(json.dumps(config, indent=2))
        run(options.program, "dataset", folder / f"{name}.json", "-o", folder / name)
