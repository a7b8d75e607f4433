"""Small images in the formats of instruments: by the libraries that write these, else as their headers are described.

Heights are integers times 2^-40 m and pixels 2^-28 m, so that every format holds the same numbers to the last bit.
"""

import struct

import gwyfile.objects
import igorwriter
import numpy as np
import tifffile

PIXEL = 2.0**-28
LSB = 2.0**-40
ROWS, COLUMNS = 48, 96
FORMATS = ["scan.gwy", "scan.gsf", "scan.spm", "scan.ibw", "scan.sxm", "scan.jpk"]


def pit(shift=0.0):
    """Heights of a pit of width 30 nm, 12 nm deep, as integers; row 0 has the smallest y."""
    x = PIXEL * (np.arange(COLUMNS) + 0.5 + shift)
    y = PIXEL * (np.arange(ROWS) + 0.5)
    x, y = np.meshgrid(x / 30e-9, y / 45e-9)
    centre = [0.5 * PIXEL * COLUMNS / 30e-9, 0.5 * PIXEL * ROWS / 45e-9]
    heights = -12e-9 * np.exp(-((x - centre[0]) ** 2 + (y - centre[1]) ** 2) / 2)
    noise = np.random.default_rng(1).normal(0, 1e-10, heights.shape)
    return np.round((heights + noise + 1e-2 * PIXEL * np.arange(COLUMNS)) / LSB).astype(np.int32)


def friction():
    return (np.arange(ROWS * COLUMNS, dtype=np.int32) % 251 - 125).reshape(ROWS, COLUMNS)


def write(path):
    """Height, trace and retrace, and a lateral signal in V, where the format has more than one channel."""
    {"gwy": gwy, "gsf": gsf, "spm": spm, "ibw": ibw, "sxm": sxm, "jpk": jpk}[path.suffix[1:]](path)


def gwy(path):
    found = gwyfile.objects.GwyContainer()
    for i, (title, image, unit) in enumerate(channels()):
        field = gwyfile.objects.GwyDataField(image, si_unit_xy="m", si_unit_z=unit)
        field.xreal, field.yreal = COLUMNS * PIXEL, ROWS * PIXEL
        found[f"/{i}/data"], found[f"/{i}/data/title"] = field, title
        found[f"/{i}/meta"] = gwyfile.objects.GwyContainer({"Scan rate": "2.5 Hz", "Spring constant": "0.2"})
    found.tofile(str(path))


def channels():
    """Titles, values and units as most formats have them."""
    return [("Height", LSB * pit(), "m"), ("Height (Retrace)", LSB * pit(3), "m"), ("Lateral", LSB * friction(), "V")]


def gsf(path):
    extents = f"XReal = {COLUMNS * PIXEL!r}\nYReal = {ROWS * PIXEL!r}\n"
    text = f"Gwyddion Simple Field 1.0\nXRes = {COLUMNS}\nYRes = {ROWS}\n{extents}XYUnits = m\nZUnits = m\nTitle = Height\n"
    content = text.encode()
    content += b"\0" * (4 - len(content) % 4)
    path.write_bytes(content + (LSB * pit()).astype("<f4").tobytes())


def spm(path, magic="\\*File list", stored="<i4", nominal=2):
    """The header of Nanoscope 9: heights are integer/65536 × 1 V × 2^-24 m/V."""
    size = np.dtype(stored).itemsize * ROWS * COLUMNS
    lists = [f"{magic}", "\\Version: 0x09300201", "\\*Scanner list", f"\\@Sens. Zsens: V {2.0**-24!r} m/V"]
    lists += ["\\*Ciao scan list", "\\Scan Rate: 2.5", "\\Capture direction: Down", "\\Spring Constant: 0.2"]
    extent = f"{COLUMNS * PIXEL!r} {ROWS * PIXEL!r} m"
    images = [("Height", "Trace", pit(), "[Sens. Zsens]"), ("Height", "Retrace", pit(3), "[Sens. Zsens]")]
    images.append(("Friction", "Trace", friction(), "[]"))
    for i, (name, way, _, sensitivity) in enumerate(images):
        scale = "1.0 V" if sensitivity != "[]" else f"{65536 * LSB!r} V"
        lists += ["\\*Ciao image list", f"\\Data offset: {40960 + i * size}", f"\\Data length: {size}"]
        lists += [f"\\Bytes/pixel: {nominal}", f"\\Samps/line: {COLUMNS}", f"\\Number of lines: {ROWS}"]
        lists += [f"\\Scan Size: {extent}", f"\\Line Direction: {way}"]
        lists += [f"\\@2:Image Data: S [{name}] \"{name}\"", f"\\@2:Z scale: V {sensitivity} (0.0003 V/LSB) {scale}"]
    header = ("\r\n".join([*lists, "\\*File list end", "\x1a"])).encode("latin-1")
    data = b"".join(image.astype(stored).tobytes() for _, _, image, _ in images)
    path.write_bytes(header.ljust(40960, b"\0") + data)


