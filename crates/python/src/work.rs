//! Commands in threads of their own: other threads of Python continue, and this one checks for Ctrl-C.

use crate::document::Document;
use crate::failed::{exception_of, unusable};
use numpy::PyReadonlyArray1;
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

/// Time between two checks of signals and progress.
const LOOK: Duration = Duration::from_millis(40);
/// Time for cancelled work to end. Work that takes longer continues in the background.
const PATIENCE: Duration = Duration::from_millis(500);
/// Size of the stack, as of a main thread.
const STACK: usize = 8 << 20;

/// A file from memory: its text, its bytes, its document, or its columns with their headings.
#[derive(FromPyObject)]
pub(crate) enum Given<'py> {
    Text(String),
    Bytes(Vec<u8>),
    Document(Py<Document>),
    Columns(Vec<(String, PyReadonlyArray1<'py, f64>)>),
}

/// Runs a command with its words and the files from memory. `progress` is called with the fraction done, or None if it
/// is unknown, and a count. Returns the result, if there is one, and the messages.
#[pyfunction]
#[pyo3(signature = (words, supplies, progress=None))]
pub(crate) fn call(
    py: Python<'_>,
    words: Vec<String>,
    supplies: Vec<(String, Given<'_>)>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(Option<Document>, Vec<String>)> {
    let supplies: PyResult<Vec<_>> =
        supplies.into_iter().map(|(name, given)| Ok((name.into(), supply(py, given)?))).collect();
    let host = Arc::new(Host::new(supplies?));
    let own = Arc::clone(&host);
    let mut answer = begin(move || hosted::call(words.iter().map(String::as_str), &own))?;
    let answer = wait(py, &mut answer, &host, progress.as_ref());
    let left = || host.take().map(|made| Document::new(py, made));
    match answer {
        Ok(Some(Ok(made))) => Ok((made.map(|made| Document::new(py, made)), host.heard())),
        Ok(Some(Err(refusal))) => Err(with_result(py, exception_of(refusal), left())),
        Ok(None) => Err(with_result(py, exception_of(panicked()), left())),
        Err(error) => Err(with_result(py, error, left())),
    }
}

/// A command: its words, and the files from memory.
type Command<'py> = (Vec<String>, Vec<(String, Given<'py>)>);

/// The document of each run, or its error.
type Runs = Vec<(Option<Document>, Option<String>)>;

/// Runs several `run` commands together. Returns the document of each, or None with its error; and the messages, each
/// with the number of its run.
#[pyfunction]
#[pyo3(signature = (commands, progress=None))]
pub(crate) fn call_runs(
    py: Python<'_>,
    commands: Vec<Command<'_>>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(Runs, Vec<(usize, String)>)> {
    let command = |(words, supplies): Command<'_>| {
        let supplies = supplies.into_iter();
        let supplies = supplies.map(|(name, given)| Ok((name.into(), supply(py, given)?)));
        Ok((words, Arc::new(Host::new(supplies.collect::<PyResult<Vec<_>>>()?))))
    };
    let commands = commands.into_iter().map(command).collect::<PyResult<Vec<_>>>()?;
    let hosts: Vec<Arc<Host>> = commands.iter().map(|(_, host)| Arc::clone(host)).collect();
    let host = Arc::new(Host::new([]));
    let own = Arc::clone(&host);
    let mut answer = begin(move || hosted::runs(&commands, &own))?;
    let runs = match wait(py, &mut answer, &host, progress.as_ref())? {
        Some(Ok(runs)) => runs,
        Some(Err((number, refusal))) => return Err(exception_of(of_run(number, refusal))),
        None => return Err(exception_of(panicked())),
    };
    let heard = hosts
        .iter()
        .enumerate()
        .flat_map(|(number, host)| host.heard().into_iter().map(move |line| (number, line)));
    let run = |run: Result<Made, Refusal>| match run {
        Ok(made) => (Some(Document::new(py, made)), None),
        Err(Refusal::Input(said) | Refusal::Run(said) | Refusal::Stopped(said)) => {
            (None, Some(said))
        }
    };
    Ok((runs.into_iter().map(run).collect(), heard.collect()))
}

