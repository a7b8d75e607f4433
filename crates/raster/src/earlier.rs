//! The grooves of earlier lines along one line, as power series.
//!
//! ```text
//!     U(x) = -α Σ_l g_l * Σ_m h_l(y - y_m) ρ_m
//! ```
//!
//! with f(x,y) = Σ_l g_l(x) h_l(y). The residence densities ρ_m are added on their lattice near the tip only, so that the
//! parts of earlier lines that are out of reach are not needed.

use crate::plan::Plan;
use crate::trace::{PIECE, Piece, Pieces, Trace};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use stickslip_convolution::{Expander, PowerSeries, TERMS};
use stickslip_tip::Ground;

/// Largest number of cells that the series about one point needs, over all layers. With more cells, transforms of whole
/// lines cost less.
const MOST_CELLS: usize = 600;
/// Number of pieces and of series that are kept.
const KEPT: usize = 32;

/// The expanders of all layers, which compute the series of all lines.
pub(crate) struct Expanders(Vec<Expander>);

impl Expanders {
    /// `None` for footprints for which transforms of whole lines cost less.
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

    /// The spacing of the lattice of densities.
    pub(crate) fn spacing(&self) -> f64 {
        self.0[0].spacing()
    }
}

/// The grooves that one line runs through.
pub(crate) struct Earlier {
    expanders: Arc<Expanders>,
    rows: Vec<Row>,
    /// Factors of the traces of all rows in each layer, one row after the other.
    factors: Vec<f64>,
    given_up: Arc<AtomicBool>,
    kept: Mutex<Kept>,
}

/// An earlier line.
struct Row {
    trace: Arc<Trace>,
    /// The pieces of the trace, if all were known when the line began: to lock it for each would make threads wait.
    whole: Option<Arc<Pieces>>,
}

impl Row {
    /// Adds a piece of the trace times the factors to the sums of all layers; false if the line is given up.
    fn add(&self, n: i64, factors: &[f64], sums: &mut [f64], given_up: &AtomicBool) -> bool {
        let mut add = |piece: &Piece| {
            for (factor, sums) in factors.iter().zip(sums.chunks_mut(PIECE)) {
                sums.iter_mut().zip(piece).for_each(|(sum, rho)| *sum += factor * rho);
            }
        };
        let mut read = |pieces: &Pieces| pieces.get(n).into_iter().for_each(&mut add);
        match &self.whole {
            Some(pieces) => read(pieces),
            None => return self.trace.read(n + 1, given_up, read).is_some(),
        }
        true
    }
}

/// The latest pieces and series, each with its number, stored at this number modulo [`KEPT`].
struct Kept {
    pieces: [Option<i64>; KEPT],
    /// Σ_m h_l(y - y_m) ρ_m of each layer, one piece after the other.
    sums: Vec<f64>,
    series: Vec<Option<(i64, PowerSeries)>>,
    cells: Vec<f64>,
}

impl fmt::Debug for Earlier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Earlier").field("rows", &self.rows.len()).finish_non_exhaustive()
    }
}

impl Earlier {
    /// The grooves of these traces, with their factors in each layer, one trace after the other.
    pub(crate) fn new(
        expanders: Arc<Expanders>,
        (traces, factors): (Vec<Arc<Trace>>, Vec<f64>),
        given_up: Arc<AtomicBool>,
    ) -> Self {
        let row = |trace: Arc<Trace>| Row { whole: trace.whole(), trace };
        let rows = traces.into_iter().map(row).collect();
        let kept = Kept {
            pieces: [None; KEPT],
            sums: vec![0.0; KEPT * PIECE * expanders.0.len()],
            series: vec![None; KEPT],
            cells: vec![],
        };
        Self { expanders, rows, factors, given_up, kept: Mutex::new(kept) }
    }

    /// Sets the sums of all layers on one piece; they are incomplete if the line is given up.
    fn sum(&self, n: i64, sums: &mut [f64]) {
        sums.fill(0.0);
        let mut rows = self.rows.iter().zip(self.factors.chunks(self.expanders.0.len()));
        if !rows.all(|(row, factors)| row.add(n, factors, sums, &self.given_up)) {
            self.given_up.store(true, Ordering::Relaxed);
        }
    }

    fn series(&self, point: i64, kept: &mut Kept) -> PowerSeries {
        let mut series = [0.0; TERMS];
        for (layer, expander) in self.expanders.0.iter().enumerate() {
            let (first, size) = (point - expander.reach() as i64, PIECE as i64);
            let last = point + expander.reach() as i64;
            kept.cells.clear();
            for n in first.div_euclid(size)..=last.div_euclid(size) {
                let room = PIECE * self.expanders.0.len();
                let sums = &mut kept.sums[room * slot(n)..][..room];
                if kept.pieces[slot(n)] != Some(n) {
                    self.sum(n, sums);
                    kept.pieces[slot(n)] = Some(n);
                }
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

/// The place in [`Kept`] of the piece or series with this number.
fn slot(n: i64) -> usize {
    usize::try_from(n.rem_euclid(KEPT as i64)).unwrap_or(0)
}
