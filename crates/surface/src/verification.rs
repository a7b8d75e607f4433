//! Does a run keep its promise? It is repeated with another memory and a tighter tolerance, and a twin with
//! a slightly different start tells how much an error grows.

mod compare;
mod growth;
mod spread;

pub use compare::Difference;
pub use growth::Growth;

use crate::SurfaceError;
use compare::{compare_l, compare_u};
use growth::growth;
use std::ops::ControlFlow;
use stickslip_tip::{MemoryChoice, Run, RunError, Scenario, TOLERANCES, Trajectory, run_observed};
use thiserror::Error;

/// What is promised of l is so many tolerances: the errors of steps add up, and slips amplify them. It is
/// what the test-suite holds every memory to (tests/tolerance_ladder.rs).
pub const TOLERANCES_ALLOWED: f64 = 10.0;

/// The second run's tolerance is so many times smaller, where f64 allows that.
const TIGHTER: f64 = 100.0;
/// The twin's start is off by so many of its tolerances, far above its errors,
const SHIFT: f64 = 1e4;
/// but by no more than this, far below the motion.
const LARGEST_SHIFT: f64 = 1e-4;
/// A direct sum over more steps takes longer than a person waits.
const MOST_STEPS_OF_DIRECT: u64 = 3000;
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
    /// How a small error grows with time.
    pub growth: Growth,
}

/// What is verified.
#[derive(Debug, Clone, Copy)]
pub enum Claim<'a> {
    /// The dense history of a run.
    History(&'a Trajectory),
    /// Samples of a run that lasted to a given time: pairs of t and l.
    Samples(&'a [(f64, f64)], f64),
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

/// Repeats a run of `scenario` that was made with the memory of that name, and compares.
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
    claim: Claim,
    mut observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let steps = match claim {
        Claim::History(trajectory) => trajectory.steps().len() as u64,
        Claim::Samples(..) => u64::MAX,
    };
    let until = match claim {
        Claim::History(trajectory) => trajectory.end(),
        Claim::Samples(_, until) => until,
    };
    let tolerance = tighter(scenario);
    let other = Scenario { tolerance, until, ..scenario.clone() };
    let reference = repeat(&other, another(memory, steps), 0.0, &mut observe)?;
    let shift = (SHIFT * tolerance).min(LARGEST_SHIFT).max(TIGHTER * tolerance);
    let twin = Scenario { kick: scenario.kick + shift, ..other };
    let twin = repeat(&twin, vec![MemoryChoice::Fft, MemoryChoice::Direct], 0.5, &mut observe)?;

    let allowed = TOLERANCES_ALLOWED * scenario.tolerance;
    let (l, trusted_until) = compare_l(claim, &reference.trajectory, allowed);
    let u = match claim {
        Claim::Samples(..) => None,
        Claim::History(trajectory) => {
            Some(compare_u(&scenario.model, trajectory, &reference, allowed)?)
        }
    };
    let growth = growth(&reference.trajectory, &twin.trajectory, shift, tolerance);
    let memory = reference.memory;
    Ok(Verification { memory, tolerance, l, u, trusted_until, growth })
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

/// Memories that may repeat a run, the best witness first.
fn another(used: &str, steps: u64) -> Vec<MemoryChoice> {
    let mut others = vec![MemoryChoice::Modes, MemoryChoice::Fft, MemoryChoice::Direct];
    if steps <= MOST_STEPS_OF_DIRECT {
        others.rotate_right(1);
    }
    let name = |choice: &MemoryChoice| match choice {
        MemoryChoice::Auto => "auto",
        MemoryChoice::Direct => "direct",
        MemoryChoice::Fft => "fft",
        MemoryChoice::Modes => "modes",
    };
    others.retain(|choice| name(choice) != used);
    others
}

/// Runs with the first of the memories that applies.
fn repeat(
    scenario: &Scenario,
    memories: Vec<MemoryChoice>,
    done: f64,
    observe: &mut impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Run, VerificationError> {
    let (start, until) = (scenario.start_time(), scenario.until);
    let mut last = None;
    for memory in memories {
        let scenario = Scenario { memory, ..scenario.clone() };
        let part = |t: f64| done + 0.5 * (t - start) / (until - start);
        match run_observed(&scenario, |step| observe(part(step.end()))) {
            Ok(run) if run.interrupted => return Err(VerificationError::Interrupted),
            Ok(run) => return Ok(run),
            Err(error @ (RunError::Modes(_) | RunError::Integration(_))) => last = Some(error),
            Err(error) => return Err(error.into()),
        }
    }
    Err(last.map_or(VerificationError::Interrupted, VerificationError::Run))
}
