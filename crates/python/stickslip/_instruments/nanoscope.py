"""Files of Nanoscope (Bruker, Veeco, Digital Instruments), .spm or .000: a text header, and integers.

A height is integer / 256^(bytes) × hard value (V) × sensitivity (nm/V), all from the header.
"""

import re

import numpy as np

from ._scan import Channel, Scan, centres, evenly_scanned, number, si

# Types by bytes of a pixel. The scale refers to the nominal number; newer versions store four bytes in any case.
TYPES = {2: "<i2", 4: "<i4", 8: "<i8"}


def read(path):
    with open(path, "rb") as file:
        content = file.read()
    sections = sections_of(content)
    if sections is None:
        raise ValueError("not a Nanoscope file with a header")
    images = [fields for title, fields in sections if title == "Ciao image list"]
    common = {}
    for title, fields in sections:
        if title != "Ciao image list":
            for key, value in fields.items():
                common.setdefault(key, value)
    channels = [channel(content, image, common) for image in images]
    channels = [found for found in channels if found]
    return Scan(channels, attributes(channels, common), "up")


def sections_of(content):
    """Titles and fields of the header's lists; None if the header has no end."""
    end = content.find(b"\\*File list end")
    if not content.startswith(b"\\*") or end < 0:
        return None
    sections = []
    for line in content[:end].decode("latin-1").splitlines():
        line = line.strip().lstrip("\\")
        if line.startswith("*"):
            sections.append((line[1:].strip(), {}))
        elif sections:
            key, _, value = line.partition(": ")
            # Fields with a digit belong to a parameter group of the same name.
            sections[-1][1].setdefault(re.sub(r"^@\d*:?", "@", key), value.strip())
    return sections


def channel(content, image, common):
    try:
        offset, length = int(image["Data offset"]), int(image["Data length"])
        columns, rows = int(image["Samps/line"]), int(image["Number of lines"])
        nominal = int(image.get("Bytes/pixel", 2))
    except (KeyError, ValueError):
        # A force curve, or a list without data.
        return None
    if columns * rows == 0 or length % (columns * rows) or length // (columns * rows) not in TYPES:
        return None
    if len(content) < offset + length:
        raise ValueError(f"{len(content)} bytes: cut off within an image")
    raw = np.frombuffer(content, TYPES[length // (columns * rows)], columns * rows, offset)
    unit, scale = scale_of(image.get("@Z scale", ""), common)
    width, height = size(image.get("Scan Size") or image.get("Scan size") or common.get("Scan Size", ""), rows / columns)
    named = re.search(r'"([^"]*)"', image.get("@Image Data", ""))
    scan = {"trace": "trace", "retrace": "retrace"}.get(image.get("Line Direction", "").lower())
    values = scale / 256.0**nominal * raw.reshape(rows, columns)
    name = named[1] if named else "channel"
    return Channel(name, unit, scan, values, centres(columns, width), centres(rows, height))


def scale_of(text, common):
    """Unit and full scale (in the unit) of ``V [Sens. Zsens] (0.0067 V/LSB) 440 V``."""
    found = re.match(r"\S+\s*(?:\[([^\]]*)\])?\s*\([^)]*\)\s*(\S+)\s*(\S*)", text)
    if not found or number(found[2]) is None:
        return "", 256.0**2
    unit, one = si(found[3])
    full = float(found[2]) * one
    sensitivity = re.match(r"\S+\s+(\S+)\s*(\S*)", common.get(f"@{found[1]}", "")) if found[1] else None
    if not sensitivity or number(sensitivity[1]) is None:
        return unit, full
    above, _, below = sensitivity[2].partition("/")
    unit, height = si(above)
    return unit, full * float(sensitivity[1]) * height / si(below)[1]


def size(text, aspect):
    """Width and height, in m, of ``505.859 505.859 nm``; one number is the width."""
    words = text.split()
    if len(words) < 2:
        return 1.0, aspect
    one = si(words[-1])[1]
    numbers = [one * float(word) for word in words[:-1]]
    return numbers[0], numbers[1] if len(numbers) > 1 else numbers[0] * aspect


def attributes(channels, common):
    found = {"format": "Nanoscope"}
    if channels:
        first = channels[0]
        width, height = (len(at) * (at[1] - at[0]) if len(at) > 1 else 0.0 for at in (first.x, first.y))
        found.update(evenly_scanned(len(first.y), height, width, number(common.get("Scan Rate", common.get("Scan rate")))))
    spring = number(common.get("Spring Constant", common.get("Spring constant")))
    if spring:
        found["normal_stiffness_N_per_m"] = spring
    direction = common.get("Capture direction", common.get("Frame direction", "")).lower()
    if direction in ("up", "down"):
        found["slow_scan"] = direction
    return found
