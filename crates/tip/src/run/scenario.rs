//! Scenarios: all parameters of a run, and errors in them.

use crate::integrator::IntegrationError;
use crate::memory::{FitError, MemoryChoice, Policy, Retreat, accuracy_needed};
use crate::series::SeriesError;
use crate::state::Damaged;
use crate::support::PathError;
use crate::{Force, InitialSurface, Model, Noise, Relief, Step, Support, SupportPath, TipFunction};
use std::sync::Arc;
use thiserror::Error;

/// The initial condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// The steady state (22), (24), as after an infinite past: t1 = (X + r + l0)/r.
    Steady,
    /// A flat surface, the spring relaxed, the support above the tip: t1 = X/r.
    Flat,
}

/// All parameters of a run. Lengths in σ, times in Γ/k, forces in kσ.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// Footprint, α and r.
    pub model: Model,
    /// The initial condition, steady or flat.
    pub start: Start,
    /// Start position X, before the kick.
    pub start_position: f64,
    /// The tip starts at X - kick, so that l starts `kick` above its value without a kick.
    pub kick: f64,
    /// Path of the support, from t = 0 on; `None` for a support of constant velocity r.
    pub path: Option<SupportPath>,
    /// Velocity V of a tip with inertia at the start; `None` for r on a steady start, and for 0 on a flat one.
    pub start_velocity: Option<f64>,
    /// Noise added to the initial surface.
    pub noise: Option<Noise>,
    /// Profile (x, u) added to the initial surface.
    pub profile: Option<(Vec<f64>, Vec<f64>)>,
    /// External force.
    pub force: Force,
    /// Time to integrate to.
    pub until: f64,
    /// Target for the error of l(t), in σ.
    pub tolerance: f64,
    /// Memory to use.
    pub memory: MemoryChoice,
}

/// Errors of a run: an invalid scenario, or an integration that cannot be completed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError {
    /// X is not finite.
    #[error("the start position must be a finite number, not {0:?}")]
    StartPosition(f64),
    /// The kick is not finite.
    #[error("the kick must be a finite number, not {0:?}")]
    Kick(f64),
    /// The start velocity is not finite, or not 0 for a tip without inertia.
    #[error(
        "a start velocity of {0:?}: it must be a finite number, and only a tip with inertia has a start velocity (without inertia it follows from the surface and the forces)"
    )]
    StartVelocity(f64),
    /// The path of the support is invalid.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A path is given, but without a spring there is no support.
    #[error("without a spring there is no support that could move on a path")]
    PathWithoutSpring,
    /// The path ends before the run does.
    #[error(
        "the path of the support ends at t = {end:?}, before the end of the run at {until:?}: end the run there, or extend the path"
    )]
    PathEnds {
        /// Last time of the path.
        end: f64,
        /// Requested end.
        until: f64,
    },
    /// The scenario has no steady motion to start from.
    #[error("{0}")]
    NoSteadyStart(&'static str),
    /// The end of the run precedes its start.
    #[error("the run starts at t = {start:?}: it must end after that, not at {until:?}")]
    Until {
        /// Requested end.
        until: f64,
        /// Time at which the tip is at its start position.
        start: f64,
    },
    /// The tolerance is not a positive number, or f64 cannot meet it.
    #[error(
        "the tolerance must lie between {min:e}, below which round-off takes over, and {max}; {0:e} does not",
        min = TOLERANCES.0, max = TOLERANCES.1
    )]
    Tolerance(f64),
    /// A position so large that its rounding error is too coarse for the initial surface there.
    #[error(
        "at x = {x:e} positions are rounded to {rounding:.1e}, too coarse for a tolerance of {tolerance:e} on the initial surface there: allow a tolerance of {least:.1e} or above, or stay nearer to 0",
        rounding = f64::EPSILON * x, least = f64::EPSILON * x / SHARE_OF_ROUNDING
    )]
    TooFar {
        /// Farthest position of the initial surface.
        x: f64,
        /// Requested tolerance.
        tolerance: f64,
    },
    /// The amplitude of the noise is negative or not finite, its spacing is not positive, or it needs too many
    /// points.
    #[error(
        "noise of amplitude {:?} on a spacing of {:?}: both must be finite, the amplitude 0 or above, the spacing above 0, and the run would need {points:e} points (at most {MOST_NOISE_POINTS:e})",
        noise.amplitude, noise.spacing
    )]
    Noise {
        /// The noise requested.
        noise: Noise,
        /// Grid points between the start and the end.
        points: f64,
    },
    /// The initial surface is not a function of x.
    #[error("the initial surface: {0}")]
    Profile(SeriesError),
    /// `modes` is requested, but exponentials do not fit the footprint.
    #[error(transparent)]
    Modes(#[from] FitError),
    /// The integration cannot continue.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The history has too many steps.
    #[error(
        "at t = {t}: the history has {MOST_STEPS} steps, more than fit in memory; end the run earlier, or keep no history"
    )]
    HistoryTooLong {
        /// Time reached.
        t: f64,
    },
    /// The saved state does not belong to this scenario.
    #[error("the saved state cannot be used: {0}")]
    State(#[from] Damaged),
}

