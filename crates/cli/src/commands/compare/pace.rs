//! Time limits: work that is predicted to take too long is rejected early, and cancelled work ends.

use crate::commands::progress::Progress;
use crate::failure::{Failure, Typed};
use crate::session::Session;
use signal_hook::consts::SIGINT;
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip_tip::stop;

/// Time in seconds after which the total is extrapolated, and no repetition is made.
const PATIENCE: f64 = 0.5;
/// Number of repetitions of each side, of which the shortest time counts, because a run may take only a millisecond.
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
pub(super) fn stopped() -> Result<(), Failure> {
    if stop::is_requested() { Err(Failure::Stopped(SIGINT as u8)) } else { Ok(()) }
}

/// The quantity in which work proceeds.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {
    /// Time, whose end this option sets.
    Time(&'static str),
    /// Lines of a raster.
    Lines,
}

/// The pace of one side, and its limit.
pub(super) struct Pace {
    unit: Unit,
    start: f64,
    end: f64,
    limit: f64,
    clock: Instant,
}

impl Pace {
    /// The limit for work from `start` to `end`: at most `limit` seconds.
    pub(super) fn new(unit: Unit, (start, end): (f64, f64), limit: f64) -> Self {
        Self { unit, start, end, limit, clock: Instant::now() }
    }

    /// Seconds so far.
    pub(super) fn seconds(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// Rejects work whose pace so far predicts a time beyond the limit, or that is cancelled.
    pub(super) fn judge(&self, at: f64) -> Result<(), Failure> {
        stopped()?;
        let (seconds, done) = (self.seconds(), at - self.start);
        let needed = seconds * (self.end - self.start) / done;
        // The time of a line is unknown before the first one is done.
        let is_known = matches!(self.unit, Unit::Time(_)) || done >= 1.0;
        let is_predicted = is_known && seconds >= PATIENCE.min(self.limit) && needed > self.limit;
        if !is_predicted && seconds <= self.limit {
            return Ok(());
        }
        let affordable = self.start + 0.5 * self.limit * done / seconds;
        let remedy = match self.unit {
            Unit::Time(option) => {
                format!(
                    "{option} {} fits the limit, or a wider --spacing of the grid",
                    Typed(affordable)
                )
            }
            Unit::Lines => format!("take about {} lines", affordable.floor().max(1.0)),
        };
        let message = format!("this would take about {needed:.0} s: {remedy}, or a higher limit");
        Err(Failure::number("--time-limit", self.limit, message))
    }
}

/// Observer of work that shows its progress, and ends it if it would take too long.
pub(super) struct Watch {
    progress: Progress,
    pace: Pace,
    calls: u32,
    /// Calls between two readings of the clock.
    calls_per_look: u32,
    judged: Result<(), Failure>,
}

impl Watch {
    /// An observer that reads the clock at every call.
    pub(super) fn new(session: &Session, unit: Unit, span: (f64, f64), limit: f64) -> Self {
        let progress = Progress::new(session, span.0, span.1).at_every_call();
        let pace = Pace::new(unit, span, limit);
        Self { progress, pace, calls: 0, calls_per_look: 1, judged: Ok(()) }
    }

    /// Reads the clock at some calls only, for work whose steps take microseconds.
    pub(super) fn of_short_steps(self) -> Self {
        Self { calls_per_look: 256, ..self }
    }

    /// Reports how far the work is, and whether it may go on.
    pub(super) fn reached(&mut self, at: f64) -> ControlFlow<()> {
        self.calls = self.calls.wrapping_add(1);
        self.judged = if self.calls.is_multiple_of(self.calls_per_look) {
            let Pace { unit, end, .. } = self.pace;
            self.progress.counted(at, || match unit {
                Unit::Time(_) => String::new(),
                Unit::Lines => format!("grid: {} of {end} lines", at.floor()),
            });
            self.pace.judge(at)
        } else {
            stopped()
        };
        if self.judged.is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The result of the work with its time in seconds, unless the work was ended.
    pub(super) fn ended<T>(self, done: Result<T, Failure>) -> Result<(T, f64), Failure> {
        let seconds = self.pace.seconds();
        self.judged.and_then(|()| stopped())?;
        Ok((done?, seconds))
    }
}
