"""Images of JPK (Bruker), .jpk and .jpk-qi-image: TIFF with private tags, by tifffile.

The tags are those of JPKImageSpec 2.0. A channel has several slots, calibrations of the same integers; the default slot is used.
"""

import math

import tifffile

from ._scan import Channel, Scan, centres, evenly_scanned, si

WIDTH, HEIGHT, ANGLE, COLUMNS, ROWS = 0x8042, 0x8043, 0x8044, 0x8046, 0x8047
LINE_RATE, DUTY = 0x8049, 0x804A
CHANNEL, RETRACE, TITLE = 0x8050, 0x8051, 0x8052
SLOTS, DEFAULT = 0x8080, 0x8081
# Tags of the first slot; those of each further slot are 0x30 higher.
SLOT, UNIT, SCALING, FACTOR, OFFSET, STRIDE = 0x8090, 0x80A2, 0x80A3, 0x80A4, 0x80A5, 0x30


def read(path):
    with tifffile.TiffFile(path) as file:
        pages = [({tag.code: tag.value for tag in page.tags}, page) for page in file.pages]
        head = pages[0][0]
        if WIDTH not in head:
            raise ValueError("a TIFF without the tags of JPK")
        channels = [channel(head, tags, page) for tags, page in pages[1:] if CHANNEL in tags]
    found = {"format": "JPK"}
    rate = head.get(LINE_RATE)
    # The tip moves along a line during part of a period, there and back.
    velocity = 2.0 * head[WIDTH] * rate / head.get(DUTY, 1.0) if rate else None
    found.update(evenly_scanned(int(head[ROWS]), head[HEIGHT], head[WIDTH], rate, velocity))
    if ANGLE in head:
        found["scan_angle_deg"] = math.degrees(head[ANGLE]) + 0.0
    return Scan(channels, found, "up")


def channel(head, tags, page):
    slots = [SLOT + STRIDE * i for i in range(int(tags.get(SLOTS, 0)))]
    chosen = next((slot for slot in slots if tags.get(slot) == tags.get(DEFAULT)), None)
    unit, factor, offset = "", 1.0, 0.0
    if chosen is not None:
        unit, height = si(str(tags.get(chosen - SLOT + UNIT, "")))
        if tags.get(chosen - SLOT + SCALING) == "LinearScaling":
            factor, offset = tags[chosen - SLOT + FACTOR] * height, tags[chosen - SLOT + OFFSET] * height
    values = factor * page.asarray().astype(float) + offset
    x, y = centres(values.shape[1], head[WIDTH]), centres(values.shape[0], head[HEIGHT])
    scan = "retrace" if int(tags.get(RETRACE, 0)) else "trace"
    return Channel(str(tags.get(CHANNEL)), unit, scan, values, x, y)
