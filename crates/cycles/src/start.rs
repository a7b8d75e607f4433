//! Initial guesses for Newton's method: the oscillation that bifurcates at αc, or a run.

use super::embedding::Embedding;
use super::mesh::{MOST_STEPS, equidistributed, graded};
use super::orbit::{Orbit, Profile, even_mesh};
use super::{CycleError, UnsettledRun};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;
use stickslip_stability::{Criticality, Onset};
use stickslip_tip::elementary::cos;
use stickslip_tip::motion::{Oscillation, last_period, latest_extrema};
use stickslip_tip::step::longest_displacement;
use stickslip_tip::{Model, Scenario, Trajectory, run_observed};

const FEWEST_STEPS: f64 = 18.0;
/// Largest amplitude at which the leading order is used as a guess, in widths.
const LARGEST_MODE: f64 = 1.0;
/// Wavelength of the motion over the width with which it scales. If the lobes of f are narrow, the motion does not depend
/// on their width; a ninth of the wavelength, about the width of a Gaussian, then replaces it.
const WIDTHS_PER_WAVELENGTH: f64 = 9.0;

/// The linear mode with the amplitude and period of leading order in α - αc; `None` if the amplitude is imaginary, or
/// so large that Newton's method might converge to another cycle.
pub(super) fn from_onset(equation: &Embedding, onset: &Onset) -> Option<Orbit> {
    let above = equation.alpha - onset.critical.alpha;
    let square = onset.amplitude_squared_slope * above;
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let model = equation.model()?;
    let amplitude = square.sqrt();
    let width = equation.width().max(onset.critical.wavelength / WIDTHS_PER_WAVELENGTH);
    if amplitude > LARGEST_MODE * width {
        return None;
    }
    let period = onset.critical.period + onset.period_slope * above;
    if period <= 0.5 * onset.critical.period {
        return None;
    }
    let mesh = even_mesh(steps_of_mode(equation, period, amplitude)?);
    let l = mode(model.steady_l(), amplitude, period);
    Some(Orbit::of_profile(equation.r, period, mesh, Profile { l, height: |_| None }))
}

/// l(t) of the linear mode.
pub(super) fn mode(steady: f64, amplitude: f64, period: f64) -> impl Fn(f64) -> f64 {
    move |t| steady + amplitude * cos(TAU * t / period)
}

/// A number of steps at which the displacement in each step is short enough; `None` if it exceeds [`MOST_STEPS`].
pub(super) fn steps_of_mode(equation: &Embedding, period: f64, amplitude: f64) -> Option<usize> {
    let farthest = equation.r * period + PI * amplitude;
    let longest = longest_displacement(equation.band);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let steps = FEWEST_STEPS.max(1.5 * farthest / longest) as usize;
    (steps <= MOST_STEPS).then_some(steps)
}

/// Whether a small cycle is expected at this α.
pub(super) fn small_cycle_exists(equation: &Embedding, onset: &Onset) -> bool {
    let above = equation.alpha > onset.critical.alpha;
    above == (onset.criticality == Criticality::Supercritical)
}

/// Times from the start at which a run is examined. If the period of the bifurcating oscillation is longer than
/// [`USUAL_PERIOD`], they are longer in proportion.
const LOOKS: [f64; 4] = [80.0, 320.0, 1280.0, 5120.0];
const USUAL_PERIOD: f64 = 10.0;
/// Largest number of steps of a run.
const MOST_STEPS_OF_A_RUN: usize = 200_000;
const TOLERANCE_OF_A_RUN: f64 = 1e-6;
/// Initial displacement of the tip, in widths.
const KICK: f64 = 0.3;

/// Passes the last period of a run to `take` at increasing times, until `take` returns true; returns the run. The kick
/// is proportional to `width`, and `born` is the period of the oscillation that bifurcates at onset.
pub(super) fn from_run(
    model: &Model,
    (width, born): (f64, f64),
    mut take: impl FnMut(Orbit) -> bool,
) -> Result<UnsettledRun, CycleError> {
    let mut scenario = Scenario::new(model.clone(), 0.0);
    scenario.kick = KICK * width;
    scenario.tolerance = TOLERANCE_OF_A_RUN;
    let start = scenario.start_time();
    let mut looks = LOOKS.map(|length| start + length * (born / USUAL_PERIOD).max(1.0)).into_iter();
    scenario.until = looks.next_back().unwrap_or(start);
    let mut look = looks.next().unwrap_or(f64::INFINITY);
    let (mut taken, mut offered) = (false, vec![]);
    let run = run_observed(&scenario, |so_far| {
        if so_far.end() >= look {
            look = looks.next().unwrap_or(f64::INFINITY);
            taken = offer(so_far, &mut offered, &mut take);
        }
        if taken || so_far.steps().len() == MOST_STEPS_OF_A_RUN {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    })?;
    if !taken {
        offer(&run.trajectory, &mut offered, &mut take);
    }
    scenario.until = scenario.until.min(run.trajectory.end());
    Ok(UnsettledRun { scenario, run })
}

/// Passes the last period of a run to `take`, and returns what `take` returns. The same period is not passed twice: a
/// stuck tip has no other.
fn offer(
    trajectory: &Trajectory,
    offered: &mut Vec<(f64, f64)>,
    take: impl FnMut(Orbit) -> bool,
) -> bool {
    let extrema = latest_extrema(trajectory);
    // Where none is seen yet, a period may have one slip or two.
    let slips = Oscillation::of(trajectory, &extrema).map_or(1..=2, |o| o.slips..=o.slips);
    let mut periods: Vec<_> = slips.filter_map(|slips| last_period(&extrema, slips)).collect();
    periods.retain(|period| !offered.contains(period));
    offered.extend_from_slice(&periods);
    periods.into_iter().map(|(from, to)| part(trajectory, from, to)).any(take)
}

/// One period of a run, with the steps of the run.
pub(super) fn part(trajectory: &Trajectory, from: f64, to: f64) -> Orbit {
    let period = to - from;
    let steps = trajectory.steps().iter().filter(|step| step.t < to && step.end() > from);
    let (mut mesh, mut density) = (vec![0.0], vec![]);
    for step in steps {
        mesh.push(((step.end() - from) / period).min(1.0));
        density.push(period / step.h);
    }
    // Steps by series come in groups of one length; those about a corner of |h| are short for good.
    let density = if trajectory.wider().depth_limit.is_some() { density } else { graded(density) };
    let profile = || Profile {
        l: |t: f64| trajectory.l(from + t),
        height: |t: f64| trajectory.height(from + t),
    };
    let r = trajectory.r();
    let on = |corners: &[f64]| {
        Orbit::of_profile(r, period, equidistributed(&mesh, &density, corners), profile())
    };
    let part = on(&[]);
    // Steps of the run end at the corners of |h|: so must these.
    match part.corners(r) {
        corners if corners.is_empty() => part,
        corners => on(&corners),
    }
}
