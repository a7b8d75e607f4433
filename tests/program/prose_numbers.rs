//! Numbers in prose are those of the data, the constant or the computation that they come from.
//!
//! Each sentence or row of a table is written here once more, with its numbers rounded from their source: measurements in
//! `data`, constants as they stand in the source code, and reference values computed by the libraries. The document must say the
//! same; where it does not, the test prints the lines to put in. So after `make peers` or `make timings` the tests name what
//! has become stale.

use crate::folder::{Folder, said};
use serde_json::Value;
use std::fs;
use std::path::Path;
use stickslip_cycles::{DEFAULT_TOLERANCE, cycle};
use stickslip_stability::{
    Raster, RasterCritical, RasterKind, RasterPath, Snaking, creep, critical, critical_r, onset,
    trapping_alpha,
};
use stickslip_tip::memory::{Fit, Retreat};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

/// Text of a file of the project.
fn text(path: &str) -> String {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Wherever lines break.
fn flowing(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Those of the passages that the text does not hold.
fn missing<'a>(text: &str, passages: &'a [String]) -> Vec<&'a str> {
    let text = flowing(text);
    passages.iter().map(String::as_str).filter(|one| !text.contains(&flowing(one))).collect()
}

#[track_caller]
fn says(file: &str, passages: &[String]) {
    let stale = missing(&text(file), passages);
    assert!(stale.is_empty(), "{file} should say:\n\n{}\n", stale.join("\n"));
}

fn data(name: &str) -> Value {
    serde_json::from_str(&text(&format!("data/{name}.json"))).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// So many digits that count, in plain decimals.
fn digits(x: f64, count: i32) -> String {
    let rounded: f64 = format!("{x:.*e}", count as usize - 1).parse().unwrap();
    let after = count - 1 - rounded.abs().log10().floor() as i32;
    format!("{rounded:.*}", after.max(0) as usize)
}

/// Thousands apart: 1,100.
fn grouped(x: f64) -> String {
    let plain = format!("{x:.0}");
    let from_end = |i: usize| plain.len() - i;
    let parts = plain.char_indices().map(|(i, digit)| {
        let comma = if i > 0 && from_end(i) % 3 == 0 { "," } else { "" };
        format!("{comma}{digit}")
    });
    parts.collect()
}

/// A ratio as people read it: 1.4, 26, 1,100, 7e4.
fn ratio(x: f64) -> String {
    match x {
        x if (x - 1.0).abs() < 1e-9 => "1".into(),
        x if x < 100.0 => digits(x, 2),
        x if x < 1e4 => grouped(digits(x, 2).parse().unwrap()),
        x => format!("{x:.0e}"),
    }
}

/// 0.11 ms, 2.6 s, 5.3 min.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.9995 => format!("{} ms", digits(1e3 * s, 2)),
        s if s < 99.5 => format!("{} s", digits(s, 2)),
        s => format!("{} min", digits(s / 60.0, 2)),
    }
}

/// The value of `const NAME: TYPE = …;` in a source file: a number, or a shift of one.
fn constant(path: &str, name: &str) -> f64 {
    let source = text(path);
    let declared = format!("const {name}: ");
    let (_, rest) = source.split_once(&declared).unwrap_or_else(|| panic!("{path}: no {name}"));
    let (_, value) = rest.split_once('=').unwrap();
    let value = value.split_once(';').unwrap().0.trim().replace('_', "");
    let number = |text: &str| -> f64 {
        text.trim().parse().unwrap_or_else(|_| panic!("{path}: {name} = {value}"))
    };
    match value.split_once("<<") {
        Some((one, shift)) => number(one) * number(shift).exp2(),
        None => number(&value),
    }
}

fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).unwrap()
}

/// Of all pairs of motion and error, with heyoka one motion after the other.
fn single(peers: &Value) -> Vec<&Value> {
    let rows = peers["embedded"].as_array().unwrap().iter();
    rows.filter(|row| !row["motion"].as_str().unwrap().starts_with("ensemble")).collect()
}

/// The least and the largest.
fn range(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, 0.0), |(low, high), x| (low.min(x), high.max(x)))
}

