//! Cycles followed in α from where they are born, until their period doubles.

use std::error::Error;
use std::ops::ControlFlow;
use stickslip::cycles::{Continuation, Parameter, SpecialKind};
use stickslip::tip::TipFunction;

fn main() -> Result<(), Box<dyn Error>> {
    let tip = TipFunction::triple_gaussian(1.0, 1.0)?;
    let follow = Continuation { to: 1.55, tolerance: 1e-7, ..Continuation::default() };
    let branch = follow.from_onset(&tip, 1.0, |_| ControlFlow::Continue(()))?;
    println!("{} cycles", branch.points.len());
    for special in &branch.special {
        println!("{:?} at α = {:.6}", special.kind, special.parameter(Parameter::Alpha));
    }
    assert!(branch.special.iter().any(|special| special.kind == SpecialKind::PeriodDoubling));
    Ok(())
}
