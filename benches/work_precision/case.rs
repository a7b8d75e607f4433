//! The regimes that the diagram is about.

use serde::Serialize;
use stickslip_tip::{MemoryChoice, Model, Scenario, TipFunction};

/// A run from the steady state at x = 14, l above it by `kick`.
#[derive(Debug, Serialize)]
pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) beta: f64,
    pub(super) alpha: f64,
    pub(super) r: f64,
    pub(super) kick: f64,
    pub(super) until: f64,
}

const fn case(name: &'static str, beta: f64, alpha: f64, r: f64, kick: f64, until: f64) -> Case {
    Case { name, beta, alpha, r, kick, until }
}

/// Onset is the paper's Fig. 1; the others go from soft to stiff.
pub(super) const CASES: [Case; 5] = [
    case("onset", 1.0, 1.079_036_174_947, 1.0, 0.01, 457.0),
    case("stick-slip", 1.0, 1.2, 1.0, 0.05, 457.0),
    case("period-doubled", 1.0, 1.62, 1.0, 0.05, 76.0),
    case("trapped", 1.0, 4.0, 1.0, 0.01, 457.0),
    case("small r", 0.9, 0.05, 0.1, 0.01, 400.0),
];

impl Case {
    pub(super) fn model(&self) -> Model {
        let tip = TipFunction::triple_gaussian(self.beta, 1.0).expect("a valid tip");
        Model::new(tip, self.alpha, self.r).expect("a valid model")
    }

    pub(super) fn scenario(&self, tolerance: f64, memory: MemoryChoice) -> Scenario {
        let run = Scenario::new(self.model(), self.until);
        Scenario { kick: self.kick, tolerance, memory, ..run }
    }
}

/// Processor and number of cores, as Linux reports them.
pub(super) fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let known = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = known.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    format!("{}, {cores} cores", name.map_or("unknown processor", |(_, name)| name.trim()))
}
