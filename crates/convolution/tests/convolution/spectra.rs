//! Spectra of sources within a stretch, and fields of them, against the sums that they stand for.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex;
use std::f64::consts::TAU;
use stickslip_convolution::{Density, Spectra};

fn sources() -> (Vec<f64>, Vec<f64>) {
    let at = |j: i32| 3.0 + 40.0 * (f64::from(j) * 0.618_034).fract();
    let weight = |j: i32| 0.2 + (f64::from(j) * 0.377).sin().abs();
    ((0..300).map(at).collect(), (0..300).map(weight).collect())
}

fn spread(spectra: &Spectra) -> Density {
    let mut density = Density::new(spectra.spacing());
    let (positions, weights) = sources();
    positions.iter().zip(&weights).for_each(|(y, w)| density.add(*y, *w));
    density
}

/// The sum that it stands for, term by term.
#[test]
fn the_spectrum_is_the_sum_over_sources() {
    let mut spectra = Spectra::new(8.7, -10.0, 55.0);
    let found = spectra.of(&spread(&spectra));
    let (positions, weights) = sources();
    let all: f64 = weights.iter().sum();
    for (k, found) in spectra.wave_numbers().zip(&found) {
        let term = |(y, w): (&f64, &f64)| Complex::from_polar(*w, -k * (y - spectra.origin()));
        let wanted: Complex<f64> = positions.iter().zip(&weights).map(term).sum();
        assert!((found - wanted).norm() < 1e-14 * all, "{k}: {found} for {wanted}");
    }
    assert!(spectra.wave_numbers().last().unwrap() >= 8.7);
}

/// A Gaussian on every source, and its slope, summed one by one.
#[test]
fn the_field_is_the_sum_of_kernels() {
    let mut spectra = Spectra::new(8.7, -10.0, 55.0);
    let density = spectra.of(&spread(&spectra));
    let kernel = |k: f64| TAU.sqrt() * (-0.5 * k * k).exp();
    let modes: Vec<_> =
        density.iter().zip(spectra.wave_numbers()).map(|(rho, k)| rho * kernel(k)).collect();
    let field = spectra.field(&modes);
    let (positions, weights) = sources();
    for i in 0..500 {
        let x = -9.0 + 0.126 * f64::from(i);
        let (value, slope) = field.value_and_derivative(x);
        let sum = |f: &dyn Fn(f64) -> f64| -> f64 {
            positions.iter().zip(&weights).map(|(y, w)| w * f(x - y)).sum()
        };
        assert!((value - sum(&|z| (-0.5 * z * z).exp())).abs() < 3e-12, "{x}");
        assert!((slope - sum(&|z| -z * (-0.5 * z * z).exp())).abs() < 3e-12, "{x}");
    }
}

#[test]
#[should_panic(expected = "sources in the cells")]
fn sources_outside_of_the_stretch_are_no_part_of_it() {
    let mut spectra = Spectra::new(8.7, 10.0, 55.0);
    let density = spread(&spectra);
    let _ = spectra.of(&density);
}
