//! From a command to its question and back: who watches and who cancels, and refusals in the words of a command line.

use super::progress::Progress;
use crate::failure::Failure;
use crate::host;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;
use stickslip::{self as documents, Context, Refused};

/// Progress goes to the terminal or to the host, which may cancel.
pub(crate) fn context() -> Context {
    let cancel = host::current().map(|host| Arc::clone(host.stop())).unwrap_or_default();
    let progress = Mutex::new(Progress::new(0.0, 1.0).at_every_call());
    Context::cancelled_by(cancel).timed_by(seconds).watched_by(move |part, counted| {
        progress.lock().unwrap_or_else(PoisonError::into_inner).counted(part, || counted);
    })
}

/// Seconds since the first call.
fn seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// A parameter as an option: `--alpha-above` for `alpha_above`.
pub(crate) fn option(parameter: &str) -> String {
    format!("--{}", parameter.replace('_', "-"))
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::input(refused.named(option), refused.reason(option))
    }
}

impl From<documents::Failure> for Failure {
    fn from(failure: documents::Failure) -> Self {
        match failure {
            documents::Failure::Refused(refused) => refused.into(),
            documents::Failure::Cancelled => Self::Stopped(signal_hook::consts::SIGINT as u8),
            other => Self::Run(other.described(option)),
        }
    }
}
