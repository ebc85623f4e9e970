"""Planning problems made for the bench, and where Parasol's lie."""

import json
from pathlib import Path


def box(x0, y0, x1, y1, height):
    return {"polygon": [[x0, y0], [x1, y0], [x1, y1], [x0, y1]], "height": height}


def three_sticks(path, gap=0.9):
    """Three sticks of length 1 at right angles, between two slabs: straight they are wider than the gap, turned a third
    of the way to a corner they pass."""
    sticks = [box(0, -0.05, 1, 0.05, 0.1), box(-0.05, 0, 0.05, 1, 0.1), box(-0.05, -0.05, 0.05, 0.05, 1)]
    slabs = [box(-4, -0.5, -gap / 2, 0.5, 4), box(gap / 2, -0.5, 4, 0.5, 4)]
    Path(path).write_text(json.dumps({
        "name": "three sticks", "space": "se3", "robot": sticks, "obstacles": slabs,
        "bounds": {"low": [-4, -4, 0], "high": [4, 4, 4], "hold": "body"},
        "queries": [{"start": [0, -2.5, 1.5, 1, 0, 0, 0], "goal": [0, 2.5, 1.5, 1, 0, 0, 0]}]}))
    return Path(path)


PARASOL = {"alpha": "alpha1.6/alpha.env", "flange": "flange_1.0/flange.env", "bug trap": "bug_trap1.0/bug-trap.env"}


def problems(folder, parasol):
    """Files by name; those of Parasol only where `parasol` is a folder with its environments (not to be shipped)."""
    found = {"three sticks": three_sticks(Path(folder) / "three_sticks.json")}
    for name, place in PARASOL.items():
        if parasol and (Path(parasol) / place).exists():
            found[name] = Path(parasol) / place
    return found
