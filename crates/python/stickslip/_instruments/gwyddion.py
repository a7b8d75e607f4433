"""Gwyddion's native format, .gwy, by gwyfile."""

import os
import re

import gwyfile
import numpy as np

from ._scan import Channel, Scan, centres, evenly_scanned, number, si


def read(path):
    check_length(path)
    container = gwyfile.load(path)
    keys = [re.fullmatch(r"/(\d+)/data", key) for key in container]
    ids = sorted(int(key[1]) for key in keys if key)
    found = [(channel(container, i), metadata(container.get(f"/{i}/meta"))) for i in ids]
    attributes = {"format": "Gwyddion"}
    if found:
        first, about = found[0]
        width, height = (len(at) * (at[1] - at[0]) if len(at) > 1 else 0.0 for at in (first.x, first.y))
        attributes.update(evenly_scanned(len(first.y), height, width, about.get("line_rate_Hz"), about.get("velocity")))
        attributes.update((key, value) for key, value in about.items() if key not in ("velocity", "line_rate_Hz"))
    return Scan([c for c, _ in found], attributes, "down")


def check_length(path):
    """Raises ValueError for a truncated file, in which gwyfile would search indefinitely."""
    with open(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        start = file.read(64)
    end = start.find(b"\0")
    if not start.startswith(b"GWYP") or end < 0 or len(start) < end + 5:
        raise ValueError("not a Gwyddion file")
    promised = end + 5 + int.from_bytes(start[end + 1 : end + 5], "little")
    if size != promised:
        raise ValueError(f"{size} bytes instead of {promised}: cut off")


def channel(container, i):
    field = container[f"/{i}/data"]
    columns, rows = int(field["xres"]), int(field["yres"])
    _, one = si(unit_of(field, "si_unit_xy") or "m")
    unit, height = si(unit_of(field, "si_unit_z"))
    x = centres(columns, one * field.get("xreal", columns), one * field.get("xoff", 0.0))
    y = centres(rows, one * field.get("yreal", rows), one * field.get("yoff", 0.0))
    values = height * np.asarray(field["data"], float).reshape(rows, columns)
    title = str(container.get(f"/{i}/data/title", f"channel {i}")).strip()
    name, scan = way(title)
    return Channel(name, unit, scan, values, x, y)


def unit_of(field, key):
    unit = field.get(key)
    return str(unit.get("unitstr", "")) if unit is not None else ""


# Suffixes of titles by which Gwyddion's import distinguishes trace and retrace.
WAYS = {"trace": "trace", "forward": "trace", "retrace": "retrace", "backward": "retrace"}


def way(title):
    """A title without the direction of the scan, and the direction: ``Height (Retrace)`` or ``Z [Backward]``."""
    ending = re.search(r"[\s_]*[\[(]?\b(trace|forward|retrace|backward)\b[\])]?$", title, re.IGNORECASE)
    if not ending or not ending.start():
        return title, None
    return title[: ending.start()], WAYS[ending[1].lower()]


def metadata(meta):
    """The scan parameters among the metadata, which Gwyddion stores as text with the names of each instrument."""
    found = {}
    if meta is None:
        return found
    for key, text in meta.items():
        word = re.sub(r"[^a-z]", "", key.lower())
        value = number(text)
        if value is None:
            continue
        if word in ("scanrate", "linerate", "scanratehz"):
            found["line_rate_Hz"] = value
        elif word in ("scanangle", "rotate", "rotation"):
            found["scan_angle_deg"] = value
        elif word == "springconstant":
            found["normal_stiffness_N_per_m"] = value
    return found
