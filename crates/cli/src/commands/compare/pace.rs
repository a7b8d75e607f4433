//! What would take too long is refused as soon as that is seen; what nobody waits for any more ends.

use crate::failure::{Failure, Typed};
use signal_hook::consts::SIGINT;
use std::time::Instant;
use stickslip_tip::stop;

/// Seconds after which the rest is extrapolated from what was done, and no repetition is made.
pub(super) const PATIENCE: f64 = 0.5;
/// The shortest of so many repetitions is the time of either side: a run may be as short as a millisecond.
const REPETITIONS: usize = 5;

/// What is done, and the seconds that it takes: `once` gives both.
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

/// A host has asked the work to end. (In a shell a signal ends the program at once.)
pub(super) fn stopped() -> Option<Failure> {
    stop::is_asked().then_some(Failure::Stopped(SIGINT as u8))
}

/// The time that one side takes, against the limit.
pub(super) struct Pace {
    option: &'static str,
    start: f64,
    end: f64,
    limit: f64,
    clock: Instant,
}

impl Pace {
    /// Over a span of time, whose end `option` sets, in at most `limit` seconds.
    pub(super) fn new(option: &'static str, (start, end): (f64, f64), limit: f64) -> Self {
        Self { option, start, end, limit, clock: Instant::now() }
    }

    /// So far.
    pub(super) fn seconds(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// A refusal, where the rest at the pace until time t goes beyond the limit, or nobody waits for it.
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
                "this would take about {needed:.0} s: {} {} will do within the limit, or a wider \
                 --spacing of the grid, or a higher limit",
                self.option,
                Typed(affordable)
            ),
        ))
    }
}
