//! What is read back of documents: a run whole, what is something else refused by its beginning.

use serde_json::Value;
use std::io::{self, Read};
use stickslip::{
    Dimension, Indentation, RegimeName, Run, RunDocument, RunEnd, SCHEMAS, SampleLine, Samples,
    SweepDocument, Tip, WorkDocument, dimension, read, read_from,
};
use stickslip_tip::{Model, Scenario, TipFunction, run};

/// The unit that the description of a field names: `in σ`, `in kσ/Γ, one order less accurate`.
fn described(description: &str) -> Option<Dimension> {
    let words: Vec<&str> = description.split_whitespace().collect();
    let unit = |pair: &[&str]| {
        let named = pair[0] == "in" || pair[0].ends_with(',');
        named.then(|| Dimension::of_unit(pair[1].trim_end_matches(['.', ',', ';', ':']))).flatten()
    };
    words.windows(2).find_map(unit)
}

/// Fields of numbers in a schema: the part that holds each, its name, and its description.
fn fields(root: &Value, at: &Value, part: &str, found: &mut Vec<[String; 3]>, depth: usize) {
    let referred = at["$ref"].as_str().and_then(|name| root.pointer(name.trim_start_matches('#')));
    let kinds = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|name| at[name].as_array());
    if depth < 12 {
        let below = kinds.flatten().chain(referred).chain(at.get("items"));
        below.for_each(|kind| fields(root, kind, part, found, depth + 1));
    }
    for (name, field) in at["properties"].as_object().into_iter().flatten() {
        let description = field["description"].as_str().unwrap_or_default();
        if field.to_string().contains("\"number\"") {
            found.push([part, name, description].map(String::from));
        }
        if !UNTOUCHED.contains(&name.as_str()) && depth < 12 {
            fields(root, field, name, found, depth + 1);
        }
    }
}

/// Parts that `physical` does not mirror.
const UNTOUCHED: [&str; 6] =
    ["parameters", "history", "work", "verification", "physical", "floquet"];
/// Documents that are in units, with their own or none, or are not told in them.
const OTHERS: [&str; 11] = [
    "run-lines",
    "checkpoint",
    "verify",
    "tip",
    "fit",
    "fit-image",
    "friction",
    "load-map",
    "units",
    "figure",
    "reproduction",
];

/// What has the unit of what it is a part, or a statistic, of.
const OF_THE_WHOLE: [&str; 8] =
    ["re", "im", "mean", "least", "median", "largest", "error", "deviation"];

/// What each number is a multiple of is told by its name, and said in its description: two lists that know nothing of
/// each other.
#[test]
fn dimensions_are_those_that_the_schemas_describe() {
    let mut judged = 0;
    for (document, schema) in SCHEMAS.iter().filter(|(name, _)| !OTHERS.contains(name)) {
        let (schema, mut found): (Value, _) = (serde_json::from_str(schema).unwrap(), vec![]);
        fields(&schema, &schema, "", &mut found, 0);
        for [part, name, description] in found {
            let (told, said) = (dimension(&part, &name), described(&description));
            if said.is_some() || !OF_THE_WHOLE.contains(&name.as_str()) {
                judged += usize::from(said.is_some());
                assert_eq!(told, said, "{document}: {part}.{name}: {description}");
            }
        }
    }
    assert!(judged > 100, "{judged}");
}

/// Counts what is read of an endless stream.
struct Endless<'a>(&'a [u8], u64);

impl Read for Endless<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        for byte in buffer.iter_mut() {
            let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
            (*byte, self.0) = (*first, rest);
        }
        self.1 += buffer.len() as u64;
        Ok(buffer.len())
    }
}

#[test]
fn what_is_something_else_is_told_by_its_beginning() {
    let begins = [
        ("", "not a complete JSON document"),
        ("0.1,0.2\n", "not a complete JSON document"),
        ("{\"format\":\"stickslip/run\",\"format_version\":1,", "format is stickslip/run"),
        ("{\"format\":\"stickslip/sweep\",\"format_version\":7,", "format_version is 7"),
        ("{\"format\":\"stickslip/sweep\",\"format_version\":1,\"points\":[", "damaged"),
        ("{\"points\":[1,2,3],\"format_version\":1,", "not a complete"),
    ];
    for (begins, words) in begins {
        let mut endless = Endless(begins.as_bytes(), 0);
        let read = read_from::<SweepDocument>(&mut endless, SweepDocument::FORMAT);
        let said = read.unwrap_err().to_string();
        assert!(said.contains(words), "{begins}: {said}");
        assert!(endless.1 < 4 << 16, "{begins}: {} bytes", endless.1);
    }
}

