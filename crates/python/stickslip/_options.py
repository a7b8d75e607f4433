"""From keyword arguments to what a shell would be given: the options are the program's, by its own telling."""

import inspect
import json
import os
from collections import namedtuple
from numbers import Integral

from . import _native
from ._results import Result

Option = namedtuple("Option", "name is_positional value delimiter is_repeatable help")

# What is printed is for a shell: here the document itself is had.
FOR_A_SHELL = {"print", "format"}


KNOWN: dict = {}


def options(path):
    """The options of a command by their names in Python."""
    if path not in KNOWN:
        told = [Option(*told) for told in _native.options(list(path))]
        KNOWN[path] = {in_python(option.name): option for option in told if option.name not in FOR_A_SHELL}
    return KNOWN[path]


def in_python(name):
    """``from`` is a word of Python: it is ``from_``."""
    name = name.replace("-", "_")
    return name + "_" if name == "from" else name


def signature(path, returns):
    """What a function of this command takes."""
    Parameter = inspect.Parameter
    found = options(path)
    first = [
        Parameter(name, Parameter.VAR_POSITIONAL if option.is_repeatable else Parameter.POSITIONAL_OR_KEYWORD)
        for name, option in found.items()
        if option.is_positional
    ]
    rest = [
        Parameter(name, Parameter.KEYWORD_ONLY, default=None if option.value else False)
        for name, option in found.items()
        if not option.is_positional
    ]
    rest.append(Parameter("progress", Parameter.KEYWORD_ONLY, default=None))
    return inspect.Signature(first + rest, return_annotation=returns)


class Asked:
    """The words of a command, and the files that it finds in memory."""

    def __init__(self, path, given):
        self.words = list(path)
        self.supplies = []
        known = options(path)
        behind = []
        for name, value in given.items():
            if value is None:
                continue
            option = known.get(name)
            if option is None:
                raise TypeError(f"{' '.join(path)}() has no option {name!r}: there are {', '.join(known)}")
            if option.is_positional:
                parts = value if option.is_repeatable else [value]
                behind += [self._file(f"{name}[{i}]" if option.is_repeatable else name, part) for i, part in enumerate(parts)]
            elif option.value is None:
                self._switch(option, name, value)
            else:
                self._option(option, name, value)
        if behind:
            self.words += ["--", *behind]

    def _switch(self, option, name, value):
        if not isinstance(value, (bool, _bool())):
            raise TypeError(f"{name} is True or False, not {value!r}")
        if value:
            self.words.append(f"--{option.name}")

    def _option(self, option, name, value):
        if isinstance(value, bool):
            raise TypeError(f"{name} has a value, {option.value}: {value!r} is none")
        if is_file(option):
            # A list is several, where there may be several; columns are a tuple.
            several = option.is_repeatable and isinstance(value, list)
            files = [self._file(f"{name}[{i}]", part) for i, part in enumerate(value)] if several else [self._file(name, value)]
            self.words += [f"--{option.name}={file}" for file in files]
        elif name == "tip" and not isinstance(value, str):
            # A footprint of one's own.
            self.words.append(f"--tip-file={self._file('tip', value)}")
        else:
            parts = repeated(option, value)
            self.words += [f"--{option.name}={shown(option, part)}" for part in parts]

    def _file(self, name, value):
        """The name of a file, or a name for what is none."""
        if isinstance(value, (str, os.PathLike)):
            return os.fspath(value)
        place = f"<{name}>"
        self.supplies.append((place, supplied(name, value)))
        return place


def is_file(option):
    """Whether its value names a file."""
    return option.value == "FILE" or option.value.endswith((".json", ".csv"))


def repeated(option, value):
    """The values of an option that may be given several times."""
    if option.delimiter or not option.is_repeatable or isinstance(value, str):
        return [value]
    entries = list(value)
    # (A, T, W) is one, [(A, T, W), …] are several.
    return [value] if entries and all(isinstance(entry, (int, float)) for entry in entries) else entries


def shown(option, value):
    """The value as it would be typed; digits are read back to the last bit."""
    if isinstance(value, str):
        return value
    if isinstance(value, range):
        value = list(value)
    if hasattr(value, "__array__") and getattr(value, "ndim", 0) > 0:
        return ",".join(map(number, value.__array__().tolist()))
    if isinstance(value, tuple) and option.delimiter is None:
        kind = option.value
        between = ":" if kind == "RANGE" or ":" in kind else "/" if "/" in kind else ","
        return between.join(map(number, value))
    if isinstance(value, (tuple, list)):
        return ",".join(map(number, value))
    return number(value)


def number(value):
    """Shortest digits of a number; whatever else it is, its own words, for the program to judge."""
    if isinstance(value, (bool, str)):
        return str(value)
    if isinstance(value, Integral):
        return repr(int(value))
    if hasattr(value, "__float__"):
        return repr(float(value))
    return str(value)


def supplied(name, value):
    """What a file would hold: a document, JSON, or columns as CSV."""
    if isinstance(value, Result):
        return value._document
    if isinstance(value, dict):
        return json.dumps(value, default=plain)
    return heading(value) + _native.csv(columns(name, value))


def heading(value):
    """The names of the columns of a DataFrame, where they are words: some commands read units off them."""
    names = list(getattr(value, "columns", [])) if hasattr(value, "to_numpy") else []
    return ",".join(names) + "\n" if names and all(isinstance(name, str) for name in names) else ""


def plain(value):
    """NumPy's values for JSON."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} is no number, text, list or dict")


def columns(name, value):
    """Columns of float64: from arrays of any kind, lists, a table of rows, a pandas Series or DataFrame."""
    import numpy as np

    if hasattr(value, "columns") and hasattr(value, "to_numpy"):
        table = value.to_numpy(dtype=float)
        found = [table[:, i] for i in range(table.shape[1])]
    elif hasattr(value, "index") and hasattr(value, "to_numpy"):
        found = [value.index.to_numpy(), value.to_numpy()]
    elif isinstance(value, np.ndarray) and value.ndim == 2:
        found = list(value.T)
    elif isinstance(value, (tuple, list)):
        found = list(value)
    else:
        raise TypeError(f"{name} is a file, columns such as (x, f), a table, a dict, or a result: {type(value).__name__} is none")
    found = [np.ascontiguousarray(column, dtype=float) for column in found]
    if any(column.ndim != 1 for column in found):
        raise ValueError(f"{name}: columns are one after another, such as (x, f), each of one axis")
    lengths = [len(column) for column in found]
    if len(set(lengths)) > 1:
        raise ValueError(f"{name}: columns have {lengths} rows: as many in each will do")
    return found


def _bool():
    """NumPy's truth values, where there is NumPy already."""
    import sys

    numpy = sys.modules.get("numpy")
    return numpy.bool_ if numpy else bool