#[test]
fn the_race_is_told_as_it_was_run() {
    let peers = data("peers");
    let row = |name: &str| {
        let rows = peers["at_matched_error"].as_array().unwrap();
        let found = rows.iter().find(|row| row["contestant"] == name);
        found.unwrap_or_else(|| panic!("{name} is not in the table"))
    };
    // The part of a setting that matters here.
    let part = |name: &str, i: usize| {
        row(name)["setting"].as_str().unwrap().split(", ").nth(i).unwrap().to_owned()
    };
    let times = |name: &str| ratio(number(&row(name)["ratio"]));
    let entry = |label: String, name: &str| {
        format!("| {label} | {} | {} |", duration(number(&row(name)["seconds"])), times(name))
    };
    let (delays, jit, spectral) = ("differential-equations", "JiTCDDE", "grid (c), spectral");
    let (windowed, uniform, scipy) =
        ("grid (b), windowed", "grid (a), uniform", "SciPy solve_ivp RK45");
    let lags = |name: &str| part(name, 2).replace(" to 11", "");
    let rows = single(&peers);
    let (least, most) = range(rows.iter().map(|row| number(&row["ratio"])));
    let (quick, slow) = range(rows.iter().map(|row| number(&row["compiling"])));
    let all = peers["embedded"].as_array().unwrap();
    let ensemble = |way: &str, target: f64| {
        let is_wanted = |row: &&Value| {
            row["motion"] == format!("ensemble, {way}") && number(&row["target"]) <= 1.01 * target
        };
        number(&all.iter().find(is_wanted).unwrap()["ratio"])
    };
    let alone = [1e-6, 1e-9].map(|target| 1.0 / ensemble("one by one", target));
    let beside = [1e-6, 1e-9].map(|target| ensemble("side by side", target));
    let ours = |motion: &str, target: f64| {
        let row = rows
            .iter()
            .find(|row| row["motion"] == motion && number(&row["target"]) <= 1.01 * target);
        duration(number(&row.unwrap()["ours"]["seconds"]))
    };
    let machine = format!(
        "{}, {}",
        peers["machine"]["cpu"].as_str().unwrap(),
        peers["date"].as_str().unwrap()
    );
    says(
        "README.md",
        &[
            format!(
                "takes {} at an error below 1e-5 ({machine}; one core)",
                duration(number(&row("closed, modes")["seconds"]))
            ),
            format!(
                "takes {} times as long, a general delay solver {} times, and the grid scheme of the literature {} times",
                times(spectral),
                times(delays),
                times(windowed)
            ),
            format!("takes {} to {} times as long", digits(least, 2), digits(most, 2)),
            format!(
                "a run takes {} times as long with `fft` as with `modes`, and {} times with `direct`",
                times("closed, fft"),
                times("closed, direct")
            ),
        ],
    );
    says(
        "paper.md",
        &[
            format!(
                "takes {} at an error below $10^{{-5}}$",
                duration(number(&row("closed, modes")["seconds"]))
            ),
            format!(
                "takes {} times as long, a general delay solver {} times",
                times(spectral),
                times(delays)
            ),
        ],
    );
    says(
        "docs/reference/speed.md",
        &[
            format!("({machine}; [data/peers.md](../../data/peers.md)"),
            format!(
                "a run takes {} times as long with `fft` as with `modes`, and {} times with `direct`",
                times("closed, fft"),
                times("closed, direct")
            ),
            entry("stickslip, `modes`".into(), "closed, modes"),
            entry(format!("our own strongest grid, spectral, {}", part(spectral, 0)), spectral),
            entry(
                format!("delay solver of the crate `differential-equations`, {}", lags(delays)),
                delays,
            ),
            entry(format!("JiTCDDE, {}, compiled", lags(jit)), jit),
            entry(
                format!("the paper's scheme within a window of the tip, {}", part(windowed, 0)),
                windowed,
            ),
            entry(
                format!(
                    "the paper's grid in SciPy, {}, extrapolated from 10 steps",
                    part(scipy, 0)
                ),
                scipy,
            ),
            entry(
                format!(
                    "the paper's grid in Rust, {}, extrapolated from 20 steps",
                    part(uniform, 0)
                ),
                uniform,
            ),
            format!(
                "takes {} at an error below 1e-6 and {} below 1e-9; stick-slip at α = 1.2 to t = 457 takes {} and {}",
                ours("onset", 1e-6),
                ours("onset", 1e-9),
                ours("stick-slip", 1e-6),
                ours("stick-slip", 1e-9)
            ),
            format!(
                "takes {} to {} times as long as stickslip at equal error, after {} to {} s of compiling",
                digits(least, 2),
                digits(most, 2),
                digits(quick, 1),
                digits(slow, 1)
            ),
            format!(
                "it is {} and {} times as fast as ours one after the other, and takes {} and {} times as long as ours side by side",
                digits(alone[0], 2),
                digits(alone[1], 2),
                digits(beside[0], 2),
                digits(beside[1], 2)
            ),
        ],
    );
    let table = all.iter().map(|row| {
        let ours = &row["ours"];
        format!(
            "| {} | {:.0e} | {} | {} | {} | {} |",
            row["motion"].as_str().unwrap(),
            number(&row["target"]),
            duration(number(&row["seconds"])),
            duration(number(&ours["seconds"])),
            ours["setting"].as_str().unwrap().replace("tolerance ", ""),
            digits(number(&row["ratio"]), 2)
        )
    });
    says("docs/reference/speed.md", &table.collect::<Vec<_>>());
    says(
        "docs/reference/speed.md",
        &[
            format!("on one core of {machine}"),
            format!(
                "{} and {} are the ratios at an error of $10^{{-5}}$",
                times(delays),
                times(jit)
            ),
            format!("{} times the time near onset", times(spectral)),
        ],
    );
}

