"""Input of commands from images: a Dataset of :func:`stickslip.open`, a channel or a profile of it (xarray)."""

import warnings

from ._instruments._scan import si
from ._warning import StickslipWarning

# Names of heights, best first.
HEIGHTS = ("height", "topography", "z", "height sensor", "zsensor", "measuredheight")


def is_array(value):
    """Whether a value is a DataArray."""
    return type(value).__module__.startswith("xarray.") and hasattr(value, "coords") and hasattr(value, "name")


def is_dataset(value):
    """Whether a value is a Dataset."""
    return type(value).__module__.startswith("xarray.") and hasattr(value, "data_vars")


def heights(name, dataset):
    """The channel with the heights of a Dataset; a warning if there are several."""
    lengths = {key: array for key, array in dataset.data_vars.items() if si(str(array.attrs.get("units", "")))[0] == "m"}
    if not lengths:
        raise ValueError(f"{name}: no channel is a length: there are {', '.join(map(str, dataset.data_vars))}")

    def rank(key):
        word = str(key).lower()
        return HEIGHTS.index(word) if word in HEIGHTS else len(HEIGHTS)

    chosen = min(lengths, key=rank)
    if len(lengths) > 1:
        rest = ", ".join(str(key) for key in lengths if key != chosen)
        message = f'{name}: the channel "{chosen}" is used; others are {rest}: choose by scan["{chosen}"]'
        warnings.warn(message, StickslipWarning, stacklevel=6)
    return lengths[chosen]


def in_nanometres(array):
    """Values with their unit: lengths in nm, others unchanged."""
    import numpy as np

    unit, one = si(str(array.attrs.get("units", "")))
    values = np.asarray(array.values, float)
    return (values * (1e9 * one), "nm") if unit == "m" else (values, str(array.attrs.get("units", "")))


def profile_columns(name, arrays):
    """Headings and columns of profiles over the same positions: the positions, then the values of each profile."""
    import numpy as np

    first = arrays[0]
    if any(array.ndim != 1 for array in arrays):
        shape = " × ".join(str(n) for n in first.shape)
        raise ValueError(f'{name}: an image ({shape}): take one of its lines, such as scan["Height"].isel(y=10)')
    over = first.dims[0]
    if over not in first.coords:
        raise ValueError(f"{name}: has no positions along {over}")
    if any(array.dims != first.dims or not np.array_equal(array[over], first[over]) for array in arrays):
        raise ValueError(f"{name}: the profiles are not over the same positions")
    pairs = [(str(over), in_nanometres(first[over]))]
    pairs += [(str(array.name or f"value {i + 1}"), in_nanometres(array)) for i, array in enumerate(arrays)]
    return [f"{label} ({unit})" if unit else label for label, (_, unit) in pairs], [values for _, (values, _) in pairs]


def image_file(name, array):
    """The bytes of a .gsf file with an image."""
    from ._instruments.simple_field import bytes_of

    if array.ndim != 2:
        raise ValueError(f"{name}: {array.ndim} dimensions: an image has two, a profile has one")
    if set(array.dims) == {"x", "y"}:
        array = array.transpose("y", "x")
    down, along = array.dims
    positions = []
    for over in (along, down):
        if over not in array.coords:
            raise ValueError(f"{name}: has no positions along {over}")
        if not is_even(array[over].values):
            raise ValueError(f"{name}: positions along {over} are not evenly spaced: interpolate the image to even ones")
        unit, one = si(str(array[over].attrs.get("units", "")))
        positions.append((array[over].values * one, unit if unit == "m" else ""))
    (x, unit), (y, _) = positions
    height, one = si(str(array.attrs.get("units", "")))
    return bytes_of(x, y, array.values * one, unit, height)


def is_even(positions):
    """Whether positions have equal distances, to a hundredth."""
    import numpy as np

    steps = np.diff(positions)
    mean = steps.mean() if len(steps) else 1.0
    return bool(mean) and bool(np.all(np.abs(steps - mean) <= 0.01 * abs(mean)))


def area_columns(name, dataset):
    """Columns y, start and length of each line, in nm, in the order of the rows."""
    import numpy as np

    x, y = (dataset[over].values for over in ("x", "y"))
    if len(x) < 2 or len(y) < 2:
        raise ValueError(f"{name}: {len(x)} × {len(y)} pixels: not an area")
    width = 1e9 * float(x[-1] - x[0]) * len(x) / (len(x) - 1)
    lines = 1e9 * (y - y[0])
    return ["y (nm)", "start (nm)", "length (nm)"], [lines, np.zeros(len(y)), np.full(len(y), width)]
