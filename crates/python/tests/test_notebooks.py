"""The notebooks are executed; what they show is committed, and light enough to read on a forge."""

import json

import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))
NEEDS = {"side_by_side": ["scipy", "jitcdde"], "own_tip": ["pandas"], "fitting": ["pandas"], "phase_diagram": ["xarray", "pandas"]}
# Characters.
HEAVIEST = 400_000


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    for needed in NEEDS.get(path.stem, []):
        pytest.importorskip(needed)
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(tmp_path)}}).execute()


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_committed_with_what_it_shows(path):
    text = path.read_text()
    assert len(text) < HEAVIEST, f"{len(text)} characters"
    cells = json.loads(text)["cells"]
    assert any(cell.get("outputs") for cell in cells)
    shown = [output for cell in cells for output in cell.get("outputs", [])]
    assert not any(output["output_type"] == "error" for output in shown)


def test_each_finding_has_a_notebook():
    chapters = (ROOT / "docs" / "findings" / "README.md").read_text("utf-8").split("\n## ")[1:]
    assert len(chapters) >= 10
    lacking = [chapter.splitlines()[0] for chapter in chapters if not any(f"notebooks/{path.name})" in chapter for path in NOTEBOOKS)]
    assert not lacking


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 12
