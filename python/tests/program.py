"""The program partwise, which Python's results are held against, and the files that tests use."""

import json
import os
import subprocess
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
DATA = REPOSITORY / "data"
CHAIR = DATA / "models" / "chair.off"
NOTCH = REPOSITORY / "examples" / "notch.obj"
TOWN = DATA / "city" / "kronstadt.geojson"


def run(folder, *arguments):
    """Runs partwise in `folder`; returns its report."""
    command = [os.environ["PARTWISE_PROGRAM"], *map(str, arguments), "--quiet", "--json", "-"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=500)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def same_bytes(folder, a, b):
    one, other = (folder / a).read_bytes(), (folder / b).read_bytes()
    assert one == other, f"{a} has {len(one)} bytes, {b} {len(other)}, and they differ"
