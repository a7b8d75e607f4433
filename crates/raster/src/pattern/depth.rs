//! The mean carved depth of a surface.

use crate::line::Line;
use crate::plan::Plan;

/// Mean depth carved by lines one pitch apart, with material heaped up beside a groove counted like removed material:
/// (α/(X d)) ∫w dt ∫∫|f|, in kσ²/a. For a footprint without side lobes it is the mean depth; for β = 1, which only
/// moves material and has mean depth 0, it has the size of overlapping grooves.
pub(super) fn carved(plan: &Plan, lines: &[Line], pitch: f64) -> f64 {
    let time = |line: &Line| line.residence().1.iter().sum::<f64>() / line.track().length;
    let mean = lines.iter().map(time).sum::<f64>() / lines.len() as f64;
    plan.law.model.alpha() * mean * magnitude(plan) / pitch
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
