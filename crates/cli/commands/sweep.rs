//! `stickslip sweep`.

mod grid;
pub(crate) mod merge;
mod point;

use super::finished::Finished;
use super::job::{Job, judge_places};
use super::progress::Progress;
use crate::arguments::{OutletArguments, SweepArguments, SweepThen};
use crate::arithmetic::arithmetic;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use grid::Grid;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::collections::HashSet;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use stickslip_documents::{FORMAT_VERSION, Software, SweepDocument, SweepParameters, SweepPoint};
use stickslip_figures::judge_sweep;
use stickslip_tip::stop;

const MOST_THREADS: usize = 4096;

pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    if let Some(SweepThen::Merge(merged)) = &arguments.then {
        return merge::merge(merged);
    }
    let threads = threads(arguments)?;
    let read = [("--tip-file", arguments.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let grid = Grid::asked(arguments)?;
    let job = job(&arguments.outlet, arguments.plot.as_deref(), &grid.parameters)?;
    let finished = match job.file() {
        Some(file) => Finished::beside(file, &grid.parameters, |index| grid.parameters.has(index))?,
        None => Finished::in_memory(),
    };
    let interrupt = Interrupt::listen()?;
    let finished = compute(&grid, finished, threads, &interrupt)?;
    if let Some(signal) = interrupt.signal() {
        return Err(left_unfinished(&grid, &finished, signal));
    }
    job.finish(&sealed(grid.parameters, finished.in_order(), Some(arithmetic()))?)?;
    finished.remove();
    Ok(())
}

/// Where a sweep goes, which is found out before hours of work.
fn job(
    outlet: &OutletArguments,
    plot: Option<&Path>,
    parameters: &SweepParameters,
) -> Result<Job, Failure> {
    if plot.is_some() {
        judge_sweep(parameters).map_err(|error| Failure::input("--plot", error))?;
    }
    Job::open::<SweepDocument>(outlet, plot)
}

/// The document of a finished sweep, with its checksum.
fn sealed(
    parameters: SweepParameters,
    points: Vec<SweepPoint>,
    arithmetic: Option<String>,
) -> Result<SweepDocument, Failure> {
    let mut document = SweepDocument {
        format: SweepDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters,
        points,
        arithmetic,
        crc32: None,
    };
    document.crc32 = Some(checksum(&document)?);
    Ok(document)
}

/// CRC-32 of parameters, points and how the machine rounds, as this program writes them, however the document is
/// laid out.
fn checksum(document: &SweepDocument) -> Result<u32, Failure> {
    let text = serde_json::to_vec(&(&document.parameters, &document.points, &document.arithmetic));
    Ok(crc32fast::hash(&text.map_err(|error| Failure::Run(error.to_string()))?))
}

/// 0: as many as there are cores.
fn threads(arguments: &SweepArguments) -> Result<usize, Failure> {
    match arguments.threads {
        None => Ok(0),
        Some(threads) if (1..=MOST_THREADS).contains(&threads) => Ok(threads),
        Some(threads) => {
            let message = format!("1 to {MOST_THREADS} will do");
            Err(Failure::input(format!("--threads {threads}"), message))
        }
    }
}

/// What the threads share.
struct State {
    finished: Finished<SweepPoint>,
    progress: Progress,
    /// Points in all.
    count: usize,
    /// Whether all could be written down.
    kept: io::Result<()>,
}

impl State {
    /// `None` once a point could not be kept: the others need not be found.
    fn keep(&mut self, point: SweepPoint) -> Option<()> {
        self.kept = self.finished.add(point);
        let done = self.finished.parts().len();
        self.progress.counted(done as f64, || format!("{done} of {} points", self.count));
        self.kept.is_ok().then_some(())
    }
}

/// All points that are not finished yet, or as many as there is time for before a signal.
fn compute(
    grid: &Grid,
    finished: Finished<SweepPoint>,
    threads: usize,
    interrupt: &Interrupt,
) -> Result<Finished<SweepPoint>, Failure> {
    let done: HashSet<usize> = finished.parts().iter().map(|point| point.index).collect();
    let missing: Vec<usize> = grid.indices().filter(|index| !done.contains(index)).collect();
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
    let work = |index: &usize| {
        if interrupt.signal().is_some() {
            return None;
        }
        let found = stop::where_asked_by(interrupt.flag(), || judged(*index, grid));
        // What a signal cut short is no point.
        let point = Some(found).filter(|_| interrupt.signal().is_none())?;
        finished_so_far.fetch_add(1, Ordering::Relaxed);
        state.lock().unwrap_or_else(PoisonError::into_inner).keep(point)
    };
    // More than there are points have nothing to do but to look for it; 0 of them is one for each core.
    let threads = threads.min(missing.len().max(1));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| Failure::Run(format!("cannot start threads: {error}")))?;
    pool.install(|| missing.par_iter().with_max_len(1).try_for_each(work));
    let State { finished, kept, .. } = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    kept.map_err(|error: io::Error| {
        let target = finished.path().map_or("memory".into(), |path| path.display().to_string());
        Failure::Write { target, error }
    })?;
    Ok(finished)
}

/// A point; where a library panics, one that failed.
fn judged(index: usize, grid: &Grid) -> SweepPoint {
    let place = grid.place(index);
    let point = AssertUnwindSafe(|| point::point(index, place, grid.parameters.tolerance));
    catch_unwind(point).unwrap_or_else(|_| SweepPoint {
        error: Some(
            "the computation failed for a reason that it cannot tell: please report it".into(),
        ),
        ..SweepPoint::at(index, place.beta, place.r, None)
    })
}

fn left_unfinished(grid: &Grid, finished: &Finished<SweepPoint>, signal: u8) -> Failure {
    unfinished(finished.parts().len(), grid.indices().count(), finished.path(), signal)
}

fn unfinished(done: usize, count: usize, path: Option<&Path>, signal: u8) -> Failure {
    let message = match path {
        Some(path) => format!(
            "{done} of {count} points are in {}: the same command goes on from there",
            path.display()
        ),
        None => format!(
            "{done} of {count} points were done, none are kept: with -o FILE.json they would be"
        ),
    };
    Failure::Unfinished { signal, message }
}
