#!/usr/bin/env python3
"""A soak of the program: random commands, of which each is killed, interrupted, given a full disk, a limit on the size of
files, or a second writer of the same file, and then repeated in peace.

    packages/soak.py PROGRAM [--minutes 30] [--seed N]

The judge of each is the same command, undisturbed, in a folder of its own. What must hold:
- an output that was there is, after a fault, what it was or the whole of the new one, never a part of either; a
  run that was interrupted may end early, and then says so;
- after a repetition in peace (--resume, where there is a checkpoint) the bytes are those of the judge, and so are the
  names in the folder: nothing is lost, nothing is left over, there or in TMPDIR;
- no panic, no status that docs/reference/limits.md does not have, no process that outlives its command, memory below 512 MB.
A full disk needs the right to mount (root); without it that fault is a limit on the size of files.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

# Times differ from run to run.
SECONDS = re.compile(rb'("(?:seconds|speedup)":)[^,}\]]*')
MEMORY = 512 << 20
OLD = b"what the user had before\n"
FAULTS = ["killed", "interrupted", "terminated", "full disk", "large file", "two writers"]
# SIGINT and SIGTERM are told apart by these.
INTERRUPTED = {signal.SIGINT: 130, signal.SIGTERM: 143}


class Violation(Exception):
    """Something that must not be."""


def commands(rng):
    """A random command line, and the files that it writes."""
    def real(low, high):
        return f"{rng.uniform(low, high):.6g}"

    model = f"--r {real(0.6, 1.5)} --alpha {real(0.3, 4)}"
    tip = rng.choice(["", " --tip gaussian", " --beta 0.5"])
    until = real(50, 3000)
    kind = rng.choice(["json", "csv", "npz", "jsonl"])
    choices = [
        (f"run {model}{tip} --kick 0.05 --until {until} -o a.{kind}", [f"a.{kind}"]),
        (f"run {model}{tip} --kick 0.05 --until {until} -o a.json --plot a.svg", ["a.json", "a.svg"]),
        (f"run {model} --kick 0.05 --until 20000 --sample-every 2 --tolerance 1e-6 --checkpoint ck --checkpoint-every 500 "
         f"-o a.jsonl", ["a.jsonl", "ck"]),
        (f"sweep --r 0.8:1.2:3 --alpha {real(0.5, 1)}:{real(1.2, 2)}:4 --threads {rng.choice([1, 2])} -o a.json", ["a.json"]),
        (f"boundary --r-range {real(0.1, 0.5)}:{real(1, 3)}:60 -o a.{rng.choice(['json', 'csv', 'npz'])}", None),
        (f"raster --tip gaussian {model} --pitch 1 --lines 12 --length 20 -o a.{rng.choice(['json', 'npz'])}", None),
        (f"cycle --r 1 --alpha {real(1.1, 1.7)} -o a.json --plot a.svg", ["a.json", "a.svg"]),
        (f"response --r 1 --alpha {real(0.3, 1)} --pulse 1e-4,30,0.5 --until 60 -o a.csv", ["a.csv"]),
    ]
    line, written = rng.choice(choices)
    return line, written or [line.rsplit(" ", 1)[1]]


class Place:
    """A folder to work in, with a TMPDIR beside it; on a disk of its own if that can be had."""

    def __init__(self, parent, has_disk):
        self.top = pathlib.Path(tempfile.mkdtemp(dir=parent))
        self.has_disk = has_disk
        if has_disk:
            subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "soak", self.top], check=True)
        self.work, self.temporary = self.top / "work", self.top / "tmp"
        self.work.mkdir()
        self.temporary.mkdir()

    def resize(self, size):
        subprocess.run(["mount", "-o", f"remount,size={size}", self.top], check=True)

    def files(self):
        return {p.name: SECONDS.sub(rb"\g<1>0", p.read_bytes()) for p in sorted(self.work.iterdir())}

    def close(self):
        if self.has_disk:
            subprocess.run(["umount", self.top], check=True)
        shutil.rmtree(self.top)


def start(program, line, place, largest=None):
    def limit():
        os.setsid()
        if largest:
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))

    said = tempfile.TemporaryFile()
    child = subprocess.Popen([program, *shlex.split(line)], cwd=place.work, stdin=subprocess.DEVNULL, stdout=said, stderr=said,
                             preexec_fn=limit, env={"PATH": "/usr/bin:/bin", "TMPDIR": str(place.temporary)})
    child.said = said
    return child


def end(child, line):
    """Waits for the end; the status, what was said, and the largest memory."""
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    child.said.seek(0)
    said = child.said.read().decode(errors="replace")
    child.said.close()
    if "panicked" in said:
        raise Violation(f"panic: {said}")
    if used.ru_maxrss << 10 > MEMORY:
        raise Violation(f"{used.ru_maxrss >> 10} MB")
    try:
        os.killpg(child.pid, 0)
    except ProcessLookupError:
        return child.returncode, said
    raise Violation("a process is left")


def allow(status, allowed, said):
    if status not in allowed:
        raise Violation(f"status {status}, not of {sorted(allowed)}: {said[-400:]}")


def disturb(program, line, place, fault, took, size, rng):
    """Runs the command with the fault; whether it ended as one that was interrupted."""
    if fault in ("killed", "interrupted", "terminated"):
        sent = {"killed": signal.SIGKILL, "interrupted": signal.SIGINT, "terminated": signal.SIGTERM}[fault]
        child = start(program, line, place)
        time.sleep(rng.uniform(0, 1.1 * took))
        os.kill(child.pid, sent)  # not yet waited for: the number is its own
        status, said = end(child, line)
        # Before it listens, the signal itself ends it.
        allow(status, {0, -sent, INTERRUPTED.get(sent, 0)}, said)
        return status == INTERRUPTED.get(sent) and line.startswith("run ")
    if fault == "two writers":
        both = [start(program, line, place)]
        time.sleep(rng.uniform(0, 0.5 * took))
        both.append(start(program, line, place))
        ends = [end(child, line) for child in both]
        for status, said in ends:
            allow(status, {0, 1, 2}, said)
        if all(status != 0 for status, _ in ends):
            raise Violation(f"neither of two writers wrote: {ends}")
    else:
        # Some of it fits, or all but the last of it.
        room = int(size * rng.choice([0.1, 0.5, 0.9, 0.99])) + 1
        if fault == "full disk" and place.has_disk:
            place.resize(max(room, 4096))
            status, said = end(start(program, line, place), line)
            place.resize("64m")
        else:
            status, said = end(start(program, line, place, largest=room), line)
        # A limit that the system sets ends a program by a signal.
        allow(status, {0, 1} if fault == "full disk" else {0, 1, -signal.SIGXFSZ}, said)
    return False


def is_cut(name, now, whole):
    """What a run writes that was interrupted: its end says so, and what comes before is that of the whole run."""
    if name.endswith(".json"):
        return json.loads(now)["interrupted"] is True
    if name.endswith(".jsonl"):
        return json.loads(now.splitlines()[-1]).get("interrupted") is True and is_begun(now, whole)
    if name.endswith(".npz"):
        return b"interrupted.npy" in now
    return name.endswith(".svg") or is_begun(now, whole)


def is_begun(now, whole):
    """Whether all lines but the last, at which it was interrupted, are the first ones of another."""
    lines = now.splitlines()
    return lines[:-1] == whole.splitlines()[:len(lines) - 1]


def check_whole(place, judged, written, is_interrupted):
    """Each output is what it was, or the whole of the new one, or that of an interrupted run."""
    for name, now in place.files().items():
        if name not in written or name == "ck":
            continue  # a beginning, under a name of its own
        if now not in (OLD, judged[name]) and not (is_interrupted and is_cut(name, now, judged[name])):
            raise Violation(f"{name} is neither the old nor the new one ({len(now)} of {len(judged[name])} bytes)")


def one(program, rng, parent, has_disk):
    """One command, judged, disturbed, repeated."""
    line, written = commands(rng)
    fault = rng.choice(FAULTS)
    had_before = rng.random() < 0.5
    judge = Place(parent, False)
    place = Place(parent, has_disk and fault == "full disk")
    try:
        begun = time.monotonic()
        status, said = end(start(program, line, judge), line)
        took = time.monotonic() - begun
        if status == 2 or status == 1:
            return line, "refused"  # no cycle there, no mode: nothing to judge
        allow(status, {0}, said)
        judged = judge.files()
        if sorted(judged) != sorted(written):
            raise Violation(f"wrote {sorted(judged)}, not {written}")
        if had_before:
            for name in set(written) - {"ck"}:
                (place.work / name).write_bytes(OLD)
        size = max(len(data) for data in judged.values())
        is_interrupted = disturb(program, line, place, fault, took, size, rng)
        check_whole(place, judged, written, is_interrupted)
        # A run of which there is a checkpoint goes on from there.
        again = "run --resume ck" if (place.work / "ck").exists() else line
        status, said = end(start(program, again, place), again)
        if again != line and status != 0:
            # Finished already, or its beginning is gone: begun anew, as the message says.
            status, said = end(start(program, line, place), line)
        allow(status, {0}, said)
        now = place.files()
        if now.keys() != judged.keys():
            raise Violation(f"left {sorted(now)}, not {sorted(judged)}")
        for name in set(written) - {"ck"}:
            if now[name] != judged[name]:
                raise Violation(f"{name} differs from that of the undisturbed command")
        left = [p.name for p in place.temporary.iterdir()]
        if left:
            raise Violation(f"left in TMPDIR: {left}")
        return line, fault
    except Violation as violation:
        raise Violation(f"{fault}{', over a file' if had_before else ''}: stickslip {line}\n    {violation}") from None
    finally:
        judge.close()
        place.close()


def can_mount(parent):
    folder = tempfile.mkdtemp(dir=parent)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "soak", folder], stderr=subprocess.DEVNULL).returncode == 0
    if mounted:
        subprocess.run(["umount", folder], check=True)
    os.rmdir(folder)
    return mounted


def main():
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("program")
    reader.add_argument("--minutes", type=float, default=30)
    reader.add_argument("--seed", type=int, default=None)
    asked = reader.parse_args()
    program = str(pathlib.Path(asked.program).resolve())
    first = random.randrange(1 << 32) if asked.seed is None else asked.seed
    print(f"seed {first}", flush=True)
    counts, violations, last = collections.Counter(), [], time.monotonic() + 60 * asked.minutes
    with tempfile.TemporaryDirectory() as parent:
        has_disk = can_mount(parent)
        number = first
        while time.monotonic() < last:
            try:
                counts[one(program, random.Random(number), parent, has_disk)[1]] += 1
            except Violation as violation:
                violations.append(violation)
                print(f"seed {number}: {violation}", flush=True)
            number += 1
        left = os.listdir(parent)
    if left:
        violations.append(left)
    disk = "a full tmpfs" if has_disk else "a limit instead of a full disk"
    print(f"{sum(counts.values())} commands ({disk}): " + ", ".join(f"{n} {fault}" for fault, n in counts.most_common()))
    print(f"{len(violations)} violations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
