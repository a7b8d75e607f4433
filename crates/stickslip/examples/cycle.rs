//! A limit cycle with its Floquet multipliers, without waiting for a run to come to it.

use std::error::Error;
use stickslip::cycles::{DEFAULT_TOLERANCE, cycle};
use stickslip::tip::{Model, TipFunction};

fn main() -> Result<(), Box<dyn Error>> {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0)?, 1.2, 1.0)?;
    let found = cycle(&model, DEFAULT_TOLERANCE)?;
    println!("period {:.10} ± {:.0e}", found.period(), found.error());
    println!("amplitude {:.10}", found.amplitude_x0());
    for multiplier in found.nontrivial_multipliers().take(3) {
        println!("multiplier {multiplier:.6}");
    }
    assert!(found.is_stable());
    Ok(())
}
