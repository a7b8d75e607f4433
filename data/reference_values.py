# /// script
# requires-python = ">=3.10"
# dependencies = ["mpmath==1.4.1", "numpy"]
# ///
"""Reference values to 30 digits, computed without any code of this project.

    python3 -m venv VENV && VENV/bin/pip install mpmath==1.4.1 numpy
    VENV/bin/python data/reference_values.py > data/reference_values.json

Equation numbers are the paper's; docs/explanation/equation.md derives the formulas. Whatever has a closed form is
checked here against quadrature of its definition; numpy only starts the Newton iteration for the limit
cycle. The run takes about a minute (Python 3.11, gmpy2 installed beside mpmath or not).
"""

import json
import sys

import mpmath
import numpy as np
from mpmath import mp, mpc, mpf

DIGITS = 30
mp.dps = DIGITS + 15
VALUES = {}


def record(name, value, origin):
    VALUES[name] = {"value": mpmath.nstr(value, DIGITS, strip_zeros=False), "origin": origin}


class Gaussians:
    """f(x) = sum of a exp(-(x-c)^2/(2 w^2))."""

    def __init__(self, *terms):
        self.terms = [tuple(mpf(v) for v in term) for term in terms]

    def f(self, x):
        return sum(a * mpmath.exp(-(((x - c) / w) ** 2) / 2) for a, c, w in self.terms)

    def slope(self, x):
        return sum(-a * (x - c) / w**2 * mpmath.exp(-(((x - c) / w) ** 2) / 2) for a, c, w in self.terms)

    def curvature(self, x):
        z = lambda c, w: (x - c) / w
        return sum(a * (z(c, w) ** 2 - 1) / w**2 * mpmath.exp(-z(c, w) ** 2 / 2) for a, c, w in self.terms)

    def fourier(self, q):
        root = mpmath.sqrt(2 * mpmath.pi)
        return sum(a * w * root * mpmath.exp(-((q * w) ** 2) / 2) * mpmath.cos(q * c) for a, c, w in self.terms)

    def transform(self, L):
        """G(L), the Laplace transform of f'' that stands in (30)."""
        half = mpmath.sqrt(mpmath.pi / 2)
        laplace = sum(
            a * w * half * mpmath.exp((L * w) ** 2 / 2 - c * L) * mpmath.erfc((L * w**2 - c) / (w * mpmath.sqrt(2)))
            for a, c, w in self.terms
        )
        return L * L * laplace - L * self.f(mpf(0))

    def transform_by_quadrature(self, L):
        return mpmath.quad(lambda y: self.curvature(y) * mpmath.exp(-L * y), range(0, 22, 2))


TRIPLE = Gaussians((1, 0, 1), (mpf(-1) / 2, -2, 1), (mpf(-1) / 2, 2, 1))
GAUSSIAN = Gaussians((1, 0, 1))
NARROW = Gaussians((1, 0, 1 / mpmath.sqrt(2)))
TIPS = {"triple_gaussian": TRIPLE, "gaussian": GAUSSIAN, "narrow_gaussian": NARROW}


def crossings(tip, mismatch, upto=9, samples=400):
    """All Omega in (0, upto) where the mismatch of c = -int f'' cos and s = int f'' sin / Omega vanishes."""

    def g(W):
        G = tip.transform(mpc(0, W))
        return mismatch(-G.real, -G.imag / W)

    grid = [mpf(upto) * (i + 1) / samples for i in range(samples)]
    coarse = [g(W) for W in grid]
    pairs = [(a, b) for a, b, u, v in zip(grid, grid[1:], coarse, coarse[1:]) if u * v < 0]
    found = [mpmath.findroot(g, pair, solver="anderson") for pair in pairs]
    return [(W, -tip.transform(mpc(0, W)).real) for W in found]


def critical(name, r):
    tip, r = TIPS[name], mpf(r)
    W, c = max(crossings(tip, lambda c, s: r * c - s), key=lambda crossing: crossing[1])
    alpha = r / c
    residual = r * mpc(0, W) + 1 + alpha / r * tip.transform_by_quadrature(mpc(0, W))
    assert abs(residual) < mpf(10) ** -DIGITS, residual
    key = f"critical.{name}.r_{mpmath.nstr(r, 3)}"
    origin = "(42), (43), the crossing of smallest alpha; residual of (30) by quadrature below 1e-30"
    record(f"{key}.alpha", alpha, origin)
    record(f"{key}.omega", r * W, origin + "; omega = r Omega")
    record(f"{key}.amplitude_ratio", alpha / r * W * tip.fourier(W), "(37): |A_u|/|A_x0| = (alpha_c/r) q f^(q), q = omega/r")
    return alpha


