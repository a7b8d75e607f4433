//! The response that roots add up to, judged by the inverse Laplace integral (A.7) evaluated on a line.

use num_complex::Complex64;
use stickslip_stability::response;
use stickslip_tip::{Model, Pulse, TipFunction};

fn model(beta: f64, alpha: f64, r: f64) -> Model {
    let tip = TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip");
    Model::new(tip, alpha, r).expect("a valid model")
}

/// l(t) - l0 by (A.7) on the line Re s = 0.3, K̃ by Simpson's rule on f''.
fn inverse_laplace(model: &Model, pulse: &Pulse, times: &[f64]) -> Vec<f64> {
    let (alpha, r) = (model.alpha(), model.r());
    let h = 0.0025;
    let curvature: Vec<(f64, f64)> = (0..=5200)
        .map(|i| {
            let weight = if i == 0 || i == 5200 { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
            let y = h * f64::from(i);
            (y, weight * h / 3.0 * model.tip().slope_and_curvature(y).1)
        })
        .collect();
    let kernel = |s: Complex64| -> Complex64 {
        curvature.iter().map(|(y, w)| (-s / r * y).exp() * (-alpha / r * w)).sum()
    };
    let step = 0.03;
    let spectrum: Vec<(Complex64, Complex64)> = (0..700)
        .map(|i| {
            let s = Complex64::new(0.3, step * f64::from(i));
            let size = pulse.amplitude * pulse.width * (2.0 * std::f64::consts::PI).sqrt();
            let force = (s * s * (0.5 * pulse.width.powi(2)) - s * pulse.time).exp() * size;
            let weight = if i == 0 { 0.5 } else { 1.0 };
            (s, force / (kernel(s) - s - 1.0) * weight)
        })
        .collect();
    let at = |t: &f64| {
        let sum: Complex64 = spectrum.iter().map(|(s, v)| v * (s * t).exp()).sum();
        sum.re * step / std::f64::consts::PI
    };
    times.iter().map(at).collect()
}

#[test]
fn the_response_is_the_inverse_laplace_transform() {
    for (beta, alpha) in [(1.0, 1.2), (1.0, 0.8), (0.0, 1.5)] {
        let model = model(beta, alpha, 1.0);
        let pulse = Pulse { amplitude: 1e-4, time: 10.0, width: 0.5 };
        let sum = response(&model, &[pulse], 12).unwrap();
        let times = [13.0, 15.0, 20.0, 30.0];
        for (t, exact) in times.iter().zip(inverse_laplace(&model, &pulse, &times)) {
            let error = (sum.at(*t) - exact).abs();
            // What decays faster than the modes kept is 1e-9 of the pulse at 13, nothing later.
            let allowed = if *t < 14.0 { 1e-12 } else { 1e-14 };
            assert!(error < allowed, "{beta} {alpha} {t} {error:e}");
        }
        let exact = inverse_laplace(&model, &pulse, &[13.0])[0];
        let pair = response(&model, &[pulse], 2).unwrap();
        assert!((pair.at(13.0) - exact).abs() > 1e-10, "negative control: fewer modes do worse");
        // Long after, each mode is its residue (A.9).
        let residues: Complex64 =
            sum.modes.iter().map(|m| m.residue * (m.lambda * 30.0).exp()).sum();
        assert!((residues.re - sum.at(30.0)).abs() < 1e-16);
    }
}

#[test]
fn pulses_superpose() {
    let model = model(1.0, 1.0, 1.0);
    let pulse = |time, amplitude| Pulse { amplitude, time, width: 0.7 };
    let (a, b) = (pulse(10.0, 1e-3), pulse(12.0, -2e-3));
    let at = |pulses: &[Pulse]| response(&model, pulses, 8).unwrap().at(18.0);
    assert!((at(&[a, b]) - at(&[a]) - at(&[b])).abs() < 1e-18);
    assert!(response(&model, &[Pulse { width: 0.0, ..a }], 8).is_err());
}
