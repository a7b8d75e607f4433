//! Progress of long work, on standard error if it is a terminal, or to a host: the fraction done, a count, the
//! elapsed time, and the remaining time if it can be estimated.

use crate::session::{Pace, Session};
use crate::sign_of_life::{self, PATIENCE};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::time::Instant;

/// Calls between two readings of the clock, for work whose parts are shorter than a reading.
const CALLS_PER_LOOK: u32 = 256;
const TICKS: f64 = 1000.0;

/// Progress from `from` to `to`, in the unit of the work, or without a known end.
pub(crate) struct Progress {
    span: Option<(f64, f64)>,
    started: Instant,
    calls: u32,
    /// Calls between two readings of the clock.
    calls_per_look: u32,
    bar: Option<ProgressBar>,
    /// Where it is shown.
    session: Session,
}

impl Progress {
    /// Progress of work that advances from `from` to `to` at an even pace.
    pub(crate) fn new(session: &Session, from: f64, to: f64) -> Self {
        Self {
            span: Some((from, to)),
            started: Instant::now(),
            calls: 0,
            calls_per_look: CALLS_PER_LOOK,
            bar: None,
            session: session.clone(),
        }
    }

    /// Progress of work of unknown length.
    pub(crate) fn without_end(session: &Session) -> Self {
        let mut progress = Self::new(session, 0.0, 1.0);
        progress.span = None;
        progress
    }

    /// Reads the clock at every call, for work whose parts take longer than a reading.
    pub(crate) fn at_every_call(mut self) -> Self {
        self.calls_per_look = 1;
        self
    }

    /// Reports that the work has reached `at`.
    pub(crate) fn reached(&mut self, at: f64) {
        self.counted(at, String::new);
    }

    /// The same with a count in words, such as `12 of 60 points`.
    pub(crate) fn counted<D: Display>(&mut self, at: f64, what: impl FnOnce() -> D) {
        self.calls = self.calls.wrapping_add(1);
        let is_due = self.calls.is_multiple_of(self.calls_per_look);
        if !is_due {
            return;
        }
        let (span, started) = (self.span, self.started);
        if let Some(host) = self.session.host() {
            let part = span.map(|(from, to)| ((at - from) / (to - from)).clamp(0.0, 1.0));
            return host.show(Pace { part, counted: what().to_string() });
        }
        if started.elapsed() < PATIENCE || self.session.is_quiet() {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| new_bar(span.is_some(), started));
        if let Some((from, to)) = span {
            let done = ((at - from) / (to - from)).clamp(0.0, 1.0);
            bar.set_position((done * TICKS) as u64);
        } else {
            bar.tick();
        }
        bar.set_message(what().to_string());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A progress bar on standard error; indicatif draws nothing if that is not a terminal.
fn new_bar(has_end: bool, started: Instant) -> ProgressBar {
    sign_of_life::end();
    let template = if has_end {
        "{wide_bar} {percent:>3} %  {msg}  {elapsed}, {eta} left"
    } else {
        "{spinner} {msg}  {elapsed}"
    };
    let style = ProgressStyle::with_template(template);
    let bar = if has_end { ProgressBar::new(TICKS as u64) } else { ProgressBar::new_spinner() };
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_elapsed(started.elapsed())
}
