"""heyoka on the embedded system: Taylor series, compiled just in time, for who knows the exponentials.

Reads what `race embedded` wrote from the file named on the command line, prints rows as JSON: for each motion and error
asked the setting that took least time, of two ways to write the system down, of the exponentials fitted about that error,
and of tolerances around it; compilation apart. Batches go side by side in the lanes of the machine.
"""

import json
import sys
import time

import heyoka as hy
import numpy as np

TARGETS = (1e-6, 1e-9, 1e-11)
# Of ensembles, whose error is taken where each motion ends.
TARGETS_OF_ENSEMBLE = (1e-6, 1e-9)
FORMS = ("shared", "folded")
# Of the error asked: which exponentials, in digits more, and the tolerances tried.
FITS = (-1, 0, 1)
DECADES = (0.5, 0, -0.5, -1, -1.5)
# Options of the compiler: faster than its own choice.
OPTIONS = {"fast_math": True, "slp_vectorize": True}


def system(terms, r, form):
    """(l, re Z, im Z, ...) for Z' = c + s v Z and v = alpha Re sum (w/c) Z + l + r, alpha a parameter.

    "shared": c = 1. The products v x and v y stand as such: heyoka expands each once for both equations that have it, which takes
    a fifth to a quarter less time than v (re x - im y). "folded": c = w besides, so that the slope is a plain sum; a tenth less
    again, but large weights then count in its control of errors.
    """
    lag = hy.make_vars("l")
    states, slope = [], []
    for i, (_, wave, re, im) in enumerate(terms):
        names = [f"x{i}", f"y{i}"] if wave else [f"x{i}"]
        states.append([hy.make_vars(name) for name in names])
        slope += states[-1][:1] if form == "folded" else [w * z for w, z in zip((re, -im), states[-1])]
    velocity = hy.par[0] * hy.sum(slope) + lag + r
    equations = [(lag, r - velocity)]
    for (re, im, *weight), z in zip(terms, states):
        source = weight if form == "folded" else (1.0, 0.0)
        products = [velocity * part for part in z]
        x, y = products if im else (products[0], 0.0)
        rates = (source[0] + re * x - im * y, source[1] + re * y + im * x)
        equations += zip(z, rates)
    return equations


def start(terms, motion, form):
    """Steady motion for ever, then the kick."""
    state = [motion["l0"] + motion["kick"]]
    for re, im, *weight in terms:
        s = complex(re, im)
        z = -np.exp(-s * motion["kick"]) / (s * motion["r"])
        z *= complex(*weight) if form == "folded" else 1.0
        state += [z.real, z.imag] if im else [z.real]
    return state


def timed(work, seconds=1.0):
    """The least processor time of as many runs as so many seconds allow, three to 1,000."""
    best, begun, count = np.inf, time.perf_counter(), 0
    while count < 3 or (time.perf_counter() - begun < seconds and count < 1000):
        before = time.process_time()
        work()
        best = min(best, time.process_time() - before)
        count += 1
    return best


def solver(terms, motion, tolerance, form):
    """Compiled afresh; and how long that took."""
    hy.llvm_state.clear_memcache()
    before = time.process_time()
    integrator = hy.taylor_adaptive(
        system(terms, motion["r"], form), start(terms, motion, form), tol=tolerance, pars=[motion["alpha"]], **OPTIONS
    )
    return integrator, time.process_time() - before


def once(integrator, state, motion):
    integrator.time = motion["start"]
    integrator.state[:] = state
    integrator.pars[0] = motion["alpha"]
    integrator.propagate_until(motion["until"])


def error(integrator, state, motion):
    integrator.time = motion["start"]
    integrator.state[:] = state
    integrator.pars[0] = motion["alpha"]
    times = np.minimum(np.array(motion["t"]), motion["until"])
    found = integrator.propagate_grid(times)[-1][:, 0]
    return float(np.max(np.abs(found - motion["l"])))


