//! The window's polynomials and transform against its formula.

use std::f64::consts::PI;

use crate::common::accept;
use gauss_quad::GaussLegendre;
use stickslip_convolution::Window;

fn offsets() -> impl Iterator<Item = f64> {
    (0..=1000).map(|i| f64::from(i) / 1000.0)
}

/// The argument of weight `k`.
fn argument(k: usize, offset: f64) -> f64 {
    (k as f64 - 7.0 - offset) / 8.0
}

#[test]
fn weights_are_those_of_the_formula() {
    let window = Window::shared();
    let mut error = 0.0_f64;
    for offset in offsets() {
        for (k, weight) in window.weights(offset).into_iter().enumerate() {
            error = error.max((weight - Window::formula(argument(k, offset))).abs());
        }
    }
    accept("weights", error, 1e-15);
}

#[test]
fn reading_one_cell_gives_its_weight_and_the_slope_of_the_formula() {
    let window = Window::shared();
    // φ'(z) = −β z/√(1 − z²) φ(z), with β = 12π; at the very ends it is infinite times round-off.
    let slope = |z: f64| 12.0 * PI * z / (1.0 - z * z).sqrt() * Window::formula(z) / 8.0;
    let (mut error, mut peak) = (0.0_f64, 0.0_f64);
    for offset in offsets().skip(10).take(981) {
        let weights = window.weights(offset);
        for k in 0..16 {
            let mut cells = [0.0; 16];
            cells[k] = 1.0;
            let (value, found) = window.read(&cells, offset);
            assert!((value - weights[k]).abs() < 1e-15);
            let expected = slope(argument(k, offset));
            error = error.max((found - expected).abs());
            peak = peak.max(expected.abs());
        }
    }
    accept("slopes", error / peak, 2e-15);
}

#[test]
fn the_transform_is_that_of_the_formula() {
    let window = Window::shared();
    let rule = GaussLegendre::new(80.try_into().unwrap());
    let mut error = 0.0_f64;
    for i in 0..=100 {
        let kappa = PI * f64::from(i) / 100.0;
        let integrand = |z: f64| 16.0 * Window::formula(z) * (8.0 * kappa * z).cos();
        error = error.max((window.transform(kappa) - rule.integrate(0.0, 1.0, integrand)).abs());
    }
    accept("transform", error, 5e-15);
}

/// Negative control: a window of another shape has another transform.
#[test]
fn the_transform_tells_a_wrong_formula() {
    let rule = GaussLegendre::new(80.try_into().unwrap());
    let wrong = rule.integrate(0.0, 1.0, |z: f64| 16.0 * Window::formula(z).powf(1.001));
    assert!((Window::shared().transform(0.0) - wrong).abs() > 1e-4);
}
