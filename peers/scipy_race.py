"""SciPy's solve_ivp on the paper's grid: x0 and u(x_j), all of them advanced at every stage.

Reads the case from the file named on the command line, prints its rows as JSON.
"""

import json
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erfc

# The paper's spacing, and the others of our grids; the paper's steps.
SPACINGS, LONGEST_STEP = (0.001, 0.0018, 0.01), 0.04
RIGHT = 471.0  # the tip ends at 455
STEPS = 10  # run, the rest extrapolated
REACH = 10.8  # f is below 1e-17 beyond


def triple_gaussian(x):
    """(48), beta = 1."""
    bell = lambda x: np.exp(-x * x / 2)
    return bell(x) - (bell(x + 2) + bell(x - 2)) / 2


def tail(x):
    """∫_x^∞ f"""
    bell = lambda x: np.sqrt(np.pi / 2) * erfc(x / np.sqrt(2))
    return bell(x) - (bell(x + 2) + bell(x - 2)) / 2


def right_hand_side(case, x, spacing, windowed):
    """Of (10), (11); `windowed` evaluates f only within its reach, the rest of the rates being 0."""
    alpha, r, pulse = case["alpha"], case["r"], case["pulse"]

    def rates(t, state):
        x0, u = state[0], state[1:]
        j = int(x0 / spacing)
        s = x0 / spacing - j
        slope = ((1 - s) * (u[j + 1] - u[j - 1]) + s * (u[j + 2] - u[j])) / (2 * spacing)
        z = (t - pulse["time"]) / pulse["width"]
        near = slice(*np.searchsorted(x, [x0 - REACH, x0 + REACH])) if windowed else slice(None)
        result = np.zeros_like(state)
        result[0] = -slope + r * t - x0 + pulse["amplitude"] * np.exp(-z * z / 2)
        result[1:][near] = -alpha * triple_gaussian(x[near] - x0)
        return result

    return rates


def race(case, spacing, windowed):
    x = spacing * np.arange(int(RIGHT / spacing) + 1)
    surface = -(case["alpha"] / case["r"]) * tail(x - case["start_position"])
    start = np.concatenate([[case["start_position"]], surface])
    short, span = STEPS * LONGEST_STEP, case["until"] - case["start"]
    seconds = []
    for _ in range(2):
        clock = time.process_time()
        # Steps are as long as allowed from the first on, so the time is in proportion to the span.
        solve_ivp(
            right_hand_side(case, x, spacing, windowed), (case["start"], case["start"] + short), start,
            method="RK45", t_eval=[case["start"] + short], max_step=LONGEST_STEP, first_step=LONGEST_STEP,
        )  # fmt: skip
        seconds.append(time.process_time() - clock)
    return {
        "contestant": "SciPy solve_ivp RK45",
        "setting": f"dx {spacing}, dt {LONGEST_STEP}, f on {'its reach' if windowed else 'all cells'}",
        "seconds": min(seconds) * span / short,
        "error": None,  # that of our grid (b), the same scheme
        "span": span,
        "remark": f"time extrapolated from {STEPS} steps; error that of (b), the same scheme",
    }


def main():
    with open(sys.argv[1]) as file:
        case = json.load(file)["case"]
    json.dump([race(case, spacing, windowed) for spacing in SPACINGS for windowed in (False, True)], sys.stdout)


if __name__ == "__main__":
    main()
