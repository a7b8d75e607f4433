"""examples/dask on a cluster of this machine, a worker of which is killed: the bytes of one process."""

import os
import signal
import sys
import threading
import time

import pytest
from conftest import ROOT

import stickslip

distributed = pytest.importorskip("distributed")

GRID = dict(r=(0.4, 2, 30), alpha=(0.5, 4, 60))


def test_a_sweep_survives_the_loss_of_a_worker(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "examples" / "dask")
    import sweep as example

    # Workers are processes of their own, which import the example as this one does.
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT / "examples" / "dask"), *sys.path]))
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            first = set(client.run(os.getpid).values())
            killed = []

            def kill_one():
                # Once a few parts are there.
                while not any(client.who_has().values()):
                    time.sleep(0.01)
                os.kill(min(first), signal.SIGKILL)
                killed.append(min(first))

            killer = threading.Thread(target=kill_one)
            killer.start()
            found = example.sweep(client, 40, **GRID)
            killer.join()
    assert killed
    assert found.to_json() == stickslip.sweep(**GRID).to_json()
