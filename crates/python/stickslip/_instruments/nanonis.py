"""Images of Nanonis (SPECS), .sxm: a text header, and big-endian single-precision pixels in the order of the scan."""

import re

import numpy as np

from ._scan import Channel, Scan, centres, evenly_scanned, number, si

END = b":SCANIT_END:"


def read(path):
    with open(path, "rb") as file:
        content = file.read()
    end = content.find(END)
    start = content.find(b"\x1a\x04", end)
    if end < 0 or start < 0:
        raise ValueError("not a Nanonis image with a header")
    header = fields(content[:end].decode("utf-8", "replace"))
    try:
        columns, rows = (int(word) for word in header["SCAN_PIXELS"].split())
        width, height = (float(word) for word in header["SCAN_RANGE"].split()[:2])
        listed = [line.strip().split("\t") for line in header["DATA_INFO"].splitlines() if line.strip()]
    except (KeyError, ValueError):
        raise ValueError("SCAN_PIXELS, SCAN_RANGE or DATA_INFO is missing or damaged") from None
    is_up = header.get("SCAN_DIR", "up").strip().lower() != "down"
    pixels = np.frombuffer(content, ">f4", (len(content) - start - 2) // 4, start + 2)
    x, y = centres(columns, width), centres(rows, height)
    names = [word.strip() for word in listed[0]]
    channels, at = [], 0
    for line in listed[1:]:
        about = dict(zip(names, (word.strip() for word in line)))
        unit, one = si(about.get("Unit", ""))
        for scan in ("trace", "retrace") if about.get("Direction", "both").lower() == "both" else ("trace",):
            image = pixels[at : at + columns * rows]
            at += columns * rows
            if len(image) < columns * rows:
                raise ValueError(f"cut off within {about.get('Name')}")
            image = one * image.reshape(rows, columns).astype(float)
            # Rows and retraces are stored in the order of the scan.
            image = image if is_up else image[::-1]
            image = image if scan == "trace" else image[:, ::-1]
            channels.append(Channel(about.get("Name", "channel").replace("_", " "), unit, scan, image, x, y))
    return Scan(channels, attributes(header, rows, height, width, is_up), "up")


def fields(text):
    """The header's fields: lines between one ``:NAME:`` and the next."""
    parts = re.split(r"^:([^:\r\n][^\r\n]*):[ \t]*\r?$", text, flags=re.MULTILINE)
    return {name: value.strip("\r\n") for name, value in zip(parts[1::2], parts[2::2])}


def attributes(header, rows, height, width, is_up):
    found = {"format": "Nanonis", "slow_scan": "up" if is_up else "down"}
    # Seconds for the trace of a line.
    seconds = number(header.get("SCAN_TIME", ""))
    velocity = width / seconds if seconds else None
    found.update(evenly_scanned(rows, height, width, velocity=velocity))
    if velocity:
        back = header.get("SCAN_TIME", "").split()
        period = seconds + (number(back[1]) or seconds if len(back) > 1 else seconds)
        found["line_rate_Hz"] = 1.0 / period
    if number(header.get("SCAN_ANGLE", "")) is not None:
        found["scan_angle_deg"] = number(header["SCAN_ANGLE"])
    return found
