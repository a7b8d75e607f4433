//! `Units`: quantities that are left out follow from r and α.

use stickslip::Units;

/// Γ, k, σ, N, a, v0 in SI units.
const ALL: [f64; 6] = [2e-3, 0.07, 30e-9, 150e-9, 4e-9, 3e-6];

/// The question with these quantities alone.
fn given(values: [Option<f64>; 6]) -> Units {
    let [damping, stiffness, tip_width, indentation_rate, slope_force, velocity] = values;
    Units {
        damping,
        stiffness,
        tip_width,
        indentation_rate,
        slope_force,
        velocity,
        ..Units::default()
    }
}

/// r = Γ v0/(kσ) and α = Γ N a/(σ² k²), (12) and (13).
fn numbers() -> (f64, f64) {
    let [damping, k, sigma, n, a, v0] = ALL;
    (damping * v0 / (k * sigma), damping * n * a / (sigma * k).powi(2))
}

fn without(left_out: &[usize]) -> [Option<f64>; 6] {
    let mut values = ALL.map(Some);
    left_out.iter().for_each(|i| values[*i] = None);
    values
}

/// Every pair of quantities that r and α determine is recovered, and every other pair is rejected.
#[test]
fn two_quantities_come_back_from_alpha_and_r() {
    let (r, alpha) = numbers();
    let mut solvable = 0;
    for i in 0..6 {
        for j in i + 1..6 {
            let question = given(without(&[i, j]));
            let question = Units { alpha: Some(alpha), r: Some(r), ..question };
            let Ok(found) = question.answered() else { continue };
            solvable += 1;
            let p = &found.physical;
            let values = [
                p.damping,
                p.stiffness,
                p.tip_width,
                p.indentation_rate,
                p.slope_force,
                p.velocity,
            ];
            for (value, wanted) in values.iter().zip(ALL) {
                assert!((value / wanted - 1.0).abs() < 1e-12, "{i} {j}: {values:?}");
            }
        }
    }
    // k with σ, and N with a, enter as products only.
    assert_eq!(solvable, 15 - 2);
}

#[test]
fn a_single_quantity_comes_back_from_either_number() {
    let (r, alpha) = numbers();
    // Γ, k and σ are in both numbers, v0 in r alone, N and a in α alone.
    let (in_r, in_alpha) = ([0, 1, 2, 5], [0, 1, 2, 3, 4]);
    for i in 0..6 {
        let question = given(without(&[i]));
        let from_alpha = Units { alpha: Some(alpha), ..question.clone() }.answered();
        let from_r = Units { r: Some(r), ..question }.answered();
        assert_eq!(from_alpha.is_ok(), in_alpha.contains(&i), "{i}");
        assert_eq!(from_r.is_ok(), in_r.contains(&i), "{i}");
        for found in [from_alpha, from_r].into_iter().flatten() {
            assert!((found.alpha / alpha - 1.0).abs() < 1e-13);
            assert!((found.r / r - 1.0).abs() < 1e-13);
        }
    }
}
