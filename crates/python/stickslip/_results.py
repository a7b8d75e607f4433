"""Results of the commands: documents of the program, with fields as attributes and numbers as arrays."""

import json
import os
import re
from collections import namedtuple

from . import _native
from ._picture import Animation, Picture
from ._records import Record, recorded

Motion = namedtuple("Motion", "l x0 velocity lag")
Motion.__doc__ = """The motion at given times, arrays of the shape of the times: l = rt - r - x0, x0 and the lag R - x0 in sigma, the
velocity in k sigma/Gamma; NaN if the support does not define a quantity."""


class Result:
    """A document of the program. Its fields, named as in its JSON Schema (``stickslip schema``), are attributes:
    structs are dicts with attributes, sequences of numbers are read-only arrays of float64, with NaN for null."""

    def __init__(self, document):
        self._document = document
        self._fields = {}

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._fields:
            if name not in self._document.names():
                raise AttributeError(f"there is no {name}: there are {', '.join(self._document.names())}")
            self._fields[name] = recorded(self._document.field(name))
        return self._fields[name]

    def __dir__(self):
        return sorted({*super().__dir__(), *self._document.names()})

    @property
    def success(self):
        """Whether the computation was completed."""
        return not ("interrupted" in self._document.names() and self.interrupted)

    @property
    def message(self):
        """The result in one line."""
        return self._document.headline

    def to_json(self):
        """The JSON text of the document, as the program writes it."""
        return self._document.json()

    def to_dict(self):
        """The document as dicts, lists and numbers."""
        return json.loads(self.to_json())

    def save(self, path):
        """Writes the document to a .json file, as the program does."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lower()
        if ending in (".csv", ".npz", ".jsonl", ".gsf"):
            remedy = f"give output={path!r} to the function that computes it"
            raise ValueError(f"save writes JSON: name the file .json, or {remedy}")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_json() + "\n")

    def columns(self):
        """The table of the document: arrays by name, with NaN for missing values; columns of words are lists."""
        return self._document.columns()

    def plot(self, *, width=None, dpi=None, x_range=None, y_range=None):
        """The picture that ``stickslip plot`` draws: width such as "85mm", dots per inch, first and last abscissa and
        ordinate."""
        view = {"width": width, "dpi": dpi, "x_range": x_range, "y_range": y_range}
        return Picture(self._document, **view)

    def animate(self, *, times=None, seconds=None, fps=None, width=None):
        """The animation that ``stickslip plot`` makes of a run or a raster: first and last time shown in Gamma/k,
        duration in seconds (10), frames per second (20), and width such as "640px"."""
        film = {"times": times, "seconds": seconds, "fps": fps, "width": width}
        return Animation(self._document, **film)

    def to_xarray(self):
        """The table as an xarray Dataset over its first column, with the parameters as attributes."""
        columns = self.columns()
        return dataset(self, columns, next(iter(columns), None), physical(self))

    def __repr__(self):
        text = self._document.text.rstrip("\n")
        return text or f"{type(self).__name__} {self.format}"

    def __reduce__(self):
        return loads, (self.to_json(),)


class RunResult(Result):
    """A run. t, l, x0, velocity and lag are arrays of the samples, without copies; l or lag is None if the support
    does not define it."""

    @property
    def regime(self):
        """"steady", "stick-slip", "trapped", "drifting" or "transient"."""
        return self.__getattr__("regime")

    @property
    def t(self):
        """Times of the samples, in Gamma/k."""
        return self.samples["t"]

    @property
    def l(self):  # noqa: E743
        """l = rt - r - x0 at the samples, in sigma."""
        return self.samples.get("l")

    @property
    def lag(self):
        """R - x0 at the samples, in sigma: the lateral force, in k sigma."""
        return self.samples.get("lag")

    @property
    def x0(self):
        """Position of the tip at the samples, in sigma."""
        return self.samples["x0"]

    @property
    def velocity(self):
        """x0' at the samples, in k sigma/Gamma."""
        return self.samples["velocity"]

    def _of_oscillation(self, name):
        return None if self.oscillation is None else self.oscillation[name]

    @property
    def period(self):
        """Period of stick-slip, in Gamma/k; None in other regimes."""
        return self._of_oscillation("period")

    @property
    def wavelength(self):
        """Wavelength of the ripples, in sigma; None in other regimes."""
        return self._of_oscillation("wavelength")

    @property
    def amplitude_x0(self):
        """Amplitude of x0 about uniform motion, half peak-to-peak, in sigma; None in other regimes."""
        return self._of_oscillation("amplitude_x0")

    @property
    def amplitude_u(self):
        """Amplitude of the ripples, half peak-to-peak, in k sigma^2/a; None in other regimes."""
        return self._of_oscillation("amplitude_u")

    def sol(self, t):
        """The dense solution at times t within the run, scalar or of any shape: a :class:`Motion`.

        Accurate to the tolerance of the run at all times, not only at its samples. ValueError outside of the run, or if the
        history was omitted."""
        import numpy as np

        times = np.asarray(t, dtype=float)
        rows = self._document.motion(np.ascontiguousarray(times).reshape(-1))
        return Motion(*(row.reshape(times.shape)[()] for row in rows))

    @property
    def span(self):
        """First and last time of the dense solution, in Gamma/k."""
        return self._document.span()

    def surface(self, x, t=None):
        """The surface u(x,t), in k sigma^2/a, at positions x, in sigma, and times t within the run [default: its end]:
        an array of the shape of t followed by that of x."""
        import numpy as np

        x = np.asarray(x, dtype=float)
        t = np.asarray(self.span[1] if t is None else t, dtype=float)
        places = [np.ascontiguousarray(of).reshape(-1) for of in (x, t)]
        return self._document.heights(*places).reshape(t.shape + x.shape)[()]

    def to_xarray(self):
        """The samples as an xarray Dataset over t."""
        return dataset(self, self.samples, "t", physical(self, "samples"))


