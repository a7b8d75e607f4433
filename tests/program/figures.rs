//! Does `stickslip figures` redraw the paper, and are its numbers audited?
//!
//! Judges: the numbers typed here from the paper, `data/reference_values.json` (30-digit arithmetic),
//! the entries of `docs/findings/corrections.md`, the schemas that the program prints, and a second making of the
//! same.

use crate::acceptance::Acceptance;
use crate::folder::Folder;
use serde_json::Value;
use std::process::Command;
use stickslip_tip::{MemoryChoice, Model, Scenario, TipFunction, run};

const FIGURES: [&str; 11] = [
    "fig1",
    "fig2",
    "fig3",
    "fig4",
    "fig5",
    "fig6",
    "fig7",
    "bifurcation",
    "criticality",
    "kymograph",
    "work-precision",
];
/// Those that take no time.
const QUICK: &str = "fig1,fig2,fig3,fig5,fig6,criticality,kymograph,work-precision,reproduction";

fn numbers(folder: &Folder) -> Vec<Value> {
    folder.prints("figures --out-dir . --only reproduction");
    folder.json("reproduction.json")["numbers"].as_array().unwrap().clone()
}

fn text<'a>(number: &'a Value, field: &str) -> &'a str {
    number[field].as_str().unwrap()
}

fn number(number: &Value, field: &str) -> f64 {
    number[field].as_f64().unwrap()
}

#[test]
fn every_printed_number_is_within_its_precision_or_explained() {
    let folder = Folder::new("reproduction");
    let corrections = include_str!("../../docs/findings/corrections.md");
    let pinned = include_str!("../science/corrections.rs");
    for entry in numbers(&folder) {
        let (ours, value, half) =
            (number(&entry, "ours"), number(&entry, "value"), number(&entry, "precision"));
        let agrees = (ours - value).abs() <= half * (1.0 + 1e-9);
        assert_eq!(entry["agrees"], agrees, "{entry}");
        let Some(correction) = entry["correction"].as_u64() else {
            assert!(agrees, "{entry} is not explained");
            continue;
        };
        // What is explained must need it.
        assert!(!agrees, "{entry} needs no explanation");
        let (_, section) = corrections.split_once(&format!("\n## {correction}. ")).unwrap();
        let section = section.split("\n## ").next().unwrap();
        let test = section.split_once("*Test:* `").unwrap().1.split('`').next().unwrap();
        assert!(pinned.contains(&format!("fn {test}()")), "{test}");
        assert!(!text(&entry, "remark").is_empty());
    }
}

/// The numbers that stand in the paper's text and captions, one by one.
#[test]
fn the_table_holds_what_the_paper_prints() {
    let folder = Folder::new("printed");
    let all = numbers(&folder);
    let has = |case: &str, quantity: &str, printed: &str| {
        let like = |entry: &&Value| {
            text(entry, "case").starts_with(case)
                && text(entry, "quantity").starts_with(quantity)
                && text(entry, "printed") == printed
        };
        assert!(all.iter().any(|entry| like(&entry)), "{quantity} = {printed} for {case}");
    };
    for (case, alpha, omega, length) in [
        ("β = 1, r = 1", "1.069", "0.943", "6.665"),
        ("exp(-x²), r = 1", "1.608", "0.934", "6.727"),
        ("(48) with β = 0", "1.608", "0.934", "6.727"),
    ] {
        has(case, "αc", alpha);
        has(case, "ω", omega);
        has(case, "L = 2πr/ω", length);
    }
    for (quantity, printed) in
        [("rc", "0.96"), ("ω", "0.915"), ("T at r → rc", "6.59"), ("L at r → rc", "6.59")]
    {
        has("β = 1, α = 1", quantity, printed);
    }
    has("k = 1.406", "αc/r of Gnecco", "0.7112");
    has("β = 1, r = 1", "T = 2π/ω", "6.665");
    has("β = 1, r = 1", "exponent of the amplitude of u", "1/2");
    has("β = 1, r = 1, α", "mean of ẋ0", "1");
    has("f = J0, r = 2", "αc", "4");
    has("β = 0", "rate of compression", "1");
}

