"""Results: their shapes, what they share with SciPy's, and what they keep from being changed."""

import pickle

import numpy as np
import pytest

import stickslip


@pytest.fixture(scope="module")
def run():
    return stickslip.run(alpha=1.2, r=1, kick=0.05, until=200, sample_every=0.5)


def test_samples_have_no_copies_and_cannot_be_written_to(run):
    assert run.t is run.t and run.t.dtype == np.float64
    # The memory is that in which Rust recorded the run.
    assert not run.t.flags.owndata and type(run.t.base).__name__ == "PySliceContainer"
    with pytest.raises(ValueError, match="read-only"):
        run.x0[0] = 0.0


def test_the_dense_solution_goes_through_the_samples(run):
    # The ends of steps are rounded to a document once: 16 roundings of numbers of the size of x0.
    slack = 16 * np.finfo(float).eps * np.abs(run.x0).max()
    found = run.sol(run.t)
    for name in ("l", "x0", "velocity", "lag"):
        sizes = np.abs(getattr(found, name) - getattr(run, name))
        assert sizes.max() <= slack * (50 if name == "velocity" else 1), name
    assert run.sol(100.0).l.shape == () and run.sol([[100.0], [101.0]]).x0.shape == (2, 1)
    with pytest.raises(ValueError, match="outside of the run"):
        run.sol(1e6)


def test_a_run_without_history_has_no_dense_solution():
    with pytest.raises(ValueError, match="history: it was left out"):
        stickslip.run(alpha=1.2, r=1, until=40, history="none").sol(30)


def test_success_and_message_are_there_as_in_scipy(run):
    assert run.success is True
    assert run.message.startswith("stick-slip, period 7.0673")
    assert "amplitude of x0" in repr(run)


def test_what_has_no_value_is_nan_or_none():
    path = ([0, 20, 40], [0, 20, 0])
    loop = stickslip.run(alpha=0.8, r=1, support_path=path, until=40)
    assert loop.l is None and loop.lag is not None
    assert np.isnan(loop.sol(10.0).l) and np.isfinite(loop.sol(10.0).lag)
    assert loop.period is None


def test_results_are_pickled_and_copied_whole(run):
    again = pickle.loads(pickle.dumps(run))
    assert again.to_json() == run.to_json() and np.array_equal(again.l, run.l)


def test_pictures_are_those_of_the_program(run, tmp_path):
    picture = run.plot(x_range=(100, 150))
    assert picture.svg.startswith("<svg") and picture._repr_svg_() == picture.svg
    for ending, beginning in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
        picture.save(tmp_path / f"run.{ending}")
        assert (tmp_path / f"run.{ending}").read_bytes().startswith(beginning)
    with pytest.raises(ValueError, match="there is no picture of it"):
        stickslip.units(alpha=1, r=1, damping="1mNs/m", stiffness="0.05N/m", tip_width="20nm", slope_force="5nN").plot().svg


def test_datasets_hold_axes_and_parameters(run):
    xarray = pytest.importorskip("xarray")
    samples = run.to_xarray()
    assert np.array_equal(samples["l"].values, run.l) and samples["t"].dims == ("t",)
    assert samples.attrs["alpha"] == 1.2
    surface = stickslip.surface(run, at=[150, 200], range=(140, 160, 11)).to_xarray()
    assert isinstance(surface, xarray.DataArray) and surface.dims == ("t", "x") and surface.shape == (2, 11)
    swept = stickslip.sweep(r=(0.8, 1.2, 3), alpha=(0.5, 4, 8)).to_xarray()
    assert dict(swept.sizes) == {"r": 3, "alpha": 8}
    place = swept.sel(r=1.0, alpha=0.5)
    assert place["regime"].item() == "steady" and np.isnan(place["period"].item())
    part = stickslip.sweep(r=(0.8, 1.2, 3), alpha=(0.5, 4, 8), shard=(1, 5)).to_xarray()
    assert (part["regime"].values != "").sum() == 5


def test_a_column_without_numbers_is_one_of_numbers():
    pytest.importorskip("xarray")
    steady = stickslip.sweep(r=1, alpha=(0.5, 0.6, 2))
    assert steady.columns()["period"].dtype == float
    assert steady.to_xarray()["period"].dtype == float and np.isnan(steady.to_xarray()["period"].values).all()


def test_each_name_is_listed_once(run):
    for found in (run, run.parameters):
        assert len(dir(found)) == len(set(dir(found)))
    assert "regime" in dir(run) and "alpha" in dir(run.parameters)


def test_an_ensemble_is_a_dataset_over_its_seeds():
    pytest.importorskip("xarray")
    runs = stickslip.sweep(r=1, alpha=[1.0, 1.2], width=[0.8, 1.0], kick=0.1, until=40, noise=1e-2, seed=(1, 4, 4))
    data = runs.to_xarray()
    assert dict(data.sizes) == {"width": 2, "r": 1, "alpha": 2, "seed": 4}
    for point in runs.points:
        place = data.sel(width=point.width, r=1, alpha=point.alpha, seed=point.at[0])
        assert place["deviation_l"].item() == point.deviation_l
    first = data["deviation_l"].isel(width=0, r=0, alpha=0).values
    told = runs.ensembles[0].deviation_l
    assert np.isclose(first.mean(), told.mean, rtol=1e-14) and np.isclose(first.std(ddof=1), told.deviation, rtol=1e-12)


