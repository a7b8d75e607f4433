//! Time limits: work that is predicted to take too long is rejected early, and cancelled work ends.

use crate::failure::{Failure, Typed};
use signal_hook::consts::SIGINT;
use std::time::Instant;
use stickslip_tip::stop;

/// Time in seconds after which the total is extrapolated, and no repetition is made.
pub(super) const PATIENCE: f64 = 0.5;
/// Number of repetitions; the time of either side is the shortest, because a run may take only a millisecond.
const REPETITIONS: usize = 5;

/// A result with its time in seconds, the shortest of several calls of `once`.
pub(super) fn timed<T>(once: impl Fn() -> Result<(T, f64), Failure>) -> Result<(T, f64), Failure> {
    let (done, mut shortest) = once()?;
    let mut spent = shortest;
    for _ in 1..REPETITIONS {
        if spent < PATIENCE {
            let (_, again) = once()?;
            spent += again;
            shortest = shortest.min(again);
        }
    }
    Ok((done, shortest))
}

/// The error if a host has cancelled the work. (In a shell a signal ends the program.)
pub(super) fn stopped() -> Option<Failure> {
    stop::is_asked().then_some(Failure::Stopped(SIGINT as u8))
}

/// The time of one side, compared with the limit.
pub(super) struct Pace {
    option: &'static str,
    start: f64,
    end: f64,
    limit: f64,
    clock: Instant,
}

impl Pace {
    /// The limit for a span of time, whose end `option` sets: at most `limit` seconds.
    pub(super) fn new(option: &'static str, (start, end): (f64, f64), limit: f64) -> Self {
        Self { option, start, end, limit, clock: Instant::now() }
    }

    /// Seconds so far.
    pub(super) fn seconds(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// An error if the pace up to time t predicts a time beyond the limit, or if the work is cancelled.
    pub(super) fn too_slow(&self, t: f64) -> Option<Failure> {
        if let Some(failure) = stopped() {
            return Some(failure);
        }
        let (seconds, done) = (self.seconds(), t - self.start);
        let needed = seconds * (self.end - self.start) / done;
        if seconds < PATIENCE.min(self.limit) || needed <= self.limit {
            return None;
        }
        let affordable = self.start + 0.5 * self.limit * done / seconds;
        Some(Failure::input(
            format!("--time-limit {}", Typed(self.limit)),
            format!(
                "this would take about {needed:.0} s: {} {} fits the limit, or a wider \
                 --spacing of the grid, or a higher limit",
                self.option,
                Typed(affordable)
            ),
        ))
    }
}
