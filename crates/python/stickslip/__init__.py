"""Stick-slip of an AFM tip on a soft surface: one closed delay equation instead of a PDE.

The commands of the program are functions. Keyword arguments are its options, with underscores for hyphens, and results are
bit for bit those of the program. All quantities are dimensionless: lengths in tip widths sigma, times in Gamma/k, forces in
k sigma, heights in k sigma^2/a.

>>> import stickslip
>>> run = stickslip.run(alpha=1.2, r=1, kick=0.05, until=400)
>>> run.regime, round(run.period, 6)
('stick-slip', 7.06736)
>>> run.sol(100.0).l.shape, run.surface([60, 61]).shape
((), (2,))
"""

from . import _commands
from ._call import run_many
from ._commands import *  # noqa: F403
from ._instruments import open  # noqa: A004
from ._picture import Animation, Picture
from ._records import Record
from ._results import (
    BoundaryResult,
    ContinueResult,
    CycleResult,
    FitResult,
    LoadMapResult,
    Motion,
    RasterResult,
    RasterSweepResult,
    ResponseResult,
    Result,
    RunResult,
    StabilityResult,
    SurfaceResult,
    SweepResult,
    load,
    loads,
)
from ._warning import StickslipWarning

__version__ = "0.2.0"

# Without `open`: a star import leaves that of Python alone.
__all__ = sorted([
    *_commands.__all__,
    "Animation",
    "BoundaryResult",
    "ContinueResult",
    "CycleResult",
    "FitResult",
    "LoadMapResult",
    "Motion",
    "Picture",
    "RasterResult",
    "RasterSweepResult",
    "Record",
    "ResponseResult",
    "Result",
    "RunResult",
    "StabilityResult",
    "StickslipWarning",
    "SurfaceResult",
    "SweepResult",
    "load",
    "loads",
    "run_many",
])
