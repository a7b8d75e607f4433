"""A long run holds nobody up: other threads run on, Ctrl-C stops it, progress is told."""

import subprocess
import sys
import threading
import time

import numpy as np

import stickslip

LONG = dict(alpha=1.2, r=1, kick=0.05, tolerance=1e-6, history="none", sample_every=1e3)


def test_other_threads_run_on_beside_a_long_run():
    # Had the run the interpreter to itself, the other thread would come to its first look after the run.
    looks, done = [], threading.Event()

    def look():
        while not done.is_set():
            looks.append(len(looks))
            time.sleep(1e-3)

    # A stretch of a million steps and more.
    other = threading.Thread(target=look)
    other.start()
    before = len(looks)
    run = stickslip.run(until=1e6, **LONG)
    during = len(looks) - before
    done.set()
    other.join()
    assert run.work.steps > 1_000_000, run.work.steps
    assert during > 100, during


def test_runs_side_by_side_do_not_mix():
    alphas = [0.8, 1.1, 1.2, 1.3, 1.5, 4.0]
    alone = [stickslip.run(alpha=a, r=1, kick=0.05, until=200).to_dict()["samples"] for a in alphas]
    together = [None] * len(alphas)

    def one(i):
        together[i] = stickslip.run(alpha=alphas[i], r=1, kick=0.05, until=200).to_dict()["samples"]

    threads = [threading.Thread(target=one, args=(i,)) for i in range(len(alphas))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


INTERRUPTED = """
import os, signal, threading, time
import stickslip
# Ctrl-C, once the run is well under way.
def press(part, counted):
    if not pressed:
        pressed.append(counted)
        os.kill(os.getpid(), signal.SIGINT)
pressed = []
try:
    {call}
except KeyboardInterrupt as error:
    {then}
    print("stopped")
"""


def interrupted(call, then):
    text = INTERRUPTED.format(call=call, then=then)
    # The run would take hours: the limit is no measurement, but keeps a test that fails from going on.
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=120)
    assert done.stdout.split()[-1:] == ["stopped"], done.stderr


def test_ctrl_c_stops_a_run_and_what_was_computed_is_there():
    call = "stickslip.run(alpha=1.2, r=1, until=1e9, history='none', sample_every=1e5, progress=press)"
    interrupted(call, "assert error.result.interrupted and not error.result.success and len(error.result.t) > 0")


def test_ctrl_c_stops_a_sweep():
    interrupted("stickslip.sweep(r=(0.1, 2, 1000), alpha=(0.05, 4, 1000), progress=press)", "pass")


def test_ctrl_c_leaves_no_grid_marching():
    call = "stickslip.compare(alpha=1.2, r=1, until=20, grid='uniform', spacing=1e-3, step=1e-5, time_limit=1e9, progress=press)"
    # Hours of work: what goes on by itself shows in the processor's time.
    interrupted(call, "used = time.process_time(); time.sleep(1); assert time.process_time() - used < 0.3")


def test_progress_is_told_and_what_it_raises_stops_the_run():
    seen = []
    stickslip.sweep(r=(0.5, 1.5, 5), alpha=(0.5, 2, 20), progress=lambda part, counted: seen.append((part, counted)))
    assert all(0 <= part <= 1 and counted.endswith("of 100 points") for part, counted in seen)
    assert seen, "a sweep that takes so long is looked at"

    class Enough(Exception):
        pass

    def enough(part, counted):
        raise Enough(counted)

    try:
        stickslip.run(alpha=1.2, r=1, until=1e9, history="none", sample_every=1e5, progress=enough)
    except Enough as error:
        assert "t = " in str(error)
    else:
        raise AssertionError("it went on")


def test_importing_loads_neither_numpy_nor_what_it_can_do_without():
    text = (
        "import sys, stickslip; "
        "print([name for name in ('numpy', 'xarray', 'pandas', 'matplotlib', 'tqdm') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
    assert np.__version__
