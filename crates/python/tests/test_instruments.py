"""Files of instruments: each format gives the same numbers, scan parameters of its header, and the same answers."""

import json
import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

for library in ("xarray", "gwyfile", "igor2", "tifffile", "igorwriter"):
    pytest.importorskip(library)

import instrument_files as made  # noqa: E402

import stickslip  # noqa: E402
from stickslip.__main__ import main  # noqa: E402


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("instruments")
    for name in made.FORMATS:
        made.write(folder / name)
    return folder


def rows_upwards(scan):
    """Heights in rows of increasing y, in the coordinates of the file."""
    return scan["height" if "height" in scan else "Height"].values


@pytest.mark.parametrize("name", made.FORMATS)
def test_every_format_holds_the_same_heights_to_the_last_bit(folder, name):
    scan = stickslip.open(folder / name)
    height = scan["height" if "height" in scan else "Height"]
    assert height.attrs["units"] == "m" and scan.x.attrs["units"] == "m"
    assert np.array_equal(height.values, made.LSB * made.pit())
    assert np.array_equal(scan.x.values, made.PIXEL * (np.arange(made.COLUMNS) + 0.5))
    assert np.array_equal(scan.y.values, made.PIXEL * (np.arange(made.ROWS) + 0.5))


@pytest.mark.parametrize("name", [name for name in made.FORMATS if name != "scan.gsf"])
def test_channels_have_names_units_and_directions(folder, name):
    scan = stickslip.open(folder / name)
    back = next(array for key, array in scan.data_vars.items() if key.endswith("retrace") and key.lower().startswith("height"))
    assert back.attrs["scan"] == "retrace"
    assert np.array_equal(back.values, made.LSB * made.pit(3))
    lateral = next(array for array in scan.data_vars.values() if array.attrs["units"] == "V" and array.attrs.get("scan") != "retrace")
    assert np.array_equal(lateral.values, made.LSB * made.friction())
    assert scan.attrs["pitch_m"] == made.PIXEL
    assert scan.attrs["line_rate_Hz"] == pytest.approx(2.5, rel=1e-15)
    assert scan.attrs["velocity_m_per_s"] == pytest.approx(5.0 * made.COLUMNS * made.PIXEL, rel=1e-15)
    if name not in ("scan.sxm", "scan.jpk"):
        assert scan.attrs["normal_stiffness_N_per_m"] == 0.2
    if name not in ("scan.gwy", "scan.jpk"):
        assert scan.attrs["slow_scan"] == "down"


def test_nanonis_agrees_with_nanonispy(folder):
    read = pytest.importorskip("nanonispy2").read
    theirs = read.Scan(str(folder / "scan.sxm"))
    ours = stickslip.open(folder / "scan.sxm")
    # They leave rows and the way back in the order of the scan.
    assert np.array_equal(theirs.signals["Height"]["forward"][::-1], ours["Height"].values)
    assert np.array_equal(theirs.signals["Height"]["backward"][::-1, ::-1], ours["Height retrace"].values)


@pytest.mark.parametrize("stored, nominal", [("<i2", 2), ("<i4", 2), ("<i4", 4)])
def test_nanoscope_stores_more_bytes_than_its_scale_counts(tmp_path, stored, nominal):
    made.spm(tmp_path / "scan.003", stored=stored, nominal=nominal)
    scan = stickslip.open(tmp_path / "scan.003")
    assert np.array_equal(scan["Height"].values, made.LSB * made.pit() * 256.0 ** (2 - nominal))


DIALECTS = {
    # Separator, decimal mark, line end, encoding, heading.
    "csv": (",", ".", "\n", "utf-8", "x_nm,z_nm"),
    "german": (";", ",", "\r\n", "cp1252", "x (nm);z (nm)"),
    "excel": (";", ",", "\r\n", "utf-8-sig", "x [nm];Höhe [nm]"),
    "tabs": ("\t", ".", "\r", "utf-16", "x / nm\tz / nm"),
    "tabs with commas": ("\t", ",", "\n", "utf-16-be", "x_nm\tz_nm"),
    "blanks": ("   ", ".", "\n", "ascii", "# x_nm z_nm"),
    "blanks with commas": (" ", ",", "\r\n", "latin-1", "x_nm z_nm"),
    "a row of units": (";", ".", "\n", "utf-8", "x;Topography\nnm;nm"),
    "typographic minus": (",", ".", "\n", "utf-8", "x in nm,z in nm"),
    "quoted": (",", ",", "\r\n", "utf-8", '"x_nm","z_nm"'),
}