def critical_points():
    for name in TIPS:
        for r in ("0.5", "1.0", "2.0"):
            critical(name, r)
    alpha = mpf(1)
    W, c = max(crossings(TRIPLE, lambda c, s: alpha * c * c - s), key=lambda crossing: crossing[1])
    r, origin = alpha * c, "(42), (43) at alpha = 1, the crossing of largest r"
    assert abs(r * mpc(0, W) + 1 + alpha / r * TRIPLE.transform_by_quadrature(mpc(0, W))) < mpf(10) ** -DIGITS
    record("critical.triple_gaussian.alpha_1.r", r, origin)
    record("critical.triple_gaussian.alpha_1.omega", r * W, origin)
    record("critical.triple_gaussian.alpha_1.period", 2 * mpmath.pi / (r * W), origin + "; 2 pi/omega")
    record("critical.triple_gaussian.alpha_1.wavelength", 2 * mpmath.pi / W, origin + "; 2 pi r/omega")
    for r in (mpf(1), mpf(2)):
        W = mpmath.sqrt((mpmath.sqrt(1 + 4 * r * r) - 1) / (2 * r * r))
        residual = r * mpc(0, W) + 1 - r * (mpc(0, W) + W * W / mpmath.sqrt(1 - W * W))
        assert abs(residual) < mpf(10) ** -DIGITS
        key = f"critical.bessel.r_{mpmath.nstr(r, 3)}"
        record(f"{key}.alpha", r * r, "alpha_c = r^2; residual of (44) below 1e-30")
        record(f"{key}.omega", r * W, "r times Omega, the root that (47) prints; residual of (44) below 1e-30")


def creep(name):
    """Q(p) = p int e^{-ps} (-f'(s)) ds = -G(p): its maximum, and where it is r/alpha."""
    tip = TIPS[name]
    Q = lambda p: -tip.transform(p)
    p = mpf("0.7")
    assert abs(Q(p) - p * mpmath.quad(lambda s: -tip.slope(s) * mpmath.exp(-p * s), range(0, 22, 2))) < mpf(10) ** -DIGITS
    top = mpmath.findroot(lambda p: mpmath.diff(Q, p), mpf("1.2"))
    record(f"trapping.{name}.alpha_over_r", 1 / Q(top), "1/max_p Q(p)")
    record(f"trapping.{name}.p", top, "argmax_p Q(p)")
    record(f"trapping.{name}.curvature", mpmath.diff(Q, top, 2), "Q''(p) there")
    for ratio in (3, 4):
        for which, ends in (("shallow", (mpf("0.05"), top)), ("steep", (top, mpf(3 * ratio)))):
            root = mpmath.findroot(lambda p: ratio * Q(p) - 1, ends, solver="anderson")
            record(f"trapping.{name}.alpha_over_r_{ratio}.{which}", root, "Q(p) = r/alpha")


def roots():
    """The four rightmost roots of (30) for the triple Gaussian, r = 1, and a count that says so."""
    for label, alpha in (("1", mpf(1)), ("critical_plus_0.01", mpf(VALUES["critical.triple_gaussian.r_1.0.alpha"]["value"]) + mpf("0.01"))):
        h = lambda L: L + 1 + alpha * TRIPLE.transform(L)
        lead = mpmath.findroot(h, mpc(0, "0.94"))
        line = lead.real - mpf("0.05")
        corners = [mpc(line, -12), mpc(8, -12), mpc(8, 12), mpc(line, 12), mpc(line, -12)]
        points = [a + (b - a) * i / 400 for a, b in zip(corners, corners[1:]) for i in range(400)]
        values = [h(z) for z in points]
        turns = sum(mpmath.arg(v / u) for u, v in zip(values, values[1:] + values[:1])) / (2 * mpmath.pi)
        assert abs(turns - 2) < mpf("1e-9"), turns
        origin = "root of (30), closed-form transform; with its conjugate the only roots right of Re - 0.05 (argument principle)"
        record(f"root.triple_gaussian.alpha_{label}.re", lead.real, origin)
        record(f"root.triple_gaussian.alpha_{label}.im", lead.imag, origin)