/// Largest number of steps in a history.
pub const MOST_STEPS: usize = 1_700_000;

// A run that is refused for its length has stayed below 256 MB until then.
const _: () = assert!(MOST_STEPS * size_of::<Step>() <= 235_000_000);

/// Range of the tolerances. Below 1e-13 the rounding errors of positions dominate.
pub const TOLERANCES: (f64, f64) = (1e-13, 1e-2);

/// Largest number of noise points; their splines take some 600 MB.
const MOST_NOISE_POINTS: f64 = 2e7;
/// Share of the tolerance available for rounding errors of positions.
const SHARE_OF_ROUNDING: f64 = 0.05;
/// Length of the noise behind the start and ahead of the last position of the support, in σ.
const NOISE_BEYOND: f64 = 30.0;

impl Scenario {
    /// A steady start at X = 14 without any disturbance, with a tolerance of 1e-9.
    pub fn new(model: Model, until: f64) -> Self {
        Self {
            model,
            start: Start::Steady,
            start_position: 14.0,
            kick: 0.0,
            path: None,
            start_velocity: None,
            noise: None,
            profile: None,
            force: Force::default(),
            until,
            tolerance: 1e-9,
            memory: MemoryChoice::Auto,
        }
    }

    /// Start time t1 of the run. A support of constant velocity r then has the position that the start requires. t1 =
    /// 0 for a support on a path, and without a spring.
    pub fn start_time(&self) -> f64 {
        if self.path.is_some() || !self.model.wider().spring {
            return 0.0;
        }
        (self.start_position + self.start_extension()) / self.model.r()
    }

    /// Checks a saved state by the time of its tip, and by the end of the steps that it contains.
    pub(crate) fn check_saved(&self, t: f64, end: f64) -> Result<(), Damaged> {
        // The last step ends at the end of the run, except for a rounding.
        let latest = self.until + 4.0 * f64::EPSILON * self.until.abs().max(1.0);
        let is_within = (self.start_time()..=self.until).contains(&t) && end <= latest;
        if is_within { Ok(()) } else { Err(Damaged::OutOfRange) }
    }

    /// The motion of the support.
    pub fn support(&self) -> Support {
        match &self.path {
            _ if !self.model.wider().spring => Support::None,
            Some(path) => {
                let start = self.start_position + self.start_extension();
                Support::Path(Arc::new(path.clone().starting_at(start)))
            }
            None => Support::Moving(self.model.r()),
        }
    }

    /// Start velocity of a tip with inertia.
    pub fn velocity_at_start(&self) -> f64 {
        self.start_velocity.unwrap_or(match self.start {
            Start::Steady => self.model.r(),
            Start::Flat => 0.0,
        })
    }

    /// Extension R - x0 at the start, before the kick.
    pub(crate) fn start_extension(&self) -> f64 {
        if !self.model.wider().spring {
            return -self.start_position;
        }
        match self.start {
            Start::Steady => self.model.steady_lag(),
            Start::Flat => 0.0,
        }
    }

