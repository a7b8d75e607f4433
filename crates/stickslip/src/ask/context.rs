//! The context of a computation: cancellation, progress, time.

use crate::Failure;
use std::fmt::{self, Debug};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip_tip::stop;

/// Cancellation flag, progress callback and clock of a computation.
#[derive(Clone, Default)]
pub struct Context {
    cancel: Arc<AtomicBool>,
    progress: Option<Arc<Progress>>,
    clock: Option<fn() -> f64>,
}

/// A callback for progress: the fraction done, from 0 to 1, if known, and a count such as `12 of 60 points`.
type Progress = dyn Fn(Option<f64>, &str) + Send + Sync;

impl Context {
    /// A context without progress reports; the work ends early once `cancel` is set.
    pub fn cancelled_by(cancel: Arc<AtomicBool>) -> Self {
        Self { cancel, ..Self::default() }
    }

    /// Calls `progress` with the fraction done, from 0 to 1, if known, and with a count.
    #[must_use]
    pub fn watched_by(self, progress: impl Fn(Option<f64>, &str) + Send + Sync + 'static) -> Self {
        Self { progress: Some(Arc::new(progress)), ..self }
    }

    /// Measures time by `clock`, in s: `work.seconds` of an answer is 0 without one.
    #[must_use]
    pub fn timed_by(self, clock: fn() -> f64) -> Self {
        Self { clock: Some(clock), ..self }
    }

    /// Seconds since a fixed time; 0 without a clock.
    pub(crate) fn seconds(&self) -> f64 {
        self.clock.map_or(0.0, |clock| clock())
    }

    /// Reports progress: `done` of `all` items, named `parts`.
    ///
    /// # Errors
    /// The work is cancelled.
    pub(crate) fn counted(&self, done: usize, all: usize, parts: &str) -> Result<(), Failure> {
        self.reached(Some(done as f64 / all as f64), &format!("{done} of {all} {parts}"))
    }

    /// Reports the fraction done, from 0 to 1, if known, and a count.
    ///
    /// # Errors
    /// The work is cancelled.
    pub(crate) fn reached(&self, part: Option<f64>, counted: &str) -> Result<(), Failure> {
        if let Some(progress) = &self.progress {
            progress(part, counted);
        }
        if self.is_cancelled() { Err(Failure::Cancelled) } else { Ok(()) }
    }

    /// Reports, at every 32nd step of a few µs, the time t that a run from `start` to `until` has reached.
    pub(crate) fn stepped(&self, (start, until): (f64, f64), t: f64, steps: usize) {
        const STEPS_PER_REPORT: usize = 32;
        if steps.is_multiple_of(STEPS_PER_REPORT) {
            // A run looks by itself whether it is cancelled.
            self.reached(Some((t - start) / (until - start)), &format!("t = {t:.6}")).ok();
        }
    }

    /// Whether the work is to end early.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Runs work that ends early once it is cancelled, and returns its partial result.
    pub(crate) fn keeping<T>(
        &self,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let done = stop::with_flag(&self.cancel, work);
        if done.is_err() && self.is_cancelled() { Err(Failure::Cancelled) } else { done }
    }

    /// Runs work that ends early once it is cancelled, and returns an error then.
    pub(crate) fn within<T>(
        &self,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let done = self.keeping(work)?;
        if self.is_cancelled() { Err(Failure::Cancelled) } else { Ok(done) }
    }
}

impl Debug for Context {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Context").field("cancel", &self.cancel).finish_non_exhaustive()
    }
}
