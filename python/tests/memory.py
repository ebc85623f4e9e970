"""Whether calls leave the memory of the process where it was."""

import gc
from pathlib import Path


def resident():
    """Bytes."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def expect_nothing_left(call, times=1000):
    """Of so many calls, after a hundred that may fill what is kept once."""
    for _ in range(100):
        call()
    before = resident()
    for _ in range(times):
        call()
    grown = resident() - before
    assert grown < 2 << 20, f"{grown / times:.0f} bytes a call"