#[test]
fn commands_take_what_was_measured() {
    let timed = data("commands");
    let of = |name: &str| {
        let command = &timed["commands"][name];
        let size = command["megabytes"].as_f64().map(|size| format!("{} MB", grouped(size)));
        (duration(number(&command["seconds"])), size.unwrap_or_default())
    };
    let rows = timed["commands"].as_object().unwrap().iter().map(|(name, command)| {
        let (time, size) = of(name);
        let line = command["command"].as_str().unwrap().trim_start_matches("stickslip ");
        format!("| {name} | `{line}` | {time} | {size} |")
    });
    says("docs/reference/speed.md", &rows.collect::<Vec<_>>());
    let date = timed["date"].as_str().unwrap();
    let machine = format!("{}, {date}", timed["machine"]["cpu"].as_str().unwrap());
    says("docs/reference/speed.md", &[format!("({machine}; `make timings`)")]);
}

#[test]
fn what_a_digit_costs_is_what_was_measured() {
    let measured = data("work_precision");
    let curves = measured["curves"].as_array().unwrap().iter();
    let costs = curves.filter(|curve| curve["method"] == "modes").map(|curve| {
        let points = curve["points"].as_array().unwrap();
        let at = |tolerance: f64| {
            let close =
                |point: &&Value| (number(&point["tolerance"]) / tolerance).ln().abs() < 0.01;
            number(&points.iter().find(close).expect("that tolerance")["seconds"])
        };
        at(1e-11) / at(1e-4)
    });
    let (least, most) = range(costs);
    says(
        "docs/reference/speed.md",
        &[format!(
            "seven digits more take {} to {} times the time with `modes`",
            digits(least, 2),
            digits(most, 2)
        )],
    );
}

#[test]
fn constants_of_the_integrator() {
    let control = |name| constant("crates/tip/src/integrator/control.rs", name);
    let plan = |name| constant("crates/tip/src/integrator/taylor/plan.rs", name);
    let switch = |name| constant("crates/tip/src/integrator/taylor/switch.rs", name);
    let estimate = |name| constant("crates/tip/src/step/estimate.rs", name);
    let share = control("SHARE_OF_A_STEP");
    let series = share * plan("SHARE_OF_SERIES");
    let band = constant("crates/tip/src/tip_function/scale.rs", "BAND_OF_A_GAUSSIAN");
    let whole = |x: f64| format!("{x:.0}");
    let name = |x: f64| ["four", "five", "six", "seven", "eight"][x as usize - 4];
    says(
        "docs/explanation/integrator.md",
        &[
            format!("$E\\le\\varepsilon/{}$", whole(1.0 / share)),
            format!(
                "$h\\cdot{}\\,(\\varepsilon/{}E)^{{1/7}}$",
                control("SAFETY"),
                whole(1.0 / share)
            ),
            format!(
                "within factors {} and {}.",
                control("LARGEST_SHRINKAGE"),
                control("LARGEST_GROWTH")
            ),
            format!(
                "after {} iterations",
                constant("crates/tip/src/integrator/newton.rs", "MOST_ITERATIONS")
            ),
            format!(
                "at most ${}/\\text{{band}}$ ({} widths of a Gaussian), never by more than {}, and accepted up to {} times",
                estimate("BANDS_PER_STEP"),
                digits(estimate("BANDS_PER_STEP") / band, 2),
                estimate("LONGEST_DISPLACEMENT"),
                control("OVERSHOOT")
            ),
            format!("is $-\\ln e$, $e = \\varepsilon/{}$", whole(1.0 / series)),
            format!(
                "err by less than $\\varepsilon/{}$",
                whole(1.0 / plan("SHARE_OF_INTERPOLATION"))
            ),
            format!("none longer than {} of the limit above", plan("REACH_OF_PIECE")),
            format!("about $\\nu/{}$ times $1/S$", whole(1.0 / switch("REACH"))),
            format!("collocation is tried for {} steps", name(switch("TRIAL"))),
            format!("longer than {} times that", name(switch("COST"))),
            format!("its steps are to be {} times as long", name(switch("COST_WITH_INERTIA"))),
        ],
    );
}

