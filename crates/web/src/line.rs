//! Command lines of the program that compute what the page shows.

use crate::parameters::Parameters;
use crate::scan::Scan;
use serde_json::{Map, Value};
use stickslip::parameter::typed;
use stickslip::{PathName, StartName};

/// Options of the model, without those that equal the program's defaults.
fn model(parameters: &Parameters) -> String {
    let Parameters { alpha, r, beta, width, depth_limit, healing_time, inertia, .. } = *parameters;
    let differs = |value: f64, usual: f64| (value - usual).abs() > 0.0;
    let is_round = !differs(beta, 0.0);
    [
        is_round.then(|| " --tip gaussian".to_owned()),
        (!is_round && differs(beta, 1.0)).then(|| format!(" --beta {beta}")),
        differs(width, 1.0).then(|| format!(" --width {width}")),
        Some(format!(" --alpha {alpha} --r {r}")),
        depth_limit.map(|b| format!(" --depth-limit {b}")),
        healing_time.map(|time| format!(" --healing-time {time}")),
        inertia.map(|mass| format!(" --inertia {mass}")),
        parameters.stiffness_across.map(|stiffness| format!(" --stiffness-across {stiffness}")),
        parameters.pushed_across().map(|kick| format!(" --kick-across {kick}")),
    ]
    .into_iter()
    .flatten()
    .collect()
}

pub(crate) fn run(parameters: &Parameters) -> String {
    let kick = if parameters.kick.abs() > 0.0 {
        format!(" --kick {}", parameters.kick)
    } else {
        String::new()
    };
    let start = if parameters.start == StartName::Flat { " --start flat" } else { "" };
    format!(
        "stickslip run{}{start}{kick} --until {} -o run.json",
        model(parameters),
        parameters.until
    )
}

pub(crate) fn raster(parameters: &Parameters, scan: &Scan) -> String {
    let Scan { pitch, lines, length, .. } = scan;
    let pitch = match scan.path {
        PathName::Repeat => String::new(),
        PathName::OneWay | PathName::Zigzag => format!(" --pitch {pitch}"),
    };
    let path = scan.path_option();
    format!(
        "stickslip raster{}{pitch} --lines {lines} --length {length}{path} --tolerance {:e} -o raster.json",
        model(parameters),
        crate::scan::TOLERANCE
    )
}

/// The command line of a walker, from the parameters that are not null.
pub(crate) fn walker(given: &Map<String, Value>) -> String {
    let given = given.iter().filter(|(_, value)| !value.is_null());
    let options =
        given.map(|(name, value)| format!(" --{} {}", name.replace('_', "-"), typed(value)));
    format!("stickslip run --walker{} -o walker.json", options.collect::<String>())
}
