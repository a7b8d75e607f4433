//! A run and its classification: `cargo run --release --example first_run`.

use std::error::Error;
use stickslip::outcome::{Regime, run_and_judge};
use stickslip::tip::{Model, Scenario, TipFunction};

fn main() -> Result<(), Box<dyn Error>> {
    let tip = TipFunction::triple_gaussian(1.0, 1.0)?; // β = 1, width 1
    let model = Model::new(tip, 1.2, 1.0)?; // α = 1.2, r = 1
    let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 400.0) };
    let (run, outcome) = run_and_judge(&scenario)?;
    for t in [50.0, 100.0, 400.0] {
        println!("l({t}) = {:.9}", run.trajectory.l(t));
    }
    let motion = outcome.oscillation.ok_or("no oscillation")?;
    println!("period {:.9} ± {:.0e}", motion.period, motion.period_error);
    assert_eq!(outcome.regime, Regime::StickSlip);
    Ok(())
}
