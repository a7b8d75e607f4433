#!/usr/bin/env python3
"""Do two builds of stickslip write the same bytes, but for what was meant?

    tests/outputs/compare.py OLD NEW [COMMANDS [CHANGES]]

Runs every line of commands.txt with both programs, each in a folder of its own, and compares what they print and
each file that they write. Times (`seconds`) and the commit of a build may differ, and pictures are not compared. What differs is taken apart:
JSON into its fields, JSON Lines, CSV and NumPy archives into their columns; numbers by how much. changes.txt says
which change explains which of it, and lets nothing else pass: the exit status is 1 if anything is left.
"""

import ast
import collections
import csv
import io
import json
import math
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).parent
MEASURED = HERE.parent.parent / "examples" / "measured"
OF_A_BUILD = re.compile(r"(seconds|speedup|software\.(commit|clean|version))$")

INPUTS = {
    "surface.csv": "x,u\n" + "".join(f"{x},{0.02 * (x % 3) - 0.02}\n" for x in range(20, 60)),
    "force.csv": "t,force\n20,0\n30,0.1\n40,-0.1\n50,0\n",
    "table.csv": "x,f\n" + "".join(f"{x / 8},{(1 + x * x / 128) ** -4 if x < 64 else 0}\n" for x in range(65)),
    "tip.json": '{"gaussians":[{"amplitude":1,"center":0,"width":1},{"amplitude":-0.3,"center":2,"width":0.8},'
    '{"amplitude":-0.3,"center":-2,"width":0.8}]}\n',
    **{name: (MEASURED / name).read_text() for name in ("pit.csv", "ripples.csv")},
}

# One thing that differs: the command line, the file (or "printed"), what of it (a field, a column; "status"), how
# ("without" and "with": only one side has it; "changed"), and of numbers by how much, over the largest of them.
Difference = collections.namedtuple("Difference", "line file field how size")


class Change:
    """A documented change: the differences that it explains."""

    def __init__(self, text):
        head, *rules = text.splitlines()
        self.cause, self.seen, self.lines, self.largest = head.strip(), 0, set(), 0.0
        self.rules = []
        for rule in rules:
            words = rule.split()
            within = float(words.pop().removeprefix("within=")) if words[-1].startswith("within=") else None
            how, where, field = words
            self.rules.append((how, re.compile(where), re.compile(field), within))

    def explains(self, d):
        for how, where, field, within in self.rules:
            small = within is None or (d.size is not None and d.size <= within)
            if how in ("any", d.how) and where.search(f"{d.line} > {d.file}") and field.fullmatch(d.field) and small:
                self.seen += 1
                self.lines.add(d.line)
                self.largest = max(self.largest, d.size or 0.0)
                return True
        return False


def changes(path):
    text = "\n".join(line for line in path.read_text().splitlines() if not line.startswith("#"))
    return [Change(part) for part in re.split(r"\n\s*\n", text.strip()) if part.strip()]


def run(program, line, folder):
    words = [program, *shlex.split(line)]
    return subprocess.run(words, cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, timeout=600)


