//! The surface after the last line, and its volume.

use crate::grooves::Grooves;
use crate::line::Line;
use crate::plan::Plan;
use ndarray::Array2;
use rayon::prelude::*;

/// u(x,y) after these lines of a plan.
pub struct Scanned {
    grooves: Grooves,
}

impl Scanned {
    /// The surface of all these lines.
    pub fn new(plan: &Plan, lines: &[Line]) -> Self {
        Self { grooves: Grooves::of_all(plan, lines) }
    }

    /// u(x,y) at every y (rows) and every x (columns), in kσ²/a. The cost of a row is proportional to the number of
    /// lines within its reach, plus a bounded number of operations for each x.
    pub fn heights(&self, x: &[f64], y: &[f64]) -> Array2<f64> {
        self.grooves.heights(x, y)
    }
}

/// ∫∫ u dx dy after these lines: -α ∫∫f times the total time of the scan, weighted by the depth limit and reduced by
/// healing. In the basic model it is -α (X/r) ∫∫f for each line, of length X.
pub fn volume(plan: &Plan, lines: &[Line]) -> f64 {
    let left =
        |line: &Line| plan.law.model.wider().left_after(plan.duration_of(line.track().length));
    let all = lines.iter().zip(times(lines));
    let all = all.fold(0.0, |sum, (line, time)| sum * left(line) + time);
    // 0, and not -0, if f has none.
    0.0 - plan.law.model.alpha() * plan.footprint.integral() * all
}

/// Mean depth carved by lines of length X at the pitch d, with material heaped up beside a groove counted like removed
/// material: (α/(X d)) ∫w dt ∫∫|f|, in kσ²/a. For a footprint without side lobes it is the mean depth. For β = 1 the mean
/// depth is 0, as material is only moved, but this depth has the size of overlapping grooves.
pub(crate) fn carved_depth(plan: &Plan, lines: &[Line], pitch: f64) -> f64 {
    let rates = lines.iter().zip(times(lines)).map(|(line, time)| time / line.track().length);
    let mean = rates.sum::<f64>() / lines.len() as f64;
    plan.law.model.alpha() * mean * magnitude(plan) / pitch
}

/// The time of the tip on each line, weighted by the depth limit and reduced by healing.
fn times(lines: &[Line]) -> Vec<f64> {
    lines.par_iter().map(|line| line.residence().1.iter().sum()).collect()
}

/// ∫∫|f|, summed over the layers.
fn magnitude(plan: &Plan) -> f64 {
    let step = 0.1 * 8.7 / plan.band();
    let reach = plan.reach_along();
    let count = (reach / step).ceil() as usize;
    let layers = plan.footprint.layers().iter();
    let of = |layer: &stickslip_tip::Layer| {
        let height = |x: f64| layer.along.value(x).abs();
        let sides = (1..=count).map(|i| step * i as f64).map(|x| height(x) + height(-x));
        let along = step * (layer.along.value(0.0).abs() + sides.sum::<f64>());
        along * layer.across.integral()
    };
    layers.map(of).sum()
}