def test_parts_of_a_sweep_merge_to_the_whole():
    parts = [stickslip.sweep(r=1, alpha=(1, 2, 5), shard=(i, 2)) for i in (2, 1)]
    assert stickslip.sweep_merge(*parts).to_json() == stickslip.sweep(r=1, alpha=(1, 2, 5)).to_json()


def test_parts_of_a_sweep_of_rasters_merge_and_are_a_dataset_over_pitch_and_alpha():
    pytest.importorskip("xarray")
    grid = dict(tip="gaussian", r=1, pitch=(0.5, 1, 2), alpha=(0.3, 0.9, 3), lines=8, length=15)
    whole = stickslip.sweep_raster(**grid)
    parts = [stickslip.sweep_raster(**grid, shard=(i, 2)) for i in (2, 1)]
    assert stickslip.sweep_merge(*parts).to_json() == whole.to_json()
    data = whole.to_xarray()
    assert dict(data.sizes) == {"pitch": 2, "alpha": 3}
    place = data.isel(pitch=1, alpha=1)
    assert place["critical_alpha"].item() == whole.points[4].critical_alpha and place["alpha"].item() == whole.points[4].alpha


def test_units_and_stability_have_their_fields():
    found = stickslip.stability(r=1)
    assert abs(found.critical.alpha - 1.0690361749) < 1e-10 and found.critical["omega"] == found.critical.omega
    with pytest.raises(AttributeError, match="there is no critcal: there are .*critical"):
        found.critcal
    with pytest.raises(AttributeError, match="there is no alfa"):
        found.critical.alfa


def test_many_runs_are_those_of_run_within_their_tolerance():
    questions = [{"alpha": alpha, "r": 1, "kick": 0.05, "until": 80, "sample_every": 1} for alpha in (0.9, 1.1, 1.2)]
    questions.append({**questions[0], "noise": 1e-3, "noise_spacing": 0.5})
    together = stickslip.run_many(questions)
    for question, run in zip(questions, together):
        one = stickslip.run(**question)
        assert run.regime == one.regime and np.array_equal(run.t, one.t)
        assert np.abs(run.x0 - one.x0).max() < 1e-8
        assert run.work.memory_reason.startswith("side by side") == ("noise" not in question)
        assert run.sol(50.0).l == pytest.approx(one.sol(50.0).l, abs=1e-8)
    # Whatever the company.
    assert np.array_equal(stickslip.run_many(questions[1:2])[0].x0, together[1].x0)
    with pytest.raises(ValueError, match=r"run 1: alpha=-1: "):
        stickslip.run_many([questions[0], {**questions[0], "alpha": -1}])
    with pytest.raises(ValueError, match="run 0: until: is needed"):
        stickslip.run_many([{"alpha": 1, "r": 1}])
    with pytest.raises(TypeError):
        stickslip.run_many([{"alfa": 1}])
    assert stickslip.run_many([]) == []


def test_animations_are_those_of_the_program(run, tmp_path):
    film = run.animate(times=(100, 110), seconds=0.5, fps=4, width="300px")
    apng = film._repr_png_()
    assert apng.startswith(b"\x89PNG") and b"acTL" in apng
    for ending, beginning in (("gif", b"GIF89a"), ("webp", b"RIFF"), ("apng", b"\x89PNG")):
        film.save(tmp_path / f"run.{ending}")
        assert (tmp_path / f"run.{ending}").read_bytes().startswith(beginning)
    assert (tmp_path / "run.apng").read_bytes() == apng
    with pytest.raises(ValueError, match=r"animate\(\)\.save"):
        run.plot().save(tmp_path / "run.gif")
    with pytest.raises(ValueError, match="run or raster"):
        stickslip.cycle(alpha=1.2, r=1).animate()._repr_png_()


SCALES = {"sigma": "20nm", "stiffness": "0.2N/m", "damping": "3.2mNs/m", "slope_force": "5nN"}


