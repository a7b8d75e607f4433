//! Critical points, boundary and trapping threshold.
//!
//! Judged by `data/stability_reference.json` (mpmath, 40 digits, f'' integrated numerically), by the
//! paper's closed forms for J0, and by counting unstable roots, which shares only G with what it judges.

use crate::tables::records;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, TAU};
use stickslip_stability::{
    Boundary, StabilityError, creep, critical, critical_r, trapping_alpha, unstable_count,
};
use stickslip_tip::{Gaussian, Model, TipFunction, Wider};

const TABLE: &str = "stability_reference.json";

fn triple(beta: f64, width: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, width).expect("a valid tip")
}

fn assert_close(found: f64, wanted: f64, relative: f64) {
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{found} for {wanted}");
}

/// A broad Gaussian with a narrow one on top: two lengths, so that (42) is met at several Ω.
fn two_lengths() -> TipFunction {
    let lobe = |amplitude, width| Gaussian { amplitude, center: 0.0, width };
    TipFunction::gaussian_sum(vec![lobe(1.0, 1.0), lobe(0.15, 0.12)]).expect("a valid tip")
}

#[test]
fn critical_points_have_the_reference_digits() {
    let rows = records(TABLE, "critical");
    assert_eq!(rows.len(), 10);
    for row in rows {
        let found = critical(&Wider::default(), &triple(row[0], row[1]), row[2]).unwrap();
        assert_close(found.alpha, row[3], 1e-12);
        assert_close(found.omega, row[4], 1e-12);
    }
}

#[test]
fn the_figures_printed_in_the_paper_are_met() {
    let found = critical(&Wider::default(), &triple(1.0, 1.0), 1.0).unwrap();
    assert_close(found.alpha, 1.069036174947, 1e-12);
    assert_close(found.omega, 0.942779021257, 1e-12);
    assert_close(found.wavelength, 6.665, 1e-4);
    // β = 0: its figures are those of width 1/√2, not of (48).
    let narrow =
        critical(&Wider::default(), &TipFunction::gaussian(0.5_f64.sqrt()).unwrap(), 1.0).unwrap();
    assert_close(narrow.alpha, 1.608057105070, 1e-12);
    assert_close(narrow.wavelength, 6.727, 5e-4);
    let wide = critical(&Wider::default(), &triple(0.0, 1.0), 1.0).unwrap();
    assert!((wide.alpha - 1.608).abs() > 0.2, "negative control");
}

#[test]
fn critical_r_inverts_critical() {
    let row = &records(TABLE, "critical_r")[0];
    let found = critical_r(&Wider::default(), &triple(row[0], row[1]), row[2]).unwrap();
    assert_close(found.r, row[3], 1e-12);
    assert_close(found.omega, row[4], 1e-12);
    for r in [0.02, 0.3, 4.0, 60.0] {
        let alpha = critical(&Wider::default(), &triple(0.5, 1.0), r).unwrap().alpha;
        assert_close(critical_r(&Wider::default(), &triple(0.5, 1.0), alpha).unwrap().r, r, 1e-11);
    }
}

#[test]
fn j0_loses_stability_at_r_squared_with_the_wave_number_of_equation_47() {
    for i in 0..=40 {
        let r = 0.05 * 400.0_f64.powf(f64::from(i) / 40.0);
        let found = critical(&Wider::default(), &TipFunction::Bessel, r).unwrap();
        // (47) as printed cancels for small r: only a part of its digits there.
        let printed = (((1.0 + 4.0 * r * r).sqrt() - 1.0) / (2.0 * r * r)).sqrt();
        assert_close(found.alpha, r * r, 1e-15);
        assert_close(found.omega, r * printed, 1e-13_f64.max(1e-15 / (r * r)));
        // (45): √(1-Ω²) = rΩ², the other half of the claim, in a form that does not cancel.
        let wave = found.omega / r;
        let (left, right) = ((1.0 - wave) * (1.0 + wave), (r * wave * wave).powi(2));
        assert_close(left, right, 1e-12_f64.max(1e-15 / (r * r)));
    }
}

