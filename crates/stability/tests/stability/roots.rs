//! Roots and their certificate.
//!
//! Judged by `data/stability_reference.json` (mpmath, 40 digits) and by the printed equations.

use crate::tables::records;
use gauss_quad::GaussLegendre;
use num_complex::Complex64;
use stickslip_stability::{certify, critical, leading_roots, roots, unstable_count};
use stickslip_tip::{Gaussian, Model, TipFunction, Wider};

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
            let critical = critical(&Wider::default(), &tip, r).unwrap();
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

/// Im λ ≥ 0
fn upper(roots: &[Complex64]) -> Vec<Complex64> {
    roots.iter().copied().filter(|z| z.im >= 0.0).collect()
}

/// At Re Λ = -ln(2/β)/2 the lobes balance the peak. Roots there, where terms of size e^{45} cancel, were
/// found and not believed, since h is round-off of those terms and not of what they leave.
#[test]
fn roots_of_side_lobes_that_nearly_vanish_have_the_reference_digits() {
    let rows = records("stability_reference.json", "lobes");
    assert_eq!(rows.len(), 1);
    let (given, wanted) = rows[0].split_at(3);
    let found = roots(&model(given[0], given[1], given[2]), -10.9).unwrap();
    let listed = upper(&found.roots);
    assert!(found.certificate.is_complete() && found.roots.len() == 49);
    assert_eq!(listed.len(), wanted.len() / 2);
    for wanted in wanted.chunks(2) {
        let wanted = Complex64::new(wanted[0], wanted[1]);
        let error = listed.iter().map(|z| (z - wanted).norm()).fold(f64::INFINITY, f64::min);
        assert!(error < 1e-12 * wanted.norm(), "{wanted} is off by {error:e}");
        assert!(error <= found.certificate.largest_error, "{wanted} {error:e}");
    }
}

/// A sum of even pairs (amplitude, center, width), the peak of width 1 first.
fn peak_and(pairs: &[(f64, f64, f64)]) -> TipFunction {
    let mut terms = vec![Gaussian { amplitude: 1.0, center: 0.0, width: 1.0 }];
    for (amplitude, center, width) in pairs.iter().copied() {
        terms.extend([-center, center].map(|center| Gaussian { amplitude, center, width }));
    }
    TipFunction::gaussian_sum(terms).expect("a valid tip")
}

#[test]
fn roots_are_complete_where_terms_of_the_tip_balance_far_left() {
    let lobes = |beta: f64| peak_and(&[(-0.5 * beta, 2.0, 1.0)]);
    let tips = [
        lobes(1e-12),
        lobes(1e-8),
        lobes(1e-4),
        peak_and(&[(-0.5, 2.0, 1.0), (1e-5, 4.0, 0.7)]),
        peak_and(&[(5e-11, 0.0, 2.0)]),
    ];
    for tip in &tips {
        for (r, part) in [(0.01, 1e-3), (1.0, 1.0), (100.0, 10.0)] {
            let alpha = part * critical(&Wider::default(), tip, r).unwrap().alpha;
            let model = Model::new(tip.clone(), alpha, r).unwrap();
            for count in [40, 100] {
                let found = leading_roots(&model, count).unwrap();
                assert!(found.certificate.is_complete() && found.roots.len() >= count);
            }
        }
    }
}

/// h of (30) and dh/dΛ by Gauss-Legendre panels over f'' e^{-Λy}, and Σ|terms|.
fn characteristic(model: &Model, lambda: Complex64) -> (Complex64, Complex64, f64) {
    let rule = GaussLegendre::new(32.try_into().expect("not 0"));
    let (r, ratio) = (model.r(), model.alpha() / model.r());
    let z = lambda / r;
    let (mut h, mut slope) = (z * r + 1.0, Complex64::new(r, 0.0));
    let mut size = h.norm();
    for panel in 0..150 {
        for (x, weight) in rule.as_node_weight_pairs() {
            let y = 0.2 * (f64::from(panel) + 0.5 * (1.0 + x));
            let term = (-z * y).exp() * (0.1 * weight * ratio * curvature(model.tip(), y));
            (h, slope, size) = (h + term, slope - term * y, size + term.norm());
        }
    }
    (h, slope, size)
}

/// f'' with the far tails that `TipFunction::slope_and_curvature` leaves out.
fn curvature(tip: &TipFunction, y: f64) -> f64 {
    let TipFunction::Gaussians(sum) = tip else { panic!("a sum of Gaussians") };
    let term = |g: &Gaussian| {
        let z = (y - g.center) / g.width;
        g.amplitude / g.width.powi(2) * (z * z - 1.0) * (-0.5 * z * z).exp()
    };
    sum.terms().iter().map(term).sum()
}

