//! SIGINT and SIGTERM.
//!
//! Every command begins as one that has nothing to keep, and ends [at once](end_at_once), by a thread that waits for
//! signals and for nothing else. One that keeps what it has [listens](Interrupt::listen): the first signal is remembered, for it
//! to end at its next step, and the second one ends the program at once. Where all that it keeps is in a file
//! already, it need not come to its next step: it says [what is told then](Interrupt::or_else). All this holds too
//! where the program was started with SIGINT ignored, as a job in the background is. Within a [host](crate::host) the
//! signals are not ours.

use crate::failure::Failure;
use crate::files::temporary::remove_unfinished;
use crate::host::{self, Host};
use crate::message::say;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

/// What the waiting thread and the commands share.
#[derive(Default)]
struct State {
    signal: AtomicU8,
    received: Arc<AtomicBool>,
    /// So many keep what there is.
    keepers: AtomicUsize,
    farewell: Mutex<Option<Farewell>>,
}

/// What is told of a signal by a command that need not end by itself.
type Farewell = Box<dyn Fn(u8) -> Failure + Send>;

/// Time for a command to end by itself.
const PATIENCE: Duration = Duration::from_millis(120);

fn state() -> &'static State {
    static STATE: OnceLock<State> = OnceLock::new();
    STATE.get_or_init(State::default)
}

/// From here on the first signal ends the program.
pub(crate) fn end_at_once() -> io::Result<()> {
    static WAITS: AtomicBool = AtomicBool::new(false);
    if WAITS.swap(true, Ordering::SeqCst) {
        return Ok(());
    }
    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    let wait = move || {
        for signal in signals.forever() {
            let number = u8::try_from(signal).unwrap_or_default();
            let is_first = !state().received.swap(true, Ordering::SeqCst);
            state().signal.store(number, Ordering::SeqCst);
            let failure = match is_first && state().keepers.load(Ordering::SeqCst) > 0 {
                true => after_a_while(number),
                false => Some(Failure::Stopped(number)),
            };
            if let Some(failure) = failure {
                say(format_args!("stickslip: {failure}"));
                remove_unfinished();
                std::process::exit(128 + signal);
            }
        }
    };
    thread::Builder::new().name("signals".into()).spawn(wait).map(drop)
}

/// What is told of a command that has not ended by itself, and need not. One that finishes what it keeps says so.
fn after_a_while(signal: u8) -> Option<Failure> {
    thread::sleep(PATIENCE);
    if state().keepers.load(Ordering::SeqCst) == 0 {
        return Some(Failure::Stopped(signal));
    }
    let farewell = state().farewell.lock().unwrap_or_else(PoisonError::into_inner);
    let failure = farewell.as_ref().map(|tell| tell(signal));
    if failure.is_none() {
        say(format_args!(
            "stickslip: interrupted: what was computed until now is being finished; a second signal ends that too"
        ));
    }
    failure
}

/// The signals, for as long as there is something to keep; of a host the wish that the work stops.
pub(crate) struct Interrupt {
    host: Option<Arc<Host>>,
    /// Whether there is something to keep.
    keeps: bool,
}

impl Interrupt {
    /// Starts listening.
    ///
    /// # Errors
    /// The system does not let it.
    pub(crate) fn listen() -> Result<Self, Failure> {
        if let Some(host) = host::current() {
            return Ok(Self { host: Some(host), keeps: true });
        }
        state().keepers.fetch_add(1, Ordering::SeqCst);
        let listening = end_at_once();
        listening.map_err(|error| Failure::Run(format!("cannot listen for signals: {error}")))?;
        Ok(Self { host: None, keeps: true })
    }

    /// For work that keeps nothing: a signal ends the program at once, and a host the work.
    pub(crate) fn of_host() -> Self {
        Self { host: host::current(), keeps: false }
    }

    /// All that is kept is in a file at any time: the program ends soon after a signal, and tells this.
    pub(crate) fn or_else(&self, tell: impl Fn(u8) -> Failure + Send + 'static) {
        if self.host.is_none() {
            *state().farewell.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(tell));
        }
    }

    /// The signal received.
    pub(crate) fn signal(&self) -> Option<u8> {
        match &self.host {
            Some(host) => host.stop().load(Ordering::Relaxed).then_some(SIGINT as u8),
            None => Some(state().signal.load(Ordering::Relaxed)).filter(|signal| *signal > 0),
        }
    }

    /// Raised by the first signal: for work to look at.
    pub(crate) fn flag(&self) -> &Arc<AtomicBool> {
        match &self.host {
            Some(host) => host.stop(),
            None => &state().received,
        }
    }
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        if self.host.is_some() || !self.keeps {
            return;
        }
        *state().farewell.lock().unwrap_or_else(PoisonError::into_inner) = None;
        state().keepers.fetch_sub(1, Ordering::SeqCst);
    }
}
