//! Progress of long work, on standard error when it is a terminal: how far it is, what is counted, how long it has
//! taken, and how much longer it takes where that can be told; or to a host.

use crate::host::{self, Host, Pace};
use crate::message::is_quiet;
use crate::sign_of_life::{self, PATIENCE};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::sync::Arc;
use std::time::Instant;

/// Of work whose parts take no longer than a look at the clock.
const CALLS_PER_LOOK: u32 = 256;
const TICKS: f64 = 1000.0;

/// Work from `from` to `to`, in its own unit, or of a length that nobody knows.
pub(crate) struct Progress {
    span: Option<(f64, f64)>,
    started: Instant,
    calls: u32,
    /// Calls between two looks at the clock.
    calls_per_look: u32,
    bar: Option<ProgressBar>,
    /// Sees it in place of a person.
    host: Option<Arc<Host>>,
}

impl Progress {
    /// Work that comes from `from` to `to` at an even pace.
    pub(crate) fn new(from: f64, to: f64) -> Self {
        Self {
            span: Some((from, to)),
            started: Instant::now(),
            calls: 0,
            calls_per_look: CALLS_PER_LOOK,
            bar: None,
            host: host::current(),
        }
    }

    /// Work of which nobody knows how much there is.
    pub(crate) fn without_end() -> Self {
        let mut progress = Self::new(0.0, 1.0);
        progress.span = None;
        progress
    }

    /// For work whose parts take longer than a look at the clock.
    pub(crate) fn at_every_call(mut self) -> Self {
        self.calls_per_look = 1;
        self
    }

    /// The work has come to `at`.
    pub(crate) fn reached(&mut self, at: f64) {
        self.counted(at, String::new);
    }

    /// The same, with what is counted in words, such as `12 of 60 points`.
    pub(crate) fn counted<D: Display>(&mut self, at: f64, what: impl FnOnce() -> D) {
        self.calls = self.calls.wrapping_add(1);
        let is_due = self.calls.is_multiple_of(self.calls_per_look);
        if !is_due {
            return;
        }
        let (span, started) = (self.span, self.started);
        if let Some(host) = &self.host {
            let part = span.map(|(from, to)| ((at - from) / (to - from)).clamp(0.0, 1.0));
            return host.show(Pace { part, counted: what().to_string() });
        }
        if started.elapsed() < PATIENCE || is_quiet() {
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

/// indicatif draws on standard error, and nothing where that is no terminal.
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
