//! Limits on what the page computes.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip::Context;

/// Time to which a page runs: the history of a fast motion takes some 100 MB then.
pub(crate) const MOST_TIME: f64 = 20_000.0;
/// Lines that a page has the patience for.
pub(crate) const MOST_LINES: usize = 400;
/// Milliseconds that a run may take: then it is cut off, and says so.
const MOST_MILLISECONDS: f64 = 4_000.0;

/// A clock in milliseconds, and the time at which it was started.
#[derive(Clone, Copy)]
pub(crate) struct Patience {
    now: fn() -> f64,
    began: f64,
}

impl Patience {
    pub(crate) fn from(now: fn() -> f64) -> Self {
        Self { now, began: now() }
    }

    pub(crate) fn seconds(self) -> f64 {
        ((self.now)() - self.began) / 1e3
    }

    /// A context that cuts a run off when the patience ends.
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
