"""Arguments at which implementations of exp, sin and similar functions are most probably told apart.

Prints the table of crates/cli/src/arithmetic.rs. Needs mpmath (1.3.0 was used), and glibc on an x86-64 processor with
a fused multiply-add (2.36 was used). Of the first 65535 points that fill the interval from -12 to 12, each function has
12: up to 6 at which the variants of glibc with and without a fused multiply-add differ, and those whose exact value is
nearest to the midpoint of two numbers, where any two implementations that are not correctly rounded may differ.
"""

import ctypes
import math
import os
import struct
import subprocess
import sys

from mpmath import mp, mpf

mp.prec = 120
WITHOUT = "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-AVX2,-FMA4,-AVX"
COUNT, EACH, OBSERVED = 65535, 12, 6

# The order is that of FUNCTIONS.
FUNCTIONS = {
    "exp": mp.exp,
    "log": lambda x: mp.log(abs(x)),
    "sin": mp.sin,
    "cos": mp.cos,
    "tan": mp.tan,
    "pow": lambda x: mp.power(abs(x), mpf(0.3 + 0.1 * float(x))),
    "atan2": lambda x: mp.atan2(x, mpf(1.7)),
    "hypot": lambda x: mp.hypot(x, mpf(2.3)),
    "expm1": mp.expm1,
    "log1p": lambda x: mp.log1p(abs(x)),
    "sinh": mp.sinh,
    "cosh": mp.cosh,
    "tanh": mp.tanh,
    "log10": lambda x: mp.log10(abs(x)),
}


def argument(i):
    return 24.0 * (math.fmod(i * 0.6180339887498949, 1.0) - 0.5)


def values():
    """The values of this process's C library, as lines of hexadecimal digits."""
    libm = ctypes.CDLL("libm.so.6")
    double = ctypes.c_double
    for name in FUNCTIONS:
        function = getattr(libm, name)
        function.restype = double
        function.argtypes = [double, double] if name in ("pow", "atan2", "hypot") else [double]
    for i in range(1, COUNT + 1):
        x = argument(i)
        seconds = {"pow": 0.3 + 0.1 * x, "atan2": 1.7, "hypot": 2.3}
        row = []
        for name in FUNCTIONS:
            first = abs(x) if name in ("log", "pow", "log1p", "log10") else x
            more = [seconds[name]] if name in seconds else []
            row.append(struct.pack(">d", getattr(libm, name)(first, *more)).hex())
        print(*row)


def from_midpoint(value):
    """The distance of a value from the midpoint of the numbers around it, in units of the last place."""
    digits, _ = mp.frexp(abs(value))
    scaled = mp.ldexp(digits, 53)
    return abs(scaled - mp.floor(scaled) - mpf(0.5))


def variant(tunables):
    environment = {**os.environ, "GLIBC_TUNABLES": tunables}
    command = [sys.executable, __file__, "values"]
    printed = subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    return [line.split() for line in printed.stdout.splitlines()]


def table():
    fused, plain = variant(""), variant(WITHOUT)
    for k, (name, function) in enumerate(FUNCTIONS.items()):
        differ = [i for i in range(1, COUNT + 1) if fused[i - 1][k] != plain[i - 1][k]]
        spread = max(1, len(differ) // OBSERVED)
        chosen = differ[::spread][:OBSERVED]
        hardest = sorted(range(1, COUNT + 1), key=lambda i: from_midpoint(function(mpf(argument(i)))))
        chosen += [i for i in hardest if i not in chosen][: EACH - len(chosen)]
        print(f"    {chosen}, // {name}: {len(differ)} of {COUNT} differ")


if __name__ == "__main__":
    values() if sys.argv[1:] == ["values"] else table()
