//! A surface that heals, and indentation that has a depth limit: onset moves.

use std::error::Error;
use stickslip::stability::critical;
use stickslip::tip::{Model, Scenario, TipFunction, Wider, run};

fn main() -> Result<(), Box<dyn Error>> {
    let tip = TipFunction::triple_gaussian(1.0, 1.0)?;
    for healing_time in [1e6, 50.0, 8.0] {
        let law = Wider { healing_time: Some(healing_time), ..Wider::default() };
        println!("T = {healing_time}: αc = {:.6}", critical(&law, &tip, 1.0)?.alpha);
    }
    let law = Wider { healing_time: Some(8.0), depth_limit: Some(5.0), ..Wider::default() };
    let model = Model::under(law, tip, 1.2, 1.0)?;
    let scenario = Scenario { kick: 0.5, ..Scenario::new(model, 200.0) };
    let run = run(&scenario)?;
    let off = run.trajectory.l(200.0) - scenario.model.steady_l();
    println!("at α = 1.2, T = 8, b = 5 the kick of 0.5 has become {off:.1e}");
    assert!(off.abs() < 1e-3);
    Ok(())
}
