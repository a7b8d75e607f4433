"""What the tests share: the program beside the package, and its documents."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def program():
    """The program as it is built: STICKSLIP names it, or it is the latest in the usual places."""
    named = os.environ.get("STICKSLIP")
    places = [Path(named)] if named else [ROOT / "target" / kind / "stickslip" for kind in ("release", "debug")]
    found = [place for place in places if place.is_file()]
    if not found:
        pytest.fail(f"there is no program in {', '.join(map(str, places))}: build it first")
    return max(found, key=lambda place: place.stat().st_mtime)


@pytest.fixture
def shell(program, tmp_path):
    """Runs a command line in a folder of its own, and reads the document that it writes."""

    def run(line):
        done = subprocess.run([program, *line.split()], cwd=tmp_path, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


def timeless(document):
    """A document but for how long it took."""
    if isinstance(document, dict):
        return {name: timeless(value) for name, value in document.items() if name not in ("seconds", "speedup")}
    if isinstance(document, list):
        return [timeless(value) for value in document]
    return document