class CycleResult(Result):
    """A cycle: period, wavelength, amplitudes, profile, floquet multipliers, stable."""

    def to_xarray(self):
        """The profile as an xarray Dataset over t."""
        return dataset(self, self.columns(), "t", physical(self, "profile"))


class ContinueResult(Result):
    """Branches of cycles, and the special points on them."""

    def to_xarray(self):
        """A list of Datasets, one for each branch, over the number of the point."""
        there = physical(self, "branches")
        return [dataset(self, branch, None, there[i] if there else {}) for i, branch in enumerate(self.branches)]


class StabilityResult(Result):
    """Linear theory at a point: critical, stable, roots with their certificate, trapping, onset."""

    def to_xarray(self):
        """The growth exponents as an xarray Dataset over their number; of a raster the growth of ripples over q."""
        columns = self.columns()
        if "re" not in columns:
            return dataset(self, columns, next(iter(columns), None), physical(self, "growth"))
        roots = physical(self, "roots")
        there = {name: [root[name] for root in roots] for name in roots[0]} if roots else {}
        return dataset(self, columns, None, there)


class BoundaryResult(Result):
    """The boundary of steady motion: alpha over r."""


class ResponseResult(Result):
    """The linear response to pulses, as a sum of modes."""

    def to_xarray(self):
        """The samples as an xarray Dataset over t."""
        return dataset(self, self.samples, "t", physical(self, "samples"))


class RasterResult(Result):
    """Lines scanned over one surface, and their pattern."""

    def to_xarray(self):
        """The samples as an xarray Dataset over line and sample, with the y of each line; shorter lines end with NaN."""
        import numpy as np
        import xarray

        there = physical(self, "lines")
        lines = [with_units(line["samples"], there[i].get("samples", {}) if there else {}) for i, line in enumerate(self.lines)]
        longest = max((len(line["t"][0]) for line in lines), default=0)
        data = {}
        for name in lines[0] if lines else []:
            rows = [np.asarray(line[name][0], dtype=float) for line in lines]
            rows = [np.pad(row, (0, longest - len(row)), constant_values=np.nan) for row in rows]
            data[name] = (("line", "sample"), np.array(rows), lines[0][name][1])
        ys = [with_units({"y": [line["y"]]}, {f"y_{k}": [v] for k, v in units_of("y", there[i] if there else {}).items()}) for i, line in enumerate(self.lines)]
        data["y"] = ("line", np.array([y["y"][0][0] for y in ys]), ys[0]["y"][1] if ys else {})
        return xarray.Dataset(data, attrs=attributes(self)).set_coords([name for name in ("t", "y") if name in data])


