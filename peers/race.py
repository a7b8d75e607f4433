"""Runs all contestants, one after the other, and writes one JSON document and one table.

Needs only the standard library itself: the contestants in Python run in an environment of their own,
made outside of the source tree from requirements.txt, and those in Rust are one example of the project.
"""

import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
CACHE = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
ENVIRONMENT = Path(os.environ.get("PEERS_VENV", CACHE / "stickslip-peers"))
OURS = ("closed, modes", "closed, fft", "closed, direct")


def printed(*command, folder=ROOT):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, cwd=folder).stdout


def python():
    """The interpreter of the contestants, with all that they need."""
    interpreter = ENVIRONMENT / "bin" / "python"
    if not interpreter.exists():
        venv.create(ENVIRONMENT, with_pip=True)
    requirements = HERE / "requirements.txt"
    printed(interpreter, "-m", "pip", "install", "--quiet", "--requirement", requirements)
    return interpreter


def rust():
    """The example with the contestants in Rust."""
    cargo = os.environ.get("CARGO", "cargo")
    build = [cargo, "build", "--release", "--locked", "--example", "race"]
    lines = printed(*build, "--message-format", "json").splitlines()
    built = [json.loads(line).get("executable") for line in lines]
    return next(path for path in reversed(built) if path)


def machine():
    """What the figures depend on beside the programs."""
    with open("/proc/cpuinfo") as file:
        models = {line.split(":", 1)[1].strip() for line in file if line.startswith("model name")}
    return {
        "cpu": ", ".join(sorted(models)),
        "cores": os.cpu_count(),
        "os": platform.freedesktop_os_release()["PRETTY_NAME"],
        "load": round(os.getloadavg()[0], 2),
    }


def versions(interpreter):
    pinned = printed(interpreter, "-m", "pip", "freeze").split()
    crate = next(
        line.split()[1].lstrip("v")
        for line in printed("cargo", "tree", "--locked", "--package", "stickslip-grid", "--prefix", "none").splitlines()
        if line.startswith("differential-equations ")
    )
    return {
        "stickslip": printed("git", "describe", "--always", "--dirty").strip(),
        "rustc": printed("rustc", "--version").split()[1],
        "python": printed(interpreter, "--version").split()[1],
        "differential-equations": crate,
        **dict(line.split("==") for line in pinned if "==" in line),
    }


def with_ratios(rows):
    """Each row beside the fastest of ours that errs no more."""
    contestants = list(dict.fromkeys(row["contestant"] for row in rows))
    rows = sorted(rows, key=lambda row: contestants.index(row["contestant"]))
    windowed = {row["setting"].split(",")[0]: row["error"] for row in rows if "(b)" in row["contestant"]}
    ours = [row for row in rows if row["contestant"] in OURS]
    for row in rows:
        if row["error"] is None:
            row["error"] = windowed[row["setting"].split(",")[0]]
        match = [our for our in ours if our["error"] <= row["error"]]
        best = min(match, key=lambda our: our["seconds"], default=None)
        row["closed"] = best and f"{best['contestant'].split()[1]}, {best['setting']}"
        row["ratio"] = best and row["seconds"] / best["seconds"]
    return rows


MATCHED = 1e-5


def at_matched_error(rows):
    """The fastest setting of each contestant that errs no more than MATCHED, beside the fastest of ours."""
    able = [row for row in rows if row["error"] <= MATCHED]
    fastest = {}
    for row in sorted(able, key=lambda row: row["seconds"], reverse=True):
        fastest[row["contestant"]] = row
    best = min(fastest[name]["seconds"] for name in OURS)
    columns = ("contestant", "setting", "seconds", "error")
    kept = sorted(fastest.values(), key=lambda row: row["seconds"])
    return [{**{c: row[c] for c in columns}, "ratio": row["seconds"] / best} for row in kept]


def embedded(ours, theirs):
    """Of each motion and error: the fastest of ours that errs no more, of an ensemble each way, beside the fastest of theirs."""
    found = []
    for row in theirs:
        able = [our for our in ours if our["motion"].split(",")[0] == row["motion"] and our["error"] <= row["target"]]
        for motion in dict.fromkeys(our["motion"] for our in able):
            our = min((our for our in able if our["motion"] == motion), key=lambda our: our["seconds"])
            found.append({**row, "motion": motion, "ours": our, "ratio": row["seconds"] / our["seconds"]})
    return found


