//! A tip of one's own: a sum of Gaussians, or a table.

use std::error::Error;
use stickslip::stability::critical;
use stickslip::tip::{Gaussian, TipFunction, Wider};

fn main() -> Result<(), Box<dyn Error>> {
    let lobe = |amplitude, center, width| Gaussian { amplitude, center, width };
    // f is even: both sides are equal.
    let lobes = vec![lobe(1.0, 0.0, 1.0), lobe(-0.3, 2.5, 0.8), lobe(-0.3, -2.5, 0.8)];
    let sum = TipFunction::gaussian_sum(lobes)?;
    let x: Vec<f64> = (0..=80).map(|i| 0.1 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| sum.value(*x)).collect();
    let table = TipFunction::table(&x, &f)?;
    let [of_sum, of_table] = [
        critical(&Wider::default(), &sum, 1.0)?.alpha,
        critical(&Wider::default(), &table, 1.0)?.alpha,
    ];
    println!("αc = {of_sum:.8} of the sum, {of_table:.8} of its table");
    assert!((of_sum - of_table).abs() < 1e-4);
    Ok(())
}
