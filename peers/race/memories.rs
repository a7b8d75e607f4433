//! The closed equation, by each of its memories.

use crate::case::{Reference, scenario};
use crate::{row, timed};
use serde_json::Value;
use stickslip_tip::{MemoryChoice, run};

pub(crate) fn rows(reference: &Reference) -> Vec<Value> {
    let memories = [
        ("closed, modes", MemoryChoice::Modes),
        ("closed, fft", MemoryChoice::Fft),
        ("closed, direct", MemoryChoice::Direct),
    ];
    let mut rows = vec![];
    for (name, memory) in memories {
        // By half a decade: others are tried at steps as near to each other.
        for halves in 6..=22 {
            let digits = 0.5 * f64::from(halves);
            let scenario = scenario(memory, 10.0_f64.powf(-digits));
            let (run, seconds) = timed(|| run(&scenario).expect("a run that ends"));
            let error = reference.error(reference.t.iter().map(|t| run.trajectory.l(*t)));
            rows.push(row(name, format!("tolerance 1e-{digits}"), seconds, Some(error), ""));
        }
    }
    rows
}