def embedded_table(rows):
    """Those who know the embedding."""
    lines = [
        "## With the embedding known",
        "",
        "heyoka gets the exponentials that we fit, as the system z' = 1 + s x0' z written so that it computes least (`shared`,",
        "`folded`: see `peers/heyoka_race.py`): the fastest setting of each that errs no more than asked, by our fits about that",
        "error and tolerances of half a decade, ours of a quarter; set off by a kick, to the same end. The ensemble has 256 values of",
        "alpha from 1.1 to 1.3; its error is the largest of l where the motions end. heyoka takes as many at a time as the lanes it",
        "recommends, or twice as many, whichever is faster; ours go one by one, or side by side in eight lanes.",
        "",
        "| motion | error | heyoka | time (s) | compiling (s) | ours | time (s) | ratio |",
        "|---|---:|---|---:|---:|---|---:|---:|",
    ]
    for row in rows:
        ours = row["ours"]
        lines.append(
            f"| {row['motion']} | {row['target']:.0e} | {row['setting']} | {row['seconds']:.2e} | {row['compiling']:.2f} "
            f"| {ours['setting']} | {ours['seconds']:.2e} | {row['ratio']:.2f} |"
        )
    return lines + [""]


def table(document):
    """Of each contestant the settings that no other of its own beats in both time and error."""
    rows = document["rows"]
    matched = [
        f"| {row['contestant']} | {row['setting']} | {row['seconds']:.2e} | {row['error']:.1e} "
        f"| {row['ratio']:.3g} |"
        for row in document["at_matched_error"]
    ]

    def beaten(row):
        return any(
            other["seconds"] <= row["seconds"] and other["error"] <= row["error"] and other is not row
            for other in rows
            if other["contestant"] == row["contestant"]
        )

    machine, case = document["machine"], document["case"]
    lines = [
        "# The race",
        "",
        f"{document['date']}, {machine['cpu']}, {machine['cores']} cores, {machine['os']}, load "
        f"{machine['load']} at the start; "
        + ", ".join(f"{name} {version}" for name, version in document["versions"].items())
        + ". Written by `make peers`.",
        "",
        f"{case['tip']}, r = {case['r']:g}, alpha = {case['alpha']:.12g}, steady start at x0 = "
        f"{case['start_position']:g}, an impulse of 0.01 about t = {case['pulse']['time']:g}, from t = "
        f"{case['start']:.3f} to {case['until']:g}. Error: the largest of l against the closed equation "
        f"with the direct memory at 1e-12, which the fft memory confirms to {document['checked_to']:.0e}. "
        "Every contestant runs on one core. A time is the shortest of several or, if that is less, the "
        "processor's, so that other work on the machine does not count.",
        "",
        f"## At an error of {MATCHED:g} or less",
        "",
        "The fastest setting of each contestant, and its time over that of the fastest of all.",
        "",
        "| contestant | setting | time (s) | error | ratio |",
        "|---|---|---:|---:|---:|",
        *matched,
        "",
        *embedded_table(document.get("embedded", [])),
        "## All",
        "",
        "Ratio: to the fastest run of the closed equation that errs no more, named before it. Settings "
        "that another of the same contestant beats in time and error are in `peers.json` only.",
        "",
        "| contestant | setting | time (s) | error | closed equation | ratio |",
        "|---|---|---:|---:|---|---:|",
    ]
    for row in rows:
        if not beaten(row):
            ratio = f"{row['ratio']:.3g}" if row["ratio"] else "none as accurate"
            lines.append(
                f"| {row['contestant']} | {row['setting']} | {row['seconds']:.2e} | {row['error']:.1e} "
                f"| {row['closed'] or ''} | {ratio} |"
            )
    remarks = sorted({f"- {row['contestant']}: {row['remark']}." for row in rows if row["remark"]})
    return "\n".join(lines + ["", *remarks, ""])


def main():
    folder = Path(sys.argv[1])
    if folder.resolve() == ROOT / "data" and printed("git", "status", "--porcelain", "--untracked-files=no"):
        sys.exit("the tree has changes that no commit names: commit them, or write to another folder than data")
    interpreter, race = python(), rust()
    before, raced = machine(), versions(interpreter)
    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch) / "case.json"
        case.write_text(printed(race, "reference"))
        rows = json.loads(printed(race, "rows"))
        for script in ("jitcdde_race.py", "scipy_race.py"):
            # Away from our pyproject.toml, which JiTCDDE would take as that of what it compiles.
            rows += json.loads(printed(interpreter, HERE / script, case, folder=scratch))
        given = json.loads(case.read_text())
        motions = Path(scratch) / "motions.json"
        motions.write_text(printed(race, "embedded"))
        theirs = json.loads(printed(interpreter, HERE / "heyoka_race.py", motions))
        known = embedded(json.loads(printed(race, "embedded-rows")), theirs)
    rows = with_ratios(rows)
    document = {
        "date": datetime.date.today().isoformat(),
        "machine": before,
        "versions": raced,
        "case": given["case"],
        "checked_to": given["reference"]["checked_to"],
        "at_matched_error": at_matched_error(rows),
        "embedded": known,
        "rows": rows,
    }
    (folder / "peers.json").write_text(json.dumps(document, indent=1) + "\n")
    (folder / "peers.md").write_text(table(document))
    print(table(document))


if __name__ == "__main__":
    main()
