//! Verification of a run: it is repeated with another memory and a tighter tolerance, and a perturbed run measures
//! the growth of errors. A run in two coordinates by `modes` is repeated by `fft`, and one by `fft` by `direct`.

mod across;
mod compare;
mod growth;
mod repeat;

pub use across::{verify_across, verify_samples_across};
pub use compare::{ComparedSamples, Difference, Sample};
pub use growth::Growth;

use compare::{AgainstSamples, Judgement, compare_l, compare_u};
use growth::{Probes, growth};
use repeat::{Kept, Repetition, Witness, another};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use stickslip_surface::SurfaceError;
use stickslip_tip::planar::PlanarError;
use stickslip_tip::{
    InitialSurface, MemoryChoice, Pulse, RunError, Scenario, TOLERANCES, Trajectory,
};
use thiserror::Error;

/// Allowed error of l, in tolerances: step errors add up, and slips amplify them. The test suite uses the same limit
/// for every memory (tests/science/tolerance_ladder.rs).
pub const TOLERANCES_ALLOWED: f64 = 10.0;

/// Ratio of the two tolerances, if the smaller one is within reach of f64.
const TIGHTER: f64 = 100.0;
/// Shift of the perturbed run, in tolerances: far above its errors.
const SHIFT: f64 = 1e4;
/// Largest shift, in σ, if it is above 100 tolerances: far below the motion.
const LARGEST_SHIFT: f64 = 1e-4;

/// Result of a verification.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Memory of the second run.
    pub memory: &'static str,
    /// Tolerance of the second run.
    pub tolerance: f64,
    /// Difference in l, over the whole run.
    pub l: Difference,
    /// Difference in y0, over the whole run; `None` for a run in one coordinate.
    pub y: Option<Difference>,
    /// Difference of the final surface; `None` without a dense history, and for a run in two coordinates.
    pub u: Option<Difference>,
    /// The first time at which the difference of l or y0 exceeds its limit.
    pub trusted_until: Option<f64>,
    /// Statistics of the compared samples; `None` with a dense history.
    pub samples: Option<ComparedSamples>,
    /// Growth of a small error with time.
    pub growth: Growth,
}

/// The reason why a run could not be verified.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum VerificationError {
    /// The run could not be repeated.
    #[error("the run could not be repeated: {0}")]
    Run(#[from] RunError),
    /// The run in two coordinates could not be repeated.
    #[error("the run could not be repeated: {0}")]
    Across(#[from] PlanarError),
    /// The surface could not be computed.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The observer stopped the verification.
    #[error("the verification was interrupted")]
    Interrupted,
}

impl Verification {
    /// Whether all differences are within their limits.
    pub fn is_kept(&self) -> bool {
        let mut others = [self.y, self.u].into_iter().flatten();
        self.l.is_allowed() && others.all(|one| one.is_allowed())
    }
}

/// Repeats a run of `scenario` with a memory other than `memory`, that of the run, and compares the dense histories.
///
/// The limit of l is [`TOLERANCES_ALLOWED`] tolerances ε. An error ε of the tip's position changes the surface by at
/// most α ε ∫|f'(x - x0(t'))|dt', which is the limit of the surface.
///
/// `observe` is called with the fraction of the work done, and may stop it.
///
/// # Errors
/// The run cannot be repeated, or the observer stopped the work.
pub fn verify(
    scenario: &Scenario,
    memory: &str,
    trajectory: &Trajectory,
    observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let surface = scenario.initial_surface()?;
    let mut second = Second::of(scenario, &surface, trajectory.end(), observe);
    let steps = trajectory.steps().len() as u64;
    let mut kept = Kept::default();
    let (by, growth) = second.run(another(memory, steps), &mut kept)?;
    let (wider, support) = (*scenario.model.wider(), scenario.support());
    let reference = Trajectory::under(wider, support, kept.steps);
    let allowed = TOLERANCES_ALLOWED * scenario.tolerance;
    let judgement = compare_l(trajectory, &reference, allowed);
    let u = compare_u(&scenario.model, trajectory, &reference, allowed)?;
    Ok(second.verification(by, &judgement, Some(u), None, growth))
}

/// Verifies a run as [`verify`] does, from samples in the order of time.
///
/// The samples are requested once for each memory that is tried, and compared as the second run proceeds. Neither the
/// samples nor the second run are stored, unless the second run uses `direct`. Samples after `until` are ignored.
///
/// # Errors
/// As [`verify`].
pub fn verify_samples<I: Iterator<Item = Sample>>(
    scenario: &Scenario,
    memory: &str,
    samples: impl Fn() -> I,
    until: f64,
    observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let surface = scenario.initial_surface()?;
    let mut second = Second::of(scenario, &surface, until, observe);
    let allowed = TOLERANCES_ALLOWED * scenario.tolerance;
    let mut compared =
        AgainstSamples::new(scenario.support(), samples, (scenario.start_time(), until), allowed);
    let (by, growth) = second.run(another(memory, u64::MAX), &mut compared)?;
    let (judgement, found) = compared.finish();
    Ok(second.verification(by, &judgement, None, Some(found), growth))
}

/// The second run and its perturbed copy.
struct Second<'a, O> {
    /// The scenario with a tighter tolerance, up to the end of the run.
    scenario: Scenario,
    /// The initial surface of the original request, which may end later: noise and its spline extend to that end.
    surface: &'a InitialSurface,
    observe: O,
}

