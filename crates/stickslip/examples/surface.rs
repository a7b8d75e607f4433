//! The surface that a tip leaves behind, at any x and t of its run.

use std::error::Error;
use stickslip::surface::Surface;
use stickslip::tip::{Model, Scenario, TipFunction, run};

fn main() -> Result<(), Box<dyn Error>> {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0)?, 1.2, 1.0)?;
    let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 200.0) };
    let run = run(&scenario)?;
    let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
    let x: Vec<f64> = (0..=40).map(|i| 170.0 + 0.5 * f64::from(i)).collect();
    let u = surface.heights(200.0, &x)?;
    for (x, u) in x.iter().zip(&u) {
        println!("{x:7.2} {u:9.5}");
    }
    assert!(u.iter().any(|u| *u > 0.5) && u.iter().any(|u| *u < -0.5));
    Ok(())
}
