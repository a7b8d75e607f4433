//! Parallel computation of points on all cores; each is saved when finished.

use crate::commands::finished::{Finished, Part};
use crate::commands::progress::Progress;
use crate::failure::Failure;
use crate::host;
use crate::interrupt::Interrupt;
use crate::message::remark;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSlice;
use std::collections::HashSet;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use stickslip_tip::stop;

const GROUPS_PER_THREAD: usize = 4;

/// State shared by the threads.
struct State<P> {
    finished: Finished<P>,
    progress: Progress,
    /// Total number of points.
    count: usize,
    /// Whether all points could be saved.
    kept: io::Result<()>,
}

impl<P: Part> State<P> {
    /// Saves a point; `None` if one could not be saved, in which case the others are abandoned.
    fn keep(&mut self, point: P) -> Option<()> {
        self.kept = self.finished.add(point);
        let done = self.finished.parts().len();
        self.progress.counted(done as f64, || format!("{done} of {} points", self.count));
        self.kept.is_ok().then_some(())
    }
}

/// Computes all points that are not finished yet, on this number of threads (0 means one per core). `judged` computes
/// the points with some indices, at most `together` of them, and passes each on as soon as it is complete.
///
/// # Errors
/// A signal arrived, or a point could not be saved.
pub(super) fn compute<P: Part + Send>(
    indices: &[usize],
    finished: Finished<P>,
    (threads, together): (usize, usize),
    interrupt: &Interrupt,
    judged: impl Fn(&[usize], &mut dyn FnMut(P)) + Sync,
) -> Result<Finished<P>, Failure> {
    let done: HashSet<usize> = finished.parts().iter().map(P::index).collect();
    let missing: Vec<usize> =
        indices.iter().copied().filter(|index| !done.contains(index)).collect();
    let count = done.len() + missing.len();
    if let (Some(path), false) = (finished.path(), done.is_empty()) {
        remark(format_args!(
            "stickslip: {} of {count} points are in {}",
            done.len(),
            path.display()
        ));
    }
    let progress = Progress::new(done.len() as f64, count as f64).at_every_call();
    let state = Mutex::new(State { finished, progress, count, kept: Ok(()) });
    let finished_so_far = Arc::new(AtomicUsize::new(done.len()));
    {
        let done = Arc::clone(&finished_so_far);
        let path = state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .finished
            .path()
            .map(Path::to_owned);
        interrupt.or_else(move |signal| {
            unfinished(done.load(Ordering::Relaxed), count, path.as_deref(), signal)
        });
    }
    let work = |indices: &[usize]| {
        let mut kept = Some(());
        let mut take = |point: P| {
            // What a signal cut short is no point.
            if kept.is_some() && interrupt.signal().is_none() {
                finished_so_far.fetch_add(1, Ordering::Relaxed);
                kept = state.lock().unwrap_or_else(PoisonError::into_inner).keep(point);
            }
        };
        if interrupt.signal().is_none() {
            stop::where_asked_by(interrupt.flag(), || judged(indices, &mut take));
        }
        kept.filter(|()| interrupt.signal().is_none())
    };
    // More than there are points have nothing to do but to look for it; 0 of them is one for each core.
    let threads = threads.min(missing.len().max(1));
    let host = host::current();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.start_handler(move |_| host::set(host.clone())).build();
    let pool = pool.map_err(|error| Failure::Run(format!("cannot start threads: {error}")))?;
    // Several groups for each thread, as some take longer than others.
    let groups = GROUPS_PER_THREAD * pool.current_num_threads();
    let size = missing.len().div_ceil(groups).clamp(1, together);
    pool.install(|| missing.par_chunks(size).with_max_len(1).try_for_each(work));
    let State { finished, kept, .. } = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    kept.map_err(|error: io::Error| {
        let target = finished.path().map_or("memory".into(), |path| path.display().to_string());
        Failure::Write { target, error }
    })?;
    match interrupt.signal() {
        Some(signal) => Err(unfinished(finished.parts().len(), count, finished.path(), signal)),
        None => Ok(finished),
    }
}

fn unfinished(done: usize, count: usize, path: Option<&Path>, signal: u8) -> Failure {
    let message = match path {
        Some(path) => format!(
            "{done} of {count} points are in {}: the same command continues from there",
            path.display()
        ),
        None => format!(
            "{done} of {count} points were computed and none are kept: -o FILE.json would keep them"
        ),
    };
    Failure::Unfinished { signal, message }
}
