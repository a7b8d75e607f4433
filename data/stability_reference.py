"""Reference figures for linear stability, computed with mpmath at 40 digits.

Writes stability_reference.json beside this file. Needs mpmath (1.4.1 was used). Independent of the Rust
code: f'' is integrated by mpmath's adaptive quadrature on the real line, nothing is taken from the
closed forms in terms of the error function. Figures are printed to 30 digits, as strings. Takes
a few minutes.

    critical   αc, ω on (42), (43); every Ω on a scan, the smallest α kept
    roots      roots Λ of (30) polished from the starts listed, λ = rΛ
    lobes      the same for side lobes of height 5e-9, all with Re Λ > -10.9, by Newton's method at 80
               digits: f'' e^{-Λy} is of size e^{60} there
    trapping   1/max_p(p ∫e^{-ps}(-f'(s))ds)
    erfcx      erfcx(x + iy) = e^{z²} erfc(z), Re z ≥ 0, on a grid that covers every branch of the
               Faddeeva algorithm, both axes included
"""

import json
import pathlib

from mpmath.calculus.quadrature import GaussLegendre
from mpmath import diff, erfc, exp, findroot, mp, mpc, mpf, nstr, pi, quad, sqrt

mp.dps = 40
FIGURES = 30


def show(v):
    return nstr(v, FIGURES, min_fixed=0, max_fixed=0)


def curvature(beta, width):
    """f'' of (48) at x/width."""
    def bell(z):
        return (z * z - 1) * exp(-z * z / 2)

    def f2(y):
        z = y / width
        return (bell(z) - beta / 2 * (bell(z + 2) + bell(z - 2))) / width**2
    return f2


def transform(beta, width):
    f2 = curvature(beta, width)
    stops = [k * width for k in (0, 1, 2, 3, 4, 6, 8, 11, 15, 20)]

    def g(lam):
        return quad(lambda y: f2(y) * exp(-lam * y), stops)
    return g


def critical(beta, width, r):
    g = transform(beta, width)

    def mismatch(wave):
        v = g(mpc(0, wave))
        return r * -v.real + v.imag / wave

    # Fifteen figures are plenty for a scan.
    mp.dps = 15
    grid = [mpf(k) / 25 / width for k in range(1, 120)]
    values = [mismatch(w) for w in grid]
    starts = [(grid[i], grid[i + 1]) for i in range(len(grid) - 1) if values[i] * values[i + 1] < 0]
    mp.dps = 40
    best = None
    for a, b in starts:
        wave = findroot(mismatch, (a, b), solver="anderson", tol=mpf(10)**-35)
        cosine = -g(mpc(0, wave)).real
        if cosine > 0 and (best is None or r / cosine < best[0]):
            best = (r / cosine, r * wave)
    return best


def critical_r(beta, width, alpha, start):
    g = transform(beta, width)

    def mismatch(wave):
        v = g(mpc(0, wave))
        return alpha * v.real**2 + v.imag / wave
    wave = findroot(mismatch, start, tol=mpf(10)**-60)
    cosine = -g(mpc(0, wave)).real
    return alpha * cosine, alpha * cosine * wave


def roots(beta, width, alpha, r, starts):
    g = transform(beta, width)
    found = []
    for start in starts:
        lam = findroot(lambda s: r * s + 1 + alpha / r * g(s), mpc(*start), tol=mpf(10)**-50)
        found.append(lam)
    found.sort(key=lambda z: -z.real)
    return [r * z for z in found]


def lobes(beta, alpha, r, starts):
    """Roots by Newton's method from f'' at the Gauss-Legendre nodes of panels of length 1."""
    mp.dps = 80
    f2 = curvature(mpf(beta), mpf(1))
    half = mpf(1) / 2
    rule = [(half * (1 + x), half * w) for x, w in GaussLegendre(mp).calc_nodes(6, mp.prec)]
    nodes = [(k + x, w * f2(k + x)) for k in range(32) for x, w in rule]
    found = []
    for start in starts:
        lam = mpc(*start)
        for _ in range(12):
            terms = [(y, w * exp(-lam * y)) for y, w in nodes]
            h = r * lam + 1 + alpha / mpf(r) * sum(term for _, term in terms)
            step = h / (r - alpha / mpf(r) * sum(y * term for y, term in terms))
            lam -= step
            if abs(step) < mpf(10)**-25 * abs(lam):
                break
        else:
            raise ArithmeticError(f"no root from {start}")
        found.append(lam)
    mp.dps = 40
    found.sort(key=lambda z: -z.real)
    return [r * z for z in found]


