"""What scripts that train networks share: their options, and trainings one after another, each from where it is to start."""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

from .process import BIN


def parse(doc, networks, furniture, words, batch=16):
    """`networks`: name to what is known of each; "start" is the name of one that goes before, or a file of weights."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("out", type=Path, help="the folder")
    add("networks", nargs="*", metavar="NETWORK", help=", ".join(networks) + "; left out: all")
    add("--furniture", type=Path, default=furniture, help="folder of .sh3f archives")
    add("--effort", type=float, default=1, help="times as many steps as written here")
    add("--start", type=Path, help="weights that each starts from, instead of those of another one of OUT or random ones")
    add("--batch", type=int, default=batch, help="pictures a step")
    add("--processes", type=int, default=os.cpu_count(), help="that share each batch, a thread each; a divisor of it")
    add("--seed", type=int, default=0)
    add("--program", type=Path, default=BIN / "partwise")
    options = parser.parse_args(words)
    if unknown := set(options.networks) - set(networks):
        parser.error(f"{unknown.pop()} is none of {', '.join(networks)}")
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is not there: build it, or name another")
    return options


def run(*command):
    print(*command, flush=True)
    subprocess.run([str(word) for word in command], check=True)


def train_together(processes, *command):
    """Processes of one thread share each batch: two of them learn twice as fast as one of two threads."""
    print(*command, flush=True)
    words = [str(word) for word in command]
    where = os.environ | {"WORLD_SIZE": str(processes), "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": "29571", "OMP_NUM_THREADS": "1",
                          "OPENBLAS_NUM_THREADS": "1"}
    started = [subprocess.Popen(words, env=where | {"RANK": str(rank)}) for rank in range(processes)]
    if any([process.wait() for process in started]):
        sys.exit(f"{words[0]} failed")


def stage(options, which):
    first, last = which["rates"]
    return {"steps": max(1, round(options.effort * which["steps"])), "learning_rate": first, "final_learning_rate": last} | which["terms"]


def started(options, config, which):
    """The configuration with the weights that it goes on from, if it does."""
    start = options.start.resolve() if options.start else which.get("start")
    if start is None:
        return config
    return config | {"start": str(start) if isinstance(start, Path) else f"{start}/best.pt"}


def train(options, networks, configuration, name):
    needed = networks[name].get("start")
    if isinstance(needed, str) and not options.start and not (options.out / needed / "best.pt").exists():
        train(options, networks, configuration, needed)
    config = options.out / f"{name}.json"
    config.write_text(json.dumps(started(options, configuration(options, networks[name]), networks[name]), indent=2))
    train_together(options.processes, options.program, "train", config, "-o", options.out / name, "--resume", "--threads", 1)


def train_all(options, networks, configuration):
    """`configuration(options, which)`: all but "start"."""
    for name in options.networks or networks:
        train(options, networks, configuration, name)
