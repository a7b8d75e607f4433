//! Progress of long work, on standard error when it is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::{Duration, Instant};

/// Shown after the first second.
const PATIENCE: Duration = Duration::from_secs(1);
/// Of work whose parts take no longer than a look at the clock.
const CALLS_PER_LOOK: u32 = 256;

/// A bar from `from` to `to`, in the unit of the work.
pub(crate) struct Progress {
    from: f64,
    to: f64,
    started: Instant,
    calls: u32,
    /// Calls between two looks at the clock.
    calls_per_look: u32,
    bar: Option<ProgressBar>,
}

const TICKS: f64 = 1000.0;

impl Progress {
    pub(crate) fn new(from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            started: Instant::now(),
            calls: 0,
            calls_per_look: CALLS_PER_LOOK,
            bar: None,
        }
    }

    /// For work whose parts take longer than a look at the clock.
    pub(crate) fn at_every_call(mut self) -> Self {
        self.calls_per_look = 1;
        self
    }

    /// The work has come to `at`.
    pub(crate) fn reached(&mut self, at: f64) {
        self.calls = self.calls.wrapping_add(1);
        if !self.calls.is_multiple_of(self.calls_per_look) || self.started.elapsed() < PATIENCE {
            return;
        }
        let done = ((at - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        self.bar.get_or_insert_with(new_bar).set_position((done * TICKS) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// indicatif draws on standard error, and nothing where that is no terminal.
fn new_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} %  {eta} left");
    let bar = ProgressBar::new(TICKS as u64);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