#[test]
fn a_pair_of_roots_turns_unstable_at_alpha_c_and_none_before() {
    let tips =
        [triple(0.0, 1.0), triple(0.5, 0.3), triple(1.0, 1.0), two_lengths(), TipFunction::Bessel];
    for tip in &tips {
        for r in [0.01, 0.1, 1.0, 10.0, 100.0] {
            let at = critical(&Wider::default(), tip, r).unwrap().alpha;
            let count =
                |alpha| unstable_count(&Model::new(tip.clone(), alpha, r).unwrap()).unwrap();
            for below in [0.2, 0.7, 0.999] {
                assert_eq!(count(below * at), 0, "{tip:?} {r} {below}");
            }
            assert_eq!(count(1.001 * at), 2, "{tip:?} {r}");
        }
    }
}

#[test]
fn of_several_crossings_the_first_counts() {
    let tip = two_lengths();
    let boundary = Boundary::new(&Wider::default(), &tip);
    let several: Vec<f64> = (0..200).map(|i| 0.01 * 1.03_f64.powi(i)).collect();
    let several = several.into_iter().find(|r| boundary.all_at(*r).unwrap().len() == 3);
    let r = several.expect("this tip has three crossings at some r");
    let all = boundary.all_at(r).unwrap();
    assert!(all.windows(2).all(|pair| pair[0].alpha < pair[1].alpha));
    assert_close(critical(&Wider::default(), &tip, r).unwrap().alpha, all[0].alpha, 1e-14);
    // At each of them the number of unstable roots changes by a pair.
    let count = |alpha| unstable_count(&Model::new(tip.clone(), alpha, r).unwrap()).unwrap();
    for crossing in &all {
        let change = count(1.0001 * crossing.alpha).abs_diff(count(0.9999 * crossing.alpha));
        assert_eq!(change, 2, "{crossing:?}");
    }
}

#[test]
fn the_boundary_is_the_curve_of_critical_points() {
    let tip = triple(1.0, 1.0);
    let boundary = Boundary::new(&Wider::default(), &tip);
    let branches = boundary.branches(0.05, 4.0, 1000).unwrap();
    assert_eq!(branches.len(), 1);
    let branch = &branches[0];
    assert_eq!(branch.r.len(), 1000);
    assert_close(branch.r[0], 4.0, 1e-12);
    assert_close(branch.r[999], 0.05, 1e-12);
    for i in [0, 10, 500, 990, 999] {
        let at = boundary.at(branch.r[i]).unwrap();
        assert_close(at.alpha, branch.alpha[i], 1e-11);
        assert_close(at.omega / at.r, branch.wave_number[i], 1e-11);
    }
}

#[test]
fn every_branch_of_the_boundary_solves_equations_42_and_43() {
    let tip = two_lengths();
    let branches = Boundary::new(&Wider::default(), &tip).branches(0.01, 3.0, 300).unwrap();
    let turns = |r: &[f64]| r.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).count();
    // Several at one r: more than one stretch, or one that turns back.
    assert!(branches.len() > 1 || turns(&branches[0].r) > 0);
    for branch in branches {
        for i in 0..branch.r.len() {
            // (43): αc = r/(Ω²f̂/2), as ∫f'' cos = -Ω²f̂/2 for even f.
            let wave = branch.wave_number[i];
            let cosine = 0.5 * wave * wave * tip.fourier(wave);
            assert_close(branch.alpha[i], branch.r[i] / cosine, 1e-12);
        }
    }
}

#[test]
fn trapping_thresholds_have_the_reference_digits() {
    for row in records(TABLE, "trapping") {
        assert_close(trapping_alpha(&triple(row[0], 1.0), 1.0).unwrap(), row[1], 1e-12);
        // It scales with r alone.
        assert_close(trapping_alpha(&triple(row[0], 1.0), 7.0).unwrap(), 7.0 * row[1], 1e-12);
    }
}

