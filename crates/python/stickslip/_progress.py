"""Progress of a computation: a bar, or calls of a function."""

import re
from contextlib import contextmanager


@contextmanager
def told(progress):
    """The function that the program calls during the computation: None, a bar of tqdm, or the function of the caller."""
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        last = [None, ""]

        def report(part, counted):
            last[:] = part, counted
            progress(part, counted)

        yield report
        if last[0] is not None and last[0] < 1:
            # The program reports at intervals; the last report may precede the end.
            progress(1.0, re.sub(r"^\S+ of (\S+)", r"\1 of \1", last[1]))
    else:
        with bar() as shown:
            yield shown


@contextmanager
def bar():
    """A bar of tqdm, for a terminal or a notebook."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ImportError("progress=True needs tqdm: pip install tqdm, or give a function (part, words)") from None
    with tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {postfix} {elapsed}<{remaining}") as shown:

        def show(part, counted):
            if part is not None:
                shown.n = round(100 * part, 1)
            shown.set_postfix_str(counted)

        yield show
        shown.n = 100
        shown.refresh()