/// Pairs that have just met or are about to: α beside the one of a double root Λ.
#[test]
fn roots_about_to_meet_are_all_found() {
    for (beta, alpha, r, meet) in [
        (0.01, 45.27182654043843, 10.0, -0.32365447),
        (1e-4, 0.02916490613917334, 0.01, 1.14154838),
        (1e-8, 26.363428428476972, 3.0, 0.41053899),
    ] {
        for part in [0.0, 3e-16, -1e-14, 1e-12, -1e-12, 1e-10, -1e-7] {
            let model = model(beta, alpha * (1.0 + part), r);
            let found = roots(&model, -11.0 * r).unwrap();
            assert!(found.certificate.is_complete());
            let near = |z: &&Complex64| (**z / r - meet).norm() < 0.01;
            let pair: Vec<_> = found.roots.iter().filter(near).collect();
            assert_eq!(pair.len(), 2, "{beta} {part} {pair:?}");
            for z in pair {
                let (h, slope, _) = characteristic(&model, *z);
                let step = 1e-3;
                let bend = (characteristic(&model, z + step * r).1 - slope) / step;
                // As close to a root as the round-off of h lets it be.
                let error = (h / slope).norm().min((h / bend).norm().sqrt());
                assert!(error < 1e-6, "{beta} {part} {z} {error:e}");
            }
        }
    }
}

/// Every root that quadrature in double precision can judge is one by quadrature, among them those
/// where the lobes balance the peak.
#[test]
fn listed_roots_solve_equation_30_by_quadrature() {
    for beta in [1e-8, 1e-4, 0.01] {
        let model = model(beta, 1.0, 1.0);
        let balance = -0.5 * (2.0 / beta).ln();
        let (mut judged, mut balanced) = (0, 0);
        for z in upper(&leading_roots(&model, 60).unwrap().roots) {
            let (h, slope, size) = characteristic(&model, z);
            if 1e-14 * size < 1e-7 * slope.norm() {
                judged += 1;
                balanced += usize::from((z.re - balance).abs() < 0.1);
                assert!(h.norm() < 1e-7 * slope.norm(), "{beta} {z}");
            }
        }
        println!("{beta}: {judged}, {balanced}");
        assert!(judged >= 8 && balanced >= 1, "{beta}: {judged}, {balanced}");
    }
}

/// One root is near the origin, where G ≈ -f(0)Λ, one as far away as G ≈ f''(0)/Λ puts it.
#[test]
fn roots_of_large_alpha_lie_where_they_must() {
    let peak = TipFunction::gaussian(1.0).unwrap();
    let x: Vec<f64> = (0..60).map(|i| 0.15 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| peak.value(*x)).collect();
    let tips = [
        TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
        TipFunction::table(&x, &f).unwrap(),
        peak,
    ];
    for tip in tips {
        let (height, curvature) = (tip.value(0.0), tip.slope_and_curvature(0.0).1);
        for (r, exponent) in [(1.0, 6), (1.0, 10), (1.0, 14), (1e-3, 12), (1e4, 12)] {
            let alpha = r * r * 10.0_f64.powi(exponent);
            let model = Model::new(tip.clone(), alpha, r).unwrap();
            let found = leading_roots(&model, 6).unwrap();
            assert!(found.certificate.is_complete());
            assert_eq!(unstable_count(&model), Ok(2));
            let ratio = alpha / r;
            let (far, near) = (found.roots[0] / r, found.roots[1] / r);
            // What is left out is of relative order 1/Λ² far off and Λ near 0.
            let wanted = ((1.0 - 4.0 * r * ratio * curvature).sqrt() - 1.0) / (2.0 * r);
            assert!((far - wanted).norm() < 10.0 / wanted + 1e-9 * wanted, "{r} {exponent} {far}");
            let wanted = 1.0 / (ratio * height - r);
            let allowed = 10.0 * wanted * wanted + 1e-12 * wanted;
            assert!((near - wanted).norm() < allowed, "{r} {exponent} {near} {wanted}");
        }
    }
}

#[test]
fn at_the_critical_point_the_leading_pair_is_on_the_axis() {
    for tip in [TipFunction::triple_gaussian(1.0, 1.0).unwrap(), TipFunction::Bessel] {
        for r in [0.05, 0.3, 1.0, 20.0] {
            let critical = critical(&Wider::default(), &tip, r).unwrap();
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

/// |Λ|² is at most some 10 α/r² right of the imaginary axis, so that nothing grows this fast.
#[test]
fn far_to_the_right_there_are_no_roots() {
    for (alpha, r) in [(1.0, 1.0), (1.2, 0.01), (0.0, 3.0)] {
        for bound in [1e3, 1e10, 1e300] {
            let found = roots(&model(1.0, alpha, r), bound).unwrap();
            assert!(found.roots.is_empty() && found.certificate.is_complete(), "{alpha} {bound}");
        }
    }
}
