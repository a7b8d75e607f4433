//! Activity indicator on a terminal: the elapsed time, while a command shows no progress of its own.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Delay before the indicator is shown.
pub(crate) const PATIENCE: Duration = Duration::from_secs(1);
const TURN: Duration = Duration::from_millis(200);

enum Sign {
    /// Not shown yet.
    Waiting,
    Shown(ProgressBar),
    /// Hidden: something else is shown, or the work is over.
    Over,
}

static SIGN: Mutex<Sign> = Mutex::new(Sign::Waiting);

fn sign() -> MutexGuard<'static, Sign> {
    SIGN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts the indicator.
pub(crate) fn begin() {
    if !stderr().is_terminal() {
        return;
    }
    let started = Instant::now();
    let show = move || {
        thread::sleep(PATIENCE);
        let mut sign = sign();
        if matches!(*sign, Sign::Waiting) {
            let style = ProgressStyle::with_template("{spinner} at work  {elapsed}");
            let bar = ProgressBar::new_spinner().with_elapsed(started.elapsed());
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            bar.enable_steady_tick(TURN);
            *sign = Sign::Shown(bar);
        }
    };
    // Without it there is less to be seen, and nothing else is lost.
    thread::Builder::new().name("sign of life".into()).spawn(show).map(drop).ok();
}

/// Hides the indicator, at the end of the work or before other output.
pub(crate) fn end() {
    if let Sign::Shown(bar) = std::mem::replace(&mut *sign(), Sign::Over) {
        bar.finish_and_clear();
    }
}

/// Prints a permanent line without disturbing the indicator.
pub(crate) fn aside<T>(say: impl FnOnce() -> T) -> T {
    match &*sign() {
        Sign::Shown(bar) => bar.suspend(say),
        Sign::Waiting | Sign::Over => say(),
    }
}