class SurfaceResult(Result):
    """Surfaces u(x,t) of a run, or u(x,y)."""

    def to_xarray(self):
        """u as an xarray DataArray over t and x, or t, y and x."""
        import xarray

        name = "surfaces" if len(self.surfaces) else "images"
        there = physical(self, name)
        found = [with_units(dict(one), there[i] if there else {}) for i, one in enumerate(getattr(self, name))]
        u = [one["u"][0] for one in found]
        over = {dim: found[0][dim] for dim in ("t", "y", "x") if dim in found[0]}
        if "t" in over:
            over["t"] = ([one["t"][0] for one in found], over["t"][1])
        else:
            u = u[0]
        coords = {dim: (dim, values, unit) for dim, (values, unit) in over.items()}
        return xarray.DataArray(u, coords=coords, dims=tuple(over), name="u", attrs={**attributes(self), **found[0]["u"][1]})


class LoadMapResult(Result):
    """Ripples over load and velocity, and the critical load."""

    def to_xarray(self):
        """An xarray Dataset over load, in nN, and velocity."""
        import numpy as np
        import xarray

        columns = with_units(self.columns(), {})
        n = len(self.velocity)
        velocity = with_units({"velocity": self.velocity}, physical(self))["velocity"]
        coords = {"load": ("load", columns["load_nN"][0][::n], {"units": "nN"}), "velocity": ("velocity", *velocity)}
        there = physical(self, "points")
        data = {}
        for name in ("alpha", "regime", "wavelength", "width"):
            values, unit = columns[name]
            # Points without ripples have no wavelength.
            known = next(filter(None, (units_of(name, point) for point in there or [])), {})
            if known:
                (suffix, _), = known.items()
                values, unit = [point.get(f"{name}_{suffix}", np.nan) for point in there], {"units": in_words(suffix)}
            data[name] = (("load", "velocity"), np.asarray(values).reshape(-1, n), unit)
        data["critical_load"] = ("velocity", np.asarray(columns["critical_load_nN"][0][:n]), {"units": "nN"})
        return xarray.Dataset(data, coords=coords, attrs=attributes(self))


class SweepResult(Result):
    """The motion that the tip settles into, over a grid: ``columns()`` has a row for each point."""

    def to_xarray(self):
        """An xarray Dataset over the axes of the grid; points of other parts are NaN."""
        parameters = self.parameters
        alphas = "alpha" if parameters.get("alpha") is not None else "alpha_above"
        axes = {name: parameters.get(name) for name in ("width", "beta", "r", alphas)}
        axes.update((axis.name.replace("-", "_"), axis["values"]) for axis in parameters.get("axes", []))
        return grid(self, {name: values for name, values in axes.items() if values is not None})


class RasterSweepResult(Result):
    """The pattern of rasters over pitch and alpha: ``columns()`` has a row for each point."""

    def to_xarray(self):
        """An xarray Dataset over pitch and alpha; points of other parts are NaN."""
        return grid(self, {name: self.parameters[name] for name in ("pitch", "alpha")})


class FitResult(Result):
    """Parameters of the model, fitted to measured data."""

    @property
    def estimates(self):
        """By name, the value of each fitted number with its 95 % interval (low, high); a bound is None if the data have none."""
        if "numbers" not in self._document.names():
            # The fit of an image.
            return Record((name, getattr(self, name)) for name in ("alpha", "r", "wavelength", "crest_angle", "amplitude"))
        return Record((number.name, number.estimate) for number in self.numbers)


