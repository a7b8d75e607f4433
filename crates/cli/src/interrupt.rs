//! Handling of SIGINT and SIGTERM.
//!
//! A command initially has nothing to save: a thread that waits for signals [ends it immediately](end_at_once). A
//! command that saves partial results [listens](Interrupt::listen): the first signal is stored and ends the command
//! at its next step, a second one ends the program immediately. If all partial results are in a file already, the
//! command need not reach its next step; it registers [its error message](Interrupt::or_else) instead. The same rules
//! apply if the program was started with SIGINT ignored, like a background job. With a
//! [host](crate::session::Host) the program does not handle signals.

use crate::failure::Failure;
use crate::files::temporary::remove_unfinished;
use crate::message::say;
use crate::session::{Session, locked};
use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread;
use std::time::Duration;

/// State shared by the waiting thread and the commands.
#[derive(Default)]
struct State {
    signal: AtomicU8,
    received: Arc<AtomicBool>,
    /// Number of active listeners.
    keepers: AtomicUsize,
    farewell: Mutex<Option<Farewell>>,
}

/// The error, as a function of the signal, with which the program ends a command that need not reach its next step.
type Farewell = Box<dyn Fn(u8) -> Failure + Send>;

/// Time for a command to end itself.
const PATIENCE: Duration = Duration::from_millis(120);

fn state() -> &'static State {
    static STATE: OnceLock<State> = OnceLock::new();
    STATE.get_or_init(State::default)
}

/// Makes the first signal end the program, from now on. Beyond the limit on the size of files, `ulimit -f`, a write
/// fails as on a full disk, instead of ending the program by SIGXFSZ.
pub(crate) fn end_at_once() -> io::Result<()> {
    static WAITS: AtomicBool = AtomicBool::new(false);
    if WAITS.swap(true, Ordering::SeqCst) {
        return Ok(());
    }
    let mut signals = Signals::new([SIGINT, SIGTERM, SIGXFSZ])?;
    let wait = move || {
        for signal in signals.forever().filter(|signal| *signal != SIGXFSZ) {
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

/// The error with which to end a command that is still working after a while; `None` while it saves partial results.
fn after_a_while(signal: u8) -> Option<Failure> {
    thread::sleep(PATIENCE);
    if state().keepers.load(Ordering::SeqCst) == 0 {
        return Some(Failure::Stopped(signal));
    }
    let farewell = locked(&state().farewell);
    let failure = farewell.as_ref().map(|tell| tell(signal));
    if failure.is_none() {
        say(format_args!(
            "stickslip: interrupted: saving the part computed so far; a second signal ends the program immediately"
        ));
    }
    failure
}

/// A listener for signals, or for cancellation by a host, while there are partial results.
pub(crate) struct Interrupt {
    session: Session,
}

/// The signal received, if any; of a host, which has cancelled the work, that of Ctrl-C.
pub(crate) fn signal(session: &Session) -> Option<u8> {
    match session.host() {
        Some(host) => host.stop().load(Ordering::Relaxed).then_some(SIGINT as u8),
        None => Some(state().signal.load(Ordering::Relaxed)).filter(|signal| *signal > 0),
    }
}

impl Interrupt {
    /// Starts listening.
    pub(crate) fn listen(session: &Session) -> Result<Self, Failure> {
        let interrupt = Self { session: session.clone() };
        if session.has_host() {
            return Ok(interrupt);
        }
        state().keepers.fetch_add(1, Ordering::SeqCst);
        let listening = end_at_once();
        listening.map_err(|error| Failure::Run(format!("cannot listen for signals: {error}")))?;
        Ok(interrupt)
    }

    /// Registers the error for a command whose partial results are always in a file: the program ends soon after a
    /// signal, with this error.
    pub(crate) fn or_else(&self, tell: impl Fn(u8) -> Failure + Send + 'static) {
        if !self.session.has_host() {
            *locked(&state().farewell) = Some(Box::new(tell));
        }
    }

    /// The signal received, if any.
    pub(crate) fn signal(&self) -> Option<u8> {
        signal(&self.session)
    }

    /// Flag set by the first signal; the work checks it.
    pub(crate) fn flag(&self) -> &Arc<AtomicBool> {
        match self.session.host() {
            Some(host) => host.stop(),
            None => &state().received,
        }
    }
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        if self.session.has_host() {
            return;
        }
        *locked(&state().farewell) = None;
        state().keepers.fetch_sub(1, Ordering::SeqCst);
    }
}