impl<'a, O: FnMut(f64) -> ControlFlow<()>> Second<'a, O> {
    fn of(run: &Scenario, surface: &'a InitialSurface, until: f64, observe: O) -> Self {
        let scenario = Scenario { tolerance: tighter(run), until, ..run.clone() };
        Self { scenario, surface, observe }
    }

    /// Repeats the run with the first applicable memory, observed by the witness, and measures the growth of errors by
    /// the perturbed run.
    fn run(
        &mut self,
        memories: Vec<MemoryChoice>,
        witness: &mut impl Witness,
    ) -> Result<(&'static str, Growth), VerificationError> {
        let Self { scenario, surface, observe } = self;
        let tolerance = scenario.tolerance;
        let mut here = Probes::of(scenario);
        let repetition = Repetition { scenario, surface, from: 0.0, to: 0.5 };
        let by = repetition.run(memories, &mut (witness, &mut here), observe)?;
        let shift = (SHIFT * tolerance).min(LARGEST_SHIFT).max(TIGHTER * tolerance);
        let twin = twin(scenario, shift);
        let mut there = Probes::of(&twin);
        let repetition = Repetition { scenario: &twin, surface, from: 0.5, to: 1.0 };
        repetition.run(vec![MemoryChoice::Fft, MemoryChoice::Direct], &mut there, observe)?;
        Ok((by, growth(&here, &there, shift, tolerance)))
    }

    fn verification(
        self,
        memory: &'static str,
        judgement: &Judgement,
        u: Option<Difference>,
        samples: Option<ComparedSamples>,
        growth: Growth,
    ) -> Verification {
        let Judgement { worst: l, trusted_until } = *judgement;
        let tolerance = self.scenario.tolerance;
        Verification { memory, tolerance, l, y: None, u, trusted_until, samples, growth }
    }
}

/// Fraction of the run after which a tip without a spring is pushed.
const PUSHED_AFTER: f64 = 0.1;
/// Latest time of this push after the start, in Γ/k.
const PUSHED_BY: f64 = 1.0;
/// Width of the pulse of force, relative to its time after the start.
const PUSH_WIDTH: f64 = 0.1;

/// The run with a small disturbance, which shifts the tip by `shift`.
///
/// A tip on a spring starts at a shifted position. Without a spring this would shift the whole run; therefore a short
/// force displaces the tip relative to its groove.
fn twin(scenario: &Scenario, shift: f64) -> Scenario {
    if scenario.model.wider().spring {
        return Scenario { kick: scenario.kick + shift, ..scenario.clone() };
    }
    let start = scenario.start_time();
    let after = (PUSHED_AFTER * (scenario.until - start)).min(PUSHED_BY);
    let width = PUSH_WIDTH * after;
    let amplitude = shift / (width * TAU.sqrt());
    let push = Pulse { amplitude, time: start + after, width };
    Scenario { force: scenario.force.clone().with_pulse(push), ..scenario.clone() }
}

/// The tightest tolerance that can be requested, at best a hundredth of that of the run.
fn tighter(scenario: &Scenario) -> f64 {
    let can_be_met = |tolerance| Scenario { tolerance, ..scenario.clone() }.validate().is_ok();
    tightest(scenario.tolerance, can_be_met)
}

/// The tightest tolerance that can be met among `asked` divided by 100, 30, 10 and 3; `asked` itself if none can.
fn tightest(asked: f64, can_be_met: impl Fn(f64) -> bool) -> f64 {
    let factors = [TIGHTER, 30.0, 10.0, 3.0];
    let mut tried = factors.into_iter().map(|factor| (asked / factor).max(TOLERANCES.0));
    tried.find(|tolerance| *tolerance < asked && can_be_met(*tolerance)).unwrap_or(asked)
}
