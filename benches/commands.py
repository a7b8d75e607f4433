#!/usr/bin/env python3
"""Times whole commands, as a user types them: processor time and memory, into one JSON document.

    benches/commands.py PROGRAM OUTPUT.json

Each command runs several times; kept is the least processor time (user and system), which other work on the machine disturbs
least, and of those that last for seconds the largest resident size. README.md and docs quote the document; tests/program/prose_numbers.rs compares them.
"""

import datetime
import json
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ONSET = "run --alpha-above 0.01 --r 1 --kick 0.01 --until 457"
CYCLES = "run --alpha 1.2 --r 1 --kick 0.05 --until 1e6 --sample-every 10 -o long.jsonl"
# Shorter ones tell no size, in seconds.
LASTING = 0.3
# name: (command, repetitions). Later commands read what earlier ones have written.
COMMANDS = {
    "just above onset": (f"{ONSET} -o run.json", 25),
    "stick-slip": ("run --alpha 1.2 --r 1 --kick 0.05 --until 457 -o cycles.json", 25),
    "trapped": ("run --alpha 4 --r 1 --kick 0.01 --until 1e5 -o trapped.json", 25),
    "critical point and growth exponents": ("stability --alpha 1.2 --r 1", 25),
    "limit cycle": ("cycle --alpha 1.2 --r 1", 25),
    "surface, 50,001 points": ("surface run.json --at 457 --range 400:470 --spacing 0.0014 -o surface.csv", 15),
    "image, 2,001 × 401": (
        "surface run.json --at 457 --range 0:471 --spacing 0.2355 --y-range=-3:3 --spacing-y 0.015 -o image.npz",
        15,
    ),
    "long run, default tolerance": (CYCLES, 3),
    "long run, fft": (f"{CYCLES} --tolerance 1e-6 --memory fft", 3),
    "long run": (f"{CYCLES} --tolerance 1e-6", 3),
    "long run verified": ("verify long.jsonl", 1),
    "phase diagram, one thread": ("sweep --r 0.3:2:100 --alpha 0.05:4:100 --threads 1 -o map.json", 1),
}


def once(program, command, folder):
    """Processor seconds and MB of one run; exit status 1 is a verification that found differences."""
    child = subprocess.Popen([program, "--quiet", *shlex.split(command)], cwd=folder, stdout=subprocess.DEVNULL)
    begun, largest, ended = time.monotonic(), 0, 0
    while not ended:
        # What the system reports in the end holds the size of this process too, from before the command took its place.
        largest = resident(child.pid) or largest
        time.sleep(0.01)
        ended, status, usage = os.wait4(child.pid, os.WNOHANG)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 1) or (child.returncode == 1 and not command.startswith("verify")):
        sys.exit(f"stickslip {command}: exit status {child.returncode}")
    return usage.ru_utime + usage.ru_stime, largest if time.monotonic() - begun > LASTING else None


def resident(pid):
    """The largest resident size of a process so far, in MB."""
    with open(f"/proc/{pid}/status") as file:
        found = [line.split()[1] for line in file if line.startswith("VmHWM")]
    return int(found[0]) / 1024 if found else None


def printed(*command):
    folder = Path(__file__).resolve().parent
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, cwd=folder).stdout.strip()


def main():
    program, output = Path(sys.argv[1]), Path(sys.argv[2])
    data = Path(__file__).resolve().parents[1] / "data"
    if output.resolve().parent == data and printed("git", "status", "--porcelain", "--untracked-files=no"):
        sys.exit("the tree has changes that no commit names: commit them, or write to another folder than data")
    with open("/proc/cpuinfo") as file:
        models = {line.split(":", 1)[1].strip() for line in file if line.startswith("model name")}
    document = {
        "date": datetime.date.today().isoformat(),
        "machine": {
            "cpu": ", ".join(sorted(models)),
            "cores": os.cpu_count(),
            "os": platform.freedesktop_os_release()["PRETTY_NAME"],
            "load": round(os.getloadavg()[0], 2),
        },
        "stickslip": printed("git", "describe", "--always", "--dirty"),
        "rustc": printed("rustc", "--version").split()[1],
        "commands": {},
    }
    with tempfile.TemporaryDirectory() as folder:
        # A copy, as an installed program is: the system maps the pages of a file that a linker wrote one by one.
        program = shutil.copy(program, folder)
        for name, (command, count) in COMMANDS.items():
            seconds, megabytes = zip(*(once(program, command, folder) for _ in range(count)))
            largest = None if None in megabytes else max(megabytes)
            found = {"command": f"stickslip {command}", "runs": count, "seconds": min(seconds), "megabytes": largest}
            document["commands"][name] = found
            print(f"{name}: {min(seconds):.4f} s, {largest} MB", file=sys.stderr)
    output.write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