def files(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def leaves(value, at=""):
    """The fields of a JSON value, each with all that it holds; entries of a list of objects are one field."""
    found = collections.defaultdict(list)
    if isinstance(value, dict):
        for key, inner in value.items():
            for name, values in leaves(inner, f"{at}.{key}" if at else key).items():
                found[name] += values
    elif isinstance(value, list) and any(isinstance(v, dict) for v in value):
        for inner in value:
            for name, values in leaves(inner, f"{at}[]").items():
                found[name] += values
    elif isinstance(value, list):
        found[at] += value
    else:
        found[at].append(value)
    return found


def array(data):
    """A .npy as a list of numbers, or as its bytes."""
    length = struct.unpack("<H", data[8:10])[0]
    header = ast.literal_eval(data[10:10 + length].decode())
    kind = {"<f8": "d", "|u1": "B", "<i8": "q", "<u8": "Q"}.get(header["descr"])
    body = data[10 + length:]
    if kind is None:
        return [body]
    return [v[0] for v in struct.iter_unpack(f"<{kind}", body)]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text or None


def parts(name, data):
    """What is in an output, by name; None for what is not known."""
    if data[:2] == b"PK":
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return {n.removesuffix(".npy"): array(archive.read(n)) for n in archive.namelist()}
    text = data.decode(errors="replace")
    if name.endswith(".csv"):
        rows = list(csv.reader(io.StringIO(text)))
        columns = zip(*rows) if rows else []
        return {column[0]: [number(v) for v in column[1:]] for column in columns}
    if name.endswith(".jsonl"):
        return leaves([json.loads(line) for line in text.splitlines()], "line")
    try:
        return leaves(json.loads(text))
    except ValueError:
        return None


def size(old, new):
    """The largest difference of two lists of numbers, over the largest number; None where they are not."""
    if len(old) != len(new):
        return None
    largest, scale = 0.0, 0.0
    for a, b in zip(old, new):
        if a == b or (a != a and b != b):
            continue
        if not all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in (a, b)):
            return None
        if not (math.isfinite(a) and math.isfinite(b)):
            return None
        largest = max(largest, abs(a - b))
    scale = max((abs(v) for v in old + new if isinstance(v, (int, float)) and math.isfinite(v)), default=0.0)
    return largest / scale if scale else 0.0


def differences(line, name, old, new):
    if old == new:
        return
    a, b = parts(name, old), parts(name, new)
    if a is None or b is None:
        yield Difference(line, name, "bytes", "changed", None)
        return
    for field in dict.fromkeys([*a, *b]):
        if OF_A_BUILD.search(field):
            continue
        if field not in a or field not in b:
            yield Difference(line, name, field, "without" if field in a else "with", None)
        # By what is printed of them: -0 is not 0.
        elif [repr(v) for v in a[field]] != [repr(v) for v in b[field]]:
            yield Difference(line, name, field, "changed", size(a[field], b[field]))


def compared(line, programs, places):
    before = [files(place) for place in places]
    outputs = [run(program, line, place) for program, place in zip(programs, places)]
    if outputs[0].returncode != outputs[1].returncode:
        yield Difference(line, "status", f"{outputs[0].returncode}, now {outputs[1].returncode}", "changed", None)
    yield from differences(line, "printed", *(o.stdout for o in outputs))
    a, b = map(files, places)
    for name in sorted(a.keys() | b.keys()):
        is_new = (a.get(name), b.get(name)) != (before[0].get(name), before[1].get(name))
        if is_new and not name.endswith((".svg", ".png", ".pdf")):
            yield from differences(line, name, a.get(name, b""), b.get(name, b""))


def main():
    programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:3]]
    commands = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else HERE / "commands.txt")
    known = changes(pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else HERE / "changes.txt"))
    lines = [line for line in commands.read_text().splitlines() if line.strip() and not line.startswith("#")]
    same, left = 0, []
    with tempfile.TemporaryDirectory() as folder:
        places = [pathlib.Path(folder, side) for side in ("old", "new")]
        for place in places:
            place.mkdir()
            for name, text in INPUTS.items():
                (place / name).write_text(text)
        for line in lines:
            found = list(compared(line, programs, places))
            same += not found
            left += [d for d in found if not any([change.explains(d) for change in known])]
    for line in dict.fromkeys(d.line for d in left):
        print(line)
        for d in (d for d in left if d.line == line):
            print(f"    {d.file}: {d.field} {d.how}" + (f" by {d.size:.1e}" if d.size is not None else ""))
    unexplained = len({d.line for d in left})
    print(f"{len(lines)} command lines: {same} the same bytes, {len(lines) - same - unexplained} the same but for:")
    for change in known:
        most = f", by at most {change.largest:.1e}" if change.largest else ""
        print(f"  {len(change.lines):3} {change.cause}{most}" if change.seen else f"    - {change.cause}: not seen")
    print(f"{unexplained} that nothing explains")
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
