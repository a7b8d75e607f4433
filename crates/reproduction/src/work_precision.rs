//! Time against error. Times vary between measurements; therefore the figure uses the saved results of `make
//! work-precision`.

use super::parts::{Failed, curve, failed, figure as empty};
use serde::Deserialize;
use stickslip::{FigureDocument, PanelDocument, ScaleName, StyleName};
use stickslip_tip::{Model, TipFunction};

/// Results of benches/work_precision.
const MEASURED: &str = include_str!("../../../data/work_precision.json");

#[derive(Debug, Deserialize)]
struct Measured {
    machine: String,
    cases: Vec<Case>,
    curves: Vec<Curve>,
}

#[derive(Debug, Deserialize)]
struct Case {
    name: String,
    beta: f64,
    alpha: f64,
    r: f64,
    until: f64,
}

#[derive(Debug, Deserialize)]
struct Curve {
    case: String,
    method: String,
    points: Vec<Point>,
}

#[derive(Debug, Deserialize)]
struct Point {
    error: f64,
    seconds: f64,
}

/// The methods, with their styles and names.
const METHODS: [(&str, StyleName, &str); 3] = [
    ("modes", StyleName::Line, "modes"),
    ("fft", StyleName::Dashed, "fft"),
    ("explicit", StyleName::Dotted, "modes, explicit (DOP853)"),
];

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let measured: Measured =
        serde_json::from_str(MEASURED).map_err(failed("work_precision.json"))?;
    let models: Result<Vec<Model>, Failed> = measured.cases.iter().map(Case::model).collect();
    let mut document = empty("work-precision", "Time of a run against its error", &models?);
    document.remarks.push(format!(
        "measured before (`make work-precision`) on {}: the shortest of many runs in process, the sum of \
         exponentials fitted before; the error is the largest of l, against fft at a tolerance of 1e-12",
        measured.machine
    ));
    document.columns = 2;
    for case in &measured.cases {
        let Case { name, beta, alpha, r, until } = case;
        let alpha = (alpha * 1e4).round() / 1e4;
        let heading = format!("{name}: β = {beta}, α = {alpha}, r = {r}, t ≤ {until}");
        let mut panel = PanelDocument::new(&heading, ("largest error of l (σ)", "time (ms)"));
        (panel.x_scale, panel.y_scale) = (ScaleName::Logarithmic, ScaleName::Logarithmic);
        for (method, style, name) in METHODS {
            let here =
                |c: &&Curve| c.case == case.name && c.method == method && !c.points.is_empty();
            let Some(found) = measured.curves.iter().find(here) else { continue };
            let errors: Vec<f64> = found.points.iter().map(|p| p.error).collect();
            let times: Vec<f64> = found.points.iter().map(|p| 1e3 * p.seconds).collect();
            panel.curves.push(curve(style, name, &errors, &times));
        }
        document.panels.push(panel);
    }
    Ok(document)
}

impl Case {
    fn model(&self) -> Result<Model, Failed> {
        let tip = TipFunction::triple_gaussian(self.beta, 1.0);
        let tip = tip.map_err(failed("the tip"))?;
        Model::new(tip, self.alpha, self.r).map_err(failed("the model"))
    }
}
