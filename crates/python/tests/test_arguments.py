"""What is taken: arrays of any kind, and what is refused, in the program's words."""

import warnings

import numpy as np
import pytest

import stickslip

X = np.linspace(0, 5, 41)
F = np.exp(-(X**2) / 2)


def motion(tip):
    return stickslip.run(tip=tip, alpha=0.6, r=1, until=30).to_dict()["samples"]


@pytest.fixture(scope="module")
def usual():
    return motion((X, F))


def test_columns_of_any_kind_are_the_same_numbers(usual):
    pandas = pytest.importorskip("pandas")
    wide = np.zeros((41, 6))
    wide[:, 1], wide[:, 4] = X, F
    kinds = {
        "lists": (X.tolist(), F.tolist()),
        "strided": (wide[:, 1], wide[:, 4]),
        "backwards": (X[::-1][::-1], F),
        "a table of rows": np.column_stack([X, F]),
        "fortran": np.asfortranarray(np.column_stack([X, F])),
        "pandas Series": pandas.Series(F, index=X),
        "pandas columns": (pandas.Series(X), pandas.Series(F)),
        "pandas DataFrame": pandas.DataFrame({"x": X, "f": F}),
        "big-endian": (X.astype(">f8"), F.astype(">f8")),
    }
    for kind, tip in kinds.items():
        assert motion(tip) == usual, kind


def test_float32_is_taken_as_the_numbers_that_it_holds(usual):
    narrow = (X.astype(np.float32), F.astype(np.float32))
    assert motion(narrow) == motion(tuple(column.astype(float) for column in narrow))
    assert motion(narrow) != usual


def test_integers_and_numpy_scalars_are_numbers():
    usual = stickslip.stability(r=1.0, alpha=1.5).to_json()
    for one in (1, np.float64(1), np.float32(1), np.int32(1), "1", np.array(1.0)):
        assert stickslip.stability(r=one, alpha=1.5).to_json() == usual, repr(one)


def test_ranges_and_lists_of_values_are_told_apart():
    even = stickslip.sweep(r=1, alpha=(1, 2, 3)).parameters.alpha
    assert even.tolist() == [1.0, 1.5, 2.0]


def test_what_is_unusable_is_refused_by_the_names_that_python_has():
    cases = [
        (dict(r=-1, alpha=1, until=20), "r=-1: "),
        (dict(r=1, alpha=1, until=3), "until=3: "),
        (dict(r=1, alpha="much", until=20), "invalid value 'much' for 'alpha'"),
        (dict(r=1, until=20), "alpha"),
        (dict(r=1, alpha=1), "until: is needed"),
        (dict(alpha=1, until=20), "r: is needed"),
        (dict(r=1, alpha=1, until=20, tip_file="nowhere.csv"), "tip_file=nowhere.csv: cannot be read"),
        (dict(r=1, alpha=1, until=20, tip=([0, 1], [1, 0])), "tip: the table"),
        (dict(r=1, alpha=1, until=20, memory="none"), "invalid value 'none' for 'memory'"),
        (dict(r=float("nan"), alpha=1, until=20), "r=NaN: "),
        (dict(r=1, alpha=1, until=20, depth_limit=-1), "depth_limit=-1: "),
    ]
    for given, said in cases:
        with pytest.raises(ValueError) as refused:
            stickslip.run(**given)
        assert said in str(refused.value), given
        assert "--" not in str(refused.value), given
    with pytest.raises(ValueError, match="missing: run"):
        stickslip.surface()
    with pytest.raises(ValueError, match="pitch: is needed"):
        stickslip.raster(alpha=1, r=1)


def test_what_is_no_option_or_no_value_is_a_type_error():
    with pytest.raises(TypeError, match="run.. has no option 'alfa': did you mean alpha. There are .*alpha"):
        stickslip.run(alfa=1, r=1, until=20)
    with pytest.raises(TypeError, match="no_spring is True or False"):
        stickslip.run(alpha=1, no_spring=1, until=20)
    with pytest.raises(TypeError, match="r takes a value"):
        stickslip.run(alpha=1, r=True, until=20)
    with pytest.raises(TypeError, match="tip must be a file, columns"):
        stickslip.run(tip=3, alpha=1, r=1, until=20)
    with pytest.raises(TypeError, match="image must be a .gsf file or an image with positions.*not ndarray"):
        stickslip.fit(image=np.ones((32, 32)), width=30)
    with pytest.raises(ValueError, match=r"columns have \[3, 2\] rows"):
        stickslip.run(tip=([0, 1, 2], [1, 0]), alpha=1, r=1, until=20)


POSITIONS = np.arange(-150.0, 151.0, 5.0)
HEIGHTS = -12 * np.exp(-(POSITIONS**2) / 1800) + 0.01 * np.cos(7 * np.arange(len(POSITIONS)))


