"""Runs a program once and says what it cost: CPU seconds (user and system, of the process and the children it waited for)
as the kernel counts them, so that a busy machine distorts them little."""

import os
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

BIN = Path(__file__).resolve().parents[2] / "build" / "release" / "bin"  # where ./run builds programs


@dataclass
class Run:
    status: int  # exit status; minus the signal's number where one ended it
    output: str
    message: str  # what it wrote to standard error
    cpu_seconds: float
    memory_mb: float  # largest resident set
    timed_out: bool
    wall_seconds: float

    @property
    def trouble(self):
        """Why it did not do its work, in a line; empty when it did."""
        if self.timed_out:
            return "time limit"
        if self.status == 0:
            return ""
        return (self.message.strip().splitlines() or [f"exit status {self.status}"])[-1]


def expect(command, time_limit):
    """As run. Errors: ValueError with what the program complained of."""
    done = run(command, time_limit)
    if done.trouble:
        raise ValueError(done.trouble)
    return done


def run(command, time_limit):
    """`time_limit`: wall seconds, after which the program is killed."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen([str(word) for word in command], stdout=out, stderr=err, stdin=subprocess.DEVNULL)
        expired = threading.Event()

        def kill():
            expired.set()
            process.kill()

        timer = threading.Timer(time_limit, kill)
        timer.start()
        started = time.monotonic()
        _, status, usage = os.wait4(process.pid, 0)
        wall_seconds = time.monotonic() - started
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
        return Run(process.returncode, *texts, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024,
                   expired.is_set() and process.returncode < 0, wall_seconds)
