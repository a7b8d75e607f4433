"""Igor's binary waves, .ibw, as Asylum Research writes images, by igor2."""

import re

import numpy as np
from igor2 import binarywave

from ._scan import Channel, Scan, evenly_scanned, number, si

# Channels without a unit in the note, by the beginning of their names, as the instrument defines them.
UNITS = {"height": "m", "zsensor": "m", "deflection": "m", "amplitude": "m", "phase": "deg", "frequency": "Hz", "current": "A"}


def read(path):
    wave = binarywave.load(path)["wave"]
    data = np.asarray(wave["wData"], float)
    if data.ndim == 2:
        data = data[:, :, np.newaxis]
    if data.ndim != 3:
        raise ValueError(f"a wave of {data.ndim} dimension(s), not an image")
    note = note_of(wave)
    positions = [axis(wave, i, data.shape[i]) for i in range(2)]
    names = [decoded(label) for label in wave["labels"][2][1:]] if len(wave["labels"]) > 2 else []
    channels = []
    for i in range(data.shape[2]):
        label = names[i] if i < len(names) and names[i] else f"channel {i}"
        name, scan = way(label)
        unit, one = si(unit_of(name, wave, note))
        channels.append(Channel(name, unit, scan, one * data[:, :, i].T, *positions))
    width, height = (len(at) * (at[1] - at[0]) if len(at) > 1 else 0.0 for at in positions)
    return Scan(channels, attributes(note, len(positions[1]), height, width), "up")


def decoded(text):
    return text.decode("latin-1") if isinstance(text, bytes) else str(text)


def note_of(wave):
    """The parameters that the instrument appends. The last of repeated ones counts: it belongs to the end of the scan."""
    lines = re.split(r"[\r\n]+", decoded(wave.get("note", b"")))
    return {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}


def axis(wave, i, count):
    """Centres of pixels, in m."""
    header = wave["wave_header"]
    unit = b"".join(np.atleast_1d(header["dimUnits"][i])).decode("latin-1")
    one = si(unit)[1]
    spacing, start = float(header["sfA"][i]), float(header["sfB"][i])
    return one * (start + spacing * (np.arange(count) + 0.5))


def way(label):
    """A label without the direction of the scan, and the direction; some labels repeat a letter: ``HeightTracee``."""
    found = re.fullmatch(r"(.+?)(Trace|Retrace)e?", label)
    return (found[1], found[2].lower()) if found else (label, None)


def unit_of(name, wave, note):
    of_data = b"".join(np.atleast_1d(wave["wave_header"]["dataUnits"])).decode("latin-1")
    if note.get(f"{name}Unit"):
        return note[f"{name}Unit"]
    known = (unit for beginning, unit in UNITS.items() if name.lower().startswith(beginning))
    return next(known, of_data or "V")


def attributes(note, lines, height, width):
    found = {"format": "Igor binary wave"}
    found.update(evenly_scanned(lines, height, width, number(note.get("ScanRate")), number(note.get("ScanSpeed"))))
    if number(note.get("ScanAngle")) is not None:
        found["scan_angle_deg"] = number(note["ScanAngle"])
    if number(note.get("SpringConstant")):
        found["normal_stiffness_N_per_m"] = number(note["SpringConstant"])
    if note.get("ScanDown") in ("0", "1"):
        found["slow_scan"] = "down" if note["ScanDown"] == "1" else "up"
    return found
