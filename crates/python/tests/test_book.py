"""The Python of the book runs in the order of its pages, and prints what they show."""

import contextlib
import io
import re

import pytest
from conftest import ROOT

BLOCKS = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", re.DOTALL)
PAGES = [page for page in [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))] if BLOCKS.search(page.read_text("utf-8"))]


def consists_of(printed, shown):
    """Whether a text consists of the parts shown; "…" stands for anything."""
    return re.fullmatch(".*?".join(map(re.escape, shown.split("…"))), printed, re.DOTALL) is not None


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_prints_what_it_shows(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    names = {}
    for code, shown in BLOCKS.findall(page.read_text("utf-8")):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, str(page), "exec"), names)
        if shown:
            assert consists_of(printed.getvalue(), shown), printed.getvalue()


def test_there_are_pages():
    assert len(PAGES) >= 2


def test_a_wrong_page_is_found():
    assert consists_of("a 1.25\nb\n", "a 1.2…\nb\n")
    assert not consists_of("a 1.25\nb\n", "a 1.3…\nb\n")