/// The error with the number of its run.
fn of_run(number: usize, refusal: Refusal) -> Refusal {
    let named = |said: String| format!("run {number}: {said}");
    match refusal {
        Refusal::Input(said) => Refusal::Input(named(said)),
        Refusal::Run(said) => Refusal::Run(named(said)),
        Refusal::Stopped(said) => Refusal::Stopped(named(said)),
    }
}

fn panicked() -> Refusal {
    let said = "the computation failed for an unknown reason: please report it";
    Refusal::Run(said.into())
}

fn supply(py: Python<'_>, given: Given<'_>) -> PyResult<Supply> {
    Ok(match given {
        Given::Text(text) => Supply::Text(text),
        Given::Bytes(bytes) => Supply::Bytes(bytes),
        Given::Document(document) => {
            let copy = document.get().whole(py, |document| document.copy())?;
            Supply::Document(Arc::from(copy))
        }
        Given::Columns(columns) => Supply::Columns(
            columns.into_iter().map(|(name, column)| (name, column.as_array().to_vec())).collect(),
        ),
    })
}

type Work = Box<dyn FnOnce() + Send>;

/// Idle threads, and the process that they belong to: a forked process has none of them.
static IDLE: Mutex<(u32, Vec<Sender<Work>>)> = Mutex::new((0, vec![]));

fn idle() -> MutexGuard<'static, (u32, Vec<Sender<Work>>)> {
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    if idle.0 != process::id() {
        *idle = (process::id(), vec![]);
    }
    idle
}

/// Starts work in an idle thread, if there is one: a new thread costs half a millisecond, mostly for its memory.
fn begin<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> PyResult<Receiver<T>> {
    let (answer, receiver) = channel();
    let work = move || {
        // The receiver is gone if the call was cancelled.
        answer.send(work()).ok();
    };
    let mut work: Work = Box::new(work);
    while let Some(thread) = { idle().1.pop() } {
        match thread.send(work) {
            Ok(()) => return Ok(receiver),
            // The thread has ended.
            Err(SendError(again)) => work = again,
        }
    }
    let thread = thread::Builder::new().name("stickslip".into()).stack_size(STACK);
    let thread = thread.spawn(move || work_on(work));
    thread.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    Ok(receiver)
}

/// Does one piece of work after another. A panic ends the thread.
fn work_on(first: Work) {
    first();
    let (sender, next) = channel();
    idle().1.push(sender.clone());
    while let Ok(work) = next.recv() {
        work();
        idle().1.push(sender.clone());
    }
}

/// Waits for the answer; None after a panic. An error of Python, such as Ctrl-C, cancels the work.
fn wait<T: Send>(
    py: Python<'_>,
    answer: &mut Receiver<T>,
    host: &Host,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Option<T>> {
    loop {
        match hear(py, answer, LOOK) {
            Ok(answer) => return Ok(Some(answer)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
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

/// The answer, if it comes in time. Other threads of Python continue.
fn hear<T: Send>(
    py: Python<'_>,
    answer: &mut Receiver<T>,
    patience: Duration,
) -> Result<T, RecvTimeoutError> {
    py.detach(move || answer.recv_timeout(patience))
}

fn show(host: &Host, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    match (progress, host.pace()) {
        (Some(progress), Some(pace)) => progress.call1((pace.part, pace.counted)).map(drop),
        _ => Ok(()),
    }
}

/// The error with the partial result as its `document`.
fn with_result(py: Python<'_>, error: PyErr, left: Option<Document>) -> PyErr {
    if let Some(left) = left {
        // An error without it is still correct.
        error.value(py).setattr("document", left).ok();
    }
    error
}

/// The document in a file.
#[pyfunction]
pub(crate) fn load(py: Python<'_>, path: PathBuf) -> PyResult<Document> {
    let document = py.detach(|| hosted::load(&path)).map_err(exception_of)?;
    Ok(Document::new(py, Made { document, headline: String::new(), text: String::new() }))
}

/// The document in a text.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, text: &str) -> PyResult<Document> {
    let document = py.detach(|| hosted::read(text.as_bytes())).map_err(unusable)?;
    Ok(Document::new(py, Made { document, headline: String::new(), text: String::new() }))
}
