//! A relief on a lattice: the groove of any number of earlier scans.

use std::sync::Arc;
use stickslip_convolution::Field;

/// Heights and slopes as fields, each evaluated with its derivative. They are smooth everywhere, so that no step has
/// to end at a break.
///
/// Slopes are not differences of heights but a separate field, so that curvatures are as accurate as slopes.
#[derive(Debug, Clone)]
pub(super) struct OnLattice {
    fields: Arc<[Field; 2]>,
    /// The value at x is that of the fields at origin + sign x.
    origin: f64,
    sign: f64,
    low: f64,
    high: f64,
}

impl OnLattice {
    /// A relief from fields that decay towards their ends, along x from an origin or, if mirrored, against x.
    pub(super) fn new(heights: Field, slopes: Field, (origin, mirrored): (f64, bool)) -> Self {
        let (a, b) = (heights.range(), slopes.range());
        let (low, high) = (a.start().max(*b.start()), a.end().min(*b.end()));
        let sign = if mirrored { -1.0 } else { 1.0 };
        Self { fields: Arc::new([heights, slopes]), origin, sign, low, high }
    }

    /// Coordinate in the fields; `None` beyond their ends.
    fn place(&self, x: f64) -> Option<f64> {
        let at = self.origin + self.sign * x;
        (at > self.low && at < self.high).then_some(at)
    }

    pub(super) fn covers(&self, x: f64) -> bool {
        self.place(x).is_some()
    }

    pub(super) fn height(&self, x: f64) -> f64 {
        self.place(x).map_or(0.0, |at| self.fields[0].value(at))
    }

    pub(super) fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        let Some(at) = self.place(x) else { return (0.0, 0.0) };
        let (slope, curvature) = self.fields[1].value_and_derivative(at);
        (self.sign * slope, curvature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;
    use stickslip_convolution::{Density, Spectra};

    /// Where a tip was and for how long, on two passes.
    fn visits() -> Vec<(f64, f64)> {
        let at = |i: i32| 30.0 * (f64::from(i) * 0.618_034).fract() + (0.9 * f64::from(i)).sin();
        (0..400).map(|i| (at(i), 0.1 + (0.37 * f64::from(i)).cos().powi(2))).collect()
    }

    fn relief(tip: &TipFunction, along: (f64, bool)) -> OnLattice {
        let mut spectra = Spectra::new(tip.band(), -20.0, 50.0);
        let mut density = Density::new(spectra.spacing());
        visits().iter().for_each(|(x, weight)| density.add(*x, *weight));
        let modes = spectra.of(&density);
        let k: Vec<f64> = spectra.wave_numbers().collect();
        let heights: Vec<_> = modes.iter().zip(&k).map(|(rho, k)| -rho * tip.fourier(*k)).collect();
        let slopes: Vec<_> = heights
            .iter()
            .zip(&k)
            .map(|(height, k)| num_complex::Complex::new(0.0, *k) * height)
            .collect();
        OnLattice::new(spectra.field(&heights), spectra.field(&slopes), along)
    }

    fn direct(tip: &TipFunction, x: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (at, weight) in visits() {
            let (slope, curvature) = tip.slope_and_curvature(x - at);
            sums[0] -= weight * tip.value(x - at);
            sums[1] -= weight * slope;
            sums[2] -= weight * curvature;
        }
        sums
    }

    /// Heights are of order 10; the errors found are 3e-14, 7e-15 and 3e-13, those of curvature from one more derivative.
    #[test]
    fn heights_slopes_and_curvatures_are_those_of_the_direct_sum() {
        for tip in [
            TipFunction::gaussian(1.0).unwrap(),
            TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
            TipFunction::gaussian(0.4).unwrap(),
        ] {
            let steep = tip.band() / 8.7;
            let (there, back) = (relief(&tip, (0.0, false)), relief(&tip, (31.0, true)));
            let further = relief(&tip, (4.0, false));
            let mut worst = [0.0_f64; 3];
            for i in 0..700 {
                let x = -15.0 + 0.087 * f64::from(i);
                let wanted = direct(&tip, x);
                let (slope, curvature) = there.slope_and_curvature(x);
                let found = [there.height(x), slope, curvature];
                for n in 0..3 {
                    worst[n] = worst[n].max((found[n] - wanted[n]).abs());
                }
                let (mirrored, same) = back.slope_and_curvature(31.0 - x);
                assert!((mirrored + slope).abs() < 1e-11 && (same - curvature).abs() < 1e-10);
                assert!((back.height(31.0 - x) - found[0]).abs() < 1e-12);
                assert!((further.height(x - 4.0) - found[0]).abs() < 1e-12);
            }
            let allowed = [1e-13, 5e-14 * steep, 1e-12 * steep * steep];
            assert!(worst.iter().zip(allowed).all(|(w, a)| *w < a), "{worst:?}, {allowed:?}");
        }
    }

    /// A reader that broke off at the last visit would miss the groove's own reach; beyond that there is nothing.
    #[test]
    fn it_goes_on_to_where_nothing_is_left() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let relief = relief(&tip, (0.0, false));
        assert!(relief.height(-1.0).abs() > 1e-2 && relief.height(33.0).abs() > 1e-2);
        let at_the_end = relief.low.next_up();
        assert!(relief.height(at_the_end).abs() < 1e-12);
        assert!(!relief.covers(relief.low) && relief.height(relief.low - 1.0).abs() < 1e-300);
    }
}