#[test]
fn constants_of_the_memories() {
    let bins = |name| constant("crates/tip/src/memory/record/bins.rs", name);
    let nodes = constant("crates/tip/src/memory/record.rs", "MOST_NODES");
    let band = constant("crates/tip/src/tip_function/scale.rs", "BAND_OF_A_GAUSSIAN");
    // Bins are a power of two long, at most 8/band; a node takes two numbers, a bin its moments.
    let length = (8.0 / band).log2().floor().exp2();
    let room = 8.0 * (2.0 * nodes + bins("MOMENTS") * bins("MOST_BINS"));
    let cells = constant("crates/tip/src/memory/fft.rs", "CELLS_KEPT");
    // Pairs, and the largest weight, of a fit to this accuracy.
    let fit = |wanted: f64| {
        let fit = Fit::new(&triple(1.0), wanted, Retreat::Small).unwrap();
        assert!(fit.certificate().slope <= wanted, "{wanted}");
        let weights = fit.terms().iter().map(|term| term.weight.re.hypot(term.weight.im));
        (fit.terms().len(), weights.fold(0.0, f64::max))
    };
    let (pencil, lattice) = ([1e-7, 1e-10, 9e-12].map(fit), [5e-13, 1e-13, 2e-14].map(fit));
    let weights = lattice.iter().map(|(_, weight)| *weight).fold(0.0, f64::max);
    says(
        "docs/explanation/memories.md",
        &[
            format!("up to $2^{{{}}}$ nodes as they are", nodes.log2()),
            format!("moments of degree below {}", bins("MOMENTS")),
            format!(
                "There are $2^{{{}}}$ bins, {} widths of a Gaussian",
                bins("MOST_BINS").log2(),
                grouped(length * bins("MOST_BINS"))
            ),
            format!("in at most {:.1} MB", 1e-6 * room),
            format!(
                "more than {} nodes lie within reach",
                constant("crates/tip/src/memory/choice.rs", "CROSSOVER_NODES")
            ),
            format!(
                "{}, {} and {} pairs are fitted for accuracies of $10^{{-7}}$, $10^{{-10}}$ and $9\\cdot10^{{-12}}$",
                pencil[0].0, pencil[1].0, pencil[2].0
            ),
            format!("(up to {} there)", digits(pencil[2].1, 3)),
            format!(
                "{}, {} and {} pairs with weights up to {} are fitted for $5\\cdot10^{{-13}}$, $10^{{-13}}$ and \
                 $2\\cdot10^{{-14}}$",
                lattice[0].0,
                lattice[1].0,
                lattice[2].0,
                digits(weights, 3)
            ),
        ],
    );
    says(
        "docs/explanation/memories.md",
        &[format!(
            "within {} cells ({},000 widths of a Gaussian)",
            grouped(cells),
            digits(1e-3 * cells * spacing(band), 2)
        )],
    );
    let extrema = constant("crates/tip/src/motion/extrema.rs", "MOST");
    says("docs/explanation/regimes.md", &[format!("the last {extrema} extrema")]);
    let steps = grouped(constant("crates/tip/src/run/scenario.rs", "MOST_STEPS"));
    says("docs/how-to/long-runs.md", &[format!("more than {steps} steps (230 MB)")]);
    says("notes/speed.md", &[format!("Visits are kept as they are, {} of them", grouped(nodes))]);
}

/// Of the lattice of `fft`: half of what the band asks for.
fn spacing(band: f64) -> f64 {
    0.5 * std::f64::consts::PI / band
}

