"""Types of what is taken and given. Shapes: samples of a run are (n,), rows of a history (steps, nodes), surfaces are
the shape of t followed by that of x."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, SupportsFloat, TypeAlias, overload

import numpy as np
import numpy.typing as npt

__version__: str
__all__: list[str]

_Array: TypeAlias = npt.NDArray[np.float64]
_Path: TypeAlias = str | os.PathLike[str]
# A number, or its digits.
_Number: TypeAlias = SupportsFloat | str
_Numbers: TypeAlias = _Number | Sequence[SupportsFloat] | npt.NDArray[Any]
# One, evenly (low, high, n), or a list or array of them.
_Values: TypeAlias = _Number | tuple[_Number, _Number, int] | list[float] | npt.NDArray[Any]
# A, T, W of A exp(-(t-T)^2/(2 W^2)).
_Pulse: TypeAlias = tuple[_Number, _Number, _Number]
# _Columns (x, f), a table of rows, a pandas Series or DataFrame, or what a .json file would hold.
_Columns: TypeAlias = Sequence[npt.ArrayLike] | npt.NDArray[Any] | Mapping[str, Any] | Result | Any
# Several of them are a list, for columns are a tuple.
_Data: TypeAlias = _Path | _Columns | list[Any]
_Progress: TypeAlias = bool | Callable[[float | None, str], object] | None

class StickslipWarning(UserWarning): ...

class Record(dict[str, Any]):
    def __getattr__(self, name: str) -> Any: ...
    def __dir__(self) -> list[str]: ...

class Motion(NamedTuple):
    l: Any
    x0: Any
    velocity: Any
    lag: Any

class Picture:
    def __init__(self, document: Any, **view: Any) -> None: ...
    @property
    def svg(self) -> str: ...
    def _repr_svg_(self) -> str: ...
    def save(self, path: _Path) -> None: ...

class Result:
    def __init__(self, document: Any) -> None: ...
    def __getattr__(self, name: str) -> Any: ...
    def __dir__(self) -> list[str]: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def success(self) -> bool: ...
    @property
    def message(self) -> str: ...
    def to_json(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_xarray(self) -> Any: ...
    def save(self, path: _Path) -> None: ...
    def columns(self) -> dict[str, Any]: ...
    def plot(
        self,
        *,
        width: str | None = None,
        dpi: float | None = None,
        x_range: tuple[float, float] | None = None,
        y_range: tuple[float, float] | None = None,
    ) -> Picture: ...

class RunResult(Result):
    @property
    def regime(self) -> str: ...
    @property
    def t(self) -> _Array: ...
    @property
    def l(self) -> _Array | None: ...
    @property
    def lag(self) -> _Array | None: ...
    @property
    def x0(self) -> _Array: ...
    @property
    def velocity(self) -> _Array: ...
    @property
    def period(self) -> float | None: ...
    @property
    def wavelength(self) -> float | None: ...
    @property
    def amplitude_x0(self) -> float | None: ...
    @property
    def amplitude_u(self) -> float | None: ...
    @property
    def span(self) -> tuple[float, float]: ...
    def sol(self, t: npt.ArrayLike) -> Motion: ...
    def surface(self, x: npt.ArrayLike, t: npt.ArrayLike | None = None) -> Any: ...

class CycleResult(Result): ...

class ContinueResult(Result):
    def to_xarray(self) -> list[Any]: ...

class StabilityResult(Result): ...
class BoundaryResult(Result): ...
class ResponseResult(Result): ...
class RasterResult(Result): ...
class SurfaceResult(Result): ...
class SweepResult(Result): ...
class RasterSweepResult(Result): ...

class FitResult(Result):
    @property
    def estimates(self) -> Record: ...

def load(path: _Path) -> Any: ...
def loads(text: str) -> Any: ...
def run(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    until: _Number | None = None,
    start: str | None = None,
    start_position: _Number | None = None,
    kick: _Number | None = None,
    start_velocity: _Number | None = None,
    support_path: _Path | _Columns | None = None,
    noise: _Number | None = None,
    noise_spacing: _Number | None = None,
    seed: _Number | None = None,
    initial_surface: _Path | _Columns | None = None,
    pulse: str | _Pulse | Sequence[_Pulse] | None = None,
    force_file: _Path | _Columns | None = None,
    memory: str | None = None,
    tolerance: _Number | None = None,
    sample_every: _Number | None = None,
    sample_at: _Numbers | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    history: str | None = None,
    plot: _Path | None = None,
    verify: bool = False,
    checkpoint: _Path | None = None,
    checkpoint_every: _Number | None = None,
    resume: _Path | None = None,
    r: _Number | None = None,
    progress: _Progress = None,
) -> RunResult: ...
def surface(
    run: _Path | Result,
    *,
    at: _Numbers | None = None,
    x: _Numbers | None = None,
    range: str | tuple[_Number, _Number] | tuple[_Number, _Number, int] | None = None,
    spacing: _Number | None = None,
    y_range: str | tuple[_Number, _Number] | tuple[_Number, _Number, int] | None = None,
    y: _Numbers | None = None,
    spacing_y: _Number | None = None,
    width_y: _Number | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    far_behind: bool = False,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> SurfaceResult: ...
def stability(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    solve_for: str | None = None,
    pitch: _Number | None = None,
    path: str | None = None,
    width_y: _Number | None = None,
    length: _Number | None = None,
    roots: _Number | None = None,
    re_above: _Number | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> StabilityResult: ...
def boundary(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    r_range: str | tuple[_Number, _Number] | tuple[_Number, _Number, int] | None = None,
    pitch_range: str | tuple[_Number, _Number] | tuple[_Number, _Number, int] | None = None,
    r: _Number | None = None,
    width_y: _Number | None = None,
    length: _Number | None = None,
    points: _Number | None = None,
    logarithmic: bool = False,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    plot_onset: _Path | None = None,
    progress: _Progress = None,
) -> BoundaryResult: ...
def response(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    pulse: str | _Pulse | Sequence[_Pulse] | None = None,
    modes: _Number | None = None,
    until: _Number | None = None,
    start_position: _Number | None = None,
    sample_every: _Number | None = None,
    sample_at: _Numbers | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    r: _Number | None = None,
    progress: _Progress = None,
) -> ResponseResult: ...
def cycle(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    from_: _Path | _Columns | None = None,
    tolerance: _Number | None = None,
    points: _Number | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> CycleResult: ...
def continue_branch(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    from_: _Path | _Columns | None = None,
    tolerance: _Number | None = None,
    over: str | None = None,
    to: _Number | None = None,
    switch: bool = False,
    longest_period: _Number | None = None,
    longest_step: _Number | None = None,
    most_points: _Number | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> ContinueResult: ...
def sweep(
    *,
    tip: str | _Columns | None = None,
    beta: _Values | None = None,
    width: _Values | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Values | None = None,
    alpha: _Values | None = None,
    alpha_above: _Values | None = None,
    depth_limit: _Values | None = None,
    healing_time: _Values | None = None,
    inertia: _Values | None = None,
    no_spring: bool = False,
    until: _Number | None = None,
    start: str | None = None,
    start_position: _Values | None = None,
    kick: _Values | None = None,
    start_velocity: _Values | None = None,
    noise: _Values | None = None,
    noise_spacing: _Values | None = None,
    seed: _Values | None = None,
    tolerance: _Number | None = None,
    threads: _Number | None = None,
    shard: str | tuple[int, int] | None = None,
    if_needed: bool = False,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> SweepResult: ...
@overload
def sweep_merge(
    *parts: RasterSweepResult,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> RasterSweepResult: ...
@overload
def sweep_merge(
    *parts: _Path | SweepResult,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> SweepResult: ...
def sweep_raster(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Values | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    width_y: _Number | None = None,
    pitch: _Values | None = None,
    lines: _Number | None = None,
    length: _Number | None = None,
    path: str | None = None,
    tolerance: _Number | None = None,
    threads: _Number | None = None,
    shard: str | tuple[int, int] | None = None,
    if_needed: bool = False,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> RasterSweepResult: ...
def raster(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    width_y: _Number | None = None,
    area: _Path | _Columns | None = None,
    path: str | None = None,
    pulse: str | _Pulse | Sequence[_Pulse] | None = None,
    memory: str | None = None,
    tolerance: _Number | None = None,
    sample_every: _Number | None = None,
    sample_at: _Numbers | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    r: _Number | None = None,
    pitch: _Number | None = None,
    lines: _Number | None = None,
    length: _Number | None = None,
    progress: _Progress = None,
) -> RasterResult: ...
def tip(
    measured: _Path | _Columns,
    *,
    unit: str | None = None,
    half: bool = False,
    both: bool = False,
    centre: _Number | None = None,
    sigma: _Number | None = None,
    terms: _Number | None = None,
    r: _Number | None = None,
    resamples: _Number | None = None,
    seed: _Number | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> Result: ...
def fit(
    *,
    ripple: _Data | None = None,
    friction: _Data | None = None,
    onsets: _Path | _Columns | None = None,
    wavelengths: _Path | _Columns | None = None,
    height_gain: _Number | None = None,
    force_gain: _Number | None = None,
    unit: str | None = None,
    robust: bool = False,
    scan: str | None = None,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    free: str | Sequence[str] | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    progress: _Progress = None,
) -> FitResult: ...
def compare(
    *,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    until: _Number | None = None,
    start: str | None = None,
    start_position: _Number | None = None,
    kick: _Number | None = None,
    start_velocity: _Number | None = None,
    support_path: _Path | _Columns | None = None,
    noise: _Number | None = None,
    noise_spacing: _Number | None = None,
    seed: _Number | None = None,
    initial_surface: _Path | _Columns | None = None,
    pulse: str | _Pulse | Sequence[_Pulse] | None = None,
    force_file: _Path | _Columns | None = None,
    memory: str | None = None,
    tolerance: _Number | None = None,
    grid: str | None = None,
    spacing: _Number | None = None,
    grid_tolerance: _Number | None = None,
    step: _Number | None = None,
    grid_until: _Number | None = None,
    time_limit: _Number | None = None,
    sample_every: _Number | None = None,
    sample_at: _Numbers | None = None,
    units: _Path | _Columns | None = None,
    sigma: str | None = None,
    stiffness: str | None = None,
    damping: str | None = None,
    velocity: str | None = None,
    slope_force: str | None = None,
    output: _Path | None = None,
    plot: _Path | None = None,
    r: _Number | None = None,
    pitch: _Number | None = None,
    lines: _Number | None = None,
    length: _Number | None = None,
    area: _Path | _Columns | None = None,
    path: str | None = None,
    width_y: _Number | None = None,
    progress: _Progress = None,
) -> Result: ...
def units(
    *,
    damping: str | None = None,
    stiffness: str | None = None,
    tip_width: str | None = None,
    indentation_rate: str | None = None,
    slope_force: str | None = None,
    velocity: str | None = None,
    tip: str | _Columns | None = None,
    beta: _Number | None = None,
    width: _Number | None = None,
    tip_file: _Path | _Columns | None = None,
    r: _Number | None = None,
    alpha: _Number | None = None,
    alpha_above: _Number | None = None,
    depth_limit: _Number | None = None,
    healing_time: _Number | None = None,
    inertia: _Number | None = None,
    no_spring: bool = False,
    output: _Path | None = None,
    progress: _Progress = None,
) -> Result: ...
def verify(
    run: _Path | Result,
    *,
    output: _Path | None = None,
    progress: _Progress = None,
) -> Result: ...
