"""Files of instruments as xarray Datasets: one variable per channel, positions in m, and the scan parameters of the header.

Gwyddion and Igor files are read by gwyfile and igor2, the TIFF of JPK by tifffile; Nanoscope, Nanonis and Gwyddion
Simple Field, whose headers are text, are read here. (pySPM, AFMReader and SciFiReaders read these too, but need
scikit-learn, matplotlib or numba, and drop line rate, stiffness and scan direction; afmformats reads force curves only.)
"""

import importlib
import os

from ._scan import dataset_of

# Suffixes, the module that reads them, and the library that it needs.
READERS = {
    ".gwy": ("gwyddion", "gwyfile"),
    ".gsf": ("simple_field", None),
    ".spm": ("nanoscope", None),
    ".ibw": ("igor", "igor2"),
    ".sxm": ("nanonis", None),
    ".jpk": ("jpk", "tifffile"),
    ".jpk-qi-image": ("jpk", "tifffile"),
}


def open(path, channel=None):  # noqa: A001
    """Images of an instrument, .gwy, .gsf, .spm (and .000, .001, …), .ibw, .sxm or .jpk, as an xarray Dataset.

    Each channel is a variable over y and x with its name in the file; ``" retrace"`` is appended if the file also has the
    trace. Positions are in m. Attributes of a channel: ``units`` (SI), ``scan`` ("trace" or "retrace").
    Attributes of the Dataset, if the header has them: ``line_rate_Hz``, ``velocity_m_per_s`` of the support along a
    line, ``pitch_m``, the distance of the lines, ``scan_angle_deg``, ``slow_scan`` ("up" or "down") and
    ``normal_stiffness_N_per_m``, the spring constant of the cantilever for bending (the k of the model is the lateral
    stiffness). y increases upwards, in Gwyddion's formats downwards (``positive`` of y says so).

    channel is the name of a single channel, needed only if channels have different sizes. ``tip``, ``fit`` and ``raster``
    take the Dataset, a channel of it, or a profile such as ``scan["Height"].isel(y=10)``.

    ImportError if a library is missing (``pip install "stickslip[instruments]"``), ValueError if the file cannot be
    read, with the reason."""
    path = os.fspath(path)
    module, library = reader_of(path)
    try:
        read = importlib.import_module(f"{__name__}.{module}").read
        import xarray  # noqa: F401
    except ImportError as error:
        missing = error.name or library
        raise ImportError(f'{path}: needs {missing}: pip install "stickslip[instruments]"', name=missing) from None
    try:
        scan = read(path)
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001 (a damaged file makes the libraries fail in any way)
        reason = str(error).removeprefix(f"{path}: ") or type(error).__name__
        raise ValueError(f"{path}: cannot be read: {reason}") from error
    return dataset_of(path, scan, channel)


def reader_of(path):
    """The module that reads a file, and the library that this needs."""
    name = os.path.basename(path).lower()
    found = next((reader for suffix, reader in READERS.items() if name.endswith(suffix)), None)
    last = os.path.splitext(name)[1]
    if found is None and len(last) == 4 and last[1:].isdigit():
        # Older versions of Nanoscope number their files.
        found = READERS[".spm"]
    if found is None:
        raise ValueError(
            f"{path}: not a file of an instrument known here ({', '.join(READERS)}): save it as .gwy or .gsf in Gwyddion,"
            " which reads nearly all; tables (.csv, .txt) are read by the commands themselves"
        )
    return found
