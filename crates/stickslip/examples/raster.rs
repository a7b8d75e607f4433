//! An area scanned line by line, and the pattern that it comes to, beside linear theory.

use std::error::Error;
use stickslip::raster::{Path, Plan, Regime, Scanning, pattern};
use stickslip::stability::{Raster, RasterPath};
use stickslip::tip::{Footprint, Model, Scenario, TipFunction, Wider};

fn main() -> Result<(), Box<dyn Error>> {
    let footprint = Footprint::separable(TipFunction::gaussian(1.0)?, 1.0)?; // exp(-(x² + y²)/2)
    let theory =
        Raster::new(&footprint, Wider::default(), (1.0, 1.0), 1.0)?.critical(RasterPath::OneWay)?; // r = 1, pitch 1
    println!("αc = {:.6}, q = {:.4}", theory.alpha, theory.q);
    let model = Model::new(footprint.path().clone(), 1.1 * theory.alpha, 1.0)?;
    let mut plan = Plan::new(footprint, model, Path::OneWay, 1.0, 120, 100.0); // 120 lines of 100
    plan.law = Scenario { tolerance: 1e-6, ..plan.law };
    let mut scanning = Scanning::new(&plan)?;
    while scanning.next_line()?.is_some() {}
    let written = pattern(&plan, scanning.lines());
    let found = written.pattern.ok_or("no pattern")?;
    let angle = found.crest_angle.zip(found.crest_angle_error).ok_or("no angle")?;
    println!("{:?}: crests at {:.1} ± {:.1}°", written.regime, angle.0, angle.1);
    assert_eq!(written.regime, Regime::Ripples);
    assert!((found.q.ok_or("no wavelength")? / theory.q - 1.0).abs() < 0.15);
    Ok(())
}