/// A number of data/reference_values.json.
fn reference(name: &str) -> f64 {
    let document = include_str!("../../data/reference_values.json");
    let (_, entry) = document.split_once(&format!("\"{name}\"")).expect("the name is in the file");
    entry.split('"').nth(3).expect("its value follows").parse().expect("which is a number")
}

#[test]
fn our_numbers_are_those_of_30_digit_arithmetic() {
    let folder = Folder::new("against_reference");
    let all = numbers(&folder);
    let ours = |case: &str, quantity: &str| {
        let like = |e: &&Value| text(e, "case") == case && text(e, "quantity") == quantity;
        number(all.iter().find(like).unwrap(), "ours")
    };
    let close = Acceptance { floor: 1e-11, slack: 0.0 };
    for (case, name) in [
        ("β = 1, r = 1", "critical.triple_gaussian.r_1.0"),
        ("exp(-x²), r = 1", "critical.narrow_gaussian.r_1.0"),
        ("(48) with β = 0, r = 1", "critical.gaussian.r_1.0"),
    ] {
        for (quantity, part) in [("αc", "alpha"), ("ω", "omega")] {
            let exact = reference(&format!("{name}.{part}"));
            close.judge(&format!("{quantity}, {case}"), (ours(case, quantity) - exact).abs(), 0.0);
        }
    }
    let f0 = reference("footprint.triple_gaussian.value_at_0");
    close.judge("f(0)", (ours("β = 1", "f(0)") - f0).abs(), 0.0);
}

#[test]
fn the_page_has_a_row_for_each_number() {
    let folder = Folder::new("page");
    let all = numbers(&folder);
    let page = String::from_utf8(folder.read("reproduction.md")).unwrap();
    let rows = page.lines().filter(|line| line.starts_with("| ")).count();
    assert_eq!(rows, all.len() + 1, "and the heading");
    assert!(!page.contains("**differs**") && page.contains("1.069036175"));
}

#[test]
fn every_figure_is_written_as_json_svg_and_png() {
    let folder = Folder::new("figures");
    let mut command = folder.command("figures --out-dir made/here");
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", crate::folder::said(&output));
    assert!(output.stdout.is_empty());
    let schema = |name: &str| {
        jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap()
    };
    let (figure, table) = (schema("figure"), schema("reproduction"));
    assert!(table.is_valid(&folder.json("made/here/reproduction.json")));
    for name in FIGURES {
        let document = folder.json(&format!("made/here/{name}.json"));
        let errors: Vec<String> =
            figure.iter_errors(&document).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{name}: {}", errors.join("\n"));
        assert_eq!(document["name"], name);
        let svg = String::from_utf8(folder.read(&format!("made/here/{name}.svg"))).unwrap();
        assert!(svg.starts_with("<svg"));
        if cfg!(feature = "png") {
            assert!(folder.read(&format!("made/here/{name}.png")).starts_with(b"\x89PNG"));
        }
    }
    // What the figures of the doubled period and of the settled ripple must show.
    let panels = folder.json("made/here/bifurcation.json")["panels"].clone();
    let named = |panel: usize, name: &str| {
        let curves = panels[panel]["curves"].as_array().unwrap();
        curves.iter().find(|curve| curve["name"] == name).unwrap().clone()
    };
    let maxima = named(1, "maxima of l in runs");
    let count = |low: f64, high: f64| -> usize {
        let x = maxima["x"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap());
        x.filter(|x| (low..high).contains(x)).count()
    };
    assert_eq!(count(1.599, 1.601), 2, "a doubled period");
    assert_eq!(count(1.399, 1.401), 1);
    // At 1.06 the oscillation has not died out yet.
    assert_eq!(count(1.0, 1.055), 0, "steady");
    // The doublings that the branch finds lie where the runs begin and cease to have two maxima.
    let doublings = named(0, "period doubling")["x"].as_array().unwrap().clone();
    let [first, last] = [0, 1].map(|i| doublings[i].as_f64().unwrap());
    assert_eq!(doublings.len(), 2);
    assert_eq!(count(first + 0.011, first + 0.0211), 2, "beyond {first}");
    assert_eq!(count(last + 0.011, last + 0.0211), 1, "beyond {last}");
    let ripple = &folder.json("made/here/fig4.json")["panels"][0]["curves"][0];
    let u: Vec<f64> =
        ripple["y"].as_array().unwrap()[3800..4400].iter().map(|u| u.as_f64().unwrap()).collect();
    let (low, high) = u.iter().fold((f64::MAX, f64::MIN), |(a, b), u| (a.min(*u), b.max(*u)));
    assert!(
        (1.8..2.0).contains(&(high - low)),
        "the ripple has grown out of the noise: {low} {high}"
    );
}

