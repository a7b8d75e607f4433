//! A command, in a thread of its own: other threads of Python run on, and this one listens for Ctrl-C.

use crate::document::Document;
use crate::failed::{raised, unusable};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::process;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SendError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;
use stickslip_cli::hosted::{self, Host, Made, Refusal, Supply};

/// Between two looks at the signals and the progress.
const LOOK: Duration = Duration::from_millis(40);
/// For work to end that was told to; what does not hear goes on by itself, and nobody waits for it.
const PATIENCE: Duration = Duration::from_millis(500);
/// As a main thread has.
const STACK: usize = 8 << 20;

/// A file from memory: its text or bytes, or the document that it would hold.
#[derive(FromPyObject)]
pub(crate) enum Given {
    Text(String),
    Bytes(Vec<u8>),
    Document(Py<Document>),
}

type Answer = Result<Option<Made>, Refusal>;

/// Carries out a command: its words, the files that it finds in memory, and who is told how far it has come, by part
/// (None where the end is not known) and words. What it has made, if anything, and the lines that it has said.
#[pyfunction]
#[pyo3(signature = (words, supplies, progress=None))]
pub(crate) fn call(
    py: Python<'_>,
    words: Vec<String>,
    supplies: Vec<(String, Given)>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(Option<Document>, Vec<String>)> {
    let supplies: PyResult<Vec<_>> =
        supplies.into_iter().map(|(name, given)| Ok((name.into(), supply(py, given)?))).collect();
    let host = Arc::new(Host::new(supplies?));
    let mut answer = begin(words, &host)?;
    let answer = wait(py, &mut answer, &host, progress.as_ref());
    let left = || host.take().map(|made| Document::new(py, made));
    match answer {
        Ok(Ok(made)) => Ok((made.map(|made| Document::new(py, made)), host.heard())),
        Ok(Err(refusal)) => Err(with_result(py, raised(refusal), left())),
        Err(error) => Err(with_result(py, error, left())),
    }
}

fn supply(py: Python<'_>, given: Given) -> PyResult<Supply> {
    Ok(match given {
        Given::Text(text) => Supply::Text(text),
        Given::Bytes(bytes) => Supply::Bytes(bytes),
        Given::Document(document) => {
            let copy = document.get().whole(py, |document| document.copy())?;
            Supply::Document(Arc::from(copy))
        }
    })
}

type Work = Box<dyn FnOnce() + Send>;

/// Threads that have nothing to do, and the process that they are of: a fork has none of them.
static IDLE: Mutex<(u32, Vec<Sender<Work>>)> = Mutex::new((0, vec![]));

fn idle() -> MutexGuard<'static, (u32, Vec<Sender<Work>>)> {
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    if idle.0 != process::id() {
        *idle = (process::id(), vec![]);
    }
    idle
}

/// Starts the work, in a thread that is there already, if one is: a new one costs half a millisecond, most of it for
/// memory of its own.
fn begin(words: Vec<String>, host: &Arc<Host>) -> PyResult<Receiver<Answer>> {
    let (answer, receiver) = channel();
    let host = Arc::clone(host);
    let work = move || {
        let words = words.iter().map(String::as_str);
        // Nobody hears it who has gone.
        answer.send(hosted::call(words, &host)).ok();
    };
    let mut work: Work = Box::new(work);
    while let Some(thread) = { idle().1.pop() } {
        match thread.send(work) {
            Ok(()) => return Ok(receiver),
            // It has ended.
            Err(SendError(again)) => work = again,
        }
    }
    let thread = thread::Builder::new().name("stickslip".into()).stack_size(STACK);
    let thread = thread.spawn(move || work_on(work));
    thread.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    Ok(receiver)
}

/// One piece of work after another; a thread whose work panics ends.
fn work_on(first: Work) {
    first();
    let (sender, next) = channel();
    idle().1.push(sender.clone());
    while let Ok(work) = next.recv() {
        work();
        idle().1.push(sender.clone());
    }
}

/// Waits for the answer; the error is Python's, Ctrl-C say, and the work was told to stop.
fn wait(
    py: Python<'_>,
    answer: &mut Receiver<Answer>,
    host: &Host,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Answer> {
    loop {
        match hear(py, answer, LOOK) {
            Ok(answer) => return Ok(answer),
            Err(RecvTimeoutError::Disconnected) => {
                let said =
                    "the computation failed for an unknown reason: please report it";
                return Ok(Err(Refusal::Run(said.into())));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        let looked = py.check_signals().and_then(|()| show(host, progress));
        if let Err(error) = looked {
            host.stop().store(true, Ordering::Relaxed);
            hear(py, answer, PATIENCE).ok();
            return Err(error);
        }
    }
}

/// The answer, if it comes in time; other threads of Python run on.
fn hear(
    py: Python<'_>,
    answer: &mut Receiver<Answer>,
    patience: Duration,
) -> Result<Answer, RecvTimeoutError> {
    py.detach(move || answer.recv_timeout(patience))
}

fn show(host: &Host, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    match (progress, host.pace()) {
        (Some(progress), Some(pace)) => progress.call1((pace.part, pace.counted)).map(drop),
        _ => Ok(()),
    }
}

/// The error, with what was computed until then as its `result`.
fn with_result(py: Python<'_>, error: PyErr, left: Option<Document>) -> PyErr {
    if let Some(left) = left {
        // Without it there is less to be seen, and nothing else is lost.
        error.value(py).setattr("document", left).ok();
    }
    error
}

/// The document that a file holds.
#[pyfunction]
pub(crate) fn load(py: Python<'_>, path: PathBuf) -> PyResult<Document> {
    let document = py.detach(|| hosted::load(&path)).map_err(raised)?;
    Ok(Document::new(py, Made { document, headline: String::new(), text: String::new() }))
}

/// The document that a text holds.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, text: &str) -> PyResult<Document> {
    let document = py.detach(|| hosted::read(text.as_bytes())).map_err(unusable)?;
    Ok(Document::new(py, Made { document, headline: String::new(), text: String::new() }))
}