@pytest.mark.filterwarnings("ignore::stickslip.StickslipWarning")
@pytest.mark.parametrize("scales", [{}, SCALES])
def test_each_document_is_xarray_in_its_units_and_netcdf(tmp_path, scales):
    pytest.importorskip("xarray")
    run = stickslip.run(alpha=1.3, r=0.8, kick=0.3, until=40, sample_every=1, **scales)
    raster = stickslip.raster(tip="gaussian", alpha=0.4, r=0.8, pitch=1, lines=3, length=6, tolerance=1e-4, **scales)
    image = stickslip.surface(run, at=[30, 40], range=(20, 30, 5), y_range=(-1, 1, 3), **scales).to_xarray()
    assert image.dims == ("t", "y", "x") and image.shape == (2, 3, 5)
    assert stickslip.surface(raster, range=(1, 3, 5), y=[0, 1], **scales).to_xarray().dims == ("y", "x")
    lines = raster.to_xarray()
    assert lines["x0"].dims == ("line", "sample") and lines["x0"].shape[0] == 3
    assert np.allclose(lines["x0"].values[1, :4], np.asarray(raster.lines[1]["samples"]["x0"][:4]) * (20 if scales else 1), rtol=1e-14)
    loads = stickslip.boundary(alpha=1.3, r=0.8, load=10, load_range=(2, 20), r_range=(0.4, 1.6, 3), **scales).to_xarray()
    assert loads["wavelength"].dims == ("load", "velocity") and loads["critical_load"].attrs["units"] == "nN"
    cycle = stickslip.cycle(alpha=1.3, r=0.8, **scales).to_xarray()
    swept = stickslip.sweep(r=(0.8, 1, 2), alpha=(0.9, 1.3, 3), **scales).to_xarray()
    stability = stickslip.stability(alpha=1.3, r=0.8, **scales)
    roots = stability.to_xarray()
    assert roots["re"].dims == ("point",) and roots["re"].attrs.get("units") == ("1/s" if scales else None)
    assert np.allclose(roots["im"], np.array([root.im for root in stability.roots]) / (0.016 if scales else 1), rtol=1e-14)
    limited = stickslip.sweep(r=0.8, alpha=(0.9, 1.3, 3), depth_limit=[3, 5], **scales).to_xarray()
    lattice = {"tip": "gaussian", "r": 1, "pitch": [0.5, 1], "alpha": [0.46, 0.5], "lines": 128, "length": 80}
    rasters = stickslip.sweep_raster(**lattice, **scales).to_xarray()
    axes = [limited["depth_limit"], rasters["pitch"], rasters["wavelength"], rasters["q"], rasters["alpha"]]
    assert [axis.attrs.get("units") for axis in axes] == (["nm", "nm", "nm", "1/nm", None] if scales else [None] * 5)
    # kσ²/a = 16 nm and σ = 20 nm.
    assert np.allclose(limited["depth_limit"], np.array([3, 5]) * (16 if scales else 1), rtol=1e-14)
    assert np.allclose(rasters["pitch"], np.array([0.5, 1]) * (20 if scales else 1), rtol=1e-14)
    several = {"limited": limited, "rasters": rasters, "run": run.to_xarray(), "image": image, "lines": lines, "cycle": cycle, "swept": swept, "loads": loads}
    for name, data in several.items():
        data.to_netcdf(tmp_path / f"{name}.nc")
    found = [several["run"]["x0"], image, lines["x0"], cycle["l"], swept["wavelength"], loads["wavelength"]]
    assert [data.attrs.get("units") for data in found] == (["nm"] * 6 if scales else [None] * 6)


def test_remarks_are_warnings_and_progress_ends():
    with pytest.warns(stickslip.StickslipWarning, match="kick=D"):
        stickslip.run(alpha=1.2, r=1, until=60)
    heard = []
    stickslip.sweep(r=(0.3, 2, 40), alpha=(0.5, 3, 40), progress=lambda part, counted: heard.append(part))
    assert heard and heard[-1] == 1


def test_quantities_are_numbers_of_the_model():
    told = stickslip.cycle(alpha=1.3, r=0.8, healing_time="0.8s", **SCALES)
    assert told.to_dict()["parameters"] == stickslip.cycle(alpha=1.3, r=0.8, healing_time=50, **SCALES).to_dict()["parameters"]
    pint = pytest.importorskip("pint")
    second = pint.UnitRegistry().second
    assert stickslip.cycle(alpha=1.3, r=0.8, healing_time=800 * second / 1000, **SCALES).parameters["healing_time"] == 50


def test_a_document_is_not_saved_under_the_name_of_a_table(tmp_path):
    result = stickslip.stability(r=1)
    for name in ("x.csv", "x.npz", "x.jsonl", "X.CSV"):
        with pytest.raises(ValueError, match="save writes JSON"):
            result.save(tmp_path / name)
        assert not (tmp_path / name).exists()
    result.save(tmp_path / "x.json")
    assert stickslip.load(tmp_path / "x.json").to_json() == result.to_json()


def test_friction_of_a_run_is_that_of_its_samples():
    path = ([0, 50, 100, 150, 200], [0, 50, 0, 50, 0])
    run = stickslip.run(tip="gaussian", alpha=1.5, r=1, healing_time=30, support_path=path, until=200, sample_every=0.05)
    found = stickslip.friction(run)
    t, x, force = np.asarray(run.t), np.asarray(run.x0) + np.asarray(run.lag), np.asarray(run.lag)
    trace, retrace = ((t > 100) & (t <= 150)), ((t > 150) & (t <= 200))
    table = stickslip.friction((x[trace], force[trace]), (x[retrace], force[retrace]))
    for name in ("kinetic", "mean", "static_peak", "work"):
        assert getattr(found, name).value == pytest.approx(getattr(table, name).value, rel=1e-12)
    assert found.force_unit == "kσ"