/// A document is the run: scenario and motion come back from its text to the last bit.
#[test]
fn a_run_comes_back_from_its_document() {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 1.0).unwrap();
    let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 40.0) };
    let done = run(&scenario).unwrap();
    let end = RunEnd {
        end: 40.0,
        regime: RegimeName::Transient,
        oscillation: None,
        creep: None,
        snaking: None,
        drifting: None,
        transient: None,
        remarks: vec![],
        interrupted: false,
        work: WorkDocument {
            memory: done.memory.into(),
            memory_reason: String::new(),
            steps: done.work.steps,
            rejected: done.work.rejected,
            newton_iterations: done.work.newton_iterations,
            series: done.work.series,
            switches: done.work.switches,
            seconds: 0.0,
        },
    };
    let history = Some((&done.trajectory).into());
    let question = Run::new(Tip::default(), Indentation::given(1.2), 1.0, 40.0);
    let question = Run { kick: 0.05, ..question };
    let document = question.document(Samples::default(), history, end);
    let text = serde_json::to_string(&document).unwrap();
    let back: RunDocument = read(&text, RunDocument::FORMAT).unwrap();
    let again = run(&back.parameters.scenario().unwrap()).unwrap();
    let trajectory = back.trajectory().unwrap();
    for t in [16.5, 25.0, 40.0] {
        let bits = [&done.trajectory, &again.trajectory, &trajectory].map(|m| m.l(t).to_bits());
        assert_eq!(bits, [bits[0]; 3], "t = {t}");
    }
    let other = read::<RunDocument>(&text, "stickslip/cycle").unwrap_err();
    assert!(other.to_string().contains("is needed"), "{other}");
    let mut none = back;
    none.history = None;
    let none = none.trajectory().unwrap_err();
    assert!(none.to_string().contains("--history all"), "{none}");
}

/// Whatever the value and its error, a person can read it, and a reader of it comes within the error.
#[test]
fn no_number_is_longer_than_a_person_reads() {
    let sizes = (-320..=304).step_by(4).map(|e| format!("3.7e{e}").parse::<f64>().unwrap());
    let sizes: Vec<f64> = sizes.chain([0.0, f64::MIN_POSITIVE, 1e308, 5e-324]).collect();
    for value in sizes.iter().flat_map(|size| [*size, -size]) {
        for error in &sizes {
            let shown = stickslip::to_its_digits(value, *error);
            assert!(shown.len() <= 42, "{value:e} ± {error:e}: {shown}");
            let (before, rest) = shown.split_once('(').unwrap_or((&shown, ")"));
            let after = rest.split_once(')').unwrap().1;
            let read: f64 = format!("{before}{after}").parse().unwrap();
            let off = (read - value).abs();
            assert!(off <= *error + 1e-13 * value.abs() + 1e-320, "{value:e} ± {error:e}: {shown}");
        }
    }
    assert_eq!(stickslip::to_its_digits(f64::NAN, 1.0), "NaN(?)");
    assert_eq!(stickslip::to_its_digits(1.0, f64::INFINITY), "1e0(?)");
}

/// A sample at a time, with or without a height.
fn sample(t: f64, height: Option<f64>) -> SampleLine {
    let x0 = 10.0 * t;
    SampleLine {
        t,
        l: None,
        lag: Some(-t),
        x0,
        velocity: 10.0,
        height,
        weight: None,
        y0: None,
        velocity_y: None,
    }
}

#[test]
fn columns_are_those_that_all_samples_have() {
    let samples: Samples = [sample(0.0, Some(1.0)), sample(1.0, Some(2.0))].into_iter().collect();
    assert_eq!(samples.height, Some(vec![1.0, 2.0]));
    assert_eq!((&samples.l, &samples.lag), (&None, &Some(vec![-0.0, -1.0])));
    assert!(samples.are_even());
    let samples: Samples = [sample(0.0, Some(1.0)), sample(1.0, None)].into_iter().collect();
    assert_eq!(samples.height, None);
}

#[test]
fn an_interrupted_run_has_the_samples_taken_in_the_order_requested() {
    // Requested: 5, 1, 3, 0; taken in the order of time, as far as t = 3.
    let taken: Samples = [0.0, 1.0, 3.0].into_iter().map(|t| sample(t, None)).collect();
    let ordered = taken.ordered_by(&[3, 1, 2, 0]);
    assert_eq!(ordered.t, [1.0, 3.0, 0.0]);
    assert_eq!(ordered.x0, [10.0, 30.0, 0.0]);
}
