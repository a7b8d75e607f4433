"""``python -m stickslip convert FILE``: a channel of an instrument's image as a file of the program."""

import argparse
import sys

from . import open as open_scan
from ._scans import heights, image_file, profile_columns


def main(words=None):
    parser = argparse.ArgumentParser(prog="python -m stickslip", description="Files of instruments for the program stickslip.")
    commands = parser.add_subparsers(dest="command", required=True)
    convert = commands.add_parser(
        "convert", help="a channel of an image as .gsf, or one of its lines as .csv; without -o, list the channels"
    )
    convert.add_argument("file", help=".gwy, .gsf, .spm (.000, …), .ibw, .sxm or .jpk")
    convert.add_argument("-o", "--output", metavar="FILE", help=".gsf for the image, .csv for a line")
    convert.add_argument("--channel", metavar="NAME", help="channel [default: heights]")
    convert.add_argument("--line", metavar="N", type=int, help="row of the image, from 0")
    given = parser.parse_args(words)
    try:
        converted(given)
    except (ImportError, OSError, ValueError) as error:
        print(f"stickslip: {error}", file=sys.stderr)
        return 2
    return 0


def converted(given):
    """Lists the channels, or writes one."""
    scan = open_scan(given.file)
    if given.output is None:
        return listed(scan)
    if given.channel is not None and given.channel not in scan:
        raise ValueError(f"--channel {given.channel}: there are {', '.join(map(str, scan.data_vars))}")
    array = scan[given.channel] if given.channel is not None else heights(given.file, scan)
    if given.output.lower().endswith(".gsf"):
        write(given.output, image_file(given.file, array))
    elif given.output.lower().endswith(".csv"):
        if given.line is None or not 0 <= given.line < array.shape[0]:
            raise ValueError(f"--line is the row of the image for a .csv, from 0 to {array.shape[0] - 1}")
        headings, columns = profile_columns(given.file, [array.isel(y=given.line)])
        lines = [";".join(f'"{heading}"' for heading in headings)]
        lines += [";".join(repr(float(value)) for value in row) for row in zip(*columns)]
        write(given.output, ("\n".join(lines) + "\n").encode())
    else:
        raise ValueError(f"-o {given.output}: .gsf or .csv")


def write(path, content):
    with open(path, "wb") as file:
        file.write(content)


def listed(scan):
    for name, array in scan.data_vars.items():
        rows, columns = array.shape
        print(f"{name}: {columns} × {rows} pixels, {array.attrs.get('units') or 'no unit'}, {array.attrs.get('scan', 'scan direction unknown')}")
    for name, value in scan.attrs.items():
        print(f"{name} = {value}")


if __name__ == "__main__":
    sys.exit(main())
