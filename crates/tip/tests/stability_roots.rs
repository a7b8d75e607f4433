//! Roots, their certificate, and the response that they add up to.
//!
//! Judged by `data/stability_reference.json` (mpmath, 40 digits), by the printed equations, and by the
//! inverse Laplace integral (A.7) evaluated on a line.

mod stability_tables;

use num_complex::Complex64;
use stability_tables::records;
use stickslip_tip::stability::{certify, critical, leading_roots, response, roots};
use stickslip_tip::{Gaussian, Model, Pulse, TipFunction};

fn model(beta: f64, alpha: f64, r: f64) -> Model {
    let tip = TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip");
    Model::new(tip, alpha, r).expect("a valid model")
}

#[test]
fn roots_have_the_reference_digits() {
    let rows = records("stability_reference.json", "roots");
    assert_eq!(rows.len(), 3);
    for row in rows {
        let found = leading_roots(&model(row[0], row[1], row[2]), 10).unwrap();
        let upper: Vec<_> = found.roots.iter().filter(|z| z.im >= 0.0).collect();
        assert!(found.certificate.is_complete());
        assert_eq!(upper.len(), (row.len() - 3) / 2);
        for (z, wanted) in upper.iter().zip(row[3..].chunks(2)) {
            let error = (*z - Complex64::new(wanted[0], wanted[1])).norm();
            assert!(error < 1e-12 * z.norm(), "{z} is off by {error:e}");
            assert!(error <= found.certificate.largest_error, "{z} {error:e}");
        }
    }
}

#[test]
fn without_indentation_the_one_root_is_minus_one() {
    for r in [0.01, 1.0, 100.0] {
        for tip in [TipFunction::triple_gaussian(1.0, 1.0).unwrap(), TipFunction::Bessel] {
            let found = leading_roots(&Model::new(tip, 0.0, r).unwrap(), 10).unwrap();
            assert_eq!(found.roots.len(), 1);
            assert!((found.roots[0] + 1.0).norm() < 1e-15);
            assert!(found.certificate.is_complete() && found.certificate.region.re_min < -1.0);
        }
    }
}

#[test]
fn a_root_removed_doubled_or_displaced_breaks_the_certificate() {
    for model in [model(1.0, 1.2, 1.0), Model::new(TipFunction::Bessel, 0.3, 1.0).unwrap()] {
        let bound = -2.5;
        let list = roots(&model, bound).unwrap().roots;
        let holds = |list: &[Complex64]| certify(&model, bound, list).unwrap().is_complete();
        assert!(list.len() >= 3 && holds(&list));
        for i in 0..list.len() {
            let mut removed = list.clone();
            let root = removed.remove(i);
            assert!(!holds(&removed), "without {root}");
            removed.push(list[(i + 1) % list.len()]);
            assert!(!holds(&removed), "another twice for {root}");
            let mut displaced = list.clone();
            displaced[i] += 1e-4;
            assert!(!holds(&displaced), "{root} displaced");
        }
    }
}

#[test]
fn roots_are_complete_and_finite_for_every_r_and_beta() {
    for i in 0..=8 {
        let r = 10.0_f64.powf(-2.0 + 0.5 * f64::from(i));
        for beta in [0.0, 0.2, 0.4, 0.7, 1.0] {
            let tip = TipFunction::triple_gaussian(beta, 1.0).unwrap();
            let critical = critical(&tip, r).unwrap();
            for factor in [0.0, 1e-9, 0.1, 0.9999999, 1.0, 1.1, 10.0, 1e3] {
                let model = Model::new(tip.clone(), factor * critical.alpha, r).unwrap();
                let found = leading_roots(&model, 10).unwrap();
                assert!(found.certificate.is_complete(), "{beta} {r} {factor}");
                assert!(found.roots.iter().all(|z| z.is_finite()));
                assert!(found.roots.windows(2).all(|pair| pair[0].re >= pair[1].re));
                let wanted = if factor > 0.0 { 10 } else { 1 };
                assert!(found.roots.len() >= wanted, "{beta} {r} {factor}");
                let size = found.roots[found.roots.len() - 1].norm();
                assert!(found.certificate.largest_error < 1e-10 * size, "{beta} {r} {factor}");
            }
        }
    }
}

#[test]
fn at_the_critical_point_the_leading_pair_is_on_the_axis() {
    for tip in [TipFunction::triple_gaussian(1.0, 1.0).unwrap(), TipFunction::Bessel] {
        for r in [0.05, 0.3, 1.0, 20.0] {
            let critical = critical(&tip, r).unwrap();
            let model = Model::new(tip.clone(), critical.alpha, r).unwrap();
            let leading = leading_roots(&model, 4).unwrap().roots[0];
            assert!(leading.re.abs() < 1e-12 * critical.omega, "{tip:?} {r} {leading}");
            assert!((leading.im / critical.omega - 1.0).abs() < 1e-12, "{tip:?} {r} {leading}");
        }
    }
}

#[test]
fn roots_for_j0_solve_equation_44_on_its_branch() {
    for (alpha, r) in [(0.3, 1.0), (1.1, 1.0), (10.0, 1.0), (0.004, 0.1), (300.0, 20.0)] {
        let found = leading_roots(&Model::new(TipFunction::Bessel, alpha, r).unwrap(), 4).unwrap();
        assert!(found.certificate.is_complete() && !found.roots.is_empty());
        for lambda in found.roots {
            let z = lambda / r;
            let root = (z + Complex64::I).sqrt() * (z - Complex64::I).sqrt();
            let right = (z - z * z / root) * (alpha / r);
            let left = z * r + 1.0;
            assert!((left - right).norm() < 1e-10 * (1.0 + left.norm()), "{alpha} {r} {z}");
        }
    }
}

#[test]
fn the_squared_equation_has_more_roots_than_j0() {
    // α = 0: (45) has Λ = ±i besides -1/r; as α → 0 they must not be left over in the list.
    let model = Model::new(TipFunction::Bessel, 1e-3, 1.0).unwrap();
    let right = roots(&model, 0.0).unwrap();
    assert!(right.roots.is_empty() && right.certificate.counted == 0);
}

#[test]
fn many_gaussians_by_quadrature_agree_with_few_in_closed_form() {
    let (few, many) = (model(1.0, 1.2, 1.0), {
        let part = |center: f64, amplitude: f64| {
            std::iter::repeat_n(Gaussian { amplitude: amplitude / 8.0, center, width: 1.0 }, 8)
        };
        let terms = part(0.0, 1.0).chain(part(-2.0, -0.5)).chain(part(2.0, -0.5)).collect();
        Model::new(TipFunction::gaussian_sum(terms).unwrap(), 1.2, 1.0).unwrap()
    });
    let (closed, numeric) = (roots(&few, -2.0).unwrap(), roots(&many, -2.0).unwrap());
    assert_eq!(closed.roots.len(), numeric.roots.len());
    for (a, b) in closed.roots.iter().zip(&numeric.roots) {
        assert!((a - b).norm() < 1e-12, "{a} {b}");
    }
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
