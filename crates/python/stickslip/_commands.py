"""The functions of the package: each is a command of the program, with the options of the command as keyword arguments."""

from ._call import call
from ._options import options, signature
from ._results import (
    BoundaryResult,
    ContinueResult,
    CycleResult,
    FitResult,
    RasterResult,
    RasterSweepResult,
    ResponseResult,
    Result,
    RunResult,
    StabilityResult,
    SurfaceResult,
    SweepResult,
)


def command(*path, returns=Result):
    """Decorator: the function of a command, with the docstring of the decorated function."""

    def made(described):
        taken = signature(path, returns)

        def function(*args, progress=None, **given):
            if args:
                bound = taken.bind_partial(*args)
                given = {**bound.arguments, **given}
            return call(path, given, progress)

        function.__name__ = function.__qualname__ = described.__name__
        function.__module__ = "stickslip"
        function.__doc__ = f"{described.__doc__.rstrip()}\n\n{listed(path)}"
        function.__signature__ = taken
        function.__stickslip__ = path
        return function

    return made


def listed(path):
    """The options of a command, for its docstring."""
    lines = ["Options, as in `stickslip " + " ".join(path) + " --help`:", ""]
    for name, option in options(path).items():
        lines.append(f"{name}: {option.value or 'True or False'}")
        lines.append(f"    {option.help}")
    lines.append("progress: True, or a function of the part done (None if the end is not known) and of a text")
    lines.append("    Shows a bar of tqdm, or calls the function.")
    return "\n".join(lines)


@command("run", returns=RunResult)
def run():
    """Integrates l'(t) = -alpha int_0^inf f'(r tau + l(t-tau) - l(t)) dtau - l(t) - F_ext(t), and classifies the motion.

    Returns a :class:`RunResult`: t, l, x0, velocity of shape (samples,), the dense solution ``sol(t)``, ``surface(x, t)``,
    regime, period, amplitudes. Ctrl-C stops it; the ``result`` of the KeyboardInterrupt is the run so far.
    tip is a name, or a footprint of your own: columns (x, f), a table of rows, a pandas Series or DataFrame, or
    {"gaussians": [{"amplitude": 1, "center": 0, "width": 1}]}."""


@command("surface", returns=SurfaceResult)
def surface():
    """Reconstructs the surface u(x,t), in k sigma^2/a, from a run, or u(x,y) from a raster; results or .json files.

    ``surfaces`` has t, x and u of shape (len(x),) for each time, ``images`` u of shape (len(y), len(x)).
    :meth:`RunResult.surface` gives the array alone."""


@command("stability", returns=StabilityResult)
def stability():
    """Linear theory: the critical point, all growth exponents lambda of r Lambda + 1 = -(alpha/r) int f'' exp(-Lambda y) dy,
    Lambda = lambda/r, with a certificate that none is missing, trapping, onset."""


@command("boundary", returns=BoundaryResult)
def boundary():
    """The curve alpha_c(r) between steady motion and stick-slip."""


@command("response", returns=ResponseResult)
def response():
    """The linear response to weak pulses as a sum of modes: ``samples.t``, ``samples.l`` of shape (samples,)."""


@command("cycle", returns=CycleResult)
def cycle():
    """The periodic motion at given alpha and r, stable or not, with its Floquet multipliers, solved for directly.

    ``profile.t``, ``profile.l`` of shape (points,); period in Gamma/k, wavelength and amplitudes in sigma."""


@command("continue", returns=ContinueResult)
def continue_branch():
    """A branch of cycles in alpha or r, through folds, with period doublings located and followed.

    ``branches`` have alpha, r, period, amplitude_x0 and stable of shape (points,); ``special`` the special points."""


@command("sweep", returns=SweepResult)
def sweep():
    """The motion that the tip settles into, at each point of a grid. A tuple (low, high, n) gives n values at even distances, a
    list or array its values.

    ``to_xarray()`` is a Dataset over the axes. With output=FILE finished points are written at once, and the same call resumes
    after an interrupt."""


@command("sweep", "merge")
def sweep_merge():
    """Merges the parts of a sweep or a sweep_raster, results or .json files in any order, into the result of the whole sweep."""


@command("sweep", "raster", returns=RasterSweepResult)
def sweep_raster():
    """The pattern of a raster over pitch and alpha; ``to_xarray()`` is a Dataset over these."""


@command("raster", returns=RasterResult)
def raster():
    """An area scanned line by line: ``lines`` with their samples, and the ``pattern`` of ripples."""


@command("tip")
def tip():
    """A footprint from a measured profile, which may be noisy, tilted, off centre and in nanometres: a file or columns (x, z).
    The column names of a DataFrame may contain units.

    ``gaussians`` is f with f(0) = 1, ``sigma`` its width; ``low`` and ``high`` of each estimate bound a 95 % interval. The
    result is a tip: ``run(tip=stickslip.tip("pit.csv"), ...)``."""


@command("fit", returns=FitResult)
def fit():
    """alpha, r and sigma from measured data, by comparison with the limit cycle of l(t) at alpha and r. Data are files, columns
    (x, z) of shape (rows,), or DataFrames, whose column names may contain units. A list is several data of the same kind; columns
    are a tuple.

    ``estimates`` has value, low and high (95 %, by profile likelihood) of each number by its name: alpha and r
    dimensionless, width sigma in the unit of the data. ``correlations`` has the shape (numbers, numbers), ``data`` compares each of
    the data with the model, and ``remarks`` are warnings to read before the result is used.

    ``image`` is an image of ripples: a .gsf file, a Dataset of :func:`stickslip.open`, or one of its channels. Its width and
    pitch are numbers in nm, or text such as "30nm"; ``profile`` is the mean ripple and that of the model."""


@command("friction")
def friction():
    """Friction forces and work of a loop of lateral force, in nN and fJ where the units are known: files or columns (x, force)
    of trace and retrace, or one of three columns (x, trace, retrace); or a run whose support returns, or two runs.

    ``kinetic``, ``mean``, ``static_peak``, ``hysteresis``, ``work``, ``offset`` and ``stiffness`` have value, low and high
    (95 %)."""


@command("compare")
def compare():
    """The same run on the full PDE, on grids of four kinds: ``max_difference``, times, and both motions."""


@command("units")
def units():
    """From damping, stiffness, tip width, indentation rate, velocity, with their units as text such as "20nm", to alpha and
    r, and back."""


@command("verify")
def verify():
    """Checks a saved run: repeats it with another memory and a tighter tolerance. RuntimeError if the difference is too large,
    with the check as its ``result``."""


__all__ = [name for name, value in globals().items() if hasattr(value, "__stickslip__")]