#[test]
fn creep_rates_solve_their_equation_above_the_threshold_only() {
    for tip in [triple(1.0, 1.0), triple(0.0, 2.0), TipFunction::Bessel] {
        let threshold = trapping_alpha(&tip, 0.7).unwrap();
        let at = |alpha| creep(&Model::new(tip.clone(), alpha, 0.7).unwrap()).unwrap();
        assert!(at(0.999 * threshold).rates().is_empty());
        let found = at(1.3 * threshold);
        let [slow, fast] = found.rates()[..] else { panic!("{found:?}") };
        assert!(0.0 < slow && slow < fast);
        assert_eq!(found.attracting(), Some(fast));
        assert!(found.certificate.is_complete());
        for p in [slow, fast] {
            assert_close(0.7 / (1.3 * threshold), push(&tip, p), 1e-7);
        }
    }
}

/// Oracle: the winding number of s(s + p) - κp, s = √(p²+1), round the right half of a disc. At small κ = α/r a pair lies at
/// ±i(1 - κ²/2) + κ³, by expansion at the branch points; it was missed, with a certificate that nothing was.
#[test]
fn all_rates_of_creep_of_j0_are_found_close_to_its_branch_points_too() {
    let count = |kappa: f64| {
        let value = |p: Complex64| {
            let s = (p * p + 1.0).sqrt();
            s * (s + p) - p * kappa
        };
        let near = (0..=4000).map(|i| 10_f64.powf(-14.0 * f64::from(i) / 4000.0));
        let near: Vec<f64> = near.collect();
        let far = 3.0 + 2.0 * kappa;
        // Up the imaginary axis by distances from the branch points, back along the arc.
        let up =
            near.iter().map(|d| 1.0 - d).chain(near.iter().rev().map(|d| 1.0 + d * (far - 1.0)));
        let up: Vec<f64> = up.collect();
        let axis = up.iter().rev().map(|y| -y).chain(up.iter().copied());
        let axis = axis.map(|y| Complex64::new(0.0, y));
        let arc = (0..=4000).map(|i| {
            let angle = FRAC_PI_2 * (1.0 - f64::from(i) / 2000.0);
            Complex64::from_polar(far, angle)
        });
        let path: Vec<Complex64> = axis.chain(arc).map(value).collect();
        let turned: f64 = path.windows(2).map(|pair| (pair[1] / pair[0]).arg()).sum();
        -turned / TAU
    };
    for kappa in [1e-3, 0.02, 0.1, 0.3, 0.7, 1.0, 1.7, 3.0, 3.4, 5.0, 40.0] {
        let found = creep(&Model::new(TipFunction::Bessel, 0.7 * kappa, 0.7).unwrap()).unwrap();
        assert!((count(kappa) - found.roots.len() as f64).abs() < 1e-6, "{kappa} {found:?}");
        let residual = found.certificate.largest_residual;
        assert!(residual < 1e-13 && found.certificate.is_complete(), "{kappa} {residual}");
    }
    for kappa in [1e-6, 1e-4, 1e-3] {
        let found = creep(&Model::new(TipFunction::Bessel, kappa, 1.0).unwrap()).unwrap();
        let [first, second] = found.roots[..] else { panic!("{kappa} {found:?}") };
        assert_eq!(first, second.conj());
        assert_close(first.re, kappa.powi(3), 10.0 * kappa * kappa + 1e-9);
        assert_close(first.im, 1.0 - 0.5 * kappa * kappa, kappa.powi(3) + 1e-15);
    }
}

/// Oracle: the zeros of 2κp³ - (κ²+1)p² + 2κp - 1 to 60 digits. Just above the threshold two rates nearly meet, and round-off
/// moves them by far more than a rounding of p.
#[test]
fn rates_of_creep_of_j0_that_nearly_meet_are_as_exact_as_their_certificate_says() {
    for (alpha, rates) in [
        (3.330_190_676_79, [0.786_149_988_877_302, 0.786_152_766_639_838_1]),
        (3.330_190_678, [0.786_128_404_971_156_5, 0.786_174_351_171_213]),
        (3.3302, [0.784_140_920_460_407_1, 0.788_166_652_530_893_9]),
    ] {
        let found = creep(&Model::new(TipFunction::Bessel, alpha, 1.0).unwrap()).unwrap();
        let [fast, slow] = found.roots[..] else { panic!("{alpha} {found:?}") };
        let off = (slow.re - rates[0]).abs().max((fast.re - rates[1]).abs());
        let largest = found.certificate.largest_error;
        assert!(off < largest && largest < 1e-8, "{alpha}: {off:e} {largest:e}");
    }
}