def measured(columns, **more):
    return stickslip.tip(columns, resamples=2, **more).to_dict()


def same(found, wanted):
    return {**found, "parameters": None} == {**wanted, "parameters": None}


def test_what_is_masked_or_nan_or_none_is_a_missing_row():
    pandas = pytest.importorskip("pandas")
    usual = measured((POSITIONS, HEIGHTS))
    # Three rows more, of values that would be another tip.
    x, z = np.append(POSITIONS, [0.0, 2.5, 7.5]), np.append(HEIGHTS, [1e3, -1e3, 5.0])
    gone = np.arange(len(x)) >= len(POSITIONS)
    kinds = {
        "masked": (x, np.ma.masked_array(z, gone)),
        "masked positions": (np.ma.masked_array(x, gone), z),
        "masked table": np.ma.masked_array(np.column_stack([x, z]), np.column_stack([gone, gone])),
        "nan": (x, np.where(gone, np.nan, z)),
        "None": (x.tolist(), [None if none else float(value) for none, value in zip(gone, z)]),
        "dict": {"x": x, "z": np.ma.masked_array(z, gone)},
        "DataFrame": pandas.DataFrame({"x": x, "z": np.where(gone, np.nan, z)}),
        "nullable": pandas.DataFrame({"x": x, "z": pandas.array(np.where(gone, np.nan, z), dtype="Float64")}),
    }
    for kind, columns in kinds.items():
        with pytest.warns(stickslip.StickslipWarning, match="3 of 64 rows have no value"):
            assert same(measured(columns), usual), kind
    # Where a table must be whole it is refused.
    with pytest.raises(ValueError, match="a value is missing"):
        motion((X, np.ma.masked_array(F, X == X[3])))


def test_units_of_names_and_quantities_are_read():
    pandas = pytest.importorskip("pandas")

    class Quantity:
        """As pint has it."""

        units = "nanometer"
        magnitude = POSITIONS

    for columns in (
        pandas.DataFrame({"x_nm": POSITIONS, "z_nm": HEIGHTS}),
        {"x (nm)": POSITIONS, "z (nm)": HEIGHTS},
        pandas.Series(HEIGHTS, index=pandas.Index(POSITIONS, name="x [nm]"), name="z [nm]"),
        np.rec.fromarrays([POSITIONS, HEIGHTS], names="x_nm,z_nm"),
        (Quantity(), HEIGHTS),
    ):
        found = measured(columns)
        assert found["sigma_metres"] == pytest.approx(1e-9 * found["sigma"]["value"], rel=1e-12)
    with pytest.raises(ValueError, match="furlong"):
        measured({"x (furlong)": POSITIONS, "z": HEIGHTS})
    with pytest.raises(ValueError, match="such as 30nm"):
        measured({"x_nm": POSITIONS, "z": HEIGHTS}, sigma=30)
    # Names of digits are names.
    assert same(measured(pandas.DataFrame({"0": POSITIONS, "1": HEIGHTS})), measured((POSITIONS, HEIGHTS)))


@pytest.mark.parametrize(
    "bad",
    [
        F.astype(complex),
        F.astype(str),
        F.astype(str).tolist(),
        F > 0.5,
        np.array(["2026-11-23"] * 41, dtype="datetime64[D]"),
        np.column_stack([F, F]),
        [[1.0], [1.0, 2.0]] + [0.0] * 39,
        [1j, *F[1:]],
    ],
    ids=["complex", "str", "list of str", "bool", "dates", "two axes", "ragged", "objects"],
)
def test_what_is_no_column_of_real_numbers_is_refused_by_name(bad):
    with pytest.raises((TypeError, ValueError), match="tip, column 2"):
        motion((X, bad))


def test_what_fails_at_run_time_is_a_runtime_error():
    with pytest.raises(RuntimeError, match="no stick-slip|no cycle|cycle"):
        stickslip.cycle(alpha=0.5, r=1)


def test_what_may_have_been_overlooked_is_a_warning():
    with pytest.warns(stickslip.StickslipWarning, match="pulse=1,500,1") as caught:
        stickslip.run(alpha=1, r=1, until=20, pulse=(1, 500, 1))
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        stickslip.run(alpha=1, r=1, until=20)


def test_files_are_written_where_asked(tmp_path):
    made = stickslip.cycle(alpha=1.2, r=1, output=tmp_path / "cycle.json", plot=tmp_path / "cycle.svg")
    assert (tmp_path / "cycle.json").read_text() == made.to_json() + "\n"
    assert (tmp_path / "cycle.svg").read_text().startswith("<svg")
    assert stickslip.run(alpha=1.2, r=1, until=40, output=tmp_path / "run.jsonl") is None
    assert len((tmp_path / "run.jsonl").read_text().splitlines()) == 2003
