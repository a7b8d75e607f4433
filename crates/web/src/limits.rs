//! Limits on what the page computes.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip::Context;

/// Largest end time of a run, in Γ/k: the history of a fast motion then takes some 100 MB.
pub(crate) const MOST_TIME: f64 = 20_000.0;
/// Largest number of lines of a raster.
pub(crate) const MOST_LINES: usize = 400;
/// Computing time in milliseconds after which a run is cut off.
const MOST_MILLISECONDS: f64 = 4_000.0;

/// A clock in milliseconds, and the time at which it was started.
#[derive(Clone, Copy)]
pub(crate) struct Stopwatch {
    now: fn() -> f64,
    began: f64,
}

impl Stopwatch {
    pub(crate) fn from(now: fn() -> f64) -> Self {
        Self { now, began: now() }
    }

    pub(crate) fn seconds(self) -> f64 {
        ((self.now)() - self.began) / 1e3
    }

    /// A context that cuts a run off at the limit of computing time.
    pub(crate) fn context(self) -> Context {
        let cut_off = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&cut_off);
        Context::cancelled_by(cut_off).watched_by(move |_, _| {
            if self.seconds() * 1e3 > MOST_MILLISECONDS {
                flag.store(true, Ordering::Relaxed);
            }
        })
    }
}