#[test]
fn critical_points_and_thresholds() {
    let narrow = TipFunction::gaussian(std::f64::consts::FRAC_1_SQRT_2).unwrap();
    let at = |label: &str, tip: &TipFunction| {
        let at = critical(&Wider::default(), tip, 1.0).unwrap();
        format!("| {label} | 1 | {:.12} | {:.12} |", at.alpha, at.omega)
    };
    let slowest = critical_r(&Wider::default(), &triple(1.0), 1.0).unwrap();
    let trapping = |label: &str, beta: f64| {
        let threshold = trapping_alpha(&triple(beta), 1.0).unwrap();
        // At the threshold both rates are one: from just above it.
        let rates =
            |ratio: f64| creep(&Model::new(triple(beta), ratio, 1.0).unwrap()).unwrap().rates();
        let [close, at_3] = [rates(threshold * (1.0 + 1e-12)), rates(3.0)];
        let middle = 0.5 * (close[0] + close[1]);
        format!(
            "| {label} | {threshold:.12} | {middle:.6} | {:.6}, {:.6} |",
            at_3[0].min(at_3[1]),
            at_3[0].max(at_3[1])
        )
    };
    says(
        "docs/explanation/linear-theory.md",
        &[
            at("(48), $\\beta = 1$", &triple(1.0)),
            at("$e^{-x^2/2}$", &triple(0.0)),
            at("$e^{-x^2}$, the paper's numbers for $\\beta = 0$", &narrow),
            format!("| (48), $\\beta = 1$ | {:.12} | 1 | {:.12} |", slowest.r, slowest.omega),
        ],
    );
    says(
        "docs/explanation/trapping.md",
        &[trapping("(48), $\\beta = 1$", 1.0), trapping("$e^{-x^2/2}$", 0.0)],
    );
    let single = critical(&Wider::default(), &triple(0.0), 1.0).unwrap().alpha;
    let rows = [0.5, 1.0, 2.0].map(|pitch| {
        let footprint = Footprint::separable(triple(0.0), 1.0).unwrap();
        let raster = Raster::new(&footprint, Wider::default(), (1.0, pitch), 1.0).unwrap();
        let one_way = raster.critical(RasterPath::OneWay).unwrap();
        let zigzag = raster.critical(RasterPath::Zigzag).unwrap();
        let angle = one_way.crest_angle.unwrap();
        format!("| {pitch} | {:.6} | {angle:.1}° | {:.6} |", one_way.alpha, zigzag.alpha)
    });
    says(
        "docs/explanation/rasters.md",
        &[&rows[..], &[format!("| one line | {single:.6} | 90° | |")]].concat(),
    );
    let small = [(1.0, 1.0), (0.0, 1.0), (1.0, 0.3), (0.0, 0.3)].map(|(beta, r)| {
        let reference = data("onset_reference");
        let is_it = |case: &&Value| (number(&case["beta"]), number(&case["r"])) == (beta, r);
        let case = reference["cases"].as_array().unwrap().iter().find(is_it).unwrap().clone();
        let ours = onset(&triple(beta), r).unwrap();
        let [square, period] =
            ["amplitude_squared_slope", "period_slope"].map(|name| number(&case[name]));
        // The tenth digit is round-off.
        let shown = |x: f64| digits(x, 9);
        format!(
            "| {beta} | {r} | {} | {} | {} | {} |",
            shown(square),
            shown(ours.amplitude_squared_slope),
            shown(period),
            shown(ours.period_slope)
        )
    });
    says("docs/explanation/linear-theory.md", &small);
}

/// The first wave of one-way lines of a round Gaussian at r = 1, on a spring across the scan if there is one.
fn first_across(path: RasterPath, pitch: f64, stiffness: Option<f64>) -> RasterCritical {
    let footprint = Footprint::separable(triple(0.0), 1.0).unwrap();
    let held = Raster::new(&footprint, Wider::default(), (1.0, pitch), 1.0).unwrap();
    let raster = stiffness.map(|stiffness| held.clone().with_stiffness_across(stiffness).unwrap());
    raster.unwrap_or(held).critical(path).unwrap()
}

