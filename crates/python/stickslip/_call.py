"""Commands of the program in this process."""

import re
import warnings

from . import _native
from ._options import Asked, in_python, options
from ._progress import told
from ._results import result_of
from ._warning import StickslipWarning


def call(path, given, progress):
    """The result of a command; None if the program has written it to a file line by line."""
    asked = Asked(path, given)
    try:
        with told(progress) as tell:
            document, said = _native.call(asked.words, asked.supplies, tell)
    except (ValueError, RuntimeError, KeyboardInterrupt) as error:
        error.args = tuple(in_words_of_python(path, str(said)) for said in error.args)
        if hasattr(error, "document"):
            # The partial result.
            error.result = result_of(error.document)
        raise
    said = [line.removeprefix("stickslip: ") for line in said]
    for line in dict.fromkeys(said + remarks(document)):
        warnings.warn(in_words_of_python(path, line), StickslipWarning, stacklevel=3)
    return None if document is None else result_of(document)


def remarks(document):
    """The remarks of a document."""
    return list(document.field("remarks")) if document is not None and "remarks" in document.names() else []


def run_many(questions, *, progress=None):
    """Several runs at once: for each dict of keyword arguments of :func:`run` a :class:`RunResult`, in the same order.

    Runs of the basic model without noise, profiles and forces are computed side by side, in half of the time or less, as
    ``work.memory_reason`` reports. They are as accurate as those of ``run`` but differ in the last digits; the others are
    equal to those of ``run``. Invalid arguments raise ValueError before the first run begins. If a run fails, the
    RuntimeError has the ``results`` of the others, with None for each that failed. ``output``, ``plot``, ``verify`` and
    checkpoints are not available.

    >>> runs = stickslip.run_many([{"alpha": alpha, "r": 1, "until": 400} for alpha in (0.9, 1.1, 1.2)])
    """
    path = ("run",)
    asked = [Asked(path, dict(given)) for given in questions]
    try:
        with told(progress) as tell:
            runs, said = _native.call_runs([(one.words, one.supplies) for one in asked], tell)
    except (ValueError, RuntimeError, KeyboardInterrupt) as error:
        error.args = tuple(": ".join([number, in_words_of_python(path, why)]) if why else number for number, why in map(apart, error.args))
        raise
    said = [(number, line.removeprefix("stickslip: ")) for number, line in said]
    said += [(number, line) for number, (document, _) in enumerate(runs) for line in remarks(document)]
    for number, line in dict.fromkeys(said):
        line = in_words_of_python(path, line)
        warnings.warn(f"run {number}: {line}", StickslipWarning, stacklevel=2)
    results = [None if document is None else result_of(document) for document, _ in runs]
    failed = [f"run {number}: {in_words_of_python(path, why)}" for number, (_, why) in enumerate(runs) if why is not None]
    if failed:
        failure = RuntimeError("\n".join(failed))
        failure.results = results
        raise failure
    return results


def apart(said):
    """``run 3`` and the message about it."""
    number, _, why = str(said).partition(": ")
    return number, why


MISSING = "the following required arguments were not provided:"


def in_words_of_python(path, said):
    """A message of the program with the names of keywords: ``--depth-limit -1: …`` becomes ``depth_limit=-1: …``."""
    if said.startswith(MISSING):
        names = [named(path, line.strip()) for line in said.removeprefix(MISSING).splitlines() if line.strip()]
        return f"missing: {', '.join(names)}"
    # Data from memory have no file: they are named by their argument.
    said = re.sub(r"(?:--[a-z-]+[ =])?<([a-z_]+(?:\[\d+\])?)>(?:\.gsf)?", r"\1", said)
    known = {option.name for option in options(path).values()}

    def one(found):
        if found["name"] not in known:
            return found[0]
        return in_python(found["name"]) + ("=" if found["between"] else "")

    option = re.compile(r"--(?P<name>[a-z]+(?:-[a-z]+)*)(?: <[^>]*>(?!:))?(?P<between>[ =](?=[^\s:,]+: |[A-Z]\b|\d))?")
    # Commands for a shell stay as they are.
    return "\n".join(line if "stickslip " in line else option.sub(one, line) for line in said.split("\n"))


def named(path, usage):
    """The keywords for ``--until <T>``, ``<--alpha <A>|--alpha-above <D>>`` or ``<RUN.json>``."""
    found = re.findall(r"--([a-z]+(?:-[a-z]+)*)", usage)
    if found:
        return " or ".join(map(in_python, found))
    return next(name for name, option in options(path).items() if option.is_positional)
