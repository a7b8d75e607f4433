//! Σ_j w_j f(x - x_j) over the residence of the tip (positions x_j, weights w_j), by the cheaper of two methods.

use ndarray::Array1;
use rayon::prelude::*;
use stickslip_convolution::{Kernel, direct_sum, sum};
use stickslip_tip::TipFunction;
use stickslip_tip::sorting::ends;

/// Methods for a sum over the residence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One evaluation of f per position of the tip and per x: the definition.
    Direct,
    /// A non-uniform FFT: a bounded number of operations per position and per x.
    Fft,
}

/// Number of pairs of source and target that cost as much as one source or target by FFT. Measured with
/// benches/surface.rs; a factor of two changes little.
const PAIRS_PER_POINT: f64 = 16.0;
/// Number of lattice cells that cost as much as one source or target by FFT.
const CELLS_PER_POINT: f64 = 2.0;
/// Largest number of cells of a lattice, which takes a gigabyte with its transforms.
pub(crate) const MOST_CELLS: f64 = 1e7;

/// Number of cells of a lattice for sources at these positions and targets in the interval.
pub(crate) fn cells(tip: &TipFunction, positions: &[f64], (c, d): (f64, f64)) -> f64 {
    let (a, b) = ends(positions.iter().copied());
    let extent = match tip.reach() {
        Some(reach) => (b.min(d + reach) - a.max(c - reach)).max(0.0) + 2.0 * reach,
        None => 4.0 * (b.max(d) - a.min(c)),
    };
    extent * tip.band() * 2.0 / std::f64::consts::PI
}

impl Method {
    /// The cheaper method for these positions and points; `Direct` if a lattice over their extent would have more than
    /// 1e7 cells.
    pub fn cheaper(tip: &TipFunction, positions: &[f64], x: &[f64]) -> Self {
        let (sources, targets) = (positions.len() as f64, x.len() as f64);
        let cells = cells(tip, positions, ends(x.iter().copied()));
        let by_fft = PAIRS_PER_POINT * (sources + targets + cells / CELLS_PER_POINT + 200.0);
        if sources * targets <= by_fft || cells > MOST_CELLS { Self::Direct } else { Self::Fft }
    }
}

/// Σ_j `weights_j` f(x - `positions_j`) at every x, by the cheaper method.
///
/// # Panics
/// The numbers of weights and positions differ, or x is not finite and [`Method::Fft`] is used.
pub fn carved(tip: &TipFunction, positions: &[f64], weights: &[f64], x: &[f64]) -> Array1<f64> {
    carved_by(Method::cheaper(tip, positions, x), tip, positions, weights, x)
}

/// As [`carved`], by the given method.
///
/// # Panics
/// As [`carved`].
pub fn carved_by(
    method: Method,
    tip: &TipFunction,
    positions: &[f64],
    weights: &[f64],
    x: &[f64],
) -> Array1<f64> {
    let value = |x: f64| tip.value(x);
    let kernel = Kernel { value: &value, band: tip.band(), reach: tip.reach() };
    match method {
        Method::Direct => {
            let at = |x: &f64| direct_sum(&kernel, positions, weights, &[*x])[0];
            x.par_iter().map(at).collect::<Vec<f64>>().into()
        }
        Method::Fft => sum(&kernel, positions, weights, x).into(),
    }
}
