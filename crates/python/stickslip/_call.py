"""A command of the program, carried out here."""

import warnings

from . import _native
from ._options import Asked
from ._progress import told
from ._results import result_of
from ._warning import StickslipWarning


def call(path, given, progress):
    """The result of a command; None where the program has written it to a file line by line."""
    asked = Asked(path, given)
    try:
        with told(progress) as tell:
            document, said = _native.call(asked.words, asked.supplies, tell)
    except (ValueError, RuntimeError, KeyboardInterrupt) as error:
        if hasattr(error, "document"):
            # What was computed until then.
            error.result = result_of(error.document)
        raise
    for line in said:
        warnings.warn(line.removeprefix("stickslip: "), StickslipWarning, stacklevel=3)
    return None if document is None else result_of(document)
