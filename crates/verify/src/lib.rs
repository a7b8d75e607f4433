//! Does a run keep its promise? It is repeated with another memory and a tighter tolerance, and a twin with
//! a slightly different start tells how much an error grows.

mod compare;
mod growth;
mod repeat;
mod spread;

pub use compare::{ComparedSamples, Difference, Sample};
pub use growth::Growth;

use compare::{AgainstSamples, Judgement, compare_l, compare_u};
use growth::{Probes, growth};
use repeat::{Kept, Repetition, Witness, another};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use stickslip_surface::SurfaceError;
use stickslip_tip::{
    InitialSurface, MemoryChoice, Pulse, RunError, Scenario, TOLERANCES, Trajectory,
};
use thiserror::Error;

/// What is promised of l is so many tolerances: the errors of steps add up, and slips amplify them. It is
/// what the test-suite holds every memory to (tests/science/tolerance_ladder.rs).
pub const TOLERANCES_ALLOWED: f64 = 10.0;

/// The second run's tolerance is so many times smaller, where f64 allows that.
const TIGHTER: f64 = 100.0;
/// The twin is shifted by so many of its tolerances, far above its errors,
const SHIFT: f64 = 1e4;
/// but by no more than this, far below the motion.
const LARGEST_SHIFT: f64 = 1e-4;

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Memory of the second run.
    pub memory: &'static str,
    /// Tolerance of the second run.
    pub tolerance: f64,
    /// In l, over all of the run.
    pub l: Difference,
    /// In the surface at the end of the run; `None` without a dense history.
    pub u: Option<Difference>,
    /// The first time at which l differs by more than is allowed.
    pub trusted_until: Option<f64>,
    /// Which samples these are; `None` with a dense history.
    pub samples: Option<ComparedSamples>,
    /// How a small error grows with time.
    pub growth: Growth,
}

/// Why a run could not be verified.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum VerificationError {
    /// It could not be repeated.
    #[error("the run could not be repeated: {0}")]
    Run(#[from] RunError),
    /// The surface could not be had.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The observer stopped it.
    #[error("the verification was interrupted")]
    Interrupted,
}

impl Verification {
    /// Whether all differences are allowed.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        self.l.is_allowed() && self.u.is_none_or(|u| u.is_allowed())
    }
}

/// Repeats a run of `scenario` that was made with the memory of that name, and compares with its dense
/// history.
///
/// l is promised to [`TOLERANCES_ALLOWED`] tolerances ε. Where the tip strays by that much, the surface does
/// by at most α ε ∫|f'(x - x0(t'))|dt', what is allowed of it.
///
/// `observe` is told the part of the work that is done, and may stop it.
///
/// # Errors
/// The run cannot be repeated, or was stopped.
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

/// As [`verify`], of a run of which nothing is left but samples in the order of time, the last at `until`.
///
/// They are asked for once for each memory that is tried, and compared as the second run passes them: memory
/// holds neither the samples nor the second run, and does not grow with their length but where the second
/// run's memory is `direct`. Samples beyond `until` are not looked at.
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

/// The second run and its twin.
struct Second<'a, O> {
    /// What is repeated: to a tighter tolerance, until the run ended.
    scenario: Scenario,
    /// That of the run asked for, however early it ended: noise and its spline reach to the end asked for.
    surface: &'a InitialSurface,
    observe: O,
}

impl<'a, O: FnMut(f64) -> ControlFlow<()>> Second<'a, O> {
    fn of(run: &Scenario, surface: &'a InitialSurface, until: f64, observe: O) -> Self {
        let scenario = Scenario { tolerance: tighter(run), until, ..run.clone() };
        Self { scenario, surface, observe }
    }

    /// Repeats with the first of the memories that applies, watched by a witness; and tells from the twin how
    /// errors grow.
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
        Verification { memory, tolerance, l, u, trusted_until, samples, growth }
    }
}

/// A tip without a spring is pushed after this part of the run,
const PUSHED_AFTER: f64 = 0.1;
/// but by this time, in Γ/k;
const PUSHED_BY: f64 = 1.0;
/// the push lasts this part of the time before it.
const PUSH_WIDTH: f64 = 0.1;

/// The run with a small disturbance, which shifts the tip by so much.
///
/// Behind a support the tip starts off its place. Without one that would shift all of the run: there a short force pushes
/// the tip off what it has left so far.
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

/// The tightest tolerance, down to a hundredth, that can be asked for.
fn tighter(scenario: &Scenario) -> f64 {
    let asked = scenario.tolerance;
    let factors = [TIGHTER, 30.0, 10.0, 3.0];
    let tried = factors.map(|factor| (asked / factor).max(TOLERANCES.0)).into_iter();
    let can_be_met =
        |tolerance: &f64| Scenario { tolerance: *tolerance, ..scenario.clone() }.validate().is_ok();
    tried.filter(|tolerance| *tolerance < asked).find(can_be_met).unwrap_or(asked)
}