def table(path, dialect, columns):
    between, mark, end, encoding, heading = DIALECTS[dialect]

    def field(value):
        text = repr(float(value)).replace(".", mark)
        if dialect == "typographic minus":
            text = text.replace("-", "\u2212") if "e" not in text else text
        return f'"{text}"' if dialect == "quoted" else text

    lines = [*heading.split("\n"), *(between.join(map(field, row)) for row in zip(*columns))]
    text = end.join(lines) + end
    bom = "\ufeff" if encoding == "utf-16-be" else ""
    path.write_bytes((bom + text).encode(encoding))


def without_source(found):
    document = found.to_dict()
    document["parameters"].pop("source")
    return document


def test_five_formats_and_ten_dialects_give_the_same_answer_to_all_digits(folder, tmp_path):
    row = made.ROWS // 2
    answers = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name in made.FORMATS:
            scan = stickslip.open(folder / name)
            profile = scan["height" if "height" in scan else "Height"].isel(y=row)
            answers[name] = without_source(stickslip.tip(profile, resamples=20))
        columns = [1e9 * profile.x.values, 1e9 * profile.values]
        for dialect in DIALECTS:
            table(tmp_path / f"{dialect}.txt", dialect, columns)
            answers[dialect] = without_source(stickslip.tip(tmp_path / f"{dialect}.txt", resamples=20))
    assert len(answers) == 16
    first = answers["scan.gwy"]
    assert first["parameters"]["unit"] == "nm"
    assert first["sigma"]["value"] == pytest.approx(30, rel=0.05)
    for name, answer in answers.items():
        assert json.dumps(answer) == json.dumps(first), name


def test_images_give_the_same_footprint_as_the_file_of_gwyddion(folder):
    usual = without_source(stickslip.tip(folder / "scan.gsf", resamples=20))
    assert usual["image"]["widths"][0] == pytest.approx(1.5, rel=0.05)
    for name in made.FORMATS:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="the profile determines")
            if name not in ("scan.gsf",):
                warnings.simplefilter("ignore", stickslip.StickslipWarning)
            found = stickslip.tip(stickslip.open(folder / name), resamples=20)
        assert json.dumps(without_source(found)) == json.dumps(usual), name


