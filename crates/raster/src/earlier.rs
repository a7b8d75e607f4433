//! The grooves of earlier lines along one line, as power series.
//!
//! ```text
//!     U(x) = -α Σ_l g_l * Σ_m h_l(y - y_m) ρ_m
//! ```
//!
//! The densities ρ_m are added on their lattice where the tip comes, so that nothing is needed of those parts of earlier
//! lines that are out of reach.

use crate::plan::Plan;
use crate::trace::{PIECE, Trace};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use stickslip_convolution::{Expander, PowerSeries, TERMS};
use stickslip_tip::Ground;

/// Largest number of cells that the series about one point takes, over all layers: beyond, transforms of whole lines
/// cost less.
const MOST_CELLS: usize = 600;
/// Number of pieces and of series that are kept.
const KEPT: usize = 32;

/// What the series of all lines are made with.
pub(crate) struct Expanders(Vec<Expander>);

impl Expanders {
    /// `None` for footprints of which transforms of whole lines cost less.
    pub(crate) fn new(plan: &Plan) -> Option<Arc<Self>> {
        let expander = |layer: &stickslip_tip::Layer| {
            let transform = |k| layer.along.transform(k);
            let bands = (layer.along.band(), plan.band());
            Some(Expander::new(bands, layer.along.reach()?, transform))
        };
        let layers = plan.footprint.layers();
        let cells = |layer: &stickslip_tip::Layer| {
            2.0 * layer.along.reach().unwrap_or(f64::INFINITY) * plan.band()
        };
        if layers.iter().map(cells).sum::<f64>() > MOST_CELLS as f64 {
            return None;
        }
        layers.iter().map(expander).collect::<Option<_>>().map(|all| Arc::new(Self(all)))
    }

    /// The spacing of densities.
    pub(crate) fn spacing(&self) -> f64 {
        self.0[0].spacing()
    }
}

/// The grooves that one line runs through.
pub(crate) struct Earlier {
    expanders: Arc<Expanders>,
    /// Each trace with its factor in each layer.
    rows: Vec<(Vec<f64>, Arc<Trace>)>,
    given_up: Arc<AtomicBool>,
    kept: Mutex<Kept>,
}

/// What was computed last, each at its number modulo the size.
struct Kept {
    /// Σ_m of each layer.
    pieces: Vec<Option<(i64, Vec<f64>)>>,
    series: Vec<Option<(i64, PowerSeries)>>,
    cells: Vec<f64>,
}

impl fmt::Debug for Earlier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Earlier").field("rows", &self.rows.len()).finish_non_exhaustive()
    }
}

impl Earlier {
    pub(crate) fn new(
        expanders: Arc<Expanders>,
        rows: Vec<(Vec<f64>, Arc<Trace>)>,
        given_up: Arc<AtomicBool>,
    ) -> Self {
        let kept = Kept { pieces: vec![None; KEPT], series: vec![None; KEPT], cells: vec![] };
        Self { expanders, rows, given_up, kept: Mutex::new(kept) }
    }

    /// Σ_m of all layers on one piece. If the line is given up it may be anything.
    fn piece(&self, n: i64) -> Vec<f64> {
        let mut sums = vec![0.0; PIECE * self.expanders.0.len()];
        for (factors, trace) in &self.rows {
            let Some(pieces) = trace.pieces((n, n + 1), &self.given_up) else {
                self.given_up.store(true, Ordering::Relaxed);
                break;
            };
            for (_, piece) in pieces {
                for (factor, sums) in factors.iter().zip(sums.chunks_mut(PIECE)) {
                    sums.iter_mut().zip(&*piece).for_each(|(sum, rho)| *sum += factor * rho);
                }
            }
        }
        sums
    }

    fn series(&self, point: i64, kept: &mut Kept) -> PowerSeries {
        let mut series = [0.0; TERMS];
        for (layer, expander) in self.expanders.0.iter().enumerate() {
            let (first, size) = (point - expander.reach() as i64, PIECE as i64);
            let last = point + expander.reach() as i64;
            kept.cells.clear();
            for n in first.div_euclid(size)..=last.div_euclid(size) {
                let piece = &mut kept.pieces[slot(n)];
                if piece.as_ref().is_none_or(|(kept, _)| *kept != n) {
                    *piece = Some((n, self.piece(n)));
                }
                let Some((_, sums)) = piece else { continue };
                let from = (first - n * size).max(0) as usize;
                let to = (last - n * size + 1).min(size) as usize;
                kept.cells.extend(&sums[PIECE * layer..][from..to]);
            }
            expander.add(&kept.cells, &mut series);
        }
        series
    }
}

impl Ground for Earlier {
    fn spacing(&self) -> f64 {
        self.expanders.spacing()
    }

    fn about(&self, point: i64) -> PowerSeries {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, series)) = kept.series[slot(point)].filter(|(kept, _)| *kept == point) {
            return series;
        }
        let series = self.series(point, &mut kept);
        kept.series[slot(point)] = Some((point, series));
        series
    }
}

/// Where what has this number is kept.
fn slot(n: i64) -> usize {
    usize::try_from(n.rem_euclid(KEPT as i64)).unwrap_or(0)
}
