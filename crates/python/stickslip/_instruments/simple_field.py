"""Gwyddion Simple Field, .gsf: a text header and single-precision pixels.

<http://gwyddion.net/documentation/user-guide-en/gsf.html>
"""

import numpy as np

from ._scan import Channel, Scan, centres, evenly_scanned, si

MAGIC = b"Gwyddion Simple Field 1.0\n"


def read(path):
    with open(path, "rb") as file:
        content = file.read()
    end = content.find(b"\0")
    if not content.startswith(MAGIC) or end < 0:
        raise ValueError("not a Gwyddion Simple Field")
    lines = content[len(MAGIC) : end].decode("utf-8", "replace").splitlines()
    header = {key.strip(): value.strip() for key, _, value in (line.partition("=") for line in lines)}
    try:
        columns, rows = int(header["XRes"]), int(header["YRes"])
    except (KeyError, ValueError):
        raise ValueError("XRes or YRes is missing, or not an integer") from None
    data = content[(end // 4 + 1) * 4 :]
    if len(data) != 4 * columns * rows:
        raise ValueError(f"{len(data)} bytes of pixels for {columns} × {rows} of four")
    _, one = si(header.get("XYUnits", "m"))
    unit, height = si(header.get("ZUnits", ""))
    extent, offset = ([one * float(header.get(axis + of, default)) for axis in "XY"] for of, default in [("Real", 1), ("Offset", 0)])
    values = height * np.frombuffer(data, "<f4").reshape(rows, columns).astype(float)
    x, y = centres(columns, extent[0], offset[0]), centres(rows, extent[1], offset[1])
    channel = Channel(header.get("Title") or "Height", unit, None, values, x, y)
    return Scan([channel], {"format": "Gwyddion Simple Field", **evenly_scanned(rows, extent[1], extent[0])}, "down")


def bytes_of(x, y, values, unit, height):
    """The bytes of a .gsf file of an even grid, positions in `unit` and values in `height`, each empty if unknown."""
    spacing = [float(at[-1] - at[0]) / (len(at) - 1) if len(at) > 1 else 1.0 for at in (x, y)]
    header = {
        "XRes": len(x),
        "YRes": len(y),
        "XReal": repr(spacing[0] * len(x)),
        "YReal": repr(spacing[1] * len(y)),
        "XOffset": repr(float(x[0]) - spacing[0] / 2),
        "YOffset": repr(float(y[0]) - spacing[1] / 2),
        "XYUnits": unit,
        "ZUnits": height,
    }
    text = MAGIC + "".join(f"{key} = {value}\n" for key, value in header.items()).encode()
    padding = b"\0" * (4 - len(text) % 4)
    return text + padding + np.ascontiguousarray(values, "<f4").tobytes()