#[test]
fn figures_come_out_the_same_again_whatever_the_thread_count() {
    let folder = Folder::new("again");
    for (name, threads) in [("one", "1"), ("two", "2")] {
        let mut command: Command =
            folder.command(&format!("figures --out-dir {name} --only {QUICK}"));
        let output = command.env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(output.status.success(), "{}", crate::folder::said(&output));
    }
    for name in QUICK.split(',') {
        for extension in if name == "reproduction" { ["json", "md"] } else { ["json", "svg"] } {
            let [one, two] =
                ["one", "two"].map(|made| folder.read(&format!("{made}/{name}.{extension}")));
            assert!(one == two, "{name}.{extension} differs");
        }
    }
}

/// The slope that the bifurcation theory foretells, against the fits of Fig. 2.
#[test]
fn the_lines_of_fig_2_have_the_slopes_of_the_theory() {
    let folder = Folder::new("slopes");
    folder.prints("figures --out-dir . --only fig2");
    let figure = folder.json("fig2.json");
    for (panel, slope, within) in [(0, 3.845, 0.02), (1, 5.0, 0.2)] {
        let line = &figure["panels"][panel]["curves"][3];
        let at = |field: &str, i: usize| line[field][i].as_f64().unwrap();
        let found = (at("y", 1) - at("y", 0)) / (at("x", 1) - at("x", 0));
        println!("panel {panel}: {found}, {slope} in theory; {}", figure["remarks"]);
        assert!((found / slope - 1.0).abs() < within, "{found}");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_refused() {
    let folder = Folder::new("no_folder");
    folder.write("file", "taken");
    folder.refuses("figures --out-dir file", &["--out-dir file"]);
    folder.refuses("figures --out-dir . --only fig8", &["fig8", "fig7"]);
    folder.refuses("figures", &["--out-dir"]);
    assert_eq!(folder.names(), ["file"]);
}

/// The table in the documents is the one that the program writes.
#[test]
fn the_table_in_the_documents_is_up_to_date() {
    let folder = Folder::new("documents");
    folder.prints("figures --out-dir . --only reproduction");
    let ours = String::from_utf8(folder.read("reproduction.md")).unwrap();
    assert_eq!(ours, include_str!("../../docs/figures/paper/reproduction.md"));
}

/// The diagram is measured by hand; what it counts must be what the integrator does today.
#[test]
fn the_measured_diagram_is_of_this_integrator() {
    let measured: Value =
        serde_json::from_str(include_str!("../../data/work_precision.json")).unwrap();
    let counted = |case: &Value, memory: &str| -> u64 {
        let ours = |curve: &&Value| curve["case"] == case["name"] && curve["method"] == memory;
        let curve = measured["curves"].as_array().unwrap().iter().find(ours).unwrap();
        let at = |point: &&Value| number(point, "tolerance").log10().round() as i32 == -6;
        curve["points"].as_array().unwrap().iter().find(at).unwrap()["steps"].as_u64().unwrap()
    };
    for case in measured["cases"].as_array().unwrap() {
        for (name, memory) in [("modes", MemoryChoice::Modes), ("fft", MemoryChoice::Fft)] {
            let tip = TipFunction::triple_gaussian(number(case, "beta"), 1.0).unwrap();
            let model = Model::new(tip, number(case, "alpha"), number(case, "r")).unwrap();
            let start = Scenario::new(model, number(case, "until"));
            let kick = number(case, "kick");
            let result = run(&Scenario { kick, tolerance: 1e-6, memory, ..start }).unwrap();
            assert_eq!(result.work.steps, counted(case, name), "{name}, {}", case["name"]);
        }
    }
}
