"""A run just above onset, its surface, and what a tip of your own does.

python first_steps.py
"""

import numpy as np

import stickslip

onset = stickslip.stability(r=1).critical
print(f"stick-slip sets in at alpha = {onset.alpha:.6f}, with period {onset.period:.4f}")

run = stickslip.run(alpha_above=0.1, r=1, kick=0.05, until=400)
print(run.message)
x = np.linspace(350, 399, 981)
print(f"ripples of {np.ptp(run.surface(x)) / 2:.3f} k sigma^2/a")
run.plot().save("run.svg")

# Any even footprint, sampled at x >= 0.
x = np.linspace(0, 6, 241)
own = stickslip.run(tip=(x, np.exp(-(x**2) / 2) * np.cos(x)), alpha=1.4, r=1, kick=0.05, until=200)
print(own.message)
