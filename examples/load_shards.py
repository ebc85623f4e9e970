#!/usr/bin/python3
"""Reads the shards of a data set, an image at a time: load_shards.py DIR. Python's own library is enough."""

import json
import sys
import tarfile
from pathlib import Path


def images(folder):
    """Yields the number of each image and its files by their endings: "image.exr" or "image.png", "normal.png", "mask.png", "part.png", "json"."""
    for shard in sorted(Path(folder).glob("shard-*.tar")):
        key, files = None, {}
        with tarfile.open(shard) as tar:
            for entry in tar:
                name, ending = entry.name.split(".", 1)
                if key not in (None, name):
                    yield key, files
                    files = {}
                key = name
                files[ending] = tar.extractfile(entry).read()
        yield key, files


if __name__ == "__main__":
    for key, files in images(sys.argv[1]):
        scene = json.loads(files["json"])
        print(key, scene["meshes"][0]["file"], scene["light"]["name"], *scene["meshes"][0]["material"], len(files["mask.png"]))
