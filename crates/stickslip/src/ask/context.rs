//! What an answer is computed within: cancellation, progress, time.

use crate::Failure;
use std::fmt::{self, Debug};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip_tip::stop;

/// Who may cancel an answer, and who watches its progress.
#[derive(Clone, Default)]
pub struct Context {
    cancel: Arc<AtomicBool>,
    progress: Option<Arc<Progress>>,
    clock: Option<fn() -> f64>,
}

/// Takes the part that is done, from 0 to 1, where that is known, and what is counted, such as `12 of 60 points`.
type Progress = dyn Fn(Option<f64>, &str) + Send + Sync;

impl Context {
    /// Nobody watches; the work ends early once `cancel` is set.
    #[must_use]
    pub fn cancelled_by(cancel: Arc<AtomicBool>) -> Self {
        Self { cancel, ..Self::default() }
    }

    /// Calls `progress` with the part that is done, from 0 to 1, where that is known, and what is counted.
    #[must_use]
    pub fn watched_by(self, progress: impl Fn(Option<f64>, &str) + Send + Sync + 'static) -> Self {
        Self { progress: Some(Arc::new(progress)), ..self }
    }

    /// Measures time by `clock`, in s: `work.seconds` of an answer is 0 without one.
    #[must_use]
    pub fn timed_by(self, clock: fn() -> f64) -> Self {
        Self { clock: Some(clock), ..self }
    }

    /// Seconds since some fixed time.
    pub(crate) fn seconds(&self) -> f64 {
        self.clock.map_or(0.0, |clock| clock())
    }

    /// Reports `done` of `all` parts, called `parts`.
    ///
    /// # Errors
    /// The work is cancelled.
    pub(crate) fn counted(&self, done: usize, all: usize, parts: &str) -> Result<(), Failure> {
        self.reached(Some(done as f64 / all as f64), &format!("{done} of {all} {parts}"))
    }

    /// Reports the part that is done, from 0 to 1, where that is known, and what is counted.
    ///
    /// # Errors
    /// The work is cancelled.
    pub(crate) fn reached(&self, part: Option<f64>, counted: &str) -> Result<(), Failure> {
        if let Some(progress) = &self.progress {
            progress(part, counted);
        }
        if self.is_cancelled() { Err(Failure::Cancelled) } else { Ok(()) }
    }

    /// Whether the work is to end early.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Work that ends early once it is cancelled, with what there is by then.
    pub(crate) fn keeping<T>(
        &self,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let done = stop::where_asked_by(&self.cancel, work);
        if done.is_err() && self.is_cancelled() { Err(Failure::Cancelled) } else { done }
    }

    /// Work that ends early once it is cancelled.
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
