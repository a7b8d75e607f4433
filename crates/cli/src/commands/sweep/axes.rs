//! Further axes of a sweep: each option alone is a constant of the sweep, or an axis of its grid.

use crate::arguments::{Range, SweepArguments};
use crate::failure::{Failure, Typed};
use stickslip::{AxisDocument, AxisName, StartName, SweepParameters, SweepRunParameters};
use stickslip_tip::Wider;

/// Largest integer seed that f64 represents exactly.
const LARGEST_SEED: f64 = 9_007_199_254_740_992.0;
/// Default start position of a run, as for `stickslip run`.
const START_POSITION: f64 = 14.0;

/// The axes of a sweep; an option adds one, or is a constant.
struct Axes(Vec<AxisDocument>);

impl Axes {
    fn number(&mut self, name: AxisName, asked: Option<&Range>) -> Option<f64> {
        let values = asked?.values();
        if let [value] = values.as_slice() {
            return Some(*value);
        }
        self.0.push(AxisDocument { name, values });
        None
    }
}

/// Law, initial condition and axes from the options, the seeds varying fastest.
pub(super) fn asked(
    arguments: &SweepArguments,
) -> Result<(Wider, Option<SweepRunParameters>, Vec<AxisDocument>), Failure> {
    let (law, run) = (&arguments.wider, &arguments.run);
    let mut axes = Axes(vec![]);
    let wider = Wider {
        depth_limit: axes.number(AxisName::DepthLimit, law.depth_limit.as_ref()),
        healing_time: axes.number(AxisName::HealingTime, law.healing_time.as_ref()),
        inertia: axes.number(AxisName::Inertia, law.inertia.as_ref()),
        spring: true,
    };
    judge_seeds(run.seed.as_ref())?;
    let Some(until) = run.until else { return Ok((wider, None, axes.0)) };
    let start_position = axes.number(AxisName::StartPosition, run.start_position.as_ref());
    let kick = axes.number(AxisName::Kick, run.kick.as_ref());
    let run = SweepRunParameters {
        until,
        start: run.start.unwrap_or(StartName::Steady),
        start_position: start_position.unwrap_or(START_POSITION),
        kick: kick.unwrap_or(0.0),
        start_velocity: axes.number(AxisName::StartVelocity, run.start_velocity.as_ref()),
        noise: axes.number(AxisName::Noise, run.noise.as_ref()),
        noise_spacing: axes.number(AxisName::NoiseSpacing, run.noise_spacing.as_ref()),
        seed: axes.number(AxisName::Seed, run.seed.as_ref()),
    };
    Ok((wider, Some(run), axes.0))
}

fn judge_seeds(seeds: Option<&Range>) -> Result<(), Failure> {
    let is_seed =
        |seed: &f64| (0.0..=LARGEST_SEED).contains(seed) && seed.fract().abs() < f64::EPSILON;
    match seeds.map(Range::values).unwrap_or_default().iter().find(|seed| !is_seed(seed)) {
        None => Ok(()),
        Some(seed) => {
            let message = "must be a whole number, 0 or above: 1:100:100 has a hundred";
            Err(Failure::input(format!("--seed {}", Typed(*seed)), message))
        }
    }
}

/// Law and initial condition at a point with these values on the axes.
pub(super) fn at(
    parameters: &SweepParameters,
    values: &[f64],
) -> (Wider, Option<SweepRunParameters>) {
    let (mut law, mut run) = (parameters.wider(), parameters.run.clone());
    for (axis, value) in parameters.axes.iter().zip(values) {
        match (axis.name, &mut run) {
            (AxisName::DepthLimit, _) => law.depth_limit = Some(*value),
            (AxisName::HealingTime, _) => law.healing_time = Some(*value),
            (AxisName::Inertia, _) => law.inertia = Some(*value),
            (AxisName::StartPosition, Some(run)) => run.start_position = *value,
            (AxisName::Kick, Some(run)) => run.kick = *value,
            (AxisName::StartVelocity, Some(run)) => run.start_velocity = Some(*value),
            (AxisName::Noise, Some(run)) => run.noise = Some(*value),
            (AxisName::NoiseSpacing, Some(run)) => run.noise_spacing = Some(*value),
            (AxisName::Seed, Some(run)) => run.seed = Some(*value),
            (_, None) => {}
        }
    }
    (law, run)
}
