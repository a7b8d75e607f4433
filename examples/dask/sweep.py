"""A phase diagram on a Dask cluster: the parts of a sweep are tasks, and a task that is lost with its worker is done
again elsewhere. Byte for byte what one process would give.

    python sweep.py                           on this machine
    python sweep.py tcp://scheduler:8786      on a cluster whose workers have stickslip installed
"""

import sys
from typing import Any

from distributed import Client

import stickslip


def part(index: int, of: int, grid: dict[str, Any]) -> stickslip.SweepResult:
    """One part of the grid, on one thread: Dask has the others."""
    return stickslip.sweep(**grid, shard=(index, of), threads=1)


def sweep(client: Client, parts: int, **grid: Any) -> stickslip.SweepResult:
    """The whole of it, in so many tasks: some ten for each worker, so that the costly ones are shared out."""
    tasks = client.map(part, range(1, parts + 1), of=parts, grid=grid)
    computed: list[stickslip.SweepResult] = client.gather(tasks)
    return stickslip.sweep_merge(*computed)


if __name__ == "__main__":
    with Client(*sys.argv[1:2]) as client:
        found = sweep(client, 20, r=(0.1, 2, 40), alpha=(0.05, 4, 40))
        found.save("map.json")
        found.plot().save("map.svg")
        print(found.message)
