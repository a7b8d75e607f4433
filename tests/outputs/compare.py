#!/usr/bin/env python3
"""Do two builds of stickslip write the same bytes?

    tests/outputs/compare.py OLD NEW [COMMANDS]

Runs every line of commands.txt with both programs, each in a folder of its own, and compares what they print and
each file that they write. Times (`seconds`) may differ, and pictures are not compared. JSON that differs is taken
apart: the fields that only one side has, and those whose value differs, are named. The exit status is 1 if
anything differs, so that a documented change can be told from one that nobody meant.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).parent
SECONDS = re.compile(rb'"([a-z_]*seconds|speedup)":[-+.0-9eE]+')

INPUTS = {
    "surface.csv": "x,u\n" + "".join(f"{x},{0.02 * (x % 3) - 0.02}\n" for x in range(20, 60)),
    "force.csv": "t,force\n20,0\n30,0.1\n40,-0.1\n50,0\n",
    "table.csv": "x,f\n" + "".join(f"{x / 8},{(1 + x * x / 128) ** -4 if x < 64 else 0}\n" for x in range(65)),
    "tip.json": '{"gaussians":[{"amplitude":1,"center":0,"width":1},{"amplitude":-0.3,"center":2,"width":0.8},'
    '{"amplitude":-0.3,"center":-2,"width":0.8}]}\n',
}


def run(program, line, folder):
    words = [program, *shlex.split(line)]
    return subprocess.run(words, cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, timeout=600)


def files(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def members(data):
    with tempfile.NamedTemporaryFile() as file:
        file.write(data)
        file.flush()
        with zipfile.ZipFile(file.name) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


def leaves(value, at=""):
    if isinstance(value, dict):
        return {k: v for key, inner in value.items() for k, v in leaves(inner, f"{at}.{key}").items()}
    if isinstance(value, list) and any(isinstance(v, dict) for v in value):
        return {k: v for i, inner in enumerate(value) for k, v in leaves(inner, f"{at}[{i}]").items()}
    return {at: value}


def difference(old, new):
    """What differs between two outputs, in words; None if nothing does."""
    old, new = SECONDS.sub(b"", old), SECONDS.sub(b"", new)
    if old == new:
        return None
    if old[:2] == b"PK" and new[:2] == b"PK":
        old, new = members(old), members(new)
        names = [n for n in old.keys() | new.keys() if old.get(n) != new.get(n)]
        return f"arrays {', '.join(sorted(names))}" if names else None
    try:
        # Not `loads` of what is left: with the times their commas are gone.
        old, new = (leaves(json.loads(re.sub(rb",(?=[}\]])|(?<=[{\[]),|,(?=,)", b"", d))) for d in (old, new))
    except ValueError:
        return "bytes"
    plain = lambda field: re.sub(r"\[\d+\]", "[]", field)
    gone = {plain(k) for k in old.keys() - new.keys()}
    come = {plain(k) for k in new.keys() - old.keys()}
    changed = {plain(k) for k in old.keys() & new.keys() if old[k] != new[k]}
    told = [f"{what} {', '.join(sorted(which))}" for what, which in
            (("without", gone), ("with", come), ("changed", changed)) if which]
    return "; ".join(told) or "order of fields"


def main():
    old, new = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:3])
    lines = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else HERE / "commands.txt").read_text().splitlines()
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    different = 0
    with tempfile.TemporaryDirectory() as folder:
        places = [pathlib.Path(folder, side) for side in ("old", "new")]
        for place in places:
            place.mkdir()
            for name, text in INPUTS.items():
                (place / name).write_text(text)
        for line in lines:
            before = [files(place) for place in places]
            outputs = [run(program, line, place) for program, place in zip((old, new), places)]
            told = []
            if outputs[0].returncode != outputs[1].returncode:
                told.append(f"status {outputs[0].returncode}, now {outputs[1].returncode}: "
                            + outputs[1].stderr.decode(errors="replace").strip()[:200])
            printed = difference(*(o.stdout for o in outputs))
            told += [f"printed: {printed}"] if printed else []
            a, b = map(files, places)
            written = [name for name in sorted(a.keys() | b.keys())
                       if (a.get(name), b.get(name)) != (before[0].get(name), before[1].get(name))]
            for name in written:
                if not name.endswith((".svg", ".png", ".pdf")):
                    what = difference(a.get(name, b""), b.get(name, b""))
                    told += [f"{name}: {what}"] if what else []
            if told:
                different += 1
                print(f"{line}\n    " + "\n    ".join(told))
    print(f"{len(lines) - different} of {len(lines)} command lines give the same bytes")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
