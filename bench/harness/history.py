"""Results kept as JSON lines in bench/history/, one line a recorded run: what, when, which commit, on what machine."""

import datetime
import json
import os
import platform
import subprocess
from pathlib import Path

BENCH = Path(__file__).resolve().parent.parent


def machine():
    model = platform.processor() or platform.machine()
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    except OSError:
        pass
    return {"cpu": model, "cores": os.cpu_count()}


def commit():
    """Of the sources, with a + where they were changed since; empty outside a checkout."""
    def git(*words):
        return subprocess.run(["git", "-C", BENCH, *words], capture_output=True, text=True, check=False).stdout.strip()
    name = git("rev-parse", "--short=12", "HEAD")
    # Not the history itself: a second record of the same build would seem to come from changed sources.
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ":(top)", ":(top,exclude)bench/history")
    return name + "+" if name and changed else name


def record(name, entry):
    line = {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "commit": commit(),
            **machine(), **entry}
    path = BENCH / "history" / f"{name}.jsonl"
    path.parent.mkdir(exist_ok=True)
    with path.open("a") as out:
        out.write(json.dumps(line) + "\n")
    return path
