//! Verification of a run: it is repeated with another memory and a tighter tolerance, and a perturbed run measures
//! the growth of errors. A run in two coordinates by `modes` is repeated by `fft`, and one by `fft` by `direct`.

mod across;
mod compare;
mod growth;
mod repeat;

pub use across::{verify_across, verify_samples_across};
pub use compare::{ComparedSamples, Difference, Sample};
pub use growth::Growth;

use compare::{AgainstSamples, Judgement, compare, compare_u};
use growth::Probes;
use repeat::{another, keep, repeat};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use stickslip_surface::SurfaceError;
use stickslip_tip::planar::PlanarError;
use stickslip_tip::{MemoryChoice, Pulse, RunError, Scenario, Step, TOLERANCES, Trajectory};
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
    let memories = another(memory, trajectory.steps().len() as u64);
    let see = |steps: &mut Vec<Step>, step: &Step, _| keep(steps, step);
    let (repeated, steps) = repeated(scenario, trajectory.end(), memories, Vec::new, see, observe)?;
    let (wider, support) = (*scenario.model.wider(), scenario.support());
    let reference = Trajectory::under(wider, support, steps);
    let allowed = TOLERANCES_ALLOWED * scenario.tolerance;
    let judgement = compare(trajectory, &reference, Trajectory::followed, allowed);
    let u = compare_u(&scenario.model, trajectory, &reference, allowed)?;
    Ok(repeated.verification(&[judgement], Some(u), None))
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
    let allowed = TOLERANCES_ALLOWED * scenario.tolerance;
    let begin =
        || AgainstSamples::new(scenario.support(), samples(), scenario.start_time(), allowed);
    let see = |compared: &mut AgainstSamples<I>, step: &Step, before| {
        compared.see(step, |_| None, before);
        Ok(())
    };
    let memories = another(memory, u64::MAX);
    let (repeated, compared) = repeated(scenario, until, memories, begin, see, observe)?;
    Ok(repeated.verification(&compared.judgements[..1], None, Some(compared.found)))
}

/// The second run, and the growth of errors from its perturbed copy.
struct Repeated {
    memory: &'static str,
    tolerance: f64,
    growth: Growth,
}

impl Repeated {
    /// The verification from the judgements of l and, in two coordinates, of y0.
    fn verification(
        self,
        judgements: &[Judgement],
        u: Option<Difference>,
        samples: Option<ComparedSamples>,
    ) -> Verification {
        let Self { memory, tolerance, growth } = self;
        let (l, y) = (judgements[0].worst, judgements.get(1).map(|judgement| judgement.worst));
        let wrong = judgements.iter().filter_map(|judgement| judgement.trusted_until);
        let trusted_until = wrong.reduce(f64::min);
        Verification { memory, tolerance, l, y, u, trusted_until, samples, growth }
    }
}

/// Repeats a run up to a time with the first applicable memory and a tighter tolerance, and measures the growth of errors
/// by a perturbed run. `begin` makes an empty record of the repetition, and `see` adds a step to it, with the time before
/// which the step is valid.
fn repeated<T>(
    run: &Scenario,
    until: f64,
    memories: Vec<MemoryChoice>,
    begin: impl Fn() -> T,
    mut see: impl FnMut(&mut T, &Step, f64) -> Result<(), RunError>,
    mut observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(Repeated, T), VerificationError> {
    // That of the original request, which may end later: noise and its spline extend to that end.
    let surface = run.initial_surface()?;
    let scenario = Scenario { tolerance: tighter(run), until, ..run.clone() };
    let (tolerance, support) = (scenario.tolerance, scenario.support());
    let probes = || Probes::over((scenario.start_time(), until));
    let probe = |probes: &mut Probes, step: &Step, before: f64| {
        probes.probe(before, |t| [step.followed(&support, t), 0.0]);
    };
    let see_and_probe = |(seen, here): &mut (T, Probes), step: &Step, before: f64| {
        probe(here, step, before);
        see(seen, step, before)
    };
    let both = || (begin(), probes());
    let (memory, (seen, here)) =
        repeat((&scenario, &surface), memories, (0.0, 0.5), both, see_and_probe, &mut observe)?;
    let shift = shift(tolerance);
    let only_probe = |there: &mut Probes, step: &Step, before: f64| {
        probe(there, step, before);
        Ok(())
    };
    let (_, there) = repeat(
        (&twin(&scenario, shift), &surface),
        vec![MemoryChoice::Fft, MemoryChoice::Direct],
        (0.5, 1.0),
        probes,
        only_probe,
        &mut observe,
    )?;
    let growth = here.growth(&there, shift, tolerance);
    Ok((Repeated { memory, tolerance, growth }, seen))
}

/// Shift of the perturbed run, in σ, for runs with this tolerance.
fn shift(tolerance: f64) -> f64 {
    (SHIFT * tolerance).min(LARGEST_SHIFT).max(TIGHTER * tolerance)
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
