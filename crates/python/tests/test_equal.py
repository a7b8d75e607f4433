"""Every number through Python is the program's, to the last bit.

The oracle is the program, built from the same sources and called by its command line; its JSON has the shortest digits
that are read back to the same bits. Negative control: another option gives other numbers."""

import json

import numpy as np
import pytest
from conftest import timeless

import stickslip

TIP = {
    "gaussians": [
        {"amplitude": 1, "center": 0, "width": 0.7},
        {"amplitude": -0.2, "center": 1.5, "width": 0.5},
        {"amplitude": -0.2, "center": -1.5, "width": 0.5},
    ]
}

COMMANDS = {
    "run --alpha-above 0.01 --r 1 --kick 0.01 --until 457": lambda s: s.run(
        alpha_above=0.01, r=1, kick=0.01, until=457
    ),
    "run --alpha 2.6 --beta 0 --r 1 --depth-limit 20 --noise 1e-3 --seed 7 --until 60 --sample-at 20,30.5": lambda s: s.run(
        alpha=2.6, beta=0, r=1, depth_limit=20, noise=1e-3, seed=7, until=60, sample_at=[20, 30.5]
    ),
    "run --tip cosine --no-spring --alpha -28 --inertia 0.1 --healing-time 1 --start-velocity 1 --until 20": lambda s: s.run(
        tip="cosine", no_spring=True, alpha=-28, inertia=0.1, healing_time=1, start_velocity=1, until=20
    ),
    "run --alpha 0.5 --r 0.8 --pulse 2,30,0.5 --pulse=-2,40,0.5 --until 80 --memory fft": lambda s: s.run(
        alpha=0.5, r=0.8, pulse=[(2, 30, 0.5), (-2, 40, 0.5)], until=80, memory="fft"
    ),
    "stability --r 1": lambda s: s.stability(r=1),
    "boundary --r-range 0.05:3:20": lambda s: s.boundary(r_range=(0.05, 3, 20)),
    "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60": lambda s: s.response(
        alpha=0.9, r=1, pulse=(1e-4, 30, 0.5), until=60
    ),
    "cycle --alpha 1.2 --r 1": lambda s: s.cycle(alpha=1.2, r=1),
    "continue --alpha 1.2 --r 1 --over alpha --to 1.3": lambda s: s.continue_branch(alpha=1.2, r=1, over="alpha", to=1.3),
    "sweep --r 0.8:1.2:3 --alpha 0.5:4:8": lambda s: s.sweep(r=(0.8, 1.2, 3), alpha=(0.5, 4, 8)),
    "sweep --r 1 --alpha-above -0.1:0.1:2 --beta 0.5:1:2 --shard 2/3": lambda s: s.sweep(
        r=1, alpha_above=(-0.1, 0.1, 2), beta=(0.5, 1, 2), shard=(2, 3)
    ),
    "raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 4 --length 10": lambda s: s.raster(
        tip="gaussian", alpha=0.45, r=1, pitch=0.5, lines=4, length=10
    ),
    "compare --alpha 1.2 --r 1 --kick 0.05 --until 30": lambda s: s.compare(alpha=1.2, r=1, kick=0.05, until=30),
    "units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --indentation-rate 200nm/s "
    "--velocity 1um/s": lambda s: s.units(
        damping="1mNs/m",
        stiffness="0.05N/m",
        tip_width="20nm",
        slope_force="5nN",
        indentation_rate="200nm/s",
        velocity="1um/s",
    ),
}


@pytest.mark.parametrize("line", COMMANDS)
def test_a_command_gives_what_the_program_gives(shell, line):
    mine = COMMANDS[line](stickslip)
    assert timeless(mine.to_dict()) == timeless(shell(line))


def test_the_comparison_can_fail(shell):
    mine = stickslip.run(alpha=1.2, r=1, kick=0.05, until=40).to_dict()
    other = shell("run --alpha 1.2 --r 1 --kick 0.05000000000000001 --until 40")
    assert timeless(mine) != timeless(other)


def test_a_tip_from_a_dict_is_that_of_a_file(shell, tmp_path):
    (tmp_path / "tip.json").write_text(json.dumps(TIP))
    mine = stickslip.run(tip=TIP, alpha=0.5, r=1, until=40)
    assert timeless(mine.to_dict()) == timeless(shell("run --tip-file tip.json --alpha 0.5 --r 1 --until 40"))


def test_a_measured_tip_is_that_of_its_file_and_is_a_tip(shell, tmp_path):
    pandas = pytest.importorskip("pandas")
    x = np.linspace(-120, 120, 161)
    noise = np.random.default_rng(5).normal(0, 0.02, x.size)
    pit = pandas.DataFrame({"x_nm": x, "z_nm": -8 * np.exp(-(x**2) / 1800) + noise})
    pit.to_csv(tmp_path / "pit.csv", index=False)
    mine = stickslip.tip(pit, resamples=20)
    program = shell("tip pit.csv --resamples 20")
    program["parameters"]["source"] = mine.parameters.source = "<measured>"
    assert timeless({**mine.to_dict(), "parameters": program["parameters"]}) == timeless(program)
    assert mine.parameters.unit == "nm"
    run = stickslip.run(tip=mine, alpha=0.5, r=1, until=30)
    assert run.parameters.tip.gaussians[0].width == mine.gaussians[0].width


