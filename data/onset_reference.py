"""Small limit cycles near onset by harmonic balance, the oracle for the first Lyapunov coefficient.

Writes onset_reference.json beside this file. Needs numpy (2.x) and scipy (1.x). Nothing of the expansion
in docs/explanation/linear-theory.md is used: the periodic solutions of (18) are solved in full.

l(t) = Σ c_k e^{ikωt}, |k| ≤ K, put into (18) at 2K+1 points of a period; the memory integral by
Gauss-Legendre panels in rτ over the reach of f. αc and ω come from (42), (43) with the same panels.
For each α - αc: period and half the peak-to-peak of l; then the slope of its square, and that of the
period, against α - αc, extrapolated to 0 from the two smallest (error of order (α - αc)²).
"""

import json
import pathlib

import numpy as np
from scipy.optimize import brentq, fsolve

HARMONICS = 12
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def lobes(beta):
    return [(1.0, 0.0), (-beta / 2, -2.0), (-beta / 2, 2.0)]


def slope(y, beta):
    return sum(-a * (y - c) * np.exp(-(y - c) ** 2 / 2) for a, c in lobes(beta))


def curvature(y, beta):
    return sum(a * ((y - c) ** 2 - 1) * np.exp(-(y - c) ** 2 / 2) for a, c in lobes(beta))


def panels(reach=14.0, count=20):
    width = reach / count
    y = np.concatenate([width * (i + 0.5 * (1 + NODES)) for i in range(count)])
    return y, np.tile(0.5 * width * WEIGHTS, count)


Y, W = panels()


def critical(beta, r):
    f2 = curvature(Y, beta) * W

    def mismatch(wave):
        return -r * (f2 @ np.cos(wave * Y)) - (f2 @ np.sin(wave * Y)) / wave
    grid = np.linspace(0.05, 1.6, 200)
    values = [mismatch(w) for w in grid]
    i = next(i for i in range(199) if values[i] * values[i + 1] < 0)
    wave = brentq(mismatch, grid[i], grid[i + 1], xtol=1e-15)
    return -r / (f2 @ np.cos(wave * Y)), r * wave


def cycle(beta, r, alpha, omega, guess):
    k = np.arange(-HARMONICS, HARMONICS + 1)
    theta = 2 * np.pi * np.arange(2 * HARMONICS + 1) / (2 * HARMONICS + 1)
    wave = np.exp(1j * np.outer(theta, k))
    f0 = sum(a * np.exp(-c * c / 2) for a, c in lobes(beta))

    def unpack(v):
        c = np.zeros(2 * HARMONICS + 1, complex)
        c[HARMONICS] = v[0]
        c[HARMONICS + 1] = v[1]  # real: fixes the phase
        c[HARMONICS + 2:] = v[2:2 + HARMONICS - 1] + 1j * v[HARMONICS + 1:2 * HARMONICS]
        c[:HARMONICS] = np.conj(c[:HARMONICS:-1])
        return c, v[-1]

    def residual(v):
        c, w = unpack(v)
        l = (wave @ c).real
        delayed = (wave @ (c[:, None] * np.exp(-1j * np.outer(k, w * Y / r)))).real
        memory = (-alpha * slope(Y + delayed - l[:, None], beta)) @ W / r
        return (wave @ (1j * k * w * c)).real - memory + l

    start = np.zeros(2 * HARMONICS + 1)
    start[0] = alpha * f0 / r
    start[1] = guess
    start[-1] = omega
    v, info, ok, message = fsolve(residual, start, xtol=1e-14, full_output=True)
    assert np.abs(info["fvec"]).max() < 1e-11, message
    c, w = unpack(v)
    upper = c[HARMONICS + 1:]
    j = np.arange(1, HARMONICS + 1)

    def extreme(start):
        """l at the zero of its derivative near `start`."""
        t = start
        for _ in range(20):
            wave_t = upper * np.exp(1j * j * t)
            t -= (1j * j * wave_t).sum().real / (-j * j * wave_t).sum().real
        return c[HARMONICS].real + 2 * (upper * np.exp(1j * j * t)).sum().real
    fine = np.linspace(0, 2 * np.pi, 400)
    l = [(upper * np.exp(1j * j * t)).sum().real for t in fine]
    top, bottom = extreme(fine[np.argmax(l)]), extreme(fine[np.argmin(l)])
    return 2 * np.pi / w, 0.5 * (top - bottom), float(np.abs(info["fvec"]).max())


def main():
    out = {"origin": "onset_reference.py, harmonic balance with 12 harmonics, numpy and scipy", "cases": []}
    for beta, r, guess in [(1.0, 1.0, 0.98), (0.0, 1.0, 1.26), (1.0, 0.3, 2.45), (0.0, 0.3, 2.44), (1.0, 3.0, 0.39), (0.5, 1.0, 0.98)]:
        alpha, omega = critical(beta, r)
        cycles = []
        for step in (1e-2, 1e-3, 1e-4):
            above = step * min(1.0, alpha)
            period, amplitude, residual = cycle(beta, r, alpha + above, omega, guess * np.sqrt(above))
            cycles.append({"above": above, "period": period, "amplitude": amplitude, "residual": residual})
        period = 2 * np.pi / omega
        squares = [c["amplitude"] ** 2 / c["above"] for c in cycles]
        periods = [(c["period"] - period) / c["above"] for c in cycles]
        out["cases"].append({"beta": beta, "r": r, "alpha_c": alpha, "period_c": period, "cycles": cycles,
                             "amplitude_squared_slope": (10 * squares[2] - squares[1]) / 9,
                             "period_slope": (10 * periods[2] - periods[1]) / 9})
        print(beta, r, out["cases"][-1]["amplitude_squared_slope"], out["cases"][-1]["period_slope"])
    path = pathlib.Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(out, indent=1) + "\n")


if __name__ == "__main__":
    main()
