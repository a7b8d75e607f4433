"""The common form of all files: channels on grids, and the scan parameters of the header."""

import warnings
from collections import namedtuple

from .._warning import StickslipWarning

# values: rows over y, in `unit`; x, y: positions in m; scan: "trace", "retrace" or None.
Channel = namedtuple("Channel", "name unit scan values x y")
# attributes: those of the Dataset; positive: the direction of increasing y, "up" or "down".
Scan = namedtuple("Scan", "channels attributes positive")

PREFIXES = {"f": 1e-15, "p": 1e-12, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "~": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6, "G": 1e9}
BASES = ("m", "N", "V", "A", "Hz", "s", "W", "Pa", "deg", "rad", "°")


def si(unit):
    """A unit as a base unit and the factor to it: nm is ("m", 1e-9). Unknown units are unchanged."""
    unit = unit.strip()
    if unit in BASES or unit[:1] not in PREFIXES or unit[1:] not in BASES:
        return {"Å": ("m", 1e-10), "º": ("deg", 1.0), "°": ("deg", 1.0)}.get(unit, (unit, 1.0))
    return unit[1:], PREFIXES[unit[0]]


def centres(count, extent, offset=0.0):
    """Centres of pixels that divide an extent evenly."""
    import numpy as np

    return offset + extent / count * (np.arange(count) + 0.5)


def evenly_scanned(lines, height, width, line_rate=None, velocity=None):
    """Attributes for the lines of a scan: their distance, and the velocity along them. A period of the line
    rate contains trace and retrace."""
    found = {"pitch_m": height / lines}
    if line_rate:
        found["line_rate_Hz"] = line_rate
        found["velocity_m_per_s"] = velocity or 2.0 * width * line_rate
    elif velocity:
        found["velocity_m_per_s"] = velocity
    return found


def number(text):
    """The first number of a text; None if it does not begin with one."""
    try:
        return float(str(text).split()[0])
    except (ValueError, IndexError):
        return None


def dataset_of(path, scan, wanted):
    """The channels as variables of a Dataset: all on the grid of the first one."""
    import numpy as np
    import xarray

    named = list(zip(variable_names(scan.channels), scan.channels))
    if wanted is not None:
        named = [(name, channel) for name, channel in named if wanted in (name, channel.name)]
    if not named:
        there = ", ".join(variable_names(scan.channels)) or "none"
        raise ValueError(f"{path}: no channel {wanted!r}: there are {there}" if wanted else f"{path}: contains no image")
    first = named[0][1]
    kept = [(name, c) for name, c in named if np.array_equal(c.x, first.x) and np.array_equal(c.y, first.y)]
    if len(kept) < len(named):
        left = ", ".join(sorted({name for name, _ in named} - {name for name, _ in kept}))
        message = f"{path}: {left} have another size than {named[0][0]}: open them by channel="
        warnings.warn(message, StickslipWarning, stacklevel=3)
    variables = {}
    for name, channel in kept:
        attributes = {"units": channel.unit, "scan": channel.scan, "long_name": channel.name}
        attributes = {key: value for key, value in attributes.items() if value}
        variables[name] = (("y", "x"), np.ascontiguousarray(channel.values, dtype=float), attributes)
    over = {
        "x": ("x", first.x, {"units": "m"}),
        "y": ("y", first.y, {"units": "m", "positive": scan.positive}),
    }
    return xarray.Dataset(variables, coords=over, attrs=scan.attributes)


def variable_names(channels):
    """A unique name for each channel: its own, with "retrace" and a number if necessary."""
    ways = {}
    for channel in channels:
        ways.setdefault(channel.name, set()).add(channel.scan)
    names = []
    for channel in channels:
        name = channel.name or "channel"
        if channel.scan == "retrace" and len(ways[channel.name]) > 1:
            name += " retrace"
        free, count = name, 1
        while free in names:
            count += 1
            free = f"{name} {count}"
        names.append(free)
    return names