def ibw(path):
    # Columns first, then rows, then channels.
    images = [("HeightTrace", LSB * pit()), ("HeightRetrace", LSB * pit(3)), ("LateralTrace", LSB * friction())]
    wave = igorwriter.IgorWave(np.stack([image.T for _, image in images], axis=2), name="scan")
    for axis in (0, 1):
        wave.set_dimscale("xy"[axis], 0.0, PIXEL, "m")
    for i, (name, _) in enumerate(images):
        wave.set_dimlabel(2, i, name)
    wave.set_note("ScanRate: 2.5\rSpringConstant: 0.2\rScanDown: 1\rLateralUnit: V\rScanAngle: 0\r")
    wave.save(str(path))


def sxm(path):
    info = "\tChannel\tName\tUnit\tDirection\tCalibration\tOffset\n\t14\tHeight\tm\tboth\t1\t0\n\t15\tLateral\tV\tboth\t1\t0\n"
    fields = {
        "NANONIS_VERSION": "2",
        "SCAN_PIXELS": f"       {COLUMNS}       {ROWS}",
        # Seconds per line, there and back.
        "SCAN_TIME": "             2.000E-1             2.000E-1",
        "SCAN_RANGE": f"           {COLUMNS * PIXEL!r}           {ROWS * PIXEL!r}",
        "SCAN_OFFSET": "             0.000000E+0         0.000000E+0",
        "SCAN_ANGLE": "0.000E+0",
        "SCAN_DIR": "down",
        "BIAS": "0.000E+0",
        "ACQ_TIME": "       9.6",
        "DATA_INFO": info,
    }
    header = "".join(f":{key}:\n{value}\n" for key, value in fields.items()) + ":SCANIT_END:\n\n\n"
    # In the order of the scan: from the top, and the way back from the right.
    images = [LSB * pit(), LSB * pit(3)[:, ::-1], LSB * friction(), LSB * friction()[:, ::-1]]
    data = b"".join(image[::-1].astype(">f4").tobytes() for image in images)
    path.write_bytes(header.encode() + b"\x1a\x04" + data)


def jpk(path):
    about = [(0x8042, "d", 1, COLUMNS * PIXEL, True), (0x8043, "d", 1, ROWS * PIXEL, True), (0x8044, "d", 1, 0.0, True)]
    about += [(0x8046, "i", 1, COLUMNS, True), (0x8047, "i", 1, ROWS, True), (0x8049, "d", 1, 2.5, True)]
    with tifffile.TiffWriter(path) as file:
        file.write(np.zeros((8, 8), np.uint8), extratags=about, photometric="minisblack", metadata=None)
        images = [("height", 0, pit(), "m"), ("height", 1, pit(3), "m"), ("hDeflection", 0, friction(), "V")]
        for name, way, image, unit in images:
            tags = [(0x8050, "s", 0, name, True), (0x8051, "H", 1, way, True), (0x8080, "i", 1, 2, True), (0x8081, "s", 0, "own", True)]
            tags += [(0x8090, "s", 0, "raw", True), (0x80A3, "s", 0, "NullScaling", True), (0x80C0, "s", 0, "own", True)]
            tags += [(0x80D2, "s", 0, unit, True), (0x80D3, "s", 0, "LinearScaling", True)]
            tags += [(0x80D4, "d", 1, LSB, True), (0x80D5, "d", 1, 0.0, True)]
            file.write(image, extratags=tags, photometric="minisblack", metadata=None)


def force_curve(path):
    """A Nanoscope file without an image."""
    path.write_bytes(b"\\*Force file list\r\n\\Version: 0x09300201\r\n\\*File list end\r\n\x1a" + struct.pack("<4h", 1, 2, 3, 4))