def trapping(beta, width):
    g = transform(beta, width)
    p = findroot(lambda p: diff(lambda q: g(q), p), mpf(1) / width)
    return -1 / g(p), p


def main():
    out = {"origin": "stability_reference.py, mpmath, 40 digits", "critical": [], "critical_r": [],
           "roots": [], "lobes": [], "trapping": [], "erfcx": []}
    half = 1 / sqrt(mpf(2))
    cases = [(b, 1, r) for b in ("0", "0.3", "1") for r in ("0.01", "1", "100")]
    cases += [("0", half, "1")]
    for beta, width, r in cases:
        alpha, omega = critical(mpf(beta), mpf(width), mpf(r))
        out["critical"].append({"beta": float(beta), "width": float(width), "r": float(r),
                                "alpha": show(alpha), "omega": show(omega)})
    r, omega = critical_r(mpf(1), mpf(1), mpf(1), mpf("0.95"))
    out["critical_r"].append({"beta": 1.0, "width": 1.0, "alpha": 1.0, "r": show(r), "omega": show(omega)})
    # Starts rounded to two figures; that no root is missing is not for this table to say.
    cases = [("1", "1.2", "1", [(0.05, 0.92), (-0.58, 0), (-1.1, 2.8), (-1.9, 3.8), (-2.6, 4.6), (-3.2, 5.3)]),
             ("0", "1.5", "1", [(-0.11, 0.78), (-1.9, 3.0), (-3.0, 3.9), (-3.9, 4.7), (-4.6, 5.3)]),
             ("1", "0.2", "0.3", [(0.01, 1.2), (-0.68, 0), (-1.1, 3.0), (-1.9, 4.0), (-2.6, 4.7), (-3.2, 5.4)])]
    for beta, alpha, r, starts in cases:
        found = roots(mpf(beta), mpf(1), mpf(alpha), mpf(r), starts)
        out["roots"].append({"beta": float(beta), "alpha": float(alpha), "r": float(r),
                             "lambda": [[show(z.real), show(z.imag)] for z in found]})
    starts = [(-0.29, 0.79), (-1.96, 2.89), (-3.09, 3.85), (-3.94, 4.6), (-4.65, 5.25), (-5.27, 5.82),
              (-5.83, 6.35), (-6.34, 6.83), (-6.81, 7.28), (-7.25, 7.7), (-7.67, 8.1), (-8.06, 8.48),
              (-8.44, 8.84), (-8.81, 9.18), (-9.19, 9.5), (-9.55, 9.91), (-9.56, 0), (-9.56, 3.14),
              (-9.56, 6.28), (-9.56, 9.43), (-9.82, 10.26), (-10.09, 10.57), (-10.36, 10.87),
              (-10.61, 11.15), (-10.86, 11.43)]
    out["lobes"].append({"beta": 1e-8, "alpha": 1.0, "r": 1.0,
                         "lambda": [[show(z.real), show(z.imag)] for z in lobes("1e-8", 1, 1, starts)]})
    for beta in ("0", "1"):
        threshold, p = trapping(mpf(beta), mpf(1))
        out["trapping"].append({"beta": float(beta), "threshold": show(threshold), "p": show(p)})
    for x in (0, 1e-9, 1e-4, 0.01, 0.3, 1, 2.5, 4, 6, 8, 12, 40, 1000):
        for y in (0, 1e-9, 1e-4, 0.02, 0.5, 1, 2, 3.5, 5.5, 6.2, 7, 9, 15, 30, 300):
            z = mpc(mpf(x), mpf(y))
            mp.dps = 60
            value = exp(z * z) * erfc(z) if abs(z) < 300 else None
            mp.dps = 40
            if value is None:
                value = asymptotic(z)
            out["erfcx"].append([x, y, show(value.real), show(value.imag)])
    path = pathlib.Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(out, indent=1) + "\n")


def asymptotic(z):
    """erfcx for |z| ≥ 300: (1/(z√π)) Σ (-1)^n (2n-1)!!/(2z²)^n."""
    term = total = mpc(1)
    for n in range(1, 30):
        term *= -(2 * n - 1) / (2 * z * z)
        total += term
    return total / (z * sqrt(pi))


if __name__ == "__main__":
    main()