def test_an_image_lies_as_its_dimensions_say(folder):
    image = stickslip.open(folder / "scan.gsf")["Height"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", stickslip.StickslipWarning)
        usual = without_source(stickslip.tip(image, resamples=2))
        assert without_source(stickslip.tip(image.transpose("x", "y"), resamples=2)) == usual
    uneven = image.assign_coords(y=image.y**2)
    with pytest.raises(ValueError, match="positions along y are not evenly spaced"):
        stickslip.tip(uneven)


def test_the_channel_that_is_used_is_named(folder):
    scan = stickslip.open(folder / "scan.spm")
    with pytest.warns(stickslip.StickslipWarning, match='"Height" is used; others are Height retrace'):
        stickslip.tip(scan, resamples=0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", stickslip.StickslipWarning)
        warnings.filterwarnings("ignore", message="the profile determines")
        stickslip.tip(scan["Height retrace"], resamples=0)
    with pytest.raises(ValueError, match="no channel is a length: there are Friction"):
        stickslip.tip(scan[["Friction"]])


def test_a_channel_is_chosen_by_its_name(folder):
    scan = stickslip.open(folder / "scan.ibw", channel="Lateral")
    assert list(scan.data_vars) == ["Lateral"]
    with pytest.raises(ValueError, match="no channel 'Phase': there are Height, Height retrace, Lateral"):
        stickslip.open(folder / "scan.ibw", channel="Phase")


def test_channels_of_another_size_are_named_and_left_out(tmp_path):
    import gwyfile.objects as gwy

    container = gwy.GwyContainer()
    for i, size in enumerate([(8, 8), (4, 8)]):
        container[f"/{i}/data"] = gwy.GwyDataField(np.ones(size), si_unit_xy="m", si_unit_z="m")
        container[f"/{i}/data/title"] = f"image {i}"
    container.tofile(str(tmp_path / "two.gwy"))
    with pytest.warns(stickslip.StickslipWarning, match="image 1 have another size than image 0"):
        scan = stickslip.open(tmp_path / "two.gwy")
    assert list(scan.data_vars) == ["image 0"]
    assert stickslip.open(tmp_path / "two.gwy", channel="image 1")["image 1"].shape == (4, 8)


@pytest.fixture(scope="module")
def ripples():
    """Ripples and lateral force of one motion, as profiles of a scan with σ = 30 nm."""
    import xarray

    run = stickslip.run(tip="gaussian", alpha=2.2, r=1, kick=0.3, until=300)
    x = np.linspace(200, 270, 400)
    noise = np.random.default_rng(2).normal(0, 0.02, (2, 400))
    heights = 18e-9 * (run.surface(x) + noise[0])
    lag = run.sol(x[:400] + 0.0).lag + noise[1]
    over = {"x": ("x", 30e-9 * x, {"units": "m"})}
    data = {"Height": ("x", heights, {"units": "m", "scan": "trace"}), "Lateral": ("x", lag, {"units": "V", "scan": "trace"})}
    return xarray.Dataset(data, coords=over), (x, heights, lag)


def test_fit_takes_a_profile_of_a_scan(ripples):
    scan, (x, heights, _) = ripples
    found = stickslip.fit(ripple=scan["Height"], tip="gaussian", r=1, scan="right")
    usual = stickslip.fit(ripple={"x_nm": 30.0 * x, "z_nm": 1e9 * heights}, tip="gaussian", r=1, scan="right")
    assert found.parameters.unit == "nm"
    assert found.estimates.alpha.value == pytest.approx(usual.estimates.alpha.value, rel=1e-9)
    assert found.estimates.alpha.low < 2.2 < found.estimates.alpha.high
    assert found.estimates.width.low < 30 < found.estimates.width.high


def test_fit_takes_an_image_of_ripples():
    area = Path(__file__).parents[3] / "examples" / "measured" / "area.gsf"
    known = {"tip": "gaussian", "width": "30nm", "pitch": "30nm"}
    found = stickslip.fit(image=stickslip.open(area), **known)
    assert found.estimates.alpha.low < 0.9 < found.estimates.alpha.high
    assert found.estimates.r.low < 1.0 < found.estimates.r.high
    assert found.parameters.unit == "nm" and found.profile.height.shape == found.profile.model.shape
    program = stickslip.fit(image=area, **known)
    assert program.estimates.alpha.value == pytest.approx(found.estimates.alpha.value, rel=1e-6)
    bare = stickslip.fit(image=area, tip="gaussian", width=30, pitch=30.0)
    assert bare.estimates.alpha.value == pytest.approx(program.estimates.alpha.value, rel=1e-9)


def test_friction_takes_columns_with_units():
    x = np.linspace(0.0, 2e3, 800)
    trace = np.minimum(0.25 * x - 6.0, 6.0) + 0.1 * np.sin(x / 20.0)
    retrace = np.maximum(6.0 - 0.25 * (2e3 - x), -6.0) + 0.1 * np.sin(x / 20.0)
    found = stickslip.friction({"x_nm": x, "trace_nN": trace, "retrace_nN": retrace})
    assert found.kinetic.value == pytest.approx(6.0, rel=0.02) and found.work_unit == "fJ"
    apart = stickslip.friction({"x_nm": x, "force_nN": trace}, {"x_nm": x[::-1], "force_nN": retrace[::-1]})
    assert apart.work.value == pytest.approx(found.work.value, rel=1e-9)
    assert stickslip.friction((x, trace, retrace), unit="nm", force_unit="nN").work.value == found.work.value


def test_an_image_is_no_profile_and_says_what_to_take(folder):
    scan = stickslip.open(folder / "scan.jpk", channel="height")
    with pytest.raises(ValueError, match=r'take one of its lines, such as scan\["Height"\].isel\(y=10\)'):
        stickslip.fit(friction=scan["height"])


def test_a_raster_scans_the_area_of_an_image(folder):
    scan = stickslip.open(folder / "scan.sxm").isel(y=slice(0, 3))
    found = stickslip.raster(tip="gaussian", alpha=0.3, r=1, area=scan, sigma="30nm")
    assert len(found.lines) == 3
    area = found.parameters.area
    assert area["y"][1] == pytest.approx(made.PIXEL / 30e-9, rel=1e-12)
    assert area["length"][2] == pytest.approx(made.COLUMNS * made.PIXEL / 30e-9, rel=1e-12)


def test_what_cannot_be_read_is_refused_with_the_reason(folder, tmp_path):
    for name in made.FORMATS:
        whole = (folder / name).read_bytes()
        for size in (0, 7, 200, len(whole) // 2, len(whole) - 1):
            (tmp_path / name).write_bytes(whole[:size])
            with pytest.raises(ValueError, match=name.replace(".", r"\.")):
                stickslip.open(tmp_path / name)
    made.force_curve(tmp_path / "curve.spm")
    with pytest.raises(ValueError, match="contains no image"):
        stickslip.open(tmp_path / "curve.spm")
    with pytest.raises(ValueError, match=r"save it as \.gwy or \.gsf in Gwyddion"):
        stickslip.open("scan.nid")
    with pytest.raises(FileNotFoundError):
        stickslip.open(tmp_path / "none.gwy")


def test_a_missing_library_is_named(folder, monkeypatch):
    monkeypatch.setitem(sys.modules, "gwyfile", None)
    monkeypatch.delitem(sys.modules, "stickslip._instruments.gwyddion", raising=False)
    with pytest.raises(ImportError, match=r'needs gwyfile: pip install "stickslip\[instruments\]"'):
        stickslip.open(folder / "scan.gwy")


def convert(*words):
    """The exit status of ``python -m stickslip convert``, here."""
    return main(["convert", *map(str, words)])


@pytest.mark.filterwarnings("ignore::stickslip.StickslipWarning")
def test_the_command_that_the_program_names_converts(folder, tmp_path, program):
    """What the program says of each format is done as it says, and its answer is that of Python."""
    for name in ("scan.gwy", "scan.spm", "scan.ibw", "scan.sxm", "scan.jpk"):
        refused = subprocess.run([program, "tip", folder / name], capture_output=True, text=True, timeout=120)
        assert refused.returncode == 2 and refused.stdout == ""
        assert f"`python -m stickslip convert {folder / name} -o image.gsf`" in refused.stderr, refused.stderr
        image, line = tmp_path / f"{name}.gsf", tmp_path / f"{name}.csv"
        for output in (image, line):
            assert convert(folder / name, "-o", output, "--line", made.ROWS // 2) == 0
        words = [program, "tip", image, "--resamples", "20", "-q"]
        found = json.loads(subprocess.run(words, capture_output=True, text=True, check=True, timeout=120).stdout)
        usual = without_source(stickslip.tip(stickslip.open(folder / name), resamples=20))
        found["parameters"].pop("source")
        assert found == usual
        first = line.read_text().splitlines()
        assert first[0] == '"x (nm)";"' + ("height" if name == "scan.jpk" else "Height") + ' (nm)"'
        assert len(first) == 1 + made.COLUMNS


def test_convert_lists_the_channels(folder, capsys):
    words = [sys.executable, "-m", "stickslip", "convert", folder / "scan.spm"]
    listed = subprocess.run(words, capture_output=True, text=True, check=True, timeout=120).stdout
    assert "Height: 96 × 48 pixels, m, trace" in listed and "line_rate_Hz = 2.5" in listed
    assert convert(folder / "scan.spm") == 0 and capsys.readouterr().out == listed
    for words in (["-o", "a.png"], ["-o", "a.csv"], ["--channel", "Phase", "-o", "a.gsf"]):
        assert convert(folder / "scan.spm", *words) == 2
        assert capsys.readouterr().err.startswith("stickslip: ")


# What AFMReader 0.0.7 and pySPM 0.6.3 read in the files that AFMReader ships (LGPL: not in this repository), in nm:
# channel, pixel, lowest, highest, corner at the smallest x and y.
SHIPPED = {
    "sample_0.spm": ("Height", 0.4940029296875, 21.21523634486748, 37.12457795307129, 21.941042700354494),
    "sample_0.jpk": ("height", 1.2770176335964876, 3302.5918201872378, 3360.9500421237926, 3334.4851510316034),
    "sample_0.ibw": ("Height", 1.565557729941292, -845.11285, -821.85547, -826.38184),
    "sample_0.gwy": ("ZSensor", 0.8468632812499975, 124.89543848157061, 141.69387524784446, 132.76176306573907),
}


@pytest.mark.skipif("STICKSLIP_INSTRUMENTS" not in os.environ, reason="STICKSLIP_INSTRUMENTS: tests/resources of AFMReader 0.0.7")
@pytest.mark.parametrize("name", SHIPPED)
def test_real_files_are_read_as_other_libraries_read_them(name):
    channel, pixel, *values = SHIPPED[name]
    height = stickslip.open(Path(os.environ["STICKSLIP_INSTRUMENTS"]) / name, channel=channel)[channel]
    found = 1e9 * np.array([height.min(), height.max(), height[0, 0]], float)
    # igor2 gives single precision, which AFMReader scales as it is.
    assert found == pytest.approx(values, rel=1e-7 if name.endswith(".ibw") else 1e-12)
    assert 1e9 * float(height.x[1] - height.x[0]) == pytest.approx(pixel, rel=1e-9)


def test_a_file_by_gwyddion_is_read():
    """`data/gwyfile-0.3.0.gwy` is tests/test.gwy of gwyfile 0.3.0 (MIT), written by Gwyddion."""
    scan = stickslip.open(Path(__file__).parent / "data" / "gwyfile-0.3.0.gwy")
    assert scan["Test"].shape == (128, 128) and float(scan["Test"].max()) == pytest.approx(1e-3)
