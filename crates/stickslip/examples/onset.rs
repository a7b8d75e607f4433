//! The onset of stick-slip: the critical point, the small oscillation there, and its growth beyond.

use std::error::Error;
use stickslip::stability::{Criticality, critical, leading_roots, onset};
use stickslip::tip::{Model, TipFunction, Wider};

fn main() -> Result<(), Box<dyn Error>> {
    let tip = TipFunction::triple_gaussian(1.0, 1.0)?;
    let at = critical(&Wider::default(), &tip, 1.0)?;
    println!("αc = {:.10}, ω = {:.10}", at.alpha, at.omega);
    let born = onset(&tip, 1.0)?;
    assert_eq!(born.criticality, Criticality::Supercritical);
    println!("amplitude² = {:.6} (α - αc)", born.amplitude_squared_slope);
    let found = leading_roots(&Model::new(tip, at.alpha + 0.1, 1.0)?, 4)?;
    for root in &found.roots {
        println!("λ = {root:.8}");
    }
    assert!(found.roots[0].re > 0.0 && found.certificate.found == found.certificate.counted);
    Ok(())
}
