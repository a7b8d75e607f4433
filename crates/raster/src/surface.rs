//! The surface after the last line, and how much of it is gone.

use crate::grooves::Grooves;
use crate::line::Line;
use crate::plan::Plan;
use ndarray::Array2;

/// u(x,y) after these lines of a plan.
pub struct Scanned {
    grooves: Grooves,
}

impl Scanned {
    /// Reads all lines.
    #[must_use]
    pub fn new(plan: &Plan, lines: &[Line]) -> Self {
        Self { grooves: Grooves::of_all(plan, lines) }
    }

    /// u(x,y) at every y (rows) and every x (columns), in kσ²/a. A row costs as much as there are lines within reach
    /// of it, and a bounded number of operations for each x.
    #[must_use]
    pub fn heights(&mut self, x: &[f64], y: &[f64]) -> Array2<f64> {
        let mut heights = Array2::zeros((y.len(), x.len()));
        for (mut row, y) in heights.rows_mut().into_iter().zip(y) {
            row.assign(&ndarray::Array1::from(self.grooves.heights(*y, x)));
        }
        heights
    }

    /// What each line alone left below it (rows), at every x (columns).
    #[must_use]
    pub fn own_grooves(&mut self, x: &[f64]) -> Array2<f64> {
        let rows = self.grooves.own_heights(x);
        Array2::from_shape_fn((rows.len(), x.len()), |(n, i)| rows[n][i])
    }
}

/// ∫∫ u dx dy after these lines: -α ∫∫f times how long the tip was there, under a depth limit with the weights of the
/// visits, and less what has healed. By the paper's law -α (X/r) ∫∫f for each line.
#[must_use]
pub fn volume(plan: &Plan, lines: &[Line]) -> f64 {
    let left =
        |line: &Line| plan.law.model.wider().left_after(plan.duration_of(line.track().length));
    let time = |line: &Line| line.residence().1.iter().sum::<f64>();
    let all = lines.iter().fold(0.0, |sum, line| sum * left(line) + time(line));
    -plan.law.model.alpha() * plan.footprint.integral() * all
}
