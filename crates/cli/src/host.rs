//! The program inside another, a Python interpreter say: that one takes what is made, hears what is said, sees how far the
//! work has come, may stop it, and supplies files from its memory.
//!
//! A thread that was lent no host is a program of its own: results go to files, words to standard error, and
//! signals stop it.

use crate::made::{Document, Made};
use std::any::Any;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What a host shares with the one command that it has asked for.
#[derive(Default)]
pub struct Host {
    stop: Arc<AtomicBool>,
    supplies: BTreeMap<PathBuf, Supply>,
    made: Mutex<Option<Made>>,
    said: Mutex<Vec<String>>,
    pace: Mutex<Option<Pace>>,
}

/// A file that is none.
pub enum Supply {
    /// Its text.
    Text(String),
    /// The document that it would hold.
    Document(Arc<dyn Document>),
}

/// How far the work has come.
#[derive(Debug, Clone, PartialEq)]
pub struct Pace {
    /// From 0 to 1, where the end is known.
    pub part: Option<f64>,
    /// Such as `12 of 60 points`.
    pub counted: String,
}

thread_local! {
    static HOST: RefCell<Option<Arc<Host>>> = const { RefCell::new(None) };
}

/// The host of this thread.
pub(crate) fn current() -> Option<Arc<Host>> {
    HOST.with_borrow(Clone::clone)
}

/// Whether there is one.
pub(crate) fn is_there() -> bool {
    HOST.with_borrow(Option::is_some)
}

/// From here on this thread works for a host, or for none.
pub(crate) fn set(host: Option<Arc<Host>>) {
    HOST.set(host);
}

/// Hands over what was made, where there is somebody to take it.
pub(crate) fn give(made: impl FnOnce() -> Made) {
    if let Some(host) = current() {
        *locked(&host.made) = Some(made());
    }
}

/// The document of this kind that the host supplies under a name.
pub(crate) fn document<D: Any + Clone>(path: &Path) -> Option<D> {
    match current()?.supplies.get(path)? {
        Supply::Document(document) => document.any().downcast_ref::<D>().cloned(),
        Supply::Text(_) => None,
    }
}

/// What a file would hold that the host supplies under a name.
pub(crate) fn bytes(path: &Path) -> Option<Vec<u8>> {
    match current()?.supplies.get(path)? {
        Supply::Text(text) => Some(text.clone().into_bytes()),
        Supply::Document(document) => serde_json::to_vec(document.serialized()).ok(),
    }
}

impl Host {
    /// A host that supplies these files.
    pub fn new(supplies: impl IntoIterator<Item = (PathBuf, Supply)>) -> Self {
        Self { supplies: supplies.into_iter().collect(), ..Self::default() }
    }

    /// Raised to stop the command.
    pub fn stop(&self) -> &Arc<AtomicBool> {
        &self.stop
    }

    /// What was made, once.
    pub fn take(&self) -> Option<Made> {
        locked(&self.made).take()
    }

    /// What was said since this was last asked, line by line.
    pub fn heard(&self) -> Vec<String> {
        std::mem::take(&mut locked(&self.said))
    }

    /// How far the work has come, where that has changed since this was last asked.
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
