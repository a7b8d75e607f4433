//! Command lines that do the same.

use crate::asked::Asked;
use crate::scan::Scan;
use serde_json::{Map, Value};
use stickslip::parameter::typed;
use stickslip::{PathName, StartName};

/// Options of the model; what is the program's default is left out.
fn model(asked: &Asked) -> String {
    let Asked { alpha, r, beta, width, depth_limit, healing_time, inertia, .. } = *asked;
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
        asked.stiffness_across.map(|stiffness| format!(" --stiffness-across {stiffness}")),
        asked.pushed_across().map(|kick| format!(" --kick-across {kick}")),
    ]
    .into_iter()
    .flatten()
    .collect()
}

pub(crate) fn run(asked: &Asked) -> String {
    let kick =
        if asked.kick.abs() > 0.0 { format!(" --kick {}", asked.kick) } else { String::new() };
    let start = if asked.start == StartName::Flat { " --start flat" } else { "" };
    format!("stickslip run{}{start}{kick} --until {} -o run.json", model(asked), asked.until)
}

pub(crate) fn raster(asked: &Asked, scan: &Scan) -> String {
    let Scan { pitch, lines, length, .. } = scan;
    let pitch = match scan.path {
        PathName::Repeat => String::new(),
        PathName::OneWay | PathName::Zigzag => format!(" --pitch {pitch}"),
    };
    let path = scan.path_option();
    format!(
        "stickslip raster{}{pitch} --lines {lines} --length {length}{path} --tolerance {:e} -o raster.json",
        model(asked),
        crate::scan::TOLERANCE
    )
}

/// Of the parameters of a walker those that are given.
pub(crate) fn walker(given: &Map<String, Value>) -> String {
    let given = given.iter().filter(|(_, value)| !value.is_null());
    let options =
        given.map(|(name, value)| format!(" --{} {}", name.replace('_', "-"), typed(value)));
    format!("stickslip run --walker{} -o walker.json", options.collect::<String>())
}