def transforms():
    for name, tip in TIPS.items():
        for re, im in (("0.3", "0.7"), ("-1.5", "2"), ("6", "-11")):
            L = mpc(re, im)
            value = tip.transform(L)
            assert abs(value - tip.transform_by_quadrature(L)) < mpf(10) ** -DIGITS
            record(f"transform.{name}.at_{re}_{im}.re", value.real, "int_0^oo f''(y) e^{-Ly} dy, closed form = quadrature")
            record(f"transform.{name}.at_{re}_{im}.im", value.imag, "int_0^oo f''(y) e^{-Ly} dy, closed form = quadrature")


def footprints():
    record("footprint.triple_gaussian.value_at_0", TRIPLE.f(mpf(0)), "(48) at beta = 1: 1 - e^-2")
    for name, tip in TIPS.items():
        integral = mpmath.quad(tip.f, range(-20, 22, 2))
        assert abs(integral - tip.fourier(mpf(0))) < mpf(10) ** -DIGITS
        record(f"footprint.{name}.integral", tip.fourier(mpf(0)), "int f, closed form = quadrature")
    half = Gaussians((1, 0, 1), (mpf(-1) / 4, -2, 1), (mpf(-1) / 4, 2, 1))
    record("footprint.triple_gaussian_beta_0.5.integral", mpmath.quad(half.f, range(-20, 22, 2)), "int of (48) at beta = 1/2, quadrature")
    for x in (1, 10, 50):
        inner = mpmath.quad(lambda t: mpmath.besselj(0, t), mpmath.linspace(0, x, 1 + max(1, x)))
        record(f"footprint.bessel.tail_{x}", 1 - inner, "int_x^oo J0 = 1 - int_0^x J0, quadrature")


class Cycle:
    """l(t) = a0 + sum a_k cos(k w t) + b_k sin(k w t), b_1 = 0, solving (18) for the triple Gaussian, r = 1."""

    HARMONICS = 36

    def __init__(self, alpha):
        self.alpha = alpha
        nodes = gauss_legendre(26)
        self.tau = [2 * panel + 1 + x for panel in range(8) for x, _ in nodes]
        self.weight = [w for _ in range(8) for _, w in nodes]

    def unpack(self, z):
        K = self.HARMONICS
        return z[0], list(z[1 : K + 1]), [0 * z[0]] + list(z[K + 1 : 2 * K]), z[2 * K]

    def start(self, omega, amplitude):
        z = np.zeros(2 * self.HARMONICS + 1)
        z[0], z[1], z[-1] = float(self.alpha * TRIPLE.f(mpf(0))), amplitude, omega
        return z

    def residual64(self, z):
        a0, a, b, w = self.unpack(z)
        K, M = self.HARMONICS, 2 * self.HARMONICS + 1
        a, b, k = np.array(a), np.array(b), np.arange(1, K + 1)
        tau, weight = np.array(self.tau, float), np.array(self.weight, float)
        t = 2 * np.pi / w * np.arange(M) / M
        l = lambda t: a0 + np.cos(np.multiply.outer(t, k * w)) @ a + np.sin(np.multiply.outer(t, k * w)) @ b
        velocity = -np.sin(np.outer(t, k * w)) @ (a * k * w) + np.cos(np.outer(t, k * w)) @ (b * k * w)
        x = tau[None, :] + l(t[:, None] - tau[None, :]) - l(t)[:, None]
        slope = sum(-float(A) * (x - float(c)) * np.exp(-((x - float(c)) ** 2) / 2) for A, c, _ in TRIPLE.terms)
        return velocity + l(t) + float(self.alpha) * slope @ weight

    def jacobian64(self, z):
        columns = []
        for j in range(len(z)):
            e = np.zeros(len(z))
            e[j] = 1e-6
            columns.append((self.residual64(z + e) - self.residual64(z - e)) / 2e-6)
        return np.array(columns).T

    def residual(self, z):
        a0, a, b, w = self.unpack(z)
        K, M = self.HARMONICS, 2 * self.HARMONICS + 1
        coefficients = [(x - mpc(0, 1) * y) for x, y in zip(a, b)]

        def l(phase):
            """a0 + Re sum c_k e^{ik phase}, by Horner's rule."""
            e = mpmath.expj(phase)
            total = mpc(0)
            for c in reversed(coefficients):
                total = (total + c) * e
            return a0 + total.real

        result = []
        for i in range(M):
            phase = 2 * mpmath.pi * i / M
            here = l(phase)
            velocity = sum(k * w * (y * mpmath.cos(k * phase) - x * mpmath.sin(k * phase)) for k, x, y in zip(range(1, K + 1), a, b))
            memory = sum(q * TRIPLE.slope(tau + l(phase - w * tau) - here) for tau, q in zip(self.tau, self.weight))
            result.append(velocity + here + self.alpha * memory)
        self.l = l
        return result

    def solve(self, z):
        for _ in range(30):
            step = np.linalg.solve(self.jacobian64(z), self.residual64(z))
            z = z - step
            if abs(step).max() < 1e-12:
                break
        inverse = np.linalg.inv(self.jacobian64(z))
        z = [mpf(v) for v in z]
        for _ in range(8):
            residual = self.residual(z)
            size = max(abs(v) for v in residual)
            if size < mpf(10) ** -(DIGITS + 4):
                return z
            scaled = np.array([float(v / size) for v in residual])
            z = [v - size * mpf(d) for v, d in zip(z, inverse @ scaled)]
        raise RuntimeError(f"the cycle did not converge: {size}")