KINDS = {
    "stickslip/run": RunResult,
    "stickslip/cycle": CycleResult,
    "stickslip/continue": ContinueResult,
    "stickslip/stability": StabilityResult,
    "stickslip/boundary": BoundaryResult,
    "stickslip/response": ResponseResult,
    "stickslip/raster": RasterResult,
    "stickslip/surface": SurfaceResult,
    "stickslip/raster-surface": SurfaceResult,
    "stickslip/load-map": LoadMapResult,
    "stickslip/sweep": SweepResult,
    "stickslip/raster-sweep": RasterSweepResult,
    "stickslip/fit": FitResult,
    "stickslip/fit-image": FitResult,
}


def result_of(document):
    """The result of the class that belongs to the format of a document."""
    return KINDS.get(document.field("format"), Result)(document)


def load(path):
    """The result in a .json file, written by the program or by :meth:`Result.save`.

    ValueError if the file cannot be read or is not a document."""
    return result_of(_native.load(os.fspath(path)))


def loads(text):
    """The result in a JSON text."""
    return result_of(_native.read(text))


def dataset(result, columns, over, there=None):
    """Columns of equal length as a Dataset over one of them, or over the row; in nm, s and nN if `there` contains them."""
    import numpy as np
    import xarray

    columns = {name: column for name, column in columns.items() if column is not None and np.asarray(column).ndim == 1}
    dim = over or "point"
    data = {name: (dim, np.asarray(column), unit) for name, (column, unit) in with_units(columns, there or {}).items()}
    return xarray.Dataset(data, attrs=attributes(result)).set_coords([over] if over else [])


def attributes(result):
    """The parameters of a result that are numbers or texts; NetCDF has no truth values."""
    parameters = result.parameters.items()
    kept = {name: value for name, value in parameters if isinstance(value, (int, float, str))}
    return {name: int(value) if isinstance(value, bool) else value for name, value in kept.items()}


# The unit at the end of a name, such as nm_per_s.
UNIT = re.compile(r"(?:(?:nN|nm|s)\d?(?:_(?:nN|nm|s)\d?)*)?(?:_?per_(?:nN|nm|s)\d?)*")


def physical(result, part=None):
    """The numbers of a document, or of a part of it, in nm, s and nN, by names with units; empty without scales."""
    there = result._document.field("physical") if "physical" in result._document.names() else None
    there = recorded(there) if there is not None else {}
    return there if part is None else there.get(part, {})


def units_of(name, there):
    """The values in nm, s and nN of the number of this name, by the suffix of its unit."""
    found = {key[len(name) + 1 :]: value for key, value in there.items() if key.startswith(name + "_")}
    return {suffix: value for suffix, value in found.items() if suffix and UNIT.fullmatch(suffix)}


def in_words(suffix):
    """``nm/s`` of ``nm_per_s``."""
    return suffix.replace("_per_", "/").replace("per_", "1/").replace("_", " ")


def with_units(columns, there):
    """Each column with its attributes: the values in nm, s or nN with their unit if they exist."""
    found = {}
    for name, column in columns.items():
        if name == "lateral_force":
            continue
        known = units_of(name, there)
        suffix = next(iter(known), None)
        found[name] = (column, {}) if suffix is None else (known[suffix], {"units": in_words(suffix)})
    return found


def grid(result, axes):
    """The points of a sweep over its axes."""
    import numpy as np
    import xarray

    shape = tuple(len(values) for values in axes.values())
    places = np.array([point["index"] for point in result.points])
    # The numbers of a raster are those of its pattern.
    data, there = {}, [{**point, **point.get("pattern", {})} for point in physical(result, "points")]
    for name, column in result.columns().items():
        if name in axes:
            continue
        suffix = next((suffix for point in there for suffix in units_of(name, point)), None)
        if suffix is not None:
            column = [point.get(f"{name}_{suffix}") for point in there]
        column = np.asarray([np.nan if value is None else value for value in column])
        empty = np.full(shape, "" if column.dtype.kind == "U" else np.nan, dtype=column.dtype)
        empty.reshape(-1)[places] = column
        data[name] = (tuple(axes), empty, {} if suffix is None else {"units": in_words(suffix)})
    coords = {name: (name, *values) for name, values in with_units(axes, physical(result, "axes")).items()}
    return xarray.Dataset(data, coords=coords, attrs=attributes(result))
