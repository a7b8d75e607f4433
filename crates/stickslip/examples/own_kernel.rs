//! Sums of a kernel of one's own over scattered points, at a cost for each that does not depend on their number.

use stickslip::convolution::{Kernel, direct_sum, sum};

fn main() {
    // x e^{-x²/2}: its transform is below round-off beyond 9.5, as it is itself.
    let kernel = Kernel { value: &|x: f64| x * (-x * x / 2.0).exp(), band: 9.5, reach: Some(9.5) };
    let sources: Vec<f64> = (0..5000).map(|j| (0.37 * f64::from(j)).sin() * 40.0).collect();
    let weights = vec![2e-4; sources.len()];
    let targets: Vec<f64> = (0..1000).map(|i| -50.0 + 0.1 * f64::from(i)).collect();
    let [fast, slow] = [sum, direct_sum].map(|of| of(&kernel, &sources, &weights, &targets));
    let largest = fast.iter().zip(&slow).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("5,000 sources at 1,000 targets: {largest:.1e} from the direct sum");
    assert!(largest < 1e-13);
}