def gauss_legendre(n):
    """Nodes and weights on [-1, 1], to working precision."""
    result = []
    for guess in np.polynomial.legendre.leggauss(n)[0]:
        x = mpmath.findroot(lambda x: mpmath.legendre(n, x), mpf(guess))
        slope = n * (x * mpmath.legendre(n, x) - mpmath.legendre(n - 1, x)) / (x * x - 1)
        result.append((x, 2 / ((1 - x * x) * slope**2)))
    return result


def limit_cycle():
    key = "cycle.triple_gaussian.r_1.alpha_critical_plus_0.01"
    alpha = mpf(VALUES["critical.triple_gaussian.r_1.0.alpha"]["value"]) + mpf("0.01")
    cycle = Cycle(alpha)
    z = cycle.solve(cycle.start(0.9387, 0.196))
    w = z[-1]
    origin = "Fourier collocation of (18), 36 harmonics, residual at the nodes below 1e-34"
    top = mpmath.findroot(lambda p: mpmath.diff(cycle.l, p), mpf("0.0"))
    low = mpmath.findroot(lambda p: mpmath.diff(cycle.l, p), mpf("3.14"))
    last = max(abs(v) for v in (z[Cycle.HARMONICS], z[2 * Cycle.HARMONICS - 1]))
    assert last < mpf(10) ** -(DIGITS + 1), last
    record(f"{key}.period", 2 * mpmath.pi / w, origin)
    record(f"{key}.amplitude_x0", abs(cycle.l(top) - cycle.l(low)) / 2, origin + "; half peak-to-peak of l")

    def ripple(x, function):
        """-alpha int f(x - x0(t)) dt by the trapezoidal rule: exponentially accurate here."""
        h = mpf("0.125")
        times = [h * i for i in range(-120, 121)]
        return -alpha * h * sum(function(x - (t - 1 - cycle.l(w * t))) for t in times)

    extrema = [mpmath.findroot(lambda x: ripple(x, TRIPLE.slope), mpf(guess)) for guess in guesses(ripple)]
    heights = [ripple(x, TRIPLE.f) for x in extrema]
    record(f"{key}.amplitude_u", (max(heights) - min(heights)) / 2, origin + "; half peak-to-peak of (35)")


def guesses(ripple):
    """Coarse places of the highest and lowest point of the ripple."""
    grid = [mpf(i) * mpf("0.35") - 4 for i in range(20)]
    heights = [ripple(x, TRIPLE.f) for x in grid]
    return grid[heights.index(max(heights))], grid[heights.index(min(heights))]


def main():
    footprints()
    critical_points()
    transforms()
    roots()
    creep("triple_gaussian")
    creep("gaussian")
    limit_cycle()
    document = {
        "format": "stickslip/reference-values",
        "software": {"python": "data/reference_values.py", "mpmath": mpmath.__version__, "working_digits": mp.dps},
        "note": "triple_gaussian is (48) with beta = 1; gaussian is exp(-x^2/2); narrow_gaussian is exp(-x^2)",
        "values": VALUES,
    }
    json.dump(document, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
