//! The surroundings of a command: files from memory, destinations of result, messages and progress, and cancellation.
//!
//! The program makes a session for its terminal: results go to files, messages to standard error, and signals stop it.
//! A host, such as a Python interpreter, makes one for each call.

use crate::failure::Failure;
use crate::message::{self, harmless, short};
use std::any::Any;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use stickslip_saved::Document;

/// The surroundings of a command. Copies share one host.
#[derive(Debug, Clone, Default)]
pub(crate) struct Session {
    host: Option<Arc<Host>>,
    is_quiet: bool,
    typed: Arc<[TypedQuantity]>,
}

/// An option whose value was typed as a quantity with a unit.
#[derive(Debug)]
pub(crate) struct TypedQuantity {
    /// The option with a number of the model.
    pub(crate) number: String,
    /// The option as typed.
    pub(crate) typed: String,
    /// The quantity and the number, with its unit.
    pub(crate) meant: String,
}

/// The result of a command.
pub struct Made {
    /// The document.
    pub document: Box<dyn Document>,
    /// The main result, in one line.
    pub headline: String,
    /// The summary as aligned lines.
    pub text: String,
}

/// State shared by a host and its current command.
#[derive(Default)]
pub struct Host {
    stop: Arc<AtomicBool>,
    supplies: BTreeMap<PathBuf, Supply>,
    made: Mutex<Option<Made>>,
    said: Mutex<Vec<String>>,
    pace: Mutex<Option<Pace>>,
}

/// A file in memory.
pub enum Supply {
    /// The text of the file.
    Text(String),
    /// The content of a file that is no text.
    Bytes(Vec<u8>),
    /// The columns of a table, with their headings; NaN where a value is missing.
    Columns(Vec<(String, Vec<f64>)>),
    /// The document in the file.
    Document(Arc<dyn Document>),
}

/// Progress of the work.
#[derive(Debug, Clone, PartialEq)]
pub struct Pace {
    /// Fraction done, from 0 to 1, if the total is known.
    pub part: Option<f64>,
    /// Count, such as `12 of 60 points`.
    pub counted: String,
}

impl Session {
    /// The session of a terminal; a quiet one prints only errors.
    pub(crate) fn of_terminal(is_quiet: bool) -> Self {
        Self { is_quiet, ..Self::default() }
    }

    /// The session of a call by a host.
    pub(crate) fn of(host: &Arc<Host>) -> Self {
        Self { host: Some(Arc::clone(host)), ..Self::default() }
    }

    /// The session of a command line with these quantities, which messages name as they were typed.
    pub(crate) fn with_quantities(self, typed: Vec<TypedQuantity>) -> Self {
        Self { typed: typed.into(), ..self }
    }

    /// The host, if there is one.
    pub(crate) fn host(&self) -> Option<&Host> {
        self.host.as_deref()
    }

    /// Whether the command is called by a host.
    pub(crate) fn has_host(&self) -> bool {
        self.host.is_some()
    }

    /// Whether only errors are printed; progress is hidden too.
    pub(crate) fn is_quiet(&self) -> bool {
        self.is_quiet
    }

    /// Flag by which the host cancels the work; without a host nothing sets it.
    pub(crate) fn stop(&self) -> Arc<AtomicBool> {
        self.host().map(|host| Arc::clone(host.stop())).unwrap_or_default()
    }

    /// Passes a result to the host, if there is one.
    pub(crate) fn give(&self, made: impl FnOnce() -> Made) {
        if let Some(host) = self.host() {
            *locked(&host.made) = Some(made());
        }
    }

    /// Prints a line, or passes it to the host.
    pub(crate) fn say(&self, line: impl Display) {
        match self.host() {
            Some(host) => locked(&host.said).push(harmless(&short(&line.to_string())).into_owned()),
            None => message::say(line),
        }
    }

    /// Prints a line that is not an error: a result or a warning.
    pub(crate) fn remark(&self, line: impl Display) {
        if self.is_quiet {
            return;
        }
        let line = line.to_string();
        let is_named = |of: &&TypedQuantity| line.contains(&format!("{} ", of.number));
        match self.typed.iter().find(is_named) {
            Some(TypedQuantity { number, typed, meant }) => {
                self.say(format_args!("{} ({meant})", line.replace(&**number, typed)));
            }
            None => self.say(line),
        }
    }

    /// The failure with a rejected quantity as it was typed.
    pub(crate) fn restored(&self, failure: Failure) -> Failure {
        let Failure::Input { option, message } = &failure else { return failure };
        match self.typed.iter().find(|of| of.number == *option) {
            // The numbers of the message are those of the model.
            Some(of) => Failure::input(&*of.typed, format!("{message} ({})", of.meant)),
            None => failure,
        }
    }

    /// The document of this kind that the host supplies under a name.
    pub(crate) fn document<D: Any + Clone>(&self, path: &Path) -> Option<D> {
        match self.host()?.supplies.get(path)? {
            Supply::Document(document) => (&**document as &dyn Any).downcast_ref::<D>().cloned(),
            Supply::Text(_) | Supply::Bytes(_) | Supply::Columns(_) => None,
        }
    }

    /// The columns that the host supplies under a name.
    pub(crate) fn columns(&self, path: &Path) -> Option<&[(String, Vec<f64>)]> {
        match self.host()?.supplies.get(path)? {
            Supply::Columns(columns) => Some(columns),
            Supply::Text(_) | Supply::Bytes(_) | Supply::Document(_) => None,
        }
    }

    /// Whether the host supplies a file under a name.
    pub(crate) fn supplies(&self, path: &Path) -> bool {
        self.host().is_some_and(|host| host.supplies.contains_key(path))
    }

    /// The content of the file that the host supplies under a name.
    pub(crate) fn bytes(&self, path: &Path) -> Option<Vec<u8>> {
        match self.host()?.supplies.get(path)? {
            Supply::Text(text) => Some(text.clone().into_bytes()),
            Supply::Bytes(bytes) => Some(bytes.clone()),
            Supply::Columns(columns) => serde_json::to_vec(columns).ok(),
            Supply::Document(document) => serde_json::to_vec(document.serialized()).ok(),
        }
    }
}

impl Host {
    /// A host that supplies these files.
    pub fn new(supplies: impl IntoIterator<Item = (PathBuf, Supply)>) -> Self {
        Self { supplies: supplies.into_iter().collect(), ..Self::default() }
    }

    /// Flag that cancels the command when set.
    pub fn stop(&self) -> &Arc<AtomicBool> {
        &self.stop
    }

    /// The result of the command; later calls return `None`.
    pub fn take(&self) -> Option<Made> {
        locked(&self.made).take()
    }

    /// Messages since the last call, line by line.
    pub fn heard(&self) -> Vec<String> {
        std::mem::take(&mut locked(&self.said))
    }

    /// Progress, if it has changed since the last call.
    pub fn pace(&self) -> Option<Pace> {
        locked(&self.pace).take()
    }

    pub(crate) fn show(&self, pace: Pace) {
        *locked(&self.pace) = Some(pace);
    }
}

impl std::fmt::Debug for Host {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Host").field("supplies", &self.supplies.keys()).finish_non_exhaustive()
    }
}

/// The value of a mutex, whether or not a thread has panicked with it.
pub(crate) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