    /// The initial surface u0(x).
    ///
    /// # Errors
    /// A profile that is not a function of x.
    pub fn initial_surface(&self) -> Result<InitialSurface, RunError> {
        let mut surface = match self.start {
            Start::Steady => InitialSurface::steady(&self.model, self.start_position),
            Start::Flat => InitialSurface::flat(),
        };
        if let Some((x, u)) = self.profile.clone() {
            surface = surface.with(Relief::profile(x, u).map_err(RunError::Profile)?);
        }
        if let Some(noise) = self.noise {
            let (from, to) = self.noise_range();
            surface = surface.with(Relief::noise(noise, from, to));
        }
        Ok(surface)
    }

    pub(crate) fn noise_range(&self) -> (f64, f64) {
        let last = self.farthest().max(self.start_position);
        (self.start_position - NOISE_BEYOND, last + NOISE_BEYOND)
    }

    /// The largest position of the support.
    pub(crate) fn farthest(&self) -> f64 {
        match self.support() {
            Support::Moving(r) => r * self.until,
            Support::None => self.start_position,
            Support::Path(path) => {
                let (_, displacement) = path.knots();
                let most = displacement.iter().copied().fold(0.0, f64::max);
                self.start_position + self.start_extension() + most
            }
        }
    }

    /// Checks the start against the extended model.
    fn validate_wider(&self) -> Result<(), RunError> {
        let wider = self.model.wider();
        if let Some(path) = &self.path {
            if !wider.spring {
                return Err(RunError::PathWithoutSpring);
            }
            if path.end() < self.until {
                return Err(RunError::PathEnds { end: path.end(), until: self.until });
            }
        }
        if let Some(v) = self.start_velocity
            && !(v.is_finite() && (wider.inertia.is_some() || v.abs() <= 0.0))
        {
            return Err(RunError::StartVelocity(v));
        }
        if self.start == Start::Steady && !wider.spring {
            return Err(RunError::NoSteadyStart(
                "without a spring nothing drags the tip: it starts on a flat surface",
            ));
        }
        let endless = *self.model.tip() == TipFunction::Cosine && wider.healing_time.is_none();
        if self.start == Start::Steady && endless {
            return Err(RunError::NoSteadyStart(
                "the footprint cosine does not decay, so that the groove of steady motion diverges: start on a flat surface, or let the surface heal",
            ));
        }
        Ok(())
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// The first parameter out of range.
    pub fn validate(&self) -> Result<(), RunError> {
        if !self.start_position.is_finite() {
            return Err(RunError::StartPosition(self.start_position));
        }
        if !self.kick.is_finite() {
            return Err(RunError::Kick(self.kick));
        }
        let (until, start) = (self.until, self.start_time());
        if !(until.is_finite() && until > start) {
            return Err(RunError::Until { until, start });
        }
        if !(TOLERANCES.0..=TOLERANCES.1).contains(&self.tolerance) {
            return Err(RunError::Tolerance(self.tolerance));
        }
        self.validate_wider()?;
        let textured = self.noise.is_some() || self.profile.is_some();
        let last = if textured { self.farthest() } else { 0.0 };
        let x = self.start_position.abs().max(last);
        self.validate_rounding(x)?;
        if let Some(noise) = self.noise {
            let (from, to) = self.noise_range();
            let points = (to - from) / noise.spacing;
            let fits = noise.spacing > 0.0 && points <= MOST_NOISE_POINTS;
            if !(noise.amplitude.is_finite() && noise.amplitude >= 0.0 && fits) {
                return Err(RunError::Noise { noise, points });
            }
        }
        Ok(())
    }

    /// Checks that positions up to x are rounded finely enough for an initial surface there.
    pub(crate) fn validate_rounding(&self, x: f64) -> Result<(), RunError> {
        if f64::EPSILON * x > SHARE_OF_ROUNDING * self.tolerance {
            return Err(RunError::TooFar { x, tolerance: self.tolerance });
        }
        Ok(())
    }

    pub(super) fn new_memory(&self) -> Result<Policy, RunError> {
        let accuracy = accuracy_needed(&self.model, self.tolerance);
        let swings = self.model.wider().swings_back();
        let back = if swings { Retreat::Swing } else { Retreat::Small };
        Ok(Policy::new(self.memory, self.model.tip().clone(), accuracy, back)?)
    }
}
