//! The motion that the tip settles into, at points of the plane of r and α.

use std::error::Error;
use stickslip::outcome::{Motion, motion};
use stickslip::tip::{Model, TipFunction};

fn main() -> Result<(), Box<dyn Error>> {
    let tip = TipFunction::triple_gaussian(1.0, 1.0)?;
    let mut told = vec![];
    for alpha in [0.9, 1.2, 1.62] {
        let found = motion(&Model::new(tip.clone(), alpha, 1.0)?, 1e-6)?;
        told.push(match &found {
            Motion::Steady => "steady".to_owned(),
            Motion::Cycle(cycle) => {
                format!("{} slips, period {:.5}", cycle.slips(), cycle.period())
            }
            Motion::Run(outcome) => format!("{:?}", outcome.regime),
        });
        println!("α = {alpha}: {}", told[told.len() - 1]);
    }
    assert!(told[0] == "steady" && told[1].starts_with('1') && told[2].starts_with('2'));
    Ok(())
}