def settings(document, target):
    """Exponentials fitted about the error asked, tolerances around it, both forms."""
    finest = document["fits"][-1]["digits"]
    for digits in sorted({min(round(-np.log10(target)) + index, finest) for index in FITS}):
        fit = next(fit for fit in document["fits"] if fit["digits"] == digits)
        for decade in DECADES:
            for form in FORMS:
                yield fit, max(target * 10.0**decade, 1e-15), form


def fastest(candidates, target):
    """Of rows with their work, those that err no more than asked: the three that seemed fastest are timed at length."""
    able = [(timed(work, 0.05), row, work) for row, work in candidates if row["error"] <= target]
    able.sort(key=lambda one: one[0])
    rows = [{**row, "target": target, "seconds": timed(work)} for _, row, work in able[:3]]
    for row in rows:
        print(row, file=sys.stderr)
    return min(rows, key=lambda row: row["seconds"])


def described(motion, terms, tolerance, form, what, compiling, miss):
    return {
        "contestant": "heyoka",
        "motion": motion,
        "setting": f"{len(terms)} exponentials, {form}, tolerance {tolerance:.1e}, {what}",
        "compiling": compiling,
        "error": miss,
    }


def scalar(document):
    rows, compiled = [], {}

    def candidate(motion, fit, tolerance, form):
        key, terms = (fit["digits"], tolerance, form), fit["terms"]
        if key not in compiled:
            compiled[key] = solver(terms, motion, tolerance, form)
        integrator, compiling = compiled[key]
        state = start(terms, motion, form)
        miss = error(integrator, state, motion)
        row = described(motion["name"], terms, tolerance, form, f"order {integrator.order}", compiling, miss)
        return row, lambda: once(integrator, state, motion)

    for motion in document["motions"]:
        for target in TARGETS:
            candidates = (candidate(motion, *setting) for setting in settings(document, target))
            rows.append(fastest(candidates, target))
    return rows


def side_by_side(document, lanes, fit, tolerance, form):
    """The ensemble: as many at a time as lanes, one batch after the other, on one core."""
    terms = fit["terms"]
    ensemble = document["ensemble"]
    motion = next(motion for motion in document["motions"] if motion["name"] == ensemble["motion"])
    alphas = np.linspace(ensemble["from"], ensemble["to"], ensemble["count"])
    hy.llvm_state.clear_memcache()
    before = time.process_time()
    states = np.array([start(terms, motion, form)] * lanes).T
    integrator = hy.taylor_adaptive_batch(
        system(terms, motion["r"], form), states, tol=tolerance, pars=[[motion["alpha"]] * lanes], **OPTIONS
    )
    compiling = time.process_time() - before
    ends = np.empty_like(alphas)

    def work():
        for i in range(0, len(alphas), lanes):
            some = alphas[i : i + lanes]
            # The steady lag is proportional to alpha.
            lags = motion["l0"] * some / motion["alpha"]
            # X + r + l over r: each starts when its support is there.
            integrator.set_time(motion["start"] + (lags - motion["l0"]) / motion["r"])
            integrator.state[:] = states
            integrator.state[0] = lags + motion["kick"]
            integrator.pars[0] = some
            integrator.propagate_until(np.full(lanes, motion["until"]))
            ends[i : i + lanes] = integrator.state[0]

    work()
    miss = float(np.max(np.abs(ends - ensemble["l_at_end"])))
    return described("ensemble", terms, tolerance, form, f"{lanes} lanes", compiling, miss), work


def batch(document):
    recommended = hy.recommended_simd_size()

    def candidates(target):
        for lanes in (recommended, 2 * recommended):
            for setting in settings(document, target):
                yield side_by_side(document, lanes, *setting)

    return [fastest(candidates(target), target) for target in TARGETS_OF_ENSEMBLE]


def main():
    # What it compiled in an earlier race is to count again.
    hy.llvm_state.set_diskcache_enabled(False)
    with open(sys.argv[1]) as file:
        document = json.load(file)
    json.dump(scalar(document) + batch(document), sys.stdout)


if __name__ == "__main__":
    main()
