//! The depth to which a surface was carved.

use crate::line::Line;
use crate::plan::Plan;

/// What lines a pitch apart take away below each place, on average, counting what is heaped up beside a groove as what is
/// taken away: (α/(X d)) ∫w dt ∫∫|f|, in kσ²/a. For a footprint without side lobes it is the mean depth; for one that only
/// moves material (β = 1), whose mean depth is 0, it is of the size of the grooves that overlap.
pub(super) fn carved(plan: &Plan, lines: &[Line], pitch: f64) -> f64 {
    let time = |line: &Line| line.residence().1.iter().sum::<f64>() / line.track().length;
    let mean = lines.iter().map(time).sum::<f64>() / lines.len() as f64;
    plan.law.model.alpha() * mean * magnitude(plan) / pitch
}

/// ∫∫|f|, of each layer by itself.
fn magnitude(plan: &Plan) -> f64 {
    let step = 0.1 * 8.7 / plan.band();
    let reach = plan.reach_along();
    let count = (reach / step).ceil() as usize;
    let layers = plan.footprint.layers().iter();
    let of = |layer: &stickslip_tip::Layer| {
        // Of an even function both sides, its middle once.
        let sides = (1..=count).map(|i| 2.0 * layer.along.value(step * i as f64).abs());
        let along = step * (layer.along.value(0.0).abs() + sides.sum::<f64>());
        along * layer.across.integral()
    };
    layers.map(of).sum()
}
