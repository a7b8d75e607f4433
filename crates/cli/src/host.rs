//! In-process use of the program by a host, such as a Python interpreter: the host receives results and messages,
//! observes progress, may cancel the work, and supplies files from memory.
//!
//! A thread without a host behaves as the program: results go to files, messages to standard error, and signals stop
//! it.

use crate::made::{Document, Made};
use std::any::Any;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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

thread_local! {
    static HOST: RefCell<Option<Arc<Host>>> = const { RefCell::new(None) };
}

/// The host of this thread.
pub(crate) fn current() -> Option<Arc<Host>> {
    HOST.with_borrow(Clone::clone)
}

/// Whether this thread has a host.
pub(crate) fn is_there() -> bool {
    HOST.with_borrow(Option::is_some)
}

/// Sets or removes the host of this thread.
pub(crate) fn set(host: Option<Arc<Host>>) {
    HOST.set(host);
}

/// Passes a result to the host, if there is one.
pub(crate) fn give(made: impl FnOnce() -> Made) {
    if let Some(host) = current() {
        *locked(&host.made) = Some(made());
    }
}

/// The document of this kind that the host supplies under a name.
pub(crate) fn document<D: Any + Clone>(path: &Path) -> Option<D> {
    match current()?.supplies.get(path)? {
        Supply::Document(document) => document.any().downcast_ref::<D>().cloned(),
        Supply::Text(_) | Supply::Bytes(_) => None,
    }
}

/// The content of the file that the host supplies under a name.
pub(crate) fn bytes(path: &Path) -> Option<Vec<u8>> {
    match current()?.supplies.get(path)? {
        Supply::Text(text) => Some(text.clone().into_bytes()),
        Supply::Bytes(bytes) => Some(bytes.clone()),
        Supply::Document(document) => serde_json::to_vec(document.serialized()).ok(),
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

    pub(crate) fn hear(&self, line: String) {
        locked(&self.said).push(line);
    }

    pub(crate) fn show(&self, pace: Pace) {
        *locked(&self.pace) = Some(pace);
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
