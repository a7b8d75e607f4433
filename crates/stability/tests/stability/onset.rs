//! The Hopf bifurcation: criticality and slopes at onset.
//!
//! Judged by `data/onset_reference.json`: limit cycles of (18) solved in full by harmonic balance at
//! α - αc down to 1e-4 and extrapolated; nothing of the expansion is used there.

use crate::tables::records;
use stickslip_stability::{Criticality, critical, onset};
use stickslip_tip::{TipFunction, Wider};

#[test]
fn amplitude_and_period_grow_with_the_slopes_of_the_limit_cycles() {
    let rows = records("onset_reference.json", "cases");
    assert_eq!(rows.len(), 6);
    for row in rows {
        let (beta, r, slopes) = (row[0], row[1], &row[row.len() - 2..]);
        let found = onset(&TipFunction::triple_gaussian(beta, 1.0).unwrap(), r).unwrap();
        assert_eq!(found.criticality, Criticality::Supercritical);
        assert!(found.lyapunov < 0.0 && found.growth_slope > 0.0);
        let off = [found.amplitude_squared_slope / slopes[0], found.period_slope / slopes[1]];
        assert!(off.iter().all(|ratio| (ratio - 1.0).abs() < 2e-6), "{beta} {r} {off:?}");
        // Negative control: the cycle at the largest α, not extrapolated, is further off.
        let (above, amplitude) = (row[4], row[6]);
        assert!((amplitude.powi(2) / above / found.amplitude_squared_slope - 1.0).abs() > 1e-5);
    }
}

#[test]
fn the_error_of_the_leading_order_falls_linearly() {
    for row in records("onset_reference.json", "cases") {
        let tip = TipFunction::triple_gaussian(row[0], 1.0).unwrap();
        let slope = onset(&tip, row[1]).unwrap().amplitude_squared_slope;
        // α - αc, period, amplitude, residual of three cycles, α - αc falling by 10.
        let errors: Vec<f64> =
            row[4..16].chunks(4).map(|cycle| cycle[2].powi(2) / cycle[0] / slope - 1.0).collect();
        let order = |i: usize| (errors[i] / errors[i + 1]).log10();
        // At β = r = 1 the first order happens to be small, so that the second shows at α - αc = 0.01.
        assert!((order(0) - 1.0).abs() < 0.1 && (order(1) - 1.0).abs() < 0.02, "{row:?}");
    }
}

#[test]
fn the_growth_slope_is_that_of_the_leading_root() {
    use stickslip_stability::leading_roots;
    use stickslip_tip::Model;
    for tip in [TipFunction::triple_gaussian(0.5, 0.8).unwrap(), TipFunction::Bessel] {
        let at = critical(&Wider::default(), &tip, 2.0).unwrap();
        let growth = |alpha: f64| {
            leading_roots(&Model::new(tip.clone(), alpha, 2.0).unwrap(), 2).unwrap().roots[0].re
        };
        let step = 1e-4 * at.alpha;
        let slope = (growth(at.alpha + step) - growth(at.alpha - step)) / (2.0 * step);
        assert!((onset(&tip, 2.0).unwrap().growth_slope / slope - 1.0).abs() < 1e-6);
    }
}

#[test]
fn onset_scales_with_the_width_of_the_tip() {
    // x → Wx: r → W r, α → W² α, amplitude → W amplitude.
    let (one, two) = (0.6, 1.7);
    let at = |width: f64| {
        onset(&TipFunction::triple_gaussian(1.0, width).unwrap(), 1.3 * width).unwrap()
    };
    let (a, b) = (at(one), at(two));
    assert!((a.critical.period / b.critical.period - 1.0).abs() < 1e-12);
    assert!((a.amplitude_squared_slope / b.amplitude_squared_slope - 1.0).abs() < 1e-10);
    let ratio = (two / one).powi(2);
    assert!((a.period_slope / b.period_slope / ratio - 1.0).abs() < 1e-10);
}
