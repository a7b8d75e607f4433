//! A tip that is pushed: the run, and linear theory beside it.

use std::error::Error;
use stickslip::stability::response;
use stickslip::tip::{Force, Model, Pulse, Scenario, TipFunction, run};

fn main() -> Result<(), Box<dyn Error>> {
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0)?, 0.8, 1.0)?; // below onset
    let pulses = vec![Pulse { amplitude: 1e-4, time: 30.0, width: 0.5 }];
    let linear = response(&model, &pulses, 10)?;
    let force = Force::new(pulses, None)?;
    let scenario = Scenario { force, ..Scenario::new(model, 60.0) };
    let run = run(&scenario)?;
    for t in [34.0, 38.0, 45.0] {
        let [l, predicted] = [run.trajectory.l(t) - scenario.model.steady_l(), linear.at(t)];
        println!("t = {t}: l - l0 = {l:+.6e}, by linear theory {predicted:+.6e}");
        assert!((l - predicted).abs() < 1e-3 * 1e-4);
    }
    Ok(())
}