#[test]
fn thresholds_across_the_scan() {
    let line = Footprint::separable(triple(1.0), 1.0).unwrap();
    let snaking = |stiffness: f64| {
        let line = Snaking::new(&line, Wider::default(), (1.0, stiffness)).unwrap();
        line.critical().unwrap().unwrap()
    };
    let along = critical(&Wider::default(), &triple(1.0), 1.0).unwrap().alpha;
    // It snakes first below the fourth decimal of this, and last above.
    assert!(snaking(0.5661).alpha < along && along < snaking(0.5663).alpha);
    let mut passages = vec![format!("above α = {along:.6}:")];
    passages.extend([0.25, 0.5, 1.0].map(|stiffness| {
        let at = snaking(stiffness);
        format!("| {stiffness} | {:.7} | {:.2} |", at.alpha, at.wavelength)
    }));
    let first = |pitch, stiffness| first_across(RasterPath::OneWay, pitch, stiffness);
    let cell = |pitch: f64, stiffness: Option<f64>| {
        let at = first(pitch, stiffness);
        let what = match at.kind {
            RasterKind::Bunching if at.q == 0.0 => "pairs".into(),
            RasterKind::Bunching => "trenches".into(),
            _ => format!("{:.1}°", at.crest_angle.unwrap()),
        };
        format!("{:.5}, {what}", at.alpha)
    };
    let stiffnesses = [None, Some(10.0), Some(3.0), Some(1.0), Some(0.3)];
    for (pitch, below) in [(0.25, 2.13), (0.5, 2.14), (1.0, 1.9), (1.5, 2.73), (2.0, 3.3)] {
        let kind = |stiffness: f64| first(pitch, Some(stiffness)).kind;
        assert_eq!(kind(below - 0.006), RasterKind::Bunching, "{pitch}");
        assert_eq!(kind(below + 0.006), RasterKind::Ripples, "{pitch}");
        let cells = stiffnesses.map(|stiffness| cell(pitch, stiffness)).join(" | ");
        passages.push(format!("| {pitch} | {cells} | {below:.2} |"));
    }
    let [across, axis] = [0.65, 1.54].map(|stiffness| first(0.5, Some(stiffness)).alpha);
    let held = first(0.5, None).alpha;
    says("docs/findings/README.md", &[format!("are {across:.5} and {axis:.5}, against {held:.5}")]);
    let zigzag = |stiffness| first_across(RasterPath::Zigzag, 0.5, Some(stiffness));
    assert!(zigzag(1.0).q.abs() < 1e-12);
    passages.push(format!("above {:.5}, close to", zigzag(1.0).alpha));
    passages.push(format!("a quarter higher, {:.5}.", zigzag(3.0).alpha));
    says("docs/explanation/across.md", &passages);
}

#[test]
fn the_limit_cycle_next_to_onset() {
    let alpha = critical(&Wider::default(), &triple(1.0), 1.0).unwrap().alpha + 0.01;
    let found = cycle(&Model::new(triple(1.0), alpha, 1.0).unwrap(), DEFAULT_TOLERANCE).unwrap();
    says(
        "docs/reference/accuracy.md",
        &[format!(
            "with period {:.10} and amplitude {:.10};",
            found.period(),
            found.amplitude_x0()
        )],
    );
}

/// Motions have the same bits on every machine, and so has the time until which they keep their tolerance.
#[test]
fn tolerances_last_as_long_as_told() {
    let folder = Folder::new("lasting");
    let row = |digits: i32| {
        folder.prints(&format!(
            "run --alpha 1.2 --r 1 --kick 0.05 --until 1e4 --sample-every 10 --tolerance 1e-{digits} -o run.jsonl"
        ));
        let verified = folder.stickslip("verify run.jsonl");
        assert_eq!(verified.status.code(), Some(1), "{}", said(&verified));
        let verified: Value = serde_json::from_slice(&verified.stdout).unwrap();
        let until = number(&verified["verification"]["trusted_until"]);
        format!("| 1e-{digits} | {} |", grouped(until))
    };
    says("docs/how-to/long-runs.md", &[6, 8].map(row));
}

/// The judge itself: a number changed in a document, a constant, or a file of data is found.
#[test]
fn a_stale_number_is_found() {
    let passages = [format!("up to $2^{{{}}}$ nodes", 15)];
    assert!(missing("keeps up to $2^{15}$\n  nodes", &passages).is_empty());
    assert_eq!(missing("keeps up to $2^{14}$ nodes", &passages), passages.each_ref());
    let shown = [1.35, 26.4, 1098.0, 73_600.0].map(ratio);
    assert_eq!(shown, ["1.4", "26", "1,100", "7e4"]);
    let times = [0.000_101_2, 0.0996, 7.44, 317.0].map(duration);
    assert_eq!(times, ["0.10 ms", "100 ms", "7.4 s", "5.3 min"]);
    assert!((constant("crates/tip/src/integrator/control.rs", "SAFETY") - 0.9).abs() < 1e-15);
}