def ripples(pandas):
    """Heights of settled ripples in nm, on a slope, noisy, as an instrument would give them; and the force of the same scan."""
    run = stickslip.run(alpha=1.3, r=1, kick=0.3, until=300)
    noise = np.random.default_rng(3).normal(0, 0.02, (2, 400))
    x, t = np.linspace(230, 270, 400), np.linspace(250, 290, 400)
    height = pandas.DataFrame({"x_nm": 30 * x, "z_nm": 18 * (run.surface(x) + 0.02 * x + noise[0])})
    return height, pandas.DataFrame({"way_nm": 30 * t, "force_nN": 9 * (run.sol(t).lag + noise[1])})


def test_a_fit_is_that_of_its_files_and_finds_what_the_ripples_were_made_of(shell, tmp_path):
    height, force = ripples(pytest.importorskip("pandas"))
    first, second = height[:260], height[140:]
    for name, frame in (("first", first), ("second", second), ("force", force)):
        frame.to_csv(tmp_path / f"{name}.csv", index=False)
    program = shell("fit --ripple first.csv --ripple second.csv --friction force.csv --height-gain 0.02 --width 30")
    mine = stickslip.fit(ripple=[first, tmp_path / "second.csv"], friction=force, height_gain=0.02, width=30)
    found = mine.to_dict()
    assert [data["source"] for data in found["data"]] == ["--ripple <ripple[0]>", f"--ripple {tmp_path / 'second.csv'}", "--friction <friction>"]
    for one, other in zip(found["data"], program["data"]):
        one["source"] = other["source"]
    assert timeless(found) == timeless(program)
    for name, truth in (("alpha", 1.3), ("r", 1.0)):
        estimate = mine.estimates[name]
        assert estimate.low < truth < estimate.high < 1.05 * truth, (name, estimate)
    assert mine.correlations.shape == (2, 2) and np.allclose(np.diag(mine.correlations), 1)
    assert mine.plot().svg.startswith("<svg")


def test_columns_of_a_fit_are_a_tuple_and_several_data_a_list():
    height, _ = ripples(pytest.importorskip("pandas"))
    columns = tuple(height.to_numpy().T)
    asked = dict(alpha=1.3, r=1, unit="nm")
    alone = [stickslip.fit(ripple=given, **asked).to_dict() for given in (columns, [columns], height)]
    for fit in alone:
        fit["data"][0].pop("source")
    # Only a heading names the unit of the heights.
    assert alone[2]["data"][0].pop("y_unit") == "nm"
    assert alone[0] == alone[1] == alone[2] and len(alone[0]["data"]) == 1
    with pytest.raises(TypeError, match=r"ripple\[0\] must be a file, columns such as \(x, f\)"):
        stickslip.fit(ripple=list(columns), **asked)


def test_attributes_are_the_numbers_of_the_document(shell):
    line = "run --alpha 1.2 --r 1 --kick 0.05 --until 400"
    mine, program = stickslip.run(alpha=1.2, r=1, kick=0.05, until=400), shell(line)
    for name in ("t", "l", "lag", "x0", "velocity"):
        assert getattr(mine, name).tolist() == program["samples"][name]
    assert mine.regime == program["regime"] == "stick-slip"
    for name in ("period", "wavelength", "amplitude_x0", "amplitude_u"):
        assert getattr(mine, name) == program["oscillation"][name]
    assert mine.parameters.tip.gaussians[0].width == program["parameters"]["tip"]["gaussians"][0]["width"]
    assert mine.history["displacement"].tolist() == program["history"]["displacement"]
    assert mine.work.steps == program["work"]["steps"]


def test_a_surface_is_that_of_the_program(shell, tmp_path):
    run = stickslip.run(alpha=1.2, r=1, kick=0.05, until=80)
    run.save(tmp_path / "run.json")
    program = shell("surface run.json --at 60,80 --range 50:70:41")["surfaces"]
    mine = run.surface(program[0]["x"], [60, 80])
    assert mine.tolist() == [surface["u"] for surface in program]
    by_command = stickslip.surface(run, at=[60, 80], range=(50, 70, 41))
    assert by_command.to_dict()["surfaces"] == program
    for outside in [{"x": 60, "t": 1}, {"x": float("nan")}]:
        with pytest.raises(ValueError, match="outside of the run|not a finite number"):
            run.surface(**outside)
    assert run.surface(60.5).shape == () and run.surface([[60.0, 61.0]], 80).shape == (1, 2)


def test_documents_of_either_side_are_read_by_the_other(program, shell, tmp_path):
    run = stickslip.run(alpha=1.2, r=1, kick=0.05, until=60)
    run.save(tmp_path / "mine.json")
    assert shell("verify mine.json --format json")["format"] == "stickslip/verify"
    shell("run --alpha 1.2 --r 1 --kick 0.05 --until 60")
    for line in ("cycle --alpha 1.2 --r 1", "stability --r 1", "sweep --r 1 --alpha 1:2:3"):
        document = shell(line)
        (tmp_path / "its.json").write_text(json.dumps(document))
        assert timeless(stickslip.load(tmp_path / "its.json").to_dict()) == timeless(document)
    loaded = stickslip.load(tmp_path / "mine.json")
    assert loaded.to_dict() == run.to_dict() and np.array_equal(loaded.sol([30.0, 40.0]), run.sol([30.0, 40.0]))
