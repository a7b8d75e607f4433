"""From keyword arguments to the words of a command line. The program describes its options itself."""

import difflib
import inspect
import json
import os
from collections import namedtuple
from decimal import Decimal
from numbers import Integral, Real

from . import _native, _scans
from ._results import Result

Option = namedtuple("Option", "name is_positional value delimiter is_repeatable help")

# Names of arguments that may be images.
IMAGES = {"measured", "image", "retrace_image", "lateral_image"}

# Those that are nothing else.
ONLY_IMAGES = IMAGES - {"measured"}

# Optional positional arguments.
OPTIONAL = {"retrace"}

# Options for output on a terminal; functions return the document.
FOR_A_SHELL = {"print", "format"}


KNOWN: dict = {}


def options(path):
    """The options of a command by their names in Python."""
    if path not in KNOWN:
        found = [Option(*option) for option in _native.options(list(path))]
        KNOWN[path] = {in_python(option.name): option for option in found if option.name not in FOR_A_SHELL}
    return KNOWN[path]


def in_python(name):
    """The name of an option in Python: ``from`` is a keyword, and becomes ``from_``."""
    name = name.replace("-", "_")
    return name + "_" if name == "from" else name


def signature(path, returns):
    """The signature of the function of a command."""
    Parameter = inspect.Parameter
    found = options(path)
    first = [
        Parameter(name, Parameter.VAR_POSITIONAL)
        if option.is_repeatable
        else Parameter(name, Parameter.POSITIONAL_OR_KEYWORD, default=None if name in OPTIONAL else Parameter.empty)
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
    """The words of a command, and the files from memory."""

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
                near = difflib.get_close_matches(name, known, n=1)
                meant = f"did you mean {near[0]}? " if near else ""
                raise TypeError(f"{' '.join(path)}() has no option {name!r}: {meant}There are {', '.join(known)}")
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
            raise TypeError(f"{name} takes a value, {option.value}, not {value!r}")
        if is_file(option):
            # A list has several files if the option may be repeated; columns are a tuple.
            several = option.is_repeatable and isinstance(value, list)
            files = [self._file(f"{name}[{i}]", part) for i, part in enumerate(value)] if several else [self._file(name, value)]
            self.words += [f"--{option.name}={file}" for file in files]
        elif name == "tip" and not isinstance(value, str):
            # A footprint that has no name.
            self.words.append(f"--tip-file={self._file('tip', value)}")
        else:
            parts = repeated(option, value)
            self.words += [f"--{option.name}={shown(option, part)}" for part in parts]

    def _file(self, name, value):
        """The name of a file, or a made-up name for data from memory."""
        if isinstance(value, (str, os.PathLike)):
            return os.fspath(value)
        if _scans.is_dataset(value) and name != "area":
            value = _scans.heights(name, value)
        if name in ONLY_IMAGES and not _scans.is_array(value):
            example = 'xarray.DataArray(z, dims=("y", "x"), coords={"y": y_nm, "x": x_nm})'
            raise TypeError(f"{name} must be a .gsf file or an image with positions, such as {example}, not {type(value).__name__}")
        is_image = _scans.is_array(value) and value.ndim > 1 and name in IMAGES
        # The program recognises an image by its extension.
        place = f"<{name}>.gsf" if is_image else f"<{name}>"
        self.supplies.append((place, _scans.image_file(name, value) if is_image else supplied(name, value)))
        return place


def is_file(option):
    """Whether its value names a file."""
    return option.value == "FILE" or option.value.endswith((".json", ".csv"))


def repeated(option, value):
    """The values of an option that may be given several times."""
    if option.delimiter or not option.is_repeatable or isinstance(value, str):
        return [value]
    entries = list(value)
    # (A, T, W) is one value, [(A, T, W), …] are several.
    return [value] if entries and all(isinstance(entry, (int, float)) for entry in entries) else entries


def shown(option, value):
    """The value as typed in a shell, with digits that are read back to the same bits."""
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
    """The shortest digits of a number; the text of anything else, which the program judges."""
    if isinstance(value, (bool, str)):
        return str(value)
    if isinstance(value, Integral):
        return repr(int(value))
    unit, amount = getattr(value, "units", None) or getattr(value, "unit", None), getattr(value, "magnitude", getattr(value, "value", None))
    if unit is not None and amount is not None and str(unit) not in ("", "1", "dimensionless"):
        # A quantity (pint, Astropy): `20.0nm`.
        return repr(float(amount)) + (f"{unit:~C}" if hasattr(unit, "dimensionality") else str(unit)).replace(" ", "").replace("**1", "")
    if hasattr(value, "__float__"):
        return repr(float(value))
    return str(value)


def supplied(name, value):
    """The content of a file: a document, JSON, or columns with their headings."""
    if isinstance(value, Result):
        return value._document
    if isinstance(value, dict) and not is_columns(value):
        return json.dumps(value, default=plain)
    headings, columns = scanned(name, value) or table(name, value)
    return list(zip(headings, columns))


def scanned(name, value):
    """Headings and columns of profiles of an image, or of the lines of an area; None of anything else."""
    if _scans.is_dataset(value):
        return _scans.area_columns(name, value)
    arrays = list(value) if isinstance(value, (tuple, list)) else [value]
    if arrays and all(_scans.is_array(array) for array in arrays):
        return _scans.profile_columns(name, arrays)
    return None


def is_columns(value):
    """Whether a dict has a column under each name; a tip has its Gaussians, a document its format."""
    return bool(value) and not {"gaussians", "format"} & value.keys()


def plain(value):
    """A value of NumPy for JSON."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} is no number, text, list or dict")


def table(name, value):
    """Headings, and columns of float64 with NaN where a value is missing: from arrays of any kind, lists, a table of rows,
    a dict of columns, a pandas Series or DataFrame."""
    pairs = named_columns(name, value)
    found = [numbers(f"{name}, column {i + 1}", column) for i, (_, column) in enumerate(pairs)]
    lengths = [len(column) for column in found]
    if len(set(lengths)) > 1:
        raise ValueError(f"{name}: columns have {lengths} rows: all must have the same number")
    return [with_unit(heading, column) for heading, column in pairs], found


def named_columns(name, value):
    """Each column with its name, which may be empty."""
    import numpy as np

    if isinstance(value, dict):
        return [(str(label), column) for label, column in value.items()]
    if hasattr(value, "columns") and hasattr(value, "to_numpy"):
        labels = list(value.columns)
        each = (value.iloc[:, i] if hasattr(value, "iloc") else value[label] for i, label in enumerate(labels))
        return [(label if isinstance(label, str) else "", column) for label, column in zip(labels, each)]
    if hasattr(value, "index") and hasattr(value, "to_numpy"):
        return [(word(value.index.name), value.index), (word(value.name), value)]
    if isinstance(value, np.ndarray) and value.dtype.names:
        return [(label, value[label]) for label in value.dtype.names]
    if isinstance(value, np.ndarray) and value.ndim == 2:
        value = np.asarray(value) if isinstance(value, np.matrix) else value
        return [("", column) for column in value.T]
    if isinstance(value, (tuple, list)):
        return [("", column) for column in value]
    raise TypeError(
        f"{name} must be a file, columns such as (x, f), a table, a dict or a result, not {type(value).__name__}"
    )


def word(label):
    return label if isinstance(label, str) else ""


def with_unit(heading, column):
    """The heading with the unit of a quantity (pint, Astropy) or of an array that has one among its attributes."""
    attributes = getattr(column, "attrs", None)
    attributes = attributes if isinstance(attributes, dict) else {}
    for unit in (getattr(column, "units", None), getattr(column, "unit", None), attributes.get("units")):
        if unit is not None and not callable(unit) and str(unit) not in ("", "1", "dimensionless"):
            return f"{heading} ({unit})"
    return heading


def numbers(name, column):
    """A column as float64, with NaN for masked values, None and NA."""
    import numpy as np

    mask = np.ma.getmaskarray(column) if isinstance(column, np.ma.MaskedArray) else None
    for inner in ("magnitude", "value"):
        # The numbers of a quantity with a unit.
        column = getattr(column, inner, column) if hasattr(column, "unit") or hasattr(column, "units") else column
    try:
        # Without a type: with one, text and complex numbers would be converted.
        values = np.asarray(column.to_numpy() if hasattr(column, "to_numpy") else column)
    except ValueError as error:
        raise ValueError(f"{name}: no column of numbers: {error}") from None
    if values.ndim != 1:
        raise ValueError(f"{name}: a column has one axis; give several as (x, f)")
    if values.dtype.kind == "O":
        values = np.array([number_or_nan(name, value) for value in values], dtype=float)
    elif values.dtype.kind not in "iuf":
        raise TypeError(f"{name}: {values.dtype} is no type of real numbers")
    values = values.astype(float)
    if mask is not None:
        values[mask] = np.nan
    return np.ascontiguousarray(values)


def number_or_nan(name, value):
    """A real number among objects; NaN for None, NaN, NA and masked values."""
    import numpy as np

    if value is None or value is np.ma.masked or type(value).__name__ in ("NAType", "NaTType"):
        return float("nan")
    if isinstance(value, (Real, Decimal)) and not isinstance(value, bool):
        return float(value)
    raise TypeError(f"{name}: {value!r} is no real number")


def _bool():
    """The type of truth values of NumPy if it is imported, else ``bool``."""
    import sys

    numpy = sys.modules.get("numpy")
    return numpy.bool_ if numpy else bool
