"""Who is told how far the work has come."""

import re
from contextlib import contextmanager


@contextmanager
def told(progress):
    """What the program calls as it goes on: nothing, a bar of tqdm, or the caller's own function."""
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        last = [None, ""]

        def tell(part, counted):
            last[:] = part, counted
            progress(part, counted)

        yield tell
        if last[0] is not None and last[0] < 1:
            # The program counts at intervals: what is done is done.
            progress(1.0, re.sub(r"^\S+ of (\S+)", r"\1 of \1", last[1]))
    else:
        with bar() as shown:
            yield shown


@contextmanager
def bar():
    """A bar, in a notebook one of its own kind."""
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