/// Only the two beside the greatest maximum of Q were looked at.
#[test]
fn of_a_footprint_of_several_peaks_all_rates_are_found() {
    let peaks = |a: f64, c: f64, w: f64| {
        let at = |amplitude, center, width| Gaussian { amplitude, center, width };
        TipFunction::gaussian_sum(vec![at(1.0, 0.0, 1.0), at(a, c, w), at(a, -c, w)]).unwrap()
    };
    let tip = peaks(1.2, 1.7, 0.55);
    let found = creep(&Model::new(tip.clone(), 50.0, 1.0).unwrap()).unwrap();
    let rates = found.rates();
    assert_eq!(rates.len(), 4, "{found:?}");
    for (rate, known) in rates.iter().zip([0.0208, 0.9596, 4.6785, 20.058]) {
        assert!((rate - known).abs() < 1e-3, "{rate} {known}");
        assert_close(1.0 / 50.0, push(&tip, *rate), 1e-4);
    }
    assert_eq!(found.attracting(), Some(rates[3]));
    // Here a complex pair lies right of both real rates: no creep lasts.
    let found = creep(&Model::new(peaks(0.45, 1.6, 0.57), 4.7399, 1.0).unwrap()).unwrap();
    assert_eq!(found.rates().len(), 2);
    assert_eq!(found.attracting(), None);
    assert!(found.roots[0].im > 0.0 && found.roots[0].re > found.rates()[1]);
    assert!(found.certificate.is_complete());
}

/// p ∫_0^∞ e^{-ps}(-f'(s))ds by Simpson's rule.
fn push(tip: &TipFunction, p: f64) -> f64 {
    let (steps, end) = (40_000, 40.0 / p);
    let h = end / f64::from(steps);
    let term = |i: i32| {
        let s = h * f64::from(i);
        let weight = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        -weight * (-p * s).exp() * tip.slope(s)
    };
    p * h / 3.0 * (0..=steps).map(term).sum::<f64>()
}

#[test]
fn what_cannot_be_had_is_refused_with_its_numbers() {
    let tip = triple(1.0, 1.0);
    assert_eq!(critical(&Wider::default(), &tip, -1.0), Err(StabilityError::R(-1.0)));
    assert_eq!(critical_r(&Wider::default(), &tip, 0.0), Err(StabilityError::Alpha(0.0)));
    // A tip that heaps up instead of digging pushes the tip on, and is stable.
    let bell = Gaussian { amplitude: -1.0, center: 0.0, width: 1.0 };
    let heap = TipFunction::gaussian_sum(vec![bell]).unwrap();
    assert_eq!(critical(&Wider::default(), &heap, 1.0), Err(StabilityError::NoCrossing { r: 1.0 }));
    assert_eq!(trapping_alpha(&heap, 1.0), Err(StabilityError::NoTrapping));
}

#[test]
fn a_table_has_the_critical_point_of_what_it_tabulates() {
    let exact = triple(1.0, 1.0);
    let x: Vec<f64> = (0..=110).map(|i| 0.1 * f64::from(i)).collect();
    let f: Vec<f64> = x.iter().map(|x| exact.value(*x)).collect();
    let table = TipFunction::table(&x, &f).unwrap();
    for r in [0.1, 1.0, 10.0] {
        let (of_table, of_exact) = (
            critical(&Wider::default(), &table, r).unwrap(),
            critical(&Wider::default(), &exact, r).unwrap(),
        );
        assert_close(of_table.alpha, of_exact.alpha, 1e-10);
        assert_close(of_table.omega, of_exact.omega, 1e-10);
    }
}
