#!/usr/bin/env python3
"""Does a kernel take more instructions than before? Exit status 1 if one takes over 5 % more.

    benches/instructions.py BEFORE AFTER

Counts the instructions of whole commands, less those of an empty one, with both programs in valgrind (callgrind). Unlike
times, counts do not depend on what else the machine does: two runs of one program differ by less than 0.1 %. Valgrind
knows no AVX-512, so the kernels take their AVX2 path.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

MOST = 1.05
# Each spends its time in one kernel; none on more than one thread.
KERNELS = {
    "series of one motion": "run --alpha 1.2 --r 1 --kick 0.05 --until 20000 --tolerance 1e-6 --sample-every 20000 --history none",
    "collocation": "run --alpha 1.2 --r 1 --kick 0.05 --until 400 --pulse 0.1,200,100 --history none",
    "memory direct": "run --alpha 1.2 --r 1 --kick 0.05 --until 200 --tolerance 1e-6 --memory direct --history none",
    "memory fft": "run --alpha 1.2 --r 1 --kick 0.05 --until 1000 --tolerance 1e-6 --memory fft --history none",
    "cycle and multipliers": "cycle --alpha 1.5 --r 1 --points 10",
    "linear theory": "boundary --r-range 0.1,3 --points 300",
    "map": "sweep --r 0.8:1.2:2 --alpha 0.9:1.6:4 --threads 1",
    "runs side by side": "sweep --until 200 --r 1 --alpha 1.1:1.5:64 --kick 0.05 --threads 1",
    "raster": "raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 16 --length 20",
    "surface": "surface run.json --at 200 --range 0:210 --spacing 0.02",
}
EMPTY = "units --r 1 --alpha 1 --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN"
# A run for those that read one.
BEFOREHAND = "run --alpha 1.2 --r 1 --kick 0.05 --until 200 -o run.json"


def counted(program, line, folder):
    """Instructions of a command."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, "--quiet", *shlex.split(line)]
    ended = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        sys.exit(f"stickslip {line}: status {ended.returncode}\n{ended.stderr}")
    return int(re.search(r"Collected : (\d+)", ended.stderr).group(1))


def main():
    programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:3]]
    dearer = []
    with tempfile.TemporaryDirectory() as folder:
        empty = [counted(p, EMPTY, folder) for p in programs]
        print(f"{'':24}{'before':>16}{'after':>16}{'ratio':>8}")
        for name, line in KERNELS.items():
            counts = []
            for program, start in zip(programs, empty):
                subprocess.run([program, "--quiet", *shlex.split(BEFOREHAND)], cwd=folder, check=True)
                counts.append(counted(program, line, folder) - start)
            ratio = counts[1] / counts[0]
            print(f"{name:24}{counts[0]:16,}{counts[1]:16,}{ratio:8.3f}", flush=True)
            if ratio > MOST:
                dearer.append(name)
    if dearer:
        print(f"more than {MOST - 1:.0%} dearer: {', '.join(dearer)}")
    return 1 if dearer else 0


if __name__ == "__main__":
    sys.exit(main())
