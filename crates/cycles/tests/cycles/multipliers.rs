//! Floquet multipliers against a slow computation that shares neither states nor exponentials with them: the
//! linearised delay equation
//!
//! ```text
//!     δ'(t) = -δ(t) + α ∫ f''(x0(t) - x0(t')) (δ(t) - δ(t')) dt'
//! ```
//!
//! by the trapezoidal rule over all of the past within reach, its period map iterated on a subspace, and two
//! step lengths extrapolated. Tips are those that no few exponentials follow, and the paper's.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{DMatrix, DVector};
use num_complex::Complex;
use stickslip_cycles::{Cycle, DEFAULT_TOLERANCE, cycle};
use stickslip_stability::critical;
use stickslip_tip::{Gaussian, Model, TipFunction, Wider, eigenvalues};

/// Dimension of the subspace, and periods that it is carried through.
const VECTORS: usize = 5;
const PERIODS: usize = 14;

/// The period map of deviations, on the past as values at even times.
struct PeriodMap {
    /// Points of a period, and of all the past that matters.
    points: usize,
    past: usize,
    h: f64,
    /// α h f''(x0(t_i) - x0(t_i - (j+1)h)) in column i, row j,
    kernel: DMatrix<f64>,
    /// and the sums of its columns.
    stiffness: Vec<f64>,
}

impl PeriodMap {
    fn of(cycle: &Cycle, points: usize) -> Self {
        let (tip, r, period) = (cycle.model().tip(), cycle.model().r(), cycle.period());
        let periods = (tip.reach().unwrap() / (r * period)).ceil() as usize + 1;
        let (past, h) = (points * periods, period / points as f64);
        // Position at any multiple of h: that within the first period, and so many wavelengths.
        let within: Vec<f64> = (0..points).map(|i| cycle.motion().x0(i as f64 * h)).collect();
        let x = |i: isize| {
            let (round, i) = (i.div_euclid(points as isize), i.rem_euclid(points as isize));
            within[i as usize] + round as f64 * r * period
        };
        let kernel = DMatrix::from_fn(past, points, |j, i| {
            let distance = x(i as isize) - x(i as isize - 1 - j as isize);
            cycle.model().alpha() * h * tip.slope_and_curvature(distance).1
        });
        let stiffness = kernel.column_iter().map(|column| column.sum()).collect();
        Self { points, past, h, kernel, stiffness }
    }

    /// A past, the latest value last, one period later.
    fn apply(&self, past: &DVector<f64>) -> DVector<f64> {
        let mut values = past.as_slice().to_vec();
        // δ' = -a δ + b
        let rate = |i: usize, values: &[f64]| {
            let i = i % self.points;
            let column = self.kernel.column(i);
            let latest = values.iter().rev().take(self.past);
            let fed: f64 = column.iter().zip(latest).map(|(k, v)| k * v).sum();
            (1.0 - self.stiffness[i], -fed)
        };
        let (mut a, mut b) = rate(0, &values[..values.len() - 1]);
        for i in 0..self.points {
            let here = values[values.len() - 1];
            let (a_next, b_next) = rate(i + 1, &values);
            let known = here + 0.5 * self.h * (b - a * here + b_next);
            values.push(known / (1.0 + 0.5 * self.h * a_next));
            (a, b) = (a_next, b_next);
        }
        DVector::from_column_slice(&values[self.points..])
    }

    /// Its largest eigenvalues.
    fn multipliers(&self) -> Vec<Complex<f64>> {
        // One value more than the past reaches: at the first step the rate before it is asked for.
        let seed = |i: usize, k: usize| ((i + 1) as f64 * (1.7 + k as f64) / 97.0).sin();
        let mut basis = DMatrix::from_fn(self.past + 1, VECTORS, seed).qr().q();
        let carry = |basis: &DMatrix<f64>| {
            let columns: Vec<_> =
                basis.column_iter().map(|column| self.apply(&column.into_owned())).collect();
            DMatrix::from_columns(&columns)
        };
        for _ in 0..PERIODS {
            basis = carry(&basis).qr().q();
        }
        let mut found = eigenvalues(basis.tr_mul(&carry(&basis))).unwrap();
        found.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
        found
    }
}

fn sum(lobes: &[(f64, f64, f64)]) -> TipFunction {
    let both = |&(amplitude, center, width): &(f64, f64, f64)| {
        let center = [center, -center];
        let count = if center[0] > 0.0 { 2 } else { 1 };
        center.into_iter().take(count).map(move |center| Gaussian { amplitude, center, width })
    };
    TipFunction::gaussian_sum(lobes.iter().flat_map(both).collect()).unwrap()
}

fn table(f: impl Fn(f64) -> f64, rows: usize, length: f64) -> TipFunction {
    let x: Vec<f64> = (0..rows).map(|i| length * i as f64 / (rows - 1) as f64).collect();
    let f: Vec<f64> = x.iter().map(|x| f(*x)).collect();
    TipFunction::table(&x, &f).unwrap()
}

fn judge(name: &str, tip: TipFunction, above: f64, points: usize, leading: usize) {
    let alpha = above * critical(&Wider::default(), &tip, 1.0).unwrap().alpha;
    let cycle = cycle(&Model::new(tip, alpha, 1.0).unwrap(), DEFAULT_TOLERANCE).unwrap();
    let [coarse, fine] = [points, 2 * points].map(|n| PeriodMap::of(&cycle, n).multipliers());
    let slow = fine.iter().zip(&coarse).map(|(fine, coarse)| (fine * 4.0 - coarse) / 3.0);
    let nearest = |m: Complex<f64>| {
        cycle.multipliers().iter().map(|own| (own - m).norm()).fold(f64::INFINITY, f64::min)
    };
    for m in slow.take(leading) {
        assert!(nearest(m) < 1e-5, "{name}: {m:.9} is not among {:.9?}", cycle.multipliers());
    }
    assert!(nearest(Complex::ONE) < 1e-7, "{name}: {:?}", cycle.multipliers());
}

#[test]
fn the_papers_tip() {
    judge("near onset", TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.01, 300, 4);
    judge("stick-slip", TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.2, 400, 3);
}

#[test]
fn narrow_lobes() {
    judge("0.3", sum(&[(1.0, 0.0, 1.0), (0.3, 1.5, 0.3)]), 1.05, 500, 2);
    // A panic in the Schur decomposition once.
    judge("0.1", sum(&[(1.0, 0.0, 1.0), (-0.1, 2.0, 0.1)]), 1.03, 600, 2);
    // The largest was left out once: two sums of too few exponentials did not agree on it.
    judge("0.07", sum(&[(1.0, 0.0, 1.0), (0.09, 3.15, 0.07), (-0.04, 3.4, 0.4)]), 1.01, 800, 2);
}

#[test]
fn tables() {
    judge("Gaussian", table(|x| (-0.5 * x * x).exp(), 275, 9.0), 1.05, 300, 2);
    judge("coarse", table(|x| (1.0 + x * x).powi(-4), 47, 8.0), 1.05, 800, 2);
}
